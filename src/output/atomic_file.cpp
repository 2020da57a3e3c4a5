// SPDX-License-Identifier: MIT
#include "output/atomic_file.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace tribo {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::filesystem::path& temporary, int reason) {
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw FileError("cannot write '" + path.string() + "': " + (reason ? std::strerror(reason) : "the writer gave up"));
}

// What is written must be on the disk before it gets its name.
void complete(const std::filesystem::path& path, const std::filesystem::path& temporary) {
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (file < 0) fail(path, temporary, errno);
  const int result = ::fsync(file);
  const int reason = errno;
  ::close(file);
  if (result != 0) fail(path, temporary, reason);
}

// Devices and pipes, such as /dev/stdout, are written to: a file must not take their place.
bool is_special(const std::filesystem::path& path) {
  // /dev/stdout may lead to a file of the shell, which must remain the same.
  const std::string name = std::filesystem::absolute(path).lexically_normal().string();
  if (name.starts_with("/proc/") || (name.starts_with("/dev/") && !name.starts_with("/dev/shm/"))) return true;
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

bool append_to(int file, std::string_view content) {
  while (!content.empty()) {
    const auto n = ::write(file, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

// Small parts are joined, so that the system is not called for each.
bool write_to(const std::string& path, std::span<const std::string_view> parts) {
  static constexpr std::size_t small = std::size_t{1} << 16;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);  // NOLINT
  if (file < 0) return false;
  std::string joined;
  bool good = true;
  for (const std::string_view part : parts) {
    if (joined.size() + part.size() > small) good = good && append_to(file, joined), joined.clear();
    if (part.size() > small)
      good = good && append_to(file, part);
    else
      joined += part;
  }
  good = good && append_to(file, joined);
  const int reason = errno;
  const bool closed = ::close(file) == 0;
  if (!good) errno = reason;
  return good && closed;
}

}  // namespace

// The extension is kept because some writers choose their format by it.
std::filesystem::path temporary_of(const std::filesystem::path& path) {
  auto temporary = path;
  temporary.replace_filename("." + path.stem().string() + ".writing" + path.extension().string());
  return temporary;
}

std::function<void()> begin_atomically(const std::filesystem::path& path,
                                       const std::function<bool(const std::string&)>& write) {
  if (is_special(path))
    throw FileError("cannot write '" + printable(path.string()) + "': it is a pipe, a socket or a device, not a file");
  const auto temporary = temporary_of(path);
  errno = 0;
  if (!write(temporary.string())) fail(path, temporary, errno);
  return [path, temporary] {
    complete(path, temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, temporary, errno);
  };
}

void write_atomically(const std::filesystem::path& path, const std::function<bool(const std::string&)>& write) {
  begin_atomically(path, write)();
}

void flush_to_disk(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (file < 0 && errno == ENOENT) return;
  const bool done = file >= 0 && (::fsync(file) == 0 || errno == EINVAL);  // some file systems cannot flush folders
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (!done) throw FileError("cannot write '" + printable(path.string()) + "': " + std::strerror(reason));
}

bool write_over(const std::filesystem::path& path, std::string_view content) {
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (file < 0) return false;
  struct stat status {};
  constexpr std::size_t block = 512;  // the unit of st_blocks
  const bool fits = ::fstat(file, &status) == 0 && content.size() <= static_cast<std::size_t>(status.st_blocks) * block;
  const bool written = fits &&
                       ::pwrite(file, content.data(), content.size(), 0) == static_cast<ssize_t>(content.size()) &&
                       ::ftruncate(file, static_cast<off_t>(content.size())) == 0 && ::fsync(file) == 0;
  ::close(file);
  return written;
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  write_atomically(path, std::array{content});
}

void write_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts) {
  if (!is_special(path))
    return write_atomically(path, [&](const std::string& temporary) { return write_to(temporary, parts); });
  errno = 0;
  if (!write_to(path.string(), parts))
    throw FileError("cannot write '" + printable(path.string()) + "': " + std::strerror(errno));
}

}  // namespace tribo
