// SPDX-License-Identifier: MIT
#include "solver/loads/nodal_work.hpp"

#include "base/parallel.hpp"

namespace tribo {

// Block by block, so that the sum does not depend on the number of threads.
template <int Dim>
void NodalWork<Dim>::record(double dt) {
  double sum = 0.0;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& field = system_.fields[f];
    if (field.rigid_contact) continue;
    by_block_.assign(field.map.active().size(), 0.0);
    parallel_for(static_cast<std::ptrdiff_t>(by_block_.size()), [&](std::ptrdiff_t block) {
      double work = 0.0;
      for (std::int64_t n = block * block_nodes<Dim>; n < (block + 1) * block_nodes<Dim>; ++n) {
        const Node& node = field.nodes[static_cast<std::size_t>(n)];
        if (!(node.mass > 0)) continue;
        double power = 0.0;
        for (int d = 0; d < Dim; ++d)
          power += node.acceleration[d] * (node.velocity[d] - 0.5 * dt * node.acceleration[d]);
        work += exchanges_[f]->ownership(n) * node.mass * power;
      }
      by_block_[static_cast<std::size_t>(block)] = work;
    });
    for (const double work : by_block_) sum += work;
  }
  ledger_.nodal_work += dt * sum;
}

template class NodalWork<2>;
template class NodalWork<3>;

}  // namespace tribo
