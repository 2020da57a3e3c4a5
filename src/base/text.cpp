// SPDX-License-Identifier: MIT
#include "base/text.hpp"

#include <sstream>

namespace tribo {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::string plural(bool one, std::string_view noun) { return std::string(noun) + (one ? "" : "s"); }

std::string counted(double number, std::string_view noun, const char* pattern) {
  const std::string text = format(pattern, number);
  return text + " " + plural(text == "1", noun);
}

std::string escaped(std::string_view text, char quote) {
  std::string out;
  for (const char c : text)
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"' && quote == c)
      out += "&quot;";
    else if (c == '\'' && quote == c)
      out += "&apos;";
    else
      out += c;
  return out;
}

}  // namespace tribo
