// SPDX-License-Identifier: MIT
/// Thermal expansion: the stress of a strain that is held, free expansion, energy, and ramps of the temperature.

#include "cloud.hpp"
#include "solver/heat/temperature_ramps.hpp"

#include "input/read.hpp"
#include "particles/fill.hpp"

#include <cmath>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double alpha = 2e-4, change = 5.0;  // a thermal strain of 0.001

// A cell full of particles that does not move: periodic in two dimensions.
Model held(const std::string& analysis, const std::string& law = "<E>1000</E><nu>0.25</nu>",
           const std::string& type = "1", const std::string& temp = "") {
  return read_model_text(
      "<JANFEAInput version='3'><Header><Analysis>" + analysis +
          "</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header><MPMHeader><GIMP/>"
          "<MPMMethod>3</MPMMethod><SkipPostExtrapolation/><MaxTime>1</MaxTime>"
          "<ArchiveTime>1</ArchiveTime></MPMHeader><Mesh><Grid xmin='0' xmax='4' ymin='0' ymax='4'>"
          "<Horiz nx='4' periodic='1'/><Vert ny='4' periodic='1'/></Grid></Mesh><MaterialPoints><Body "
          "matname='m'" +
          temp + "><Rect xmin='0' xmax='4' ymin='0' ymax='4'/></Body></MaterialPoints><Material Type='" + type +
          "' Name='m'><rho>1</rho><alpha>200</alpha>" + law +
          "</Material><CustomTasks><Schedule name='PropertyRamp'><Parameter name='Delta'>5</Parameter>"
          "<Parameter name='time'>0.01</Parameter></Schedule></CustomTasks></JANFEAInput>",
      "deck");
}

System<2> after(const Model& model, int steps, double dt = 1e-3) {
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  for (int k = 0; k < steps; ++k) stepper.advance(dt);
  return system;
}

Mat3 mean_stress(System<2>& system) { return measure(system).stress; }

}  // namespace

TEST_CASE("a held strain has the stress of the thermal strain", "[expansion]") {
  const double E = 1000, nu = 0.25, strain = alpha * change;
  auto plane_strain = after(held("10"), 12);
  const double s = -E * strain / (1 - 2 * nu);
  CHECK((mean_stress(plane_strain) - s * Mat3::Identity()).norm() < 1e-10);
  // The plane is held, the thickness is free
  auto plane_stress = after(held("11"), 12);
  const double plane = -E * strain / (1 - nu);
  CHECK((mean_stress(plane_stress) - plane * Vec3(1, 1, 0).asDiagonal().toDenseMatrix()).norm() < 1e-3);
  const double thicker = std::exp(strain - nu / (1 - nu) * -2 * strain);
  CHECK(measure(plane_stress).volume == Approx(16 * thicker).epsilon(1e-9));
}

TEST_CASE("half of the way of the ramp is half of the stress", "[expansion]") {
  auto half = after(held("10"), 5), whole = after(held("10"), 12);
  CHECK(mean_stress(half)(0, 0) == Approx(0.5 * mean_stress(whole)(0, 0)).epsilon(1e-9));
}

TEST_CASE("a body that starts warmer than the stress-free temperature has stress after its first step", "[expansion]") {
  auto system = after(held("10", "<E>1000</E><nu>0.25</nu>", "1", " temp='-5'"), 1, 1e-9);
  CHECK(mean_stress(system)(2, 2) == Approx(1000 * alpha * 5 / 0.5).epsilon(1e-6));
}

TEST_CASE("a plastic material yields under a held thermal strain", "[expansion]") {
  // Spherical stress does not yield in plane strain; in plane stress 1.33 is above the yield stress.
  auto system = after(held("11", "<E>1000</E><nu>0.25</nu><yield>1</yield>", "9"), 12);
  const Mat3 stress = mean_stress(system);
  CHECK(stress(0, 0) == Approx(-1).epsilon(1e-6));
  CHECK(measure(system).dissipated > 0);
}

TEST_CASE("the work on thermal expansion closes the balance of energy", "[expansion]") {
  auto system = after(held("10"), 12);
  const Measures m = measure(system);
  CHECK(m.stored > 0);
  CHECK(m.stored + m.expansion == Approx(0).margin(1e-9 * m.stored));
}

TEST_CASE("ramps add temperature and its heat", "[expansion]") {
  Model model = held("10");
  model.materials[0].heat_capacity = 3;
  model.heat.ramps[0].share = Expression("x", Origin{});
  auto system = build_system<2>(model, place_points(model));
  TemperatureRamps<2> ramps(model, system);
  CHECK(ramps.apply(0.005) == Approx(3 * 16 * 2 * 2.5));  // rho c V times the mean of x times half of the change
  const auto& body = system.bodies[0];
  CHECK(system.bodies[0].particles[body.temperature][0] == Approx(2.5 * body.particles.position(0)[0]));
  system.time = 0.02;
  CHECK(ramps.apply(0.005) == 0);
}
