// SPDX-License-Identifier: MIT
/// Syntax tree of a script: commands, loops, conditions and subroutines.
#pragma once

#include "input/script/evaluate.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tribo::script {

struct Node;
using Block = std::vector<Node>;

enum class NodeKind { command, assign, choice, repeat, leave_loop, leave_loops, next_turn, call, leave_sub };

/// Type of the condition of a branch.
enum class Test { value, defined, undefined, number, text, always };

struct Branch {
  Test test = Test::value;
  Piece condition;
  Block body;
};

struct Node {
  NodeKind kind = NodeKind::command;
  Origin origin;
  std::string word;              ///< command, subroutine, or operator of an assignment (empty: plain)
  Piece target;                  ///< assign: the variable
  std::vector<Piece> arguments;  ///< arguments of a command, call or loop; the expression of an assignment
  std::vector<Branch> branches;  ///< of a condition
  Block body;                    ///< of a loop
  int cuts = 0;                  ///< number of `Cut` before a shape
  std::vector<Piece> lines;      ///< unchanged text lines of a command (Header, XMLData)
};

struct Subroutine {
  std::vector<std::string> parameters;
  Block body;
};

struct Program {
  Block body;
  std::map<std::string, Subroutine> subroutines;  ///< by name in lower case
};

/// `begin` is the place of the text. Throws InputError with all structural problems: blocks that are not closed, closed
/// twice or out of place.
Program parse(std::string_view text, const Origin& begin);

/// Names of all variables that the program assigns, without elements of arrays.
std::set<std::string> assigned_variables(const Program& program);

}  // namespace tribo::script
