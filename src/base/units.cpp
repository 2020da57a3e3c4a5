// SPDX-License-Identifier: MIT
#include "base/units.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace tribo {

double Units::factor(Dimension dimension) const {
  if (dimension == Dimension::angle) return std::numbers::pi / 180.0;
  if (!legacy) return 1.0;
  switch (dimension) {  // factor from legacy units to mm, g, s
    case Dimension::density:
      return 1e-3;  // g/cm^3
    case Dimension::stress:
      return 1e6;  // MPa
    case Dimension::force:
      return 1e6;  // N = kg m/s^2
    case Dimension::expansion:
      return 1e-6;  // ppm
    case Dimension::heat_capacity:
      return 1e6;  // J/(kg K)
    case Dimension::conductivity:
      return 1e6;  // W/(m K)
    case Dimension::heat_flux:
      return 1e3;  // W/m^2
    case Dimension::viscosity:
      return 1e-3;  // cP
    case Dimension::interface_stiffness:
      return 1e6;  // MPa/mm
    case Dimension::energy_release:
      return 1e3;  // J/m^2
    case Dimension::stress_intensity:
      return 1e6 * std::sqrt(1e3);  // MPa m^1/2
    default:
      return 1.0;
  }
}

namespace {

/// Systems of units with named units of stress and force.
struct KnownUnits {
  std::string_view length, mass, time;
  const char *stress, *force;
};

const KnownUnits* known_units(std::string_view length, std::string_view mass, std::string_view time) {
  static constexpr std::array<KnownUnits, 6> all{{{"m", "kg", "s", "Pa", "N"},
                                                  {"mm", "t", "s", "MPa", "N"},
                                                  {"mm", "g", "ms", "MPa", "N"},
                                                  {"mm", "g", "s", "Pa", "uN"},
                                                  {"mm", "kg", "ms", "GPa", "kN"},
                                                  {"mm", "mg", "ms", "kPa", "mN"}}};
  for (const auto& u : all)
    if (u.length == length && u.mass == mass && u.time == time) return &u;
  return nullptr;
}

}  // namespace

std::optional<double> Units::size_in_si(Dimension dimension) const {
  struct Unit {
    std::string_view name;
    Dimension dimension;
    double size;
  };
  using D = Dimension;
  static constexpr std::array<Unit, 18> all{{{"km", D::length, 1e3},
                                             {"m", D::length, 1},
                                             {"dm", D::length, 0.1},
                                             {"cm", D::length, 1e-2},
                                             {"mm", D::length, 1e-3},
                                             {"um", D::length, 1e-6},
                                             {"microns", D::length, 1e-6},
                                             {"nm", D::length, 1e-9},
                                             {"t", D::mass, 1e3},
                                             {"kg", D::mass, 1},
                                             {"g", D::mass, 1e-3},
                                             {"mg", D::mass, 1e-6},
                                             {"ug", D::mass, 1e-9},
                                             {"s", D::time, 1},
                                             {"sec", D::time, 1},
                                             {"ms", D::time, 1e-3},
                                             {"msec", D::time, 1e-3},
                                             {"us", D::time, 1e-6}}};
  const std::string wanted = name(dimension);
  for (const Unit& unit : all)
    if (unit.dimension == dimension && unit.name == wanted) return unit.size;
  return std::nullopt;
}

std::string Units::name(Dimension dimension) const {
  const std::string l = legacy ? "mm" : length, m = legacy ? "g" : mass, t = legacy ? "s" : time;
  switch (dimension) {
    case Dimension::none:
      return "-";
    case Dimension::length:
      return l;
    case Dimension::mass:
      return m;
    case Dimension::time:
      return t;
    case Dimension::velocity:
      return l + "/" + t;
    case Dimension::acceleration:
      return l + "/" + t + "^2";
    case Dimension::density:
      return m + "/" + l + "^3";
    case Dimension::stress:
      if (const auto* known = known_units(l, m, t)) return known->stress;
      return m + "/(" + l + " " + t + "^2)";
    case Dimension::force:
      if (const auto* known = known_units(l, m, t)) return known->force;
      return m + " " + l + "/" + t + "^2";
    case Dimension::rate:
      return "1/" + t;
    case Dimension::expansion:
      return "1/K";
    case Dimension::temperature:
      return "K";
    case Dimension::heat_capacity:
      return l + "^2/(" + t + "^2 K)";
    case Dimension::conductivity:
      return m + " " + l + "/(" + t + "^3 K)";
    case Dimension::heat_flux:
      return m + "/" + t + "^3";
    case Dimension::viscosity:
      return m + "/(" + l + " " + t + ")";
    case Dimension::interface_stiffness:
      return m + "/(" + l + "^2 " + t + "^2)";
    case Dimension::energy_release:
      return m + "/" + t + "^2";
    case Dimension::stress_intensity:
      return m + "/(" + l + "^0.5 " + t + "^2)";
    case Dimension::per_length:
      return "1/" + l;
    case Dimension::per_velocity:
      return t + "/" + l;
    case Dimension::angle:
      return "rad";
  }
  return "-";
}

std::string_view dimension_name(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "-";
    case Dimension::length:
      return "length";
    case Dimension::mass:
      return "mass";
    case Dimension::time:
      return "time";
    case Dimension::velocity:
      return "length/time";
    case Dimension::acceleration:
      return "length/time^2";
    case Dimension::density:
      return "mass/length^3";
    case Dimension::stress:
      return "stress";
    case Dimension::force:
      return "force";
    case Dimension::rate:
      return "1/time";
    case Dimension::expansion:
      return "1/temperature";
    case Dimension::temperature:
      return "temperature";
    case Dimension::heat_capacity:
      return "energy/(mass temperature)";
    case Dimension::conductivity:
      return "power/(length temperature)";
    case Dimension::heat_flux:
      return "power/area";
    case Dimension::viscosity:
      return "stress time";
    case Dimension::interface_stiffness:
      return "stress/length";
    case Dimension::energy_release:
      return "energy/area";
    case Dimension::stress_intensity:
      return "stress length^0.5";
    case Dimension::per_length:
      return "1/length";
    case Dimension::per_velocity:
      return "time/length";
    case Dimension::angle:
      return "degrees";
  }
  return "-";
}

}  // namespace tribo
