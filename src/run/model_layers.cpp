// SPDX-License-Identifier: MIT
#include "run/model_layers.hpp"

#include "base/text.hpp"
#include "grid/select.hpp"
#include "particles/fill.hpp"
#include "run/layer_list.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tribo {
namespace {

constexpr std::array<int, 3> grey{150, 160, 166}, green{46, 139, 87}, brown{139, 90, 43}, violet{120, 81, 169},
    red{200, 40, 60}, orange{230, 120, 20}, blue{30, 100, 200}, pink{214, 51, 132}, black{40, 46, 50};
constexpr const char* axes = "xyz";

// Every n-th of many, so that at most about 4000 are drawn.
std::size_t stride_of(std::size_t count) { return count / 4000 + 1; }

// A rectangle normal to an axis, or a line in two dimensions.
void plane(Layer& layer, const GridSpec& grid, std::size_t axis, double at, bool flat) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto first = static_cast<std::uint32_t>(layer.points.size());
  const auto corner = [&](bool high_u, bool high_v) {
    std::array<double, 3> x{};
    x[axis] = at, x[u] = high_u ? grid.high[u] : grid.low[u], x[v] = high_v ? grid.high[v] : grid.low[v];
    if (flat) x[2] = 0.0;
    return Vec3(x[0], x[1], x[2]);
  };
  if (flat) {
    layer.line(corner(false, false), corner(true, true));
    return;
  }
  for (const auto& [a, b] : {std::pair(false, false), {true, false}, {true, true}, {false, true}})
    layer.points.push_back(corner(a, b));
  layer.polygons.push_back({first, first + 1, first + 2, first + 3});
}

Bounds grid_bounds(const GridSpec& grid, bool flat) {
  return {Vec3(grid.low[0], grid.low[1], flat ? 0.0 : grid.low[2]),
          Vec3(grid.high[0], grid.high[1], flat ? 0.0 : grid.high[2])};
}

// Lines of the cells; in space on the three faces at the low ends.
Layer cell_lines(const GridSpec& grid, bool flat) {
  Layer out{"cells", format("%d x %d", grid.cells[0], grid.cells[1]), grey, 1.0, 0.45, false};
  if (!flat) out.note += format(" x %d", grid.cells[2]);
  static constexpr int most = 2000;
  if (grid.cells[0] + grid.cells[1] + (flat ? 0 : grid.cells[2]) > most) return out;
  const Bounds b = grid_bounds(grid, flat);
  for (int axis = 0; axis < (flat ? 2 : 3); ++axis)
    for (int other = 0; other < (flat ? 2 : 3); ++other) {
      const int cells = grid.cells[static_cast<std::size_t>(axis)];
      for (int k = 0; axis != other && k <= cells; ++k) {
        Vec3 from = b.low, to = b.low;
        from[axis] = to[axis] = b.low[axis] + (b.high[axis] - b.low[axis]) * k / cells;
        to[other] = b.high[other];
        out.line(from, to);
      }
    }
  return out;
}

void add_edges(std::vector<Layer>& out, const GridSpec& grid, bool flat) {
  Layer outline{"edges of the grid", "", grey, 1.0}, walls{"walls", "", brown, 4.0, flat ? 1.0 : 0.3},
      symmetry{"symmetry planes", "", green, 3.0, flat ? 1.0 : 0.25},
      periodic{"periodic edges", "", violet, 3.0, flat ? 1.0 : 0.25};
  outline.box(grid_bounds(grid, flat));
  for (std::size_t axis = 0; axis < (flat ? 2 : 3); ++axis)
    for (std::size_t side = 0; side < 2; ++side) {
      if (const auto at = grid.symmetry[axis][side]) plane(symmetry, grid, axis, *at, flat);
      if (const auto at = grid.wall[axis][side]) plane(walls, grid, axis, *at, flat);
      if (grid.periodic[axis]) plane(periodic, grid, axis, side == 0 ? grid.low[axis] : grid.high[axis], flat);
    }
  out.push_back(std::move(outline)), out.push_back(cell_lines(grid, flat));
  out.push_back(std::move(walls)), out.push_back(std::move(symmetry)), out.push_back(std::move(periodic));
}

template <int Dim>
std::vector<Vec3> nodes_in(const Lattice<Dim>& lattice, const Region& region) {
  std::vector<Vec3> out;
  each_node_in<Dim>(lattice, region, [&](const Index<Dim>& node) {
    Vec3 x = Vec3::Zero();
    x.template head<Dim>() = lattice.position(node);
    const auto at = x.template head<Dim>().array();
    if (((at >= lattice.low.array() - 1e-9) && (at <= lattice.high.array() + 1e-9)).all()) out.push_back(x);
  });
  return out;
}

// One layer for each direction in which velocities of nodes are prescribed.
template <int Dim>
void add_node_conditions(std::vector<Layer>& out, const Model& model, const Lattice<Dim>& lattice) {
  std::map<std::string, Layer> layers;
  std::map<std::string, std::size_t> counts;
  for (const NodeCondition& c : model.node_conditions) {
    Eigen::Index axis = 0;
    const bool along = c.direction.cwiseAbs().maxCoeff(&axis) > 1 - 1e-9;
    const std::string name = c.wall ? "moving walls"
                                    : std::string("velocity of nodes prescribed in ") +
                                          (along ? std::string(1, axes[axis]) : "oblique directions");
    Layer& layer = layers
                       .try_emplace(name, Layer{name, "",
                                                c.wall      ? brown
                                                : !along    ? pink
                                                : axis == 0 ? red
                                                : axis == 1 ? orange
                                                            : blue,
                                                2.0})
                       .first->second;
    const auto nodes = nodes_in<Dim>(lattice, *c.where);
    counts[name] += nodes.size();
    const Vec3 half = 0.3 * lattice.spacing.minCoeff() * c.direction;
    for (std::size_t k = 0; k < nodes.size(); k += stride_of(nodes.size()))
      layer.line(nodes[k] - half, nodes[k] + half);
  }
  for (auto& [name, layer] : layers) layer.note = counted(counts[name], "node"), out.push_back(std::move(layer));
  Layer heat{"temperature of nodes prescribed", "", pink, 2.0};
  for (const TemperatureCondition& c : model.temperature_conditions)
    for (const Vec3& x : nodes_in<Dim>(lattice, *c.where)) heat.points.push_back(x);
  heat.note = counted(heat.points.size(), "node");
  out.push_back(std::move(heat));
}

// Outward normal of a face of a particle's domain in its initial state.
Vec3 normal_of(DomainFace face) {
  switch (face) {
    case DomainFace::low_x:
      return -Vec3::UnitX();
    case DomainFace::high_x:
      return Vec3::UnitX();
    case DomainFace::low_y:
      return -Vec3::UnitY();
    case DomainFace::high_y:
      return Vec3::UnitY();
    case DomainFace::low_z:
      return -Vec3::UnitZ();
    case DomainFace::high_z:
      return Vec3::UnitZ();
  }
  return Vec3::Zero();
}

// The direction in which a load with a positive value acts.
Vec3 direction_of(const ParticleCondition& c) {
  const Vec3 normal = normal_of(c.face);
  if (c.kind == ParticleCondition::Kind::heat_flux) return -normal;
  if (c.direction == LoadDirection::normal) return normal;
  if (c.direction == LoadDirection::tangential) return {-normal[1], normal[0], 0.0};
  return Vec3::Unit(static_cast<int>(c.direction));
}

template <int Dim>
void add_loads(std::vector<Layer>& out, const Model& model, const Lattice<Dim>& lattice) {
  if (model.particle_conditions.empty()) return;
  using Kind = ParticleCondition::Kind;
  Layer forces{"forces on particles", "", red, 2.0}, tractions{"tractions", "", orange, 2.0},
      fluxes{"heat fluxes", "", pink, 2.0};
  std::map<Kind, std::size_t> counts;
  const double size = 1.5 * lattice.spacing.minCoeff();
  place_points(model, [&](const Seed& seed) {
    for (const ParticleCondition& c : model.particle_conditions) {
      if (!c.where->contains(seed.x)) continue;
      static constexpr std::size_t most = 4000;
      if (++counts[c.kind] > most) continue;
      Layer& layer = c.kind == Kind::force ? forces : c.kind == Kind::traction ? tractions : fluxes;
      // At the start of the load if it has a value, else as a positive one
      const double value = c.value.at(0.0, seed.x);
      const Vec3 along = (value < 0 ? -size : size) * direction_of(c);
      Vec3 at = seed.x;
      if (c.kind != Kind::force) at += normal_of(c.face).cwiseProduct(seed.half_size);
      if (Dim == 2) at[2] = 0.0;
      layer.arrow(at, at + along);
    }
  });
  for (auto& [kind, count] : counts)
    (kind == Kind::force ? forces : kind == Kind::traction ? tractions : fluxes).note = counted(count, "particle");
  for (Layer* layer : {&forces, &tractions, &fluxes}) out.push_back(std::move(*layer));
}

template <int Dim>
Vec3 in_space(const Vec<Dim>& x) {
  Vec3 out = Vec3::Zero();
  out.template head<Dim>() = x;
  return out;
}

template <int Dim>
void add_cracks(std::vector<Layer>& out, const System<Dim>& system) {
  Layer cracks{"cracks", counted(system.cracks.size(), "crack"), pink, 3.0, Dim == 2 ? 1.0 : 0.6};
  for (const Crack<Dim>& crack : system.cracks) {
    const auto first = static_cast<std::uint32_t>(cracks.points.size());
    for (std::size_t k = 0; k < crack.main_points; ++k) cracks.points.push_back(in_space<Dim>(crack.x[k]));
    for (std::size_t p = 0; p < crack.main_pieces; ++p) {
      std::vector<std::uint32_t> corners;
      for (const auto k : crack.pieces[p]) corners.push_back(first + k);
      (Dim == 2 ? cracks.lines : cracks.polygons).push_back(std::move(corners));
    }
  }
  Layer joints{"joints", "", blue, 2.0};
  std::size_t count = 0;
  const double half = 0.3 * system.lattice.spacing.minCoeff();
  for (const auto& surface : system.joints)
    for (std::size_t k = 0; k < surface.x.size(); ++k, ++count) {
      const Vec3 x = in_space<Dim>(surface.x[k]);
      joints.line(x - half * surface.axes[k].n, x + half * surface.axes[k].n);
    }
  joints.note = counted(count, "point");
  out.push_back(std::move(cracks)), out.push_back(std::move(joints));
}

// Gravity, and body forces that are functions as they are at the start in the middle of the model.
void add_gravity(std::vector<Layer>& out, const Model& model, const Bounds& around) {
  Vec3 g = model.body_force.gravity;
  for (int d = 0; d < 3; ++d)
    for (const auto* functions : {&model.body_force.function, &model.body_force.on_particles})
      if (const auto& function = (*functions)[static_cast<std::size_t>(d)])
        g[d] += (*function)(Variables::at(0.5 * (around.low + around.high)));
  if (g.isZero()) return;
  Layer gravity{"gravity", format("%.4g at the start", g.norm()), black, 2.0};
  const Vec3 size = around.high - around.low, from = around.high - 0.06 * size;
  gravity.arrow(from, from + 0.12 * size.head<2>().maxCoeff() * g.normalized());
  out.push_back(std::move(gravity));
}

// The part of a region's box that lies within the bodies, a little enlarged.
void add_region(Layer& layer, const Region& region, const Bounds& around, bool flat) {
  const Vec3 margin = 0.02 * (around.high - around.low);
  Bounds b = region.bounds();
  b.low = b.low.cwiseMax(around.low - margin), b.high = b.high.cwiseMin(around.high + margin);
  if (flat) b.low[2] = b.high[2] = 0.0;
  if ((b.low.array() <= b.high.array()).all()) layer.box(b);
}

Bounds bounds_of(const Assembly& blocks) {
  Bounds out{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (std::size_t k = 0; k < blocks.block_count(); ++k) {
    const BlockShape& shape = blocks.shapes[k];
    for (const Vec3& corner : shape.corners) {
      Vec3 reach = Vec3::Constant(shape.radius);
      if (blocks.plane()) reach[2] = 0.0;
      const Vec3 x = blocks.motion[k].x + blocks.motion[k].R * corner;
      out.low = out.low.cwiseMin(x - reach), out.high = out.high.cwiseMax(x + reach);
    }
  }
  return out;
}

void add_block_conditions(std::vector<Layer>& out, const BlocksSpec& spec, const Assembly& blocks) {
  const Bounds around = bounds_of(blocks);
  Layer held{"blocks held", "", red, 2.0}, loaded{"blocks loaded", "", orange, 2.0},
      pressed{"pressures on blocks", "", violet, 2.0}, platens{"platens", "", brown, 3.0};
  const auto add = [&](Layer& layer, const auto& list) {
    for (const auto& one : list)
      if (one.where) add_region(layer, *one.where, around, blocks.plane());
    layer.note = counted(list.size(), "region");
    out.push_back(std::move(layer));
  };
  add(held, spec.holds), add(loaded, spec.loads), add(pressed, spec.pressures), add(platens, spec.platens);
}

}  // namespace

template <int Dim>
std::string model_layers(const Model& model, const System<Dim>& system) {
  std::vector<Layer> out;
  add_edges(out, model.grid, Dim == 2);
  add_node_conditions<Dim>(out, model, system.lattice);
  add_loads<Dim>(out, model, system.lattice);
  add_cracks<Dim>(out, system);
  if (system.blocks) add_block_conditions(out, *model.blocks, *system.blocks);
  add_gravity(out, model, grid_bounds(model.grid, Dim == 2));
  return json_of(out);
}

std::string model_layers(const Model& model, const Assembly& blocks) {
  std::vector<Layer> out;
  add_block_conditions(out, *model.blocks, blocks);
  add_gravity(out, model, bounds_of(blocks));
  return json_of(out);
}

template std::string model_layers<2>(const Model&, const System<2>&);
template std::string model_layers<3>(const Model&, const System<3>&);

}  // namespace tribo
