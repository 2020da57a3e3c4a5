// SPDX-License-Identifier: MIT
/// Files of results that are damaged at random: what is read is right in form, or there is an error that names the
/// file.
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/checkpoint.hpp"
#include "output/checkpoint_archive.hpp"
#include "output/vtk.hpp"
#include "tests/scratch.hpp"
#include "view/run_folder.hpp"

#include <catch2/catch.hpp>

#include <zlib.h>

#include <cstring>
#include <limits>
#include <random>

using namespace tribo;

namespace {

// Some bytes changed, removed or added, or the end cut off.
std::string damaged(std::string data, std::mt19937& random) {
  const auto any = [&](std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random); };
  for (std::size_t k = 0; k <= any(3) && !data.empty(); ++k) {
    const std::size_t at = any(data.size());
    switch (any(6)) {
      case 0:
        data[at] = static_cast<char>(any(256));
        break;
      case 1:
        data.erase(at, 1 + any(16));
        break;
      case 2:
        data.insert(at, data.substr(at, 1 + any(40)));
        break;
      case 3:
        data.resize(at);
        break;
      case 4:
        data[at] = static_cast<char>('0' + any(10));
        break;
      default:
        data[at] = static_cast<char>(data[at] ^ (1 << any(8)));
    }
  }
  return data;
}

// Reads damaged versions of a file. Returns how many of them were refused.
template <class Read>
int refused(const std::filesystem::path& file, int times, Read&& read) {
  const std::string sound = read_file(file);
  std::mt19937 random(7);
  int count = 0;
  for (int k = 0; k < times; ++k) {
    write_atomically(file, damaged(sound, random));
    try {
      read();
    } catch (const FileError& error) {
      ++count;
      CHECK_THAT(error.what(), Catch::Contains(file.filename().string()));
    }
  }
  write_atomically(file, sound);
  return count;
}

}  // namespace

TEST_CASE("damaged particle files are refused or right in form", "[output]") {
  const ScratchFolder folder;
  const auto file = folder.path / "a.vtp";
  const std::vector<double> x{0, 1, 2, 3, 4}, y{5, 6, 7, 8, 9};
  const std::vector<std::int64_t> id{1, 2, 3, 4, 5};
  const std::vector<OutputField> fields{{"velocity", {x.data(), y.data(), nullptr}}, {"id", {}, id.data()}};
  write_particles(file, 5, {x.data(), y.data(), nullptr}, fields, 0.5);
  const ParticleFrame sound = read_particles(file);
  CHECK(sound.time == 0.5);
  CHECK(sound.position[3][1] == 8);
  REQUIRE(sound.field("velocity"));
  CHECK(sound.field("velocity")->values[7] == 7);
  CHECK(sound.field("id")->integers);
  const int bad = refused(file, 3000, [&] {
    const ParticleFrame frame = read_particles(file);
    for (const auto& f : frame.fields) CHECK(f.values.size() == frame.count() * static_cast<std::size_t>(f.components));
  });
  CHECK(bad > 1000);
}

TEST_CASE("damaged files of cells are refused or right in form", "[output]") {
  const ScratchFolder folder;
  const auto file = folder.path / "a.vtp";
  const std::vector<double> x{0, 1, 1, 0}, y{0, 0, 1, 1}, value{1, 2};
  const std::vector<std::uint32_t> cells{0, 1, 2, 0, 2, 3};
  const std::vector<std::size_t> ends{3, 6};
  const std::vector<OutputField> fields{{"pressure", {value.data()}}};
  write_cells(file, 4, {x.data(), y.data(), nullptr}, cells, ends, fields, 1.0);
  const CellFrame sound = read_cells(file);
  REQUIRE(sound.count() == 2);
  CHECK(sound.cells[1] == std::vector<std::uint32_t>{0, 2, 3});
  CHECK(sound.field("pressure")->values == value);
  refused(file, 3000, [&] {
    const CellFrame frame = read_cells(file);
    for (const auto& cell : frame.cells)
      for (const auto corner : cell) CHECK(corner < frame.position.size());
  });
}

TEST_CASE("damaged tables, lists of files and records are refused or read", "[output]") {
  const ScratchFolder folder;
  const auto table = folder.path / "history.csv", list = folder.path / "run.pvd",
             record = folder.path / "provenance.json";
  write_atomically(table, "time,velx\n0,1\n1,-2.5e-3\n2,nan\n");
  CHECK(read_table(table).columns[1][1] == -2.5e-3);
  refused(table, 2000, [&] {
    const ResultTable t = read_table(table);
    for (const auto& column : t.columns) CHECK(column.size() == t.rows());
  });
  Collection collection(list);
  collection.add(0, "particles/run_000000.vtp"), collection.add(0.5, "particles/run_000001.vtp");
  CHECK(read_collection(list).size() == 2);
  refused(list, 2000, [&] { read_collection(list); });
  write_atomically(
      record,
      R"({"status": "finished", "model": {"unit of time": "s"}, "unit_of": {"stress": "Pa"}, "materials": ["a"]})");
  const RunFolder run(folder.path);
  CHECK(run.legend().unit_of("stress.xx") == "Pa");
  CHECK(refused(record, 2000, [&] { run.legend(); }) > 500);
}

TEST_CASE("damaged checkpoints are refused", "[output]") {
  const ScratchFolder folder;
  const auto file = folder.path / "checkpoint.bin";
  CheckpointWriter writer;
  const std::vector<double> values{1, 2, 3};
  writer.put("values", values), writer.put("list.size", std::int64_t{3}), writer.put("name", "text");
  writer.save(file);
  CHECK(Checkpoint(file).doubles("values") == values);
  CHECK(refused(file, 3000, [&] { Checkpoint{file}; }) > 2900);
}

TEST_CASE("a checkpoint whose lists cannot be that long is refused before memory is spent", "[output]") {
  const ScratchFolder folder;
  const auto file = folder.path / "checkpoint.bin";
  for (const std::int64_t size : {std::int64_t{-1}, std::int64_t{1} << 62, std::int64_t{100000}}) {
    CheckpointWriter writer;
    writer.put("list.size", size), writer.put("list", std::vector<double>{1, 2});
    writer.save(file);
    const Checkpoint checkpoint(file);
    RestoringArchive archive(checkpoint);
    std::vector<double> list;
    CHECK_THROWS_AS(archive.resizable("list", list), FileError);
  }
}

TEST_CASE("a checkpoint with a number that is not finite or not of its type is refused", "[output]") {
  const ScratchFolder folder;
  const auto file = folder.path / "checkpoint.bin";
  const double right = 1.25, wrong = std::numeric_limits<double>::quiet_NaN();
  CheckpointWriter writer;
  writer.put("x", right), writer.put("flag", std::int64_t{2});
  writer.save(file);
  std::string bytes = read_file(file);
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&right), sizeof right));
  REQUIRE(at != std::string::npos);
  std::memcpy(bytes.data() + at, &wrong, sizeof wrong);
  const auto crc = static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + at - 1), static_cast<uInt>(1 + sizeof wrong)));
  std::memcpy(bytes.data() + at + sizeof wrong, &crc, sizeof crc);
  write_atomically(file, bytes);
  const Checkpoint checkpoint(file);
  RestoringArchive archive(checkpoint);
  double x = 0;
  bool flag = false;
  CHECK_THROWS_WITH(archive("x", x), Catch::Contains("'x' has a number that is not finite"));
  CHECK_THROWS_WITH(archive("flag", flag), Catch::Contains("'flag' is 2"));
}

TEST_CASE("a device is written to, and not replaced by a file", "[output]") {
  write_atomically("/dev/null", "text");
  CHECK(std::filesystem::is_character_file("/dev/null"));
  if (std::filesystem::exists("/dev/full")) CHECK_THROWS_AS(write_atomically("/dev/full", "text"), FileError);
  CHECK(!std::filesystem::is_regular_file("/dev/full"));
  CHECK_THROWS_AS(write_atomically("/dev/null", [](const std::string&) { return true; }), FileError);
}
