// SPDX-License-Identifier: MIT
/// Contact beside a symmetry plane is that of the whole body.

#include "input/read.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace tribo;

namespace {

constexpr double plane = 20.0, step_length = 0.01;

enum class Part { whole, right, left };

// A disc that moves against a block, both symmetric about x = 20, or half of them.
Model falling_disc(Part part, const std::string& impulses) {
  const std::string from = part == Part::right ? "20" : "4", to = part == Part::left ? "20" : "36";
  const std::string at_plane = part == Part::right ? " symmin='20'" : part == Part::left ? " symmax='20'" : "";
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MPMMethod>USL</MPMMethod><SkipPostExtrapolation/><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>
  <TimeStep>0.01</TimeStep><MultiMaterialMode Impulses=')" +
                             impulses + R"('><Friction law='rough'/></MultiMaterialMode></MPMHeader>
 <Mesh><Grid xmin=')" + from +
                             "' xmax='" + to + R"(' ymin='0' ymax='40'><Horiz cellsize='1')" + at_plane +
                             R"(/><Vert ny='40'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='disc' vy='-0.02'><Oval xmin='14.7' xmax='25.3' ymin='16.01' ymax='26.61'/></Body>
  <Body matname='block'><Rect xmin='8' xmax='32' ymin='8' ymax='16'/></Body>
 </MaterialPoints>
 <Material Type='CoulombFriction' Name='rough'><coeff>0.2</coeff><coeffStatic>0.3</coeffStatic></Material>
 <Material Type='1' Name='disc'><rho>1</rho><E>2</E><nu>0.3</nu></Material>
 <Material Type='1' Name='block'><rho>1</rho><E>1</E><nu>0.3</nu></Material></JANFEAInput>)",
                         "deck.xml");
}

struct Run {
  Model model;
  System<2> system;
  Stepper<2> stepper;

  Run(Part part, const std::string& impulses)
      : model(falling_disc(part, impulses)),
        system(build_system<2>(model, place_points(model))),
        stepper(model, system) {
    for (int k = 0; k < 300; ++k) stepper.advance(step_length);
    stepper.contact().fill_view();
  }
};

std::size_t nearest(Body<2>& body, const Vec<2>& x) {
  std::size_t found = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double distance = (body.particles.position(i) - x).squaredNorm();
    if (distance < smallest) smallest = distance, found = i;
  }
  return found;
}

Vec<2> velocity(Body<2>& body, std::size_t i) { return {body.particles.v()[0][i], body.particles.v()[1][i]}; }

}  // namespace

TEST_CASE("a disc that meets a block at a symmetry plane has the contact of the whole disc", "[contact][view]") {
  const Part part = GENERATE(Part::right, Part::left);
  // The sweeps over the constraints of faces end before they have converged to the last digit, and how neighbouring
  // points share an impulse converges last.
  const auto [impulses, tolerance, of_tractions] =
      GENERATE(table<const char*, double, double>({{"nodes", 1e-4, 1e-4}, {"faces", 1e-2, 0.1}}));
  INFO(impulses);
  Run whole(Part::whole, impulses), half(part, impulses);
  int touching = 0, beside = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    Body<2>&body = half.system.bodies[b], &other = whole.system.bodies[b];
    double fastest = 0.0, pressure = 0.0;
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      fastest = std::max(fastest, velocity(body, i).norm());
      if (const auto* contact = body.contact_of(i)) pressure = std::max(pressure, contact->traction.norm());
    }
    REQUIRE(pressure > 0);
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const Vec<2> x = body.particles.position(i);
      const std::size_t k = nearest(other, x);
      CHECK((other.particles.position(k) - x).norm() < tolerance);
      CHECK((velocity(other, k) - velocity(body, i)).norm() < tolerance * fastest);
      const auto *contact = body.contact_of(i), *of_other = other.contact_of(k);
      REQUIRE((contact == nullptr) == (of_other == nullptr));
      if (!contact) continue;
      ++touching, beside += std::abs(x[0] - plane) < 1.0;
      CHECK((contact->traction - of_other->traction).norm() < of_tractions * pressure);
      CHECK((contact->normal - of_other->normal).norm() < tolerance);
    }
  }
  CHECK(touching > 6);
  CHECK(beside == 4);
}
