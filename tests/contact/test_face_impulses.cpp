// SPDX-License-Identifier: MIT
#include "contact/contact_cases.hpp"
#include "solver/contact/contact_ledger.hpp"
#include "solver/contact/face_solver.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <utility>

using namespace tribo;
using namespace tribo::test;

namespace {

/// Two fields that share the nodes around a horizontal face; the lower one, a, may be rigid.
struct SharedNodes {
  System<2> system{Lattice<2>(Vec<2>(0, 0), Vec<2>(16, 16), {16, 16})};
  ContactNodes<2> contacts;
  std::vector<ContactPair>& pairs = contacts.pairs;
  FaceSolver<2> faces{system};
  Exchanges<2> exchanges;

  SharedNodes(const ContactLaw& law, double height, bool rigid, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0.01, 1);
    const int pad = Lattice<2>::padding;
    std::vector<std::int64_t> blocks;
    for (int i = 0; i < 16; ++i)
      blocks.push_back(system.lattice.block_index({(pad + i) / block_edge<2>, (pad + 8) / block_edge<2>}));
    for (int f = 0; f < 2; ++f) {
      auto& field = system.fields.emplace_back(system.lattice);
      field.map.rebuild(blocks);
      field.nodes.resize(static_cast<std::size_t>(field.map.node_count()), Node{});
      field.rigid_contact = rigid && f == 0;
      exchanges.push_back(make_exchange<2>(GridSpec{}, system.lattice));
      for (int i = 2; i < 14; ++i)
        for (int j = f == 0 ? 3 : 7; j <= (f == 0 ? 9 : 13); ++j) {
          Node& node = field.nodes[static_cast<std::size_t>(field.map.node({pad + i, pad + j}))];
          node.mass = unit(random);
          for (int d = 0; d < 2; ++d) node.velocity[d] = field.rigid_contact ? 0.3 * d : normal(random);
        }
    }
    for (int i = 2; i < 14; ++i)
      for (int j = 7; j <= 9; ++j) {
        const Index<2> place{pad + i, pad + j};
        ContactNode<2> node;
        node.index = place, node.first_member = contacts.members.size(), node.first_pair = pairs.size();
        for (std::size_t f = 0; f < 2; ++f) {
          ContactMember& member = contacts.members.emplace_back();
          member.field = f, member.node = system.fields[f].map.node(place);
          member.mass = system.fields[f].nodes[static_cast<std::size_t>(member.node)].mass;
          member.inverse_mass = system.fields[f].rigid_contact ? 0.0 : 1 / member.mass;
        }
        node.end_member = contacts.members.size(), node.end_pair = node.first_pair + 1;
        ContactPair pair;
        pair.a = node.first_member, pair.b = node.first_member + 1, pair.law = &law;
        pair.state.normal = Vec3::UnitY(), pair.state.area = 1;
        pair.face_position = height - j;
        pairs.push_back(pair), contacts.nodes.push_back(node);
      }
    faces.set_up(contacts, exchanges);
    REQUIRE(contacts.nodes[0].solved_on_faces);
  }
  SharedNodes(const SharedNodes&) = delete;
  SharedNodes& operator=(const SharedNodes&) = delete;

  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    each([&](const Node& n) { sum += n.mass * Eigen::Map<const Vec3>(n.velocity); });
    return sum;
  }
  double energy() const {
    double sum = 0.0;
    each([&](const Node& n) { sum += 0.5 * n.mass * Eigen::Map<const Vec3>(n.velocity).squaredNorm(); });
    return sum;
  }
  /// Those of all nodes of both fields.
  std::vector<double> velocities() const {
    std::vector<double> all;
    for (const auto& field : system.fields)
      for (const auto& node : field.nodes) all.insert(all.end(), node.velocity, node.velocity + 2);
    return all;
  }
  void each(const std::function<void(const Node&)>& f) const {
    for (const auto& field : system.fields)
      if (!field.rigid_contact)
        for (const Node& n : field.nodes) f(n);
  }
};

}  // namespace

TEST_CASE("impulses on faces keep momentum, take energy and stop faces from passing", "[contact]") {
  const auto smooth = make_law("61", {}), rough = make_law("61", {{"coeff", "0.4"}});
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const double height : {8.0, 8.3, 7.6})
      for (const auto* law : {smooth.get(), rough.get()}) {
        SharedNodes shared(*law, height, false, seed);
        const Vec3 momentum = shared.momentum();
        const double energy = shared.energy();
        shared.faces.apply(1e-3, ContactPass::corrector);
        CHECK((shared.momentum() - momentum).norm() < 1e-12 * std::sqrt(2 * energy));
        CHECK(shared.energy() < energy);
        for (const auto& pair : shared.pairs) {
          CHECK(pair.impulse[1] <= 0);  // pushes a down
          CHECK(pair.final_velocity[1] > -0.02);
          CHECK(std::abs(pair.impulse[0]) <= 0.4 * -pair.impulse[1] + 1e-12);
        }
      }
}

TEST_CASE("at the start of a step impulses on faces change the velocities like those of the update, and are removed",
          "[contact]") {
  const auto smooth = make_law("61", {});
  const int pad = Lattice<2>::padding;
  SharedNodes shared(*smooth, 8.0, false, 3);
  auto& lower = shared.system.fields[0];
  for (int i = 2; i < 14; ++i)  // nodes that the lower body hardly reaches
    lower.nodes[static_cast<std::size_t>(lower.map.node({pad + i, pad + 9}))].mass = 0.01;
  shared.faces.set_up(shared.contacts, shared.exchanges);
  const auto before = shared.velocities();
  shared.faces.apply(1e-3, ContactPass::predictor);
  const auto after = shared.velocities();
  shared.faces.remove();
  const auto removed = shared.velocities();
  shared.faces.apply(1e-3, ContactPass::corrector);
  const auto end = shared.velocities();
  for (std::size_t k = 0; k < before.size(); ++k) {
    CHECK(removed[k] == Approx(before[k]).margin(1e-12));
    CHECK(after[k] == Approx(end[k]).margin(1e-12));
  }
}

TEST_CASE("before the update, faces under pressure keep their velocity also where the extrapolated one parts them",
          "[contact]") {
  const auto smooth = make_law("61", {}), rough = make_law("61", {{"coeff", "0.4"}});
  for (unsigned seed = 0; seed < 5; ++seed)
    for (const bool rigid : {false, true})
      for (const auto* law : {smooth.get(), rough.get()}) {
        SharedNodes shared(*law, 8.3, rigid, seed);
        for (auto& pair : shared.pairs) {
          pair.update_impulse = Vec3(law == rough.get() ? 1 : 0, -3, 0), pair.update_mass = 1;
          pair.update_status = ContactStatus::stick;
        }
        const Vec3 momentum = shared.momentum();
        double parting = 0.0;
        for (int k = 0; k < 60; ++k) {  // the solver improves its impulses in each call
          shared.faces.apply(1e-3, ContactPass::held);
          if (k == 0)
            for (const auto& pair : shared.pairs) parting = std::min(parting, pair.impulse[1] * -1);
        }
        CHECK(parting < 0);  // some faces are held together
        for (const auto& pair : shared.pairs) {
          CHECK(std::abs(pair.final_velocity[1]) < 1e-3);
          if (law == rough.get()) CHECK(std::abs(pair.final_velocity[0]) < 1e-3);
        }
        if (!rigid) CHECK((shared.momentum() - momentum).norm() < 1e-11);
      }
}

TEST_CASE("filtered velocities at the start of a step obey contact at light nodes, too", "[contact]") {
  const auto smooth = make_law("61", {});
  const int pad = Lattice<2>::padding;
  // Velocities of both bodies that the predictor and a filter without increments leave, or those after the corrector.
  const auto velocities = [&](ContactPass pass) {
    SharedNodes shared(*smooth, 8.0, false, 3);
    auto& lower = shared.system.fields[0];
    for (int i = 2; i < 14; ++i) lower.nodes[static_cast<std::size_t>(lower.map.node({pad + i, pad + 9}))].mass = 0.01;
    shared.faces.set_up(shared.contacts, shared.exchanges);
    for (auto& field : shared.system.fields) field.filter.resize(field.nodes.size(), FilterNode{});
    shared.faces.apply(1e-3, pass);
    for (int k = 0; k < 4; ++k) {  // the solver improves its impulses in each call
      shared.faces.constrain_increments(pass);
      for (auto& field : shared.system.fields)
        for (std::size_t n = 0; n < field.nodes.size(); ++n)
          for (int d = 0; d < 2; ++d) field.nodes[n].velocity[d] += std::exchange(field.filter[n].increment[d], 0.0);
    }
    return shared.velocities();
  };
  const auto start = velocities(ContactPass::predictor), end = velocities(ContactPass::corrector);
  double largest = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < start.size(); ++k) {
    largest = std::max(largest, std::abs(end[k]));
    difference = std::max(difference, std::abs(start[k] - end[k]));
  }
  REQUIRE(largest > 1);
  CHECK(difference < 1e-5 * largest);
}

TEST_CASE("impulses on faces push a rigid body at the face, not at the nodes", "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.4"}});
  for (const double height : {8.0, 8.3, 7.6}) {
    SharedNodes shared(*rough, height, true, 3);
    shared.faces.apply(1e-3, ContactPass::corrector);
    ContactLedger<2> ledger(shared.system);
    ledger.record(shared.contacts, 1e-3, false, false, 0.0);
    const RigidExchange& exchange = ledger.rigid_exchanges().at(0);
    REQUIRE(exchange.impulse.norm() > 0);
    double moment = 0;  // x cross impulse, at the height of the face
    for (const auto& node : shared.contacts.nodes)
      for (const auto& pair : shared.contacts.pairs_of(node))
        moment += shared.system.lattice.position(node.index)[0] * pair.impulse[1] - height * pair.impulse[0];
    CHECK(exchange.moment[2] == Approx(moment));
  }
}

TEST_CASE("impulses on faces next to a symmetry plane are those of the whole body", "[contact]") {
  const auto law = make_law("61", {{"coeff", "0.4"}});
  constexpr int plane = 8, last = 13, pad = Lattice<2>::padding;
  const auto rigid = GENERATE(false, true);
  const auto pass = GENERATE(ContactPass::predictor, ContactPass::corrector);
  // Two bodies that are symmetric about the plane x = 8, with a face that is curved; `half`: only the part beyond it.
  const auto apply = [&](SharedNodes& shared, bool half) {
    for (auto& field : shared.system.fields)
      for (std::int64_t k = 0; k < field.map.node_count(); ++k) {
        const auto index = field.map.node_at(k);
        Node& node = field.nodes[static_cast<std::size_t>(k)];
        const int beyond = index[0] - pad - plane;
        if (beyond == 0) node.velocity[0] = 0.0;
        if (beyond < 0 && (half || plane - beyond > last)) {
          node = Node{};
        } else if (beyond < 0) {
          node = field.nodes[static_cast<std::size_t>(field.map.node({pad + plane - beyond, index[1]}))];
          node.velocity[0] *= -1;
        }
      }
    auto& nodes = shared.contacts.nodes;
    for (auto& node : nodes)
      for (auto& pair : shared.contacts.pairs_of(node)) {
        const int beyond = node.index[0] - pad - plane;
        pair.state.normal = Vec3(0.1 * beyond, 1, 0).normalized();
        if (std::abs(beyond) == 1) pair.foremost_offset[0] = -1.4 * beyond;  // to a place beyond the plane
        if (beyond == 0 && half) node.ownership = 0.5, node.mirrored_axes = 1;
      }
    nodes.erase(
        std::remove_if(nodes.begin(), nodes.end(),
                       [&](const auto& node) { return node.index[0] - pad < (half ? plane : 2 * plane - last); }),
        nodes.end());
    if (half) {
      GridSpec grid;
      grid.symmetry[0][0] = plane;
      for (std::size_t f = 0; f < 2; ++f) {
        shared.exchanges[f] = make_exchange<2>(grid, shared.system.lattice);
        shared.exchanges[f]->locate(shared.system.fields[f].map);
      }
    }
    shared.faces.set_up(shared.contacts, shared.exchanges);
    shared.faces.apply(1e-3, pass);
  };
  for (const double height : {8.0, 8.3, 7.6}) {
    SharedNodes whole(*law, height, rigid, 7), half(*law, height, rigid, 7);
    apply(whole, false), apply(half, true);
    double difference = 0.0, largest = 0.0;
    for (std::size_t f = rigid ? 1 : 0; f < 2; ++f)
      for (int i = plane; i <= last; ++i)
        for (int j = 4; j <= 12; ++j) {
          const auto& map = whole.system.fields[f].map;
          const auto k = static_cast<std::size_t>(map.node({pad + i, pad + j}));
          const Vec<2> of_whole(whole.system.fields[f].nodes[k].velocity),
              of_half(half.system.fields[f].nodes[k].velocity);
          if (i == plane) CHECK(of_half[0] == 0.0);
          difference = std::max(difference, (of_whole - of_half).norm());
          largest = std::max(largest, of_whole.norm());
        }
    REQUIRE(largest > 0.5);
    // The sweeps over the constraints end before they have converged to the last digit.
    CHECK(difference < 1e-3 * largest);
  }
}

TEST_CASE("next to a rigid face the mirror image of a node moves against it", "[contact]") {
  // A face on a grid line: linear strain along the normal must pass, only its mean is held.
  const auto law = make_law("61", {{"coeff", "-1"}, {"displacementOnly", "1"}});  // sticks
  SharedNodes shared(*law, 8.0, true, 1);
  auto& field = shared.system.fields[1];
  const auto at = [&](int i, int j) -> Node& {
    return field.nodes[static_cast<std::size_t>(field.map.node({Lattice<2>::padding + i, Lattice<2>::padding + j}))];
  };
  for (int i = 2; i < 14; ++i)
    for (int j = 7; j <= 13; ++j) at(i, j).velocity[0] = 0.0, at(i, j).velocity[1] = 0.3 + 0.1 * (j - 8);
  shared.faces.apply(1e-3, ContactPass::predictor);
  for (int i = 2; i < 14; ++i)
    for (int j = 7; j <= 13; ++j) CHECK(at(i, j).velocity[1] == Approx(0.3 + 0.1 * (j - 8)).margin(1e-14));
  for (int i = 2; i < 14; ++i)
    for (int j = 7; j <= 13; ++j) at(i, j).velocity[1] -= 0.2;
  shared.faces.apply(1e-3, ContactPass::predictor);
  for (const auto& pair : shared.pairs) CHECK(pair.final_velocity.norm() < 1e-6);
}

TEST_CASE("impulses on faces start from those of the last step", "[contact]") {
  const auto rough = make_law("61", {{"coeff", "0.4"}});
  SharedNodes first(*rough, 8.3, false, 5), second(*rough, 8.3, false, 5);
  first.faces.apply(1e-3, ContactPass::corrector);
  for (std::size_t k = 0; k < first.pairs.size(); ++k) second.pairs[k].update_impulse = first.pairs[k].impulse;
  second.faces.apply(1e-3, ContactPass::corrector);
  double far = 0.0, size = 0.0;
  for (std::size_t k = 0; k < first.pairs.size(); ++k) {
    far += (second.pairs[k].impulse - first.pairs[k].impulse).squaredNorm(),
        size += first.pairs[k].impulse.squaredNorm();
    CHECK(second.pairs[k].final_velocity[1] > -0.005);
  }
  CHECK(far < 1e-4 * size);
}

TEST_CASE("a rigid body does the work of the impulses on faces at its velocity there", "[contact]") {
  const auto law = make_law("61", {{"coeff", "-1"}, {"displacementOnly", "1"}});  // sticks
  SharedNodes shared(*law, 8.0, true, 3);
  // A rigid rotation: the velocity along x grows with the height, and is 0.5 at the face.
  auto& rigid = shared.system.fields[0];
  for (int i = 2; i < 14; ++i)
    for (int j = 3; j <= 9; ++j)
      rigid.nodes[static_cast<std::size_t>(rigid.map.node({Lattice<2>::padding + i, Lattice<2>::padding + j}))]
          .velocity[0] = 0.5 + 0.25 * (j - 8);
  shared.faces.set_up(shared.contacts, shared.exchanges);
  const Vec3 before = shared.momentum();
  shared.faces.apply(1e-3, ContactPass::corrector);
  const Vec3 impulse = shared.momentum() - before;
  ContactLedger<2> ledger(shared.system);
  ledger.record(shared.contacts, 1e-3, false, false, 0.0);
  CHECK((ledger.rigid_impulse - impulse).norm() < 1e-12 * impulse.norm());
  CHECK(std::abs(impulse[0]) > 0.1);
  CHECK(ledger.rigid_work == Approx(impulse.dot(Vec3(0.5, 0.3, 0))));
}

TEST_CASE("impulses on faces make the velocity of a body at the face right where it does not reach all nodes",
          "[contact]") {
  const auto smooth = make_law("61", {});
  // The face is at 8.3, and the upper body reaches nodes from 8 on: the image of the node at 9 lies at 7.6, between the
  // node at 8 and one without mass. Its velocity decreases linearly from the face on.
  SharedNodes shared(*smooth, 8.3, true, 1);
  auto& upper = shared.system.fields[1];
  for (std::int64_t n = 0; n < upper.map.node_count(); ++n) {
    Node& node = upper.nodes[static_cast<std::size_t>(n)];
    const double height = upper.map.node_at(n)[1] - Lattice<2>::padding;
    node.mass = height < 7.5 ? 0.0 : height < 13.5 ? 1.0 : 0.0;
    node.velocity[0] = 0.0, node.velocity[1] = 0.3 - 0.1 * (height - 8.3);  // 0.3: of the rigid body
  }
  shared.faces.set_up(shared.contacts, shared.exchanges);
  shared.faces.apply(1e-3, ContactPass::corrector);
  for (const auto& pair : shared.pairs) {
    const auto& node = shared.contacts.nodes[static_cast<std::size_t>(&pair - shared.pairs.data())];
    if (node.index[1] == Lattice<2>::padding + 7) continue;  // the upper body does not reach it
    CHECK(pair.final_velocity.norm() < 1e-12);
    CHECK(pair.impulse.norm() < 1e-12);
  }
}
