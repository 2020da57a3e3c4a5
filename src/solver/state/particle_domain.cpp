// SPDX-License-Identifier: MIT
#include "solver/state/particle_domain.hpp"

namespace tribo {

template <int Dim>
DomainReader<Dim>::DomainReader(Body<Dim>& body) : uniform_(body.uniform_half_size) {
  for (std::size_t d = 0; d < Dim; ++d) {
    x_[d] = body.particles.x()[d];
    if (body.half_size) half_[d] = body.particles[body.half_size][d];
    if (body.half_axes)
      for (std::size_t k = 0; k < Dim; ++k) axes_[k * Dim + d] = body.particles[body.half_axes][k * Dim + d];
  }
  if (!body.particles.has_deformation()) return;
  for (std::size_t k = 0; k < Layout<Dim>::full; ++k) {
    const auto [row, column] = Layout<Dim>::full_at[k];
    if (row < Dim && column < Dim) F_[static_cast<std::size_t>(row * Dim + column)] = body.particles.F()[k];
  }
}

template class DomainReader<2>;
template class DomainReader<3>;

}  // namespace tribo
