// SPDX-License-Identifier: MIT
#include "input/format_version.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace tribo {
namespace {

// A whole number without sign and leading zeros; -1 if the text is something else.
int whole(std::string_view text) {
  const bool digits =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || (text.size() > 1 && text.front() == '0')) return -1;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : -1;
}

}  // namespace

std::optional<FormatVersion> format_version(std::string_view text) {
  std::array<int, 3> numbers{};
  for (int& number : numbers) {
    const auto point = text.find('.');
    number = whole(text.substr(0, point));
    if (number < 0) return {};
    if (point == std::string_view::npos) return FormatVersion{numbers[0], numbers[1], numbers[2]};
    text.remove_prefix(point + 1);
  }
  return {};
}

std::string format_version_text(const FormatVersion& version) {
  const std::string text = std::to_string(version.major) + "." + std::to_string(version.minor);
  return version.patch == 0 ? text : text + "." + std::to_string(version.patch);
}

std::string problem_of_format_version(std::string_view text) {
  const auto version = format_version(text);
  const std::string newest = format_version_text(newest_format);
  if (!version)
    return "must be one to three whole numbers with points between them, such as 3 or " + newest + ", not '" +
           std::string(text) + "'";
  if (*version > newest_format)
    return "is " + std::string(text) + ", but this program reads the format up to version " + newest +
           "; use a newer Tribo, or state the version whose keywords the file needs";
  return {};
}

}  // namespace tribo
