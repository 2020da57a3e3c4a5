// SPDX-License-Identifier: MIT
/// The lines of a script as a tree of commands, loops, choices and subroutines, before anything runs.
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

/// How the condition of a branch is meant.
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
  std::vector<Piece> arguments;  ///< of a command, a call or a loop; the expression of an assignment
  std::vector<Branch> branches;  ///< choice
  Block body;                    ///< repeat
  int cuts = 0;                  ///< how many `Cut` before a shape
  std::vector<Piece> lines;      ///< command with text below it (Header, XMLData), as written
};

struct Subroutine {
  std::vector<std::string> parameters;
  Block body;
};

struct Program {
  Block body;
  std::map<std::string, Subroutine> subroutines;  ///< by name in lower case
};

/// `begin` is where the text begins. Throws InputError with all that is wrong with the structure: what is not closed,
/// closed twice or out of place.
Program parse(std::string_view text, const Origin& begin);

/// Names of the variables, without elements of arrays, that the program gives values to, each once.
std::set<std::string> assigned_variables(const Program& program);

}  // namespace tribo::script
