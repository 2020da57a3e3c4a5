// SPDX-License-Identifier: MIT
#include "solver/transfer/material_points.hpp"

namespace tribo {

template <int Dim>
MaterialPoints<Dim> points_of(Body<Dim>& body, std::uint32_t first, int count, HistoryPointers& history) {
  MaterialPoints<Dim> points;
  points.count = count;
  const auto F = body.particles.F();
  const auto stress = body.particles.stress();
  for (std::size_t k = 0; k < F.size(); ++k) points.F[k] = F[k] ? F[k] + first : nullptr;
  for (std::size_t k = 0; k < stress.size(); ++k) points.stress[k] = stress[k] + first;
  points.mass = body.particles.mass() + first;
  points.volume = body.particles.volume() + first;
  for (std::size_t k = 0; k < body.history_columns.size(); ++k) history[k] = body.history_columns[k] + first;
  points.history = {history.data(), body.history_columns.size()};
  if (body.temperature) points.temperature = body.particles[body.temperature] + first;
  points.reference_temperature = body.reference_temperature;
  points.cell = body.cell;
  return points;
}

template <int Dim>
double stored_energy(Body<Dim>& body, std::size_t particle) {
  HistoryPointers history{};
  return body.law->stored_energy(points_of(body, static_cast<std::uint32_t>(particle), 1, history));
}

template <int Dim>
double dissipated_energy(Body<Dim>& body, std::size_t particle) {
  const int k = body.law->dissipation_index();
  if (k < 0) return 0.0;
  return body.history_columns[static_cast<std::size_t>(k)][particle] * body.particles.mass()[particle] /
         body.law->density();
}

template MaterialPoints<2> points_of<2>(Body<2>&, std::uint32_t, int, HistoryPointers&);
template double stored_energy<2>(Body<2>&, std::size_t);
template double dissipated_energy<2>(Body<2>&, std::size_t);
template MaterialPoints<3> points_of<3>(Body<3>&, std::uint32_t, int, HistoryPointers&);
template double stored_energy<3>(Body<3>&, std::size_t);
template double dissipated_energy<3>(Body<3>&, std::size_t);

}  // namespace tribo
