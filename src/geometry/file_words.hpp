// SPDX-License-Identifier: MIT
/// The words of a text file, with their places.
#pragma once

#include "base/schema.hpp"
#include "geometry/file.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace tribo {

/// Reads the words between blanks one after the other. What fails throws FileError `path:line:column: message` with the
/// place of the last word.
class FileWords {
 public:
  explicit FileWords(const Bytes& bytes) : bytes_(bytes), text_(bytes.text()) {}

  /// The next word; empty at the end of the file.
  std::string_view next() {
    for (; at_ < text_.size() && blank(text_[at_]); ++at_)
      if (text_[at_] == '\n') ++line_, line_start_ = at_ + 1;
    word_ = at_;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    return text_.substr(word_, at_ - word_);
  }
  /// The text up to the end of the line.
  std::string_view rest_of_line() {
    const std::size_t start = at_;
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    return text_.substr(start, at_ - start);
  }
  void skip_line() { rest_of_line(); }
  /// The next word must be this one, in any case.
  void expect(std::string_view wanted) {
    const auto word = next();
    if (!same(word, wanted)) fail("'" + std::string(wanted) + "' is expected, not " + shown(word));
  }
  double number() {
    const auto word = next();
    const auto value = to_number(word);
    if (!value) fail("a number is expected, not " + shown(word));
    return *value;
  }
  /// A whole number in a range.
  std::int64_t whole(std::int64_t lowest, std::int64_t highest) {
    const auto word = next();
    const auto value = to_number(word);
    if (!value || *value != std::floor(*value) || *value < static_cast<double>(lowest) ||
        *value > static_cast<double>(highest))
      fail("a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest) + " is expected, not " +
           shown(word));
    return static_cast<std::int64_t>(*value);
  }
  [[noreturn]] void fail(const std::string& message) const {
    bytes_.fail_at(line_, static_cast<int>(word_ - line_start_) + 1, message);
  }

  /// Whether two words are the same in any case.
  static bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if ((a[i] | 32) != (b[i] | 32)) return false;
    return true;
  }
  /// A word for messages.
  static std::string shown(std::string_view word) {
    return word.empty() ? "the end of the file" : "'" + std::string(word.substr(0, 40)) + "'";
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  const Bytes& bytes_;
  std::string_view text_;
  std::size_t at_ = 0, word_ = 0, line_start_ = 0;
  int line_ = 1;
};

}  // namespace tribo
