// SPDX-License-Identifier: MIT
#include "run/crack_report.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tribo {
namespace {

/// The cracks of one surface: lines that share an end, such as the parts of a crack with laws of their own.
template <int Dim>
struct CrackGroup {
  std::vector<std::size_t> members;  // numbers of its cracks
  std::size_t pieces = 0, open_ends = 0;
  double whole = 0.0, inside = 0.0;  // length or area, and what lies in bodies
  double longest = 0.0;              // side of a piece
};

template <int Dim>
std::vector<CrackGroup<Dim>> groups_of(const System<Dim>& system) {
  std::map<std::uint32_t, CrackGroup<Dim>> groups;  // by the number of their first crack
  for (std::size_t c = 0; c < system.cracks.size(); ++c) {
    const Crack<Dim>& crack = system.cracks[c];
    CrackGroup<Dim>& group = groups[Dim == 2 ? crack.surface : static_cast<std::uint32_t>(c)];
    group.members.push_back(c), group.pieces += crack.main_pieces;
    for (std::size_t p = 0; p < crack.main_pieces; ++p) {
      const auto corners = crack.corners(p);
      const double size = Crack<Dim>::area(corners).norm();
      group.whole += size, group.inside += crack.inside[p] * size;
      for (std::size_t k = 0; k < corners.size(); ++k)
        group.longest = std::max(group.longest, (corners[k] - corners[(k + 1) % corners.size()]).norm());
    }
    for (std::size_t p = crack.main_pieces; p < crack.pieces.size(); ++p)
      for (const auto point : crack.pieces[p]) group.open_ends += point < crack.main_points;
  }
  std::vector<CrackGroup<Dim>> out;
  for (auto& entry : groups) out.push_back(std::move(entry.second));
  return out;
}

/// How far a group was moved onto the edges of particles, for example ", moved by 0.002 along y to edges of particles";
/// empty: not at all.
template <int Dim>
std::string displacement_of(const Model& model, const System<Dim>& system, const CrackGroup<Dim>& group) {
  const std::size_t c = group.members.front();
  const Vec<Dim> shift = system.cracks[c].x.front() - model.cracks[c].points.front().template head<Dim>();
  for (Eigen::Index axis = 0; axis < Dim; ++axis)
    if (shift[axis] != 0.0)
      return format(", moved by %.4g along %c to the edges of particles", shift[axis], "xyz"[axis]);
  return "";
}

template <int Dim>
std::string name_of(const CrackGroup<Dim>& group) {
  if (group.members.size() == 1) return format("crack %zu", group.members.front() + 1);
  std::string numbers;
  for (std::size_t k = 0; k < group.members.size(); ++k)
    numbers += (k == 0 ? "" : k + 1 == group.members.size() ? " and " : ", ") + std::to_string(group.members[k] + 1);
  return "the line of cracks " + numbers;
}

/// For example " (of 5000 in the model; the grid does not resolve the others)"; empty: all of them.
template <int Dim>
std::string of_those_given(const Model& model, const CrackGroup<Dim>& group) {
  std::size_t given = 0;
  for (const std::size_t c : group.members) given += model.cracks[c].pieces.size();
  if (given <= group.pieces) return "";
  return format(" (of %zu in the model; the grid does not resolve the others)", given);
}

/// Least distance between the points of two groups of cracks.
template <int Dim>
double distance(const System<Dim>& system, const CrackGroup<Dim>& a, const CrackGroup<Dim>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t m : a.members)
    for (const std::size_t n : b.members) {
      const Crack<Dim>&one = system.cracks[m], &other = system.cracks[n];
      for (std::size_t i = 0; i < one.main_points; ++i)
        for (std::size_t j = 0; j < other.main_points; ++j) least = std::min(least, (one.x[i] - other.x[j]).norm());
    }
  return least;
}

/// Whether a crack ends within a body: in two dimensions if it does not go on beyond both its ends.
template <int Dim>
bool has_tips(const CrackGroup<Dim>& group) {
  return Dim == 3 ? group.inside > 0.999 * group.whole : group.open_ends < 2;
}

/// Advice on ends that are said to lie outside of the bodies, but whose extension does not reach the surface.
template <int Dim>
void remark_short_ends(const System<Dim>& system, const CrackGroup<Dim>& group, double h, Remarks& out) {
  constexpr double most = 0.99;  // of the last piece
  for (const std::size_t c : group.members) {
    const Crack<Dim>& crack = system.cracks[c];
    std::size_t first = crack.main_pieces;
    for (std::size_t p = first; p < crack.pieces.size(); ++p) {
      const auto begins = [&](std::size_t piece) {
        return std::any_of(crack.pieces[piece].begin(), crack.pieces[piece].end(),
                           [&](std::uint32_t point) { return point < crack.main_points; });
      };
      if (begins(p)) first = p;
      const bool last = p + 1 == crack.pieces.size() || begins(p + 1);
      if (!last || crack.inside[p] < most) continue;
      const auto& piece = crack.pieces[first];
      const Vec<Dim>& end = crack.x[*std::min_element(piece.begin(), piece.end())];
      out.advice.push_back(
          format("crack %zu: its end at (%.6g, %.6g) is said to be exterior but lies inside a body; the "
                 "crack goes on for ",
                 c + 1, end[0], end[1]) +
          counted(static_cast<double>(p - first + 1), "cell") +
          format(", %.4g, and ends there inside the body: draw it beyond the surface",
                 static_cast<double>(p - first + 1) * h));
    }
  }
}

}  // namespace

template <int Dim>
Remarks describe_cracks(const Model& model, const System<Dim>& system) {
  constexpr double few = 6, near = 3, coarse = 1.01, common = 1e-6;  // cells
  const double h = system.lattice.spacing.maxCoeff();
  Remarks out;
  const auto groups = groups_of(system);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CrackGroup<Dim>& group = groups[g];
    const double across = Dim == 2 ? group.inside / h : std::sqrt(group.inside) / h;
    const std::string who = name_of(group);
    out.lines.push_back(
        who + ": " + counted(group.pieces, "piece") + of_those_given(model, group) +
        format(", %s %.6g, %.6g of it in bodies: ", Dim == 2 ? "length" : "area", group.whole, group.inside) +
        counted(across, "cell", "%.3g") + (Dim == 2 ? " long" : " across") + displacement_of(model, system, group));
    if (group.inside == 0)
      out.advice.push_back(who + " lies in no body and does nothing");
    else if (across < few && has_tips(group))
      out.advice.push_back(who + " spans " + counted(across, "cell") +
                           " only: what happens at its ends is smeared over two or three");
    if (group.inside > 0) remark_short_ends(system, group, h, out);
    if (group.longest > coarse * (Dim == 3 ? std::sqrt(2.0) : 1.0) * h)
      out.advice.push_back(who + " has pieces of up to " + counted(group.longest / h, "cell") +
                           ": nodes between its points see it coarsely; take more, two per cell");
    for (std::size_t other = 0; other < g; ++other) {
      const double d = distance(system, groups[other], group) / h;
      if (d < common)
        out.advice.push_back(name_of(groups[other]) + " and " + who +
                             " meet: the body between them is not resolved near their common point");
      else if (d < near)
        out.advice.push_back(name_of(groups[other]) + " and " + who + " come within " + counted(d, "cell") +
                             ": what is between them is not resolved");
    }
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
    // The points of imperfect interfaces are found in the first step
    if (surface.crack != JointSurface<Dim>::none || surface.interface) continue;
    double area = 0.0;
    std::size_t steps = 0;
    for (std::size_t k = 0; k < surface.joints.size(); ++k) {
      area += surface.joints[k].area;
      if (k > 0 && (surface.x[k] - surface.x[k - 1]).norm() < h)
        steps += surface.axes[k].n.dot(surface.axes[k - 1].n) < turned;
    }
    const std::string who =
        format("joint %zu of %s and %s", s + 1, name(surface.material[0]).c_str(), name(surface.material[1]).c_str());
    out.lines.push_back(who + ": " + counted(surface.joints.size(), "point") + format(", area %.6g", area));
    const double cells = std::pow(static_cast<double>(surface.joints.size()), 1.0 / (Dim - 1)) / 2;
    if (cells < few) out.advice.push_back(who + " has " + counted(surface.joints.size(), "point") + " only");
    if (10 * steps > surface.joints.size())
      out.advice.push_back(
          who +
          " runs in steps of particles, which lock it: let particles follow the face (<Deform>), or draw "
          "the joint as a crack");
  }
  return out;
}

template <int Dim>
std::vector<std::string> remarks_on_inclined_joints(const Model& model, const System<Dim>& system) {
  constexpr double along_axis = 0.985;  // least cosine, of 10 degrees
  std::vector<std::string> out;
  if (model.scheme.kernel != Kernel::quadratic_spline && model.scheme.kernel != Kernel::cubic_spline) return out;
  const auto name = [&](int material) { return model.materials[static_cast<std::size_t>(material)].name; };
  for (const JointSurface<Dim>& surface : system.joints) {
    if (surface.crack != JointSurface<Dim>::none) continue;
    const bool inclined = std::any_of(surface.axes.begin(), surface.axes.end(), [](const JointAxes& axes) {
      return axes.n.template lpNorm<Eigen::Infinity>() < along_axis;
    });
    if (inclined)
      out.push_back(std::string("the ") + (surface.interface ? "interface" : "joint") + " of '" +
                    name(surface.material[0]) + "' and '" + name(surface.material[1]) +
                    "' lies at an angle to the grid: with splines, its points within a cell of a free end carry too "
                    "little stress; take <GIMP type='uGIMP'/> or <GIMP type='lCPDI'/> where that matters");
  }
  return out;
}

template std::vector<std::string> remarks_on_inclined_joints(const Model&, const System<2>&);
template std::vector<std::string> remarks_on_inclined_joints(const Model&, const System<3>&);
template Remarks describe_cracks(const Model&, const System<2>&);
template Remarks describe_interfaces(const System<2>&);
template Remarks describe_interfaces(const System<3>&);
template Remarks describe_cracks(const Model&, const System<3>&);

}  // namespace tribo
