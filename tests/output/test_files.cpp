// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "output/checkpoint.hpp"
#include "output/history.hpp"
#include "output/number.hpp"
#include "output/vtk.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace tribo;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

}  // namespace

TEST_CASE("a file is replaced whole or not at all", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "a.txt";
  write_atomically(file, "one");
  CHECK(content(file) == "one");
  write_atomically(file, "two");
  CHECK(content(file) == "two");
  CHECK(files_in(scratch.path) == 1);

  CHECK_THROWS_AS(write_atomically(file,
                                   [](const std::string& temporary) {
                                     std::ofstream(temporary) << "half";
                                     return false;
                                   }),
                  FileError);
  CHECK(content(file) == "two");
  CHECK(files_in(scratch.path) == 1);
  CHECK_THROWS_WITH(write_atomically(scratch.path / "nowhere" / "b.txt", "x"), Catch::Contains("nowhere"));
}

TEST_CASE("a history keeps its rows over a resume, without doubles and without torn lines", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "h.csv";
  const std::vector<std::string> columns{"time", "velx:a, \"b\""};
  {
    History h(file, columns);
    for (const double t : {0.0, 0.1, 0.2, 0.30000000000000004}) h.add(std::array{t, 1 / (1 + t)});
  }
  const std::string whole = content(file);
  CHECK(whole.rfind("time,\"velx:a, \"\"b\"\"\"\n0,1\n0.1,", 0) == 0);
  std::ofstream(file, std::ios::app) << "0.4,0.";  // torn
  {
    auto h = History::resume(file, columns, 0.1);
    for (const double t : {0.2, 0.30000000000000004}) h.add(std::array{t, 1 / (1 + t)});
  }
  CHECK(content(file) == whole);
  CHECK_THROWS_AS(History::resume(file, {"time", "other"}, 0.1), FileError);
}

TEST_CASE("a checkpoint returns the same bits, and notices every damage", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "c.bin";
  const std::vector<double> values{1.5, -0.0, -1.7976931348623157e308, 5e-324};
  const std::vector<std::int64_t> numbers{1, -2, INT64_MAX};
  const auto put_all = [&](CheckpointWriter& to) {
    to.put("values", std::span<const double>(values));
    to.put("numbers", std::span<const std::int64_t>(numbers));
    to.put("text", std::string("hello"));
    to.put("empty", std::span<const double>());
  };
  CheckpointWriter out;
  put_all(out);
  out.save(file);
  write_checkpoint(scratch.path / "at once.bin", put_all);
  CHECK(content(scratch.path / "at once.bin") == content(file));

  const Checkpoint in(file);
  const auto back = in.doubles("values");
  REQUIRE(back.size() == values.size());
  CHECK(std::memcmp(back.data(), values.data(), values.size() * sizeof(double)) == 0);
  CHECK(in.integers("numbers") == numbers);
  CHECK(in.text("text") == "hello");
  CHECK(in.doubles("empty").empty());
  CHECK_THROWS_AS(in.doubles("text"), FileError);
  CHECK_THROWS_AS(in.doubles("nothing"), FileError);

  const std::string all = content(file);
  for (std::size_t n = 0; n < all.size(); ++n) {
    std::ofstream(file, std::ios::binary) << all.substr(0, n);
    CHECK_THROWS_AS(Checkpoint(file), FileError);
  }
  std::string damaged = all;
  damaged[damaged.find("hello") + 1] = 'a';
  std::ofstream(file, std::ios::binary) << damaged;
  CHECK_THROWS_WITH(Checkpoint(file), Catch::Contains("'text' is damaged"));
}

TEST_CASE("a collection lists its files with exact times and continues without doubles", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "run.pvd";
  Collection whole(file);
  for (int k = 0; k < 4; ++k) whole.add(0.1 * k, "p" + std::to_string(k));
  const std::string text = content(file);
  CHECK(text.find("timestep=\"0.30000000000000004\"") != std::string::npos);
  Collection again(file);
  again.resume(0.1);
  CHECK(again.size() == 2);
  again.add(0.1 * 2, "p2");
  again.add(0.1 * 3, "p3");
  CHECK(content(file) == text);
}

TEST_CASE("domains of particles are written in single precision and read back as half axes", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "p.vtp";
  const std::vector<double> x{0, 0, 0, 1, 2, 3};  // positions of two particles
  const OutputRows positions{x.data(), nullptr, 3};
  std::vector<float> four, nine;
  for (const float size : {0.5F, 0.1F})
    for (int k = 1; k <= 9; ++k) {
      nine.push_back(size * static_cast<float>(k));
      if (k <= 4) four.push_back(nine.back());
    }
  const OutputField plane{"domain", {}, nullptr, nullptr, {nullptr, four.data(), 4}};
  const OutputField space{"domain", {}, nullptr, nullptr, {nullptr, nine.data(), 9}};
  write_particles(file, 2, positions, std::vector{plane}, 0.0);
  CHECK(content(file).find("type=\"Float32\" Name=\"domain\" NumberOfComponents=\"4\"") != std::string::npos);
  ParticleFrame frame = read_particles(file);
  CHECK(frame.fields.empty());
  REQUIRE(frame.domains.size() == 2);
  CHECK(frame.domains[0] == HalfAxes{{{0.5, 1, 0}, {1.5, 2, 0}, {0, 0, 0}}});
  CHECK(frame.domains[1][1][0] == Approx(0.3).epsilon(1e-7));
  write_particles(file, 2, positions, std::vector{space}, 0.0);
  frame = read_particles(file);
  CHECK(frame.position[1] == std::array<double, 3>{1, 2, 3});
  CHECK(frame.domains[0] == HalfAxes{{{0.5, 1, 1.5}, {2, 2.5, 3}, {3.5, 4, 4.5}}});
}

namespace {

// Writes each block from its first row on.
void write_blocks(const std::filesystem::path& file, const std::vector<OutputBlock>& blocks,
                  const std::vector<std::size_t>& begins, const std::vector<double>& x,
                  const std::vector<OutputField>& fields, const std::vector<std::string>& materials) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t end = k + 1 < blocks.size() ? begins[k + 1] : x.size() / 3;
    auto own = fields;
    for (OutputField& field : own) {
      if (field.integers) field.integers += begins[k];
      if (field.rows.floats) field.rows.floats += begins[k];
    }
    write_particles(file_of_block(file, blocks[k]), end - begins[k], {x.data() + 3 * begins[k], nullptr, 3}, own, 0.25,
                    materials);
  }
  write_block_list(file, blocks);
}

}  // namespace

TEST_CASE("blocks of particles have a file each, and are read as one", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "run_000003.vtm";
  const std::vector<double> x{0, 0, 0, 1, 2, 3, 4, 5, 6};
  const std::vector<float> speed{7, 8, 9};
  const std::vector<std::int64_t> id{2, 0, 1};
  const std::vector<OutputField> fields{{"speed", {}, nullptr, nullptr, {nullptr, speed.data(), 1}, "m/s"},
                                        {"id", {}, id.data()}};
  const std::vector<OutputBlock> blocks{{"none yet", 1}, {"soft <& \"wet\">", 2}, {"rock", 4}};
  const std::vector<std::string> materials{"none yet", "soft", "contact", "rock"};
  write_blocks(file, blocks, {0, 0, 1}, x, fields, materials);
  CHECK(files_in(scratch.path) == 4);
  const auto read = read_blocks(file);
  REQUIRE(read.size() == 3);
  CHECK(read[1].name == "soft &lt;&amp; &quot;wet&quot;&gt;");
  CHECK(read[2].file == scratch.path / "run_000003_4.vtp");
  CHECK(content(read[2].file).find("Name=\"material names\"") != std::string::npos);
  CHECK(read_particles(read[2].file).count() == 2);
  const ParticleFrame whole = read_particles(file);
  CHECK(whole.time == 0.25);
  CHECK(whole.position[2] == std::array<double, 3>{4, 5, 6});
  CHECK(whole.field("speed")->values == std::vector<double>{7, 8, 9});
  CHECK(whole.field("id")->values == std::vector<double>{2, 0, 1});
  write_particles(read[2].file, 2, {x.data(), nullptr, 3}, std::vector{fields[1]}, 0.25);
  CHECK_THROWS_WITH(read_particles(file), Catch::Contains("different fields"));
  std::filesystem::remove(read[2].file);
  CHECK_THROWS_AS(read_particles(file), FileError);
  std::ofstream(file) << "<DataSet index=\"0\" name=\"a\" file=\"../x.vtp\"/>\n</VTKFile>";
  CHECK_THROWS_WITH(read_particles(file), Catch::Contains("outside the folder"));
  std::ofstream(file) << "<DataSet index=\"0\" name=\"a\" file=\"run_000003.vtm\"/>\n</VTKFile>";
  CHECK_THROWS_WITH(read_particles(file), Catch::Contains("no file of particles"));
}

TEST_CASE("bodies of a material are blocks within its block", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "run_000003.vtm";
  const std::vector<double> x{0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<OutputBlock> blocks{
      {"floor", 1}, {"rubber 1", 2, "rubber", 1}, {"rubber 2", 2, "rubber", 2}, {"rock", 4}};
  write_blocks(file, blocks, {0, 1, 2, 3}, x, {}, {});
  const std::string text = content(file);
  const auto at = [&](const char* line) { return text.find(line); };
  const auto floor = at("<DataSet index=\"0\" name=\"floor\" file=\"run_000003_1.vtp\"/>"),
             rubber = at("<Block index=\"1\" name=\"rubber\">"),
             second = at("<DataSet index=\"1\" name=\"rubber 2\" file=\"run_000003_2_2.vtp\"/>\n</Block>"),
             rock = at("<DataSet index=\"2\" name=\"rock\" file=\"run_000003_4.vtp\"/>");
  CHECK((floor < rubber && rubber < second && second < rock && rock != std::string::npos));
  CHECK(read_particles(file).position[2] == std::array<double, 3>{4, 5, 6});
}

TEST_CASE("a collection has several files for a time", "[output]") {
  const ScratchFolder scratch;
  Collection all(scratch.path / "all.pvd");
  all.add(0.0, {{"particles", "particles/run_000000.vtm"}, {"blocks", "blocks/run_000000.vtp"}});
  all.add(0.5, {{"particles", "particles/run_000001.vtm"}, {"blocks", "blocks/run_000001.vtp"}});
  const std::string whole = content(scratch.path / "all.pvd");
  CHECK(whole.find("timestep=\"0.5\" part=\"1\" name=\"blocks\" file=\"blocks/run_000001.vtp\"") != std::string::npos);
  Collection again(scratch.path / "all.pvd");
  again.resume(0.0);
  CHECK(again.size() == 1);
  again.add(0.5, {{"particles", "particles/run_000001.vtm"}, {"blocks", "blocks/run_000001.vtp"}});
  CHECK(content(scratch.path / "all.pvd") == whole);
}

TEST_CASE("a particle file is written whole, compressed and with its time", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "p.vtp";
  const std::vector<double> x{0, 1, 2}, y{3, 4, 5}, s{7, 8, 9};
  const std::vector<std::int64_t> id{2, 0, 1};
  std::vector<OutputField> fields{{"speed", {s.data()}, nullptr},
                                  {"id", {}, id.data()},
                                  {"stress", {s.data(), s.data(), s.data(), s.data(), nullptr, nullptr}, nullptr}};
  fields[0].unit = "m/s";
  write_particles(file, 3, {x.data(), y.data(), nullptr}, fields, 0.25);
  const std::string text = content(file);
  for (const auto word : {"vtkZLibDataCompressor", "UNITS_LABEL", "m/s", "GlobalIds=\"id\"", "NumberOfVerts=\"3\"",
                          "Name=\"stress\"", "ComponentName3=\"XY\"", "TimeValue", "encoding=\"raw\""})
    CHECK(text.find(word) != std::string::npos);
  const ParticleFrame frame = read_particles(file);
  CHECK(frame.domains.empty());
  for (const char* name : {"speed", "id", "stress"}) REQUIRE(frame.field(name));
  CHECK(frame.field("speed")->values == s);
  CHECK(frame.field("stress")->components == 6);
  write_particles(scratch.path / "none.vtp", 0, {nullptr, nullptr, nullptr}, {}, 0.0);
  CHECK(files_in(scratch.path) == 2);
}

TEST_CASE("what is not a number reaches no file", "[output]") {
  const ScratchFolder scratch;
  const double nan = std::nan(""), infinite = HUGE_VAL;
  const auto table = scratch.path / "h.csv";
  History h(table, {"time", "force", "word"});
  h.add(std::array{0.0, 1.0, 2.0});
  const std::string before = content(table);
  for (const double bad : {nan, -nan, infinite, -infinite}) {
    CHECK_THROWS_WITH(h.add(std::array{1.0, bad, 2.0}), Catch::Contains("'force'") && Catch::Contains("time 1"));
    CHECK_THROWS_AS(h.add(1.0, std::vector<std::string>{"2", number_text(bad)}), SimulationError);
    CHECK_THROWS_WITH(CheckpointWriter().put("velocity", bad), Catch::Contains("'velocity'"));
    const std::array<double, 2> x{0, 1}, values{0, bad};
    const std::vector<OutputField> fields{{"stress", {values.data()}}};
    const auto frame = scratch.path / "p.vtp";
    CHECK_THROWS_WITH(write_particles(frame, 2, {x.data(), nullptr, nullptr}, fields, 0.0),
                      Catch::Contains("'stress'"));
    CHECK_THROWS_WITH(write_particles(frame, 2, {x.data(), values.data(), nullptr}, {}, 0.0),
                      Catch::Contains("'position'"));
    const std::array<double, 6> rows{0, 0, 0, 1, bad, 0};
    const std::array<float, 2> singles{0, static_cast<float>(bad)};
    const std::vector<OutputField> single{{"domain", {}, nullptr, nullptr, {nullptr, singles.data(), 1}}};
    CHECK_THROWS_WITH(write_particles(frame, 2, {rows.data(), nullptr, 3}, {}, 0.0),
                      Catch::Contains("'position' of row 1 "));
    CHECK_THROWS_WITH(check_rows(2, {x.data(), nullptr, 1}, single), Catch::Contains("'domain' of row 1 "));
    CHECK_FALSE(std::filesystem::exists(frame));
  }
  h.add(1.0, std::vector<std::string>{"2", ""});  // does not exist
  CHECK(content(table) == before + "1,2,\n");
}

TEST_CASE("a file is written over within the space that it has", "[output]") {
  const ScratchFolder scratch;
  const auto file = scratch.path / "r.json";
  CHECK_FALSE(write_over(file, "new"));
  write_atomically(file, "a longer text");
  CHECK(write_over(file, "new"));
  CHECK(content(file) == "new");
  CHECK_FALSE(write_over(file, std::string(1 << 20, 'x')));
  CHECK(content(file) == "new");
}
