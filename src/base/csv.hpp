// SPDX-License-Identifier: MIT
/// Tables of comma-separated cells, with the place of each cell in the input.
#pragma once

#include "base/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

struct CsvCell {
  std::string text;  ///< without blanks around it
  Origin origin;
};

/// A line that is not blank. Text after # is a comment.
struct CsvRow {
  std::vector<CsvCell> cells;
  Origin origin;
};

/// The rows of a text that begins at `origin`.
std::vector<CsvRow> read_csv(std::string_view text, const Origin& origin);

}  // namespace tribo
