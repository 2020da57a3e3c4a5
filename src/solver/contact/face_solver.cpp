// SPDX-License-Identifier: MIT
#include "solver/contact/face_solver.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <array>

namespace tribo {
namespace {

// In Jacobi sweeps the laws of all pairs read the same velocities, so that pairs that share nodes also share the
// pressure evenly. Gauss-Seidel sweeps alone would load the first ones most.
constexpr int jacobi_sweeps = 5;
constexpr int max_sweeps_from_rest = 50;  // Gauss-Seidel sweeps if no impulses of the last step are known
constexpr int max_sweeps = 10;            // if they are

}  // namespace

template <int Dim>
void FaceSolver<Dim>::set_up(ContactNodes<Dim>& contacts, const Exchanges<Dim>& exchanges) {
  constraints_.find(contacts, exchanges);
  const auto& list = constraints_.list();
  const auto& velocities = constraints_.velocities();
  rows_.resize(list.size());
  weights_.clear();
  for (std::size_t k = 0; k < list.size(); ++k) {
    const FaceConstraint<Dim>& c = list[k];
    Row& row = rows_[k];
    row.pair = c.pair, row.law = c.pair->law;
    row.size_before = c.pair->update_impulse.squaredNorm();
    row.active = c.pair->may_touch();
    row.effective_mass = c.effective_mass, row.lumped_mass = c.lumped_mass;
    row.first = static_cast<std::uint32_t>(weights_.size());
    row.next_to_plane = false;
    for (const FaceTerm& t : c.terms()) {
      const double over_mass = c.node->ownership * t.weight * velocities[t.velocity].inverse_mass;
      weights_.push_back({t.weight, over_mass, t.velocity, t.signs});
      row.next_to_plane = row.next_to_plane || !t.signs.all_one();
    }
    row.end = static_cast<std::uint32_t>(weights_.size());
  }
  changes_.resize(velocities.size());
  group_changes_.resize(constraints_.groups().size());
  find_islands();
}

template <int Dim>
void FaceSolver<Dim>::find_islands() {
  islands_.find(rows_.size(), constraints_.velocities().size(), [&](std::size_t k, auto&& unknown) {
    for (std::uint32_t t = rows_[k].first; t < rows_[k].end; ++t) unknown(weights_[t].velocity);
  });
  has_swept_rows_ = false;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    rows_[k].in_island = islands_.contain(k);
    has_swept_rows_ = has_swept_rows_ || rows_[k].is_swept();
  }
  first_coupling_.resize(islands_.count());
  std::size_t count = 0;
  for (std::size_t island = 0; island < islands_.count(); ++island) {
    const std::size_t n = islands_.rows(island).size();
    first_coupling_[island] = count, count += n * n;
  }
  couplings_.resize(count);
  each_island([&](std::size_t island) { find_couplings(island); });
}

template <int Dim>
void FaceSolver<Dim>::find_couplings(std::size_t island) {
  Vec3* coupling = &couplings_[first_coupling_[island]];
  const auto rows = islands_.rows(island);
  for (const std::uint32_t k : rows)
    for (const std::uint32_t l : rows) {
      const Row &of = rows_[k], &by = rows_[l];
      coupling->setZero();
      for (std::uint32_t t = of.first; t < of.end; ++t)
        for (std::uint32_t u = by.first; u < by.end; ++u)
          if (weights_[t].velocity == weights_[u].velocity)
            *coupling += weights_[t].weight * weights_[u].over_mass *
                         weights_[t].signs.of(weights_[u].signs.of(Vec3(Vec3::Ones())));
      ++coupling;
    }
}

template <int Dim>
template <class Value>
Vec3 FaceSolver<Dim>::weighted_sum(const Row& row, Value&& value) const {
  Vec3 out = Vec3::Zero();
  for (std::uint32_t t = row.first; t < row.end; ++t)
    out += weights_[t].weight * weights_[t].signs.of(value(weights_[t].velocity));
  return out;
}

// Calls f(number of the group) for all groups, colour by colour; those of a colour in parallel. `backward`: in reverse
// order.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_group(bool backward, F&& f) {
  const bool in_parallel = static_cast<std::ptrdiff_t>(rows_.size()) >= FaceConstraints<Dim>::serial_below;
  const auto& ends = constraints_.colour_ends();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const std::size_t colour = backward ? ends.size() - 1 - k : k;
    const std::size_t first = colour == 0 ? 0 : ends[colour - 1];
    const auto count = static_cast<std::ptrdiff_t>(ends[colour] - first);
    parallel_for(
        count, [&](std::ptrdiff_t g) { f(first + static_cast<std::size_t>(g)); }, in_parallel ? 2 : count + 1);
  }
}

// Calls f(number of the island) for all islands in parallel.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_island(F&& f) {
  parallel_for(
      static_cast<std::ptrdiff_t>(islands_.count()), [&](std::ptrdiff_t k) { f(static_cast<std::size_t>(k)); },
      FaceConstraints<Dim>::serial_below);
}

// Calls f(row) for all rows in parallel.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_row(F&& f) {
  parallel_for(
      static_cast<std::ptrdiff_t>(rows_.size()), [&](std::ptrdiff_t k) { f(rows_[static_cast<std::size_t>(k)]); },
      FaceConstraints<Dim>::serial_below);
}

// Calls f(node, change of its velocity) for all nodal velocities in parallel.
template <int Dim>
template <class F>
void FaceSolver<Dim>::each_velocity(const Changes& changes, F&& f) {
  const auto& velocities = constraints_.velocities();
  parallel_for(
      static_cast<std::ptrdiff_t>(velocities.size()),
      [&](std::ptrdiff_t k) {
        const auto number = static_cast<std::size_t>(k);
        f(velocities[number], Vec3(changes[number].template head<3>()));
      },
      FaceConstraints<Dim>::serial_below);
}

template <int Dim>
Vec3 FaceSolver<Dim>::velocity_at_face(const Row& row) const {
  Eigen::Vector4d change = Eigen::Vector4d::Zero();
  if (row.next_to_plane)
    return row.trial_velocity + weighted_sum(row, [&](std::uint32_t v) { return Vec3(changes_[v].head<3>()); });
  for (std::uint32_t t = row.first; t < row.end; ++t) change += weights_[t].weight * changes_[weights_[t].velocity];
  return row.trial_velocity + change.template head<3>();
}

// Computes the impulse of a pair by its law from its relative velocity. `mass`: impulse over the change of relative
// velocity that the law shall assume.
template <int Dim>
void FaceSolver<Dim>::update_impulse(Row& row, const Vec3& velocity, double mass) {
  row.state.mass = mass;
  row.state.velocity = velocity + row.impulse / mass;
  row.response = row.hold == Hold::nothing ? row.law->response(row.state) : response_of(*row.pair, row.state, row.hold);
  row.impulse_change = row.response.impulse - row.impulse;
  row.impulse = row.response.impulse;
}

// Applies an impulse of a pair to the nodes, with the weights and signs that their velocities have in its relative
// velocity. As the weights of one side sum to one, momentum is conserved.
template <int Dim>
void FaceSolver<Dim>::distribute(const Row& row, const Vec3& impulse) {
  const Eigen::Vector4d padded(impulse[0], impulse[1], impulse[2], 0.0);
  for (std::uint32_t t = row.first; t < row.end; ++t) {
    const Weight& w = weights_[t];
    changes_[w.velocity] -= w.over_mass * (row.next_to_plane ? w.signs.of(padded) : padded);
  }
}

// All pairs read the same velocities.
template <int Dim>
void FaceSolver<Dim>::sweep_all_at_once() {
  const auto& groups = constraints_.groups();
  each_group(false, [&](std::size_t g) {
    for (std::size_t k = groups[g].first; k < groups[g].end; ++k)
      if (rows_[k].is_swept()) update_impulse(rows_[k], velocity_at_face(rows_[k]), rows_[k].lumped_mass);
  });
  each_group(false, [&](std::size_t g) {
    for (std::size_t k = groups[g].first; k < groups[g].end; ++k)
      if (rows_[k].is_swept()) distribute(rows_[k], rows_[k].impulse_change);
  });
}

// Each pair reads the velocities after the impulses of those before it. Returns whether the impulses hardly changed.
template <int Dim>
bool FaceSolver<Dim>::sweep_one_by_one(bool backward) {
  const auto& groups = constraints_.groups();
  each_group(backward, [&](std::size_t g) {
    Change sum;
    const auto [first, end, colour] = groups[g];
    for (std::size_t k = first; k < end; ++k) {
      Row& row = rows_[backward ? end - 1 - (k - first) : k];
      if (!row.is_swept()) continue;
      update_impulse(row, velocity_at_face(row), row.effective_mass);
      distribute(row, row.impulse_change);
      sum.add(row);
    }
    group_changes_[g] = sum;
  });
  Change all;
  for (const Change& of : group_changes_) all.change += of.change, all.size += of.size;
  return all.is_small();
}

// Projected Jacobi sweeps, then projected Gauss-Seidel sweeps, forward and backward in turn, over the rows that are in
// no island.
template <int Dim>
void FaceSolver<Dim>::sweep_rows() {
  if (!has_swept_rows_) return;
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) sweep_all_at_once();
  const bool from_rest = std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.size_before == 0.0; });
  const int most = from_rest ? max_sweeps_from_rest : max_sweeps;
  for (int sweep = 0; sweep < most; ++sweep)
    if (sweep_one_by_one(sweep % 2 != 0)) break;
}

// The same sweeps over the rows of an island. Their relative velocities change with the impulses by the couplings.
template <int Dim>
void FaceSolver<Dim>::solve_island(std::size_t island) {
  std::array<Row*, RowIslands::largest> all;
  std::size_t count = 0;
  for (const std::uint32_t k : islands_.rows(island)) all[count++] = &rows_[k];
  const std::span<Row*> rows(all.data(), count);
  if (std::none_of(rows.begin(), rows.end(), [](const Row* row) { return row->active; })) return;
  std::array<Vec3, RowIslands::largest> velocities, before;
  for (std::size_t k = 0; k < count; ++k) velocities[k] = velocity_at_face(*rows[k]), before[k] = rows[k]->impulse;
  const auto apply_change = [&](std::size_t l) {
    const Vec3* coupling = &couplings_[first_coupling_[island] + l];
    for (std::size_t k = 0; k < count; ++k, coupling += count)
      velocities[k] -= coupling->cwiseProduct(rows[l]->impulse_change);
  };
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
    for (std::size_t k = 0; k < count; ++k)
      if (rows[k]->active) update_impulse(*rows[k], velocities[k], rows[k]->lumped_mass);
    for (std::size_t k = 0; k < count; ++k)
      if (rows[k]->active) apply_change(k);
  }
  const bool from_rest = std::all_of(rows.begin(), rows.end(), [](const Row* row) { return row->size_before == 0.0; });
  const int most = from_rest ? max_sweeps_from_rest : max_sweeps;
  for (int sweep = 0; sweep < most; ++sweep) {
    Change sum;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t k = sweep % 2 != 0 ? count - 1 - j : j;
      Row& row = *rows[k];
      if (!row.active) continue;
      update_impulse(row, velocities[k], row.effective_mass);
      apply_change(k);
      sum.add(row);
    }
    if (sum.is_small()) break;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (rows[k]->active) distribute(*rows[k], rows[k]->impulse - before[k]);
}

template <int Dim>
void FaceSolver<Dim>::solve(ContactPass pass) {
  each_row([&](Row& row) { row.hold = hold_of(*row.pair, pass); });
  sweep_rows();
  each_island([&](std::size_t island) { solve_island(island); });
  each_row([&](Row& row) {
    ContactPair& pair = *row.pair;
    pair.state = row.state, pair.impulse = row.impulse, pair.response = row.response;
    pair.final_velocity = velocity_at_face(row);
  });
}

// The relative velocities of a row before contact, and the impulse with which the iteration starts.
template <int Dim>
void FaceSolver<Dim>::begin_row(Row& row, double dt, ContactPass pass) {
  const auto node = [&](std::uint32_t v) -> const Node& {
    const FaceVelocity& of = constraints_.velocities()[v];
    return system_.fields[of.field].nodes[static_cast<std::size_t>(of.node)];
  };
  const ContactPair& pair = *row.pair;
  row.state = pair.state;
  row.trial_velocity = pair.rigid_velocity + weighted_sum(row, [&](std::uint32_t v) {
                         return Vec3(Eigen::Map<const Vec3>(node(v).velocity));
                       });
  row.state.dt = dt;
  row.state.start = row.trial_velocity;
  if (pass == ContactPass::corrector)
    row.state.start -=
        dt * weighted_sum(row, [&](std::uint32_t v) { return Vec3(Eigen::Map<const Vec3>(node(v).acceleration)); });
  row.response = {};
  row.impulse.setZero();
  if (pass == ContactPass::corrector && row.active) row.impulse = pair.update_impulse;
}

template <int Dim>
void FaceSolver<Dim>::apply(double dt, ContactPass pass) {
  const bool corrects = pass == ContactPass::corrector;
  const auto& groups = constraints_.groups();
  std::fill(changes_.begin(), changes_.end(), Eigen::Vector4d::Zero());
  each_row([&](Row& row) { begin_row(row, dt, pass); });
  if (corrects)  // else the iteration starts without impulses
    each_group(false, [&](std::size_t g) {
      for (std::size_t k = groups[g].first; k < groups[g].end; ++k) distribute(rows_[k], rows_[k].impulse);
    });
  solve(pass);
  if (!corrects) start_changes_ = changes_;
  each_row([&](Row& row) { (corrects ? row.pair->applied : row.pair->at_start) = row.impulse; });
  each_velocity(changes_, [&](const FaceVelocity& of, const Vec3& change) {
    Node& node = system_.fields[of.field].nodes[static_cast<std::size_t>(of.node)];
    Eigen::Map<Vec3>(node.velocity) += change;
    if (corrects) Eigen::Map<Vec3>(node.acceleration) += change / dt;
  });
}

template <int Dim>
void FaceSolver<Dim>::remove() {
  each_velocity(start_changes_, [&](const FaceVelocity& of, const Vec3& change) {
    Eigen::Map<Vec3>(system_.fields[of.field].nodes[static_cast<std::size_t>(of.node)].velocity) -= change;
  });
}

template <int Dim>
void FaceSolver<Dim>::constrain_increments(ContactPass pass) {
  const auto increment = [&](const FaceVelocity& of) {
    return Eigen::Map<Vec3>(system_.fields[of.field].filter[static_cast<std::size_t>(of.node)].increment);
  };
  each_row([&](Row& row) {
    row.trial_velocity +=
        weighted_sum(row, [&](std::uint32_t v) { return Vec3(increment(constraints_.velocities()[v])); });
  });
  each_velocity(changes_, [&](const FaceVelocity& of, const Vec3& change) { increment(of) -= change; });
  solve(pass);
  each_velocity(changes_, [&](const FaceVelocity& of, const Vec3& change) { increment(of) += change; });
}

template <int Dim>
void FaceSolver<Dim>::find_velocities(bool of_filter) {
  each_row([&](Row& row) {
    row.pair->final_velocity =
        row.pair->rigid_velocity + weighted_sum(row, [&](std::uint32_t v) {
          const FaceVelocity& of = constraints_.velocities()[v];
          const auto& field = system_.fields[of.field];
          const auto n = static_cast<std::size_t>(of.node);
          return Vec3(Eigen::Map<const Vec3>(of_filter ? field.filter[n].velocity : field.nodes[n].velocity));
        });
  });
}

template class FaceSolver<2>;
template class FaceSolver<3>;

}  // namespace tribo
