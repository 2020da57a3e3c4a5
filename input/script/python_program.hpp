// SPDX-License-Identifier: MIT
/// A script as a Python program (`tribo convert -o model.py`).
#pragma once

#include "input/script/commands.hpp"
#include "input/script/interpreter.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tribo::script {

/// A material whose lines are being collected.
struct PythonMaterial {
  using Property = std::pair<std::string, std::string>;  ///< name and value
  std::vector<std::string> head;                         ///< id, name, type; the id alone in a stage
  std::vector<Property> properties;                      ///< in their order
  std::vector<Property> contacts;                        ///< the other material and the law
  std::vector<std::string> calls;                        ///< one for each line, for what has no shorter form
  bool shorter = true;
};

/// A body whose commands are being collected.
struct PythonRegion {
  std::size_t line = 0;  ///< of the program, where it began
  std::vector<std::string> arguments, shapes;
  bool shorter = true;
};

/// Collects the commands of a script in the order in which they run, with the values of their arguments, and writes
/// them as calls of the methods of tribo.Model. The commands must be those of a script without problems.
class PythonProgram {
 public:
  /// `name` is that of the model; without a folder and an ending.
  explicit PythonProgram(std::string name) : name_(std::move(name)) {}

  void take(const Command& c);
  /// The program. `source` is the file that it was made from.
  std::string text(const std::string& source) const;

 private:
  void add(const std::string& line);
  void call(const std::string& begin, const std::vector<std::string>& arguments, const std::string& end = {});
  void any(const Command& c, const CommandInfo& info);
  void head(const Command& c, const std::string& word);
  void lines(const Command& c, const std::string& word);
  void property(const Command& c, const std::string& word);
  void end_of_material();
  void begin_region(const Command& c);
  void corner(const Command& c);
  void shape(const Command& c, const std::string& word);
  void end_of_polygon();
  void end_of_region();

  std::string name_, title_, analysis_;
  std::vector<std::string> units_;
  bool described_ = false, solid_ = false, gravity_ = false;
  std::vector<std::string> program_;
  std::vector<std::string> ends_;     ///< commands that close the open blocks, in lower case
  std::vector<std::string> corners_;  ///< of the polygon that is not yet written
  std::optional<PythonMaterial> material_;
  std::optional<PythonRegion> region_;
};

}  // namespace tribo::script
