// SPDX-License-Identifier: MIT
/// <Blocks>: assemblies of rigid blocks, alone or coupled to a grid.

#include "base/text.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"
#include "materials/material.hpp"
#include "model/block_quantities.hpp"

#include <algorithm>

namespace tribo {
namespace {

bool lists(const std::vector<std::string_view>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

// A model that consists of blocks only has no other sections, and many settings of <MPMHeader> refer to the grid.
void Builder::only_of_blocks() {
  static const std::vector<std::string_view> sections{"Header",   "MPMHeader", "Blocks", "Material", "Gravity",
                                                      "Commands", "Drive",     "Stage",  "When"};
  static const std::vector<std::string_view> settings{
      "TimeStep",     "MaxTime",           "Timing",        "ArchiveTime", "FirstArchiveTime",
      "ArchiveGroup", "GlobalArchiveTime", "GlobalArchive", "Output",      "ArchiveRoot"};
  for (const auto& s : root_.children)
    must(lists(sections, s.name), s.origin,
         "<" + s.name + "> needs a grid and particles; a file with <Mesh> can have blocks in addition");
  for (const auto& s : root_.child("MPMHeader")->children)
    must(lists(settings, s.name), s.origin,
         "<" + s.name + "> belongs to grids and particles and has no meaning for blocks; leave it out");
  if (const auto* o = root_.child("MPMHeader")->child("Output"))
    for (const char* name : {"fields", "grid"})
      must(!has(*o, name), o->origin,
           "files of blocks always contain all fields; leave out '" + std::string(name) + "' out");
  must(model_.analysis != Analysis::axisymmetric, root_.child("Header")->child("Analysis")->origin,
       "blocks are plane or three-dimensional, not axisymmetric");
  if (const auto* g = root_.child("Gravity"))
    for (const auto& s : g->children)
      must(s.name.rfind("Body", 0) == 0, s.origin,
           "<" + s.name +
               "> belongs to grids and particles; blocks have constant gravity, <BodyXForce>, <BodyYForce>, "
               "<BodyZForce>");
}

// Blocks coupled to a grid interact with its bodies by nodal contact.
void Builder::blocks_in_grid(const BlocksSpec& spec) {
  const Statement& s = *root_.child("Blocks");
  must(model_.analysis != Analysis::axisymmetric, root_.child("Header")->child("Analysis")->origin,
       "blocks are plane or three-dimensional, not axisymmetric");
  must(model_.contact.active, s.origin,
       "blocks coupled to a grid need <MultiMaterialMode> in <MPMHeader>, which enables contact with its bodies");
  must(!spec.quasi_static, s.origin,
       "'quasistatic' scales the masses of blocks, but the bodies of the grid need the true masses");
  must(!has(s, "thickness") || spec.thickness == model_.grid.thickness, s.origin,
       "with a grid the thickness is that of the grid; leave 'thickness' out");
  if (const auto* g = root_.child("Gravity"))
    for (const auto& f : model_.body_force.function)
      must(!f, g->origin,
           "gravity that is a function does not act on blocks; use <BodyXForce>, <BodyYForce>, <BodyZForce>");
  for (const auto& [pair, joint] : model_.contact.joints)
    for (const auto& group : spec.groups)
      must(group.material != pair.first && group.material != pair.second, joint.origin,
           "a joint law between blocks and bodies of the grid is not implemented; use a contact law");
}

// The RigidContact material by which blocks interact with the bodies of a grid.
int Builder::block_material(const Statement& s) {
  if (!has(s, "matname") && !has(s, "mat")) {
    must(!in_grid(), s.origin,
         "with a grid <" + s.name +
             "> needs 'matname', a material of Type='RigidContact' for contact with other materials");
    return -1;
  }
  must(in_grid(), s.origin, "'mat' and 'matname' belong to blocks coupled to a grid");
  const int found = material(s);
  if (found < 0 || found >= static_cast<int>(model_.materials.size())) return -1;
  const MaterialSpec& spec = model_.materials[static_cast<std::size_t>(found)];
  if (has(s, "matname") && spec.name != word(s, "matname")) return -1;  // material() has reported the problem
  const bool moves =
      std::any_of(spec.rigid_velocity.begin(), spec.rigid_velocity.end(), [](const auto& v) { return v.has_value(); });
  must(spec.law && spec.law->rigid() && spec.touches(), s.origin,
       "'" + spec.name + "' is not a material of Type='RigidContact'");
  must(!moves, s.origin, "'" + spec.name + "' has a prescribed motion; blocks move by the forces on them or by <Hold>");
  return found;
}

void Builder::blocks() {
  const Statement& s = *root_.child("Blocks");
  auto spec = std::make_shared<BlocksSpec>();
  spec->origin = s.origin, spec->in_grid = in_grid();
  spec->thickness = number(s, "thickness", Dimension::length, in_grid() ? model_.grid.thickness : 1.0);
  spec->local_damping = number(s, "damping", Dimension::none);
  spec->stress_iterations = static_cast<int>(number(s, "iterations", Dimension::none));
  spec->quasi_static = yes(word(s, "quasistatic"));
  spec->step_share = number(s, "step", Dimension::none, 0.8);
  const bool solid = model_.dimension() == 3;
  must(spec->thickness > 0, s.origin, "the thickness must be positive");
  must(!solid || !has(s, "thickness"), s.origin, "'thickness' belongs to plane models");
  must(spec->local_damping >= 0 && spec->local_damping < 1, s.origin, "'damping' must be in [0, 1)");
  must(spec->stress_iterations >= 0 && spec->stress_iterations <= 20, s.origin, "'iterations' must be in 0 ... 20");
  must(spec->step_share > 0 && spec->step_share <= 1, s.origin, "'step' must be in (0, 1]");
  const Statement& header = *root_.child("MPMHeader");
  const auto* timing = header.child("Timing");
  must(!spec->quasi_static || header.child("TimeStep") || (timing && has(*timing, "step")), s.origin,
       "with 'quasistatic' the time step must be chosen: give <TimeStep>");
  must(!spec->quasi_static || !has(s, "step"), s.origin,
       "with 'quasistatic' the attribute 'step' has no meaning; the time step is <TimeStep>");

  constexpr std::array velocities{"vx", "vy", "vz"}, spins{"spinx", "spiny", "spinz"};
  for (const auto& part : s.children) {
    const auto all = [&](const std::array<const char*, 3>& names, Dimension dimension, auto& to, double factor = 1.0) {
      for (std::size_t d = 0; d < 3; ++d) {
        to[d] = time_function(part, names[d], dimension, factor);
        const bool out_of_plane = !solid && (names[0][0] == 's' || names[0][0] == 'M' ? d < 2 : d == 2);
        must(!out_of_plane || !to[d], part.origin,
             "'" + std::string(names[d]) + "' leaves the plane of the two-dimensional model");
      }
    };
    if (part.name == "Joint") {
      continue;  // rules refer to all blocks, and are read when these are known
    } else if (part.name == "Platen") {
      BlockPlaten p{word(part, "name"), shapes_of(part), {}, yes(word(part, "rough")), 0.0, part.origin};
      p.modulus = number(part, "E", Dimension::stress);
      if (const Attribute* given = part.attribute("E")) must(p.modulus > 0, given->origin, "'E' must be positive");
      all(velocities, Dimension::velocity, p.velocity);
      spec->platens.push_back(std::move(p));
    } else if (part.name == "Pressure") {
      BlockPressure p{shapes_of(part), {}, !has(part, "follows") || yes(word(part, "follows")), part.origin};
      if (const auto value = time_function(part, "value", Dimension::stress)) p.pressure = *value;
      spec->pressures.push_back(std::move(p));
    } else if (part.name == "Hold") {
      BlockHold h{of_named_blocks(part), {}, {}, part.origin};
      all(velocities, Dimension::velocity, h.velocity), all(spins, Dimension::rate, h.spin);
      spec->holds.push_back(std::move(h));
    } else if (part.name == "Load") {
      BlockLoad l{of_named_blocks(part), {}, {}, part.origin};
      all({"Fx", "Fy", "Fz"}, Dimension::force, l.force);
      all({"Mx", "My", "Mz"}, Dimension::force, l.moment, model_.units.factor(Dimension::length));
      spec->loads.push_back(std::move(l));
    } else {
      spec->groups.push_back(block_group(part));
      surfaces_.push_back(block_surface(part));
    }
  }
  name_blocks(s, *spec);
  must(!spec->groups.empty(), s.origin, "<Blocks> has no block; give <Voronoi>, <BoxBlock>, <PolygonBlock> or <Ball>");
  block_joints(s, *spec);
  block_histories(*spec);
  if (in_grid()) blocks_in_grid(*spec);

  // Poisson's ratio is modelled by the fictitious stress.
  double nu = 0;
  for (const auto& m : model_.materials) {
    if (!m.joint || m.joint->poisson() == 0) continue;
    nu = m.joint->poisson();
    must(model_.analysis == Analysis::plane_stress || nu < 0.5, m.origin,
         "Poisson's ratio of '" + m.name +
             "' must be below 0.5: in plane strain and three dimensions the fictitious stress diverges at 0.5");
  }
  if (nu > 0 && spec->local_damping == 0)
    warn(s.origin,
         "Poisson's ratio uses the stress of the preceding step, which excites vibrations: without damping they grow "
         "without bound. Give 'damping' (0.05 for dynamics, 0.7 for static equilibrium) and, if needed, "
         "'iterations'='1'");
  model_.blocks = std::move(spec);
}

std::shared_ptr<const JointLaw> Builder::joint_of(const Statement& s) {
  if (!has(s, "lawname") && !has(s, "law")) {
    problems_.add(s.origin, "<" + s.name + "> needs 'lawname', the name of a joint law (SpringNetwork, Mohr)");
    return nullptr;
  }
  const MaterialSpec* found = named_law(s);
  if (!found) return nullptr;
  must(found->joint != nullptr || tribo::joint_laws().find(found->type) != nullptr, s.origin,
       "'" + found->name + "' is the contact law " + found->type +
           ", which serves grids only; contacts of blocks need a joint law: SpringNetwork or Mohr");
  must(!found->joint || found->joint->user_areas().size() <= 1, s.origin,
       "<user_area> of '" + found->name + "' has an area for each point of a crack; contacts of blocks take one area");
  return found->joint;
}

// The shapes of a <Hold> or <Load>; null if it chooses blocks by their names only.
RegionPtr Builder::of_named_blocks(const Statement& s) {
  return has(s, "blocks") && s.children.empty() ? nullptr : shapes_of(s);
}

// The names refer to all blocks, which are known only now.
void Builder::name_blocks(const Statement& s, BlocksSpec& spec) {
  std::size_t hold = 0, load = 0;
  for (const auto& part : s.children) {
    if (part.name == "Hold") spec.holds[hold++].groups = block_groups(part, "blocks", spec);
    if (part.name == "Load") spec.loads[load++].groups = block_groups(part, "blocks", spec);
  }
}

RegionPtr Builder::shapes_of(const Statement& s) {
  std::vector<RegionPtr> shapes;
  for (const auto& child : s.children) {
    must((child.name != "Line" && child.name != "Arc") || has(child, "tolerance"), child.origin,
         "<" + child.name + "> needs 'tolerance': without a grid there is no default, which is in cells");
    shapes.push_back(shape(child));
  }
  if (!shapes.empty()) return shapes.size() == 1 ? shapes.front() : unite(std::move(shapes));
  problems_.add(s.origin, "<" + s.name + "> has no shape that selects blocks or faces");
  return rectangle(0, 0, 0, 0);
}

std::optional<TimeFunction> Builder::time_function(const Statement& s, const char* attribute, Dimension dimension,
                                                   double factor) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return std::nullopt;
  return TimeFunction{function(a->text, a->origin, "'" + a->name + "' of <" + s.name + ">"),
                      model_.units.alternative_time(), model_.units.factor(dimension) * factor};
}

SurfaceProperties Builder::block_surface(const Statement& s) {
  const auto value = [&](const char* name, Dimension dimension) -> std::optional<double> {
    if (!has(s, name)) return std::nullopt;
    const double given = number(s, name, dimension);
    must(given >= 0, s.origin, "'" + std::string(name) + "' must not be negative");
    return given;
  };
  return {value("kn", Dimension::interface_stiffness), value("ks", Dimension::interface_stiffness),
          value("fric", Dimension::none)};
}

BlockGroup Builder::block_group(const Statement& s) {
  using Shape = BlockGroup::Shape;
  BlockGroup g;
  g.origin = s.origin, g.name = word(s, "name");
  g.density = number(s, "rho", Dimension::density, 1.0);
  g.material = block_material(s);
  must(g.density > 0, s.origin, "the density must be positive");
  const bool solid = model_.dimension() == 3;
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto i = static_cast<Eigen::Index>(d);
    const std::string x = axes[d];
    g.velocity[i] = number(s, "v" + x, Dimension::velocity), g.spin[i] = number(s, "spin" + x, Dimension::rate);
    g.low[i] = number(s, x + "min", Dimension::length), g.high[i] = number(s, x + "max", Dimension::length);
    for (const char* end : {"min", "max"}) {
      must(d < 2 || solid || !has(s, x + end), s.origin, "'" + x + end + "' belongs to three-dimensional models");
      must(d < 2 || !solid || s.name == "Ball" || has(s, x + end), s.origin,
           "<" + s.name + "> needs '" + x + end + "' in three dimensions");
    }
  }
  must(solid || (g.velocity[2] == 0 && g.spin[0] == 0 && g.spin[1] == 0), s.origin,
       "this motion leaves the plane of the two-dimensional model");
  g.angle = number(s, "angle", Dimension::angle);
  const auto point = [&](const Statement& pt) {
    g.points.emplace_back(coordinate(pt, "x", 0), coordinate(pt, "y", 1), solid ? coordinate(pt, "z", 2) : 0.0);
    g.point_origins.push_back(pt.origin);
  };
  if (s.name == "Ball") {
    g.shape = Shape::ball;
    g.radius = number(s, "radius", Dimension::length);
    must(g.radius > 0, s.origin, "the radius must be positive");
    g.points.emplace_back(number(s, "x", Dimension::length), number(s, "y", Dimension::length),
                          solid ? number(s, "z", Dimension::length) : 0.0);
    return g;
  }
  if (s.name == "PolygonBlock") {
    g.shape = Shape::polygon;
    must(!solid, s.origin, "<PolygonBlock> belongs to plane models; in three dimensions use <BoxBlock> or <Voronoi>");
    for (const auto& pt : s.children) point(pt);
    return g;
  }
  for (Eigen::Index d = 0; d < model_.dimension(); ++d)
    must(g.high[d] > g.low[d], s.origin,
         std::string(axes[static_cast<std::size_t>(d)]) + "max must be larger than " +
             axes[static_cast<std::size_t>(d)] + "min");
  g.shape = s.name == "Voronoi" ? Shape::voronoi : Shape::brick;
  if (g.shape == Shape::brick) return g;
  for (const auto& pt : s.children) point(pt);
  nuclei(s, g);
  return g;
}

void Builder::block_histories(BlocksSpec& spec) {
  using Of = BlockQuantityInfo::Of;
  for (const auto& s : root_.child("MPMHeader")->children) {
    if (s.name != "GlobalArchive" || (in_grid() && !archives_blocks(s))) continue;
    BlockHistory h;
    h.column = h.name = word(s, "type");
    for (const auto& a : s.attributes)
      must(a.name == "type" || a.name == "platen" || a.name == "block", a.origin,
           "'" + a.name + "' belongs to grids and particles; in models of blocks use 'platen' or 'block'");
    const auto find = [&](const char* attribute, const auto& list) {
      const Attribute* a = s.attribute(attribute);
      if (!a) return -1;
      h.column += ":" + a->text;
      std::vector<std::string> names;
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (list[k].name == a->text) return static_cast<int>(k);
        if (!list[k].name.empty()) names.push_back(list[k].name);
      }
      problems_.add(a->origin, "there is no " + std::string(attribute) + " '" + a->text + "'" +
                                   did_you_mean(a->text, names) +
                                   (names.empty() ? "; none of them has a name" : "; valid: " + join(names)));
      return -1;
    };
    h.platen = find("platen", spec.platens), h.group = find("block", spec.groups);
    must(!has(s, "platen") || !has(s, "block"), s.origin, "give 'platen' or 'block'");
    const Of of = has(s, "platen") ? Of::platen : has(s, "block") ? Of::block : Of::run;
    const auto* info = find_block_quantity(h.name, of);
    if (!info) {
      std::vector<std::string> names;
      for (const auto& q : block_quantities())
        if (q.of == of) names.emplace_back(q.name);
      problems_.add(s.attribute("type")->origin, "'" + h.name + "' is not a quantity " +
                                                     (of == Of::platen  ? "of a platen"
                                                      : of == Of::block ? "of blocks"
                                                                        : "of the run") +
                                                     did_you_mean(h.name, names) + "; valid: " + join(names));
      continue;
    }
    h.name = info->name;
    spec.histories.push_back(std::move(h));
  }
}

}  // namespace tribo
