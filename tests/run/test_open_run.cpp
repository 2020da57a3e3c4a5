// SPDX-License-Identifier: MIT
/// Runs whose caller takes the steps, and what a program adds to a model: loads and laws.

#include "base/read_file.hpp"
#include "input/read.hpp"
#include "materials/material.hpp"
#include "run/grid_run.hpp"
#include "run/simulation.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

namespace {

const std::string falling_square = R"(Analysis "Plane Strain MPM"
ConsistentUnits m,kg,s
MPMMethod "USL","B2SPLINE"
TimeStep 1e-3,0.02,0.4
ArchiveTime 0.005
GlobalArchiveTime 0.002
GlobalArchive vely,"square"
GlobalArchive velx,"square"
Material "square","square","LinearElastic"
  rho 1000
  E 1e5
  nu 0.3
Done
GridHoriz 10
GridVert 10
GridRect 0,1,0,1
Region "square",1,0
  Rect 0.3,0.6,0.3,0.6
EndRegion
Gravity 0,-10
)";

Model square() { return read_model_text(falling_square, "square"); }

RunOptions options_for(const std::filesystem::path& folder) {
  RunOptions out;
  out.folder = folder, out.quiet = true;
  return out;
}

}  // namespace

TEST_CASE("a run whose caller takes the steps writes the files of a run", "[run]") {
  const ScratchFolder scratch;
  const auto whole = scratch.path / "whole", steps = scratch.path / "steps", stopped = scratch.path / "stopped";
  CHECK(run(square(), options_for(whole)) == Outcome::finished);
  const auto same = [&](const std::filesystem::path& folder) {
    for (const char* file :
         {"history.csv", "energy.csv", "checkpoint.bin", "particles/run_000004.vtm", "particles/run_000004_1.vtp"}) {
      INFO(file);
      CHECK(read_file(folder / file) == read_file(whole / file));
    }
  };
  using Pause = StepwiseRun::Pause;
  const auto open = open_run(square(), options_for(steps));
  CHECK(open->advance(3) == Pause::due);
  CHECK(open->stepped().step() == 3);
  CHECK(open->advance(0) == Pause::due);
  CHECK(open->stepped().time() == Approx(0.005));
  CHECK_THROWS_AS(run(square(), options_for(steps)), FileError);  // the folder is in use
  Pause last = Pause::due;
  for (int k = 0; k < 100 && last == Pause::due; ++k) last = open->advance(0);
  CHECK(last == Pause::end);
  same(steps);

  const auto part = open_run(square(), options_for(stopped));
  part->advance(7);
  part->stop("enough");
  RunOptions again = options_for(stopped);
  again.resume = true;
  CHECK(run(square(), again) == Outcome::finished);
  same(stopped);
}

TEST_CASE("accelerations of a program act on all particles and do work", "[run]") {
  Model model = square();
  int calls = 0;
  model.body_force.of_program = [&](int dimension, std::span<const double> x, double, std::span<double> a) {
    ++calls;
    REQUIRE(dimension == 2);
    REQUIRE(x.size() == a.size());
    for (std::size_t i = 0; i < a.size(); i += 2) a[i] = 4, a[i + 1] = 10;
  };
  GridRun<2> pushed(model);
  pushed.start();
  double time = 0;
  for (int k = 0; k < 10; ++k) time += pushed.advance();
  CHECK(calls == 10);
  auto& particles = pushed.system().bodies[0].particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    CHECK(particles.v()[0][i] == Approx(1 + 4 * time));
    CHECK(particles.v()[1][i] == Approx(0).margin(1e-12));
  }
  // A run without the program cannot continue from its state.
  const Checkpoint state(pushed.save({}));
  const Model other = square();
  GridRun<2> without(other);
  CHECK_THROWS_AS(without.restore(state), FileError);
  GridRun<2> with(model);
  with.restore(state);
  CHECK(with.step() == 10);
}

TEST_CASE("a program adds laws to a catalogue, but does not replace those of Tribo", "[materials]") {
  auto& all = extensible_materials();
  const std::size_t before = all.items().size();
  auto law = *materials().find("LinearElastic");
  CHECK_THROWS_AS(all.add(law), std::invalid_argument);
  law.name = "SprungFromATest", law.aliases.clear(), law.number = 0;
  all.add(law);
  law.summary = "another one";
  all.add(law);
  CHECK(all.items().size() == before + 1);
  CHECK(materials().find("sprungfromatest")->summary == "another one");
  auto text = falling_square;
  text.replace(text.find("LinearElastic"), 13, "SprungFromATest");
  CHECK(read_model_text(text, "square").materials[0].type == "SprungFromATest");
}
