// SPDX-License-Identifier: MIT
#include "input/script/python_text.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace tribo::script {
namespace {

constexpr std::size_t longest_line = 118;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool small(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '\r' ? "\\r" : std::string(1, c);
  }
  return out + "\"";
}

// An expression of the script for a text with line breaks, which a text in quotes cannot have there.
std::string joined_lines(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '\n' ? "\"&return&\"" : c == '"' ? "\"&quote&\"" : std::string(1, c);
  return "tribo.Expression(" + quoted(out + "\"") + ")";
}

// Python reads the number in the same way: 007 is none.
bool is_python_number(const std::string& text) {
  const std::size_t first = text[0] == '-' || text[0] == '+' ? 1 : 0;
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return is_digit(c) || c == '.' || c == 'e' || c == 'E' || c == '+' || c == '-';
  });
  const bool leading_zero = text.size() > first + 1 && text[first] == '0' && is_digit(text[first + 1]);
  return plain && !leading_zero;
}

}  // namespace

std::string python_value(const std::string& text) {
  if (text.empty()) return "tribo.Expression(\"\")";  // an argument that is left out
  if (to_number(text) && is_python_number(text)) return text;
  return text.find('\n') == std::string::npos ? quoted(text) : joined_lines(text);
}

std::string python_lines(const std::string& text) {
  std::string out = "\"\"\"";
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool ends_text = text[k] == '"' && (k + 1 == text.size() || text[k + 1] == '"');
    if (text[k] == '\\' || ends_text) out += '\\';
    out += text[k];
  }
  return out + "\"\"\"";
}

bool is_python_name(const std::string& name) {
  static constexpr std::array keywords{
      "False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
      "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
      "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
      "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield",    "self"};
  const auto letter = [](char c) { return small(c) || capital(c) || c == '_'; };
  return !name.empty() && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || is_digit(c); }) &&
         std::find(keywords.begin(), keywords.end(), name) == keywords.end();
}

std::string python_method(std::string_view command) {
  std::string out;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const char c = command[k];
    const bool begins_word = k > 0 && capital(c) &&
                             (small(command[k - 1]) || is_digit(command[k - 1]) ||
                              (capital(command[k - 1]) && k + 1 < command.size() && small(command[k + 1])));
    if (begins_word) out += '_';
    out += c;
  }
  return lower(out);
}

std::string python_call(const std::string& begin, const std::vector<std::string>& arguments, const std::string& end,
                        std::size_t indent) {
  const std::string margin(indent + begin.size() + 1, ' ');
  std::string out = std::string(indent, ' ') + begin + "(";
  std::size_t column = out.size();
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const bool last = k + 1 == arguments.size();
    const std::size_t length = arguments[k].size() + (last ? 1 + end.size() : 1);
    if (k > 0 && column + 1 + length > longest_line)
      out += "\n" + margin, column = margin.size();
    else if (k > 0)
      out += " ", ++column;
    out += arguments[k] + (last ? "" : ","), column += length;
  }
  return out + ")" + end;
}

}  // namespace tribo::script
