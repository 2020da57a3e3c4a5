// SPDX-License-Identifier: MIT
#include "input/script/interpreter.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::script {
namespace {

constexpr long most_commands = 500'000;
constexpr long most_complaints = 2'000;  // limit of problems, since loops repeat them
constexpr std::size_t deepest_calls = 100, most_problems = 50;
constexpr std::size_t longest_text = 10'000, most_written = 1'000'000;  // characters

// Thrown by `Stop`; problems found before are reported first.
struct Stopped {};

}  // namespace

void Interpreter::fix(const std::string& name, Value value) {
  variables_[name] = std::move(value);
  fixed_.insert(name);
}

void Interpreter::run() {
  try {
    block(program_.body);
    ran_to_end_ = true;
  } catch (const Stopped&) {
  }
  if (!problems_.empty()) throw InputError(std::move(problems_));
}

void Interpreter::report(const InputError& error) {
  std::string from;
  for (auto step = stack_.rbegin(); step != stack_.rend(); ++step) from += "; " + *step;
  for (const Problem& p : error.problems()) {
    if (!known_.insert(p.origin.text() + p.message).second) continue;
    problems_.push_back({p.origin, p.message + from});
  }
  if (problems_.size() >= most_problems || ++complaints_ >= most_complaints) throw Stopped{};
}

void Interpreter::count(const Origin& origin) {
  if (++commands_ <= most_commands) return;
  report({origin, "the script has run half a million commands: a loop that does not end?"});
  throw Stopped{};
}

Interpreter::Flow Interpreter::block(const Block& body) {
  for (const Node& n : body) {
    const Flow flow = node(n);
    if (flow != Flow::on) return flow;
  }
  return Flow::on;
}

Interpreter::Flow Interpreter::node(const Node& n) {
  count(n.origin);
  const bool unsure = uses_lost(n);
  try {
    switch (n.kind) {
      case NodeKind::command:
        command(n);
        break;
      case NodeKind::assign:
        assign(n);
        break;
      case NodeKind::choice:
        return choice(n);
      case NodeKind::repeat:
        return repeat(n);
      case NodeKind::call:
        call(n);
        break;
      case NodeKind::leave_loop:
        return Flow::leave_loop;
      case NodeKind::leave_loops:
        return Flow::leave_loops;
      case NodeKind::next_turn:
        return Flow::next_turn;
      case NodeKind::leave_sub:
        return Flow::leave_sub;
    }
  } catch (const InputError& error) {
    if (!unsure) report(error);
  }
  return Flow::on;
}

bool Interpreter::uses_lost(const Piece& piece) const {
  return std::any_of(lost_.begin(), lost_.end(), [&](const std::string& name) {
    for (auto at = piece.text.find(name); at != std::string::npos; at = piece.text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      const bool begins = name.front() == '#' || at == 0 || !in_name(piece.text[at - 1]);
      if (begins && (end == piece.text.size() || !in_name(piece.text[end]))) return true;
    }
    return false;
  });
}

bool Interpreter::uses_lost(const Node& n) const {
  const auto lost = [&](const Piece& piece) { return uses_lost(piece); };
  return (!n.word.empty() && lost(n.target)) || std::any_of(n.arguments.begin(), n.arguments.end(), lost) ||
         std::any_of(n.branches.begin(), n.branches.end(), [&](const Branch& b) { return lost(b.condition); });
}

// The value that an assignment gives to a variable.
Value Interpreter::value_of(const Node& n, const std::string& name) const {
  Piece value = n.arguments.front();
  if (value.text.empty()) throw InputError(value.origin, "a value is missing here");
  Value v = evaluate(value, variables_);
  if (!n.word.empty()) {
    const auto old = variables_.find(name);
    if (old == variables_.end()) throw InputError(n.target.origin, "there is no variable '" + name + "' to change");
    const Variables two{{"#old", old->second}, {"#new", v}};
    v = evaluate({"#old" + n.word + "#new", n.origin}, two);
  }
  if (is_text(v) && std::get<std::string>(v).size() > longest_text)
    throw InputError(value.origin, "this text is longer than ten thousand characters");
  return v;
}

void Interpreter::assign(const Node& n) {
  const std::string name = variable_name(n.target, variables_);
  if (before_assignment) before_assignment(name, n);
  const bool lost = uses_lost(n);
  Value v;
  try {
    v = value_of(n, name);
  } catch (const InputError&) {
    lost_.insert(name), values_lost_ = true;
    variables_.try_emplace(name, 1.0);
    throw;
  }
  if (fixed_.erase(name) > 0) return;
  if (lost)
    lost_.insert(name);
  else
    lost_.erase(name);
  variables_[name] = std::move(v);
}

bool Interpreter::holds(const Branch& branch) const {
  const auto defined = [&] { return variables_.count(variable_name(branch.condition, variables_)) > 0; };
  switch (branch.test) {
    case Test::always:
      return true;
    case Test::defined:
      return defined();
    case Test::undefined:
      return !defined();
    case Test::value:
    case Test::number:
    case Test::text:
      return condition(branch.condition, variables_);
  }
  return false;
}

Interpreter::Flow Interpreter::choice(const Node& n) {
  for (const Branch& branch : n.branches)
    if (holds(branch)) return block(branch.body);
  return Flow::on;
}

Interpreter::Flow Interpreter::repeat(const Node& n) {
  const bool counted = !n.arguments.empty();
  const std::string name = counted ? variable_name(n.arguments[0], variables_) : "";
  const double first = counted ? evaluate_number(n.arguments[1], variables_) : 0.0;
  const double last = counted ? evaluate_number(n.arguments[2], variables_) : 0.0;
  const double step = n.arguments.size() > 3 ? evaluate_number(n.arguments[3], variables_) : 1.0;
  if (counted && uses_lost(n)) lost_.insert(name);
  if (counted && (!(std::abs(step) > 0) || !std::isfinite(step)))
    throw InputError(n.arguments.back().origin, "the step of a loop must not be 0");
  for (long turn = 0;; ++turn) {
    const double value = first + static_cast<double>(turn) * step;
    // tolerance: the last value may be missed by round-off
    if (counted && !((step > 0 ? value - last : last - value) <= 1e-10 * std::abs(step))) return Flow::on;
    if (counted) variables_[name] = value;
    count(n.origin);
    stack_.push_back(counted ? "with " + name + " = " + printed(value) : "in iteration " + std::to_string(turn + 1));
    ++loops_;
    const Flow flow = block(n.body);
    --loops_;
    stack_.pop_back();
    if (flow == Flow::leave_loop || (flow == Flow::leave_loops && loops_ == 0)) return Flow::on;
    if (flow == Flow::leave_loops || flow == Flow::leave_sub) return flow;
  }
}

void Interpreter::call(const Node& n) {
  const auto found = program_.subroutines.find(lower(n.word));
  if (found == program_.subroutines.end()) {
    std::vector<std::string> known;
    for (const auto& [name, sub] : program_.subroutines) known.push_back(name);
    throw InputError(n.origin, "there is no subroutine '" + n.word + "'" + did_you_mean(lower(n.word), known));
  }
  const Subroutine& sub = found->second;
  if (n.arguments.size() > sub.parameters.size())
    throw InputError(n.origin, "subroutine '" + n.word + "' takes " + std::to_string(sub.parameters.size()) +
                                   " arguments, not " + std::to_string(n.arguments.size()));
  if (stack_.size() >= deepest_calls) throw InputError(n.origin, "more than 100 nested calls and loops");
  std::vector<Value> values;
  for (const Piece& a : n.arguments) values.push_back(evaluate(a, variables_));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (uses_lost(n.arguments[k])) lost_.insert(sub.parameters[k]);
    variables_[sub.parameters[k]] = values[k];
  }
  stack_.push_back("called from " + n.origin.text());
  const int outside = std::exchange(loops_, 0);
  block(sub.body);
  loops_ = outside;
  stack_.pop_back();
}

std::string Interpreter::joined(const Node& n) const {
  std::string out;
  for (const Piece& p : n.arguments) out += argument(p, variables_);
  return out;
}

// Lines and Words: store the parts of a text in the elements of an array.
void Interpreter::pieces_of_text(const Node& n, bool words) {
  if (n.arguments.size() < 4 || n.arguments.size() > (words ? 5U : 4U))
    throw InputError(n.origin, "'" + n.word + "' takes a variable, the first and last index and a text");
  const std::string name = variable_name(n.arguments[0], variables_);
  const double first = evaluate_number(n.arguments[1], variables_), last = evaluate_number(n.arguments[2], variables_);
  const std::string text = printed(evaluate(n.arguments[3], variables_));
  const std::string split_at =
      words ? n.arguments.size() > 4 ? printed(evaluate(n.arguments[4], variables_)) : " \t\r\n" : "\n";
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const auto end = std::min(text.find_first_of(split_at, begin), text.size());
    if (end > begin || !words) parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  for (std::size_t k = 0; k < parts.size() && first + static_cast<double>(k) <= last; ++k)
    variables_[name + "[" + printed(first + static_cast<double>(k)) + "]"] = parts[k];
}

void Interpreter::command(const Node& n) {
  const std::string word = lower(n.word);
  if (word == "write" || word == "writeline") {
    output_ += joined(n) + (word == "writeline" ? "\n" : "");
    if (output_.size() > most_written) throw InputError(n.origin, "more than a million characters written");
  } else if (word == "clear") {
    output_.clear();
  } else if (word == "stop") {
    const std::string message = joined(n);
    if (lost_.empty()) report({n.origin, message.empty() ? "the script stops here" : message});
    throw Stopped{};
  } else if (word == "lines" || word == "words") {
    pieces_of_text(n, word == "words");
  } else {
    receiver_({n, variables_});
  }
}

}  // namespace tribo::script
