// SPDX-License-Identifier: MIT
#include "drive/drive.hpp"
#include "output/number.hpp"

namespace tribo {

std::string Table::text() const {
  std::string out = join(names, ",") + "\n";
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0) out += ',';
      out += number_text(row[k]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace tribo
