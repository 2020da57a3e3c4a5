// SPDX-License-Identifier: MIT
#include "run/result_folder.hpp"

#include "base/error.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

#include <unistd.h>

using namespace tribo;
namespace fs = std::filesystem;

namespace {

const ResultNames some{{"history.csv", "provenance.json"}, {"particles"}};

void put(const fs::path& file, const std::string& text = "mine") {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

std::string content(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void start(const fs::path& folder, bool overwrite, const ResultNames& names = some) {
  ResultFolder(folder).start(names, overwrite);
}

}  // namespace

TEST_CASE("a run refuses a place that holds what no run has made, and changes nothing", "[folder]") {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path;
  put(folder / "particles" / "run_000000.vtp"), put(folder / "notes.txt");
  for (const bool overwrite : {false, true}) {
    CHECK_THROWS_WITH(start(folder, overwrite), Catch::Contains("'particles'") && Catch::Contains("not made by a run"));
    CHECK(content(folder / "particles" / "run_000000.vtp") == "mine");
    CHECK(std::distance(fs::directory_iterator(folder), {}) == 2);
  }
  fs::rename(folder / "particles", folder / "elsewhere");
  put(folder / "history.csv");
  CHECK_THROWS_WITH(start(folder, true), Catch::Contains("'history.csv'"));
  CHECK(content(folder / "history.csv") == "mine");
  fs::remove(folder / "history.csv");
  start(folder, false);  // other content is not in the way
  CHECK(content(folder / "notes.txt") == "mine");
  CHECK(fs::exists(folder / "particles"));
}

TEST_CASE("overwriting removes what a run has made and nothing else", "[folder]") {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path;
  const fs::path outside = scratch.path / "outside";
  start(folder, false, {{"history.csv", "provenance.json", "events.csv"}, {"particles", "grid", "joints"}});
  put(folder / "history.csv", "old"), put(folder / "particles" / "run_000000.vtp", "old");
  put(folder / "particles" / ".run_000001.writing.vtp", "old"), put(folder / "joints" / "run_000000.vtp", "old");
  put(folder / "particles" / "run_000000.vtm", "old"), put(folder / "particles" / "run_000000_12.vtp", "old");
  put(folder / "particles" / "run_000000_.vtp"), put(folder / "particles" / "mine.vtp"),
      put(folder / "particles" / "run_1.vtp"), put(folder / "other.csv");
  put(outside / "run_000000.vtp");
  fs::remove(folder / "grid");
  fs::create_directory_symlink(outside, folder / "grid");
  put(outside / "events.csv");
  fs::create_symlink(outside / "events.csv", folder / "events.csv");
  CHECK_THROWS_WITH(start(folder, false), Catch::Contains("already holds a run"));
  CHECK(content(folder / "history.csv") == "old");

  start(folder, true);
  CHECK_FALSE(fs::exists(folder / "history.csv"));
  CHECK_FALSE(fs::exists(folder / "joints"));
  CHECK_FALSE(fs::exists(folder / "particles" / "run_000000.vtp"));
  CHECK_FALSE(fs::exists(folder / "particles" / "run_000000.vtm"));
  CHECK_FALSE(fs::exists(folder / "particles" / "run_000000_12.vtp"));
  CHECK_FALSE(fs::exists(folder / "particles" / ".run_000001.writing.vtp"));
  CHECK_FALSE(fs::exists(fs::symlink_status(folder / "events.csv")));
  for (const char* kept : {"particles/mine.vtp", "particles/run_000000_.vtp", "particles/run_1.vtp", "other.csv",
                           "outside/run_000000.vtp", "outside/events.csv", "grid/run_000000.vtp"}) {
    INFO(kept);
    CHECK(content(folder / kept) == "mine");
  }
  // A link in place of a folder of the new run is in the way
  CHECK_THROWS_WITH(start(folder, true, {{}, {"grid"}}), Catch::Contains("'grid'"));
  // A folder that was kept for what else it holds still counts as made by a run
  start(folder, true, {{"history.csv"}, {}});
  start(folder, true);
  CHECK(content(folder / "particles" / "mine.vtp") == "mine");
}

TEST_CASE("folders of runs without a list are recognised by their record", "[folder]") {
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path;
  put(folder / "provenance.json", R"({"program": "tribo 0.0", "status": "finished"})");
  put(folder / "history.csv", "old"), put(folder / "grid" / "run_000000.vti", "old"), put(folder / "grid" / "mesh.msh");
  CHECK_THROWS_WITH(start(folder, false), Catch::Contains("already holds a run"));
  start(folder, true);
  CHECK_FALSE(fs::exists(folder / "history.csv"));
  CHECK_FALSE(fs::exists(folder / "grid" / "run_000000.vti"));
  CHECK(content(folder / "grid" / "mesh.msh") == "mine");

  put(folder / "b" / "provenance.json", R"({"program": "other", "status": "finished"})");
  CHECK_THROWS_WITH(start(folder / "b", true), Catch::Contains("'provenance.json'"));
  put(folder / "c" / "tribo-run.json", R"({"files": ["../history.csv"], "frames": []})");
  CHECK_THROWS_WITH(start(folder / "c", true), Catch::Contains("damaged"));
}

TEST_CASE("two runs cannot use one folder, and a run that does not start leaves none", "[folder]") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path / "a" / "b";
  {
    const ResultFolder first(folder);
    CHECK_THROWS_WITH(ResultFolder(folder), Catch::Contains("process " + std::to_string(::getpid()) + " on "));
  }
  CHECK_FALSE(fs::exists(scratch.path / "a"));
  start(folder, false);
  { const ResultFolder second(folder); }
  CHECK(fs::exists(folder / "tribo-run.json"));
  put(scratch.path / "c" / "tribo-run.lock");
  CHECK_THROWS_WITH(ResultFolder(scratch.path / "c"), Catch::Contains("not made by Tribo"));
  CHECK(content(scratch.path / "c" / "tribo-run.lock") == "mine");
  put(scratch.path / "file");
  CHECK_THROWS_AS(ResultFolder(scratch.path / "file" / "x"), FileError);
}
