// SPDX-License-Identifier: MIT
/// Contact impulses on nodes or on faces, where the command file does not say it.

#include "input/read.hpp"
#include "run/preflight.hpp"
#include "solver/build.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using Catch::Contains;

namespace {

struct ImpulseDeck {
  std::string mode = "<MultiMaterialMode/>";
  std::string bodies{};
  std::string materials{};
  std::string more{};  // after the materials
  std::string shape = "<GIMP/>";
};

const std::string thin_plate = "<Body matname='plate'><Rect xmin='2' xmax='18' ymin='8' ymax='9'/></Body>";
const std::string thick_block = "<Body matname='block'><Rect xmin='4' xmax='14' ymin='9' ymax='17'/></Body>";
const std::string two_platens =
    "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='6' ymax='9'/></Body>"
    "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='17' ymax='19'/></Body>";
const std::string one_platen = "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='6' ymax='9'/></Body>";

Model deck_model(const ImpulseDeck& deck) {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime>)" +
                             deck.shape + deck.mode + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='20'><Horiz nx='20'/><Vert ny='20'/></Grid></Mesh>
 <MaterialPoints>)" + deck.bodies +
                             R"(</MaterialPoints>
 <Material Type='1' Name='plate'><rho>1</rho><E>1</E><nu>0</nu>)" +
                             deck.materials + R"(</Material>
 <Material Type='1' Name='block'><rho>1</rho><E>1</E><nu>0</nu></Material>
 <Material Type='RigidContact' Name='platen'/>)" +
                             deck.more + "</JANFEAInput>",
                         "deck.xml");
}

System<2> deck_system(const ImpulseDeck& deck) {
  const Model model = deck_model(deck);
  return build_system<2>(model, place_points(model));
}

void check_choice(const ImpulseDeck& deck, bool faces, const std::string& reason) {
  const System<2> system = deck_system(deck);
  CHECK(system.contact_at_faces == faces);
  CHECK(system.contact_reason == reason);
}

const std::string why_nodes =
    "on nodes, because no body in contact is thin, curved or inelastic, or lies between rigid faces";
const std::string why_faces = "'plate' is 1 cell thick";
const std::string but_thin =
    ", although " + why_faces + ", so that its contact is too stiff; Impulses='faces' may be better";

// Discs of two cells that do not touch each other, each of a material of its own.
ImpulseDeck discs(int number) {
  ImpulseDeck deck;
  for (int k = 0; k < number; ++k) {
    const std::string name = "disc " + std::to_string(k);
    const int x = 4 * (k % 5) + 1, y = 4 * (k / 5) + 1;
    deck.bodies += "<Body matname='" + name + "'><Oval xmin='" + std::to_string(x) + "' xmax='" +
                   std::to_string(x + 2) + "' ymin='" + std::to_string(y) + "' ymax='" + std::to_string(y + 2) +
                   "'/></Body>";
    deck.more += "<Material Type='1' Name='" + name + "'><rho>1</rho><E>1</E><nu>0</nu></Material>";
  }
  return deck;
}

}  // namespace

TEST_CASE("an elastic block takes impulses on nodes", "[impulses]") {
  check_choice({.bodies = thick_block + one_platen}, false, why_nodes);
}

TEST_CASE("a thin body in contact takes impulses on faces", "[impulses]") {
  check_choice({.bodies = thin_plate + thick_block}, true, "on faces, because " + why_faces);
  check_choice({.bodies = "<Body matname='plate'><Rect xmin='2' xmax='18' ymin='6' ymax='9'/></Body>" + thick_block},
               true, "on faces, because 'plate' is 3 cells thick");
  check_choice({.bodies = "<Body matname='plate'><Rect xmin='2' xmax='18' ymin='5' ymax='9'/></Body>" + thick_block},
               false, why_nodes);
}

TEST_CASE("curved and inelastic bodies take impulses on faces", "[impulses]") {
  const std::string round = "<Body matname='block'><Oval xmin='4' xmax='14' ymin='9' ymax='19'/></Body>";
  check_choice({.bodies = round + one_platen}, true, "on faces, because 'block' is curved");
  std::string corners;  // of a polygon with as many directions
  for (int k = 0; k < 14; ++k)
    corners += "<pt x='" + std::to_string(9 + 5 * std::cos(k * 6.2831853 / 14)) + "' y='" +
               std::to_string(14 + 5 * std::sin(k * 6.2831853 / 14)) + "'/>";
  check_choice({.bodies = "<Body matname='block'><Polygon>" + corners + "</Polygon></Body>" + one_platen}, true,
               "on faces, because 'block' is curved");
  check_choice({.mode = "<MultiMaterialMode><Friction lawname='film'/></MultiMaterialMode>",
                .bodies = round + one_platen,
                .more = "<Material Type='TaitLiquid' Name='oil'><rho>1</rho><K>1</K><viscosity>1</viscosity></Material>"
                        "<Material Type='LiquidContact' Name='film'><LiquidPhase>4</LiquidPhase></Material>"},
               false, "on nodes, because the model has films of liquid");
  const std::string wheel = "<Body matname='platen'><Oval xmin='4' xmax='8' ymin='5' ymax='9'/></Body>";
  check_choice({.bodies = thick_block + wheel}, true, "on faces, because 'platen' is curved");
  const auto deformed = [](const std::string& F11) {
    return "<Body matname='block'><Deform F11='" + F11 + "'/><Rect xmin='4' xmax='14' ymin='9' ymax='17'/></Body>";
  };
  check_choice({.bodies = deformed("1+0.001*y") + one_platen}, true, "on faces, because 'block' is curved");
  check_choice({.bodies = deformed("1.01") + one_platen}, false, why_nodes);
  const std::string soil =
      "<Material Type='MohrCoulomb' Name='soil'><rho>1</rho><E>1</E><nu>0</nu><cohesion>1</cohesion>"
      "<friction>30</friction></Material>";
  check_choice({.bodies = "<Body matname='soil'><Rect xmin='4' xmax='14' ymin='9' ymax='17'/></Body>" + one_platen,
                .more = soil},
               true, "on faces, because 'soil' is inelastic");
}

TEST_CASE("many bodies take impulses on nodes, unless one of them is thin", "[impulses]") {
  check_choice(discs(16), true, "on faces, because 'disc 0' is curved");
  check_choice(discs(17), false,
               "on nodes, because with 17 deformable materials in contact the iteration over faces would take most of "
               "the time; Impulses='faces' is more accurate");
  ImpulseDeck more = discs(17);
  more.bodies +=
      "<Body matname='plate'><Rect xmin='12' xmax='18' ymin='17' ymax='18'/></Body>"
      "<Body matname='block'><Rect xmin='12' xmax='18' ymin='18' ymax='19'/></Body>";
  check_choice(more, true, "on faces, because " + why_faces);
}

TEST_CASE("with splines on a rigid face the choice of nodes tells that stresses there are wrong", "[impulses]") {
  const auto reason = [](const char* shape) {
    return deck_system(
               {.mode = "<MultiMaterialMode Normals='avggrad'/>", .bodies = thick_block + one_platen, .shape = shape})
        .contact_reason;
  };
  const std::string why = "on nodes, because the command file sets the method for normals";
  for (const char* spline : {"<GIMP type='quadratic'/>", "<GIMP type='B3SPLINE'/>"})
    CHECK_THAT(reason(spline), Contains(why) && Contains("stresses within two cells of a rigid face"));
  CHECK(reason("<GIMP type='lCPDI'/>") == why);
}

TEST_CASE("a body between rigid platens takes impulses on faces", "[impulses]") {
  check_choice({.bodies = thick_block + two_platens}, true,
               "on faces, because 'block' lies between rigid faces on opposite sides");
}

TEST_CASE("with splines, impulses act on faces unless something speaks against it", "[impulses]") {
  for (const char* spline : {"<GIMP type='quadratic'/>", "<GIMP type='B3SPLINE'/>"}) {
    ImpulseDeck deck{.bodies = thick_block + one_platen};
    deck.shape = spline;
    const std::string why = "on faces, because splines would spread impulses on nodes over three rows of nodes";
    CHECK_THAT(deck_system(deck).contact_reason, Contains(why + ". Without damping, elastic bodies vibrate"));
    deck.shape += "<Transfer type='FMPM' order='2'/>";
    check_choice(deck, true, why);
  }
  ImpulseDeck other{.bodies = thick_block + one_platen};
  other.shape = "<GIMP type='uGIMP'/>";
  check_choice(other, false, why_nodes);
}

TEST_CASE("a thin body that touches nothing does not count", "[impulses]") {
  const std::string friend_law = "<Friction law='4' matname='block'/>";
  const std::string ignore = "<Material Type='IgnoreContact' Name='none'/>";
  check_choice({.bodies = thin_plate + thick_block, .materials = friend_law, .more = ignore}, false,
               "on nodes, because no contact law acts between faces");
  Model model = deck_model({.bodies = thin_plate + thick_block});
  model.contact.active = false;
  CHECK(build_system<2>(model, place_points(model)).contact_reason.empty());
}

TEST_CASE("layers of one velocity field are one body", "[impulses]") {
  check_choice({.bodies = thin_plate + thick_block + one_platen, .materials = "<shareMatField>2</shareMatField>"},
               false, why_nodes);
}

TEST_CASE("thin rigid bodies do not count", "[impulses]") {
  check_choice({.bodies = "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='8' ymax='9'/></Body>" + thick_block},
               false, why_nodes);
}

TEST_CASE("the command file decides about impulses", "[impulses]") {
  check_choice({.mode = "<MultiMaterialMode Impulses='nodes'/>", .bodies = thin_plate + thick_block}, false,
               "on nodes, as the command file says");
  check_choice({.mode = "<MultiMaterialMode Impulses='faces'/>", .bodies = thick_block + one_platen}, true,
               "on faces, as the command file says");
}

TEST_CASE("cracks, joints and interfaces keep impulses on nodes", "[impulses]") {
  const std::string crack = "<CrackList><Line xmin='6' ymin='12' xmax='9' ymax='12'/></CrackList>";
  const std::string glue =
      "<Material Type='LinearInterface' Name='glue'><Dnt>1</Dnt><Dt>1</Dt></Material>"
      "<Material Type='Mohr' Name='joint'><stiffness-normal>1</stiffness-normal>"
      "<stiffness-shear>1</stiffness-shear></Material>";
  const auto law = [](int number) { return "<Friction law='" + std::to_string(number) + "' matname='block'/>"; };
  check_choice({.bodies = thick_block + one_platen, .more = crack}, false, "on nodes, because the model has cracks");
  // What lies behind an interface or a joint has its stiffness, however thin it is.
  const std::string bodies = thin_plate + thick_block;
  check_choice({.bodies = bodies, .materials = law(4), .more = glue}, false,
               "on nodes, because the model has interfaces");
  check_choice({.bodies = bodies, .materials = law(5), .more = glue}, false, "on nodes, because the model has joints");
}

TEST_CASE("thin bodies and platens take impulses on faces in models with cracks, joints and interfaces", "[impulses]") {
  const std::string crack = "<CrackList><Line xmin='6' ymin='12' xmax='9' ymax='12'/></CrackList>";
  check_choice({.bodies = thin_plate + thick_block, .more = crack}, true, "on faces, because " + why_faces);
  check_choice({.bodies = thick_block + two_platens, .more = crack}, true,
               "on faces, because 'block' lies between rigid faces on opposite sides");
  const std::string plate_below =
      "<Body matname='plate'><Rect xmin='4' xmax='14' ymin='4' ymax='9'/></Body>"
      "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='2' ymax='4'/></Body>"
      "<Body matname='platen'><Rect xmin='2' xmax='18' ymin='17' ymax='19'/></Body>";
  const std::string sides =
      "<Body matname='platen'><Rect xmin='2' xmax='4' ymin='9' ymax='17'/></Body>"
      "<Body matname='platen'><Rect xmin='14' xmax='16' ymin='9' ymax='17'/></Body>";
  const std::string bonds =
      "<Material Type='LinearInterface' Name='glue'><Dnt>1</Dnt><Dt>1</Dt></Material>"
      "<Material Type='Mohr' Name='joint'><stiffness-normal>1</stiffness-normal>"
      "<stiffness-shear>1</stiffness-shear></Material>";
  for (const char* law : {"<Friction law='4' matname='block'/>", "<Friction law='5' matname='block'/>"})
    check_choice({.bodies = thick_block + plate_below + sides, .materials = law, .more = bonds}, true,
                 "on faces, because 'block' lies between rigid faces on opposite sides");
}

TEST_CASE("settings for impulses on nodes keep them there", "[impulses]") {
  const std::string bodies = thin_plate + thick_block;
  const auto because = [](const std::string& what) { return "on nodes, because " + what + but_thin; };
  check_choice({.mode = "<MultiMaterialMode Normals='avggrad'/>", .bodies = bodies}, false,
               because("the command file sets the method for normals"));
  check_choice({.mode = "<MultiMaterialMode Separation='displacements'/>", .bodies = bodies}, false,
               because("the command file sets the method for gaps"));
}

TEST_CASE("the summary says where the impulses act", "[impulses][preflight]") {
  CHECK_THAT(preflight(deck_model({.bodies = thin_plate + thick_block}), 1),
             Contains("contact impulses: on faces, because " + why_faces));
  CHECK_THAT(preflight(deck_model({.bodies = thick_block + one_platen}), 1),
             Contains("contact impulses: " + why_nodes));
}

TEST_CASE("impulses of round blocks act on faces", "[contact]") {
  const std::string ball = "<Ball matname='platen' x='9' y='12' radius='3' rho='1'/>",
                    box = "<BoxBlock matname='platen' xmin='6' xmax='12' ymin='9' ymax='12' rho='1'/>";
  const auto deck = [](const std::string& block) {
    ImpulseDeck out;
    out.bodies = "<Body matname='plate'><Rect xmin='2' xmax='18' ymin='2' ymax='9'/></Body>";
    out.more = "<Material Type='SpringNetwork' Name='law'><kn>1</kn><ks>1</ks></Material><Blocks lawname='law'>" +
               block + "</Blocks>";
    return out;
  };
  check_choice(deck(ball), true, "on faces, because a block is curved");
  check_choice(deck(box), false, "on nodes, because no rigid block is curved");
  ImpulseDeck given = deck(ball);
  given.mode = "<MultiMaterialMode Normals='maxgrad'/>";
  check_choice(given, false, "on nodes, because the command file sets the method for normals");
}
