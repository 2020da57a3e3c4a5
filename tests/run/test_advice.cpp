// SPDX-License-Identifier: MIT
/// Advice on energy balances and on contact laws names what the model does not have yet.

#include "input/read.hpp"
#include "run/energy_advice.hpp"
#include "run/law_remarks.hpp"
#include "run/preflight.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using Catch::Contains;
using Catch::StartsWith;

namespace {

std::string deck(const std::string& mode, const std::string& law, const std::string& header = "<GIMP/>") {
  return "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
         "</Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime>" +
         header + mode +
         "</MPMHeader><Mesh><Grid xmin='0' xmax='10' ymin='0' ymax='20'><Horiz nx='10'/><Vert ny='20'/></Grid></Mesh>"
         "<MaterialPoints><Body matname='a'><Rect xmin='2' xmax='8' ymin='2' ymax='8'/></Body>"
         "<Body matname='b'><Rect xmin='2' xmax='8' ymin='8' ymax='14'/></Body></MaterialPoints>"
         "<Material Type='LinearElastic' Name='a'><rho>1000</rho><E>1e5</E><nu>0.3</nu></Material>"
         "<Material Type='LinearElastic' Name='b'><rho>1000</rho><E>1e5</E><nu>0.3</nu></Material>" +
         law + "</JANFEAInput>";
}

const std::string friction = "<Material Type='CoulombFriction' Name='rub'><coeff>0.2</coeff></Material>";

std::string remarks(const Model& model) {
  std::string all;
  for (const auto& text : remarks_on_contact_laws(model)) all += text + "\n";
  return all;
}

Model adhesive(const std::string& strengths) {
  return read_model_text(deck("<MultiMaterialMode><Friction lawname='glue'/></MultiMaterialMode>",
                              "<Material Type='AdhesiveFriction' Name='glue'>" + strengths + "</Material>"),
                         "deck.xml");
}

}  // namespace

TEST_CASE("a gain of energy is cured by what the scheme does not have", "[monitor]") {
  Scheme s;
  s.transfer = Transfer::flip, s.kernel = Kernel::gimp;
  CHECK_THAT(cure_of_gain(s), Contains("'APIC'") && Contains("USL-") && Contains("'quadratic'"));
  s.kernel = Kernel::quadratic_spline;
  CHECK_THAT(cure_of_gain(s), Contains("'APIC'") && !Contains("'quadratic'"));
  s.transfer = Transfer::apic;
  CHECK_THAT(cure_of_gain(s), !Contains("'APIC'") && Contains("USL-"));
  s.order = UpdateOrder::usl, s.extrapolate_again = false;
  CHECK(cure_of_gain(s) == "a smaller <TimeFactor>");
}

TEST_CASE("what avoids losses of energy, or where they are, depends on the scheme", "[monitor]") {
  Model model;
  model.scheme.order = UpdateOrder::usl, model.scheme.extrapolate_again = false;
  model.scheme.transfer = Transfer::flip;
  CHECK(cure_of_loss(model) == "USAVG- usually avoids most of this loss");
  model.scheme.order = UpdateOrder::usavg;
  CHECK_THAT(cure_of_loss(model), Contains("without <SkipPostExtrapolation/>"));
  model.scheme.order = UpdateOrder::usl, model.scheme.transfer = Transfer::fmpm;
  CHECK(cure_of_loss(model).empty());
  model.scheme.transfer = Transfer::flip, model.damping.particle = Expression(3.0);
  CHECK_THAT(cure_of_loss(model), Contains("USAVG") && Contains("'APIC'"));
  model.scheme.order = UpdateOrder::usavg;
  CHECK(cure_of_loss(model).empty());
  model.scheme.order = UpdateOrder::usf;
  CHECK(cure_of_loss(model).empty());
  model.scheme.transfer = Transfer::apic;
  CHECK_THAT(cure_of_loss(model), Contains("with USF this loss is what the transfer dissipates"));
}

TEST_CASE("USAVG- is the cure of a balance that exceeds, unless it is the scheme already", "[monitor]") {
  Scheme s;
  for (const auto order : {UpdateOrder::usl, UpdateOrder::usf, UpdateOrder::usavg}) {
    s.order = order, s.extrapolate_again = true;
    CHECK_THAT(cure_of_excess(s), StartsWith("USAVG- or a smaller <TimeFactor>"));
  }
  s.extrapolate_again = false;
  CHECK_THAT(cure_of_excess(s), StartsWith("a smaller <TimeFactor>"));
}

TEST_CASE("a contact law that nothing uses is told", "[preflight]") {
  CHECK_THAT(remarks(read_model_text(deck("<MultiMaterialMode/>", friction), "deck.xml")),
             Contains("the contact law 'rub' (deck.xml:") && Contains("is not used"));
  CHECK(remarks(read_model_text(deck("<MultiMaterialMode><Friction lawname='rub'/></MultiMaterialMode>", friction),
                                "deck.xml"))
            .empty());
}

TEST_CASE("impulses on faces with normals from elsewhere are remarked", "[preflight]") {
  const auto with = [](const std::string& attributes) {
    return remarks(read_model_text(
        deck("<MultiMaterialMode " + attributes + "><Friction lawname='rub'/></MultiMaterialMode>", friction),
        "deck.xml"));
  };
  CHECK_THAT(with("Impulses='faces' Normals='avggrad'"), Contains("Without 'Normals'"));
  CHECK(with("Impulses='faces'").empty());
  CHECK(with("Impulses='nodes' Normals='avggrad'").empty());
}

TEST_CASE("a bond with one strength only is warned of", "[preflight]") {
  CHECK(adhesive("<Sa>1e3</Sa><Na>1e3</Na>").warnings.empty());
  const auto one = [](const std::string& strength) {
    const auto warnings = adhesive(strength).warnings;
    return warnings.size() == 1 ? warnings.front() : std::string();
  };
  CHECK_THAT(one("<Na>1e3</Na>"), Contains("<Na> has no effect without <Sa>"));
  CHECK_THAT(one("<Sa>1e3</Sa>"), Contains("<Sa> is the cohesion"));
}

TEST_CASE("negative damping, and damping that exceeds what a step bears, are told", "[preflight]") {
  const auto damped = [](const std::string& rate) {
    return read_model_text(deck("", "", "<GIMP/><Damping>" + rate + "</Damping>"), "deck.xml");
  };
  REQUIRE(damped("-5").warnings.size() == 1);
  CHECK_THAT(damped("-5").warnings.front(), Contains("a negative <Damping> adds energy"));
  CHECK_THAT(preflight(damped("1e3"), 1), Contains("<Damping> takes"));
  CHECK_THAT(preflight(damped("1"), 1), !Contains("<Damping> takes"));
}

TEST_CASE("materials that share a velocity field are listed as without contact", "[preflight]") {
  std::string text = deck("<MultiMaterialMode/>", "");
  const auto at = text.rfind("<nu>0.3</nu>");
  text.insert(at, "<shareMatField>1</shareMatField>");
  CHECK_THAT(preflight(read_model_text(text, "deck.xml"), 1),
             Contains("no contact of 'b' and 'a': they share one velocity field"));
}

TEST_CASE("thermal properties without effect are remarked", "[preflight]") {
  const std::string ramp =
      "<CustomTasks><Schedule name='ThermalRamp'><Parameter name='time'>0.5</Parameter>"
      "<Parameter name='DeltaT'>20</Parameter></Schedule></CustomTasks>";
  const auto sheet = [&](const std::string& of_material, const std::string& more, const std::string& of_body = "") {
    std::string text = deck("", more);
    const std::string body = "<Body matname='a'";
    text.insert(text.find(body) + body.size(), of_body);
    const std::string end = "</nu>";
    for (auto at = text.find(end); at != std::string::npos; at = text.find(end, at + 1))
      text.insert(at + end.size(), of_material);
    return preflight(read_model_text(text, "deck.xml"), 1);
  };
  CHECK_THAT(sheet("", ramp), Contains("no material has <alpha>"));
  CHECK_THAT(sheet("<alpha>12</alpha>", ramp), !Contains("<alpha>"));
  CHECK_THAT(sheet("<Cv>400</Cv><kCond>50</kCond>", ""), Contains("<kCond> has no effect"));
  CHECK_THAT(sheet("<Cv>400</Cv><kCond>50</kCond>", "<Thermal><Conduction/></Thermal>"), !Contains("has no effect"));
  CHECK_THAT(sheet("<alpha>12</alpha>", "", " temp='100'"), Contains("starts 100 above <StressFreeTemp>"));
  CHECK_THAT(sheet("", "", " temp='100'"), !Contains("StressFreeTemp"));
}
