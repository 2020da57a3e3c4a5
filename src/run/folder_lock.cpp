// SPDX-License-Identifier: MIT
#include "run/folder_lock.hpp"

#include "base/error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace tribo {
namespace {

constexpr std::string_view signature = "process ";

std::string content(int file) {
  std::array<char, 256> text{};
  const auto n = ::pread(file, text.data(), text.size(), 0);
  std::string out(text.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  return out.substr(0, out.find('\n'));
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown machine";
}

// Whether the path still leads to the open file: another process may have removed it meanwhile.
bool leads_to(const std::filesystem::path& path, int file) {
  struct stat a {
  }, b{};
  return ::fstat(file, &a) == 0 && ::stat(path.c_str(), &b) == 0 && a.st_ino == b.st_ino && a.st_dev == b.st_dev;
}

// Opens the file, or creates it. NOLINTBEGIN(cppcoreguidelines-pro-type-vararg)
int open_lock(const std::filesystem::path& path, bool& created) {
  const int common = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
  while (true) {
    const int made = ::open(path.c_str(), common | O_CREAT | O_EXCL, 0666);
    created = made >= 0;
    if (made >= 0 || errno != EEXIST) return made;
    const int found = ::open(path.c_str(), common);
    if (found >= 0 || errno != ENOENT) return found;
  }
}
// NOLINTEND(cppcoreguidelines-pro-type-vararg)

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : path_(folder / file_name) {
  const auto fail = [&](const std::string& message) {
    if (file_ >= 0) ::close(file_);
    throw FileError(message);
  };
  while (true) {
    file_ = open_lock(path_, created_);
    if (file_ < 0) fail("cannot write '" + path_.string() + "': " + std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) {
      if (leads_to(path_, file_)) break;
      ::close(file_);
      continue;
    }
    if (errno == EINTR) {
      ::close(file_);
      continue;
    }
    if (errno == EWOULDBLOCK) {
      const std::string holder = content(file_);
      fail("another run writes into '" + folder.string() + "': " + (holder.empty() ? "an unknown process" : holder) +
           "; wait for its end, stop it, or choose another folder with --output");
    }
    std::fprintf(stderr, "warning: '%s' cannot be locked (%s): do not start a second run in this folder\n",
                 path_.c_str(), std::strerror(errno));
    break;
  }
  const std::string found = content(file_);
  if (!found.empty() && !found.starts_with(signature))
    fail("'" + path_.string() + "' was not made by Tribo; move it, or choose another folder with --output");
  sign();
}

// The lock works without this text, so a full disk does not matter.
void FolderLock::sign() const {
  const std::string text = std::string(signature) + std::to_string(::getpid()) + " on " + host() + "\n";
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) < 0) errno = 0;
}

FolderLock::~FolderLock() {
  if (created_) ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace tribo
