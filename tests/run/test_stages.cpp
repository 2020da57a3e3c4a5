// SPDX-License-Identifier: MIT
/// Stages within a run: what they change, and that a run through them continues to the bit.

#include "base/parallel.hpp"
#include "input/read.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/preflight.hpp"
#include "run/simulation.hpp"
#include "run/staged_run.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace tribo;

namespace {

// A block of 4 x 4 on a floor, with a second material for later bodies.
std::string block_with(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  return R"(<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader>
    <MPMMethod>3</MPMMethod><GIMP/><Transfer type='APIC'/>
    <TimeStep>1</TimeStep><MaxTime>0.12</MaxTime><TimeFactor>0.4</TimeFactor><ArchiveTime>0.03</ArchiveTime>
    <GlobalArchiveTime>0.004</GlobalArchiveTime>
    <GlobalArchive type='syy' mat='1'/>)" +
         header + R"(
  </MPMHeader>
  <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='8'><Horiz nx='16'/><Vert ny='16' symmin='0'/></Grid></Mesh>
  <MaterialPoints><Body mat='1'><Rect xmin='2' xmax='6' ymin='0' ymax='4'/></Body></MaterialPoints>
  <Material Type='LinearElastic' Name='soil'><rho>1000</rho><E>1e6</E><nu>0.2</nu></Material>
  <Material Type='LinearElastic' Name='fill'><rho>500</rho><E>2e6</E><nu>0.2</nu></Material>
  <Gravity><BodyYForce>-10</BodyYForce></Gravity>)" +
         more + stages + "\n</JANFEAInput>";
}

Model staged_model(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  return read_model_text(block_with(stages, header, more), "stages.xml");
}

// The message of the reader about stages.
std::string message_of(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  try {
    (void)staged_model(stages, header, more);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

// A run that has begun.
template <class Stepped>
std::unique_ptr<StagedRun<Stepped>> begun(const Model& model) {
  auto run = std::make_unique<StagedRun<Stepped>>(model);
  run->start();
  return run;
}

template <class Stepped>
void run_until(StagedRun<Stepped>& run, double time) {
  while (run.time() < time * (1 - 1e-12)) run.advance();
}

std::vector<std::string> differing(const Checkpoint& a, const Checkpoint& b) {
  std::vector<std::string> out;
  if (a.names() != b.names()) out.emplace_back("names of the entries");
  for (const auto& name : a.names())
    if (!b.has(name) || !a.same(b, name)) out.push_back(name);
  return out;
}

std::vector<double> column_of(const Checkpoint& state, const std::string& name) {
  return state.doubles("stepper.system.body0.particles." + name);
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream buffer;
  buffer << in.rdbuf();
  return buffer.str();
}

std::vector<std::vector<double>> rows_of(const std::filesystem::path& file) {
  std::vector<std::vector<double>> out;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    out.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) out.back().push_back(std::stod(field));
  }
  return out;
}

const std::string excavation =
    "<Stage at='0.03' name='dig'><Excavate><Rect xmin='2' xmax='6' ymin='2' ymax='4'/>"
    "</Excavate></Stage>";
const std::string refill =
    "<Stage at='0.06'><Body matname='fill'><Rect xmin='2' xmax='4' ymin='2.2' ymax='3.2'/></Body>"
    "<Material Name='soil'><E>5e5</E></Material></Stage>";
const std::string third =
    "<Stage at='0.09'><Gravity><BodyYForce>-5</BodyYForce></Gravity><Damping>10</Damping>"
    "<ParticleBCs><BCShape><Rect xmin='2' xmax='6' ymin='1' ymax='2'/><net/><LoadBC dir='1' load='100'/></BCShape>"
    "</ParticleBCs></Stage>";

}  // namespace

TEST_CASE("what cannot change in a stage is refused at its place", "[stages]") {
  const auto says = [](const std::string& text, const std::string& stages) {
    const std::string message = message_of(stages);
    INFO(stages);
    INFO(message);
    CHECK(message.find(text) != std::string::npos);
    CHECK(message.find("stages.xml:") != std::string::npos);
  };
  says("begins after the start", "<Stage at='0'><Damping>1</Damping></Stage>");
  says("when the run has ended", "<Stage at='1'><Damping>1</Damping></Stage>");
  says("order of their times",
       "<Stage at='0.1'><Damping>1</Damping></Stage><Stage at='0.1'><Damping>1</Damping></Stage>");
  says("changes nothing", "<Stage at='0.1'/>");
  says("needs the attribute 'at'", "<Stage><Damping>1</Damping></Stage>");
  says("no material named 'rock'", "<Stage at='0.1'><Material Name='rock'><E>1</E></Material></Stage>");
  says("keep their mass", "<Stage at='0.1'><Material Name='soil'><rho>1</rho></Material></Stage>");
  says("cannot change the type", "<Stage at='0.1'><Material Name='soil' Type='NeoHookean'><E>1</E></Material></Stage>");
  says("has no shape", "<Stage at='0.1'><Excavate/></Stage>");
  says("<MaxTime> is not known inside <Stage>", "<Stage at='0.1'><MaxTime>1</MaxTime></Stage>");
  says("<Mesh> is not known inside <Stage>", "<Stage at='0.1'><Mesh/></Stage>");
  says("must be in (0, 1]", "<Stage at='0.1'><TimeFactor>3</TimeFactor></Stage>");
  says("needs <MultiMaterialMode>", "<Stage at='0.1'><Friction>0.3</Friction></Stage>");
  says("no <Blocks>", "<Stage at='0.1'><Blocks damping='0.1'/></Stage>");
  says("there is no platen 'top'", "<Stage at='0.1'><Platen name='top' vx='1'/></Stage>");
  CHECK(message_of(excavation + refill + third).empty());
}

TEST_CASE("interfaces and joints cannot begin in a stage", "[stages]") {
  const std::string contact = "<MultiMaterialMode><Friction>0.3</Friction></MultiMaterialMode>",
                    laws =
                        "<Material Type='LinearInterface' Name='glue'><Dn>1e5</Dn><Dt>1e5</Dt></Material>"
                        "<Material Type='Mohr' Name='joint'><stiffness-normal>1e6</stiffness-normal></Material>"
                        "<Material Type='CoulombFriction' Name='rough'><coeff>0.5</coeff></Material>";
  const auto pair = [&](const std::string& law) {
    return message_of(
        "<Stage at='0.1'><Material Name='soil'><Friction matname='fill' lawname='" + law + "'/></Material></Stage>",
        contact, laws);
  };
  CHECK(pair("rough").empty());
  CHECK(pair("glue").find("imperfect interface") != std::string::npos);
  CHECK(pair("joint").find("begin with the run") != std::string::npos);
}

TEST_CASE("an excavation takes away its particles and leaves the others as they are", "[stages]") {
  const ScratchFolder scratch;
  const Model model = staged_model(excavation);
  auto run = begun<GridRun<2>>(model);
  run_until(*run, 0.03);
  run->save({}).save(scratch.path / "before.bin");
  const Checkpoint before(scratch.path / "before.bin");
  // The stage alone, without a step
  GridRun<2> first(model), next(*model.stages[0].model);
  first.restore(before);
  const StageBalance balance = first.end_stage();
  first.save({}).save(scratch.path / "end.bin");
  next.restore(Checkpoint(scratch.path / "end.bin"));
  const StageReport report = next.begin_stage(model, model.stages[0].actions, balance);
  next.save({}).save(scratch.path / "after.bin");
  const Checkpoint after(scratch.path / "after.bin");

  const auto ids = before.integers("stepper.system.body0.particles.id"),
             kept = after.integers("stepper.system.body0.particles.id");
  CHECK(ids.size() == 256);
  CHECK(kept.size() + static_cast<std::size_t>(report.excavated) == ids.size());
  CHECK(report.excavated == 128);
  const auto y = column_of(before, "position_y"), vy = column_of(before, "velocity_y"),
             mass = column_of(before, "mass");
  double momentum = 0.0, moved = 0.0, kinetic = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (y[i] < 2) {
      REQUIRE(n < kept.size());
      CHECK(kept[n++] == ids[i]);
      continue;
    }
    momentum += mass[i] * vy[i], kinetic += 0.5 * mass[i] * vy[i] * vy[i];
    moved += mass[i];
  }
  CHECK(moved == Approx(8000));
  for (const char* name : {"position_x", "velocity_y", "stress_yy", "mass"}) {
    const auto old = column_of(before, name), now = column_of(after, name);
    std::size_t k = 0;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (y[i] < 2) CHECK(now[k++] == old[i]);
  }
  const double impulse = after.doubles("stepper.ledger.impulse")[1] - before.doubles("stepper.ledger.impulse")[1];
  CHECK(impulse == Approx(-momentum).epsilon(1e-9));
  CHECK(after.number("stepper.ledger.first_kinetic") - before.number("stepper.ledger.first_kinetic") ==
        Approx(-kinetic).epsilon(1e-9));
  CHECK(after.number("stepper.system.body0.total_mass") == Approx(8000));
}

TEST_CASE("placed particles fill their shape, but not where there is matter", "[stages]") {
  const Model model = staged_model(
      "<Stage at='0.01'><Body matname='fill' vy='-1'><Rect xmin='2' xmax='6' ymin='3' ymax='6'/></Body></Stage>");
  auto run = begun<GridRun<2>>(model);
  CHECK(run->facts().at("particles of fill") == "0");
  run_until(*run, 0.0101);
  CHECK(run->stage() == 1);
  CHECK(run->facts().at("particles of fill") == "128");  // of 192
  const auto news = run->take_news();
  REQUIRE(news.size() == 1);
  CHECK(news[0].find("128 particles placed") != std::string::npos);
  const auto warnings = run->look();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("64 particles are not placed") != std::string::npos);
}

TEST_CASE("a run through stages continues to the bit from anywhere, on any number of threads", "[stages]") {
  const ScratchFolder scratch;
  const Model model = staged_model(excavation + refill + third);
  const auto state = [&](StagedRun<GridRun<2>>& run, const char* name) {
    run.save({}).save(scratch.path / name);
    return Checkpoint(scratch.path / name);
  };
  auto whole = begun<GridRun<2>>(model);
  run_until(*whole, 0.12);
  CHECK(whole->stage() == 3);
  const Checkpoint end = state(*whole, "end.bin");
  for (const double at : {0.02, 0.03, 0.031, 0.06, 0.065, 0.09, 0.1}) {
    INFO(at);
    auto part = begun<GridRun<2>>(model);
    run_until(*part, at);
    const Checkpoint middle = state(*part, "middle.bin");
    StagedRun<GridRun<2>> resumed(model);
    resumed.restore(middle);
    CHECK(differing(middle, state(resumed, "again.bin")).empty());
    run_until(resumed, 0.12);
    CHECK(differing(end, state(resumed, "resumed.bin")).empty());
  }
  set_threads(2);
  auto two = begun<GridRun<2>>(model);
  run_until(*two, 0.12);
  set_threads(1);
  CHECK(differing(end, state(*two, "two.bin")).empty());
}

TEST_CASE("files of a run through stages are the same if it is stopped in between", "[stages]") {
  const ScratchFolder scratch;
  const std::string fields =
      "<GlobalArchive type='posy' pt='4,1' mat='1'/><GlobalArchive type='posy' pt='4,3.5' mat='1'/>";
  const Model model = staged_model(excavation + refill + third, fields);
  RunOptions options;
  options.quiet = true;
  options.folder = scratch.path / "whole";
  REQUIRE(run(model, options) == Outcome::finished);
  options.folder = scratch.path / "parts", options.max_wall = 0.05;
  int parts = 1;
  while (run(model, options) == Outcome::stopped && parts < 1000) options.resume = true, ++parts;
  INFO(parts);
  for (const char* file : {"history.csv", "energy.csv", "stages.csv", "checkpoint.bin", "run.pvd"})
    CHECK(contents(scratch.path / "whole" / file) == contents(scratch.path / "parts" / file));
  // The energy of the stages is in a column of its own, so that the balance is not worse than without them.
  options = {};
  options.quiet = true, options.folder = scratch.path / "plain";
  REQUIRE(run(staged_model("", fields), options) == Outcome::finished);
  const auto worst = [&](const char* folder) {
    double most = 0.0;
    for (const auto& row : rows_of(scratch.path / folder / "energy.csv")) most = std::max(most, std::abs(row[11]));
    return most;
  };
  CHECK(worst("whole") < worst("plain"));
  CHECK(std::abs(rows_of(scratch.path / "whole" / "energy.csv").back().back()) > 500);
  // The excavated particle is not followed any more.
  const auto history = rows_of(scratch.path / "whole" / "history.csv");
  CHECK(history.back()[2] > 0.8);
  CHECK(history.back()[3] == 0.0);
}

TEST_CASE("gravity, damping and properties are those of the stage", "[stages]") {
  const Model model = staged_model(third);
  const Model& now = *model.stages[0].model;
  CHECK(model.body_force.gravity[1] == -10);
  CHECK(now.body_force.gravity[1] == -5);
  CHECK_FALSE(model.damping.grid);
  REQUIRE(now.damping.grid);
  CHECK((*now.damping.grid)(Variables{}) == 10);
  CHECK(now.stage.number == 1);
  CHECK(now.time.until == 0);
  CHECK(model.time.until == 0.09);
  CHECK(model.stage.loads);
  // The load finds the present particles
  auto run = begun<GridRun<2>>(model);
  run_until(*run, 0.0905);
  const ScratchFolder scratch;
  run->save({}).save(scratch.path / "now.bin");
  const auto marked = column_of(Checkpoint(scratch.path / "now.bin"), "load_set");
  CHECK(std::count(marked.begin(), marked.end(), 1.0) == 64);
  CHECK(Checkpoint(scratch.path / "now.bin").doubles("stepper.loads.factor").at(0) == Approx(1.0 / 64));
}

TEST_CASE("loads of a stage replace the former ones, or are added", "[stages]") {
  const auto load = [](const char* attributes, const char* box, const char* force) {
    return "<ParticleBCs" + std::string(attributes) + "><BCShape><Rect " + box + "/><LoadBC dir='1' load='" + force +
           "'/></BCShape></ParticleBCs>";
  };
  const std::string low = "xmin='2' xmax='6' ymin='0' ymax='1'", high = "xmin='2' xmax='6' ymin='3' ymax='4'";
  for (const bool add : {false, true}) {
    const Model model =
        staged_model("<Stage at='0.01'>" + load(add ? " add='yes'" : "", high.c_str(), "2") + "</Stage>", "",
                     load("", low.c_str(), "1"));
    CHECK(model.stages[0].model->particle_conditions.size() == (add ? 2 : 1));
    CHECK(model.stages[0].model->stage.kept == (add ? 1 : 0));
    auto run = begun<GridRun<2>>(model);
    run_until(*run, 0.0101);
    const ScratchFolder scratch;
    run->save({}).save(scratch.path / "now.bin");
    const auto marked = column_of(Checkpoint(scratch.path / "now.bin"), "load_set");
    CHECK(std::count(marked.begin(), marked.end(), 1.0) == 64);  // the low ones, or the high ones alone
    CHECK(std::count(marked.begin(), marked.end(), 2.0) == (add ? 64 : 0));
  }
}

TEST_CASE("a stage that changes nothing of effect leaves the motion as it is", "[stages]") {
  const ScratchFolder scratch;
  RunOptions options;
  options.quiet = true;
  options.folder = scratch.path / "with";
  run(staged_model("<Stage at='0.04'><Damping>0</Damping></Stage>"), options);
  options.folder = scratch.path / "without";
  run(staged_model(""), options);
  const auto with = rows_of(scratch.path / "with" / "history.csv"),
             without = rows_of(scratch.path / "without" / "history.csv");
  CHECK(with.back()[0] == Approx(without.back()[0]));
  CHECK(with.back()[1] == Approx(without.back()[1]).epsilon(0.02));
  const auto energy = rows_of(scratch.path / "with" / "energy.csv");
  CHECK(std::abs(energy.back().back()) < 1e-9);
}

TEST_CASE("a check tells of the stages and builds their models", "[stages]") {
  const std::string text = preflight(staged_model(excavation + refill), 1);
  CHECK(text.find("stage 1 'dig' at time 0.03: excavation, 128 particles of the start excavated") != std::string::npos);
  CHECK(text.find("stage 2 at time 0.06: placement, 'soil' with E 5e5, 32 particles placed") != std::string::npos);
  CHECK_THROWS_WITH(preflight(staged_model("<Stage at='0.1'><GridBCs><BCShape><Rect xmin='50' xmax='60' ymin='0' "
                                           "ymax='1'/><DisBC dir='1' vel='0'/></BCShape></GridBCs></Stage>"),
                              1),
                    Catch::Contains("selects no node"));
}

TEST_CASE("joints take over another stiffness at the same forces", "[stages]") {
  const auto law = [](const std::string& type, const std::string& properties) {
    Statement s;
    std::istringstream words(properties);
    for (std::string name, value; words >> name >> value;) {
      Statement child;
      child.name = name, child.text = value;
      s.children.push_back(child);
    }
    Problems problems;
    auto made = joint_laws().find(type)->make(s, {}, Units{}, problems);
    problems.raise();
    return made;
  };
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
  stiff->adopt(joint, *soft);
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
  twice->adopt(loose, *network);
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

TEST_CASE("scripts have stages, too", "[stages]") {
  const std::string text = R"(Title "Stages"
Analysis "Plane Strain MPM"
MPMMethod "USL-","uGIMP"
TimeStep 1,20,0.4
ArchiveTime 5
GlobalArchiveTime 1
GlobalArchive velx,"soil"
Material "soil","Soil","LinearElastic"
  rho 1
  E 1
  nu 0.2
Done
Material "fill","Fill","LinearElastic"
  rho 1
  E 1
  nu 0.2
Done
GridRect 0,8,0,8
GridHoriz 16
GridVert 16
Region "soil",0,0
  Rect 2,6,2,6
EndRegion
When above,"velx:Soil",1e9,Stop
Stage 5,"dig"
  Excavate "soil"
    Rect 2,6,4,6
  EndExcavate
  Material "soil"
    E 2
  Done
  Damping 0.5
  GridBC add
    Line 2,6,2,2
    Velocity y,constant,0
  EndGridBC
EndStage
Stage 10,"fill",1e-4
  Region "fill",0,0
    Rect 2,6,4,5
  EndRegion
  Gravity 0,-1
EndStage
)";
  const Model model = read_model_text(text, "stages.fmcmd");
  REQUIRE(model.stages.size() == 2);
  CHECK(model.reactions.size() == 1);
  CHECK(model.stages[0].at == Approx(0.005));  // from milliseconds
  CHECK(model.stages[0].name == "dig");
  REQUIRE(model.stages[0].actions.size() == 1);
  CHECK(model.stages[0].actions[0].material == 0);
  CHECK(model.stages[0].model->node_conditions.size() == 1);
  CHECK(model.stages[0].model->reactions.empty());
  CHECK(model.stages[0].model->materials[0].law->wave_modulus() == Approx(2 * model.materials[0].law->wave_modulus()));
  CHECK(model.stages[1].model->materials[0].law->wave_modulus() ==
        model.stages[0].model->materials[0].law->wave_modulus());
  REQUIRE(model.placements.size() == 1);
  CHECK(model.placements[0].pieces.at(0).material == 1);
  CHECK(model.stages[1].model->body_force.gravity[1] == -1);
  REQUIRE(model.stages[1].model->reactions.size() == 1);
  CHECK(model.stages[1].model->reactions[0].what == Reaction::What::ratio);
  const auto fails = [&](const std::string& from, const std::string& to, const std::string& why) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    CHECK_THROWS_WITH(read_model_text(other, "stages.fmcmd"), Catch::Contains(why));
  };
  fails("  Damping 0.5\n", "  GridThickness 2\n", "cannot change in a stage");
  fails("EndStage\nStage 10", "Stage 10", "a stage within the stage");
  fails("  Material \"soil\"\n", "  Material \"rock\"\n", "no material 'rock'");
  fails("Excavate \"soil\"", "Excavate \"soul\"", "no material 'soul'");
}

TEST_CASE("reactions write files, begin the next stage and stop the run", "[stages]") {
  const ScratchFolder scratch;
  RunOptions options;
  options.quiet = true, options.folder = scratch.path / "run";
  const std::string history = "<GlobalArchive type='Kinetic Energy'/>",
                    when = "<When history='Kinetic Energy' above='200'><Frame/><Checkpoint/><NextStage/></When>";
  const Model model = staged_model(when +
                                       "<Stage at='0.1'><Damping>300</Damping><When history='Kinetic Energy' "
                                       "below='100'><Stop/></When></Stage>",
                                   history);
  REQUIRE(run(model, options) == Outcome::finished);
  const auto stages = contents(options.folder / "stages.csv");
  INFO(stages);
  CHECK(std::filesystem::exists(options.folder / "particles" / numbered(900000, ".vtp")));
  const auto rows = rows_of(options.folder / "history.csv");
  double begin = -1;
  for (const auto& row : rows)
    if (row[2] > 200 && begin < 0) begin = row[0];
  CHECK(begin > 0);
  CHECK(stages.find("\n" + std::to_string(begin).substr(0, 4)) != std::string::npos);
  CHECK(rows.back()[0] < 0.119);
  CHECK(rows.back()[2] < 100);
  CHECK(contents(options.folder / "provenance.json").find("was below 100") != std::string::npos);
  CHECK(message_of("<When history='speed' above='1'><Stop/></When>").find("has no column 'speed'") !=
        std::string::npos);
  CHECK(message_of("<When ratio='1'/>").find("does nothing") != std::string::npos);
  CHECK(message_of("<When event='bond_break'><Stop/></When>").find("no bond can break") != std::string::npos);
  CHECK(message_of("<Stage at='0.1' until='1e-4'><Damping>1</Damping></Stage>").find("'until' is") !=
        std::string::npos);
}

TEST_CASE("a stage ends once its forces are balanced", "[stages]") {
  // At rest from the start: the ratio is small at once, and the stage begins long before its time.
  const std::string still = "<Stage at='0.1'><Damping>1</Damping></Stage><When ratio='1e-2'><NextStage/></When>";
  std::string text = block_with(still);
  const std::string body = "<Body mat='1'>";
  text.replace(text.find(body), body.size(), "<Body mat='1'><InitialStress K0='0.25'/>");
  text.replace(text.find("<Horiz nx='16'/>"), 16, "<Horiz nx='16' symmin='2' symmax='6'/>");
  text.replace(text.find("<TimeFactor>0.4"), 15, "<TimeFactor>0.05");
  const ScratchFolder scratch;
  RunOptions options;
  options.quiet = true, options.folder = scratch.path / "run";
  REQUIRE(run(read_model_text(text, "stages.xml"), options) == Outcome::finished);
  std::ifstream file(options.folder / "stages.csv");
  std::string head, begin;
  REQUIRE((std::getline(file, head) && std::getline(file, begin, ',')));
  CHECK(std::stod(begin) < 0.05);
}
