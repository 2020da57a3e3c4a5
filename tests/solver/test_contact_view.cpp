// SPDX-License-Identifier: MIT
/// The particle columns that show contact.

#include "contact/contact_cases.hpp"
#include "input/read.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double fall_velocity = 0.01, fall_step = 0.01, block_width = 8, particle_size = 0.5;

// A block of 8 x 6 cells that moves against a rigid floor, turned by an angle in degrees.
Model falling_block(const std::string& impulses, double angle) {
  const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
  const auto text = [](double x) { return std::to_string(x); };
  const std::string X = "(" + text(c) + "*(x-20)-(" + text(s) + ")*(y-20)+20)",
                    Y = "(" + text(s) + "*(x-20)+(" + text(c) + ")*(y-20)+20)";
  const std::string turn = "<Deform dX='" + X + "-x' dY='" + Y + "-y' F11='" + text(c) + "' F12='" + text(-s) +
                           "' F21='" + text(s) + "' F22='" + text(c) + "'/>";
  const std::string motion = " vx='" + text(fall_velocity * s) + "' vy='" + text(-fall_velocity * c) + "'";
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MPMMethod>USL</MPMMethod><SkipPostExtrapolation/><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>
  <TimeStep>0.01</TimeStep><MultiMaterialMode Impulses=')" +
                             impulses + R"('/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='40' ymin='0' ymax='40'><Horiz nx='40'/><Vert ny='40'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='floor'>)" + turn +
                             R"(<Rect xmin='12' xmax='28' ymin='16' ymax='20'/></Body>
  <Body matname='block')" + motion +
                             ">" + turn + R"(<Rect xmin='16' xmax='24' ymin='20' ymax='26'/></Body>
 </MaterialPoints>
 <Material Type='RigidContact' Name='floor'/>
 <Material Type='1' Name='block'><rho>1</rho><E>1</E><nu>0</nu></Material></JANFEAInput>)",
                         "deck.xml");
}

Vec<2> momentum_of(Body<2>& body) {
  Vec<2> sum = Vec<2>::Zero();
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    sum += body.particles.mass()[i] * Vec<2>(body.particles.v()[0][i], body.particles.v()[1][i]);
  return sum;
}

}  // namespace

TEST_CASE("contact shows on the row of particles that touches, whose tractions sum to the force", "[contact][view]") {
  const char* impulses = GENERATE("nodes", "faces");
  const double angle = GENERATE(0.0, 17.0, 45.0);
  INFO(impulses << ", turned by " << angle << " degrees");
  const Model model = falling_block(impulses, angle);
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  Body<2>& block = system.bodies[0];
  for (int k = 0; k < 2; ++k) stepper.advance(fall_step);  // the faces only touch at the start
  const Vec<2> up(-std::sin(angle * std::numbers::pi / 180), std::cos(angle * std::numbers::pi / 180));
  // Means over many steps: the force of a block that falls on the floor oscillates from step to step.
  Vec<2> sum = Vec<2>::Zero();
  const Vec<2> before = momentum_of(block);
  constexpr int steps = 100;
  for (int step = 0; step < steps; ++step) {
    stepper.advance(fall_step);
    stepper.contact().fill_view();
    int touching = 0;
    for (std::size_t i = 0; i < block.particles.size(); ++i) {
      const double height = (block.particles.position(i) - Vec<2>(20, 20)).dot(up);
      const bool first = height < particle_size;
      const auto* const contact = block.contact_of(i);
      const Vec<2> traction = contact ? contact->traction : Vec<2>(Vec<2>::Zero());
      sum += particle_size / steps * traction, touching += first ? 1 : 0;
      if (step > 0) continue;
      CHECK((contact != nullptr) == first);
      CHECK((traction.norm() > 0) == first);
      if (first && contact) CHECK((contact->normal + up).norm() < 1e-3);
    }
    if (step == 0) CHECK(touching == static_cast<int>(block_width / particle_size));
  }
  const Vec<2> force = (momentum_of(block) - before) / (steps * fall_step);
  CHECK(sum.dot(up) > 0);
  // The sides of the particles deviate from their initial size by the strain, of the order of velocity over wave speed.
  CHECK((sum - force).norm() < 1e-3 * force.norm());
  for (const Body<2>& floor : system.rigids)
    for (std::size_t i = 0; i < floor.particles.size(); ++i)
      if ((floor.particles.position(i) - Vec<2>(20, 20)).dot(up) < -particle_size) CHECK(!floor.contact_of(i));
}

TEST_CASE("tractions are uniform up to symmetry planes", "[contact][view]") {
  const char* impulses = GENERATE("nodes", "faces");
  INFO(impulses);
  const Model model = read_model_text(
      R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MPMMethod>USL</MPMMethod><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>
  <TimeStep>0.01</TimeStep><MultiMaterialMode Impulses=')" +
          std::string(impulses) + R"('/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='16'>
  <Horiz nx='8' symmin='0' symmax='8'/><Vert ny='16'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='floor'><Rect xmin='0' xmax='8' ymin='2' ymax='6'/></Body>
  <Body matname='block' vy='-0.01'><Rect xmin='0' xmax='8' ymin='6' ymax='12'/></Body>
 </MaterialPoints>
 <Material Type='RigidContact' Name='floor'/>
 <Material Type='1' Name='block'><rho>1</rho><E>1</E><nu>0</nu></Material></JANFEAInput>)",
      "deck.xml");
  auto system = build_system<2>(model, place_points(model));
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 20; ++k) stepper.advance(fall_step);
  stepper.contact().fill_view();
  const Body<2>& block = system.bodies[0];
  int touching = 0;
  double mean = 0.0;
  for (std::size_t i = 0; i < block.particles.size(); ++i)
    if (const auto* const contact = block.contact_of(i)) ++touching, mean += contact->traction[1];
  REQUIRE(touching == 16);
  mean /= touching;
  CHECK(mean > 0);
  for (std::size_t i = 0; i < block.particles.size(); ++i)
    if (const auto* const contact = block.contact_of(i))
      CHECK((contact->traction - Vec<2>(0, mean)).norm() < 1e-6 * mean);
}

TEST_CASE("particles of a face show whether it slides", "[contact][view]") {
  const char* impulses = GENERATE("nodes", "faces");
  const bool slides = GENERATE(true, false);
  INFO(impulses);
  Model model = falling_block(impulses, 0.0);
  model.contact.default_law = make_law("CoulombFriction", {{"coeff", slides ? "0.1" : "100"}});
  auto system = build_system<2>(model, place_points(model));
  Body<2>& block = system.bodies[0];
  for (std::size_t i = 0; i < block.particles.size(); ++i) block.particles.v()[0][i] = 0.5 * fall_velocity;
  Stepper<2> stepper(model, system);
  for (int k = 0; k < 3; ++k) stepper.advance(fall_step);
  stepper.contact().fill_view();
  for (std::size_t i = 0; i < block.particles.size(); ++i)
    if (block.particles.position(i)[1] - 20 < particle_size)
      CHECK((block.contact_of(i) && block.contact_of(i)->slips == slides));
}
