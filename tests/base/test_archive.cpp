// SPDX-License-Identifier: MIT
#include "archived.hpp"
#include "output/checkpoint_archive.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using namespace tribo::test;
using Catch::Contains;

namespace {

struct Inner {
  double a = 1.5;
  bool flag = true;
};
void archive(Archive& ar, Inner& inner) {
  auto& [a, flag] = inner;
  ar.version(3);
  ar("a", a), ar("flag", flag);
}

struct Outer {
  double x = -0.0, tiny = 5e-324;
  std::array<double, 2> pair{1, 2};
  std::int64_t count = 7;
  Eigen::Matrix<double, 3, 1> v{1, 2, 3};
  Inner inner;
  std::vector<Eigen::Matrix<double, 2, 2>> tensors{Eigen::Matrix2d::Identity(), 2 * Eigen::Matrix2d::Identity()};
  std::vector<std::uint32_t> numbers{4, 5};
  std::vector<Inner> list{{2.5, false}, {3.5, true}, {4.5, false}};
  std::vector<double> growing{1, 2, 3};
  std::map<std::pair<std::size_t, std::size_t>, Inner> by_pair{{{1, 2}, {9, true}}};
};
void archive(Archive& ar, Outer& outer) {
  auto& [x, tiny, pair, count, v, inner, tensors, numbers, list, growing, by_pair] = outer;
  ar.version(1);
  ar("x", x), ar("tiny", tiny), ar("pair", pair), ar("count", count), ar("v", v), ar("inner", inner);
  ar("tensors", tensors), ar("numbers", numbers), ar("list", list), ar.resizable("growing", growing);
  ar.map("by_pair", by_pair);
}

// Another version of Inner.
struct Later {
  double a = 0;
};
void archive(Archive& ar, Later& later) {
  ar.version(4);
  ar("a", later.a);
}

template <class T>
Checkpoint saved(const ScratchFolder& scratch, T object) {
  CheckpointWriter out;
  SavingArchive a(out);
  a("object", object);
  out.save(scratch.path / "c.bin");
  return Checkpoint(scratch.path / "c.bin");
}

template <class T>
void load(const Checkpoint& from, T& object) {
  RestoringArchive a(from);
  a("object", object);
  a.finish();
}

}  // namespace

TEST_CASE("an archive returns every member to the bit", "[archive]") {
  const ScratchFolder scratch;
  Outer original;
  const Checkpoint file = saved(scratch, original);
  Outer other;
  other.x = 1, other.tiny = 0, other.pair = {}, other.count = 0, other.v.setZero(), other.inner = {0, false};
  for (auto& t : other.tensors) t.setZero();
  other.numbers = {0, 0}, other.list = {3, Inner{0, false}}, other.growing = {}, other.by_pair = {{{5, 6}, {}}};
  CHECK(differences(archived(original), archived(other)).size() > 10);
  load(file, other);
  CHECK(differences(archived(original), archived(other)).empty());
  CHECK(file.doubles("object.list.a") == std::vector<double>{2.5, 3.5, 4.5});  // one entry per member of a list
  CHECK(file.integers("object.inner.version") == std::vector<std::int64_t>{3});
}

TEST_CASE("an archive names the entry that is wrong", "[archive]") {
  const ScratchFolder scratch;
  Outer object;
  SECTION("a list of another size") {
    const Checkpoint file = saved(scratch, object);
    object.list.resize(2);
    CHECK_THROWS_WITH(load(file, object), Contains("'object.list' has 3 objects, not 2"));
  }
  SECTION("an array of another size") {
    const Checkpoint file = saved(scratch, object);
    object.tensors.resize(3);
    CHECK_THROWS_WITH(load(file, object), Contains("'object.tensors' of the checkpoint has 8 numbers, not 12"));
  }
  SECTION("another version") {
    const Checkpoint file = saved(scratch, Later{});
    Inner inner;
    CHECK_THROWS_WITH(load(file, inner), Contains("'object.version' is 4, this program reads 3"));
  }
  SECTION("a missing entry") {
    const Checkpoint file = saved(scratch, Inner{});
    CHECK_THROWS_AS(load(file, object), FileError);
  }
  SECTION("an entry that nothing asks for") {
    const Checkpoint file = saved(scratch, object);
    RestoringArchive a(file);
    a.enter("object");
    double x = 1;
    a("x", x);
    CHECK(x == 0);
    CHECK_THROWS_WITH(a.finish(), Contains("'object.") && Contains("is unknown"));
  }
}
