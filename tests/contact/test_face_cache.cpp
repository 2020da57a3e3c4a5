// SPDX-License-Identifier: MIT
/// Faces that are kept from step to step, compared with faces that are found from all particles.

#include "base/parallel.hpp"
#include "contact/contact_cases.hpp"
#include "solver/cloud.hpp"
#include "solver/contact/contact.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A slab with a second body on it, on a grid of unit cells; both consist of four particles per cell.
struct Bodies {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip, UpdateOrder::usl, false, 40);
  Mat<2> turn;
  System<2> system;
  std::unique_ptr<Transfers<2>> transfers;
  Exchanges<2> exchanges;
  ContactLaws<2> laws;
  std::vector<Body<2>*> bodies;
  ParticleCloud<2> cloud;
  ContactSearch<2> search;
  NodalVolumes<2> volumes;
  FaceFinder<2> finder;

  /// The bodies are turned by `angle`. `lower` and `upper`: curvatures of the upper face of the slab and of the lower
  /// face of the other body, positive if the face is bent upwards; 0: plane [1/length]. The faces touch in their
  /// middle.
  Bodies(double angle, double lower, double upper)
      : turn(Eigen::Rotation2Dd(angle).toRotationMatrix()),
        system(build(lower, upper)),
        transfers(make_transfers<2>(model.scheme)),
        laws(model, system),
        bodies{&system.bodies[0], &system.bodies[1]},
        cloud(system.lattice, 2.5),
        search(system, laws),
        volumes(system, *transfers),
        finder(model, system, cloud, laws) {
    std::vector<std::int64_t> occupied;
    for (auto& body : system.bodies) {
      REQUIRE(body.bins.sort(system.lattice, body.particles) == -1);
      body.refresh();
      for (const Bin& bin : body.bins.list()) occupied.push_back(bin.block);
    }
    for (auto& field : system.fields) {
      field.map.rebuild(occupied);
      field.nodes.assign(static_cast<std::size_t>(field.map.node_count()), Node{});
      exchanges.push_back(make_exchange<2>(model.grid, system.lattice));
      exchanges.back()->locate(field.map);
    }
    search.locate();
  }

  System<2> build(double lower, double upper) {
    model.materials.push_back(model.materials.front());
    model.contact.active = true;
    model.contact.default_law = make_law("61", {{"coeff", "0.3"}});
    std::vector<Seed> seeds;
    // The domains are turned so that their sides are parallel to the curved face.
    const auto add = [&](double x, double height, double curvature, int material) {
      Mat<2> axes;
      axes << 1, -curvature * x, curvature * x, 1;
      axes /= axes.col(0).norm();
      Seed s;
      s.x.head<2>() = Vec<2>(20.2, 20.15) + turn * (Vec<2>(x, 0.5 * curvature * x * x) + height * axes.col(1));
      s.half_size.head<2>().setConstant(0.25);
      s.F.topLeftCorner<2, 2>() = turn * axes;
      s.volume = 0.25, s.mass = 250, s.material = material;
      seeds.push_back(s);
    };
    for (double x = -11.75; x < 12; x += 0.5)
      for (double height = -5.75; height < 0; height += 0.5) add(x, height, lower, 0);
    for (double x = -7.75; x < 8; x += 0.5)
      for (double height = 0.25; height < 4; height += 0.5) add(x, height, upper, 1);
    return build_system<2>(model, seeds);
  }

  /// Moves the second body along and across the face of the slab, in cells.
  void move(double along, double across) {
    const Vec<2> by = turn * Vec<2>(along, across);
    auto& particles = system.bodies[1].particles;
    for (std::size_t d = 0; d < 2; ++d)
      for (std::size_t i = 0; i < particles.size(); ++i) particles.x()[d][i] += by[static_cast<Eigen::Index>(d)];
  }

  /// Finds the contact nodes of the present positions.
  void find_nodes() {
    for (auto& field : system.fields) std::fill(field.nodes.begin(), field.nodes.end(), Node{});
    for (auto& body : system.bodies)
      transfers->scatter(body, Target<2>(body, system.fields, &Field<2>::nodes), Scatter::momentum, false, false);
    search.find(exchanges);
  }

  /// Finds the faces of the pairs that need them.
  void find_faces(ContactNodes<2>& contacts, FaceCache<2>& cache) {
    cloud.clear();
    for (const auto& node : contacts.nodes)
      if (node.needs_faces) cloud.request(node.index);
    cloud.collect(bodies);
    volumes.scatter(contacts, bodies, exchanges);
    NearParticles<2> near;
    for (const auto& node : contacts.nodes)
      for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
        if (!contacts.pairs[p].needs_face) continue;
        ContactFace& face = cache.new_face(p);
        if (finder.find(node, contacts.members, contacts.pairs[p], face, near) && cache.enabled())
          cache.store(face, contacts.pairs[p], near);
      }
    cache.end_search(cloud);
  }
};

/// The largest differences between faces that were kept and faces that were found, and numbers of faces [cells].
struct Difference {
  double normal = 0.0, gap = 0.0, area = 0.0;
  std::size_t kept = 0, compared = 0, turned = 0, apart = 0;  ///< turned: normals that differ by more than 1e-3
  int searches = 0;                                           ///< in which most faces were found
};

template <class F>
void each_pair(const ContactNodes<2>& contacts, F&& f) {
  for (const auto& node : contacts.nodes)
    for (const ContactPair& pair : contacts.pairs_of(node)) f(pair);
}

/// Slides the second body by `steps` steps of 0.002 cells along the face and 1e-5 cells away from it. Only nodes at
/// most `half_width` from its middle are compared.
Difference slide(double angle, double lower, double upper, int steps, double half_width) {
  Bodies b(angle, lower, upper);
  FaceCache<2> cache(b.system, true), none(b.system, false);
  constexpr double step = 0.002;
  Difference worst;
  for (int k = 0; k < steps; ++k) {
    b.find_nodes();
    auto& contacts = b.search.found();
    ContactNodes<2> fresh = contacts;
    cache.reuse(contacts, b.bodies);
    std::size_t found = 0, all = 0;
    each_pair(contacts, [&](const ContactPair& pair) { ++all, found += pair.needs_face ? 1 : 0; });
    worst.kept += all - found, worst.searches += 2 * found > all ? 1 : 0;
    b.find_faces(contacts, cache);
    none.reuse(fresh, b.bodies);
    b.find_faces(fresh, none);
    REQUIRE(fresh.pairs.size() == contacts.pairs.size());
    const Vec<2> middle = Vec<2>(20.2, 20.15) + b.turn * Vec<2>(k * step, 0);
    for (const auto& node : contacts.nodes) {
      const Vec<2> x = b.turn.transpose() * (b.system.lattice.position(node.index) - middle);
      if (std::abs(x[0]) > half_width) continue;
      REQUIRE(node.end_pair == node.first_pair + 1);
      const ContactPair &kept = contacts.pairs[node.first_pair], &found = fresh.pairs[node.first_pair];
      REQUIRE(kept.has_no_face == found.has_no_face);
      if (found.has_no_face) continue;
      ++worst.compared;
      if (kept.apart) {  // and its gap at least this
        REQUIRE(kept.state.gap > 0.1);
        REQUIRE(kept.state.gap < found.state.gap + 1e-12);
        ++worst.apart;
        continue;
      }
      worst.gap = std::max(worst.gap, std::abs(kept.state.gap - found.state.gap));
      if (found.state.gap > 0.1) continue;  // no force acts, so that the face may be older
      const double turn = (kept.state.normal - found.state.normal).norm();
      worst.normal = std::max(worst.normal, turn), worst.turned += turn > 1e-3 ? 1 : 0;
      worst.area = std::max(worst.area, std::abs(kept.state.area - found.state.area));
    }
    b.move(step, 1e-5);
    cache.add_travel({0.0, step});
  }
  return worst;
}

}  // namespace

TEST_CASE("kept faces of flat bodies equal those found from all particles", "[contact][faces]") {
  for (const double degrees : {0.0, 17.0, 45.0}) {
    INFO(degrees << " degrees");
    const Difference d = slide(degrees * pi / 180, 0.0, 0.0, 120, 5.0);
    CHECK(d.compared > 1000);
    CHECK(d.kept > 1000);    // they were kept
    CHECK(d.searches <= 4);  // after every 0.2 cells or fewer
    CHECK(d.normal < 1e-7);
    CHECK(d.gap < 1e-7);
    CHECK(d.area < 0.03);  // as the particles move against the nodes, it varies by 2 % of a cell
  }
}

TEST_CASE("kept faces of curved bodies are those found from all particles within their travel", "[contact][faces]") {
  std::size_t apart = 0;
  // two convex faces; a convex face in a concave one, whose gaps are corrected; a convex face on a plane one
  for (const auto& [lower, upper] : {std::pair{-0.05, 0.05}, {0.04, 0.05}, {0.0, 0.1}}) {
    INFO("curvatures " << lower << ", " << upper);
    const Difference d = slide(0.0, lower, upper, 40, 3.0);
    CHECK(d.compared > 100);
    CHECK(d.kept > 100);
    apart += d.apart;
    // The sides of neighbouring particles differ in direction by their size times the curvature. Where the foremost
    // side changes, the normal of a found face jumps by that angle at once, that of a kept face within its travel.
    const double jump = 0.5 * (std::abs(lower) + std::abs(upper));
    CHECK(d.normal < jump);
    CHECK(d.turned < d.compared / 20);
    CHECK(d.gap < 1e-3);
    CHECK(d.area < 5e-3);
  }
  CHECK(apart > 10);
}

TEST_CASE("faces that are apart are kept until they may have come near each other", "[contact][faces]") {
  // Of faces `apart` cells, how many are found anew after the upper body has travelled [cells]
  const auto found_after = [](double apart, double travel) {
    Bodies b(0.0, 0.0, 0.1);
    b.move(0.0, apart);
    FaceCache<2> cache(b.system, true);
    const auto count = [&] {
      b.find_nodes();
      auto& contacts = b.search.found();
      cache.reuse(contacts, b.bodies);
      int needed = 0;
      each_pair(contacts, [&](const ContactPair& pair) { needed += pair.needs_face ? 1 : 0; });
      b.find_faces(contacts, cache);
      return needed;
    };
    CHECK(count() > 5);
    CHECK(count() == 0);  // nothing has moved
    cache.add_travel({0.0, travel});
    return count();
  };
  CHECK(found_after(0.0, 0.005) == 0);
  CHECK(found_after(0.0, 0.011) > 0);
  CHECK(found_after(0.12, 0.011) > 0);
  CHECK(found_after(0.25, 0.05) == 0);  // two particles that move by 0.05 cells approach each other by 0.1
  CHECK(found_after(0.25, 0.101) > 0);
  CHECK(found_after(0.55, 0.19) == 0);
  CHECK(found_after(0.55, 0.201) > 0);
}

TEST_CASE("contact faces are the same for any number of threads", "[contact][faces][threads]") {
  struct Face {
    Vec3 normal;
    double gap, area;
    bool operator==(const Face& o) const { return normal == o.normal && gap == o.gap && area == o.area; }
  };
  Bodies b(17 * pi / 180, 0.0, 0.05);
  b.find_nodes();  // sets the nodal masses
  Cracks<2> cracks(b.model, b.system, *b.transfers);
  const Joints<2> joints(b.model, b.system, cracks);
  const auto faces = [&](int count) {
    set_threads(count);
    Contact<2> contact(b.model, b.system, *b.transfers, cracks);
    contact.locate();
    contact.find(b.exchanges, joints);
    set_threads(1);
    std::vector<Face> out;
    for (const auto& node : contact.nodes())
      contact.each_closed_pair(node, [&](const ContactPair& pair, const auto&, const auto&) {
        out.push_back({pair.state.normal, pair.state.gap, pair.state.area});
      });
    return out;
  };
  const auto one = faces(1);
  CHECK(one.size() > 2);
  CHECK(one == faces(3));
  CHECK(one == faces(300));  // more threads than nodes
}
