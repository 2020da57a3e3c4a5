// SPDX-License-Identifier: MIT
/// Errors, and their places in the input.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A place in an input file. Line and column count from 1; 0 means unknown.
struct Origin {
  std::shared_ptr<const std::string> file;  ///< shared by all origins of one file; null: not from a file
  int line = 0;
  int column = 0;

  /// `file:line:col` without the unknown parts; empty if nothing is known.
  std::string text() const;
};

/// A problem of the input: what is wrong, and what is valid.
struct Problem {
  Origin origin;
  std::string message;
};

/// The input is invalid. `what()` has one line `file:line:col: error: message` per problem, at most a hundred. Long
/// quotations of the input are cut.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(Origin origin, std::string message);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  struct Shortened {
    std::vector<Problem> list;
  };
  explicit InputError(Shortened problems);
  std::vector<Problem> problems_;
};

/// Collects problems so that all of them are reported at once.
class Problems {
 public:
  void add(Origin origin, std::string message) { list_.push_back({std::move(origin), std::move(message)}); }
  void add(const InputError& error) { list_.insert(list_.end(), error.problems().begin(), error.problems().end()); }
  void add(const Problems& others) { list_.insert(list_.end(), others.list_.begin(), others.list_.end()); }
  /// A possible mistake that does not stop the program.
  void warn(Origin origin, std::string message) { warnings_.push_back({std::move(origin), std::move(message)}); }
  const std::vector<Problem>& warnings() const { return warnings_; }
  const std::vector<Problem>& list() const { return list_; }
  bool empty() const { return list_.empty(); }
  /// So many problems that more would not help.
  bool full() const { return list_.size() >= 1000; }
  /// Throws InputError with all problems in order of file position. Does nothing if there are none.
  void raise() const;

 private:
  std::vector<Problem> list_, warnings_;
};

/// The state of a run has become invalid, so that its results have no meaning (exit code 4).
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The same, thrown by all processes of a run together, which can therefore end the run in an orderly way.
class CommonError : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

/// The command line is invalid (exit code 2).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written (exit code 5).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate with the smallest edit distance to `word`; empty if none is similar.
std::string similar_word(std::string_view word, const std::vector<std::string>& candidates);

/// ` (did you mean 'x'?)` for the similar candidate, or else for one that is a part of `word` or begins with it; empty
/// if there is none.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// `a, b, c` for messages that list what is valid.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace tribo
