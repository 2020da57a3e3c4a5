// SPDX-License-Identifier: MIT
#include "run/setup_report.hpp"

#include "base/text.hpp"
#include "grid/select.hpp"
#include "materials/material.hpp"
#include "particles/coverage.hpp"
#include "run/contact_table.hpp"
#include "run/unit_remarks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tribo {
namespace {

constexpr std::array<char, 3> axis_names{'x', 'y', 'z'};

template <int Dim>
class SetupReport {
 public:
  SetupReport(const Model& model, const System<Dim>& system) : model_(model), system_(system) {}

  Remarks remarks() {
    scheme();
    equilibrium();
    gravity();
    cells();
    edges();
    for (const std::string& text : contact_table(model_, system_)) line(text);
    overlapping();
    cut_by_edges();
    return std::move(out_);
  }

 private:
  using Box = std::pair<Index<Dim>, Index<Dim>>;

  void line(const std::string& text) { out_.lines.push_back(text); }
  std::string name(int material) const { return "'" + model_.materials[static_cast<std::size_t>(material)].name + "'"; }
  std::string body(int piece) const {
    const Piece& p = model_.pieces[static_cast<std::size_t>(piece)];
    return name(p.material) + (p.origin.file ? " (" + p.origin.text() + ")" : "");
  }
  static std::string edge_name(int axis, int side) {
    return std::string(1, axis_names[static_cast<std::size_t>(axis)]) + (side == 0 ? "min" : "max");
  }
  double edge_at(int axis, int side) const {
    const auto k = static_cast<std::size_t>(axis);
    return side == 0 ? model_.grid.low[k] : model_.grid.high[k];
  }

  void scheme() {
    const Scheme& s = model_.scheme;
    line("scheme: " + (s.kernel == Kernel::linear ? "linear" : words_of(s.kernel).front()) + " shape functions, " +
         words_of_transfer(s) + ", stress update " + words_of_order(s));
    if (s.kernel == Kernel::linear && !s.b_bar && !s.strains_follow_update() && !system_.bodies.empty())
      out_.advice.push_back(
          "the shape functions are linear: stresses jump when particles cross from cell to cell; "
          "<GIMP type='uGIMP'/>, <GIMP type='lCPDI'/> or <GIMP type='quadratic'/> avoid this");
  }

  // In equilibrium, strains from extrapolated velocities do not see the motion of nodes that particles hardly reach.
  // Where these lie along a curved face under stress, the out-of-balance force remains: FMPM and XPIC, which remove the
  // velocity of such nodes in each step, move the particles on and on; with FLIP the face vibrates.
  void equilibrium() {
    const Scheme& s = model_.scheme;
    const bool creeps = s.transfer == Transfer::fmpm || s.transfer == Transfer::xpic;
    if (!model_.seeks_equilibrium() || s.strains_follow_update() || s.kernel == Kernel::linear) return;
    if (!creeps && s.transfer != Transfer::flip) return;
    out_.advice.push_back("with " + words_of_transfer(s) + " and " + words_of_order(s) +
                          ", faces of a body in equilibrium that are curved or inclined " +
                          (creeps ? "creep, and their displacement becomes too large" : "vibrate in spite of damping") +
                          "; USL- and USAVG-, in XML with <SkipPostExtrapolation/>, avoid this");
  }

  static std::string words_of_transfer(const Scheme& s) {
    const std::string order = "(" + std::to_string(s.filter_order) + ")";
    switch (s.transfer) {
      case Transfer::flip:
        return "FLIP";
      case Transfer::pic:
        return "PIC";
      case Transfer::blend:
        return format("FLIP %.6g", s.flip_fraction);
      case Transfer::xpic:
        return "XPIC" + order;
      case Transfer::fmpm:
        return "FMPM" + order;
      case Transfer::apic:
        return "APIC";
    }
    return "";
  }

  static std::string words_of_order(const Scheme& s) {
    if (s.order == UpdateOrder::usf) return "USF";
    return std::string(s.order == UpdateOrder::usl ? "USL" : "USAVG") + (s.extrapolate_again ? "+" : "-");
  }

  void gravity() {
    const Vec3& g = model_.body_force.gravity;
    line("gravity: " + words_of_gravity(model_));
    if (Dim == 2 && g[0] != 0 && g[1] == 0 && !model_.body_force.function[1] && !model_.body_force.on_particles[1])
      out_.advice.push_back(format("gravity acts along %s alone; in the plane y is up, so <BodyYForce> may be meant",
                                   model_.analysis == Analysis::axisymmetric ? "the radius" : "x"));
  }

  void cells() {
    static constexpr double slender = 4;
    std::string counts, sizes;
    for (std::size_t d = 0; d < Dim; ++d) {
      counts += (d ? " x " : "") + std::to_string(model_.grid.cells[d]);
      sizes += (d ? " x " : "") + format("%.6g", system_.lattice.spacing[static_cast<Eigen::Index>(d)]);
    }
    const int total = model_.points_per_cell > 0 ? model_.points_per_cell : Dim == 2 ? 4 : 8;
    line("cells: " + counts + " of " + sizes + " (" + model_.units.name(Dimension::length) + "), " +
         counted(total, "particle") + " per cell" + own_numbers());
    const double ratio = system_.lattice.spacing.maxCoeff() / system_.lattice.spacing.minCoeff();
    if (ratio > slender * (1 - 1e-9))
      out_.advice.push_back(
          format("the cells are %.3g times as long as wide: the short edge sets the time step, the "
                 "long one the accuracy; cells near to squares serve better",
                 ratio));
  }

  std::string own_numbers() const {
    const bool own = std::any_of(model_.pieces.begin(), model_.pieces.end(), [](const Piece& p) {
      return p.material >= 0 && (p.point_size || p.points_per_axis != std::array<int, 3>{0, 0, 0});
    });
    return own ? ", other numbers in some bodies" : "";
  }

  // The nodes of the input grid that a condition selects; none if it selects none of them.
  std::optional<Box> nodes_of(const NodeCondition& condition) const {
    std::optional<Box> box;
    each_node_in<Dim>(system_.lattice, *condition.where, [&](Index<Dim> node) {
      for (std::size_t d = 0; d < Dim; ++d) {
        node[d] -= Lattice<Dim>::padding;
        if (node[d] < 0 || node[d] > model_.grid.cells[d]) return;
      }
      if (!box) box = {node, node};
      for (std::size_t d = 0; d < Dim; ++d)
        box->first[d] = std::min(box->first[d], node[d]), box->second[d] = std::max(box->second[d], node[d]);
    });
    return box;
  }

  // The edge of the grid that a layer of nodes belongs to, axis and side; none if it is no layer.
  std::optional<std::pair<int, int>> edge_of(const Box& box) const {
    static constexpr double flat = 0.25;  // thickness of a layer over its extent
    int axis = 0;
    const auto extent = [&](int d) {
      const auto k = static_cast<std::size_t>(d);
      return box.second[k] - box.first[k];
    };
    for (int d = 1; d < Dim; ++d)
      if (extent(d) < extent(axis)) axis = d;
    for (int d = 0; d < Dim; ++d)
      if (d != axis && !(extent(axis) <= flat * extent(d))) return std::nullopt;
    const auto k = static_cast<std::size_t>(axis);
    const int below = box.first[k], above = model_.grid.cells[k] - box.second[k];
    return std::pair{axis, below <= above ? 0 : 1};
  }

  std::string value_of(const NodeCondition& condition) const {
    const Vec3& n = condition.direction;
    Eigen::Index axis = 0;
    const bool along = n.cwiseAbs().maxCoeff(&axis) > 1 - 1e-9;
    const std::string direction = along ? std::string(1, axis_names[static_cast<std::size_t>(axis)])
                                        : format("along (%.3g, %.3g, %.3g)", n[0], n[1], n[2]);
    const Prescribed& v = condition.velocity;
    const std::string style = words_of(v.style->words).front();
    const std::string wall = condition.wall ? " of a moving wall" : "";
    if (style == "constant") return direction + format(" = %.6g", along && n[axis] < 0 ? -v.value : v.value) + wall;
    return direction + " (" + style + ")" + wall;
  }

  // The position of a node, with zero for what round-off leaves of it.
  double position(int node, int axis) const {
    const double h = system_.lattice.spacing[axis], x = edge_at(axis, 0) + node * h;
    return std::abs(x) < 1e-9 * h ? 0.0 : x;
  }

  std::string place_of(const Box& box, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    const double low = position(box.first[k], axis), high = position(box.second[k], axis);
    const char name = axis_names[k];
    return low == high ? format(" at %c = %.6g", name, low) : format(" for %c from %.6g to %.6g", name, low, high);
  }

  void edges() {
    std::map<std::pair<int, int>, std::map<std::string, std::string>> conditions;  // by edge, then by place
    std::map<std::string, int> elsewhere;
    for (const auto& c : model_.node_conditions) {
      const auto box = nodes_of(c);
      if (!box) continue;
      const auto edge = edge_of(*box);
      if (!edge) {
        ++elsewhere[value_of(c)];
        continue;
      }
      std::string& at = conditions[*edge][place_of(*box, edge->first)];
      if (at.find(value_of(c)) == std::string::npos) at += (at.empty() ? "velocity " : ", ") + value_of(c);
    }
    line("edges of the grid:");
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        std::vector<std::string> parts = planes(axis, side);
        for (const auto& [place, what] : conditions[{axis, side}]) parts.push_back(what + place);
        line("  " + edge_name(axis, side) + format(" = %-10.6g ", edge_at(axis, side)) +
             (parts.empty() ? "free" : join(parts, "; ")));
      }
    for (const auto& [value, count] : elsewhere)
      line("  inside: velocity " + value + (count == 1 ? "" : " in " + counted(count, "region")));
  }

  std::vector<std::string> planes(int axis, int side) const {
    const auto k = static_cast<std::size_t>(axis), s = static_cast<std::size_t>(side);
    if (model_.grid.periodic[k]) return {"periodic"};
    std::vector<std::string> out;
    const auto plane = [&](const std::optional<double>& at, const char* what) {
      if (!at) return;
      out.push_back(what + (std::abs(*at - edge_at(axis, side)) < 1e-9 * system_.lattice.spacing[axis]
                                ? std::string()
                                : format(" at %c = %.6g", axis_names[k], *at)));
    };
    plane(model_.grid.symmetry[k][s], "symmetry");
    plane(model_.grid.wall[k][s], "wall");
    return out;
  }

  void overlapping() {
    for (const Overlap& o : overlaps(model_)) {
      const std::string size = format("%s of %.4g", Dim == 2 ? "an area" : "a volume", o.volume);
      if (o.inside)
        line("in its place: " + body(o.first) + ", " + size + ", replaces a part of " + body(o.second));
      else
        out_.advice.push_back(body(o.first) + " and " + body(o.second) + " claim " + size +
                              " in common: the first of them gets it. Draw the other one with a hole there, or move "
                              "one of them");
    }
  }

  void cut_by_edges() {
    for (const EdgeCut& cut : edge_cuts(model_))
      out_.advice.push_back(body(cut.piece) + ": " + text_of(cut, model_) +
                            "; a rigid body acts only where the grid is");
  }

  const Model& model_;
  const System<Dim>& system_;
  Remarks out_;
};

}  // namespace

template <int Dim>
Remarks describe_setup(const Model& model, const System<Dim>& system) {
  return SetupReport<Dim>(model, system).remarks();
}

template Remarks describe_setup(const Model&, const System<2>&);
template Remarks describe_setup(const Model&, const System<3>&);

}  // namespace tribo
