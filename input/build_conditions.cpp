// SPDX-License-Identifier: MIT
/// GridBCs, ParticleBCs, Thermal and Gravity.

#include "input/builder.hpp"
#include "input/common_properties.hpp"

#include "materials/material.hpp"

#include <cmath>
#include <numbers>

namespace tribo {
namespace {

bool on_nodes(const Statement& s) { return s.name == "DisBC" || s.name == "TempBC"; }
bool on_particles(const Statement& s) { return s.name == "LoadBC" || s.name == "TractionBC" || s.name == "HeatFluxBC"; }
bool needs_three_dimensions(DomainFace face) { return face == DomainFace::low_z || face == DomainFace::high_z; }

}  // namespace

void Builder::conditions() {
  if (const auto* grid = root_.child("GridBCs"))
    for (const auto& s : grid->children) selector(s, true);
  if (const auto* particles = root_.child("ParticleBCs"))
    for (const auto& s : particles->children) selector(s, false);
}

void Builder::selector(const Statement& s, bool grid) {
  const RegionPtr where = selected(s);
  bool any = false, net = false;
  for (const auto& child : s.children) {
    if (child.name == "net" || child.name == "perParticle") {
      must(!grid, child.origin, "<" + child.name + "> is about loads and belongs into <ParticleBCs>");
      net = child.name == "net";
    }
    if (!on_nodes(child) && !on_particles(child)) continue;
    any = true;
    must(grid == on_nodes(child), child.origin,
         "<" + child.name + "> belongs into <" + (on_nodes(child) ? "GridBCs" : "ParticleBCs") + ">");
    if (grid != on_nodes(child)) continue;
    if (child.name == "DisBC") node_condition(child, where);
    if (child.name == "TempBC") temperature_condition(child, where);
    if (child.name == "HeatFluxBC") heat_flux(child, where);
    if (child.name == "LoadBC" || child.name == "TractionBC") particle_condition(child, where, net);
  }
  must(any, s.origin, "<" + s.name + "> selects " + (grid ? "nodes" : "particles") + " but sets nothing");
}

RegionPtr Builder::selected(const Statement& s) {
  if (s.name != "BCShape" && s.name != "LdShape") return placed(s, [&] { return plain_shape(s); });
  std::vector<RegionPtr> shapes;
  for (const auto& child : s.children)
    if (!on_nodes(child) && !on_particles(child) && child.name != "net" && child.name != "perParticle")
      shapes.push_back(shape(child));
  if (shapes.empty()) {
    problems_.add(s.origin, "<" + s.name + "> has no shape");
    return rectangle(0, 0, 0, 0);
  }
  return shapes.size() == 1 ? shapes.front() : unite(std::move(shapes));
}

Prescribed Builder::prescribed(const Statement& s, std::string_view value, Dimension dimension) {
  Prescribed p;
  if (const Style* known = style_of(word(s, "style", has(s, "function") ? "function" : "constant"))) p.style = known;
  must(!p.style->motion || s.name == "TractionBC", s.origin,
       "style '" + word(s, "style", "") + "' depends on the motion of a surface; it is for <TractionBC> only");
  const double alternative = model_.units.alternative_time();
  const double time = number(s, has(s, "time") ? "time" : "ftime", Dimension::none);
  p.time = p.style->time == Style::Time::start ? time * alternative : time / alternative;
  p.value = number(s, value, dimension);
  if (p.style->per == Dimension::time) p.value /= alternative;
  if (p.style->per == Dimension::length) p.value /= model_.units.factor(Dimension::length);
  must(!p.style->elastic || p.value >= 0, s.origin, "the stiffness of an elastic support must not be negative");
  if (p.style->function) {
    if (const auto f = function(s, "function"))
      p.function = *f;
    else
      problems_.add(s.origin, "style 'function' needs the attribute 'function'");
    p.function_time = alternative;
    p.function_scale = model_.units.factor(dimension);
  } else {
    must(!has(s, "function"), s.origin, "'function' has an effect with style 'function' (6) only");
  }
  return p;
}

void Builder::node_condition(const Statement& s, const RegionPtr& where) {
  NodeCondition c;
  c.where = where;
  c.origin = s.origin;
  const std::string dir = word(s, "dir", "1");
  const double angle = number(s, "angle", Dimension::angle), angle2 = number(s, "angle2", Dimension::angle);
  // Inclined directions are rotated clockwise from the first axis, as in NairnMPM
  if (dir == "1") c.direction = Vec3::UnitX();
  if (dir == "2") c.direction = Vec3::UnitY();
  if (dir == "3") c.direction = Vec3::UnitZ();
  if (dir == "12") c.direction = Vec3(std::cos(angle), -std::sin(angle), 0);
  if (dir == "13") c.direction = Vec3(std::cos(angle), 0, -std::sin(angle));
  if (dir == "23") c.direction = Vec3(0, std::cos(angle), -std::sin(angle));
  if (dir == "123")
    c.direction = Vec3(std::cos(angle) * std::sin(angle2), -std::sin(angle) * std::sin(angle2), std::cos(angle2));
  must(model_.dimension() == 3 || dir.find('3') == std::string::npos, s.origin,
       "direction " + dir + " needs a three-dimensional model");
  must(!(has(s, "vel") && has(s, "disp")), s.origin, "give only one of 'vel' and 'disp', which have the same meaning");
  c.velocity = prescribed(s, has(s, "vel") ? "vel" : "disp", Dimension::velocity);
  c.wall = moving_wall(s, dir);
  c.id = static_cast<int>(number(s, "id", Dimension::none));
  must(c.id <= 0, s.origin, "the id of a condition must be 0 or negative");
  model_.node_conditions.push_back(std::move(c));
}

std::optional<MovingWall> Builder::moving_wall(const Statement& s, const std::string& dir) {
  if (!has(s, "depth")) {
    for (const char* of_walls : {"gradfxn", "dispfxn"})
      must(!has(s, of_walls), s.origin,
           std::string("'") + of_walls + "' belongs to a moving wall, which 'depth' makes of a condition");
    return std::nullopt;
  }
  MovingWall wall;
  const double depth = number(s, "depth", Dimension::none);
  wall.side = depth < 0 ? -1 : 1, wall.depth = std::abs(depth);
  must(dir.size() == 1, s.origin, "a moving wall is normal to an axis: dir 1, 2 or 3");
  must(wall.depth <= 1000, s.origin, "the depth of a moving wall is a number of cells, at most 1000");
  wall.function_time = model_.units.alternative_time(), wall.length_unit = model_.units.factor(Dimension::length);
  if (const auto f = function(s, "dispfxn")) wall.displacement = *f;
  wall.mirror = word(s, "gradfxn", "") == "mirror";
  if (wall.mirror) return wall;
  if (const auto f = function(s, "gradfxn")) wall.gradient = *f;
  return wall;
}

DomainFace Builder::face_of(const Statement& s) {
  return static_cast<DomainFace>(static_cast<int>(number(s, "face", Dimension::none)));
}

void Builder::particle_condition(const Statement& s, const RegionPtr& where, bool net) {
  ParticleCondition c;
  c.where = where;
  c.origin = s.origin;
  const bool traction = s.name == "TractionBC";
  c.kind = traction ? ParticleCondition::Kind::traction : ParticleCondition::Kind::force;
  const int dir = static_cast<int>(number(s, "dir", Dimension::none, 1));
  // directions 1, 2, 3 are axes; of tractions, 11 is normal and 12 tangential
  c.direction = dir == 11   ? LoadDirection::normal
                : dir == 12 ? LoadDirection::tangential
                            : static_cast<LoadDirection>(dir - 1);
  if (traction) c.face = face_of(s);
  c.net = net && !traction;
  must(model_.dimension() == 3 || (dir != 3 && !needs_three_dimensions(c.face)), s.origin,
       "this direction or face needs a three-dimensional model");
  must(model_.dimension() == 2 || dir != 12, s.origin,
       "shear traction (12) is for two-dimensional models; give 1, 2 or 3");
  c.value = prescribed(s,
                       traction         ? "stress"
                       : has(s, "load") ? "load"
                                        : "value",
                       traction ? Dimension::stress : Dimension::force);
  model_.particle_conditions.push_back(std::move(c));
}

void Builder::temperature_condition(const Statement& s, const RegionPtr& where) {
  TemperatureCondition c{where, prescribed(s, "value", Dimension::temperature), s.origin};
  model_.temperature_conditions.push_back(std::move(c));
}

void Builder::heat_flux(const Statement& s, const RegionPtr& where) {
  ParticleCondition c;
  c.kind = ParticleCondition::Kind::heat_flux;
  c.where = where;
  c.origin = s.origin;
  c.face = face_of(s);
  must(model_.dimension() == 3 || !needs_three_dimensions(c.face), s.origin,
       "this face needs a three-dimensional model");
  must(word(s, "dir", "1") == "1", s.attribute("dir") ? s.attribute("dir")->origin : s.origin,
       "a heat flux that depends on the temperature of the particle (coupled, direction 2) is not implemented; give "
       "the flux as a function of t, x, y and z (external, direction 1)");
  c.value = prescribed(s, "value", Dimension::heat_flux);
  model_.particle_conditions.push_back(std::move(c));
}

void Builder::heat() {
  const auto* thermal = root_.child("Thermal");
  HeatSpec& heat = model_.heat;
  heat.conduction = thermal && thermal->child("Conduction");
  heat.contact_heating = thermal && thermal->child("ContactHeating");
  heat.work_heating = work_heating();
  check_capacities(thermal);
  if (!heat.conduction) {
    constexpr std::string_view missing = " needs <Conduction/> in <Thermal>";
    if (heat.contact_heating)
      problems_.add(thermal->child("ContactHeating")->origin, "<ContactHeating>" + std::string(missing));
    for (const auto& c : model_.temperature_conditions) problems_.add(c.origin, "<TempBC>" + std::string(missing));
    for (const auto& c : model_.particle_conditions)
      must(c.kind != ParticleCondition::Kind::heat_flux, c.origin, "<HeatFluxBC>" + std::string(missing));
    return;
  }
  must(!heat.contact_heating || model_.contact.active, thermal->origin,
       "<ContactHeating> needs contact, <MultiMaterialMode> in <MPMHeader>");
}

// Decides whether particles have temperatures, and checks the heat properties of the materials.
void Builder::check_capacities(const Statement* thermal) {
  HeatSpec& heat = model_.heat;
  const bool needs_capacity = heat.conduction || heat.work_heating;
  const auto differs = [&](const std::optional<double>& t) { return t && *t != heat.reference; };
  const bool changes =
      needs_capacity || !heat.ramps.empty() ||
      std::any_of(model_.pieces.begin(), model_.pieces.end(), [&](const Piece& p) { return differs(p.temperature); }) ||
      std::any_of(model_.points.begin(), model_.points.end(),
                  [&](const PointSpec& p) { return differs(p.temperature); }) ||
      std::any_of(model_.tables.begin(), model_.tables.end(), [&](const ParticleTable& t) {
        return differs(t.temperature) ||
               std::any_of(t.temperatures.begin(), t.temperatures.end(), [&](double value) { return differs(value); });
      });
  heat.kept = needs_capacity || !heat.ramps.empty();
  for (const auto& m : model_.materials) {
    if (!m.law || m.law->rigid()) continue;
    heat.kept |= m.law->feels_temperature();
    if (needs_capacity)
      must(m.heat_capacity > 0, m.origin,
           std::string(heat.conduction ? "<Conduction>" : "<EnergyCoupling>") + " needs the heat capacity of '" +
               m.name + "': <Cv>");
    for (const Statement& property : m.statement.children)
      must(!changes || !of_anisotropic_expansion(property.name) || to_number(property.text) == 0.0, property.origin,
           "thermal expansion of anisotropic materials is not implemented; at a constant temperature, or with 0, the "
           "model runs");
    if (!changes || m.expansion == 0.0) continue;
    heat.expansion = heat.kept = true;
    must(keeps_stress(*m.law), m.statement.child("alpha")->origin,
         "thermal expansion is implemented for laws with an incremental stress; the stress of '" + m.name +
             "' is a function of its deformation. With <alpha>0</alpha> the model runs");
  }
  const auto dissipates = [](const MaterialSpec& m) { return m.law && m.law->dissipation_index() >= 0; };
  if (heat.work_heating && std::none_of(model_.materials.begin(), model_.materials.end(), dissipates))
    problems_.warn(thermal->child("EnergyCoupling")->origin,
                   "<EnergyCoupling> converts dissipated work to heat, but none of these materials dissipates: it has "
                   "no effect");
}

void Builder::gravity() {
  const auto* g = root_.child("Gravity");
  if (!g) return;
  constexpr std::array constants{"BodyXForce", "BodyYForce", "BodyZForce"},
      functions{"GridBodyXForce", "GridBodyYForce", "GridBodyZForce"},
      on_particles{"ParticleBodyXForce", "ParticleBodyYForce", "ParticleBodyZForce"};
  model_.body_force.function_time = model_.units.alternative_time();
  for (std::size_t d = 0; d < 3; ++d) {
    if (const auto* s = g->child(constants[d])) {
      model_.body_force.gravity[static_cast<Eigen::Index>(d)] = text_number(*s, Dimension::acceleration);
      must(d < 2 || model_.dimension() == 3 || model_.body_force.gravity[2] == 0, s->origin,
           "a force along z needs a three-dimensional model");
    }
    if (const auto* s = g->child(functions[d]))
      model_.body_force.function[d] = function(s->text, s->text_origin, "<" + s->name + ">");
    if (const auto* s = g->child(on_particles[d]))
      model_.body_force.on_particles[d] = particle_function(s->text, s->text_origin, "<" + s->name + ">");
  }
}

}  // namespace tribo
