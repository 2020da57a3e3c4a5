// SPDX-License-Identifier: MIT
/// Contact at nodes with prescribed velocities, and the means from which it takes gaps.
#include "cloud.hpp"
#include "input/read.hpp"
#include "solver/contact/nodal_volumes.hpp"

#include <numbers>

using namespace tribo;
using namespace tribo::test;

namespace {

// Two blocks that meet at x = 10 and slide.
Model meeting_blocks(const std::string& header, const std::string& conditions, const std::string& mode = "") {
  return read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>)" +
                             header + "<MultiMaterialMode" + mode + R"('/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints><Body matname='a' vx='1' vy='0.5'><Rect xmin='6' xmax='10' ymin='3' ymax='7'/></Body>
  <Body matname='b' vx='-1' vy='-0.5'><Rect xmin='10' xmax='14' ymin='3' ymax='7'/></Body></MaterialPoints>
 <Material Type='1' Name='a'><rho>1</rho><E>100</E><nu>0</nu></Material>
 <Material Type='1' Name='b'><rho>3</rho><E>100</E><nu>0</nu></Material>)" +
                             conditions + "</JANFEAInput>",
                         "deck.xml");
}

// The nodal volumes of two bodies at a node at which they are in contact.
struct VolumesAtNode {
  std::unique_ptr<Transfers<2>> transfers;
  Exchanges<2> exchanges;
  NodalVolumes<2> volumes;
  ContactNodes<2> contacts;

  VolumesAtNode(const Model& model, System<2>& system, const Index<2>& at)
      : transfers(make_transfers<2>(model.scheme)), volumes(system, *transfers) {
    std::vector<Body<2>*> bodies;
    contacts.nodes.emplace_back().index = at;
    contacts.nodes.back().end_member = system.bodies.size();
    for (auto& body : system.bodies) {
      REQUIRE(body.bins.sort(system.lattice, body.particles) == -1);
      body.refresh();
      bodies.push_back(&body);
      std::vector<std::int64_t> occupied;
      for (const Bin& bin : body.bins.list()) occupied.push_back(bin.block);
      auto& field = system.fields[body.field];
      field.map.rebuild(occupied);
      exchanges.push_back(make_exchange<2>(model.grid, system.lattice));
      exchanges.back()->locate(field.map);
      ContactMember& member = contacts.members.emplace_back();
      member.field = body.field, member.node = field.map.node(at);
    }
    volumes.scatter(contacts, bodies, exchanges);
  }
};

}  // namespace

TEST_CASE("prescribed velocities win over contact", "[contact][conditions]") {
  const std::string update = GENERATE(as<std::string>{}, "USL", "USAVG"), transfer = GENERATE("FLIP", "APIC"),
                    again = GENERATE("", "<SkipPostExtrapolation/>");
  INFO(update << ", " << transfer << again);
  const std::string held =
      "<GridBCs><BCShape><Rect xmin='9.9' xmax='10.1' ymin='4.9' ymax='5.1'/><DisBC dir='12' angle='30' style='1' "
      "vel='0.75'/>"
      "</BCShape></GridBCs>";
  const auto velocities = [&](const std::string& conditions) {
    const Model model =
        meeting_blocks("<MPMMethod>" + update + "</MPMMethod>" + again + "<Transfer type='" + transfer + "'/>",
                       conditions, " Impulses='nodes");
    auto system = build_system<2>(model, place_points(model));
    Stepper<2> stepper(model, system);
    stepper.advance(1e-3);
    std::array<Vec<2>, 2> v;
    for (std::size_t f = 0; f < 2; ++f) {
      const auto& field = system.fields[f];
      const auto node = field.map.node({Lattice<2>::padding + 10, Lattice<2>::padding + 5});
      v[f] = Eigen::Map<const Vec<2>>(field.nodes[static_cast<std::size_t>(node)].velocity);
    }
    return v;
  };
  const auto free = velocities(""), prescribed = velocities(held);
  // by contact alone, masses of 1 and 3 that meet with 1 and -1
  for (const auto& v : free) CHECK(v[0] == Approx(-0.5).epsilon(0.01));
  // The blocks slide, so that the conditions make them approach: contact after them would change what they prescribe.
  const Vec<2> direction(std::cos(std::numbers::pi / 6), -std::sin(std::numbers::pi / 6));
  for (const auto& v : prescribed) CHECK(v.dot(direction) == Approx(0.75).epsilon(1e-14));
  CHECK((prescribed[0] - prescribed[1]).norm() > 0.01);
}

TEST_CASE("gaps by displacements and by positions are found from their means by volume", "[contact][faces]") {
  Model model = meeting_blocks("", "", " Normals='avggrad");
  CHECK(model.contact.separation == Separation::displacements);
  for (const auto separation : {Separation::displacements, Separation::positions}) {
    model.contact.separation = separation;
    auto system = build_system<2>(model, place_points(model));
    auto& moved = system.bodies[1].particles;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved.x()[0][i] -= 0.0625, moved.x()[1][i] += 0.125;
      moved.volume()[i] *= 2;  // does not change the means
    }
    const VolumesAtNode at_node(model, system, {Lattice<2>::padding + 10, Lattice<2>::padding + 5});
    const auto mean = [&](std::size_t f) {
      const VolumeNode& v = *at_node.contacts.members[f].volumes;
      REQUIRE(v.volume > 0);
      return Vec<2>(v.moment[0] / v.volume, v.moment[1] / v.volume);
    };
    if (separation == Separation::displacements) {
      CHECK(mean(0).norm() < 1e-15);
      CHECK((mean(1) - Vec<2>(-0.0625, 0.125)).norm() < 1e-13);
    } else {
      // uGIMP weights of particles of half size 0.25 at 0.25 and 0.75, and at 0.1875, 0.6875 and 1.1875 cells
      CHECK(mean(0)[0] == Approx(10 - (0.25 * 0.75 + 0.75 * 0.25)).epsilon(1e-13));
      const double w[] = {0.8046875, 0.3125, 0.00390625};
      CHECK(mean(1)[0] ==
            Approx(10 + (0.1875 * w[0] + 0.6875 * w[1] + 1.1875 * w[2]) / (w[0] + w[1] + w[2])).epsilon(1e-13));
    }
  }
}
