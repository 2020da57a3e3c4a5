// SPDX-License-Identifier: MIT
#include "run/crack_report.hpp"

#include "base/text.hpp"

#include <cmath>
#include <limits>

namespace tribo {
namespace {

/// Least distance between the points of two cracks.
template <int Dim>
double distance(const Crack<Dim>& a, const Crack<Dim>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.main_points; ++i)
    for (std::size_t j = 0; j < b.main_points; ++j) least = std::min(least, (a.x[i] - b.x[j]).norm());
  return least;
}

/// Whether a crack ends within a body: in two dimensions if it does not go on beyond both its ends.
template <int Dim>
bool has_tips(const Crack<Dim>& crack, double inside, double whole) {
  if (Dim == 3) return inside > 0.999 * whole;
  std::size_t out = 0;
  for (std::size_t p = crack.main_pieces; p < crack.pieces.size(); ++p)
    for (const auto point : crack.pieces[p]) out += point < crack.main_points;
  return out < 2;
}

}  // namespace

template <int Dim>
Remarks describe_cracks(const System<Dim>& system) {
  constexpr double few = 6, near = 3, coarse = 1.01;  // cells
  const double h = system.lattice.spacing.maxCoeff();
  Remarks out;
  for (std::size_t c = 0; c < system.cracks.size(); ++c) {
    const Crack<Dim>& crack = system.cracks[c];
    double whole = 0.0, inside = 0.0, longest = 0.0;
    for (std::size_t p = 0; p < crack.main_pieces; ++p) {
      const auto corners = crack.corners(p);
      const double size = Crack<Dim>::area(corners).norm();
      whole += size, inside += crack.inside[p] * size;
      for (std::size_t k = 0; k < corners.size(); ++k)
        longest = std::max(longest, (corners[k] - corners[(k + 1) % corners.size()]).norm());
    }
    const double across = Dim == 2 ? inside / h : std::sqrt(inside) / h;
    const std::string who = format("crack %zu", c + 1);
    out.lines.push_back(who + format(": %zu pieces, %s %.6g, %.6g of it in bodies: %.3g cells %s", crack.main_pieces,
                                     Dim == 2 ? "length" : "area", whole, inside, across,
                                     Dim == 2 ? "long" : "across"));
    if (inside == 0)
      out.advice.push_back(who + " lies in no body and does nothing");
    else if (across < few && has_tips(crack, inside, whole))
      out.advice.push_back(
          who + format(" spans %.2g cells only: what happens at its ends is smeared over two or three", across));
    if (longest > coarse * (Dim == 3 ? std::sqrt(2.0) : 1.0) * h)
      out.advice.push_back(who +
                           format(" has pieces of up to %.2g cells: nodes between its points see it coarsely; take "
                                  "more, two per cell",
                                  longest / h));
    for (std::size_t other = 0; other < c; ++other)
      if (const double d = distance(system.cracks[other], crack) / h; d < near)
        out.advice.push_back(format("crack %zu and %s come within %.2g cells: what is between them is not resolved",
                                    other + 1, who.c_str(), d));
  }
  return out;
}

template <int Dim>
Remarks describe_interfaces(const System<Dim>& system) {
  constexpr double few = 3;       // cells
  constexpr double turned = 0.9;  // cosine of the angle between neighbours
  const double h = system.lattice.spacing.maxCoeff();
  const auto name = [&](int material) {
    for (const auto* list : {&system.bodies, &system.rigids})
      for (const auto& body : *list)
        if (body.material == material) return "'" + body.name + "'";
    return std::string();
  };
  Remarks out;
  for (std::size_t s = 0; s < system.joints.size(); ++s) {
    const JointSurface<Dim>& surface = system.joints[s];
    if (surface.crack != JointSurface<Dim>::none) continue;
    double area = 0.0;
    std::size_t steps = 0;
    for (std::size_t k = 0; k < surface.joints.size(); ++k) {
      area += surface.joints[k].area;
      if (k > 0 && (surface.x[k] - surface.x[k - 1]).norm() < h)
        steps += surface.axes[k].n.dot(surface.axes[k - 1].n) < turned;
    }
    const std::string who =
        format("joint %zu of %s and %s", s + 1, name(surface.material[0]).c_str(), name(surface.material[1]).c_str());
    out.lines.push_back(who + format(": %zu points, area %.6g", surface.joints.size(), area));
    const double cells = std::pow(static_cast<double>(surface.joints.size()), 1.0 / (Dim - 1)) / 2;
    if (cells < few) out.advice.push_back(who + format(" has %zu points only", surface.joints.size()));
    if (10 * steps > surface.joints.size())
      out.advice.push_back(
          who +
          " runs in steps of particles, which lock it: let particles follow the face (<Deform>), or draw "
          "the joint as a crack");
  }
  return out;
}

template Remarks describe_cracks(const System<2>&);
template Remarks describe_interfaces(const System<2>&);
template Remarks describe_interfaces(const System<3>&);
template Remarks describe_cracks(const System<3>&);

}  // namespace tribo
