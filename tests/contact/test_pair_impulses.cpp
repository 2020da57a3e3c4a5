// SPDX-License-Identifier: MIT
#include "contact/contact_cases.hpp"
#include "solver/contact/node_impulses.hpp"
#include "solver/contact/node_solver.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

/// Three bodies a | b | c in a row, masses 1, 2, 4; a and c do not touch.
struct Row {
  std::vector<ContactMember> members;
  std::vector<ContactPair> pairs;

  Row(const ContactLaw& law, double a, double b, double c) {
    const double mass[] = {1, 2, 4}, velocity[] = {a, b, c};
    for (int k = 0; k < 3; ++k) {
      ContactMember m;
      m.mass = mass[k], m.inverse_mass = 1 / mass[k];
      m.trial_velocity = Vec3(velocity[k], 0, 0);
      members.push_back(m);
    }
    for (const auto& [i, j, gap] : {std::tuple{0, 1, 0.0}, {0, 2, 1e9}, {1, 2, 0.0}}) {
      ContactPair pair;
      pair.a = static_cast<std::size_t>(i), pair.b = static_cast<std::size_t>(j), pair.law = &law;
      pair.state.mass = 1 / (members[pair.a].inverse_mass + members[pair.b].inverse_mass);
      pair.state.dt = 1e-3, pair.state.gap = gap, pair.state.area = 1;
      pairs.push_back(pair);
    }
  }
  double after(std::size_t k) const { return velocity_after(members, pairs, k)[0]; }
};

}  // namespace

TEST_CASE("three bodies at a node exchange the impulses of least energy", "[contact]") {
  const auto law = make_law("61", {});
  struct {
    double start[3], end[3];
  } const cases[] = {{{2, 0, -1}, {-2.0 / 7, -2.0 / 7, -2.0 / 7}},
                     {{2, 0, 3}, {2.0 / 3, 2.0 / 3, 3}},
                     {{2, 0, 0.5}, {4.0 / 7, 4.0 / 7, 4.0 / 7}},
                     {{-1, 0, 1}, {-1, 0, 1}}};
  for (const auto& [start, end] : cases) {
    Row row(*law, start[0], start[1], start[2]);
    solve_node(row.members, row.pairs, ContactPass::corrector, false);
    for (std::size_t k = 0; k < 3; ++k) CHECK(row.after(k) == Approx(end[k]).epsilon(0).margin(1e-12));
    const double before = start[0] + 2 * start[1] + 4 * start[2];
    CHECK(row.after(0) + 2 * row.after(1) + 4 * row.after(2) == Approx(before).margin(1e-14));
  }
}

TEST_CASE("faces that friction held do not slide in the predictor, whatever pressure it finds", "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.3"}});
  for (const double closing : {1.0, 0.0, -1.0}) {
    std::vector<ContactMember> members(2);
    members[0].inverse_mass = 1.0, members[0].trial_velocity = Vec3(0, closing, 0);
    members[1].inverse_mass = 0.5, members[1].trial_velocity = Vec3(4, 0, 1);
    std::vector<ContactPair> pairs(1);
    pairs[0].a = 0, pairs[0].b = 1, pairs[0].law = rough.get();
    pairs[0].state.mass = 1 / 1.5, pairs[0].state.dt = 1e-3, pairs[0].state.area = 1;
    pairs[0].state.normal = Vec3::UnitY();
    pairs[0].update_impulse = Vec3(0.1, -1, 0), pairs[0].update_mass = 1;
    const auto relative = [&](ContactPass pass, bool stuck) {
      pairs[0].update_status = stuck ? ContactStatus::stick : ContactStatus::slip;
      solve_node(members, pairs, pass, false);
      return Vec3(velocity_after(members, pairs, 1) - velocity_after(members, pairs, 0));
    };
    const Vec3 held = relative(ContactPass::predictor, true);
    CHECK(std::hypot(held[0], held[2]) < 1e-15);
    CHECK(held[1] == Approx(std::max(0.0, -closing)).margin(1e-15));  // faces that part go on parting
    CHECK(pairs[0].impulse[0] == Approx(4 / 1.5));
    for (const auto& [pass, stuck] :
         {std::pair{ContactPass::predictor, false}, std::pair{ContactPass::corrector, true}}) {
      const Vec3 free = relative(pass, stuck);
      CHECK(free[0] == Approx(4 - 0.3 * std::max(0.0, closing) * 4 / std::sqrt(17.0)));
    }
  }
}

TEST_CASE("pairs that carried an impulse keep the relative velocity of the update, along the face if they stuck",
          "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.3"}}), interface = make_law("62", {{"Dn", "10"}, {"Dt", "10"}});
  const auto film = make_law("64", {{"coeff", "2"}, {"LiquidPhase", "1"}});
  film->set_viscosity([](double) { return 1000.0; });
  const auto one_body = make_law("60", {}), glue = make_law("63", {{"coeff", "0.3"}, {"Sa", "1e5"}});
  for (const double closing : {1.0, 0.0, -1.0})
    for (const ContactLaw* law :
         std::initializer_list<const ContactLaw*>{rough.get(), glue.get(), interface.get(), film.get(), one_body.get()})
      for (const auto& [pressed, slid] : {std::pair{true, false}, {true, true}, {false, false}}) {
        std::vector<ContactMember> members(2);
        members[0].inverse_mass = 1.0, members[0].trial_velocity = Vec3(0, closing, 0);
        members[1].inverse_mass = 0.5, members[1].trial_velocity = Vec3(4, 0, 1);
        std::vector<ContactPair> pairs(1);
        pairs[0].a = 0, pairs[0].b = 1, pairs[0].law = law;
        pairs[0].state.mass = 1 / 1.5, pairs[0].state.dt = 1e-3, pairs[0].state.area = 1;
        pairs[0].state.normal = Vec3::UnitY(), pairs[0].end_velocity = Vec3(0.2, 0, -0.1);
        if (pressed) pairs[0].update_impulse = Vec3(0.1, -3, 0), pairs[0].update_mass = pairs[0].state.mass;
        pairs[0].update_status = slid ? ContactStatus::slip : ContactStatus::stick;
        const auto relative = [&](ContactPass pass) {
          solve_node(members, pairs, pass, false);
          return Vec3(velocity_after(members, pairs, 1) - velocity_after(members, pairs, 0));
        };
        const Vec3 by_law = relative(ContactPass::corrector), again = relative(ContactPass::held);
        Vec3 wanted = by_law;
        if (pressed && (law == rough.get() || law == glue.get()))
          wanted = slid ? Vec3(4, pairs[0].end_velocity[1], 1) : pairs[0].end_velocity;
        if (pressed && law == film.get()) wanted[1] = pairs[0].end_velocity[1];  // the drag follows the law
        CHECK((again - wanted).norm() < 1e-14);
      }
}

TEST_CASE("the velocity of a node that was hardly reached counts little once it is reached", "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.3"}});
  std::vector<ContactMember> members(2);
  members[0].inverse_mass = 1.0, members[1].inverse_mass = 0.5;
  std::vector<ContactPair> pairs(1);
  pairs[0].a = 0, pairs[0].b = 1, pairs[0].law = rough.get();
  pairs[0].state.mass = 1 / 1.5, pairs[0].state.dt = 1e-3, pairs[0].state.area = 1;
  pairs[0].state.normal = Vec3::UnitY();
  pairs[0].update_mass = 1e-12, pairs[0].end_velocity = Vec3(100, -3000, 0);
  pairs[0].update_impulse = Vec3(1e-10, 1e-9, 0), pairs[0].update_status = ContactStatus::stick;
  solve_node(members, pairs, ContactPass::held, false);
  CHECK(pairs[0].impulse.norm() < 1e-8);
  CHECK(velocity_after(members, pairs, 0).norm() < 1e-8);
}

TEST_CASE("many bodies with any frictional laws keep momentum and never gain energy", "[contact]") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto rough = make_law("61", {{"coeff", "0.6"}}), smooth = make_law("61", {}), sticky = make_law("60", {});
  const ContactLaw* laws[] = {rough.get(), smooth.get(), sticky.get()};
  for (int n = 0; n < 200; ++n) {
    std::vector<ContactMember> members(4);
    Vec3 momentum = Vec3::Zero();
    double energy = 0;
    for (auto& m : members) {
      m.mass = std::exp(normal(random)), m.inverse_mass = 1 / m.mass;
      m.trial_velocity = m.start_velocity = Vec3(normal(random), normal(random), normal(random));
      momentum += m.mass * m.trial_velocity, energy += 0.5 * m.mass * m.trial_velocity.squaredNorm();
    }
    std::vector<ContactPair> pairs;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        ContactPair pair;
        pair.a = a, pair.b = b, pair.law = laws[(a + b + static_cast<std::size_t>(n)) % 3];
        pair.state.mass = 1 / (members[a].inverse_mass + members[b].inverse_mass);
        pair.state.dt = 1e-3, pair.state.gap = -1e-3, pair.state.area = 1;
        pair.state.normal = Vec3(normal(random), normal(random), normal(random)).normalized();
        pairs.push_back(pair);
      }
    solve_node(members, pairs, ContactPass::corrector, false);
    Vec3 after = Vec3::Zero();
    double energy_after = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 v = velocity_after(members, pairs, k);
      after += members[k].mass * v, energy_after += 0.5 * members[k].mass * v.squaredNorm();
    }
    REQUIRE((after - momentum).norm() <= 1e-13 * (1 + momentum.norm()));
    REQUIRE(energy_after <= energy * (1 + 1e-9));
  }
}

TEST_CASE("at a node of eight bodies each pair obeys its law for the velocities that all others leave", "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.3"}});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int solved = 0;
  constexpr int nodes = 50;
  for (int n = 0; n < nodes; ++n) {
    std::vector<ContactMember> members(8);  // one in each octant, all of which move towards the node
    for (std::size_t k = 0; k < 8; ++k) {
      ContactMember& m = members[k];
      m.mass = std::exp(normal(random)), m.inverse_mass = 1 / m.mass;
      for (int d = 0; d < 3; ++d) m.trial_velocity[d] = ((k >> d & 1) != 0 ? -1.0 : 1.0) + 0.2 * normal(random);
    }
    std::vector<ContactPair> pairs;
    for (std::size_t a = 0; a < 8; ++a)
      for (int d = 0; d < 3; ++d) {
        const std::size_t b = a | std::size_t{1} << d;
        if (a == b) continue;
        ContactPair& pair = pairs.emplace_back();
        pair.a = a, pair.b = b, pair.law = rough.get();
        pair.state.mass = 1 / (members[a].inverse_mass + members[b].inverse_mass);
        pair.state.dt = 1e-3, pair.state.area = 1, pair.state.normal = Vec3::Unit(d);
      }
    solve_node(members, pairs, ContactPass::corrector, false);
    double worst = 0.0, most = 0.0;
    for (ContactPair& pair : pairs) {
      const Vec3 relative = velocity_after(members, pairs, pair.b) - velocity_after(members, pairs, pair.a);
      pair.state.velocity = relative + pair.impulse / pair.state.mass;
      worst = std::max(worst, (rough->response(pair.state).impulse - pair.impulse).norm());
      most = std::max(most, pair.impulse.norm());
    }
    CHECK(most > 0.0);
    solved += worst < 1e-10 * most ? 1 : 0;
  }
  CHECK(solved >= nodes / 2);  // at some, faces stick and slip in turn
}

TEST_CASE(
    "at the start of a step impulses at nodes conserve momentum, are those of the update, and are removed as a whole",
    "[contact]") {
  const auto smooth = make_law("61", {}), joined = make_law("60", {});
  const double light = 0.003, heavy = 1.0;
  for (const auto* law : {smooth.get(), joined.get()}) {
    System<2> system{Lattice<2>(Vec<2>(0, 0), Vec<2>(4, 4), {4, 4})};
    const Index<2> place{Lattice<2>::padding + 1, Lattice<2>::padding + 1};
    const std::vector blocks{system.lattice.block_index({place[0] / block_edge<2>, place[1] / block_edge<2>})};
    ContactNodes<2> contacts;
    ContactNode<2> node;
    node.index = place, node.end_member = 2, node.end_pair = 1;
    for (std::size_t f = 0; f < 2; ++f) {
      auto& field = system.fields.emplace_back(system.lattice);
      field.map.rebuild(blocks);
      field.nodes.resize(static_cast<std::size_t>(field.map.node_count()), Node{});
      ContactMember& m = contacts.members.emplace_back();
      m.field = f, m.node = field.map.node(place), m.mass = f == 0 ? light : heavy, m.inverse_mass = 1 / m.mass;
      Node& at = field.nodes[static_cast<std::size_t>(m.node)];
      at.mass = m.mass, at.velocity[1] = f == 0 ? 1 : 0;
    }
    ContactPair pair;
    pair.a = 0, pair.b = 1, pair.law = law;
    pair.state.mass = light * heavy / (light + heavy), pair.state.normal = Vec3::UnitY(), pair.state.area = 1;
    contacts.nodes.push_back(node), contacts.pairs.push_back(pair);
    NodeImpulses<2> impulses(system, contacts);
    const auto velocity = [&](std::size_t f) {
      return system.fields[f].nodes[static_cast<std::size_t>(contacts.members[f].node)].velocity[1];
    };
    const double common = light / (light + heavy);
    impulses.apply(1e-3, ContactPass::predictor);
    CHECK(velocity(0) == Approx(common));
    CHECK(velocity(1) == Approx(common));
    CHECK(light * velocity(0) + heavy * velocity(1) == Approx(light));
    impulses.remove();
    CHECK(velocity(0) == Approx(1));
    CHECK(velocity(1) == Approx(0).margin(1e-15));
    impulses.apply(1e-3, ContactPass::corrector);
    CHECK(velocity(0) == Approx(common));
  }
}
