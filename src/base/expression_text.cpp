// SPDX-License-Identifier: MIT
#include "base/expression_text.hpp"

#include "base/expression.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tribo {

const std::vector<FunctionName>& expression_functions() {
  static const std::vector<FunctionName> all{
      {"sin"},        {"cos"},           {"tan"},       {"asin"},         {"acos"},      {"atan"},     {"sinh"},
      {"cosh"},       {"tanh"},          {"log"},       {"ln"},           {"log10"},     {"exp"},      {"sqrt"},
      {"abs"},        {"int"},           {"erf"},       {"erfc"},         {"sign"},      {"sgn"},      {"mod", 2, 2},
      {"ramp", 2, 2}, {"cosramp", 2, 2}, {"box", 2, 2}, {"sinbox", 2, 2}, {"min", 2, 0}, {"max", 2, 0}};
  return all;
}

const std::vector<std::string>& expression_variables() {
  static const std::vector<std::string> all{"t", "x", "y", "z", "dt", "q", "R", "Z", "D", "T", "x0", "y0", "z0"};
  return all;
}

Origin origin_inside(const Origin& origin, const std::string& text, std::size_t offset) {
  Origin at = origin;
  const auto before = std::string_view(text).substr(0, offset);
  const auto newline = before.rfind('\n');
  if (newline != std::string_view::npos) {
    if (at.line > 0) at.line += static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    at.column = static_cast<int>(offset - newline);
  } else if (at.column > 0) {
    at.column += static_cast<int>(offset);
  }
  return at;
}

namespace {

// Character classes of ASCII, independent of the locale.
bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string function_list() {
  std::vector<std::string> names;
  for (const auto& f : expression_functions()) names.emplace_back(f.name);
  return join(names, " ");
}

// Parses the text once from left to right. A valid expression alternates between operands and operators.
class Checker {
 public:
  Checker(const std::string& text, const Origin& origin) : text_(text), origin_(origin) {}

  CheckedText run() {
    if (text_.size() > Expression::longest)
      fail(Expression::longest, "the expression is longer than " + std::to_string(Expression::longest) + " characters");
    levels_.push_back({});
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (operand_next_)
        operand();
      else
        after_operand();
    }
    if (operand_next_)
      fail(text_.size(), text_.find_first_not_of(" \t\r\n") == std::string::npos
                             ? "the expression is empty"
                             : "the expression ends where a value is expected");
    if (levels_.size() > 1) fail(levels_.back().opened, "this '(' is never closed");
    close_choices(text_.size());
    return std::move(out_);
  }

 private:
  // State of one pair of parentheses; the lowest level is the whole text.
  struct Level {
    std::size_t opened = 0;
    const FunctionName* function = nullptr;
    int arguments = 1;
    std::vector<std::size_t> choices;  // places of `?` without their `:` so far
  };

  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw InputError(origin_inside(origin_, text_, offset), message + " in '" + quoted() + "'");
  }

  std::string quoted() const { return text_.size() <= 200 ? text_ : text_.substr(0, 197) + "..."; }

  void skip_blanks() {
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
  }

  // The character at the current place, with all bytes if it is not ASCII.
  std::string character() const {
    std::size_t end = at_ + 1;
    if (static_cast<unsigned char>(text_[at_]) >= 0x80)
      while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    return text_.substr(at_, end - at_);
  }

  void operand() {
    const char c = text_[at_];
    if (c == '+' || c == '-') {
      signs();
    } else if (digit(c) || c == '.') {
      number();
    } else if (letter(c)) {
      name();
    } else if (c == '(') {
      open(nullptr, at_);
    } else if (c == ')' && levels_.size() > 1) {
      fail(at_, "a value is missing before ')'");
    } else {
      fail(at_, "a value is expected, not '" + character() + "'; valid: a number, a variable (" +
                    join(expression_variables(), " ") + "), pi, a function or '('");
    }
  }

  // Combines several signs in a row: t-#v in a script with a negative v gives two signs.
  void signs() {
    bool negative = false;
    for (; at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-' || blank(text_[at_])); ++at_)
      if (text_[at_] == '-') negative = !negative;
    out_.program += negative ? '-' : '+';
  }

  void number() {
    double value = 0;
    const char* const first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range) fail(at_, "the number is out of range");
    if (error != std::errc()) fail(at_, "'" + character() + "' is not a number");
    std::array<char, 32> shortest{};
    const auto written = std::to_chars(shortest.data(), shortest.data() + shortest.size(), value);
    out_.program.append(shortest.data(), written.ptr);
    at_ += static_cast<std::size_t>(end - first);
    operand_next_ = false;
  }

  void name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (letter(text_[at_]) || digit(text_[at_]))) ++at_;
    const std::string word = text_.substr(start, at_ - start), lower = lower_case(word);
    skip_blanks();
    const bool called = at_ < text_.size() && text_[at_] == '(';
    const auto& functions = expression_functions();
    const auto function =
        std::find_if(functions.begin(), functions.end(), [&](const auto& f) { return f.name == lower; });
    const auto& variables = expression_variables();
    const bool variable = std::find(variables.begin(), variables.end(), word) != variables.end();

    if (variable || lower == "pi") {
      out_.program += variable ? word : lower;
      out_.uses_variables = out_.uses_variables || variable;
      out_.uses_start = out_.uses_start || word == "x0" || word == "y0" || word == "z0";
      out_.uses_place = out_.uses_place || (word.size() == 1 && std::string_view("xyzRZDT").find(word) < 7);
      operand_next_ = false;
    } else if (function != functions.end()) {
      if (!called) fail(start, "the function '" + word + "' needs its arguments in parentheses");
      out_.program += lower;
      open(&*function, start);
    } else {
      unknown(start, word, lower, called);
    }
  }

  [[noreturn]] void unknown(std::size_t start, const std::string& word, const std::string& lower, bool called) const {
    if (lower == "rand") fail(start, "rand is not supported: a run must give the same result every time");
    if (lower == "cdfinv" || lower == "tri")
      fail(start, lower + " is not supported by Tribo; valid functions: " + function_list());
    std::vector<std::string> names;
    if (called)
      for (const auto& f : expression_functions()) names.emplace_back(f.name);
    else
      names = expression_variables(), names.emplace_back("pi");
    const std::string hint = word.size() > 1 || !called ? did_you_mean(word, names) : std::string();
    fail(start, std::string("unknown ") + (called ? "function '" : "variable '") + word + "'" + hint +
                    "; valid: " + join(names, " "));
  }

  void open(const FunctionName* function, std::size_t where) {
    if (levels_.size() > Expression::deepest)
      fail(at_, "more than " + std::to_string(Expression::deepest) + " parentheses inside each other");
    levels_.push_back({where, function, 1, {}});
    out_.program += '(';
    ++at_;
  }

  void after_operand() {
    const char c = text_[at_];
    if (c == ')')
      close();
    else if (c == ',' || c == ';')
      next_argument();
    else if (c == '?')
      levels_.back().choices.push_back(at_++), push("?");
    else if (c == ':')
      alternative();
    else
      binary();
  }

  void push(std::string_view word) {
    out_.program += word;
    operand_next_ = true;
  }

  void close() {
    if (levels_.size() == 1) fail(at_, "this ')' was never opened");
    close_choices(at_);
    const Level& level = levels_.back();
    if (level.function) count_arguments(level);
    levels_.pop_back();
    out_.program += ')';
    ++at_;
  }

  void count_arguments(const Level& level) const {
    const auto& f = *level.function;
    if (level.arguments >= f.least && (f.most == 0 || level.arguments <= f.most)) return;
    fail(level.opened, std::string(f.name) + " takes " + (f.most == 0 ? "at least " : "") +
                           counted(f.least, "argument") + ", not " + std::to_string(level.arguments));
  }

  void next_argument() {
    Level& level = levels_.back();
    if (!level.function)
      fail(at_, "'" + character() + "' separates the arguments of a function; decimals are written with '.'");
    close_choices(at_);
    ++level.arguments;
    ++at_;
    push(",");
  }

  void alternative() {
    auto& choices = levels_.back().choices;
    if (choices.empty()) fail(at_, "':' without '?'");
    choices.pop_back();
    ++at_;
    push(":");
  }

  void close_choices(std::size_t) const {
    if (!levels_.back().choices.empty()) fail(levels_.back().choices.back(), "'?' without ':'");
  }

  // The operand before this place is a variable.
  bool after_name() const {
    std::size_t end = at_;
    while (end > 0 && (text_[end - 1] == ' ' || text_[end - 1] == '\t')) --end;
    std::size_t begin = end;
    while (begin > 0 && (letter(text_[begin - 1]) || digit(text_[begin - 1]))) --begin;
    return begin < end && letter(text_[begin]);
  }

  void binary() {
    static constexpr std::array<std::string_view, 13> operators{"<=", ">=", "==", "!=", "&&", "||", "<",
                                                                ">",  "+",  "-",  "*",  "/",  "^"};
    const auto rest = std::string_view(text_).substr(at_);
    if (rest.starts_with("**")) fail(at_, "'**' is not an operator; powers are written with ^");
    for (const auto word : operators) {
      if (!rest.starts_with(word)) continue;
      at_ += word.size();
      return push(word == "^" ? "#" : word);
    }
    const char c = text_[at_];
    // 2(x+1) and (x+1)(x-1) are products, as in NairnMPM
    if (c == '(' && !after_name()) return push("*");
    if (digit(c) || letter(c) || c == '(' || c == '.')
      fail(at_, "an operator is missing before '" + character() + "' (products are written with *)");
    if (c == '=') fail(at_, "'=' is not an operator; equality is written ==");
    if (c == '%') fail(at_, "'%' is not an operator here; remainders are written mod(x,y)");
    fail(at_, "an operator is expected, not '" + character() + "'; valid: + - * / ^ < <= > >= == != && || ? : ( )");
  }

  const std::string& text_;
  const Origin& origin_;
  std::size_t at_ = 0;
  bool operand_next_ = true;
  std::vector<Level> levels_;
  CheckedText out_;
};

}  // namespace

CheckedText check_expression(const std::string& text, const Origin& origin) { return Checker(text, origin).run(); }

}  // namespace tribo
