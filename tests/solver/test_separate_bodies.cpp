// SPDX-License-Identifier: MIT
/// Bodies of one material that touch each other.

#include "base/error.hpp"
#include "input/read.hpp"
#include "run/particle_blocks.hpp"
#include "run/preflight.hpp"
#include "solver/build.hpp"
#include "solver/contact/contact_laws.hpp"
#include "solver/measures.hpp"
#include "solver/step.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace tribo;
using Catch::Matchers::Contains;

namespace {

constexpr double radius = 2.0;

std::string disc(double x, double y) {
  const auto at = [](double value) { return std::to_string(value); };
  return "<Oval xmin='" + at(x - radius) + "' xmax='" + at(x + radius) + "' ymin='" + at(y - radius) + "' ymax='" +
         at(y + radius) + "'/>";
}

std::string grain(const std::string& name, const std::string& more) {
  return "<Material Type='1' Name='" + name + "'><rho>1</rho><E>100</E><nu>0.3</nu>" + more + "</Material>";
}

// Discs that fall on a plate and on each other, each of a material of its own or all of one.
Model falling_discs(int count, bool one_material, const std::string& default_law = "<Friction lawname='rough'/>") {
  std::string bodies, materials;
  for (int k = 0; k < count; ++k) {
    const std::string name = one_material ? "grain" : "grain " + std::to_string(k + 1);
    const double x = 6 + 4.5 * (k % 5) + 0.7 * (k / 5 % 2), y = 4.1 + 4.1 * (k / 5);
    bodies += "<Body matname='" + name + "' vx='0.3' vy='-2'>" + disc(x, y) + "</Body>";
    if (!one_material) materials += grain(name, "");
  }
  if (one_material) materials = grain("grain", "<Friction lawname='rough' matname='grain'/>");
  return read_model_text(
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis>"
      "<ConsistentUnits length='mm' mass='g' "
      "time='ms'/></Header><MPMHeader><MPMMethod>USL</MPMMethod><MaxTime>1</MaxTime>"
      "<ArchiveTime>1</ArchiveTime><GIMP type='quadratic'/><MultiMaterialMode>" +
          default_law +
          "</MultiMaterialMode></MPMHeader><Mesh><Grid xmin='0' xmax='32' ymin='0' ymax='32'><Horiz cellsize='1'/>"
          "<Vert cellsize='1'/></Grid></Mesh><MaterialPoints>" +
          bodies + "<Body matname='plate'><Rect xmin='1' xmax='31' ymin='1' ymax='2'/></Body></MaterialPoints>" +
          materials +
          "<Material Type='RigidContact' Name='plate'/>"
          "<Material Type='CoulombFriction' Name='rough'><coeff>0.2</coeff></Material></JANFEAInput>",
      "deck.xml");
}

struct Run {
  Model model;
  System<2> system;
  Stepper<2> stepper;
  explicit Run(const Model& of)
      : model(of), system(build_system<2>(model, place_points(model))), stepper(model, system) {}
};

}  // namespace

TEST_CASE("a contact law of a material with itself acts between its bodies", "[contact]") {
  Run one(falling_discs(7, true)), many(falling_discs(7, false));
  REQUIRE(one.system.bodies.size() == 7);
  for (int k = 0; k < 200; ++k) one.stepper.advance(0.01), many.stepper.advance(0.01);
  double mass = 0.0, kinetic = 0.0;
  for (std::size_t b = 0; b < 7; ++b) {
    Body<2>&body = one.system.bodies[b], &other = many.system.bodies[b];
    CHECK(body.material == 0);
    REQUIRE(body.particles.size() == other.particles.size());
    bool same = true;
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      same = same && body.particles.x()[0][i] == other.particles.x()[0][i] &&
             body.particles.v()[1][i] == other.particles.v()[1][i];
    CHECK(same);
    const Measures m = measure(body);
    mass += m.mass, kinetic += m.kinetic;
  }
  bool touched = false;  // some disc was turned aside by another one
  for (Body<2>& body : one.system.bodies)
    touched = touched || std::abs(measure(body).momentum[0] / measure(body).mass) > 0.5;
  CHECK(touched);
  const Measures all = measure(one.system, false, 0);
  CHECK(all.mass == Approx(mass));
  CHECK(all.kinetic == Approx(kinetic));
}

TEST_CASE("bodies of one material share the entry of their contact law", "[contact]") {
  Model model = falling_discs(7, true);
  const ContactLaw* among_grains = model.contact.law(0, 0);
  const auto with_plate = model.contact.default_law = falling_discs(2, false).contact.default_law;
  REQUIRE(with_plate.get() != among_grains);
  const System<2> system = build_system<2>(model, place_points(model));
  const ContactLaws<2> laws(model, system);
  REQUIRE(system.bodies.size() == 7);
  for (const Body<2>& a : system.bodies) {
    for (const Body<2>& b : system.bodies)
      if (a.field != b.field) CHECK(laws.between(a.field, b.field) == among_grains);
    CHECK(laws.between(a.field, system.rigids[0].field) == with_plate.get());
    CHECK(laws.between(system.rigids[0].field, a.field) == with_plate.get());
  }
}

TEST_CASE("the files of many bodies of one material are few", "[output]") {
  for (const int count : {7, 25}) {
    Run run(falling_discs(count, true));
    std::vector<Body<2>*> bodies;
    for (Body<2>& body : run.system.bodies) bodies.push_back(&body);
    const ParticleBlocks<2> blocks(run.model, bodies, run.system.pieces);
    std::size_t particles = 0;
    for (std::size_t k = 0; k < blocks.blocks().size(); ++k) particles += blocks.count(k);
    CHECK(particles == static_cast<std::size_t>(measure(run.system).particles));
    if (count == 7) {
      REQUIRE(blocks.blocks().size() == 7);
      CHECK((blocks.blocks()[2].name == "grain 3" && blocks.blocks()[2].group == "grain"));
    } else {
      REQUIRE(blocks.blocks().size() == 1);
      CHECK((blocks.blocks()[0].name == "grain" && blocks.blocks()[0].number == 1 && blocks.ranges(0).size() == 25));
      const ParticleBlocks<2> divided(run.model, bodies, run.system.pieces, particles / 3);
      CHECK(divided.blocks().size() == 4);
      CHECK(divided.ranges().size() == 25);
    }
  }
}

TEST_CASE("check names the law between the bodies of a material", "[preflight]") {
  CHECK_THAT(preflight(falling_discs(2, true), 1), Contains("contact of all pairs (2): CoulombFriction 'rough'"));
  const std::string sheet = preflight(falling_discs(2, true, ""), 1);
  CHECK_THAT(sheet, Contains("contact of the bodies of 'grain' with each other: CoulombFriction 'rough'"));
  CHECK_THAT(sheet, Contains("body of 'grain 2'"));
  // Many bodies share a line
  CHECK_THAT(preflight(falling_discs(9, true), 1), Contains("9 bodies of 'grain': ") && !Contains("body of 'grain 2'"));
}

TEST_CASE("what bodies of one material that touch each other do not have yet is an error", "[contact]") {
  const auto message = [](const std::string& self, const std::string& more,
                          const std::string& matrix = "") -> std::string {
    try {
      read_model_text(
          "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/>"
          "</Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><MultiMaterialMode/></"
          "MPMHeader><Mesh><Grid xmin='0' xmax='9' ymin='0' "
          "ymax='9'><Horiz nx='9'/><Vert ny='9'/></Grid></Mesh><MaterialPoints><Body matname='grain'><Rect xmin='1' "
          "xmax='2' ymin='1' ymax='2'/></Body>" +
              more + "</MaterialPoints>" + grain("grain", self) + grain("matrix", matrix) +
              "<Material Type='Mohr' Name='joint'><stiffness-normal>1</stiffness-normal>"
              "<stiffness-shear>1</stiffness-shear></Material></JANFEAInput>",
          "deck.xml");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::string self = "<Friction matname='grain'>0.2</Friction>";
  CHECK(message(self, "") == "");
  CHECK_THAT(message(self, "<PointList><mp matname='grain' lpx='1' lpy='1'><pt x='5' y='5'/></mp></PointList>"),
             Contains("not implemented for single particles"));
  CHECK_THAT(message("<Friction matname='grain' lawname='joint'/>", ""),
             Contains("joint laws between the bodies of one"));
  CHECK_THAT(message(self + "<shareMatField>1</shareMatField>", ""), Contains("contradicts its <shareMatField>"));
  CHECK_THAT(message(self, "", "<shareMatField>1</shareMatField>"), Contains("no other material can share them"));
}
