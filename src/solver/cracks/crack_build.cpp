// SPDX-License-Identifier: MIT
/// Construction of cracks: which parts lie within bodies, and the extension of a crack beyond the surface of a body.

#include "solver/cracks/crack_build.hpp"

#include "base/text.hpp"
#include "contact/interface_joint.hpp"
#include "solver/cracks/line_points.hpp"
#include "solver/cracks/particle_edges.hpp"
#include "solver/neighbours/body_occupancy.hpp"
#include "solver/state/limited_interface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace tribo {
namespace {

/// An integration point of a piece: its barycentric coordinates, and the fraction of the area of the piece that it
/// represents.
template <std::size_t count>
using PieceSample = std::pair<std::array<double, count>, double>;

/// Integration points on the part of a piece that lies within bodies.
std::vector<PieceSample<2>> samples(const std::array<Vec<2>, 2>& corners, const BodyOccupancy<2>& occupancy) {
  const auto inside = [&](double t) { return occupancy.contains((1 - t) * corners[0] + t * corners[1]); };
  constexpr int steps = 16;
  int first = 0, last = steps - 1;
  const auto middle = [](int k) { return (k + 0.5) / steps; };
  while (first < steps && !inside(middle(first))) ++first;
  while (last > first && !inside(middle(last))) --last;
  if (first == steps) return {};
  const auto edge = [&](double in, double out) {
    if (inside(out)) return out;
    for (int k = 0; k < 30; ++k) (inside(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
    return in;
  };
  const double begin = edge(middle(first), first == 0 ? 0.0 : middle(first - 1)),
               end = edge(middle(last), last == steps - 1 ? 1.0 : middle(last + 1));
  std::vector<PieceSample<2>> out;
  for (const double gauss : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
    const double t = begin + gauss * (end - begin);
    out.push_back({{1 - t, t}, 0.5 * (end - begin)});
  }
  return out;
}
std::vector<PieceSample<3>> samples(const std::array<Vec3, 3>& corners, const BodyOccupancy<3>& occupancy) {
  int inside = 0, all = 0;
  constexpr int steps = 5;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * (steps - i) - 1; ++j, ++all) {
      // centroids of small triangles, every second one inverted
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const int column = j / 2;
      const double u = (i + third) / steps, v = (column + third) / steps;
      inside += occupancy.contains(corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]));
    }
  if (inside == 0) return {};
  return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, static_cast<double>(inside) / all}};
}

/// Adds the joints along the last crack of the system.
template <int Dim>
void add_joint(const Model& model, const CrackSpec& spec, const JointLaw& law, const BodyOccupancy<Dim>& occupancy,
               System<Dim>& system) {
  const Crack<Dim>& crack = system.cracks.back();
  JointSurface<Dim> surface;
  surface.law = &law, surface.crack = system.cracks.size() - 1;
  std::vector<double> areas(crack.x.size(), 0.0);
  for (std::size_t p = 0; p < crack.pieces.size(); ++p) {
    const auto corners = crack.corners(p);
    for (const auto& [share, fraction] : samples(corners, occupancy)) {
      double area = fraction * Crack<Dim>::area(corners).norm();
      JointSample<Dim> sample;
      sample.point = crack.pieces[p], sample.weight = share;
      if (model.analysis == Analysis::axisymmetric)
        area *= share[0] * corners[0][0] + share[1] * corners[1][0];
      else if (Dim == 2)
        area *= model.grid.thickness;
      for (std::size_t k = 0; k < share.size(); ++k)
        sample.area_fraction[k] = share[k] * area, areas[sample.point[k]] += sample.area_fraction[k];
      surface.samples.push_back(sample);
    }
  }
  if (surface.samples.empty())
    throw InputError(spec.origin, "this crack has a joint law but does not run through any body");
  const auto points =
      static_cast<std::size_t>(std::count_if(areas.begin(), areas.end(), [](double a) { return a > 0; }));
  if (const std::size_t given = law.user_areas().size(); given > 1 && given != points)
    throw InputError(spec.origin, "<user_area> of the joint law has " + std::to_string(given) +
                                      " areas, but the crack has " + counted(points, "point") + " in bodies");
  const auto normals = crack.normals();
  std::vector<std::uint32_t> joint_of(crack.x.size(), 0);
  for (std::size_t k = 0; k < crack.x.size(); ++k) {
    if (!(areas[k] > 0)) continue;
    JointSite site;
    site.area = areas[k], site.plane = Dim == 2, site.thickness = model.grid.thickness;
    site.number = surface.joints.size();
    Vec3 normal = Vec3::Zero();
    normal.template head<Dim>() = normals[k];
    joint_of[k] = static_cast<std::uint32_t>(surface.joints.size());
    surface.point.push_back(k);
    surface.x.push_back(crack.x[k]);
    surface.axes.push_back(JointAxes::of_normal(normal));
    Vec3 at = Vec3::Zero();
    at.template head<Dim>() = crack.x[k];
    site.pressure = law.pore_pressure(at, system.time);
    surface.joints.push_back(surface.law->start(site));
  }
  for (auto& sample : surface.samples)
    for (std::size_t k = 0; k < sample.point.size(); ++k)
      sample.joint[k] = joint_of[sample.point[k]], sample.area_fraction[k] /= areas[sample.point[k]];
  surface.mass.fill(std::vector<double>(surface.samples.size(), 0.0));
  system.joints.push_back(std::move(surface));
}

/// A line that shares an end with exactly one other line is part of the surface of that line.
struct CommonEnds {
  std::vector<std::uint32_t> surface;           ///< per crack
  std::vector<std::array<bool, 2>> has_common;  ///< per crack and end

  CommonEnds(const std::vector<CrackSpec>& cracks, bool lines, double cell)
      : surface(cracks.size()), has_common(cracks.size(), {false, false}) {
    std::iota(surface.begin(), surface.end(), 0U);
    if (!lines) return;
    const auto end_of = [&](std::size_t end) -> const Vec3& {
      const auto& points = cracks[end / 2].points;
      return end % 2 == 0 ? points.front() : points.back();
    };
    const auto is_tip = [&](std::size_t end) { return cracks[end / 2].ends[end % 2] == CrackSpec::End::tip; };
    for (std::size_t a = 0; a < 2 * cracks.size(); ++a) {
      std::size_t partner = a, count = 0;
      for (std::size_t b = 0; b < 2 * cracks.size(); ++b)
        if (b != a && (end_of(a) - end_of(b)).norm() < 1e-6 * cell) partner = b, ++count;
      if (count != 1 || partner / 2 == a / 2 || is_tip(a) || is_tip(partner)) continue;
      has_common[a / 2][a % 2] = true;
      const auto [low, high] = std::minmax(surface[a / 2], surface[partner / 2]);
      std::replace(surface.begin(), surface.end(), std::uint32_t{high}, std::uint32_t{low});
    }
  }
};

/// Treats the ends of a line that are `common` with no other line. An end within a body is a tip. Beyond an end outside
/// of the bodies, the crack is extended over the width of a stencil; otherwise nodes beyond the surface would couple
/// its two sides.
void find_ends(Crack<2>& crack, const CrackSpec& spec, const std::array<bool, 2>& common,
               const BodyOccupancy<2>& occupancy, double cell, int cells) {
  using End = CrackSpec::End;
  if ((crack.x.front() - crack.x[crack.main_points - 1]).norm() < 1e-9 * cell) return;  // a closed line
  for (const int end : {0, 1}) {
    if (common[static_cast<std::size_t>(end)]) continue;
    const auto& piece = crack.pieces[end == 0 ? 0 : crack.main_pieces - 1];
    CrackTip tip;
    tip.end = end;
    tip.point = piece[end == 0 ? 0 : 1], tip.previous = piece[end == 0 ? 1 : 0];
    const End requested = spec.ends[static_cast<std::size_t>(end)];
    const Vec<2> x = crack.x[tip.point], ahead = cell * crack.direction_at(tip, tip_length * cell);
    constexpr int probes = 8;  // per cell
    int outside = 0;
    while (outside < probes * cells && !occupancy.contains(x + (outside + 0.5) / probes * ahead)) ++outside;
    if (outside == 0 && !occupancy.is_mirrored(x + 1e-6 * ahead) &&
        (requested == End::found || requested == End::tip)) {
      tip.initial_direction = ahead / cell;
      crack.tips.push_back(tip);
    } else if (requested == End::tip) {
      throw InputError(spec.origin, std::string("this crack's ") + (end == 0 ? "first" : "last") +
                                        " point is said to be a tip but lies in no body");
    } else {
      extend_straight(crack, tip, cell, requested == End::exterior ? cells : outside / probes);
    }
  }
}
void find_ends(Crack<3>&, const CrackSpec&, const std::array<bool, 2>&, const BodyOccupancy<3>&, double, int) {}

/// Sorts the pieces of a surface along Morton's curve through their centres, so that pieces which follow each other are
/// near each other, as the search among them assumes. Those of a line are in its order.
void sort_pieces(Crack<3>& crack) {
  const auto centre = [&](const Crack<3>::Piece& piece) {
    return Vec3((crack.x[piece[0]] + crack.x[piece[1]] + crack.x[piece[2]]) / 3);
  };
  Vec3 low = crack.x.front(), high = low;
  for (const Vec3& x : crack.x) low = low.cwiseMin(x), high = high.cwiseMax(x);
  constexpr int bits = 20;  // per axis
  const double unit = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min()) / ((1 << bits) - 1);
  std::vector<std::pair<std::uint64_t, Crack<3>::Piece>> places;
  for (const auto& piece : crack.pieces) {
    const Vec3 at = (centre(piece) - low) / unit;
    std::uint64_t code = 0;
    for (int bit = 0; bit < bits; ++bit)
      for (int d = 0; d < 3; ++d) code |= (static_cast<std::uint64_t>(at[d]) >> bit & 1) << (3 * bit + d);
    places.emplace_back(code, piece);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t p = 0; p < places.size(); ++p) crack.pieces[p] = places[p].second;
}
void sort_pieces(Crack<2>&) {}

/// Occupancy of the region around all cracks of the model.
template <int Dim>
BodyOccupancy<Dim> around_cracks(const Model& model, System<Dim>& system) {
  Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const CrackSpec& crack : model.cracks)
    for (const Vec3& x : crack.points)
      low = low.cwiseMin(x.template head<Dim>()), high = high.cwiseMax(x.template head<Dim>());
  const Vec<Dim> reach = 8 * system.lattice.spacing;
  return BodyOccupancy<Dim>(model, system, low - reach, high + reach);
}

/// The imperfect interface between the faces of a crack; null if its contact law is none.
template <int Dim>
std::shared_ptr<const InterfaceLaw> imperfect_interface(const Model& model, const System<Dim>& system,
                                                        const CrackSpec& spec) {
  if (!spec.law || !spec.law->interface()) return nullptr;
  std::vector<int> materials;
  for (const auto& body : system.bodies) materials.push_back(body.material);
  return limited_interface(model, system.lattice, *spec.law->interface(), materials);
}

/// The displacements that put surfaces of cracks with joints onto edges of particles, per crack. Surfaces that other
/// cracks approach stay where they are. `surface`: per crack, as in CommonEnds.
template <int Dim>
std::vector<Vec<Dim>> shifts_to_edges(const Model& model, System<Dim>& system,
                                      const std::vector<std::uint32_t>& surface) {
  const auto has_joint = [](const CrackSpec& crack) { return crack.joint || (crack.law && crack.law->interface()); };
  const double near = system.lattice.spacing.maxCoeff();
  std::vector<Vec<Dim>> shifts(model.cracks.size(), Vec<Dim>::Zero());
  for (std::size_t first = 0; first < surface.size(); ++first) {
    if (surface[first] != first) continue;
    std::vector<Vec<Dim>> points;
    bool joint = false;
    for (std::size_t k = first; k < surface.size(); ++k) {
      if (surface[k] != first) continue;
      joint = joint || has_joint(model.cracks[k]);
      for (const Vec3& x : model.cracks[k].points) points.push_back(x.template head<Dim>());
    }
    if (!joint) continue;
    Vec<Dim> low = points.front(), high = low;
    for (const Vec<Dim>& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    bool alone = true;
    for (std::size_t k = 0; k < surface.size(); ++k)
      for (const Vec3& x : model.cracks[k].points)
        alone = alone && (surface[k] == first || ((x.template head<Dim>() - low).array() < -near).any() ||
                          ((x.template head<Dim>() - high).array() > near).any());
    if (!alone) continue;
    const Vec<Dim> shift = shift_to_particle_edges(system, points);
    for (std::size_t k = first; k < surface.size(); ++k)
      if (surface[k] == first) shifts[k] = shift;
  }
  return shifts;
}

}  // namespace

void extend_straight(Crack<2>& crack, const CrackTip& tip, double cell, int cells) {
  auto from = tip.point;
  const Vec<2> end = crack.x[from], ahead = cell * (end - crack.x[tip.previous]).normalized();
  for (int k = 1; k <= cells; ++k) {
    const auto next = static_cast<std::uint32_t>(crack.x.size());
    crack.add_point(crack.x.size(), end + k * ahead);
    crack.pieces.push_back(tip.end == 1 ? Crack<2>::Piece{from, next} : Crack<2>::Piece{next, from});
    crack.inside.push_back(0.0);
    from = next;
  }
}

void grow_to(Crack<2>& crack, CrackTip& tip, const Vec<2>& x) {
  const auto next = static_cast<std::uint32_t>(crack.main_points);
  for (auto& piece : crack.pieces)
    for (auto& point : piece) point += point >= next;
  crack.add_point(crack.main_points++, x);
  const auto at = static_cast<std::ptrdiff_t>(crack.main_pieces++);
  crack.pieces.insert(crack.pieces.begin() + at,
                      tip.end == 1 ? Crack<2>::Piece{tip.point, next} : Crack<2>::Piece{next, tip.point});
  crack.inside.insert(crack.inside.begin() + at, 1.0);
  tip.previous = tip.point, tip.point = next;
}

namespace {

// Adds the points and pieces of a description to a crack, moved by `shift`. Joints keep all points, as each of them has
// a history of its own.
void add_pieces(const CrackSpec& spec, const Vec<2>& shift, double cell, Crack<2>& crack) {
  std::vector<std::uint32_t> kept(spec.points.size());
  std::iota(kept.begin(), kept.end(), 0U);
  if (!spec.joint && !(spec.law && spec.law->interface())) kept = resolved_points(spec.points, cell);
  for (const auto k : kept) crack.add_point(crack.x.size(), spec.points[k].head<2>() + shift);
  for (std::uint32_t k = 1; k < crack.x.size(); ++k) crack.pieces.push_back({k - 1, k});
}
void add_pieces(const CrackSpec& spec, const Vec3& shift, double, Crack<3>& crack) {
  for (const Vec3& x : spec.points) crack.add_point(crack.x.size(), x + shift);
  for (const auto& piece : spec.pieces) crack.pieces.push_back(piece);
}

}  // namespace

template <int Dim>
void add_cracks(const Model& model, System<Dim>& system, int width) {
  const BodyOccupancy<Dim> occupancy = around_cracks(model, system);
  const CommonEnds ends(model.cracks, Dim == 2, system.lattice.spacing.maxCoeff());
  const auto shifts = shifts_to_edges(model, system, ends.surface);
  for (std::size_t number = 0; number < model.cracks.size(); ++number) {
    const CrackSpec& spec = model.cracks[number];
    Crack<Dim> crack;
    crack.surface = ends.surface[number];
    crack.law = spec.law, crack.fixed = spec.fixed;
    const auto interface = imperfect_interface(model, system, spec);
    if (interface) crack.law = interface->is_bonded() ? interface : nullptr;
    // closed faces are bonded at the start if their contact law has bonds
    crack.initial_bond = crack.law && crack.law->has_memory() ? 1.0 : 0.0;
    add_pieces(spec, shifts[number], system.lattice.smallest_spacing(), crack);
    sort_pieces(crack);
    crack.main_points = crack.x.size(), crack.main_pieces = crack.pieces.size();
    find_ends(crack, spec, ends.has_common[number], occupancy, system.lattice.spacing.maxCoeff(), width + 1);
    crack.inside.assign(crack.pieces.size(), 0.0);
    for (std::size_t p = 0; p < crack.pieces.size(); ++p)
      for (const auto& [share, fraction] : samples(crack.corners(p), occupancy)) crack.inside[p] += fraction;
    system.cracks.push_back(std::move(crack));
    if (spec.joint) add_joint(model, spec, *spec.joint, occupancy, system);
    if (interface && interface->is_elastic()) {
      const auto law = std::make_shared<InterfaceJoint>(interface);
      add_joint(model, spec, *law, occupancy, system);
      system.joints.back().interface = law;
    }
  }
}

template void add_cracks(const Model&, System<2>&, int);
template void add_cracks(const Model&, System<3>&, int);

}  // namespace tribo
