// SPDX-License-Identifier: MIT
/// What stages change of joints and of contacts of blocks.

#include "base/parallel.hpp"
#include "contact/joint_law.hpp"
#include "run/simulation.hpp"
#include "scratch.hpp"
#include "staged_models.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tribo;
using namespace tribo::test;

namespace {

// A joint law with the properties `name value name value`; values may be several words joined by commas.
std::shared_ptr<JointLaw> law(const std::string& type, const std::string& properties) {
  Statement s;
  std::istringstream words(properties);
  for (std::string name, value; words >> name >> value;) {
    std::replace(value.begin(), value.end(), ',', ' ');
    Statement child;
    child.name = name, child.text = value;
    s.children.push_back(child);
  }
  Problems problems;
  auto made = joint_laws().find(type)->make(s, {}, Units{}, problems);
  problems.raise();
  return made;
}

}  // namespace

TEST_CASE("joints take over another stiffness at the same forces", "[stages]") {
  JointSite site;
  site.area = 2.0, site.distance = 1.0;
  const auto soft = law("Mohr", "stiffness-normal 10 stiffness-shear 5 friction 30 friction-residual 30 cohesion 9"),
             stiff = law("Mohr", "stiffness-normal 40 stiffness-shear 5 friction 30 friction-residual 30 cohesion 9");
  Joint joint = soft->start(site);
  std::vector<JointEvent> events;
  JointIncrement d;
  d.normal = -0.1, d.shear.t = 0.2, d.gap = -0.1;
  soft->update({&joint, 1}, {&d, 1}, events);
  CHECK(joint.Fn == Approx(-2.0));
  const Joint before = joint;
  stiff->adopt(joint, *soft, site);
  CHECK(joint.Fn == before.Fn);
  CHECK(joint.Fs.t == before.Fs.t);
  CHECK(joint.kn == 40);
  CHECK(joint.strain - before.strain == Approx(0.5 * 4.0 / 80 - 0.5 * 4.0 / 20));
  CHECK(joint.released() == Approx(before.released()).margin(1e-12));
  // A bond that is broken and bonded again
  CHECK_FALSE(soft->bond(joint));
  CHECK(stiff->unbond(joint));
  CHECK(joint.shear_weak);
  CHECK(joint.Fn == before.Fn);
  CHECK_FALSE(stiff->unbond(joint));
  CHECK(stiff->bond(joint));
  CHECK_FALSE(joint.shear_weak);
  const auto network = law("SpringNetwork", "kn 10 ks 5"), twice = law("SpringNetwork", "kn 20 ks 10");
  Joint loose = network->start(site);
  CHECK_FALSE(network->is_bonded(loose));
  CHECK(network->bond(loose));
  CHECK(network->is_bonded(loose));
  twice->adopt(loose, *network, site);
  CHECK(loose.kn == 20);
  CHECK(twice->unbond(loose));
  CHECK_FALSE(twice->is_bonded(loose));
}

TEST_CASE("blocks follow the gravity and the laws of stages, to the bit", "[stages]") {
  const std::string text = R"(<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader><TimeStep>0.001</TimeStep><MaxTime>0.4</MaxTime><ArchiveTime>0.1</ArchiveTime>
    <GlobalArchiveTime>0.002</GlobalArchiveTime><GlobalArchive type='velx' block='box'/></MPMHeader>
  <Material Type='Mohr' Name='joint'><stiffness-normal>1e7</stiffness-normal><stiffness-shear>1e7</stiffness-shear>
    <friction>40</friction><friction-residual>40</friction-residual></Material>
  <Blocks lawname='joint' points='corners' damping='0.7'>
    <BoxBlock name='floor' xmin='-3' xmax='6' ymin='-1' ymax='0' rho='2000'/>
    <BoxBlock name='box' xmin='-0.5' xmax='0.5' ymin='0' ymax='0.25' rho='2000'/>
    <Hold vx='0' vy='0' spinz='0'><Rect xmin='-3' xmax='6' ymin='-1' ymax='-0.1'/></Hold>
  </Blocks>
  <Gravity><BodyXForce>4</BodyXForce><BodyYForce>-10</BodyYForce></Gravity>
  <Stage at='0.2'><Material Name='joint'><friction>10</friction><friction-residual>10</friction-residual></Material>
    <Blocks damping='0'/></Stage>
  <Stage at='0.3'><Gravity><BodyYForce>-10</BodyYForce></Gravity></Stage>
</JANFEAInput>)";
  const ScratchFolder scratch;
  const Model model = read_model_text(text, "blocks.xml");
  RunOptions options;
  options.quiet = true, options.folder = scratch.path / "whole";
  REQUIRE(run(model, options) == Outcome::finished);
  const auto rows = rows_of(scratch.path / "whole" / "history.csv");
  const auto speed = [&](double time) {
    for (const auto& row : rows)
      if (std::abs(row[0] - time) < 0.00105) return row[1];
    return -1.0;
  };
  const double tan10 = std::tan(10 * M_PI / 180);
  CHECK(std::abs(speed(0.19)) < 0.05);  // it holds
  // It slides with the acceleration g_x - mu g_y, then is braked by mu g.
  CHECK(speed(0.3) - speed(0.22) == Approx(0.08 * (4 - 10 * tan10)).epsilon(0.02));
  CHECK(speed(0.4) - speed(0.32) == Approx(-0.08 * 10 * tan10).epsilon(0.02));
  const auto energy = rows_of(scratch.path / "whole" / "energy.csv");
  for (const auto& row : energy) CHECK(std::abs(row[10]) < 1e-6 * 1e4);
  options.folder = scratch.path / "parts", options.max_wall = 1e-4;
  for (int k = 0; run(model, options) == Outcome::stopped && k < 5000; ++k) {
    options.resume = true;
    options.max_wall = k % 2 ? 1e-4 : 0.02;
  }
  for (const char* file : {"history.csv", "energy.csv", "stages.csv", "events.csv", "checkpoint.bin"})
    CHECK(contents(scratch.path / "whole" / file) == contents(scratch.path / "parts" / file));
}

TEST_CASE("the former law of contacts of blocks is found for later contacts and inherited surfaces, too", "[stages]") {
  const auto with = [](const std::string& stiffness) {
    return read_model_text(
        "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
        "</Header><MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>"
        "<Blocks lawname='bond' inherit='yes'>"
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1000' name='floor' kn='1e8' ks='1e8' fric='0.4'/>"
        "<BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='1000' name='block' kn='3e8' ks='1e8' fric='0.5'/>"
        "<Joint lawname='rock' blocks='floor' with='any'/></Blocks>"
        "<Material Type='SpringNetwork' Name='bond'><kn>" +
            stiffness +
            "</kn><ks>1e8</ks><fric>0.3</fric><sn_ten>1e9</sn_ten><sn_coh>1e9</sn_coh><bond/></Material>"
            "<Material Type='Mohr' Name='rock'><stiffness-normal>" +
            stiffness + "</stiffness-normal><stiffness-shear>1e8</stiffness-shear></Material></JANFEAInput>",
        "blocks.xml");
  };
  const Model then = with("1e8"), now = with("2e8");
  REQUIRE(now.blocks->joints.size() == 1);
  std::size_t found = 0;
  for (std::size_t rule = 0; rule < 2; ++rule) {
    const BlockLaws &a = then.blocks->laws_of(rule), &b = now.blocks->laws_of(rule);
    CHECK(former_law(now, then, b.initial.get()) == a.initial.get());
    CHECK(former_law(now, then, b.later.get()) == a.later.get());
    for (const auto& [groups, laws] : b.by_groups)
      for (std::size_t which = 0; which < 2; ++which, ++found)
        CHECK(former_law(now, then, laws[which].get()) == a.by_groups.at(groups)[which].get());
  }
  CHECK(found >= 2);
  CHECK(former_law(now, then, nullptr) == nullptr);
}

TEST_CASE("bonds are made and broken by names of blocks, orientation and law", "[stages]") {
  const auto unbonded = [](const std::string& criteria) {
    const Model model = read_model_text(
        "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
        "</Header><MPMHeader><MaxTime>0.02</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader><Blocks lawname='bond'>"
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1000' name='a'/>"
        "<BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='1000' name='b'/>"
        "<BoxBlock xmin='1' xmax='2' ymin='0' ymax='1' rho='1000' name='c'/>"
        "<Joint lawname='other' blocks='c' with='any'/></Blocks>"
        "<Material Type='SpringNetwork' Name='bond'><kn>1e8</kn><ks>1e8</ks><sn_ten>1e9</sn_ten><sn_coh>1e9</sn_coh>"
        "<bond/></Material><Material Type='SpringNetwork' Name='other'><kn>1e8</kn><ks>1e8</ks><sn_ten>1e9</sn_ten>"
        "<sn_coh>1e9</sn_coh><bond/></Material><Stage at='0.01'><Unbond " +
            criteria + "</Stage></JANFEAInput>",
        "blocks.xml");
    StagedRun<BlockRun> run(model);
    run.start();
    while (run.stage() == 0) run.advance();
    return 2 - run.present().bonds();
  };
  CHECK(unbonded("><Rect xmin='0' xmax='2' ymin='0' ymax='2'/></Unbond>") == 2);
  CHECK(unbonded("><Rect xmin='0' xmax='0.9' ymin='0.5' ymax='1.5'/></Unbond>") == 1);
  CHECK(unbonded("blocks='a' with='b'/>") == 1);
  CHECK(unbonded("blocks='b' with='c'/>") == 0);
  CHECK(unbonded("blocks='a' with='any'/>") == 2);
  CHECK(unbonded("dip='0 30'/>") == 1);
  CHECK(unbonded("dip='80 90'/>") == 1);
  CHECK(unbonded("lawname='other'/>") == 1);
  CHECK(unbonded("lawname='other' dip='0 30'/>") == 0);
  CHECK(unbonded("kind='balls'/>") == 0);
}

TEST_CASE("joints take over another area, and stiffnesses from a modulus", "[stages]") {
  JointSite site;
  site.area = 2.0, site.distance = 4.0, site.plane = false;
  const std::string strengths = " fric 0.5 sn_ten 1e9 sn_coh 1e9 bond gap,0";
  std::vector<JointEvent> events;
  JointIncrement d;
  d.normal = -0.1, d.shear.t = 0.2, d.gap = -0.1, d.bend.t = 0.01, d.twist = 0.02;
  const auto strained = [&](const JointLaw& of) {
    Joint joint = of.start(site);
    of.update({&joint, 1}, {&d, 1}, events);
    return joint;
  };
  const auto plain = law("SpringNetwork", "kn 10 ks 5" + strengths),
             small = law("SpringNetwork", "kn 10 ks 5 user_area 0.5" + strengths);
  const Joint before = strained(*plain), wanted = small->start(site);
  Joint joint = before;
  small->adopt(joint, *plain, site);
  CHECK(joint.area == 0.5);
  CHECK(joint.radius == Approx(wanted.radius));
  CHECK(joint.Fn == before.Fn);
  CHECK(joint.Fs.t == before.Fs.t);
  CHECK(joint.Mb.t == before.Mb.t);
  CHECK(joint.twist_stiffness == Approx(wanted.twist_stiffness));
  CHECK(joint.bend_stiffness[1] == Approx(wanted.bend_stiffness[1]));
  CHECK(joint.released() == Approx(before.released()).margin(1e-12));
  CHECK(joint.strain > before.strain);  // the same forces on weaker springs
  // A modulus in place of stiffnesses, another modulus, and back
  const auto elastic = law("SpringNetwork", "compute-stiffness emod,80,poisson,0" + strengths),
             stiffer = law("SpringNetwork", "compute-stiffness emod,160,poisson,0" + strengths),
             assigned = law("SpringNetwork", "assign-stiffness kn,6,kratio,3" + strengths);
  joint = before;
  elastic->adopt(joint, *plain, site);
  CHECK(joint.kn == Approx(20));
  CHECK(joint.ks == Approx(20));
  CHECK(joint.bend_stiffness[0] == Approx(elastic->start(site).bend_stiffness[0]));
  stiffer->adopt(joint, *elastic, site);
  CHECK(joint.kn == Approx(40));
  CHECK(joint.twist_stiffness == Approx(stiffer->start(site).twist_stiffness));
  assigned->adopt(joint, *stiffer, site);
  CHECK(joint.kn == Approx(6));
  CHECK(joint.ks == Approx(2));
  CHECK(joint.twist_stiffness == 0.0);
  elastic->adopt(joint, *assigned, site);
  CHECK(joint.bend_stiffness[1] == Approx(elastic->start(site).bend_stiffness[1]));
  site.part_of_face = true;
  assigned->adopt(joint, *elastic, site);
  elastic->adopt(joint, *assigned, site);
  CHECK(joint.bend_stiffness[1] == 0.0);
  // Mohr
  const auto wide = law("Mohr", "stiffness-normal 10 stiffness-shear 5 friction 30 cohesion 9"),
             narrow = law("Mohr", "stiffness-normal 10 stiffness-shear 5 friction 30 cohesion 9 user_area 1");
  joint = strained(*wide);
  const double force = joint.Fn;
  narrow->adopt(joint, *wide, site);
  CHECK(joint.area == 1.0);
  CHECK(joint.Fn == force);
}

TEST_CASE("a way to give the stiffness of joints takes the place of another in a stage", "[stages]") {
  const auto stiffness = [](const std::string& before, const std::string& now) {
    const Model model = read_model_text(
        "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
        "</Header><MPMHeader><MaxTime>2</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader><Blocks lawname='bond'>"
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1' name='a'/>"
        "<BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='1' name='b'/></Blocks>"
        "<Material Type='SpringNetwork' Name='bond'>" +
            before + "<fric>0.5</fric></Material><Stage at='1'><Material Name='bond'>" + now +
            "</Material></Stage></JANFEAInput>",
        "ways.xml");
    JointSite site;
    site.area = 1, site.distance = 1;
    return model.stages.at(0).model->materials.at(0).joint->start(site).kn;
  };
  const std::string plain = "<kn>3</kn><ks>2</ks>",
                    computed = "<compute-stiffness>emod 5 poisson 0</compute-stiffness>",
                    assigned = "<assign-stiffness>kn 7 kratio 2</assign-stiffness>";
  CHECK(stiffness(plain, computed) == 5);
  CHECK(stiffness(plain, assigned) == 7);
  CHECK(stiffness(computed, assigned) == 7);
  CHECK(stiffness(assigned, computed) == 5);
  CHECK_THROWS_WITH(stiffness(computed, "<kn>3</kn>"), Catch::Contains("leave one of them out"));
}

TEST_CASE("platens take over another modulus, or that of their joints", "[stages]") {
  // A column of two blocks under a load of 1000 at its top is compressed by F/k per contact; k of the platen changes.
  const auto strain = [](const std::string& platen, const std::string& stage) {
    const Model model = read_model_text(
        "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
        "</Header><MPMHeader><MaxTime>2</MaxTime><ArchiveTime>1</ArchiveTime><GlobalArchiveTime>1</"
        "GlobalArchiveTime><GlobalArchive type='dispy' block='a'/></MPMHeader>"
        "<Blocks lawname='bond' damping='0.7'>"
        "<BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1000' name='a'/>"
        "<Platen name='bottom'" +
            platen +
            "><Rect xmin='0' xmax='1' ymin='-0.1' ymax='0.1'/></Platen>"
            "<Load Fy='-1000 - 1000*(t &gt; 1)'><Rect xmin='0' xmax='1' ymin='0' ymax='1'/></Load></Blocks>"
            "<Material Type='SpringNetwork' Name='bond'><kn>1e6</kn><ks>1e6</ks><sn_ten>1e9</sn_ten>"
            "<sn_coh>1e9</sn_coh><bond/></Material><Stage at='1'>" +
            stage + "</Stage></JANFEAInput>",
        "platen.xml");
    const ScratchFolder scratch;
    RunOptions options;
    options.quiet = true, options.folder = scratch.path / "out";
    REQUIRE(run(model, options) == Outcome::finished);
    const auto rows = rows_of(options.folder / "history.csv");
    const double last = rows.back().at(1), middle = rows.at(rows.size() / 2).at(1);
    return std::array{middle, last - middle};
  };
  const std::string nothing = "<Blocks damping='0.7'/>", stiffer = "<Material Name='bond'><kn>4e6</kn></Material>";
  const auto same = strain("", nothing), like = strain("", stiffer),
             own = strain(" E='5e5'", "<Platen name='bottom' E='2e6'/>"), kept = strain(" E='5e5'", stiffer);
  CHECK(same[0] == Approx(-1e-3).epsilon(0.01));
  CHECK(same[1] == Approx(-1e-3).epsilon(0.01));
  CHECK(like[0] == Approx(-1e-3).epsilon(0.01));
  CHECK(like[1] == Approx(-0.25e-3).epsilon(0.01));
  CHECK(own[0] == Approx(-1e-3).epsilon(0.01));  // E/d of half a block
  CHECK(own[1] == Approx(-0.25e-3).epsilon(0.01));
  CHECK(kept[1] == Approx(-1e-3).epsilon(0.01));
}
