// SPDX-License-Identifier: MIT
/// Runs of blocks from command files to the last file.

#include "input/read.hpp"
#include "output/vtk.hpp"
#include "run/preflight.hpp"
#include "run/simulation.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace tribo;

namespace {

const char* const header = R"(<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header>
    <Analysis>11</Analysis>
    <ConsistentUnits length='m' mass='kg' time='s'/>
  </Header>
  <MPMHeader>
    <TimeStep>0.0001220703125</TimeStep>
    <MaxTime>0.125</MaxTime>
    <ArchiveTime>0.0625</ArchiveTime>
    <GlobalArchiveTime>0.0009765625</GlobalArchiveTime>
    <GlobalArchive type='forcey' platen='top'/>
    <GlobalArchive type='syy'/>
    <GlobalArchive type='eyy'/>
    <GlobalArchive type='broken in tension'/>
    <GlobalArchive type='bonds'/>
  </MPMHeader>
  <Material Type='SpringNetwork' Name='bond'>
    <compute-stiffness>emod 50e9 poisson 0.2</compute-stiffness>
    <sn_ten>1e6</sn_ten><sn_coh>5e6</sn_coh><sn_fa>30</sn_fa><bond>gap 1e-6</bond>
  </Material>
)";

const char* const pulled = R"(
  <Blocks lawname='bond' damping='0.7' quasistatic='yes'>
    <Voronoi xmin='0' xmax='0.08' ymin='0' ymax='0.1' hexagons='0.01' rho='2500'/>
    <Platen><Line xmin='0' xmax='0.08' ymin='0' ymax='0' tolerance='1e-6'/></Platen>
    <Platen name='top' vy='3e-5'><Line xmin='0' xmax='0.08' ymin='0.1' ymax='0.1' tolerance='1e-6'/></Platen>
  </Blocks>
</JANFEAInput>)";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream buffer;
  buffer << in.rdbuf();
  return buffer.str();
}

RunOptions quiet(const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder, options.quiet = true;
  return options;
}

// To half of the time, then stopped at once when it goes on, then to the end.
void run_in_two_parts(std::string text, const char* name, const std::filesystem::path& folder) {
  const std::string whole = "<MaxTime>0.125</MaxTime>", half = "<MaxTime>0.0625</MaxTime>";
  std::string first = text;
  first.replace(first.find(whole), whole.size(), half);
  RunOptions options = quiet(folder);
  REQUIRE(run(read_model_text(first, name), options) == Outcome::finished);
  options.resume = true, options.max_wall = 1e-9;
  REQUIRE(run(read_model_text(text, name), options) == Outcome::stopped);
  options.max_wall = 0;
  REQUIRE(run(read_model_text(text, name), options) == Outcome::finished);
}

}  // namespace

TEST_CASE("a run of blocks writes its files, and the same after stops", "[blocks]") {
  const std::string text = std::string(header) + pulled;
  const Model model = read_model_text(text, "pulled.xml");
  const ScratchFolder whole, parts;
  REQUIRE(run(model, quiet(whole.path)) == Outcome::finished);
  for (const char* file : {"blocks.pvd", "contacts.pvd", "events.csv", "history.csv", "energy.csv", "provenance.json",
                           "checkpoint.bin", "blocks/run_000002.vtp", "contacts/run_000002.vtp"})
    CHECK(std::filesystem::exists(whole.path / file));
  CHECK(read_collection(whole.path / "blocks.pvd").size() == 3);
  CHECK(text_of(whole.path / "events.csv").find("bond_break,1,") != std::string::npos);

  run_in_two_parts(text, "pulled.xml", parts.path);
  for (const char* file : {"history.csv", "energy.csv", "events.csv", "blocks.pvd", "checkpoint.bin"}) {
    INFO(file);
    CHECK(text_of(parts.path / file) == text_of(whole.path / file));
  }
}

TEST_CASE("the sheet of a model of blocks tells blocks, contacts and the step", "[blocks]") {
  const std::string sheet = preflight(read_model_text(std::string(header) + pulled, "pulled.xml"), 1);
  for (const char* word :
       {"blocks: ", "contacts of 'bond'", "bonds: ", "platen 'top': area 0.08", "time step: 0.00012207", "memory: "})
    CHECK_THAT(sheet, Catch::Contains(word));
}

TEST_CASE("undamped blocks with Poisson's ratio are warned of", "[blocks]") {
  std::string text = std::string(header) + pulled;
  text.replace(text.find("damping='0.7' "), 14, "");
  const Model model = read_model_text(text, "pulled.xml");
  REQUIRE(model.warnings.size() == 1);
  CHECK_THAT(model.warnings.front(),
             Catch::Contains("pulled.xml:") && Catch::Contains("grow without bound") && Catch::Contains("'damping'"));
}

TEST_CASE("blocks that gain energy from nowhere are reported", "[blocks][monitor]") {
  const std::string damped = std::string(header) + pulled;
  std::string text = damped;
  text.replace(text.find("damping='0.7' "), 14, "");
  text.replace(text.find("<sn_ten>1e6</sn_ten><sn_coh>5e6</sn_coh>"), 40, "<sn_ten>1e30</sn_ten><sn_coh>1e30</sn_coh>");
  text.replace(text.find("<MaxTime>0.125"), 14, "<MaxTime>0.375");
  const ScratchFolder sound, gaining, parts;
  run(read_model_text(damped, "pulled.xml"), quiet(sound.path));
  CHECK_THAT(text_of(sound.path / "provenance.json"), !Catch::Contains("of what was supplied came from"));
  run(read_model_text(text, "pulled.xml"), quiet(gaining.path));
  const std::string record = text_of(gaining.path / "provenance.json");
  CHECK_THAT(record,
             Catch::Contains("of what was supplied came from the fictitious stress") && Catch::Contains("'damping'"));
  RunOptions options = quiet(parts.path);
  options.max_wall = 1e-9;
  REQUIRE(run(read_model_text(text, "pulled.xml"), options) == Outcome::stopped);
  options.max_wall = 0, options.resume = true;
  REQUIRE(run(read_model_text(text, "pulled.xml"), options) == Outcome::finished);
  const auto line = [](const std::string& of) {
    const auto at = of.find("energy: ");
    return of.substr(at, of.find('"', at) - at);
  };
  CHECK(line(text_of(parts.path / "provenance.json")) == line(record));
}

TEST_CASE("blocks that meet without a contact end the run with their names", "[blocks]") {
  const char* const fly = R"(
  <Blocks lawname='bond' touchname='none'>
    <BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='2500' vx='10'/>
    <BoxBlock xmin='1.1' xmax='2' ymin='0' ymax='1' rho='2500'/>
  </Blocks>
</JANFEAInput>)";
  std::string text = std::string(header) + fly;
  text.erase(text.find("<GlobalArchive type='forcey'"),
             std::string("<GlobalArchive type='forcey' platen='top'/>").size());
  const ScratchFolder folder;
  CHECK_THROWS_WITH(run(read_model_text(text, "fly.xml"), quiet(folder.path)),
                    Catch::Contains("the blocks 1 and 2 met") && Catch::Contains("touchname"));
}

TEST_CASE("balls find each other and part again", "[blocks]") {
  const char* const balls = R"(
  <Blocks touchname='touch'>
    <Ball name='a' x='0' y='0' radius='0.5' rho='2500' vx='30'/>
    <Ball name='b' x='1.5' y='0.1' radius='0.5' rho='2500'/>
    <Ball name='c' x='3' y='-0.2' radius='0.5' rho='2500'/>
  </Blocks>
  <Material Type='SpringNetwork' Name='touch'><kn>1e9</kn><ks>5e8</ks><fric>0.3</fric></Material>
</JANFEAInput>)";
  std::string text = std::string(header) + balls;
  text.erase(text.find("<GlobalArchive type='forcey'"),
             std::string("<GlobalArchive type='forcey' platen='top'/>").size());
  text.replace(text.find("<GlobalArchive type='bonds'/>"), 29, "<GlobalArchive type='velx' block='c'/>");
  const Model model = read_model_text(text, "balls.xml");
  const ScratchFolder whole, parts;
  REQUIRE(run(model, quiet(whole.path)) == Outcome::finished);
  const std::string history = text_of(whole.path / "history.csv");
  const double speed = std::stod(history.substr(history.rfind(',') + 1));
  CHECK(speed > 10);
  run_in_two_parts(text, "balls.xml", parts.path);
  CHECK(text_of(parts.path / "history.csv") == history);
  CHECK(text_of(parts.path / "energy.csv") == text_of(whole.path / "energy.csv"));
}
