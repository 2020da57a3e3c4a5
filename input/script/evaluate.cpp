// SPDX-License-Identifier: MIT
#include "input/script/evaluate.hpp"

#include "base/expression.hpp"
#include "base/expression_text.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/script/text_functions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tribo::script {

bool name_begins(char c) { return c == '#' || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool in_name(char c) { return (c >= '0' && c <= '9') || c == '_' || (c != '#' && name_begins(c)); }

namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

std::string with_digits(double x, int digits) {
  if (x == 0) return "0";  // not -0
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits).ptr;
  return {buffer, end};
}

class Evaluator {
 public:
  Evaluator(const Piece& piece, const Variables& variables) : piece_(piece), variables_(variables) {}

  Value whole() {
    const Value v = joined();
    if (at_ < piece_.text.size())
      fail(at_, "unexpected '" + std::string(1, piece_.text[at_]) + "'" +
                    (piece_.text[at_] == '#' ? "; a comment begins with '!'" : ""));
    return v;
  }

  /// Name with evaluated indices.
  std::string name() {
    const std::size_t begin = at_;
    ++at_;
    while (at_ < piece_.text.size() && in_name(piece_.text[at_])) ++at_;
    if (at_ < piece_.text.size() && piece_.text[at_] == '$') ++at_;
    std::string out = piece_.text.substr(begin, at_ - begin);
    while (at_ < piece_.text.size() && piece_.text[at_] == '[') {
      ++at_;
      out += "[" + printed(joined()) + "]";
      expect(']');
    }
    return out;
  }
  std::size_t place() const { return at_; }

 private:
  static constexpr int deepest = 200;

  [[noreturn]] void fail(std::size_t at, const std::string& message) const {
    throw InputError(origin_inside(piece_.origin, piece_.text, at), message);
  }
  char next() {
    while (at_ < piece_.text.size() && blank(piece_.text[at_])) ++at_;
    return at_ < piece_.text.size() ? piece_.text[at_] : '\0';
  }
  void expect(char c) {
    if (next() != c) fail(at_, std::string("'") + c + "' is missing here");
    ++at_;
  }
  double number(const Value& v, std::size_t at) const {
    if (const double* x = std::get_if<double>(&v)) return *x;
    const auto& text = std::get<std::string>(v);
    if (const auto x = to_number(text)) return *x;
    fail(at, "'" + text + "' is text where a number is needed");
  }

  Value joined() {
    if (++depth_ > deepest) fail(at_, "more than 200 nested parentheses");
    Value left = sum();
    while (next() == '&') {
      ++at_;
      left = printed(left) + printed(sum());
    }
    --depth_;
    return left;
  }
  // Operators of equal precedence, from left to right.
  template <class Operand>
  Value chain(std::string_view operators, Operand operand) {
    const std::size_t begin = at_;
    Value left = operand();
    for (char c = next(); c != '\0' && operators.find(c) != std::string_view::npos; c = next()) {
      ++at_;
      const std::size_t right_at = at_;
      const double a = number(left, begin), b = number(operand(), right_at);
      left = c == '+'   ? a + b
             : c == '-' ? a - b
             : c == '*' ? a * b
             : c == '/' ? a / b
             : c == '%' ? std::fmod(a, b)
                        : std::pow(a, b);
    }
    return left;
  }
  Value sum() {
    return chain("+-", [&] { return product(); });
  }
  Value product() {
    return chain("*/%", [&] { return signed_value(); });
  }
  Value signed_value() {
    const char c = next();
    if (c != '-' && c != '+') return power();
    const std::size_t begin = at_++;
    if (++depth_ > deepest) fail(at_, "more than 200 signs");
    const double x = number(signed_value(), begin);
    --depth_;
    return c == '-' ? -x : x;
  }
  Value power() {
    return chain("^", [&]() -> Value {
      const char c = next();
      return c == '-' || c == '+' ? signed_value() : primary();
    });
  }

  Value primary() {
    const char c = next();
    const std::size_t begin = at_;
    if (c == '"') return quoted();
    if (c == '(') {
      ++at_;
      Value v = joined();
      expect(')');
      return v;
    }
    if (digit(c) || c == '.') {
      double x = 0;
      const char* end = piece_.text.data() + piece_.text.size();
      const auto read = std::from_chars(piece_.text.data() + at_, end, x);
      if (read.ec != std::errc()) fail(begin, "this number cannot be represented");
      at_ = static_cast<std::size_t>(read.ptr - piece_.text.data());
      return x;
    }
    if (name_begins(c)) return named();
    if (c == '@') fail(begin, "'@' refers to keypoints and objects of NairnFEAMPM, which Tribo does not have");
    if (c == '\0') fail(begin, "a value is missing here");
    fail(begin, std::string("unexpected '") + c + "' where a value is needed");
  }

  Value quoted() {
    const std::size_t begin = at_++, end = piece_.text.find('"', at_);
    if (end == std::string::npos) fail(begin, "this quote is never closed");
    std::string out = piece_.text.substr(at_, end - at_);
    at_ = end + 1;
    return out;
  }

  Value named() {
    const std::size_t begin = at_;
    const std::string word = name();
    if (const auto found = variables_.find(word); found != variables_.end()) return found->second;
    if (at_ < piece_.text.size() && piece_.text[at_] == '(') return call(word, begin);
    if (word == "pi") return M_PI;
    if (word == "return") return "\n";
    if (word == "tab") return "\t";
    if (word == "quote") return "\"";
    std::vector<std::string> known;
    if (variables_.size() < 2000)  // more are those of arrays
      for (const auto& [n, v] : variables_) known.push_back(n);
    fail(begin, "there is no variable '" + word + "'" + did_you_mean(word, known));
  }

  // Arguments are separated by commas; those of text functions by \ too.
  Value call(const std::string& word, std::size_t begin) {
    const TextFunction* function = find_text_function(word);
    expect('(');
    std::vector<Value> given;
    if (next() != ')') {
      given.push_back(joined());
      for (char c = next(); c == ',' || c == ';' || c == '\\'; c = next()) {
        ++at_;
        given.push_back(joined());
      }
      // round(x" "n): number and decimals as one text
      if (lower(word) == "round" && next() == '"') {
        const Value between = quoted();
        given.back() = printed(given.back()) + printed(between) + printed(joined());
      }
    }
    expect(')');
    if (function) {
      if (given.size() < function->least || given.size() > function->most)
        fail(begin, word + "() takes " + function->arguments);
      return function->value(given, [&](const Value& v) { return number(v, begin); });
    }
    std::string program = lower(word) + "(";
    for (std::size_t k = 0; k < given.size(); ++k) {
      const double x = number(given[k], begin);
      if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
      program += (k ? ",(" : "(") + with_digits(x, 17) + ")";
    }
    try {
      return Expression(program + ")", {})(tribo::Variables{});
    } catch (const InputError& error) {
      std::string names;
      if (!known_function(lower(word))) names = "; functions of texts: " + text_function_names();
      fail(begin, error.problems().front().message + names);
    }
  }
  static bool known_function(const std::string& word) {
    const auto& all = expression_functions();
    return std::any_of(all.begin(), all.end(), [&](const FunctionName& f) { return f.name == word; });
  }

  const Piece& piece_;
  const Variables& variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// Positions of a separator outside quotes, parentheses and brackets.
std::vector<std::size_t> places(const std::string& text, std::string_view separator) {
  std::vector<std::size_t> out;
  int open = 0;
  bool quote = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"') quote = !quote;
    if (quote) continue;
    if (c == '(' || c == '[') ++open;
    if (c == ')' || c == ']') --open;
    if (open <= 0 && text.compare(k, separator.size(), separator) == 0) out.push_back(k), k += separator.size() - 1;
  }
  return out;
}

struct Comparison {
  std::string word;
  std::size_t at = 0;
};

std::optional<Comparison> find_comparison(const std::string& text) {
  int open = 0;
  bool quote = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"') quote = !quote;
    if (quote) continue;
    if (c == '(' || c == '[') ++open;
    if (c == ')' || c == ']') --open;
    if (open > 0) continue;
    for (const char* word : {"==", "!=", ">=", "<=", "=", ">", "<"})
      if (text.compare(k, std::char_traits<char>::length(word), word) == 0) return Comparison{word, k};
    if (k > 0 && blank(text[k - 1]) && (text.compare(k, 3, "is ") == 0 || text.compare(k, 3, "is\"") == 0))
      return Comparison{"is", k};
  }
  return std::nullopt;
}

bool compare(const Value& a, const Value& b, const std::string& how) {
  const auto number = [](const Value& v) {
    return is_text(v) ? to_number(std::get<std::string>(v)) : std::optional<double>(std::get<double>(v));
  };
  const auto x = number(a), y = number(b);
  const bool as_numbers = x && y && !(is_text(a) && is_text(b));
  int order = 0;
  if (as_numbers)
    order = *x < *y ? -1 : *x > *y ? 1 : 0;
  else if (how == "==" || how == "!=")
    order = printed(a).compare(printed(b));
  else
    order = lower(printed(a)).compare(lower(printed(b)));
  if (how == "!=") return as_numbers ? order != 0 : lower(printed(a)) != lower(printed(b));
  if (how == ">") return order > 0;
  if (how == ">=") return order >= 0;
  if (how == "<") return order < 0;
  if (how == "<=") return order <= 0;
  return order == 0;
}

bool one_condition(const Piece& piece, const Variables& variables) {
  const auto found = find_comparison(piece.text);
  if (!found) return evaluate_number(piece, variables) != 0;
  const Piece left{piece.text.substr(0, found->at), piece.origin};
  const std::size_t after = found->at + found->word.size();
  const Piece right{piece.text.substr(after), origin_inside(piece.origin, piece.text, after)};
  return compare(evaluate(trimmed(left), variables), evaluate(trimmed(right), variables), found->word);
}

}  // namespace

std::string printed(const Value& v) {
  return is_text(v) ? std::get<std::string>(v) : with_digits(std::get<double>(v), 8);
}
std::string written(const Value& v) {
  return is_text(v) ? std::get<std::string>(v) : with_digits(std::get<double>(v), 15);
}

Piece trimmed(const Piece& piece) {
  std::size_t begin = 0, end = piece.text.size();
  while (begin < end && blank(piece.text[begin])) ++begin;
  while (end > begin && blank(piece.text[end - 1])) --end;
  return {piece.text.substr(begin, end - begin), origin_inside(piece.origin, piece.text, begin)};
}

std::vector<Piece> split(const Piece& piece, std::string_view separator) {
  std::vector<Piece> out;
  std::size_t begin = 0;
  const auto add = [&](std::size_t end) {
    out.push_back(trimmed({piece.text.substr(begin, end - begin), origin_inside(piece.origin, piece.text, begin)}));
    begin = end + separator.size();
  };
  for (const std::size_t at : places(piece.text, separator)) add(at);
  add(piece.text.size());
  return out;
}

Value evaluate(const Piece& piece, const Variables& variables) { return Evaluator(piece, variables).whole(); }

namespace {

double finite(double x, const Piece& piece) {
  if (std::isfinite(x)) return x;
  throw InputError(piece.origin, "'" + piece.text +
                                     "' is not a finite number: a division by 0, or a root or logarithm " +
                                     "of something negative?");
}

}  // namespace

double evaluate_number(const Piece& piece, const Variables& variables) {
  const Value v = evaluate(piece, variables);
  if (const double* x = std::get_if<double>(&v)) return finite(*x, piece);
  if (const auto x = to_number(std::get<std::string>(v))) return *x;
  throw InputError(piece.origin, "'" + std::get<std::string>(v) + "' is text where a number is needed");
}

std::string variable_name(const Piece& piece, const Variables& variables) {
  const std::size_t length = piece.text.size();
  if (length > 2 && piece.text.front() == '"' && piece.text.back() == '"')
    return variable_name({piece.text.substr(1, length - 2), origin_inside(piece.origin, piece.text, 1)}, variables);
  if (piece.text.empty() || !name_begins(piece.text[0]))
    throw InputError(piece.origin, "the name of a variable is needed here");
  Evaluator reader(piece, variables);
  std::string name = reader.name();
  if (reader.place() != piece.text.size())
    throw InputError(origin_inside(piece.origin, piece.text, reader.place()),
                     "the name of a variable ends before this character");
  return name;
}

std::string argument(const Piece& piece, const Variables& variables) {
  if (to_number(piece.text)) return piece.text;  // unchanged
  Value v;
  try {
    v = evaluate(piece, variables);
  } catch (const InputError&) {
    const bool computed = piece.text.find('#') != std::string::npos || piece.text.find('"') != std::string::npos;
    if (computed || piece.text.empty()) throw;
    return piece.text;
  }
  if (const double* x = std::get_if<double>(&v)) finite(*x, piece);
  return written(v);
}

bool condition(const Piece& piece, const Variables& variables) {
  for (const Piece& either : split(piece, "||")) {
    bool all = true;
    for (const Piece& both : split(either, "&&")) {
      if (!one_condition(both, variables)) {
        all = false;
        break;
      }
    }
    if (all) return true;
  }
  return false;
}

}  // namespace tribo::script
