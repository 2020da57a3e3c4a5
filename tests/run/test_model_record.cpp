// SPDX-License-Identifier: MIT
#include "run/model_record.hpp"

#include "base/error.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace tribo;

namespace {

Model model_with(const std::filesystem::path& file, const std::string& text, const std::string& meaning) {
  Model model;
  model.file = file.string(), model.source = text, model.meaning = meaning, model.settings = {{"speed", "3"}};
  return model;
}

}  // namespace

TEST_CASE("a change of the command file is told by its lines", "[record]") {
  const ScratchFolder scratch;
  const auto folder = scratch.path / "out";
  std::filesystem::create_directory(folder);
  const std::string text = "a\nb = 1\nc\nd\n";
  Model model = model_with(scratch.path / "m.xml", text, "<a/>");
  std::ofstream(scratch.path / "table.csv") << "1,2";
  model.data_files = {"table.csv"};
  CHECK_THROWS_WITH(read_model_record(folder), Catch::Contains("tribo-model.json"));
  write_model_record(folder, model);

  const ModelRecord record = read_model_record(folder);
  CHECK(record.file == scratch.path / "m.xml");
  CHECK(record.relative == std::filesystem::path("..") / "m.xml");
  CHECK(record.settings.at("speed") == "3");
  CHECK(changes(record, model).empty());
  model.source = "a\nb = 1  ! a comment\nc\nd\n";  // with the same meaning
  CHECK(changes(record, model).empty());
  model.source = "a\nb = 2\nc\nd\ne\n", model.meaning = "<b/>";
  CHECK(changes(record, model) == std::vector<std::string>{"2: - b = 1", "2: + b = 2", "5: + e"});
  model.source = text;  // the meaning alone differs
  CHECK(changes(record, model) == std::vector<std::string>{"1: - <a/>", "1: + <b/>"});
  model.meaning = "<a/>";
  std::ofstream(scratch.path / "table.csv") << "1,3";
  CHECK(changes(record, model) == std::vector<std::string>{"the file 'table.csv' has other contents"});
}
