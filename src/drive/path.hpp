// SPDX-License-Identifier: MIT
/// Paths along which a law is driven: rows of a table, and the standard tests of laboratories.
#pragma once

#include "base/statement.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// One row: `steps` equal steps of `dt`.
struct PathRow {
  double dt = 0.0;            ///< one step                                       [time]
  int steps = 1;              ///< how many of them
  std::vector<double> value;  ///< one per column of the table; NaN for an empty cell
  Origin origin;
};

/// Place of a row in the command file, for messages: `file:line:col: `, or nothing.
std::string place(const PathRow& row);

/// A column of a table of a path.
struct PathColumn {
  std::string_view name;
  double factor = 1.0;  ///< to consistent units
};

/// Reads comma-separated rows. The first line that is not blank names the columns, in any order: `dt`, perhaps `steps`,
/// and some of `columns`; text after # is skipped, empty cells are NaN. Lines of problems count from `origin`, where
/// the text begins. `time` is the factor of dt.
std::vector<PathRow> read_path(std::string_view text, const Origin& origin, const std::vector<PathColumn>& columns,
                               double time, Problems& problems);

}  // namespace tribo
