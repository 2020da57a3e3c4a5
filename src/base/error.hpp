// SPDX-License-Identifier: MIT
/// What can go wrong, and where it was written.
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

  /// `file:line:col`, leaving out what is unknown; empty if nothing is known.
  std::string text() const;
};

/// One complaint about the input: what is wrong, and what is allowed.
struct Problem {
  Origin origin;
  std::string message;
};

/// The input cannot be honoured. `what()` has one line `file:line:col: error: message` per problem.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(Origin origin, std::string message);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Collects problems so that all of them are reported at once.
class Problems {
 public:
  void add(Origin origin, std::string message) { list_.push_back({std::move(origin), std::move(message)}); }
  void add(const InputError& error) { list_.insert(list_.end(), error.problems().begin(), error.problems().end()); }
  /// Something that may well be meant otherwise; does not stop anything.
  void warn(Origin origin, std::string message) { warnings_.push_back({std::move(origin), std::move(message)}); }
  const std::vector<Problem>& warnings() const { return warnings_; }
  bool empty() const { return list_.empty(); }
  /// Throws InputError with everything collected, in order of file position; returns if there is nothing.
  void raise() const;

 private:
  std::vector<Problem> list_, warnings_;
};

/// A run left the range in which its result means anything (exit code 4).
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command line asks for what cannot be (exit code 2).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written (exit code 5).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// ` (did you mean 'x'?)` for the candidate nearest to `word` by edit distance, or an empty string if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// `a, b, c` for messages that list what is valid.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace tribo
