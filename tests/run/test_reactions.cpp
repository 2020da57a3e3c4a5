// SPDX-License-Identifier: MIT
/// Reactions to what happens within a run.

#include "run/simulation.hpp"
#include "scratch.hpp"
#include "staged_models.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

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
  CHECK(std::filesystem::exists(options.folder / "particles" / numbered(900000, ".vtm")));
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
