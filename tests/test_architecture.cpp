/// Who may include whom. Folders drift unless a test holds them.

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace {

const std::map<std::string, std::set<std::string>> allowed{
    {"src/base", {"base"}},
    {"src/geometry", {"base", "geometry"}},
    {"src/model", {"base", "geometry", "model"}},
    {"materials", {"base", "materials"}},
    {"contact", {"base", "contact"}},
    {"input", {"base", "geometry", "model", "materials", "contact", "drive", "input"}},
    {"input/script", {"base", "materials", "contact", "input"}},
    {"src/drive", {"base", "materials", "contact", "output", "drive"}},
    {"src/grid", {"base", "geometry", "grid"}},
    {"src/particles", {"base", "geometry", "model", "materials", "grid", "particles"}},
    {"src/solver", {"base", "geometry", "model", "materials", "contact", "grid", "particles", "blocks", "solver"}},
    {"src/blocks", {"base", "geometry", "model", "contact", "blocks"}},
    {"src/output", {"base", "output"}},
    {"src/view", {"base", "output", "view"}},
    {"src/run", {"base", "model", "materials", "contact", "grid", "particles", "solver", "blocks", "output", "run"}},
};

}  // namespace

TEST_CASE("every folder includes only the folders it may", "[architecture]") {
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path();
  for (const auto& [folder, may] : allowed)
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        if (line.rfind("#include \"", 0) != 0) continue;
        const std::string included = line.substr(10, line.find('"', 10) - 10);
        INFO(entry.path() << " includes " << included);
        CHECK(may.count(included.substr(0, included.find('/'))) == 1);
      }
    }
}

TEST_CASE("OpenMP, TinyXML-2, VTK and Voro++ are each named in one place", "[architecture]") {
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path();
  const std::map<std::string, std::string> homes{{"#include <omp.h>", "parallel.hpp"},
                                                 {"#include <tinyxml2.h>", "xml.cpp"},
                                                 {"#include <vtk", "vtk.cpp"},
                                                 {"#include <voro++", "voronoi_3d.cpp"}};
  for (const auto& [folder, may] : allowed)
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
        for (const auto& [text, home] : homes) {
          INFO(entry.path() << ": " << line);
          CHECK((line.rfind(text, 0) != 0 || entry.path().filename() == home));
        }
    }
}
