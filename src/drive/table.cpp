// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "drive/drive.hpp"
#include "output/number.hpp"

#include <cmath>

namespace tribo {

std::string Table::text() const {
  std::string out = join(names, ",") + "\n";
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!std::isfinite(row[k]))
        throw SimulationError("'" + names[k] + "' is not a number in row " + std::to_string(&row - rows.data() + 1) +
                              " of the table, at " + names[0] + " " + number_text(row[0]) +
                              ": the law has no answer to this path; no table is written");
      if (k > 0) out += ',';
      out += number_text(row[k]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace tribo
