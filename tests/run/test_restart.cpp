// SPDX-License-Identifier: MIT
/// Runs that continue from a checkpoint, to the bit, for models that together use every kind of state.

#include "base/parallel.hpp"
#include "input/read.hpp"
#include "root.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace tribo;

namespace {

/// A command file of the repository with texts replaced.
struct Deck {
  std::string path;
  std::vector<std::pair<std::string, std::string>> replaced;
  int steps;  ///< before the checkpoint, and again after it
};

Model model_of(const Deck& deck) {
  std::ifstream file(test::source_root() / deck.path, std::ios::binary);
  std::ostringstream buffer;
  buffer << file.rdbuf();
  std::string text = buffer.str();
  for (const auto& [from, to] : deck.replaced) {
    INFO(from);
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
  }
  return read_model_text(text, deck.path);
}

std::unique_ptr<SteppedModel> stepped(const Model& model) {
  if (model.only_blocks()) return std::make_unique<BlockRun>(model);
  if (model.dimension() == 2) return std::make_unique<GridRun<2>>(model);
  return std::make_unique<GridRun<3>>(model);
}

// Entries of two checkpoints that differ.
std::vector<std::string> differences(const Checkpoint& a, const Checkpoint& b) {
  std::vector<std::string> out;
  if (a.names() != b.names()) out.emplace_back("names of the entries");
  for (const auto& name : a.names())
    if (!b.has(name) || !a.same(b, name)) out.push_back(name);
  return out;
}

// Entries of the state after `steps`, and after the same steps with a checkpoint in the middle.
void check_resume(const Deck& deck, std::initializer_list<const char*> must_change) {
  INFO(deck.path);
  const ScratchFolder scratch;
  const Model model = model_of(deck);
  const auto save = [&](SteppedModel& run, const char* name) {
    run.save({}).save(scratch.path / name);
    return Checkpoint(scratch.path / name);
  };
  auto whole = stepped(model);
  whole->start();
  const Checkpoint first = save(*whole, "first.bin");
  for (int k = 0; k < deck.steps; ++k) whole->advance();
  const Checkpoint middle = save(*whole, "middle.bin");
  auto resumed = stepped(model);
  resumed->restore(middle);
  CHECK(differences(middle, save(*resumed, "again.bin")).empty());
  for (int k = 0; k < deck.steps; ++k) whole->advance(), resumed->advance();
  const Checkpoint end = save(*whole, "end.bin");
  CHECK(differences(end, save(*resumed, "resumed.bin")).empty());
  // The model does use what it is there for, before the checkpoint and after it
  for (const char* name : must_change) {
    INFO(name);
    REQUIRE(end.has(name));
    CHECK((!first.has(name) || !first.same(middle, name)));
    CHECK(!middle.same(end, name));
  }
}

const std::string tasks =
    "<CustomTasks><Schedule name='PeriodicXPIC'><Parameter name='XPICOrder'>2</Parameter>"
    "<Parameter name='periodicTime'>0.1</Parameter></Schedule></CustomTasks></JANFEAInput>";

}  // namespace

TEST_CASE("contact with heat, friction and bonds continues to the bit", "[restart]") {
  check_resume({"verification/rubbing/case.xml", {}, 120},
               {"stepper.heat.from_contact", "stepper.contact.ledger.pairs.friction",
                "stepper.system.body0.particles.position_x"});
  check_resume({"verification/rubbing/case.xml",
                {{"<Material Type='CoulombFriction' Name='rough'><coeff>0.5</coeff></Material>",
                  "<Material Type='AdhesiveFriction' Name='rough'><coeff>0.1</coeff><coeffStatic>0.5</coeffStatic>"
                  "<Sa>1e3</Sa><Na>1e3</Na><rebond>1</rebond></Material>"}},
                60},
               {"stepper.contact.ledger.pairs.impact"});
  check_resume({"verification/conduction/contact.xml", {}, 40}, {"stepper.system.body0.particles.temperature"});
  check_resume({"verification/conduction/flux.xml", {}, 40}, {"stepper.heat.supplied"});
  check_resume({"verification/adiabatic/shear.xml", {}, 40}, {"stepper.conditions0.work"});
}

TEST_CASE("contact with faces that are kept from step to step continues to the bit", "[restart]") {
  const auto kept = {"stepper.kept.faces.travel", "stepper.kept.faces.step"};
  check_resume({"verification/rolling/case.xml", {{"\"0.025\"", "\"0.05\""}}, 12}, kept);
  check_resume({"verification/capstan/case.xml", {}, 12}, kept);
  check_resume({"verification/sphere/case.xml", {{"\"0.025\"", "\"0.1\""}}, 12}, kept);
}

TEST_CASE("cracks that grow and cracks with laws continue to the bit", "[restart]") {
  check_resume({"verification/fracture/growth.xml",
                {{"\"1\"", "\"2\""}, {"<JIc>0.02", "<JIc>1e-30"}, {"xmax='30'", "xmax='12'"}},
                80},
               {"stepper.system.crack0.points", "stepper.system.crack0.tips.J", "stepper.ledger.damping_work"});
  check_resume({"verification/crack_interface/case.xml", {}, 60}, {"stepper.system.crack0.upper"});
}

TEST_CASE("joints on cracks and between bodies continue to the bit", "[restart]") {
  check_resume({"verification/joint_patch/case.xml", {}, 40}, {"stepper.system.joints0.joints.Fn"});
  check_resume({"verification/joint_shear/case.xml", {}, 40}, {"stepper.system.joints0.joints.work"});
}

TEST_CASE("rigid bodies, CPDI and averaged volumes continue to the bit", "[restart]") {
  check_resume({"verification/cook/case.xml", {}, 40}, {"stepper.system.body0.particles.F_xx"});
  check_resume({"verification/seam/case.xml", {}, 40}, {"stepper.system.body0.particles.position_y"});
  check_resume({"input/examples/rubber_ring.xml", {}, 40}, {"stepper.system.body0.particles.F_xx"});
}

TEST_CASE("particles that split and merge continue to the bit", "[restart]") {
  check_resume({"verification/stretching/case.xml",
                {{"<SplitParticles/>", "<SplitParticles longest='0.5'/>"},
                 {"exp(t)</Set", "exp(20*t)*20</Set"},
                 {"vel0X>x<", "vel0X>20*x<"},
                 {"vel0Y>-y<", "vel0Y>-20*y<"}},
                2000},
               {"stepper.splitting.split", "stepper.splitting.next_id"});
}

TEST_CASE("filters by period, damping with feedback and returned particles continue to the bit", "[restart]") {
  check_resume({"tests/input/legacy_disks.xml",
                {{"<GIMP/>",
                  "<GIMP/><LeaveLimit>1000000</LeaveLimit><FeedbackDamping>1e-4</FeedbackDamping>"
                  "<PFeedbackDamping>1e-4</PFeedbackDamping>"},
                 {"\"52\"", "\"46\""},
                 {"vx=\"&speed;\"", "vx=\"-&speed;\""},
                 {" symmin=\"-&hmax;\" symmax=\"&hmax;\"", ""},
                 {"</JANFEAInput>", tasks}},
                60},
               {"stepper.damping.grid_feedback", "stepper.damping.particle_feedback", "stepper.filter.next",
                "stepper.sort.returned"});
}

TEST_CASE("blocks in the grid and blocks alone continue to the bit", "[restart]") {
  check_resume({"verification/blocks_on_matter/bed.xml", {}, 40},
               {"blocks.motion.x", "blocks.grid_forces.force", "stepper.contact.ledger.rigid_impulse"});
  check_resume({"verification/blocks_stick_slip/case.xml", {}, 200}, {"blocks.motion.x", "blocks.joints.Fs.t"});
}

TEST_CASE("the checkpoint of any step can be read, also where particles have left their bins", "[restart]") {
  // The disks cross cells, so that particles are sorted again and again; each sort happens in the step after it is due.
  const ScratchFolder scratch;
  const Model model = model_of({"tests/input/legacy_disks.xml", {}, 0});
  GridRun<2> run(model);
  run.start();
  int count = 0;
  for (; !run.at_end(); ++count) {
    run.advance();
    run.save({}).save(scratch.path / "state.bin");
    GridRun<2> other(model);
    INFO(count);
    REQUIRE_NOTHROW(other.restore(Checkpoint(scratch.path / "state.bin")));
  }
  CHECK(count > 300);
}

TEST_CASE("a run does not continue from a checkpoint of another model", "[restart]") {
  const ScratchFolder scratch;
  const Model model = model_of({"verification/conduction/contact.xml", {}, 0});
  const Model other = model_of({"verification/adiabatic/shear.xml", {}, 0});
  auto run = stepped(model);
  run->start();
  run->save({}).save(scratch.path / "c.bin");
  auto wrong = stepped(other);
  CHECK_THROWS_AS(wrong->restore(Checkpoint(scratch.path / "c.bin")), FileError);
}
