// SPDX-License-Identifier: MIT
#include "solver/contact/face_solver.hpp"

#include <cmath>

namespace tribo {
namespace {

constexpr int first_sweeps = 5;  // in which all rows answer at once: those that share nodes share the pressure
constexpr int most_sweeps = 50;
constexpr double tolerance = 1e-8;  // of the impulses, relative

}  // namespace

template <int Dim>
void FaceSolver<Dim>::clear() {
  number_.resize(system_.fields.size());
  for (const Point& p : points_)
    if (static_cast<std::size_t>(p.at) < number_[p.field].size()) number_[p.field][static_cast<std::size_t>(p.at)] = -1;
  for (std::size_t f = 0; f < number_.size(); ++f) number_[f].resize(system_.fields[f].nodes.size(), -1);
  rows_.clear(), terms_.clear(), points_.clear();
}

template <int Dim>
std::size_t FaceSolver<Dim>::point(std::size_t field, std::int64_t at) {
  int& number = number_[field][static_cast<std::size_t>(at)];
  if (number < 0) {
    number = static_cast<int>(points_.size());
    points_.push_back({field, at, 1.0 / system_.fields[field].nodes[static_cast<std::size_t>(at)].mass});
  }
  return static_cast<std::size_t>(number);
}

template <int Dim>
void FaceSolver<Dim>::add(ContactPair& pair, std::span<const ContactMember> members, const Index<Dim>& index,
                          bool mirrored) {
  Row row{&pair, terms_.size(), 0};
  const ContactMember &a = members[pair.a], &b = members[pair.b];
  for (const auto* m : {&a, &b}) {
    const double sign = m == &a ? -1.0 : 1.0;
    if (m->inverse_mass == 0.0) {
      const Node& node = system_.fields[m->field].nodes[static_cast<std::size_t>(m->at)];
      row.rigid += sign * Eigen::Map<const Vec3>(node.velocity);
      continue;
    }
    terms_.push_back({point(m->field, m->at), sign});
    if (mirrored) add_image(pair, *m, index);
  }
  row.end = terms_.size();
  double alone = 0.0, among = 0.0;
  for (std::size_t t = row.first; t < row.end; ++t) {
    const double inverse_mass = points_[terms_[t].point].inverse_mass;
    among += std::abs(terms_[t].share) * inverse_mass;
    for (std::size_t u = row.first; u < row.end; ++u)  // a node may be its own image
      if (terms_[u].point == terms_[t].point) alone += terms_[t].share * terms_[u].share * inverse_mass;
  }
  row.mass_alone = 1.0 / alone, row.mass_among = 1.0 / among;
  rows_.push_back(row);
}

// Gives half of the last term's share to the node's mirror image, between the nodes there.
template <int Dim>
void FaceSolver<Dim>::add_image(const ContactPair& pair, const ContactMember& member, const Index<Dim>& index) {
  const auto& field = system_.fields[member.field];
  Index<Dim> low;
  Vec<Dim> part;
  for (int d = 0; d < Dim; ++d) {
    const auto k = static_cast<std::size_t>(d);
    double at = index[k] + 2 * pair.face * pair.state.normal[d] / field.map.lattice().spacing[d];
    if (std::abs(at - std::round(at)) < 1e-9) at = std::round(at);  // a face along the grid, whatever round-off says
    low[k] = static_cast<int>(std::floor(at));
    part[d] = at - std::floor(at);
  }
  const std::size_t first = terms_.size();
  const double half = 0.5 * terms_[first - 1].share;
  double total = 0.0;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    Index<Dim> n = low;
    double w = 1.0;
    for (int d = 0; d < Dim; ++d) {
      const int up = corner >> d & 1;
      n[static_cast<std::size_t>(d)] += up;
      w *= up != 0 ? part[d] : 1.0 - part[d];
    }
    const std::int64_t at = w > 0 ? field.map.node(n) : -1;
    if (at < 0 || !(field.nodes[static_cast<std::size_t>(at)].mass > 0)) continue;
    terms_.push_back({point(member.field, at), w});
    total += w;
  }
  if (total == 0.0) return;
  terms_[first - 1].share = half;
  for (std::size_t t = first; t < terms_.size(); ++t) terms_[t].share *= half / total;
}

template <int Dim>
template <class Value>
Vec3 FaceSolver<Dim>::sum(const Row& row, Value&& value) const {
  Vec3 out = Vec3::Zero();
  for (std::size_t t = row.first; t < row.end; ++t) out += terms_[t].share * value(points_[terms_[t].point]);
  return out;
}

// The law's answer to the velocity without the row's own impulse, if the impulse moves `mass`.
template <int Dim>
void FaceSolver<Dim>::ask(Row& row, double mass) {
  ContactPair& pair = *row.pair;
  ContactState& m = pair.state;
  m.mass = mass;
  pair.after = row.trial + sum(row, [](const Point& p) { return p.change; });
  m.velocity = pair.after + pair.impulse / mass;
  pair.response = pair.law->response(m);
  row.more = pair.response.impulse - pair.impulse;
  pair.impulse = pair.response.impulse;
}

template <int Dim>
void FaceSolver<Dim>::push(const Row& row, const Vec3& impulse) {
  for (std::size_t t = row.first; t < row.end; ++t) {
    Point& p = points_[terms_[t].point];
    p.change -= terms_[t].share * p.inverse_mass * impulse;
  }
}

// Sweeps of Jacobi's kind, then projected Gauss-Seidel, forward and backward in turn.
template <int Dim>
void FaceSolver<Dim>::solve(bool update) {
  const auto silent = [&](const Row& row) {
    return row.pair->apart || row.pair->jointed || (!update && row.pair->law->interface());
  };
  for (int sweep = 0; sweep < first_sweeps; ++sweep) {
    for (Row& row : rows_)
      if (!silent(row)) ask(row, row.mass_among);
    for (Row& row : rows_)
      if (!silent(row)) push(row, row.more);
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0.0, size = 0.0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Row& row = rows_[sweep % 2 == 0 ? k : rows_.size() - 1 - k];
      if (silent(row)) continue;
      ask(row, row.mass_alone);
      push(row, row.more);
      change += row.more.squaredNorm(), size += row.pair->impulse.squaredNorm();
    }
    if (change <= tolerance * tolerance * size) break;
  }
  for (Row& row : rows_) row.pair->after = row.trial + sum(row, [](const Point& p) { return p.change; });
}

template <int Dim>
void FaceSolver<Dim>::meet(double dt, bool update) {
  const auto node = [&](const Point& p) -> Node& {
    return system_.fields[p.field].nodes[static_cast<std::size_t>(p.at)];
  };
  for (Point& p : points_) p.change.setZero();
  for (Row& row : rows_) {
    row.trial = row.rigid + sum(row, [&](const Point& p) { return Vec3(Eigen::Map<const Vec3>(node(p).velocity)); });
    ContactState& m = row.pair->state;
    m.dt = dt;
    m.start = row.trial;
    if (update)
      m.start -= dt * sum(row, [&](const Point& p) { return Vec3(Eigen::Map<const Vec3>(node(p).acceleration)); });
    row.pair->impulse.setZero(), row.pair->response = {};
  }
  solve(update);
  for (const Point& p : points_) {
    Eigen::Map<Vec3>(node(p).velocity) += p.change;
    if (update) Eigen::Map<Vec3>(node(p).acceleration) += p.change / dt;
  }
}

template <int Dim>
void FaceSolver<Dim>::part() {
  for (const Point& p : points_)
    Eigen::Map<Vec3>(system_.fields[p.field].nodes[static_cast<std::size_t>(p.at)].velocity) -= p.change;
}

template <int Dim>
void FaceSolver<Dim>::refine(bool update) {
  const auto increment = [&](const Point& p) {
    return Eigen::Map<Vec3>(system_.fields[p.field].filter[static_cast<std::size_t>(p.at)].increment);
  };
  for (Row& row : rows_) row.trial += sum(row, [&](const Point& p) { return Vec3(increment(p)); });
  for (Point& p : points_) increment(p) -= p.change;
  solve(update);
  for (Point& p : points_) increment(p) += p.change;
}

template class FaceSolver<2>;
template class FaceSolver<3>;

}  // namespace tribo
