// SPDX-License-Identifier: MIT
#include "run/history_source.hpp"

#include <chrono>
#include <ctime>

namespace tribo {

// Force on the material: of a rigid body, of the conditions or the symmetry plane with an id, or of all but the planes.
template <int Dim>
Vec3 RunHistorySource<Dim>::reaction() const {
  const HistoryQuantity& q = quantity_;
  Vec3 sum = Vec3::Zero();
  const auto& rigid = stepper_.rigid_bodies().reactions();
  for (std::size_t r = 0; r < rigid.size(); ++r)
    if (q.material >= 0 ? system_.rigids[r].material == q.material : q.condition_id == 0) sum += rigid[r];
  if (q.material >= 0) return sum;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& conditions = stepper_.conditions(f);
    for (std::size_t c = 0; c < model_.node_conditions.size(); ++c)
      if (q.condition_id == 0 || model_.node_conditions[c].id == q.condition_id) sum += conditions.reactions()[c];
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side)
        if (q.condition_id == symmetry_plane_id(axis, side))
          sum[axis] += stepper_.exchange(f).plane_reaction(axis, side);
  }
  return sum;
}

template <int Dim>
bool RunHistorySource<Dim>::has_material(std::size_t field, int material) const {
  for (auto* list : {&system_.bodies, &system_.rigids})
    for (const auto& body : *list)
      if (body.field == field && body.material == material) return true;
  return false;
}

// Sum over the pairs that the quantity asks for; force on its material, or on the first of each pair.
template <int Dim>
ContactSums RunHistorySource<Dim>::contact() const {
  const HistoryQuantity& q = quantity_;
  ContactSums sum;
  const auto& ledger = stepper_.contact().ledger();
  for (const auto& [pair, entry] : ledger.pairs) {
    double sign = 1.0;
    if (q.material >= 0) {
      const bool first = has_material(pair.first, q.material), second = has_material(pair.second, q.material);
      if (!first && !second) continue;
      if (q.other >= 0 && !has_material(first ? pair.second : pair.first, q.other)) continue;
      sign = first && second ? 0.0 : first ? 1.0 : -1.0;  // forces between bodies of one material cancel
    }
    sum.force += sign * ledger.mean_force(entry), sum.last_force += sign * entry.force;
    sum.friction += entry.friction, sum.impact += entry.impact, sum.stored += entry.stored, sum.area += entry.area;
  }
  return sum;
}

template <int Dim>
double RunHistorySource<Dim>::processor_time() const {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <int Dim>
double RunHistorySource<Dim>::elapsed_time() const {
  using Clock = std::chrono::steady_clock;
  static const Clock::time_point first = Clock::now();
  return std::chrono::duration<double>(Clock::now() - first).count();
}

template class RunHistorySource<2>;
template class RunHistorySource<3>;

}  // namespace tribo
