// SPDX-License-Identifier: MIT
#include "output/atomic_file.hpp"

#include "base/error.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tribo {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::filesystem::path& temporary, int reason) {
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw FileError("cannot write '" + path.string() + "': " + (reason ? std::strerror(reason) : "the writer gave up"));
}

void flush_to_disk(const std::filesystem::path& path, const std::filesystem::path& temporary) {
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (file < 0) fail(path, temporary, errno);
  const int result = ::fsync(file);
  const int reason = errno;
  ::close(file);
  if (result != 0) fail(path, temporary, reason);
}

}  // namespace

void write_atomically(const std::filesystem::path& path, const std::function<bool(const std::string&)>& write) {
  // The extension is kept because some writers choose their format by it.
  auto temporary = path;
  temporary.replace_filename("." + path.stem().string() + ".writing" + path.extension().string());
  errno = 0;
  if (!write(temporary.string())) fail(path, temporary, errno);
  flush_to_disk(path, temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, temporary, errno);
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  write_atomically(path, [&](const std::string& temporary) {
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);  // NOLINT
    if (file < 0) return false;
    std::size_t done = 0;
    while (done < content.size()) {
      const auto n = ::write(file, content.data() + done, content.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) {
        const int reason = errno;
        ::close(file);
        errno = reason;
        return false;
      }
      done += static_cast<std::size_t>(n);
    }
    return ::close(file) == 0;
  });
}

}  // namespace tribo
