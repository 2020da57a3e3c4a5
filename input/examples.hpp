// SPDX-License-Identifier: MIT
/// Examples of the manual: passages of the complete command files in input/manual_examples. A passage stands between a
/// line `<!-- example NAMES -->` and a line `<!-- end -->`, in scripts `! example NAMES` and `! end`, and may contain
/// others. It is the example of the elements, tasks or commands that it names. The element of a name that stands for
/// several elements is written with a parent: `Stage/Gravity`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// A file of input/manual_examples as it was when the program was built.
struct ExampleFile {
  std::string_view name, text;
};
const std::vector<ExampleFile>& example_files();

/// A passage, without marks and common indentation.
struct Example {
  std::string key;  ///< a name, or `parent/name`
  std::string text;
  bool script = false;
  std::string_view file;
};
/// All passages, once for each of their names.
const std::vector<Example>& examples();
/// The passages of a text.
std::vector<Example> passages(const ExampleFile& file);

/// The text of the passage with this key, of elements and tasks or of commands; empty if there is none.
std::string example_of(std::string_view key, bool script);

/// The same material or law, given as XML element <Material>, in the form of a script.
std::string material_in_script(std::string_view xml);

/// Lines without their common indentation and without blank lines at the beginning and the end.
std::string without_indentation(std::string_view text);

}  // namespace tribo
