// SPDX-License-Identifier: MIT
/// Remarks of `tribo check` on units, gravity and what holds the bodies.

#include "input/read.hpp"
#include "input/script/script.hpp"
#include "run/preflight.hpp"
#include "run/unit_remarks.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;

namespace {

// A block 4 high with some material and gravity, in mm, g and ms or other units.
std::string block_sheet(const std::string& material, const std::string& more = "",
                        const std::string& units = "length='mm' mass='g' time='ms'") {
  return preflight(read_model_text("<JANFEAInput version='3'><Header><Analysis>10</Analysis>" +
                                       (units.empty() ? "" : "<ConsistentUnits " + units + "/>") + R"(</Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='Bar'><Rect xmin='4' xmax='8' ymin='2' ymax='6'/></Body></MaterialPoints>
 <Material Type='LinearElastic' Name='Bar'>)" +
                                       material + "</Material>" + more + "</JANFEAInput>",
                                   "deck.xml"),
                   1);
}

std::string elastic(const std::string& density, const std::string& modulus) {
  return "<rho>" + density + "</rho><E>" + modulus + "</E><nu>0</nu>";
}
std::string gravity_along_y(const std::string& value) {
  return "<Gravity><BodyYForce>" + value + "</BodyYForce></Gravity>";
}

}  // namespace

TEST_CASE("densities and moduli in other units are remarked", "[check]") {
  const std::string remark = "unusual for a solid";
  CHECK_THAT(block_sheet(elastic("2.4e-3", "33000")), !Contains(remark));
  CHECK_THAT(block_sheet(elastic("2400", "33000")),
             Contains("the wave speed of 'Bar' is 3.71 m/s at a density of 2.4e+09 kg/m^3, unusual for a solid"));
  CHECK_THAT(block_sheet(elastic("1e-3", "1e10")), Contains("is 3.16e+06 m/s") && Contains(remark));
  // gigapascals where megapascals are expected
  CHECK_THAT(block_sheet(elastic("7.8e-3", "210")), Contains("the wave speed of 'Bar' is 164 m/s") && Contains(remark));
  CHECK_THAT(block_sheet(elastic("7.8e-3", "210000")), !Contains(remark));
  CHECK_THAT(block_sheet(elastic("2e-3", "50")), !Contains(remark));  // soil
  // models without units in m, kg and s
  CHECK_THAT(block_sheet(elastic("1", "1"), "", "length='m' mass='kg' time='s'"), !Contains(remark));
  CHECK_THAT(block_sheet(elastic("2400", "33000"), "", "length='L' mass='M' time='T'"), !Contains(remark));
  CHECK_THAT(block_sheet(elastic("2.4e-9", "33000"), "", "length='mm' mass='t' time='s'"),
             !Contains(remark) && Contains("units: mm, t, s; stress MPa"));
}

TEST_CASE("properties in other units and nearly incompressible solids are remarked", "[check]") {
  const std::string si = "length='m' mass='kg' time='s'", density = "less than that of the lightest foams";
  CHECK_THAT(block_sheet(elastic("1.6", "1e7"), "", si), Contains("the density of 'Bar' is 1.6 kg/m^3, " + density));
  CHECK_THAT(block_sheet(elastic("1600", "1e7"), "", si), !Contains(density));
  CHECK_THAT(block_sheet(elastic("1.6", "1"), "", si), !Contains(density));  // no real material
  const auto with = [&](const std::string& more) { return block_sheet(elastic("7800", "2e11") + more, "", si); };
  CHECK_THAT(with("<alpha>1.2e-5</alpha>"),
             Contains("alpha 1.2e-05, is in 10^-6 per kelvin: 1.2e-05 per kelvin would be 12"));
  CHECK_THAT(with("<alpha>12</alpha>"), !Contains("thermal expansion"));
  const auto of_ratio = [&](const std::string& nu) {
    return block_sheet("<rho>1000</rho><E>1e6</E><nu>" + nu + "</nu>", "", si);
  };
  CHECK_THAT(of_ratio("0.49999"), Contains("'Bar' is nearly incompressible (nu 0.49999)") && Contains("224 times"));
  CHECK_THAT(of_ratio("0.49"), !Contains("incompressible"));
}

TEST_CASE("a gravity of another unit or direction is remarked", "[check]") {
  const auto with = [](const std::string& value, const std::string& units) {
    return block_sheet(elastic("1", "1e9"), gravity_along_y(value), units);
  };
  const std::string si = "length='m' mass='kg' time='s'", mm = "length='mm' mass='kg' time='s'";
  CHECK_THAT(with("-9.81", mm), Contains("gravity is 9.81 mm/s^2, which is 0.00981 m/s^2: 9.81 m/s^2 are 9810 in "
                                         "these units"));
  CHECK_THAT(with("-9810", mm), !Contains("gravity is"));
  CHECK_THAT(with("-9810", si), Contains("which is 9.81e+03 m/s^2"));
  for (const char* value : {"-9.81", "-9.80665", "-10", "-1", "-981", "-0.5"}) {
    INFO(value);
    CHECK_THAT(with(value, si), !Contains("gravity is") && !Contains("upwards"));
  }
  CHECK_THAT(with("9.81", si), Contains("gravity acts upwards"));
}

TEST_CASE("a body that is too soft for its own weight is remarked", "[check]") {
  const std::string si = "length='m' mass='kg' time='s'", floor = gravity_along_y("-10"), remark = "its own weight";
  // Its particles are 3.5 apart: 2000*10*3.5 = 70000
  CHECK_THAT(block_sheet(elastic("2000", "3e5"), floor, si), !Contains(remark));
  CHECK_THAT(block_sheet(elastic("2000", "2e5"), floor, si),
             Contains("gravity times its height is 0.35 times its modulus"));
  CHECK_THAT(block_sheet(elastic("2000", "20"), floor, si), Contains("'Bar' is too soft for its own weight"));
}

TEST_CASE("legacy units and angles in radians are told", "[check]") {
  CHECK_THAT(block_sheet(elastic("1", "100"), "", ""), Contains("without <ConsistentUnits> the numbers of the file"));
  CHECK_THAT(block_sheet(elastic("1", "100")), !Contains("legacy"));
  const auto sand = [](const std::string& angle) {
    return block_sheet(elastic("1", "100"), "<Material Type='MohrCoulomb' Name='Sand'>" + elastic("1", "100") +
                                                "<cohesion>1</cohesion><friction>" + angle + "</friction></Material>");
  };
  CHECK_THAT(sand("0.52"), Contains("the friction angle of 'Sand', friction 0.52, is below one degree"));
  CHECK_THAT(sand("30"), !Contains("below one degree"));
  CHECK_THAT(sand("0"), !Contains("below one degree"));
  const auto rough = [](const std::string& coefficient) {
    return block_sheet(elastic("1", "100"),
                       "<Material Type='CoulombFriction' Name='Rough'><coeff>" + coefficient + "</coeff></Material>");
  };
  CHECK_THAT(rough("30"), Contains("the friction coefficient of 'Rough', coeff 30, looks like an angle: the "
                                   "coefficient of 30 degrees is 0.577"));
  CHECK_THAT(rough("1.2"), !Contains("looks like an angle"));
}

TEST_CASE("bodies that nothing holds are remarked", "[check]") {
  const std::string falls = "nothing holds the bodies", si = "length='m' mass='kg' time='s'";
  CHECK_THAT(block_sheet(elastic("1", "1e9"), gravity_along_y("-10"), si), Contains(falls));
  CHECK_THAT(block_sheet(elastic("1", "1e9"), "", si), !Contains(falls));
  CHECK_THAT(block_sheet(elastic("1", "1e9"),
                         gravity_along_y("-10") + "<GridBCs><BCLine x1='0' x2='20' y1='0' y2='0' tolerance='*0.1'>"
                                                  "<DisBC dir='2' vel='0'/></BCLine></GridBCs>",
                         si),
             !Contains(falls));
}

TEST_CASE("advice on a script names its commands", "[check]") {
  CHECK(in_words_of_scripts("let it grow (<GridBodyYForce> as a function of t), set by <TimeStep>") ==
        "let it grow ('Gravity' as a function of t), set by 'TimeStep'");
  CHECK(in_words_of_scripts("Use <GIMP type='uGIMP'/> where <GIMP/> is") ==
        "Use 'MPMMethod' with uGIMP where 'MPMMethod' is");
  CHECK(in_words_of_scripts("often avoided by <Transfer type='APIC'/>, <GIMP type='quadratic'/>") ==
        "often avoided by 'Transfer APIC', 'MPMMethod' with B2SPLINE");
  CHECK(in_words_of_scripts("<Transfer type='FMPM' order='2'/> or Impulses='nodes'") ==
        "'Transfer FMPM,2' or Impulses='nodes'");
}

TEST_CASE("a model of blocks tells gravity and what is missing", "[check]") {
  const auto with = [](const std::string& gravity, const std::string& hold) {
    return preflight(read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1e-3</MaxTime><ArchiveTime>1e-3</ArchiveTime></MPMHeader>
 <Blocks lawname='joint'>
  <BoxBlock name='base' xmin='0' xmax='1' ymin='0' ymax='1' rho='2000'/>
  <BoxBlock name='rock' xmin='0' xmax='1' ymin='1' ymax='2' rho='2000'/>)" +
                                         hold + R"(</Blocks>
 <Material Type='Mohr' Name='joint'><stiffness-normal>1e9</stiffness-normal><stiffness-shear>1e9</stiffness-shear>
 </Material>)" + gravity + "</JANFEAInput>",
                                     "blocks.xml"),
                     1);
  };
  const std::string hold = "<Hold blocks='base' vx='0' vy='0' spinz='0'/>";
  CHECK_THAT(with("", ""), Contains("gravity: none") && Contains("nothing moves the blocks"));
  CHECK_THAT(with(gravity_along_y("-10"), ""), Contains("gravity: down 10 (along -y)") && Contains("no block is held"));
  CHECK_THAT(with(gravity_along_y("-10"), hold), !Contains("to look at"));
  CHECK_THAT(with(gravity_along_y("10"), hold), Contains("gravity acts upwards"));
}
