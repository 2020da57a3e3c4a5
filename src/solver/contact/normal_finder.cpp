// SPDX-License-Identifier: MIT
#include "solver/contact/normal_finder.hpp"

#include "solver/contact/face_geometry.hpp"
#include "solver/contact/face_tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

using namespace face_tolerance;

// Particles at most this far behind the foremost one are examined first; at most nodes they suffice [cells].
constexpr double front_depth = 0.4;
// Particles that reach so much less far than the foremost one at a face do not shape this face: the centre of a side
// of a domain of one cell that belongs to the face lies up to 0.31 cells behind its foremost corner, and sides up to
// 0.15 cells behind the foremost one belong to the face [cells].
constexpr double face_depth = 0.5;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Unit vector along v; std::nullopt if v is zero.
template <int Dim>
std::optional<Vec<Dim>> unit(const Vec<Dim>& v) {
  const double norm = v.norm();
  if (!(norm > 0)) return std::nullopt;
  return Vec<Dim>(v / norm);
}

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> NormalFinder<Dim>::find(const ContactNode<Dim>& node, const ContactMember& a,
                                                const ContactMember& b, NearParticles<Dim>& near) const {
  collect_groups(node, near, a, b);
  return chosen_normal(node, near, a, b);
}

// Direction from a to b from the volume gradients of the two fields, which point out of them.
template <int Dim>
Vec<Dim> NormalFinder<Dim>::gradient_normal(const ContactMember& a, const ContactMember& b) const {
  const Vec<Dim> ga = Eigen::Map<const Vec<Dim>>(a.volumes->gradient);
  const Vec<Dim> gb = Eigen::Map<const Vec<Dim>>(b.volumes->gradient);
  const double bias = spec_.rigid_bias;
  const double wa = a.inverse_mass == 0.0 ? bias : 1.0, wb = b.inverse_mass == 0.0 ? bias : 1.0;
  switch (spec_.normals) {
    case NormalMethod::steepest:
      return wa * ga.norm() >= wb * gb.norm() ? ga : Vec<Dim>(-gb);
    case NormalMethod::largest:
      return wa * a.volumes->volume >= wb * b.volumes->volume ? ga : Vec<Dim>(-gb);
    case NormalMethod::own:
      return a.inverse_mass > 0 ? ga : Vec<Dim>(-gb);
    default:
      return wa * ga - wb * gb;
  }
}

// Lists the groups of both sides near the node with the boxes around them, and estimates the direction from a to b by
// the difference of the mean positions of their particles.
template <int Dim>
void NormalFinder<Dim>::collect_groups(const ContactNode<Dim>& node, NearParticles<Dim>& near, const ContactMember& a,
                                       const ContactMember& b) const {
  std::array<Vec<Dim>, 2> sum{Vec<Dim>::Zero(), Vec<Dim>::Zero()};
  std::array<double, 2> count{};
  for (auto& groups : near.groups) groups.clear();
  near.low.fill(Vec<Dim>::Constant(infinity)), near.high.fill(Vec<Dim>::Constant(-infinity));
  cloud_.each_group(node.index, [&](const ParticleGroup<Dim>& group) {
    if (group.field != a.field && group.field != b.field) return;
    const std::size_t side = group.field == a.field ? 0 : 1;
    near.groups[side].push_back(&group);
    sum[side] += group.sum, count[side] += group.end - group.begin;
    near.low[side] = near.low[side].cwiseMin(group.low), near.high[side] = near.high[side].cwiseMax(group.high);
  });
  const Vec<Dim> centre = system_.lattice.position(node.index);
  for (std::size_t side = 0; side < 2; ++side)
    near.mean[side] = count[side] > 0 ? Vec<Dim>(sum[side] / count[side] - centre) : Vec<Dim>(Vec<Dim>::Zero());
  near.direction.setZero();
  if (count[0] > 0 && count[1] > 0) near.direction = sum[1] / count[1] - sum[0] / count[0];
}

// Fills both sides with all particles within reach of the node.
template <int Dim>
void NormalFinder<Dim>::fill_sides(const Vec<Dim>& centre, NearParticles<Dim>& near) const {
  for (std::size_t side = 0; side < 2; ++side) {
    near.numbers.clear();
    for (const auto* group : near.groups[side])
      cloud_.each_point(*group, centre, [&](std::uint32_t k) { near.numbers.push_back(k); });
    near.sides[side].assign(near.numbers, cloud_.columns(), centre);
  }
}

// Adds to the foremost particles of both sides those in the band, or near enough to enter it while the face is cached,
// that reach at most `depth` less far along the normal than the face there [length]. They determine the gap if the line
// through the node along the normal misses the foremost particles.
template <int Dim>
void NormalFinder<Dim>::add_band_particles(const Vec<Dim>& centre, NearParticles<Dim>& near, const Vec<Dim>& n,
                                           double depth) const {
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = near.sides[side];
    const Vec<Dim> out = side == 0 ? n : Vec<Dim>(-n);
    const double limit = of.band_limit(out, (band + max_valid_travel) * h_);
    const bool any_in_band = of.band_limit(out, band * h_) <= band * band * h_ * h_;
    const double least_reach = any_in_band ? face_position<Dim>(of, out, band * h_) - depth : -infinity;
    near.numbers = of.numbers;
    ++near.mark;
    if (near.marks.size() < cloud_.size()) near.marks.resize(cloud_.size(), 0);
    for (const std::size_t k : of.numbers) near.marks[k] = near.mark;
    for (const auto* group : near.groups[side]) {
      if (group->reach_bound(centre, out) < least_reach) continue;
      const Vec<Dim> middle = 0.5 * (group->low + group->high) - centre;
      const double beside = (middle - middle.dot(n) * n).norm(), radius = 0.5 * (group->high - group->low).norm();
      if (beside > std::sqrt(limit) + radius) continue;  // all its particles lie outside of the band
      near.reach.resize(std::max<std::size_t>(near.reach.size(), group->end - group->begin));
      cloud_.compute_reach(*group, centre, out, near.reach.data());
      for (std::uint32_t k = group->begin; k < group->end; ++k) {
        const double reach = near.reach[k - group->begin];
        if (!(reach >= least_reach && reach > -infinity) || near.marks[k] == near.mark) continue;
        const Vec<Dim> x = cloud_.centre(k) - centre;
        if (x.squaredNorm() - x.dot(n) * x.dot(n) <= limit) near.numbers.push_back(k);
      }
    }
    of.assign(near.numbers, cloud_.columns(), centre);
  }
}

// Removes those of the particles begin to end - 1 of near.numbers and near.reach that reach less than `limit`. Returns
// the end of the remaining ones.
template <int Dim>
std::size_t NormalFinder<Dim>::remove_behind(NearParticles<Dim>& near, std::size_t begin, std::size_t end,
                                             double limit) {
  std::size_t kept = begin;
  for (std::size_t i = begin; i < end; ++i) {
    const double reach = near.reach[i];
    near.reach[kept] = reach, near.numbers[kept] = near.numbers[i];
    kept += reach >= limit && reach > -infinity ? 1 : 0;
  }
  return kept;
}

// Fills a side with the particles that reach at most `front_depth` less far along `out` than the foremost one.
template <int Dim>
void NormalFinder<Dim>::fill_foremost(const Vec<Dim>& centre, NearParticles<Dim>& near, std::size_t side,
                                      const Vec<Dim>& out) const {
  const double depth = front_depth * h_;
  Groups& groups = near.groups[side];
  double highest = -infinity;
  near.bounds.clear(), near.numbers.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    near.bounds.push_back(groups[g]->reach_bound(centre, out));
    if (near.bounds[g] <= highest) continue;
    highest = near.bounds[g];
    // The group with the largest bound comes first: its particles most likely exclude those of other groups.
    std::swap(groups[0], groups[g]), std::swap(near.bounds[0], near.bounds[g]);
  }
  double most = -infinity;
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (near.bounds[g] < most - depth) continue;
    const ParticleGroup<Dim>& group = *groups[g];
    const std::size_t end = count + group.end - group.begin;
    near.numbers.resize(std::max(near.numbers.size(), end)), near.reach.resize(near.numbers.size());
    double* reach = near.reach.data() + count;
    cloud_.compute_reach(group, centre, out, reach);
    for (std::size_t i = 0; i < end - count; ++i)
      near.numbers[count + i] = group.begin + i, most = std::max(most, reach[i]);
    count = remove_behind(near, count, end, most - depth);
  }
  near.numbers.resize(remove_behind(near, 0, count, most - depth));
  near.max_reach[side] = most;
  near.sides[side].assign(near.numbers, cloud_.columns(), centre);
}

// Whether a side that was filled by fill_foremost along `guess` contains all particles that reach beyond `limit` along
// `out`.
template <int Dim>
bool NormalFinder<Dim>::is_complete(const Vec<Dim>& centre, NearParticles<Dim>& near, std::size_t side,
                                    const Vec<Dim>& guess, const Vec<Dim>& out, double limit) const {
  const double turned = (out - guess).norm() * (cloud_.reach() + cloud_.max_extent());
  if (limit >= near.max_reach[side] - front_depth * h_ + turned) return true;
  ParticleSet<Dim>& of = near.sides[side];
  const auto before = [limit](double reach) { return reach > limit; };
  of.compute_reach(out, 1.0);
  auto more = -std::count_if(of.reach.data(), of.reach.data() + of.size(), before);
  for (const auto* group : near.groups[side]) {
    if (group->reach_bound(centre, out) <= limit) continue;
    near.reach.resize(group->end - group->begin);
    cloud_.compute_reach(*group, centre, out, near.reach.data());
    more += std::count_if(near.reach.begin(), near.reach.end(), before);
  }
  return more == 0;
}

// Fills the sides with their foremost particles along `guess`, and finds the normal of largest margin between them.
template <int Dim>
auto NormalFinder<Dim>::front_normal(const Vec<Dim>& centre, NearParticles<Dim>& near, const Vec<Dim>& guess) const
    -> FrontNormal {
  FrontNormal front;
  for (std::size_t side = 0; side < 2; ++side) {
    fill_foremost(centre, near, side, side == 0 ? guess : Vec<Dim>(-guess));
    if (near.sides[side].empty()) return front;
  }
  front.normal = margin_normal<Dim>(near.sides[0], near.sides[1], guess, h_);
  if (!front.normal) return front;
  // The particles that were left out must lie behind the centres of all foremost particles, which bound the margin, and
  // behind the faces from which the gap is measured.
  front.same_normal = front.same_gap = true;
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = near.sides[side];
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vec<Dim> out = sign * *front.normal;
    double limit = of.max_reach(out, 0.0);
    if (of.band_limit(out, band * h_) > band * band * h_ * h_)
      front.same_gap = false;  // no foremost particle lies in the band
    else
      limit = std::min(limit, face_position<Dim>(of, out, band * h_) - cached_depth * h_);
    front.same_normal = front.same_normal && is_complete(centre, near, side, sign * guess, out, limit);
  }
  front.same_gap = front.same_gap && front.same_normal;
  return front;
}

// The mean normal of the smooth faces at the node, near `n`; std::nullopt if there are none. The normals are those on
// the line through the node along the result, which is found in a few passes. Opposite the end of a face, where its
// facets lie beside the line or are not smooth, the other face alone determines the normal.
template <int Dim>
std::optional<Vec<Dim>> NormalFinder<Dim>::normal_of_smooth_faces(NearParticles<Dim>& near, const Vec<Dim>& n) const {
  constexpr double turned = 0.01;      // a smaller change of the normal displaces the line by less than 0.02 cells
  constexpr double much_nearer = 0.3;  // cells
  constexpr int passes = 3;
  std::optional<Vec<Dim>> normal;
  for (int pass = 0; pass < passes; ++pass) {
    const Vec<Dim> before = normal.value_or(n);
    std::array<std::optional<SmoothNormal<Dim>>, 2> of;
    for (std::size_t side = 0; side < 2; ++side)
      of[side] = smooth_face_normal<Dim>(near.sides[side], side == 0 ? before : Vec<Dim>(-before), band * h_, h_);
    if (of[0] && of[1] && std::abs(of[0]->beside - of[1]->beside) > much_nearer * h_)
      of[of[0]->beside > of[1]->beside ? 0 : 1].reset();
    Vec<Dim> sum = Vec<Dim>::Zero();
    if (of[0]) sum += of[0]->normal;
    if (of[1]) sum -= of[1]->normal;
    const auto mean = unit<Dim>(sum);
    if (!mean) break;
    normal = mean;
    if ((*mean - before).norm() < turned) break;
  }
  return normal;
}

// The normal of plane or smooth faces from the sides of the domains, near the normal `n` of largest margin; `n` where
// the faces are irregular. The domains of cut cells have different depths, so that the plane of largest margin between
// their shrunk domains tilts. A plane or smooth face of a rigid side alone determines the normal: the other face may be
// tilted by its deformation, and what slides along a rigid face at a tilted normal sinks into it. Else a plane face
// determines it, or two of them together, and without plane faces the smooth ones.
template <int Dim>
Vec<Dim> NormalFinder<Dim>::normal_of_faces(NearParticles<Dim>& near, const Vec<Dim>& n) const {
  constexpr double beside_end = 0.4;  // cells; beside the end of a rigid face its regression is extrapolated
  if (!has_cut_cells_) return n;
  auto& [side_a, side_b] = near.sides;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!near.rigid[side]) continue;
    const double sign = side == 0 ? 1.0 : -1.0;
    auto out = plane_normal_at_node<Dim>(near.sides[side], sign * n, band * h_, h_);
    if (!out)
      if (const auto smooth = smooth_face_normal<Dim>(near.sides[side], sign * n, band * h_, h_, true);
          smooth && smooth->beside <= beside_end * h_)
        out = smooth->normal;
    if (out) return sign * *out;
  }
  Vec<Dim> sum = Vec<Dim>::Zero();
  if (const auto out = plane_face_normal<Dim>(side_a, n, h_)) sum += *out;
  if (const auto out = plane_face_normal<Dim>(side_b, -n, h_)) sum -= *out;
  if (!sum.isZero()) return sum.normalized();
  if (const auto smooth = normal_of_smooth_faces(near, n)) return *smooth;
  if (!near.curved) return n;
  // Beside the end of a face that surrounds the other body, as a socket does, the normal of largest margin is far from
  // that of the other body's surface, which is nearly the direction from the mean place of its particles to the node.
  constexpr double not_beside = 0.75;  // cosine of 41 degrees
  for (std::size_t side = 0; side < 2; ++side)
    if (const auto guess = unit<Dim>(side == 0 ? Vec<Dim>(-near.mean[0]) : near.mean[1]))
      if (const auto smooth = normal_of_smooth_faces(near, *guess); smooth && smooth->dot(n) > not_beside)
        return *smooth;
  return n;
}

// The normal of largest margin between all particles, found from the foremost ones where they suffice. Where corners or
// edges face each other, the normal of one of the faces there. `gradient`: fallback if no plane separates the sides.
template <int Dim>
std::optional<Vec<Dim>> NormalFinder<Dim>::largest_margin(const Vec<Dim>& centre, NearParticles<Dim>& near,
                                                          const Vec<Dim>& gradient) const {
  auto& [side_a, side_b] = near.sides;
  if (near.groups[0].empty() || near.groups[1].empty()) return std::nullopt;
  near.apart = apart_beside_corner(near, least_opposite * h_);
  if (near.apart > 0.0) return std::nullopt;
  const Vec<Dim> guess = unit<Dim>(near.direction).value_or(Vec<Dim>::Unit(0));
  FrontNormal front = front_normal(centre, near, guess);
  // Where faces overhang, the first guess is poor.
  if (front.normal && !front.same_normal) front = front_normal(centre, near, *front.normal);
  if (front.same_gap && are_wide_faces<Dim>(side_a, side_b, *front.normal, h_)) {
    near.wide = true;
    return normal_of_faces(near, *front.normal);
  }
  if (front.same_normal)
    add_band_particles(centre, near, *front.normal, face_depth * h_);
  else
    fill_sides(centre, near);
  if (side_a.empty() || side_b.empty()) return std::nullopt;
  if (const auto n = front.same_normal ? front.normal : margin_normal<Dim>(side_a, side_b, guess, h_)) {
    near.wide = are_wide_faces<Dim>(side_a, side_b, *n, h_);
    if (near.wide || !are_corners<Dim>(side_a, side_b, *n, h_)) return normal_of_faces(near, *n);
    // A side of a corner may extend far behind its foremost point.
    if (front.same_normal) add_band_particles(centre, near, *n, infinity);
    const auto of_corner = corner_normal<Dim>(side_a, side_b, *n, h_);
    return of_corner == n ? normal_of_faces(near, *n) : of_corner;
  }
  if (near.curved)
    if (const auto n = normal_within_reach(centre, near, guess)) return n;
  if (auto n = regression_normal<Dim>(side_a, side_b, false, h_)) return n;
  return unit<Dim>(gradient);
}

// The normal where no plane separates the sides, since one surrounds the other, as a socket with a radius of few cells
// does: that of largest margin between the particles near the line through the node along the normal.
template <int Dim>
std::optional<Vec<Dim>> NormalFinder<Dim>::normal_within_reach(const Vec<Dim>& centre, NearParticles<Dim>& near,
                                                               const Vec<Dim>& guess) const {
  constexpr int passes = 2;
  for (const double radius : {1.5, 1.0}) {  // cells
    std::optional<Vec<Dim>> n = guess;
    for (int pass = 0; n && pass < passes; ++pass) {
      for (std::size_t side = 0; side < 2; ++side) {
        near.numbers.clear();
        for (const auto* group : near.groups[side])
          cloud_.each_point(*group, centre, [&](std::uint32_t k) {
            const Vec<Dim> x = cloud_.centre(k) - centre;
            if ((x - x.dot(*n) * *n).squaredNorm() <= radius * radius * h_ * h_) near.numbers.push_back(k);
          });
        near.sides[side].assign(near.numbers, cloud_.columns(), centre);
      }
      n = near.sides[0].empty() || near.sides[1].empty() ? std::nullopt
                                                         : margin_normal<Dim>(near.sides[0], near.sides[1], *n, h_);
    }
    if (!n) continue;
    fill_sides(centre, near);
    return normal_of_faces(near, *n);
  }
  fill_sides(centre, near);
  return std::nullopt;
}

template <int Dim>
std::optional<Vec<Dim>> NormalFinder<Dim>::chosen_normal(const ContactNode<Dim>& node, NearParticles<Dim>& near,
                                                         const ContactMember& a, const ContactMember& b) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  auto& [side_a, side_b] = near.sides;
  near.wide = false, near.apart = 0.0;
  near.rigid = {a.inverse_mass == 0.0, b.inverse_mass == 0.0};
  near.curved = system_.fields[a.field].curved || system_.fields[b.field].curved;
  const Vec<Dim> gradient = gradient_normal(a, b);
  NormalMethod method = spec_.normals;
  const bool by_gradient = method == NormalMethod::steepest || method == NormalMethod::largest ||
                           method == NormalMethod::average || method == NormalMethod::own;
  // The shape of a rigid body is known exactly, so its particle domains are better than volume gradients.
  if (by_gradient && (a.inverse_mass == 0.0 || b.inverse_mass == 0.0)) method = NormalMethod::margin;
  if (method == NormalMethod::margin) return largest_margin(centre, near, gradient);
  fill_sides(centre, near);
  switch (method) {
    case NormalMethod::specified: {
      // The direction of the model points from the deformable to the rigid field, else from the lower to the higher.
      const double sign = a.inverse_mass == 0.0 ? -1.0 : 1.0;
      return unit<Dim>(sign * spec_.direction.template head<Dim>());
    }
    case NormalMethod::steepest:
    case NormalMethod::largest:
    case NormalMethod::average:
    case NormalMethod::own:
      return unit<Dim>(gradient);
    case NormalMethod::linear:
    case NormalMethod::logistic:
      if (side_a.empty() || side_b.empty()) return unit<Dim>(gradient);
      if (auto n = regression_normal<Dim>(side_a, side_b, method == NormalMethod::logistic, h_)) return n;
      return unit<Dim>(gradient);
    case NormalMethod::margin:
      break;
  }
  return std::nullopt;
}

template class NormalFinder<2>;
template class NormalFinder<3>;

}  // namespace tribo
