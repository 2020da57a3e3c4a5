// SPDX-License-Identifier: MIT
#include "model/bodies.hpp"

#include <algorithm>

namespace tribo {

bool Piece::curved() const {
  if (region && region->curved()) return true;
  if (!deformation) return false;
  return std::any_of(deformation->F.begin(), deformation->F.end(), [](const auto& row) {
    return std::any_of(row.begin(), row.end(), [](const auto& f) { return f && !f->is_constant(); });
  });
}

}  // namespace tribo
