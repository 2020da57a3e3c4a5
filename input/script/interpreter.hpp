// SPDX-License-Identifier: MIT
/// Runs a script: variables, conditions, loops and subroutines. Every other command is passed to a receiver.
#pragma once

#include "input/script/program.hpp"

#include <functional>
#include <set>

namespace tribo::script {

/// A command with evaluated arguments.
struct Command {
  const Node& node;
  const Variables& variables;

  std::size_t size() const { return node.arguments.size(); }
  const Origin& origin() const { return node.origin; }
  /// Place of an argument, or of the command if there is no such argument.
  const Origin& origin(std::size_t k) const { return k < size() ? node.arguments[k].origin : node.origin; }
  bool given(std::size_t k) const { return k < size() && !node.arguments[k].text.empty(); }
  /// An argument as text; empty if there is none.
  std::string text(std::size_t k) const { return given(k) ? argument(node.arguments[k], variables) : std::string(); }
  /// An argument as a number; throws InputError if it is not a number.
  double number(std::size_t k) const { return evaluate_number(node.arguments.at(k), variables); }
};

class Interpreter {
 public:
  using Receiver = std::function<void(const Command&)>;

  Interpreter(const Program& program, Receiver receiver) : program_(program), receiver_(std::move(receiver)) {}

  /// Sets a variable to a value that replaces its first assignment in the script.
  void fix(const std::string& name, Value value);
  /// Called with the name of a variable before it is assigned, and the node that assigns it. May throw InputError.
  std::function<void(const std::string&, const Node&)> before_assignment;
  /// Runs to the end. Throws InputError with every problem found, or with the message of `Stop`.
  void run();
  /// Whether the script ran to its end: no `Stop`, and no limit on commands or problems was reached.
  bool ran_to_end() const { return ran_to_end_; }
  /// Whether the definition of a variable had an error, so that its value is not known.
  bool values_lost() const { return values_lost_; }
  /// The text written by `Write` and `WriteLine`.
  const std::string& output() const { return output_; }

 private:
  enum class Flow { on, next_turn, leave_loop, leave_loops, leave_sub };

  Flow block(const Block& body);
  Flow node(const Node& n);
  Flow choice(const Node& n);
  Flow repeat(const Node& n);
  void call(const Node& n);
  void assign(const Node& n);
  Value value_of(const Node& n, const std::string& name) const;
  bool uses_lost(const Piece& piece) const;
  bool uses_lost(const Node& n) const;
  bool holds(const Branch& branch) const;
  void command(const Node& n);
  void pieces_of_text(const Node& n, bool words);
  std::string joined(const Node& n) const;
  void count(const Origin& origin);
  void report(const InputError& error);

  const Program& program_;
  Receiver receiver_;
  Variables variables_;
  std::set<std::string> fixed_;
  /// Variables whose definition has an error, or uses such a variable. They have some value, so that their use is no
  /// further error; errors of commands with them may be consequences and are not reported.
  std::set<std::string> lost_;
  std::string output_;
  std::vector<std::string> stack_;  ///< calls and loops around the current command, outermost first
  std::set<std::string> known_;     ///< problems that were already reported, since loops repeat them
  std::vector<Problem> problems_;
  bool ran_to_end_ = false, values_lost_ = false;
  long commands_ = 0, complaints_ = 0;
  int loops_ = 0;  ///< nested loops in the current subroutine
};

}  // namespace tribo::script
