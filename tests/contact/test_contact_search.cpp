// SPDX-License-Identifier: MIT
/// The search for nodes that carry two or more velocity fields.

#include "solver/contact/contact_search.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <random>

using namespace tribo;

namespace {

/// Fields without particles on a grid of 16 x 16 unit cells from 0; masses are set node by node.
struct Fields {
  GridSpec grid;
  Model model;
  System<2> system{Lattice<2>(Vec<2>(0, 0), Vec<2>(16, 16), {16, 16})};
  Exchanges<2> exchanges;

  explicit Fields(std::size_t count) {
    grid.high = {16, 16, 0}, grid.cells = {16, 16, 1};
    for (std::size_t f = 0; f < count; ++f) {
      auto& field = system.fields.emplace_back(system.lattice);
      field.base_field = f;
      field.map.rebuild(std::vector<std::int64_t>{system.lattice.block_index(block_of({8, 8}))});
      field.nodes.resize(static_cast<std::size_t>(field.map.node_count()), Node{});
    }
  }
  /// Index of the node at (i, j) in the lattice.
  static Index<2> at(int i, int j) { return {Lattice<2>::padding + i, Lattice<2>::padding + j}; }
  static Index<2> block_of(const Index<2>& cell) {
    const Index<2> n = at(cell[0], cell[1]);
    return {n[0] / block_edge<2>, n[1] / block_edge<2>};
  }
  void set_mass(std::size_t f, int i, int j, double mass) {
    auto& field = system.fields[f];
    field.nodes[static_cast<std::size_t>(field.map.node(at(i, j)))].mass = mass;
  }
  void make_exchanges() {
    for (auto& field : system.fields) {
      exchanges.push_back(make_exchange<2>(grid, system.lattice));
      exchanges.back()->locate(field.map);
    }
  }
};

}  // namespace

TEST_CASE("the contact search finds exactly the nodes that carry two or more fields", "[contact][search]") {
  Fields fields(3);
  fields.set_mass(0, 8, 8, 2.0), fields.set_mass(1, 8, 8, 3.0);
  fields.set_mass(0, 9, 8, 1.0);
  fields.set_mass(0, 7, 10, 1.0), fields.set_mass(1, 7, 10, 2.0), fields.set_mass(2, 7, 10, 4.0);
  fields.set_mass(1, 3, 3, 1.0), fields.set_mass(2, 3, 4, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  CHECK(search.node_at(Fields::at(8, 8)) == nullptr);  // before the first search
  search.locate();
  search.find(fields.exchanges);
  const auto& found = search.found();
  REQUIRE(found.nodes.size() == 2);
  CHECK(found.nodes[0].end_member - found.nodes[0].first_member == 3);
  CHECK(found.nodes[1].end_member - found.nodes[1].first_member == 2);

  const ContactNode<2>* two = search.node_at(Fields::at(8, 8));
  REQUIRE(two);
  CHECK(two->index == Fields::at(8, 8));
  CHECK(two->ownership == 1.0);
  CHECK(two->mirrored_axes == 0);
  CHECK(two->between_bodies);
  REQUIRE(found.pairs_of(*two).size() == 1);
  const ContactPair& pair = found.pairs_of(*two)[0];
  const ContactMember &a = found.members[pair.a], &b = found.members[pair.b];
  CHECK(a.field == 0);
  CHECK(b.field == 1);
  CHECK(a.mass == 2.0);
  CHECK(b.inverse_mass == Approx(1.0 / 3));
  CHECK(a.node == fields.system.fields[0].map.node(Fields::at(8, 8)));
  CHECK(pair.state.mass == Approx(2.0 * 3.0 / 5.0));
  CHECK(pair.crack == -1);

  const ContactNode<2>* three = search.node_at(Fields::at(7, 10));
  REQUIRE(three);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const ContactPair& p : found.pairs_of(*three))
    pairs.emplace_back(found.members[p.a].field, found.members[p.b].field);
  CHECK(pairs == std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {0, 2}, {1, 2}});

  for (const auto& [i, j] : {std::pair{9, 8}, {3, 3}, {3, 4}, {8, 9}})
    CHECK(search.node_at(Fields::at(i, j)) == nullptr);
  CHECK(search.node_at({-1, 5}) == nullptr);
  CHECK(search.node_at({5, 1000000}) == nullptr);

  // A new search forgets the old nodes.
  fields.set_mass(1, 8, 8, 0.0);
  search.find(fields.exchanges);
  CHECK(search.found().nodes.size() == 1);
  CHECK(search.node_at(Fields::at(8, 8)) == nullptr);
  CHECK(search.node_at(Fields::at(7, 10)) == &search.found().nodes[0]);
}

TEST_CASE("rigid fields take part in contact with deformable ones only", "[contact][search]") {
  Fields fields(3);
  fields.system.fields[0].rigid_contact = fields.system.fields[2].rigid_contact = true;
  for (std::size_t f = 0; f < 3; ++f) fields.set_mass(f, 8, 8, 2.0);
  fields.set_mass(0, 8, 9, 1.0), fields.set_mass(2, 8, 9, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  const auto& found = search.found();
  REQUIRE(found.nodes.size() == 1);  // not the node with rigid fields only
  CHECK(search.node_at(Fields::at(8, 9)) == nullptr);
  const std::size_t first = found.nodes[0].first_member;
  REQUIRE(found.nodes[0].end_member == first + 3);
  CHECK(found.members[first].inverse_mass == 0.0);
  CHECK(found.members[first + 1].inverse_mass == 0.5);
  REQUIRE(found.pairs_of(found.nodes[0]).size() == 2);  // not the pair of the two rigid fields
  for (const ContactPair& pair : found.pairs_of(found.nodes[0])) {
    CHECK((pair.a == first + 1 || pair.b == first + 1));
    CHECK(pair.state.mass == Approx(2.0));  // the mass of the deformable one
  }
}

TEST_CASE("fields on two sides of one crack form a pair of crack faces, on two sides of two cracks none",
          "[contact][search][cracks]") {
  Fields fields(3);
  for (std::size_t f = 0; f < 3; ++f) {
    fields.system.fields[f].side = static_cast<int>(f);  // 0: own side, 1 and 2: across the first and second crack
    fields.system.fields[f].base_field = 0;
    fields.set_mass(f, 8, 8, 1.0);
  }
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  const auto& found = search.found();
  REQUIRE(found.nodes.size() == 1);
  CHECK_FALSE(found.nodes[0].between_bodies);
  REQUIRE(found.pairs_of(found.nodes[0]).size() == 2);
  for (const ContactPair& pair : found.pairs_of(found.nodes[0])) {
    CHECK(found.members[pair.a].field == 0);
    CHECK(pair.crack == 0);
    CHECK(pair.law == nullptr);
  }
}

TEST_CASE("contact nodes on symmetry planes know their planes and their share of sums", "[contact][search]") {
  Fields fields(2);
  fields.grid.symmetry[0][0] = 8.0, fields.grid.symmetry[1][1] = 9.0;
  for (std::size_t f = 0; f < 2; ++f)
    for (const auto& [i, j] : {std::pair{8, 8}, {8, 9}, {9, 8}}) fields.set_mass(f, i, j, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  const auto check = [&](int i, int j, int axes, double ownership) {
    const ContactNode<2>* node = search.node_at(Fields::at(i, j));
    REQUIRE(node);
    CHECK(node->mirrored_axes == axes);
    CHECK(node->ownership == ownership);
  };
  check(9, 8, 0, 1.0), check(8, 8, 1, 0.5), check(8, 9, 3, 0.25);
}

TEST_CASE("the contact search follows a change of the fields' maps", "[contact][search]") {
  Fields fields(2);
  fields.set_mass(0, 8, 8, 1.0), fields.set_mass(1, 8, 8, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  REQUIRE(search.found().nodes.size() == 1);
  auto& field = fields.system.fields[1];
  field.map.rebuild(std::vector<std::int64_t>{});
  field.nodes.clear();
  search.locate();
  search.find(fields.exchanges);
  CHECK(search.found().nodes.empty());
  CHECK(search.node_at(Fields::at(8, 8)) == nullptr);
}

TEST_CASE("the search knows the pairs that friction held in the last step", "[contact][search]") {
  Fields fields(3);
  for (std::size_t f = 0; f < 3; ++f) fields.set_mass(f, 8, 8, 1.0), fields.set_mass(f, 9, 8, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  REQUIRE(search.found().nodes.size() == 2);
  const auto set = [&](std::size_t k, ContactStatus status, const Vec3& impulse) {
    ContactPair& pair = search.found().pairs_of(search.found().nodes[k / 3])[k % 3];
    pair.state.normal = Vec3(0.6, 0.8, 0), pair.update_status = status, pair.update_impulse = impulse;
  };
  const Vec3 normal(-0.6, -0.8, 0);
  set(0, ContactStatus::slip, normal + Vec3::UnitZ());
  set(1, ContactStatus::stick, normal + Vec3::UnitZ());
  set(2, ContactStatus::stick, normal);  // without a shear impulse friction holds nothing
  set(5, ContactStatus::stick, normal + 1e-6 * Vec3::UnitZ());
  fields.set_mass(0, 8, 8, 0.0);  // the pair 1, of the fields 0 and 2, is gone
  fields.set_mass(0, 7, 8, 1.0), fields.set_mass(1, 7, 8, 1.0);
  search.locate();
  search.find(fields.exchanges);
  std::vector<std::array<std::int64_t, 3>> stuck_pairs;
  for (const auto& node : search.found().nodes)
    for (const auto& pair : search.found().pairs_of(node)) {
      const auto field = [&](std::size_t m) { return static_cast<std::int64_t>(search.found().members[m].field); };
      if (tribo::stuck(pair, Vec3(0.6, 0.8, 0)))
        stuck_pairs.push_back({node.index[0] - Lattice<2>::padding, field(pair.a), field(pair.b)});
    }
  CHECK(stuck_pairs == std::vector<std::array<std::int64_t, 3>>{{9, 1, 2}});
}

TEST_CASE("lists kept from step to step equal those found anew", "[contact][search]") {
  constexpr std::size_t count = 4;
  Fields fields(count);
  fields.system.fields[2].rigid_contact = true;
  for (std::size_t f = 0; f < count; ++f) {
    std::vector<std::int64_t> blocks;
    for (const int j : {2, 6, 10, 13})
      for (const int i : {2, 6, 10, 13}) blocks.push_back(fields.system.lattice.block_index(Fields::block_of({i, j})));
    std::sort(blocks.begin(), blocks.end());
    auto& field = fields.system.fields[f];
    field.map.rebuild(blocks);
    field.nodes.assign(static_cast<std::size_t>(field.map.node_count()), Node{});
  }
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  using Key = std::array<std::int64_t, 4>;  // of a pair: its node and fields
  const auto key_of = [](const auto& found, const auto& node, const ContactPair& pair) {
    const auto field = [&](std::size_t m) { return static_cast<std::int64_t>(found.members[m].field); };
    return Key{node.index[0], node.index[1], field(pair.a), field(pair.b)};
  };
  std::map<Key, Vec3> impulses;  // of the pairs of the last step
  int in_place = 0, moved = 0;
  for (int step = 0; step < 200; ++step) {
    INFO("step " << step);
    // Few nodes change in most steps, many in some.
    for (int k = below(10) == 0 ? 200 : below(4); k > 0; --k)
      fields.set_mass(static_cast<std::size_t>(below(count)), 2 + below(12), 2 + below(12),
                      below(3) == 0 ? 0.0 : 1.0 + below(5));
    if (step % 50 == 49) search.locate();
    ContactSearch<2> anew(fields.system, laws);
    anew.locate(), anew.find(fields.exchanges);
    const auto& expected = anew.found();
    search.find(fields.exchanges);
    auto& found = search.found();
    (found.moved ? moved : in_place) += 1;
    REQUIRE(found.nodes.size() == expected.nodes.size());
    std::map<Key, Vec3> next;
    for (std::size_t n = 0; n < found.nodes.size(); ++n) {
      const auto &node = found.nodes[n], &of = expected.nodes[n];
      REQUIRE(node.index == of.index);
      REQUIRE(search.node_at(node.index) == &node);
      REQUIRE(found.pairs_of(node).size() == expected.pairs_of(of).size());
      for (std::size_t p = 0; p < found.pairs_of(node).size(); ++p) {
        ContactPair& pair = found.pairs_of(node)[p];
        const Key key = key_of(found, node, pair);
        REQUIRE(key == key_of(expected, of, expected.pairs_of(of)[p]));
        REQUIRE(pair.state.mass == expected.pairs_of(of)[p].state.mass);
        REQUIRE(pair.impulse.isZero(0));
        const auto last = impulses.find(key);
        REQUIRE(pair.update_impulse == (last == impulses.end() ? Vec3(Vec3::Zero()) : last->second));
        pair.impulse = pair.update_impulse = below(2) == 0 ? Vec3(Vec3::Zero()) : Vec3(1 + below(100), below(100), 0);
        if (!pair.update_impulse.isZero(0)) next[key] = pair.update_impulse;
      }
    }
    impulses = next;
  }
  CHECK(in_place > 100);
  CHECK(moved > 4);
}

TEST_CASE("impulses of pairs that have parted are forgotten, also if no nodes are shared meanwhile",
          "[contact][search]") {
  Fields fields(2);
  fields.set_mass(0, 8, 8, 1.0), fields.set_mass(1, 8, 8, 1.0);
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  const auto find = [&] {
    search.locate();
    search.find(fields.exchanges);
  };
  const auto map_to = [&](int cell) {
    auto& field = fields.system.fields[1];
    field.map.rebuild(std::vector<std::int64_t>{fields.system.lattice.block_index(Fields::block_of({cell, cell}))});
    field.nodes.assign(static_cast<std::size_t>(field.map.node_count()), Node{});
    fields.exchanges[1]->locate(field.map);
  };
  find();
  search.found().pairs_of(search.found().nodes[0])[0].update_impulse = Vec3(1, 2, 0);
  SECTION("the fields still share nodes: kept") {
    find();
    CHECK(search.found().pairs_of(search.found().nodes[0])[0].update_impulse == Vec3(1, 2, 0));
  }
  SECTION("in between they do not: forgotten") {
    map_to(2);
    find();
    CHECK(search.found().nodes.empty());
    map_to(8);
    fields.set_mass(1, 8, 8, 1.0);
    find();
    CHECK(search.found().pairs_of(search.found().nodes[0])[0].update_impulse.isZero(0));
  }
}

TEST_CASE("two deformable bodies at a node form a pair also where a rigid body is at it", "[contact][search]") {
  Fields fields(3);
  const std::size_t rigid = GENERATE(0, 1, 2);
  fields.system.fields[rigid].rigid_contact = true;
  for (std::size_t f = 0; f < 3; ++f) fields.set_mass(f, 8, 8, 2.0 + static_cast<double>(f));
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  const auto& found = search.found();
  REQUIRE(found.nodes.size() == 1);
  REQUIRE(found.pairs_of(found.nodes[0]).size() == 3);
  for (const ContactPair& pair : found.pairs_of(found.nodes[0])) {
    const ContactMember &a = found.members[pair.a], &b = found.members[pair.b];
    const double ma = a.mass, mb = b.mass;
    const double reduced = a.field == rigid ? mb : b.field == rigid ? ma : ma * mb / (ma + mb);
    CHECK(pair.state.mass == Approx(reduced));
  }
}

TEST_CASE("a node holds the pairs of materials and those across a crack, each of which is one of its crack",
          "[contact][search][cracks]") {
  Fields fields(4);  // two materials, each on both sides of a crack
  for (std::size_t f = 0; f < 4; ++f) {
    fields.system.fields[f].side = static_cast<int>(f / 2), fields.system.fields[f].base_field = f % 2;
    fields.set_mass(f, 8, 8, 1.0 + static_cast<double>(f));
  }
  fields.make_exchanges();
  const ContactLaws<2> laws(fields.model, fields.system);
  ContactSearch<2> search(fields.system, laws);
  search.locate();
  search.find(fields.exchanges);
  const auto& found = search.found();
  REQUIRE(found.nodes.size() == 1);
  REQUIRE(found.pairs_of(found.nodes[0]).size() == 6);
  for (const ContactPair& pair : found.pairs_of(found.nodes[0])) {
    const ContactMember &a = found.members[pair.a], &b = found.members[pair.b];
    INFO("fields " << a.field << " and " << b.field);
    CHECK((pair.crack == 0) == (a.field < 2 && b.field >= 2));  // whether or not the materials are the same
    CHECK(pair.state.mass == Approx(a.mass * b.mass / (a.mass + b.mass)));
  }
}
