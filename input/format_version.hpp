// SPDX-License-Identifier: MIT
/// The version that a command file states: of the format, not of the program.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace tribo {

/// Three numbers, as in Semantic Versioning. What is left out is zero: `3` is 3.0.0, the format of NairnMPM.
struct FormatVersion {
  int major = 0, minor = 0, patch = 0;
  auto operator<=>(const FormatVersion&) const = default;  // NOLINT(modernize-use-nullptr): not a pointer
};

/// The newest version that this program reads. The second number rises with every release that adds keywords or
/// commands, the third with one that mends their meaning.
constexpr FormatVersion newest_format{3, 2, 0};

/// One to three whole numbers without signs and leading zeros, separated by points; nothing if the text is something
/// else.
std::optional<FormatVersion> format_version(std::string_view text);

/// `3.2`, and with the third number only if it is not zero.
std::string format_version_text(const FormatVersion& version);

/// What is wrong with a stated version, to follow the name of the place where it is stated; empty if files of this
/// version are read.
std::string problem_of_format_version(std::string_view text);

}  // namespace tribo
