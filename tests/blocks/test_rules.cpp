// SPDX-License-Identifier: MIT
/// Rules that assign joint laws to contacts of blocks, and the laws of contacts formed during the run.

#include "archived.hpp"
#include "blocks/block_cases.hpp"
#include "input/read.hpp"

#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A plane that descends by `dip` in a direction, clockwise from y; in two dimensions to the right for 90 degrees.
Vec3 normal_of(double dip, double direction, bool plane) {
  const double out = std::sin(dip * degree), up = std::cos(dip * degree), to = direction * degree;
  return plane ? Vec3(out * std::sin(to), up, 0) : Vec3(out * std::sin(to), out * std::cos(to), up);
}

JointSite unit_face(double gap) {
  JointSite site;
  site.area = site.distance = 1.0, site.gap = gap;
  return site;
}

Model model_of(const std::string& blocks) {
  return read_model_text(
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' "
      "time='s'/></Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>" +
          blocks +
          "<Material Type='SpringNetwork' Name='bond'><kn>1e8</kn><ks>5e7</ks><fric>0.5</fric><sn_ten>1e5</sn_ten>"
          "<sn_coh>1e5</sn_coh><bond>gap 1e-6</bond></Material>"
          "<Material Type='Mohr' Name='joint'><stiffness-normal>2e8</stiffness-normal><stiffness-shear>1e8"
          "</stiffness-shear><friction>40</friction><friction-residual>30</friction-residual><cohesion>1e4</cohesion>"
          "</Material></JANFEAInput>",
      "blocks.xml");
}

std::string problem_of(const std::string& blocks) {
  try {
    model_of(blocks);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

constexpr const char* two_on_a_floor =
    "<BoxBlock name='floor' xmin='-2' xmax='2' ymin='-1' ymax='0' rho='2000' kn='1e8' ks='2e8' fric='0.6'/>"
    "<BoxBlock name='cube' xmin='0' xmax='1' ymin='0' ymax='1' rho='2000' kn='3e8' ks='2e8' fric='0.4'/>"
    "<BoxBlock name='lid' xmin='0' xmax='1' ymin='1' ymax='2' rho='2000'/>";

}  // namespace

TEST_CASE("a rule fits the contacts that fulfil all its criteria", "[blocks][rules]") {
  BlockPairing contact;
  contact.groups = {2, 5}, contact.place = Vec3(1, 1, 0), contact.normal = normal_of(30, 90, true);
  BlockJoint rule;
  CHECK(rule.fits(contact, true));
  SECTION("groups, in either order") {
    rule.groups = {std::vector<std::int32_t>{5}, {2, 3}};
    CHECK(rule.fits(contact, true));
    rule.groups = {std::vector<std::int32_t>{2}, {2}};
    CHECK_FALSE(rule.fits(contact, true));
    rule.groups = {std::vector<std::int32_t>{5}, {}};
    CHECK(rule.fits(contact, true));
  }
  SECTION("shapes") {
    rule.where = around(0, 2, 0, 2);
    CHECK(rule.fits(contact, true));
    contact.place[0] = 3;
    CHECK_FALSE(rule.fits(contact, true));
  }
  SECTION("kind and time") {
    rule.kind = BlockPairing::Kind::balls;
    CHECK_FALSE(rule.fits(contact, true));
    contact.kind = BlockPairing::Kind::balls;
    CHECK(rule.fits(contact, true));
    contact.later = true;
    CHECK_FALSE(rule.fits(contact, true));
    rule.later = true, rule.at_start = false;
    CHECK(rule.fits(contact, true));
    contact.later = false;
    CHECK_FALSE(rule.fits(contact, true));
  }
  SECTION("dip and its direction, for either sign of the normal") {
    for (const bool plane : {true, false})
      for (const double sign : {1.0, -1.0})
        for (const double direction : {90.0, 270.0}) {
          contact.normal = sign * normal_of(30, direction, plane);
          rule.dip = {20 * degree, 40 * degree}, rule.dip_direction = {};
          CHECK(rule.fits(contact, plane));
          rule.dip = {31 * degree, 90 * degree};
          CHECK_FALSE(rule.fits(contact, plane));
          rule.dip = {}, rule.dip_direction = {80 * degree, 100 * degree};
          CHECK(rule.fits(contact, plane) == (direction == 90));
          rule.dip_direction = {200 * degree, 280 * degree};
          CHECK(rule.fits(contact, plane) == (direction == 270));
        }
    rule.dip_direction = {350 * degree, 10 * degree};
    for (const double direction : {355.0, 0.0, 5.0, 180.0, 20.0}) {
      contact.normal = normal_of(30, direction, false);
      CHECK(rule.fits(contact, false) == (direction != 180 && direction != 20));
    }
    contact.normal = normal_of(90, 180, false);  // an upright face descends to both sides
    CHECK(rule.fits(contact, false));
    contact.normal = normal_of(0, 0, false);  // a level one to none
    CHECK(rule.fits(contact, false));
  }
}

TEST_CASE("the first rule that fits gives a contact its law", "[blocks][rules]") {
  const Model model = model_of("<Blocks lawname='bond'>" + std::string(two_on_a_floor) +
                               "<Joint lawname='joint' blocks='floor' with='any'/></Blocks>");
  const Assembly body(model.blocks, 2, false, Vec3::Zero(), 1.0);
  REQUIRE(body.contacts.size() >= 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const bool on_floor = body.contacts[k].a == 0 || body.contacts[k].b == 0;
    CHECK(body.joints[k].kn == (on_floor ? 2e8 : 1e8));
  }
}

TEST_CASE("contacts inherit the properties of both surfaces", "[blocks][rules]") {
  const Model model = model_of("<Blocks lawname='joint' inherit='yes'>" + std::string(two_on_a_floor) + "</Blocks>");
  const Assembly body(model.blocks, 2, false, Vec3::Zero(), 1.0);
  for (std::size_t k = 0; k < 2; ++k) {
    const bool on_floor = body.contacts[k].a == 0 || body.contacts[k].b == 0;
    CHECK(body.joints[k].kn == Approx(on_floor ? 0.75e8 : 2e8));  // in series
    CHECK(body.joints[k].ks == Approx(on_floor ? 1e8 : 1e8));
  }
  const auto* law = model.blocks->laws.initial_of({1, 0});
  Joint j = law->start(unit_face(0.0));
  j.Fn = -10;
  std::vector<JointEvent> events;
  JointIncrement d;
  d.shear = {0, 1};
  j.shear_weak = true, j.state = 4;
  law->update({&j, 1}, {&d, 1}, events);
  CHECK(j.Fs.norm() == Approx(0.4 * 10));  // the smaller friction, without residual cohesion
}

TEST_CASE("laws give the law of contacts that form later", "[blocks][rules]") {
  const auto friction_of = [](const JointLaw& law) {
    Joint j = law.start(unit_face(1e-3));
    CHECK(j.away);
    CHECK_FALSE(law.is_bonded(j));
    std::vector<JointEvent> events;
    JointIncrement d;
    d.normal = -2e-3, d.gap = -1e-3, d.shear = {0, 1};
    law.update({&j, 1}, {&d, 1}, events);
    CHECK(j.Fn == Approx(-1e-3 * j.kn));
    return j.Fs.norm() / -j.Fn;
  };
  const auto bond = joint_law(
      "SpringNetwork",
      {{"kn", "1e8"}, {"ks", "1e8"}, {"fric", "0.5"}, {"sn_ten", "1e9"}, {"sn_coh", "1e9"}, {"bond", "gap 1"}});
  CHECK(friction_of(*bond->for_new_contacts()) == Approx(0.5));
  const auto mohr = joint_law("Mohr", {{"stiffness-normal", "1e8"},
                                       {"stiffness-shear", "1e8"},
                                       {"cohesion", "1e9"},
                                       {"friction", "40"},
                                       {"friction-residual", "30"}});
  CHECK(friction_of(*mohr->for_new_contacts()) == Approx(std::tan(30 * degree)));
}

TEST_CASE("blocks that collapse need no law by name", "[blocks][rules]") {
  for (const char* law : {"bond", "joint"}) {
    const Model model = model_of("<Blocks lawname='" + std::string(law) + "' damping='0.3'>" +
                                 "<BoxBlock xmin='-2' xmax='2' ymin='-1' ymax='0' rho='2000'/>"
                                 "<BoxBlock xmin='0' xmax='1' ymin='0.01' ymax='1.01' rho='2000'/>"
                                 "<Hold vx='0' vy='0' spinz='0'><Rect xmin='-2' xmax='2' ymin='-1' ymax='0'/></Hold>"
                                 "</Blocks>");
    Assembly body(model.blocks, 2, false, Vec3(0, -10, 0), 1.0);
    const double dt = body.critical_step();
    for (int k = 0; k * dt < 2; ++k) body.advance(dt), body.check_contacts();
    const double kn = law == std::string("bond") ? 1e8 : 2e8;
    CHECK(body.motion[1].x[1] - 0.5 == Approx(-2000 * 10 / kn).epsilon(1e-3));
  }
  const Model refused = model_of(
      "<Blocks lawname='bond' touchname='none'>"
      "<BoxBlock xmin='-2' xmax='2' ymin='-1' ymax='0' rho='2000'/>"
      "<BoxBlock xmin='0' xmax='1' ymin='0.01' ymax='1.01' rho='2000'/></Blocks>");
  CHECK(refused.blocks->laws.later == nullptr);
}

TEST_CASE("a rule has the contact points of the blocks unless it has its own", "[blocks][rules]") {
  const auto contacts = [](const std::string& of_blocks, const std::string& of_rule) {
    const Model model = model_of("<Blocks lawname='joint'" + of_blocks +
                                 "><BoxBlock name='a' xmin='0' xmax='1' ymin='-1' ymax='0' rho='2000'/>"
                                 "<BoxBlock name='b' xmin='0' xmax='1' ymin='0' ymax='1' rho='2000'/>"
                                 "<Joint lawname='joint' blocks='a' with='b'" +
                                 of_rule + "/></Blocks>");
    return Assembly(model.blocks, 2, false, Vec3::Zero(), 1.0).contacts.size();
  };
  CHECK(contacts("", "") == 1);
  CHECK(contacts("", " points='corners'") == 2);
  CHECK(contacts(" points='corners'", "") == 2);
  CHECK(contacts(" points='corners'", " points='face'") == 1);
}

TEST_CASE("blocks are held and loaded by their names, and also by shapes", "[blocks][rules]") {
  const std::string row =
      "<BoxBlock name='base' xmin='0' xmax='1' ymin='0' ymax='1' rho='2000'/>"
      "<BoxBlock name='base' xmin='3' xmax='4' ymin='0' ymax='1' rho='2000'/>"
      "<BoxBlock name='top' xmin='6' xmax='7' ymin='0' ymax='1' rho='2000'/>";
  const auto assembly = [&](const std::string& rest) {
    return Assembly(model_of("<Blocks lawname='joint'>" + row + rest + "</Blocks>").blocks, 2, false, Vec3::Zero(),
                    1.0);
  };
  Assembly held = assembly("<Hold blocks='base' vx='0' vy='0'/><Load blocks='base top' Fx='5'/>");
  const auto in_plane = [](const Assembly& a, std::size_t k) { return a.bodies[k].held & 3; };
  CHECK((in_plane(held, 0) == 3 && in_plane(held, 1) == 3 && in_plane(held, 2) == 0));
  held.advance(1e-6);
  CHECK((held.motion[0].v[0] == 0 && held.motion[2].v[0] > 0));
  const Assembly both = assembly("<Hold blocks='base' vx='0'><Rect xmin='2' xmax='9' ymin='0' ymax='1'/></Hold>");
  CHECK((in_plane(both, 0) == 0 && in_plane(both, 1) == 1 && in_plane(both, 2) == 0));
  CHECK_THROWS_WITH(assembly("<Hold blocks='bas' vx='0'/>"), Catch::Contains("base"));
  CHECK_THROWS_WITH(assembly("<Hold blocks='top' vx='0'><Rect xmin='0' xmax='4' ymin='0' ymax='1'/></Hold>"),
                    Catch::Contains("none of these blocks"));
}

TEST_CASE("faces that have turned are replaced without a jump of their force", "[blocks][rules]") {
  const Model model = model_of(
      "<Blocks lawname='joint'><BoxBlock xmin='-2' xmax='2' ymin='-1' ymax='0' rho='2000'/>"
      "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='2000' spinz='-0.2'/>"
      "<Hold vx='0' vy='0' spinz='0'><Rect xmin='-2' xmax='2' ymin='-1' ymax='0'/></Hold></Blocks>");
  Assembly body(model.blocks, 2, false, Vec3(0, -10, 0), 1.0);
  const double dt = body.critical_step(), energy = body.ledger().kinetic;
  bool replaced = false;
  double most = energy;
  for (int k = 0; k * dt < 0.5; ++k) {
    body.advance(dt);
    const bool before = replaced;
    for (const ContactGroup& g : body.groups) replaced |= g.kind == ContactKind::overlap && body.joints[g.begin].Fn < 0;
    const BlockLedger l = body.ledger();
    // The springs would have stored 2e8 (0.015 m)^2/6 per metre, 7.5 kJ, all of it from nowhere. One percent of that
    // remains for springs whose area changes.
    most = std::max(most, l.kinetic + l.strain + l.potential);
    if (replaced && !before) CHECK(body.contacts.back().set_back > 1e-3);
  }
  CHECK(replaced);
  CHECK(most < energy + 75);
}

TEST_CASE("contacts that form later keep their laws over a restart", "[blocks][rules]") {
  std::string balls =
      "<Blocks lawname='bond'><BoxBlock name='floor' xmin='-1' xmax='9' ymin='-1' ymax='0' rho='2000'/>"
      "<Hold vx='0' vy='0' spinz='0'><Rect xmin='-1' xmax='9' ymin='-1' ymax='0'/></Hold>"
      "<Joint lawname='joint' contacts='later' kind='ball-face'/>"
      "<Joint lawname='joint' contacts='later' kind='balls' blocks='right'/>";
  for (int k = 0; k < 8; ++k)
    balls += "<Ball name='" + std::string(k < 4 ? "left" : "right") + "' x='" + std::to_string(1.01 * k) + "' y='" +
             std::to_string(0.55 + 0.01 * (k % 3)) + "' radius='0.5' rho='2000' vx='" + (k < 4 ? "2" : "-2") + "'/>";
  const Model model = model_of(balls + "</Blocks>");
  const Vec3 gravity(0, -10, 0);
  Assembly body(model.blocks, 2, false, gravity, 1.0);
  const double dt = body.critical_step();
  for (int k = 0; k < 300; ++k) body.advance(dt);
  const ArchivedState saved = archived(body);
  const auto pairs = body.found_pairs();
  std::vector<int> of_law(3, 0);  // by rules, then the rest
  for (std::size_t k = 0; k < pairs.size(); k += 3) ++of_law.at(static_cast<std::size_t>(pairs[k]));
  for (const int found : of_law) CHECK(found > 0);
  for (int k = 0; k < 300; ++k) body.advance(dt);
  Assembly again(model.blocks, 2, false, gravity, 1.0);
  restore(saved, again);
  for (int k = 0; k < 300; ++k) again.advance(dt);
  CHECK(differences(archived(body), archived(again)).empty());
}

TEST_CASE("wrong rules are told with what is right", "[blocks][rules]") {
  const auto with = [](const std::string& joint) {
    return problem_of("<Blocks lawname='bond'>" + std::string(two_on_a_floor) + joint + "</Blocks>");
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  CHECK(has(with("<Joint lawname='joint' blocks='flor'/>"), "did you mean 'floor'"));
  CHECK(has(with("<Joint lawname='joint'/>"), "has no shape"));
  CHECK(has(with("<Joint lawname='joint' with='lid'/>"), "'with' needs 'blocks'"));
  CHECK(has(with("<Joint lawname='joint' dip='10'/>"), "two angles"));
  CHECK(has(with("<Joint lawname='joint' dip='10 100'/>"), "from 0 to 90"));
  CHECK(has(with("<Joint lawname='joint' dip='30 10'/>"), "must not exceed"));
  CHECK(has(problem_of("<Blocks lawname='bond' inherit='yes'><BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1'/>"
                       "</Blocks>"),
            "has no effect"));
}
