// SPDX-License-Identifier: MIT
/// What Tribo knows of the dialect of NairnMPM: every name of the dialect looked up in the tables of the reader.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// Names of one kind, separated by blanks.
struct DialectNames {
  enum class Kind { element, attribute, command, property, type, task, parameter, quantity, field } kind;
  std::string_view inside;  ///< the element, or for parameters the task; empty for other kinds
  std::string_view names;
};

/// All names of the dialect, and its quantities that consist of several words (dialect/nairnmpm_names.cpp).
const std::vector<DialectNames>& nairnmpm_names();
const std::vector<std::string>& nairnmpm_quantities_of_words();

/// A name of the dialect and what the reader does with it.
struct Coverage {
  enum class State { known, refused, unknown } state;
  DialectNames::Kind kind;
  std::string inside, name;
  std::string reason;  ///< of a refusal
};

std::vector<Coverage> coverage();
/// The coverage as a page in Markdown.
std::string coverage_markdown();

}  // namespace tribo
