// SPDX-License-Identifier: MIT
/// The old form of contact laws, in which a number selects the law.

#include "contact/contact_law.hpp"
#include "input/read.hpp"
#include "model/model.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

std::shared_ptr<const ContactLaw> law_of_number(const std::string& number) {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>
  <MultiMaterialMode><Friction Dn='7' Dt='5'>)" +
                             number + R"(</Friction></MultiMaterialMode></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='a'><Rect xmin='6' xmax='10' ymin='3' ymax='7'/></Body></MaterialPoints>
 <Material Type='1' Name='a'><rho>1</rho><E>100</E><nu>0</nu></Material></JANFEAInput>)",
                         "deck.xml")
      .contact.default_law;
}

}  // namespace

TEST_CASE("a number selects the contact law, with limits at -10, 0 and 10", "[input][contact]") {
  ContactState pressed, parting;
  pressed.mass = parting.mass = 2, pressed.dt = parting.dt = 1, pressed.area = parting.area = 1;
  pressed.velocity = Vec3(-1, 100, 0), parting.velocity = Vec3(1, 0, 0);
  const auto shear = [&](const std::string& number) { return law_of_number(number)->response(pressed).impulse[1]; };
  for (const char* ignores : {"-11", "-10"}) {
    CHECK_FALSE(law_of_number(ignores)->uses_face());
    CHECK(law_of_number(ignores)->response(parting).impulse[0] == Approx(2));
  }
  for (const char* sticks : {"-9.999", "-1e-9"}) {
    CHECK(law_of_number(sticks)->uses_face());
    CHECK(shear(sticks) == Approx(200));
    CHECK(law_of_number(sticks)->response(parting).impulse.norm() == 0);
  }
  for (const char* coefficient : {"0", "1e-9", "0.3", "9.999"})
    CHECK(shear(coefficient) == Approx(2 * std::stod(coefficient)));
  for (const char* interface : {"10", "11"}) {
    const auto law = law_of_number(interface);
    REQUIRE(law->interface());
    CHECK(law->stiffness() == Approx(7));
  }
}
