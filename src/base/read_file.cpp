// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include "base/error.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>

namespace tribo {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw FileError("cannot read the file '" + printable(file.string()) + "': " + why);
}

std::string reason(int error) {
  switch (error) {
    case ENOENT:
      return "there is no such file";
    case ENOTDIR:
      return "a part of its path is not a folder";
    case EACCES:
    case EPERM:
      return "no permission to read it";
    case ELOOP:
      return "its symbolic links form a loop";
    case ENAMETOOLONG:
      return "its name is too long";
    default:
      return std::strerror(error);
  }
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

// A number of bytes in a file of the system; infinity if it has none.
double number_in(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    if (!key.empty() && word != key) continue;
    double value = 0;
    const bool found = key.empty() ? !word.empty() && word[0] >= '0' && word[0] <= '9' : bool(in >> value);
    if (found) return key.empty() ? std::stod(word) : 1024 * value;
    break;
  }
  return std::numeric_limits<double>::infinity();
}

// Length of the UTF-8 sequence at a place; 0 if there is none.
std::size_t sequence(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xC2 && first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (first >= 0x80 && (first < 0xC2 || first > 0xF4)) return 0;
  if (at + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[at + k]) & 0xC0U) != 0x80U) return 0;
  return length;
}

}  // namespace

std::string printable(const std::string& name) {
  static constexpr std::size_t longest = 200;
  return printable(name, longest, false);
}

std::string printable(const std::string& text, std::size_t longest, bool lines) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (out.size() >= longest) return out + "...";
    const std::size_t length = sequence(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    const bool shown = length > 1 || (length == 1 && first >= 0x20 && first != 0x7F) || (lines && first == '\n');
    out += shown ? text.substr(at, length) : "?";
    at += std::max<std::size_t>(1, length);
  }
  return out;
}

std::string read_file(const std::filesystem::path& file, std::uintmax_t most) {
  // A pipe without a writer must not block.
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};  // NOLINT
  if (in.number < 0) refuse(file, reason(errno));
  struct stat about {};
  if (::fstat(in.number, &about) != 0) refuse(file, reason(errno));
  if (S_ISDIR(about.st_mode)) refuse(file, "it is a folder");
  if (!S_ISREG(about.st_mode)) refuse(file, "it is a pipe, a socket or a device, not a file");
  const auto size = static_cast<std::uintmax_t>(about.st_size);
  const auto too_large = [&] { refuse(file, "it is larger than " + std::to_string(most >> 20) + " MB"); };
  if (size > most) too_large();
  std::string out;
  const auto no_memory = [&] { refuse(file, "not enough memory for its " + std::to_string(size >> 20) + " MB"); };
  static constexpr std::size_t piece = 1 << 16;
  std::size_t used = 0;
  while (true) {
    try {
      if (used == out.size()) out.resize(std::max(used + piece, static_cast<std::size_t>(size) + 1));
    } catch (const std::bad_alloc&) {
      no_memory();
    }
    const auto n = ::read(in.number, out.data() + used, out.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(file, reason(errno));
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used > most) too_large();
  }
  out.resize(used);
  return out;
}

double available_memory() {
  const double machine = number_in("/proc/meminfo", "MemAvailable:");
  const double limit = number_in("/sys/fs/cgroup/memory.max", ""),
               used = number_in("/sys/fs/cgroup/memory.current", "");
  rlimit own{};
  const bool limited = ::getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY;
  const double allowed = limited ? static_cast<double>(own.rlim_cur) : machine;
  return std::min({machine, allowed, limit < 1e300 && used < 1e300 ? std::max(0.0, limit - used) : limit});
}

}  // namespace tribo
