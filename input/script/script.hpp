// SPDX-License-Identifier: MIT
/// Translation of scripts to statements.
#pragma once

#include "base/statement.hpp"
#include "input/settings.hpp"

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// Result of a script.
struct Script {
  Statement root;      ///< the equivalent command file, with places in the script
  std::string output;  ///< the text written by `Write` and `WriteLine`
  /// Problems of commands, each with the calls and loops through which it was reached. The commands with problems are
  /// missing in `root`.
  Problems problems = {};
  std::vector<Problem> warnings = {};
  std::vector<std::array<int, 2>> xml_lines = {};  ///< first and last lines of XML in it
};

/// The problems of a command file that a script produced, in the words of scripts: commands instead of elements, except
/// for lines of XML.
std::vector<Problem> in_words_of_scripts(std::vector<Problem> problems,
                                         const std::vector<std::array<int, 2>>& xml_lines);

/// A text about a model in the words of scripts, as above.
std::string in_words_of_scripts(const std::string& text);

/// Runs a script. Variables in `settings` keep their values. Throws InputError if the script cannot be run to its end
/// or the value of a variable is not known because its definition has an error.
Script read_script(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings);

/// A Python program that builds the model of a script with tribo.Model: the commands in the order in which they run,
/// with the values of their arguments. Throws InputError with every problem found.
std::string script_as_python(std::string_view text, const std::string& file_name, Settings settings);

/// Runs the scripts in <Commands> of an XML file and adds the resulting elements to its sections, and problems of their
/// commands to `problems`. Returns the text that they wrote. Throws as read_script.
std::string run_commands(Statement& root, Settings& settings, Problems& problems);

/// Whether a text is a script, not XML.
bool is_script(std::string_view text);

}  // namespace tribo
