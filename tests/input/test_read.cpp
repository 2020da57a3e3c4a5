// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"
#include "input/read.hpp"
#include "materials/material.hpp"
#include "particles/fill.hpp"
#include "run/preflight.hpp"
#include "run/simulation.hpp"
#include "tests/root.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace tribo;

namespace {

const std::filesystem::path here = tribo::test::source_root() / "tests/input";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream buffer;
  buffer << in.rdbuf();
  return buffer.str();
}

}  // namespace

TEST_CASE("every malformed command file is refused with places and the right words", "[input]") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(here / "malformed")) {
    ++count;
    INFO(entry.path());
    const std::string text = text_of(entry.path());
    std::string expected;
    if (const auto at = text.find("expect: "); at != std::string::npos)
      expected = text.substr(at + 8, text.find(" -->", at) - at - 8);
    bool refused = false;
    try {
      const Model model = read_model(entry.path());
      preflight(model, 1);
    } catch (const InputError& error) {
      refused = true;
      for (const auto& problem : error.problems()) {
        INFO(problem.message);
        CHECK(problem.origin.file);
        CHECK(problem.origin.line > 0);
        CHECK(problem.origin.column > 0);
      }
      CHECK_THAT(error.what(), Catch::Contains(expected));
    }
    CHECK(refused);
  }
  CHECK(count >= 60);
}

TEST_CASE("every malformed script is refused with one message, which has a place and the right words", "[input]") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(here / "malformed_scripts")) {
    ++count;
    INFO(entry.path());
    const std::string text = text_of(entry.path());
    const std::string head = "! expect: ";
    REQUIRE(text.rfind(head, 0) == 0);
    const std::string expected = text.substr(head.size(), text.find('\n') - head.size());
    bool refused = false;
    try {
      preflight(read_model(entry.path()), 1);
    } catch (const InputError& error) {
      refused = true;
      CHECK(error.problems().size() == 1);
      CHECK(error.problems().front().origin.line > 0);
      CHECK(error.problems().front().origin.column > 0);
      CHECK_THAT(error.what(), Catch::Contains(expected));
    }
    CHECK(refused);
  }
  CHECK(count >= 70);
}

TEST_CASE("all problems are reported at once, in the order of the file", "[input]") {
  try {
    read_model_text("<JANFEAInput>\n <Header><Analysis>7</Analysis></Header>\n <Nonsense/>\n</JANFEAInput>",
                    "deck.xml");
    FAIL();
  } catch (const InputError& error) {
    REQUIRE(error.problems().size() >= 3);
    CHECK_THAT(error.what(),
               Catch::Contains(
                   "deck.xml:2:20: error: <Analysis> needs one of 10, 11, 12, 13, not '7' (type of the analysis: 10 "
                   "plane strain") ||
                   Catch::Contains("deck.xml:2:10: error: <Analysis>"));
    CHECK_THAT(error.what(), Catch::Contains("deck.xml:3:2: error: <Nonsense> is not known"));
    for (std::size_t k = 1; k < error.problems().size(); ++k)
      CHECK(error.problems()[k - 1].origin.line <= error.problems()[k].origin.line);
  }
}

TEST_CASE("wrong names and wrong values of a file are reported in one round", "[input]") {
  const auto complaint = [](const std::string& text) {
    try {
      read_model_text(text, "deck");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto script = [](const std::string& method, const std::string& grid) {
    return "Analysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\n" + method +
           " USAVG\nMaximumTime -1\nArchiveTime 1\n" + grid +
           " 10\nGridVert 10\nGridRect 0,1,0,1\nMaterial \"s\",\"sand\",\"MohrCoulomb\"\nrho -1\nE nan\nnu .3\n"
           "cohesio 1\nfriction 30\nDone\nRegion \"r\",0,0,1\nRect .2,.4,.2,.4\nEndRegion\n"
           "GridBC\nLine 0,0,0,1\nVelocity q,constant,0\nEndGridBC\n";
  };
  const std::string wrong = complaint(script("MPMMetod", "GridHoriz"));
  for (const char* part :
       {"deck:3:1: error: there is no command 'MPMMetod'", "deck:4:13: error: 'MaximumTime' must be positive",
        "deck:10:5: error: 'rho' is -1", "deck:11:3: error: 'E' needs one number, not 'nan'",
        "deck:13:1: error: 'cohesio' is not a property", "deck:16:8: error: there is no material 'r'",
        "deck:21:10: error: 'q' is not a direction"})
    CHECK_THAT(wrong, Catch::Contains(part));
  CHECK(std::count(wrong.begin(), wrong.end(), '\n') == 6);
  // Without a grid only the materials can be checked
  const std::string no_grid = complaint(script("MPMMethod", "GridHorz"));
  for (const char* part : {"deck:6:1: error: there is no command 'GridHorz'", "deck:10:5: error: 'rho' is -1"})
    CHECK_THAT(no_grid, Catch::Contains(part));
  const std::string open =
      complaint("Analysis \"Plane Strain MPM\"\nMaterial \"s\",\"sand\",\"MohrCoulomb\"\nrho -1\n");
  CHECK_THAT(open, Catch::Contains("deck:2:1: error: this 'Material' is never closed"));
  CHECK_THAT(open, Catch::Contains("deck:3:5: error: 'rho' is -1"));
  const std::string in_xml = complaint(
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis></Header>\n<Commands>\n"
      "Material \"s\",\"sand\",\"MohrCoulomb\"\nrho -1\nDone\nRegoin \"s\",0,0,1\nRegion \"s\",0,0,1\nRect "
      ".2,.4,.2,.4\nEndRegion\n</Commands>\n"
      "<Mesh><Grid xmin='0' xmax='1' ymin='0' ymax='1'><Horiz cellsize='-1'/><Vert cellsize='1'/></Grid></Mesh>\n"
      "<MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader></JANFEAInput>");
  for (const char* part : {"deck:4:5: error: <rho> is -1", "deck:6:1: error: there is no command 'Regoin'",
                           "deck:11:56: error: the cell size must be positive"})
    CHECK_THAT(in_xml, Catch::Contains(part));
}

TEST_CASE("a command that begins or ends a block wrongly has no consequences for the commands around it", "[input]") {
  const std::string sound =
      "Analysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\nMaximumTime 1\nArchiveTime 1\nGridHoriz 10\nGridVert 10\n"
      "GridRect 0,1,0,1\nMaterial \"s\",\"sand\",\"MohrCoulomb\"\nrho 1\nE 1\nnu .3\ncohesion 1\nfriction 30\nDone\n"
      "Region \"s\",0,0,1\nRect .2,.4,.2,.4\nEndRegion\nGridBC\nLine 0,0,0,1\nVelocity x,constant,0\nEndGridBC\n";
  CHECK_NOTHROW(read_model_text(sound, "deck"));
  for (const std::string word : {"Analysis", "Material", "Done", "Region", "EndRegion", "GridBC", "EndGridBC"}) {
    std::string text = sound;
    const auto at = ("\n" + text).find("\n" + word);
    text.insert(at + word.size(), "z");
    INFO(text);
    try {
      read_model_text(text, "deck");
      FAIL();
    } catch (const InputError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK_THAT(error.what(), Catch::Contains("there is no command '" + word + "z' (did you mean '" + word + "'?)"));
    }
  }
}

TEST_CASE("a legacy file is read into mm, g and s", "[input]") {
  const Model m = read_model(here / "legacy_disks.xml");
  CHECK(m.units.legacy);
  CHECK(m.time.end == Approx(0.02));  // 20 ms
  CHECK(m.output.archive.at(0).interval == Approx(5e-4));
  CHECK(m.materials.at(0).law->density() == Approx(1.5e-3));                           // 1.5 g/cm^3
  CHECK(m.materials.at(0).law->wave_modulus() == Approx(1e6 * 0.67 / (1.33 * 0.34)));  // MPa
  CHECK(m.pieces.at(0).velocity[0] == 2500);                                           // mm/s
  CHECK(m.pieces.at(1).velocity[0] == -2500);
  CHECK(m.grid.low[0] == -52);
  CHECK(m.grid.cells[0] == 52);
  CHECK(m.grid.symmetry[0][0].value() == -52);
  CHECK(m.scheme.kernel == Kernel::gimp);
  CHECK(m.scheme.order == UpdateOrder::usavg);
  CHECK(m.scheme.extrapolate_again);
  CHECK(m.output.history.at(0).column == "velx:Left disk");
  CHECK(place_points(m).size() == 2 * 732);  // 716 of them with their centres in the disc
}

TEST_CASE("materials are numbered by first reference if names are used", "[input]") {
  std::string text = text_of(here / "legacy_disks.xml");
  const Model m = read_model_text(text, "deck.xml");
  CHECK(m.materials.at(0).name == "Left disk");
  CHECK(m.materials.at(1).name == "Right disk");
}

TEST_CASE("a contact law is found by its number or its name", "[input]") {
  const std::string text = text_of(here / "malformed/contact_undefined_law.xml"), wrong = "lawname='rubb'";
  for (const std::string right : {"lawname='rub'", "law='rub'", "law='3'"}) {
    std::string edited = text;
    edited.replace(text.find(wrong), wrong.size(), right);
    INFO(right);
    CHECK(read_model_text(edited, "deck.xml").contact.default_law != nullptr);
  }
}

TEST_CASE("double precision of files is a choice", "[input]") {
  std::string text = text_of(here / "legacy_disks.xml");
  CHECK_FALSE(read_model_text(text, "deck.xml").output.double_precision);
  const auto head = text.find("<MPMHeader>") + 11;
  const auto with = [&](const char* more) { return std::string(text).insert(head, more); };
  CHECK_FALSE(read_model_text(with("<SinglePrecision/>"), "deck.xml").output.double_precision);
  CHECK(read_model_text(with("<DoublePrecision/>"), "deck.xml").output.double_precision);
  CHECK_THROWS_WITH(read_model_text(with("<SinglePrecision/><DoublePrecision/>"), "deck.xml"),
                    Catch::Contains("exclude each other"));
}

TEST_CASE("the cell size enlarges the upper edge to a whole cell", "[input]") {
  std::string text = text_of(here / "legacy_disks.xml");
  const auto at = text.find("ymax=\"&vmax;\"");
  text.replace(at, 13, "ymax=\"23\"");
  text.replace(text.find("symmax=\"&vmax;\""), 15, "");
  const Model m = read_model_text(text, "deck.xml");
  CHECK(m.grid.cells[1] == 24);
  CHECK(m.grid.high[1] == 24);
}

TEST_CASE("the keyword table has no element twice in one parent", "[input]") {
  const auto& all = dialect();
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK_FALSE((all[a].name == all[b].name && all[a].parents == all[b].parents));
}
