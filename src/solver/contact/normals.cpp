// SPDX-License-Identifier: MIT
/// Which way two fields face each other at a node.

#include "solver/contact/contact.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Particles this far behind the foremost are tried first; in most places the others lie behind them [cells].
constexpr double front_depth = 0.4;

}  // namespace

template <int Dim>
Vec<Dim> Contact<Dim>::gradient_normal(const ContactMember& a, const ContactMember& b) const {
  const auto outward = [&](const ContactMember& m) {
    const VolumeNode& node = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(node.gradient));
  };
  const auto volume = [&](const ContactMember& m) {
    return system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)].volume;
  };
  const Vec<Dim> ga = outward(a), gb = outward(b);
  const double bias = model_.contact.rigid_bias;
  const double wa = a.inverse_mass == 0.0 ? bias : 1.0, wb = b.inverse_mass == 0.0 ? bias : 1.0;
  switch (model_.contact.normals) {
    case NormalMethod::steepest:
      return wa * ga.norm() >= wb * gb.norm() ? ga : Vec<Dim>(-gb);
    case NormalMethod::largest:
      return wa * volume(a) >= wb * volume(b) ? ga : Vec<Dim>(-gb);
    case NormalMethod::own:
      return a.inverse_mass > 0 ? ga : Vec<Dim>(-gb);
    default:
      return wa * ga - wb * gb;
  }
}

// The particles on both sides of a pair: their groups near the node, and an estimate of the direction from a to b, from
// centre to centre.
template <int Dim>
void Contact<Dim>::look_around(const ContactNode& node, Scratch& s, const ContactMember& a,
                               const ContactMember& b) const {
  std::array<Vec<Dim>, 2> sum{Vec<Dim>::Zero(), Vec<Dim>::Zero()};
  std::array<double, 2> count{};
  for (auto& groups : s.groups) groups.clear();
  cloud_.each_group(node.index, [&](const ParticleGroup<Dim>& group) {
    if (group.field != a.field && group.field != b.field) return;
    const std::size_t side = group.field == a.field ? 0 : 1;
    s.groups[side].push_back(&group);
    sum[side] += group.sum, count[side] += group.end - group.begin;
  });
  s.towards.setZero();
  if (count[0] > 0 && count[1] > 0) s.towards = sum[1] / count[1] - sum[0] / count[0];
}

// All particles near the node.
template <int Dim>
void Contact<Dim>::fill_sides(const Vec<Dim>& centre, Scratch& s) const {
  for (std::size_t side = 0; side < 2; ++side) {
    s.numbers.clear();
    for (const auto* group : s.groups[side])
      cloud_.each_point(*group, centre, [&](std::uint32_t k) { s.numbers.push_back(k); });
    s.sides[side].take(s.numbers, cloud_.data(), centre);
  }
}

// Adds to sides of foremost particles whoever else may measure gaps at a node beside them, or is kept for that.
template <int Dim>
void Contact<Dim>::add_beside(const Vec<Dim>& centre, Scratch& s, const Vec<Dim>& n) const {
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = s.sides[side];
    const double limit = of.band_limit(n, (band + most_beside) * h_);
    s.numbers = of.which;
    const auto end = static_cast<std::ptrdiff_t>(s.numbers.size());
    for (const auto* group : s.groups[side])
      cloud_.each_point(*group, centre, [&](std::uint32_t k) {
        const Vec<Dim> x = cloud_.centre(k) - centre;
        if (x.squaredNorm() - x.dot(n) * x.dot(n) > limit) return;
        if (std::find(s.numbers.begin(), s.numbers.begin() + end, k) == s.numbers.begin() + end) s.numbers.push_back(k);
      });
    of.take(s.numbers, cloud_.data(), centre);
  }
}

// Of the particles begin to end - 1 keeps those that reach beyond `limit`, one after the other; returns where they end.
template <int Dim>
std::size_t Contact<Dim>::keep_ahead(Scratch& s, std::size_t begin, std::size_t end, double limit) {
  std::size_t kept = begin;
  for (std::size_t i = begin; i < end; ++i) {
    const double reach = s.reach[i];
    s.reach[kept] = reach, s.numbers[kept] = s.numbers[i];
    kept += reach >= limit && reach > -std::numeric_limits<double>::infinity() ? 1 : 0;
  }
  return kept;
}

// Fills a side with its particles that reach to the foremost along `out`, or nearly.
template <int Dim>
void Contact<Dim>::take_front(const Vec<Dim>& centre, Scratch& s, std::size_t side, const Vec<Dim>& out) const {
  const double depth = front_depth * h_;
  Groups& groups = s.groups[side];
  double highest = -std::numeric_limits<double>::infinity();
  s.bounds.clear(), s.numbers.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    s.bounds.push_back(groups[g]->bound(centre, out));
    if (s.bounds[g] <= highest) continue;
    highest = s.bounds[g];
    std::swap(groups[0], groups[g]), std::swap(s.bounds[0], s.bounds[g]);  // it is likely to spare others
  }
  double most = -std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (s.bounds[g] < most - depth) continue;
    const ParticleGroup<Dim>& group = *groups[g];
    const std::size_t end = count + group.end - group.begin;
    s.numbers.resize(std::max(s.numbers.size(), end)), s.reach.resize(s.numbers.size());
    double* reach = s.reach.data() + count;
    cloud_.measure(group, centre, out, reach);
    for (std::size_t i = 0; i < end - count; ++i)
      s.numbers[count + i] = group.begin + i, most = std::max(most, reach[i]);
    count = keep_ahead(s, count, end, most - depth);
  }
  s.numbers.resize(keep_ahead(s, 0, count, most - depth));
  s.most[side] = most;
  s.sides[side].take(s.numbers, cloud_.data(), centre);
}

// Whether a side holds all particles that reach beyond `limit` along `out`, though it was filled along `guess`.
template <int Dim>
bool Contact<Dim>::has_all(const Vec<Dim>& centre, Scratch& s, std::size_t side, const Vec<Dim>& guess,
                           const Vec<Dim>& out, double limit) const {
  const double turned = (out - guess).norm() * (cloud_.reach() + cloud_.largest());
  if (limit >= s.most[side] - front_depth * h_ + turned) return true;
  ParticleSet<Dim>& of = s.sides[side];
  const auto before = [limit](double reach) { return reach > limit; };
  of.measure(out, 1.0);
  auto more = -std::count_if(of.reach.data(), of.reach.data() + of.size(), before);
  for (const auto* group : s.groups[side]) {
    if (group->bound(centre, out) <= limit) continue;
    s.reach.resize(group->end - group->begin);
    cloud_.measure(*group, centre, out, s.reach.data());
    more += std::count_if(s.reach.begin(), s.reach.end(), before);
  }
  return more == 0;
}

// Fills the sides with their foremost particles along `guess`, and finds the normal of largest margin between them.
template <int Dim>
auto Contact<Dim>::margin_of_front(const Vec<Dim>& centre, Scratch& s, const Vec<Dim>& guess) const -> Front {
  Front front;
  for (std::size_t side = 0; side < 2; ++side) {
    take_front(centre, s, side, side == 0 ? guess : Vec<Dim>(-guess));
    if (s.sides[side].empty()) return front;
  }
  front.normal = margin_normal<Dim>(s.sides[0], s.sides[1], guess, h_);
  if (!front.normal) return front;
  // Whoever was left out must lie behind all that counts: the support of the margin, and the faces of gaps.
  front.same_normal = front.same_gap = true;
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = s.sides[side];
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vec<Dim> out = sign * *front.normal;
    double limit = of.farthest_reach(out, 0.0);
    if (of.band_limit(out, band * h_) > band * band * h_ * h_)
      front.same_gap = false;  // the node lies beside the face
    else
      limit = std::min(limit, face_position<Dim>(of, out, band * h_) - kept_depth * h_);
    front.same_normal = front.same_normal && has_all(centre, s, side, sign * guess, out, limit);
  }
  front.same_gap = front.same_gap && front.same_normal;
  return front;
}

template <int Dim>
std::optional<Vec<Dim>> Contact<Dim>::chosen_normal(const ContactNode& node, Scratch& s, const ContactMember& a,
                                                    const ContactMember& b) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  auto& [side_a, side_b] = s.sides;
  s.wide = false;
  const auto unit = [](const Vec<Dim>& v) -> std::optional<Vec<Dim>> {
    const double norm = v.norm();
    if (!(norm > 0)) return std::nullopt;
    return Vec<Dim>(v / norm);
  };
  const Vec<Dim> gradient = gradient_normal(a, b);
  // The faces of a rigid body are known: its geometry replaces the gradients.
  NormalMethod method = model_.contact.normals;
  const bool by_gradient = method == NormalMethod::steepest || method == NormalMethod::largest ||
                           method == NormalMethod::average || method == NormalMethod::own;
  if (by_gradient && (a.inverse_mass == 0.0 || b.inverse_mass == 0.0)) method = NormalMethod::margin;
  if (method == NormalMethod::margin) {
    const Vec<Dim> guess = unit(s.towards).value_or(Vec<Dim>::Unit(0));
    Front front = margin_of_front(centre, s, guess);
    // where faces overhang the guess is poor
    if (front.normal && !front.same_normal) front = margin_of_front(centre, s, *front.normal);
    if (front.same_gap && wide_faces<Dim>(side_a, side_b, *front.normal, h_)) return s.wide = true, front.normal;
    if (front.same_normal)
      add_beside(centre, s, *front.normal);
    else
      fill_sides(centre, s);
    if (side_a.empty() || side_b.empty()) return std::nullopt;
    if (const auto n = front.same_normal ? front.normal : margin_normal<Dim>(side_a, side_b, guess, h_)) {
      s.wide = wide_faces<Dim>(side_a, side_b, *n, h_);
      return s.wide ? n : facing_normal<Dim>(side_a, side_b, *n, h_);
    }
    if (auto n = regression_normal<Dim>(side_a, side_b, false, h_)) return n;
    return unit(gradient);
  }
  fill_sides(centre, s);
  switch (method) {
    case NormalMethod::specified: {
      // from the deformable into the rigid, else from the lower to the higher field
      const double sign = a.inverse_mass == 0.0 ? -1.0 : 1.0;
      return unit(sign * model_.contact.direction.template head<Dim>());
    }
    case NormalMethod::steepest:
    case NormalMethod::largest:
    case NormalMethod::average:
    case NormalMethod::own:
      return unit(gradient);
    case NormalMethod::linear:
    case NormalMethod::logistic:
      if (side_a.empty() || side_b.empty()) return unit(gradient);
      if (auto n = regression_normal<Dim>(side_a, side_b, method == NormalMethod::logistic, h_)) return n;
      return unit(gradient);
    case NormalMethod::margin:
      break;
  }
  return std::nullopt;
}

template void Contact<2>::look_around(const ContactNode&, Scratch&, const ContactMember&, const ContactMember&) const;
template void Contact<3>::look_around(const ContactNode&, Scratch&, const ContactMember&, const ContactMember&) const;
template std::optional<Vec<2>> Contact<2>::chosen_normal(const ContactNode&, Scratch&, const ContactMember&,
                                                         const ContactMember&) const;
template std::optional<Vec<3>> Contact<3>::chosen_normal(const ContactNode&, Scratch&, const ContactMember&,
                                                         const ContactMember&) const;

}  // namespace tribo
