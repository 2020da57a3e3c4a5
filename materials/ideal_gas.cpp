// SPDX-License-Identifier: MIT
/// Ideal gas under adiabatic or isothermal compression.
///
///   p = P0 J^-gamma;   gamma = 1: isothermal. The stress is -(p - P0) 1, or -p 1 if `absolute` is 1.

#include "materials/material.hpp"

namespace tribo {
namespace {

struct IdealGas {
  static constexpr std::string_view name = "IdealGas";
  static constexpr std::string_view summary = "Ideal gas, adiabatic or isothermal.";
  static constexpr int number = 22;
  static constexpr std::string_view example = R"(
<Material Type='IdealGas' Name='air'>
  <rho>1.2</rho>
  <P0>101325</P0>
  <gamma>1.4</gamma>
</Material>)";

  double density = 0, pressure = 0, gamma = 1.4, absolute = 0;

  static auto parameters() {
    using L = IdealGas;
    using P = Parameter<L>;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density at the pressure P0"},
        P{"P0", &L::pressure, Dimension::stress, positive, "absolute pressure before deformation"},
        P{"gamma",
          &L::gamma,
          Dimension::none,
          {1.0, 2.0, false, false},
          "ratio of the heat capacities at constant pressure and constant volume; 1: isothermal gas",
          1.4},
        P{"absolute", &L::absolute, Dimension::none, within(0, 1),
          "1: the particles carry the absolute pressure, for a gas that walls enclose; 0: they carry the pressure "
          "above P0",
          0.0},
    };
  }
  void prepare(const Statement& statement, Problems& problems) {
    if (absolute != 0 && absolute != 1) problems.add(statement.child("absolute")->origin, "<absolute> is 0 or 1");
  }

  double wave_modulus() const { return gamma * pressure; }
  using State = NoState;
  double wave_modulus(const Mat3& F, const Mat3&, const State&) const {
    return gamma * pressure * std::pow(F.determinant(), -gamma);
  }
  Mat3 stress(const Motion& motion, const Mat3&, State&) const {
    const double p = pressure * std::pow(motion.F.determinant(), -gamma);
    return -(p - (absolute == 1 ? 0.0 : pressure)) * Mat3::Identity();
  }
  // Minus the integral of the pressure over J from 1, divided by J: energy per current volume
  double energy_density(const Mat3& F, const Mat3&, const State&) const {
    const double J = F.determinant(), outside = absolute == 1 ? 0.0 : pressure;
    const double work =
        gamma == 1 ? -pressure * std::log(J) : pressure * std::expm1((1 - gamma) * std::log(J)) / (gamma - 1);
    return (work + outside * (J - 1)) / J;
  }
};

}  // namespace

Catalogue<Material>::Item ideal_gas() { return material_law<IdealGas>(); }

}  // namespace tribo
