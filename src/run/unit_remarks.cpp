// SPDX-License-Identifier: MIT
#include "run/unit_remarks.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

constexpr double earth = 9.80665;  // m/s^2

// Factor to m, kg and s for these powers of length, mass and time; none if one of the units has no name.
std::optional<double> factor_to_si(const Units& units, int length, int mass, int time) {
  const auto l = units.size_in_si(Dimension::length), m = units.size_in_si(Dimension::mass),
             t = units.size_in_si(Dimension::time);
  if (!l || !m || !t) return std::nullopt;
  return std::pow(*l, length) * std::pow(*m, mass) * std::pow(*t, time);
}

// Gravity at the end of the run, in the middle of the grid where it is a function.
Vec3 gravity_at_end(const Model& model) {
  Vec3 out = model.body_force.gravity, middle = Vec3::Zero();
  for (std::size_t d = 0; d < static_cast<std::size_t>(model.dimension()); ++d)
    middle[static_cast<Eigen::Index>(d)] = 0.5 * (model.grid.low[d] + model.grid.high[d]);
  const auto at = Variables::at(middle, model.time.end / model.body_force.function_time);
  for (std::size_t d = 0; d < 3; ++d) try {
      if (const auto& f = model.body_force.function[d]) out[static_cast<Eigen::Index>(d)] += (*f)(at);
    } catch (const SimulationError&) {  // no value there or then: nothing can be said
    }
  return out;
}

// What is said of solids does not hold for liquids and gases.
bool solid(const MaterialSpec& m) {
  return m.law && !m.law->rigid() && !m.law->liquid() && m.type != "IdealGas" && m.law->wave_modulus() > 0;
}

// Dense and slow at once is a density in a wrong unit; models without units often have a density and a modulus of 1.
// Solids as dense as metals have moduli of GPa: less is a modulus in GPa where MPa are expected.
void unusual_waves(const Model& model, const MaterialSpec& m, std::vector<std::string>& out) {
  constexpr double fastest = 2e4, slowest = 8, densest = 1e5;  // m/s and kg/m^3
  constexpr double metal = 3000, slowest_metal = 500;
  const auto speed_unit = factor_to_si(model.units, 1, 0, -1), density_unit = factor_to_si(model.units, -3, 1, 0);
  if (!speed_unit || !density_unit) return;
  const double speed = *speed_unit * std::sqrt(m.law->wave_modulus() / m.law->density());
  const double density = *density_unit * m.law->density();
  const bool soft_metal = density > metal && density < densest && speed > slowest && speed < slowest_metal;
  if (speed > fastest || (speed < slowest && density > densest) || soft_metal)
    out.push_back(
        format("the wave speed of '%s' is %.3g m/s at a density of %.3g kg/m^3, unusual for a solid: check the units "
               "of its density and its moduli",
               m.name.c_str(), speed, density));
}

// Densities of solids in g/cm^3 where kg/m^3 are expected. Models with moduli of the order of 1 have no real material.
void low_density(const Model& model, const MaterialSpec& m, std::vector<std::string>& out) {
  constexpr double lightest = 20, real = 1e4;  // kg/m^3 and Pa
  const auto density_unit = factor_to_si(model.units, -3, 1, 0), stress_unit = factor_to_si(model.units, -1, 1, -2);
  if (!density_unit || !stress_unit || *stress_unit * m.law->wave_modulus() < real) return;
  const double density = *density_unit * m.law->density();
  if (density < lightest)
    out.push_back(format("the density of '%s' is %.3g kg/m^3, less than that of the lightest foams: check its unit",
                         m.name.c_str(), density));
}

// The number that a statement of a material gives for a property; none if it gives none.
std::optional<double> property(const MaterialSpec& m, std::string_view name) {
  for (const Statement& child : m.statement.children)
    if (child.name == name) return to_number(child.text);
  return std::nullopt;
}

void unusual_properties(const MaterialSpec& m, std::vector<std::string>& out) {
  constexpr double least_expansion = 0.01;  // 10^-6/K; silica glass has 0.5
  constexpr double strongest = 0.3;         // of Young's modulus; ideal crystals have 0.1
  constexpr double incompressible = 0.499;  // the longitudinal waves are then 13 times as fast as the shear waves
  for (const char* name : {"alpha", "alphaA", "alphaT", "alphax", "alphay", "alphaz"})
    if (const auto alpha = property(m, name); alpha && *alpha > 0 && *alpha < least_expansion)
      out.push_back(format("the thermal expansion of '%s', %s %g, is in 10^-6 per kelvin: %g per kelvin would be %g",
                           m.name.c_str(), name, *alpha, *alpha, *alpha * 1e6));
  const auto young = property(m, "E"), yield = property(m, "yield"), poisson = property(m, "nu");
  if (young && yield && *young > 0 && *yield > strongest * *young)
    out.push_back(format("the yield stress of '%s' is %.3g times its Young's modulus: check their units",
                         m.name.c_str(), *yield / *young));
  if (poisson && *poisson > incompressible && *poisson < 0.5)
    out.push_back(format(
        "'%s' is nearly incompressible (nu %g): its pressure waves are %.3g times as fast as its shear "
        "waves and determine the time step, and its cells become too stiff without the B-bar method (tribo doc BBar)",
        m.name.c_str(), *poisson, std::sqrt((2 - 2 * *poisson) / (1 - 2 * *poisson))));
}

template <class Law>
bool is_friction_angle(const Law* law, const std::string& property) {
  return law && std::any_of(law->parameters.begin(), law->parameters.end(), [&](const ParameterInfo& p) {
           return p.name == property && p.dimension == Dimension::angle &&
                  p.meaning.find("friction") != std::string::npos;
         });
}

void small_angles(const MaterialSpec& m, std::vector<std::string>& out) {
  for (const Statement& child : m.statement.children) {
    const double value = to_number(child.text).value_or(0.0);
    const bool angle = is_friction_angle(materials().find(m.type), child.name) ||
                       is_friction_angle(contact_laws().find(m.type), child.name) ||
                       is_friction_angle(joint_laws().find(m.type), child.name);
    if (angle && value > 0 && value < 1)
      out.push_back("the friction angle of '" + m.name + "', " + child.name + " " + child.text +
                    ", is below one degree: angles are in degrees, not in radians");
  }
}

void angles_as_coefficients(const MaterialSpec& m, std::vector<std::string>& out) {
  constexpr double rough = 3;  // no faces have a larger coefficient of friction
  if (!contact_laws().find(m.type)) return;
  for (const Statement& child : m.statement.children) {
    const double value = to_number(child.text).value_or(0.0);
    if ((child.name == "coeff" || child.name == "coeffStatic") && value > rough && value < 90)
      out.push_back("the friction coefficient of '" + m.name + "', " + child.name + " " + child.text +
                    format(", looks like an angle: the coefficient of %.6g degrees is %.3g", value,
                           std::tan(value * std::acos(-1.0) / 180)));
  }
}

// The extent of the particles of a material along a direction.
struct HeightRange {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  bool empty() const { return !(low <= high); }
};

std::vector<HeightRange> extents_along(const Vec3& direction, const Seeds& seeds, std::size_t materials) {
  std::vector<HeightRange> out(materials);
  for (const Seed& seed : seeds) {
    HeightRange& of = out[static_cast<std::size_t>(seed.material)];
    of.low = std::min(of.low, direction.dot(seed.x)), of.high = std::max(of.high, direction.dot(seed.x));
  }
  return out;
}

void own_weight(const MaterialSpec& m, double gravity, const HeightRange& height, std::vector<std::string>& out) {
  constexpr double much = 0.3;  // of the stiffness
  const double share = m.law->density() * gravity * (height.high - height.low) / m.law->wave_modulus();
  if (share > much)
    out.push_back(format(
        "'%s' is too soft for its own weight: density times gravity times its height is %.2g times its modulus of "
        "compression; check the units of its density, its moduli and of gravity",
        m.name.c_str(), share));
}

}  // namespace

std::string line_of_units(const Model& model) {
  std::string out = "units: " + model.units.name(Dimension::length) + ", " + model.units.name(Dimension::mass) + ", " +
                    model.units.name(Dimension::time) + "; stress " + model.units.name(Dimension::stress);
  if (model.units.legacy)
    out +=
        "; without <ConsistentUnits> the numbers of the file are in legacy units: mm, g/cm^3, MPa and N, and ms for "
        "times in functions and scripts";
  return out;
}

std::string words_of_gravity(const Model& model) {
  constexpr std::array axis_names{'x', 'y', 'z'};
  const BodyForce& force = model.body_force;
  std::vector<std::string> parts;
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = force.gravity[static_cast<Eigen::Index>(d)];
    if (g == 0) continue;
    const char* word = model.dimension() == 3 ? "" : d == 1 ? (g < 0 ? "down " : "up ") : (g < 0 ? "left " : "right ");
    parts.push_back(word + format("%.6g (along %c%c)", std::abs(g), g < 0 ? '-' : '+', axis_names[d]));
  }
  const auto functions = [&](const auto& list, const char* what) {
    for (std::size_t d = 0; d < 3; ++d)
      if (list[d]) parts.push_back(format("a function along %c%s", axis_names[d], what));
  };
  functions(force.function, "");
  functions(force.on_particles, " on particles");
  return parts.empty() ? "none" : join(parts, ", ");
}

std::vector<std::string> remarks_on_gravity(const Model& model) {
  std::vector<std::string> out;
  const Vec3 gravity = gravity_at_end(model);
  if (model.dimension() == 2 && gravity[1] > 0 && gravity[0] == 0)
    out.push_back(format("gravity acts upwards: it is %.6g along y, and a negative number points down", gravity[1]));
  const auto unit = factor_to_si(model.units, 1, 0, -2);
  if (gravity.isZero() || !unit) return out;
  const double ratio = *unit * gravity.norm() / earth, powers = std::round(std::log10(ratio));
  const bool digits = std::abs(ratio / std::pow(10, powers) - 1) < 0.004;
  if (digits && (powers < 0 || powers > 2))  // a centrifuge has up to some hundred times the gravity of the earth
    out.push_back(format("gravity is %.6g %s, which is %.3g m/s^2: 9.81 m/s^2 are %.6g in these units", gravity.norm(),
                         model.units.name(Dimension::acceleration).c_str(), *unit * gravity.norm(), 9.81 / *unit));
  return out;
}

std::vector<std::string> remarks_on_units(const Model& model, const Seeds& seeds) {
  std::vector<std::string> out = remarks_on_gravity(model);
  const Vec3 gravity = gravity_at_end(model);
  const auto heights = extents_along(gravity.normalized(), seeds, model.materials.size());
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    const MaterialSpec& m = model.materials[k];
    small_angles(m, out), angles_as_coefficients(m, out);
    if (heights[k].empty() || !solid(m)) continue;
    unusual_waves(model, m, out), low_density(model, m, out), unusual_properties(m, out);
    own_weight(m, gravity.norm(), heights[k], out);
  }
  return out;
}

}  // namespace tribo
