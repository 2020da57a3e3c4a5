// SPDX-License-Identifier: MIT
/// Who may include whom. The rules keep the dependencies one-way.

#include "root.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

// Each folder with the folders whose headers it may include, besides its own. Sub-folders without a line of their own
// follow the rule of the folder around them. A folder may use what stands above it in this list, so that no two folders
// can include each other.
struct Rule {
  std::string folder;
  std::set<std::string> may;
};
const std::set<std::string> foundation{"base",    "geometry", "model",     "materials",
                                       "contact", "grid",     "particles", "blocks"};

std::set<std::string> with(std::set<std::string> set, std::initializer_list<const char*> more) {
  set.insert(more.begin(), more.end());
  return set;
}

const std::vector<Rule> rules{
    {"src/base", {}},
    {"src/geometry", {"base"}},
    {"src/model", {"base", "geometry"}},
    {"materials", {"base"}},
    {"contact", {"base"}},
    {"src/grid", {"base", "geometry", "model"}},
    {"src/particles", {"base", "geometry", "model", "materials", "grid"}},
    {"src/blocks", {"base", "geometry", "model", "contact"}},
    {"src/output", {"base"}},
    {"src/view", {"base", "output"}},
    {"src/drive", {"base", "materials", "contact", "output"}},
    {"input", {"base", "geometry", "model", "materials", "contact", "drive"}},
    {"input/script", {"base", "model", "materials", "contact", "input"}},
    {"src/solver/state", {"base", "model", "materials", "contact", "grid", "particles"}},
    {"src/solver/neighbours", {"model", "grid", "solver/state"}},
    {"src/solver/exchange", {"base", "grid", "solver/state"}},
    {"src/solver/boundary", {"base", "model", "grid", "solver/state", "solver/exchange"}},
    {"src/solver/transfer", {"base", "model", "grid", "solver/state", "solver/exchange"}},
    {"src/solver/cracks",
     {"base", "geometry", "materials", "solver/state", "solver/neighbours", "solver/exchange", "solver/transfer"}},
    {"src/solver/joints", {"base", "contact", "grid", "solver/state", "solver/neighbours", "solver/cracks"}},
    {"src/solver/contact",
     {"base", "contact", "grid", "blocks", "solver/state", "solver/exchange", "solver/transfer", "solver/cracks",
      "solver/joints"}},
    {"src/solver/loads", {"base", "grid", "solver/state", "solver/exchange", "solver/cracks"}},
    {"src/solver/heat", {"base", "grid", "solver/exchange", "solver/transfer", "solver/contact", "solver/loads"}},
    {"src/solver/rigid",
     {"base", "grid", "particles", "blocks", "solver/state", "solver/exchange", "solver/transfer", "solver/contact"}},
    {"src/solver",
     with(foundation, {"solver/state", "solver/neighbours", "solver/exchange", "solver/transfer", "solver/cracks",
                       "solver/joints", "solver/contact", "solver/loads", "solver/heat", "solver/rigid"})},
    {"src/run", with(foundation, {"output", "solver", "solver/state", "solver/neighbours", "solver/boundary",
                                  "solver/transfer", "solver/cracks", "solver/joints", "solver/contact", "solver/loads",
                                  "solver/heat", "solver/rigid"})},
};

// The folder of an include, as the rules write it.
std::string folder_of(const std::string& path) {
  const auto end = path.rfind('/');
  return end == std::string::npos ? std::string() : path.substr(0, end);
}
std::string as_included(const std::string& folder) { return folder.rfind("src/", 0) == 0 ? folder.substr(4) : folder; }

const Rule* rule_of(std::string folder) {
  for (; !folder.empty(); folder = folder_of(folder))
    for (const Rule& rule : rules)
      if (rule.folder == folder) return &rule;
  return nullptr;
}

// Calls f(path from the root, line) for every line of every C++ file of the library.
template <class F>
void each_line(F&& f) {
  const std::filesystem::path root = tribo::test::source_root();
  for (const char* top : {"src", "materials", "contact", "input"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      const std::string path = std::filesystem::relative(entry.path(), root).generic_string();
      for (std::string line; std::getline(file, line);) f(path, line);
    }
}

}  // namespace

TEST_CASE("every folder includes only the folders it may", "[architecture]") {
  std::size_t checked = 0;
  each_line([&](const std::string& path, const std::string& line) {
    const std::string folder = folder_of(path);
    if (folder == "src" || line.rfind("#include \"", 0) != 0) return;  // the program may use everything
    const Rule* rule = rule_of(folder);
    INFO(path << ": " << line);
    REQUIRE(rule);
    std::string included = folder_of(line.substr(10, line.find('"', 10) - 10));
    // A header without a rule of its own, such as input/script/value.hpp, belongs to the folder around it.
    bool allowed = included == as_included(rule->folder);
    for (; !included.empty() && !allowed; included = folder_of(included))
      allowed = rule->may.count(included) == 1 || included == as_included(rule->folder);
    CHECK(allowed);
    ++checked;
  });
  CHECK(checked > 500);
}

TEST_CASE("no two folders include each other", "[architecture]") {
  std::set<std::string> known;
  for (const Rule& rule : rules) {
    for (const std::string& used : rule.may) {
      INFO(rule.folder << " may use " << used);
      CHECK(known.count(used) == 1);
    }
    known.insert(as_included(rule.folder));
  }
}

TEST_CASE("OpenMP, TinyXML-2, VTK and Voro++ are each named in one place", "[architecture]") {
  const std::map<std::string, std::string> homes{{"#include <omp.h>", "parallel.hpp"},
                                                 {"#include <tinyxml2.h>", "xml.cpp"},
                                                 {"#include <vtk", "vtk.cpp"},
                                                 {"#include <voro++", "voronoi_3d.cpp"}};
  each_line([&](const std::string& path, const std::string& line) {
    for (const auto& [text, home] : homes) {
      INFO(path << ": " << line);
      CHECK((line.rfind(text, 0) != 0 || std::filesystem::path(path).filename() == home));
    }
  });
}
