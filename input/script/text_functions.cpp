// SPDX-License-Identifier: MIT
#include "input/script/text_functions.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace tribo::script {
namespace {

std::string words_between(const std::string& text, std::size_t begin, std::size_t end) {
  const auto words = words_of(text);
  std::string out;
  for (std::size_t k = begin; k < std::min(end, words.size()); ++k) out += (out.empty() ? "" : " ") + words[k];
  return out;
}

std::string trim(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

template <class F>
std::string each_letter(std::string text, F f) {
  for (char& c : text) c = f(c);
  return text;
}
char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string title_case(std::string text) {
  bool first = true;
  for (char& c : text) {
    c = first ? capital(c) : small(c);
    first = c == ' ' || c == '\t';
  }
  return text;
}

// Converts a position counted from 1 to an index from 0. An invalid position gives an index beyond any text.
std::size_t index(double count) {
  return count >= 1 && count < 1e9 ? static_cast<std::size_t>(count) - 1 : static_cast<std::size_t>(1e9);
}

std::string replaced(const std::string& what, const std::string& by, const std::string& text) {
  if (what.empty()) return text;
  std::string out;
  std::size_t at = 0;
  for (auto found = text.find(what); found != std::string::npos; found = text.find(what, at)) {
    out += text.substr(at, found - at) + by;
    at = found + what.size();
  }
  return out + text.substr(at);
}

double rounded(double x, double digits) {
  const double scale = std::pow(10.0, std::clamp(std::round(digits), -15.0, 15.0));
  return std::round(x * scale) / scale;
}

using Arguments = std::vector<Value>;
using Number = std::function<double(const Value&)>;

template <class F>
TextFunction of_text(std::string_view name, F f) {
  return {name, 1, 1, "one text", [f](const Arguments& a, const Number&) -> Value { return f(printed(a[0])); }};
}

std::vector<TextFunction> make() {
  std::vector<TextFunction> all{
      of_text("length", [](const std::string& s) { return static_cast<double>(s.size()); }),
      of_text("words", [](const std::string& s) { return static_cast<double>(words_of(s).size()); }),
      of_text("firstWord", [](const std::string& s) { return words_between(s, 0, 1); }),
      of_text("lastWord", [](const std::string& s) { return words_of(s).empty() ? "" : words_of(s).back(); }),
      of_text("removeFirstWord", [](const std::string& s) { return words_between(s, 1, std::string::npos); }),
      of_text(
          "removeLastWord",
          [](const std::string& s) { return words_between(s, 0, std::max<std::size_t>(words_of(s).size(), 1) - 1); }),
      of_text("trim", trim),
      of_text("upperCase", [](const std::string& s) { return each_letter(s, capital); }),
      of_text("lowerCase", [](const std::string& s) { return each_letter(s, small); }),
      of_text("titleCase", title_case)};
  all.push_back({"chars", 3, 3, "a first place, a last place and a text: chars(2\\4\\#s)",
                 [](const Arguments& a, const Number& number) -> Value {
                   const std::string text = printed(a[2]);
                   const std::size_t first = index(number(a[0])), last = index(number(a[1]));
                   return first < text.size() && last >= first ? text.substr(first, last - first + 1) : std::string();
                 }});
  all.push_back(
      {"word", 2, 2, "a number and a text: word(2\\#s)", [](const Arguments& a, const Number& number) -> Value {
         const std::size_t n = index(number(a[0]));
         return words_between(printed(a[1]), n, n + 1);
       }});
  all.push_back({"offset", 3, 3, "what to look for, the place to begin at and a text: offset(\"x\"\\1\\#s)",
                 [](const Arguments& a, const Number& number) -> Value {
                   const auto found = printed(a[2]).find(printed(a[0]), index(number(a[1])));
                   return found == std::string::npos ? 0.0 : static_cast<double>(found + 1);
                 }});
  all.push_back({"replace", 3, 3, "what to replace, by what and a text: replace(\"a\"\\\"b\"\\#s)",
                 [](const Arguments& a, const Number&) -> Value {
                   return replaced(printed(a[0]), printed(a[1]), printed(a[2]));
                 }});
  all.push_back({"round", 1, 2, "a number and how many decimals (default 0)",
                 [](const Arguments& a, const Number& number) -> Value {
                   const auto parts = words_of(printed(a[0]));
                   if (a.size() == 1 && is_text(a[0]) && parts.size() == 2)
                     return rounded(number(Value(parts[0])), number(Value(parts[1])));
                   return rounded(number(a[0]), a.size() > 1 ? number(a[1]) : 0.0);
                 }});
  return all;
}

const std::vector<TextFunction>& functions() {
  static const std::vector<TextFunction> all = make();
  return all;
}

}  // namespace

const TextFunction* find_text_function(std::string_view name) {
  const std::string wanted = lower(name);
  for (const auto& f : functions())
    if (lower(f.name) == wanted) return &f;
  return nullptr;
}

std::string text_function_names() {
  std::string out;
  for (const auto& f : functions()) out += (out.empty() ? "" : " ") + std::string(f.name);
  return out;
}

}  // namespace tribo::script
