// SPDX-License-Identifier: MIT
/// The time step that a scheme allows while faces of bodies move across grid lines.

#include "input/read.hpp"
#include "run/step_size.hpp"
#include "solver/build.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace tribo;

namespace {

// A block that flies and vibrates a little.
Model flying_block(const std::string& method, const std::string& kernel, const std::string& transfer, int per_cell) {
  const bool again = method.back() != '-';
  return read_model_text(R"(<JANFEAInput version='3'><Header><Analysis>10</Analysis>
 <ConsistentUnits length='m' mass='kg' time='s'/></Header><MPMHeader><MPMMethod>)" +
                             method.substr(0, method.find('-')) + "</MPMMethod>" +
                             (again ? "" : "<SkipPostExtrapolation/>") + "<GIMP type='" + kernel + "'/><Transfer " +
                             transfer + "/><TimeFactor>1</TimeFactor><MatlPtsPerElement>" + std::to_string(per_cell) +
                             R"(</MatlPtsPerElement><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz cellsize='1'/><Vert cellsize='1'/></Grid></Mesh>
 <MaterialPoints><Body matname='block'><vel0X>0.02+1e-4*(x-6)</vel0X><vel0Y>0.003</vel0Y>
  <Rect xmin='3' xmax='8' ymin='3' ymax='6'/></Body></MaterialPoints>
 <Material Type='LinearElastic' Name='block'><rho>1</rho><E>1</E><nu>0.3</nu></Material></JANFEAInput>)",
                         "block.xml");
}

// The largest stored energy until the block has moved by two cells, and infinity where the run stops.
double largest_energy(const Model& model, double factor) {
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  const double dt = factor * StepSize<2>(model, system).first().size;
  double largest = 0.0;
  try {
    while (system.time < 100) {
      stepper.advance(dt);
      if (system.step % 10 == 0) largest = std::max(largest, measure(system).stored);
    }
  } catch (const SimulationError&) {
    return std::numeric_limits<double>::infinity();
  }
  return largest;
}

}  // namespace

TEST_CASE("faces that move across grid lines limit the step of schemes whose strains follow the update", "[run]") {
  // at most 1e-8 times half of the mass times the variance of x, with some tolerance for the transfers
  constexpr double supplied = 0.5 * 15 * 1e-8 * 25 / 12;
  const char* kernel = GENERATE("uGIMP", "lCPDI", "B2SPLINE");
  const char* transfer = GENERATE("type='APIC'", "type='FMPM' order='2'", "type='FMPM' order='4'");
  INFO(kernel << ", " << transfer);
  const Model model = flying_block("USL-", kernel, transfer, 4);
  CHECK(largest_energy(model, 1.0) < 1.05 * supplied);
  CHECK(largest_energy(model, 1.8) > 10 * supplied);
}

TEST_CASE("the limit of faces falls with the order of FMPM and the particles per cell", "[run]") {
  const auto step = [](const std::string& method, int order, int per_cell) {
    const Model model = flying_block(
        method, "uGIMP", order > 1 ? "type='FMPM' order='" + std::to_string(order) + "'" : "type='FLIP'", per_cell);
    auto system = build_system<2>(model, place_points(model));
    const auto first = StepSize<2>(model, system).first();
    CHECK((first.limit.cause == StepLimit::Cause::faces) == (method.back() == '-'));
    return first.size * first.wave_speed;
  };
  CHECK(step("USL-", 2, 4) == Approx(0.88 / 2));
  CHECK(step("USL-", 4, 4) == Approx(0.88 / std::sqrt(8.0)));
  CHECK(step("USL-", 4, 9) == Approx(0.88 / std::sqrt(12.0)));
  CHECK(step("USL-", 1, 16) == Approx(0.88 / 2));
  CHECK(step("USAVG-", 4, 4) == Approx(1.2 * 0.88 / std::sqrt(8.0)));
  CHECK(step("USAVG", 4, 4) == Approx(1));
}
