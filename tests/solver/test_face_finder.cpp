// SPDX-License-Identifier: MIT
/// Normals and gaps at a node from given volumes, means and volume gradients of two bodies.

#include "cloud.hpp"
#include "solver/contact/face_finder.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

/// Two velocity fields at one node of a grid of 16 x 16 cells.
struct FaceAtNode {
  Model model;
  System<2> system;
  std::shared_ptr<const ContactLaw> law = make_law("CoulombFriction", {});
  std::array<double, 2> inverse_mass{1.0, 1.0};
  std::array<VolumeNode, 2> volumes{};  ///< of the two fields at the node
  int mirrored_axes = 0;
  ContactPair pair;
  static inline const Index<2> at{Lattice<2>::padding + 8, Lattice<2>::padding + 8};

  explicit FaceAtNode(const Vec<2>& cell = Vec<2>(1, 1)) : system(Lattice<2>(Vec<2>(0, 0), 16 * cell, {16, 16})) {
    for (std::size_t f = 0; f < 2; ++f) system.fields.emplace_back(system.lattice);
  }
  /// Two bodies of the same particles in the cells 6 to 10, the second one rigid.
  explicit FaceAtNode(const std::vector<Seed>& seeds, const Model& of)
      : model(of), system(build_system<2>(model, seeds)) {
    for (auto* list : {&system.bodies, &system.rigids})
      for (auto& body : *list) {
        REQUIRE(body.bins.sort(system.lattice, body.particles) == -1);
        bodies.push_back(&body);
      }
    inverse_mass[1] = 0.0;
  }

  void set(std::size_t f, double v, const Vec<2>& mean, const Vec<2>& gradient) {
    volumes[f] = {v, {v * mean[0], v * mean[1], 0.0}, 0.0, {gradient[0], gradient[1], 0.0}};
  }
  Vec<2> position() const { return system.lattice.position(at); }
  /// Whether there is a face; its normal and gap are then those of `pair`.
  bool find() {
    const double h = system.lattice.spacing.maxCoeff();
    ParticleCloud<2> cloud(system.lattice, 2.5 * h);
    cloud.clear(), cloud.request(at), cloud.collect(bodies);
    const ContactLaws<2> laws(model, system);
    const FaceFinder<2> finder(model, system, cloud, laws);
    ContactNode<2> node;
    node.index = at, node.mirrored_axes = mirrored_axes;
    std::array<ContactMember, 2> members;
    for (std::size_t f = 0; f < 2; ++f) {
      members[f].field = f, members[f].volumes = &volumes[f];
      members[f].mass = 1.0, members[f].inverse_mass = inverse_mass[f];
    }
    ContactFace face;
    NearParticles<2> near;
    pair = {};
    pair.a = 0, pair.b = 1, pair.law = law.get();
    const bool found = finder.find(node, members, pair, face, near);
    CHECK(pair.has_no_face == !found);
    return found;
  }
  Vec<2> normal() {
    REQUIRE(find());
    return pair.state.normal.head<2>();
  }
  double gap() {
    REQUIRE(find());
    return pair.state.gap;
  }

 private:
  std::vector<Body<2>*> bodies;
};

void specify(Model& model, Separation separation, double position = 0.8) {
  model.contact.normals = NormalMethod::specified, model.contact.direction = Vec3(0.6, 0.8, 0);
  model.contact.separation = separation, model.contact.position = position;
}

}  // namespace

TEST_CASE("the gap by displacements is their difference along the normal", "[contact][faces]") {
  FaceAtNode face(Vec<2>(1, 0.5));
  specify(face.model, Separation::displacements);
  face.set(0, 2, {0.02, -0.01}, {}), face.set(1, 0.5, {0.05, 0.07}, {});
  CHECK(face.gap() == Approx(0.6 * 0.03 + 0.8 * 0.08).epsilon(1e-13));
  face.set(1, 0.5, {-0.05, 0.01}, {});
  CHECK(face.gap() == Approx(-0.6 * 0.07 + 0.8 * 0.02).epsilon(1e-13));
}

TEST_CASE("the gap by positions is their distance less a share of the cell along the normal", "[contact][faces]") {
  for (const Vec<2>& cell : {Vec<2>(1, 1), Vec<2>(1, 0.5), Vec<2>(0.25, 1)}) {
    FaceAtNode face(cell);
    specify(face.model, Separation::positions);
    const Vec<2> x = face.position();
    face.set(0, 2, x + Vec<2>(-0.3, -0.2), {}), face.set(1, 0.5, x + Vec<2>(0.1, 0.4), {});
    const double across = std::hypot(0.6 * cell[0], 0.8 * cell[1]);
    CHECK(face.gap() == Approx(0.6 * 0.4 + 0.8 * 0.6 - 0.8 * across).epsilon(1e-12));
    face.model.contact.position = 1.1;
    CHECK(face.gap() == Approx(0.6 * 0.4 + 0.8 * 0.6 - 1.1 * across).epsilon(1e-12));
    // along an axis it is the edge of the cell
    face.model.contact.direction = Vec3(0, 1, 0);
    CHECK(face.gap() == Approx(0.6 - 1.1 * cell[1]).epsilon(1e-12));
  }
}

TEST_CASE("the gap by positions may follow a power law", "[contact][faces]") {
  for (const Vec<2>& cell : {Vec<2>(1, 1), Vec<2>(1, 0.5)}) {
    FaceAtNode face(cell);
    const double q = 0.58, across = std::hypot(0.6 * cell[0], 0.8 * cell[1]), reach = 1.25 * across;
    specify(face.model, Separation::positions, -q);
    const Vec<2> x = face.position(), n(0.6, 0.8), along(-0.8, 0.6);
    const auto gap = [&](double ea, double eb) {  // distances along the normal in 1.25 cells
      face.set(0, 2, x + ea * reach * n + 0.3 * along, {}), face.set(1, 0.5, x + eb * reach * n - 0.1 * along, {});
      return face.gap();
    };
    CHECK(gap(-0.3, 0.4) == Approx(across * (2 * std::pow(0.4, q) + 2 * std::pow(0.3, q) - 2)).epsilon(1e-11));
    CHECK(gap(0.1, 0.5) == Approx(across * 2 * (std::pow(0.5, q) - std::pow(0.1, q))).epsilon(1e-11));
    const double touch = std::pow(0.5, 1 / q);
    CHECK(gap(-touch, touch) == Approx(0).margin(1e-12));
    CHECK(gap(-touch - 0.01, touch) > 0);
  }
}

TEST_CASE("each method takes its normal from the volume gradients", "[contact][faces]") {
  FaceAtNode face;
  face.model.contact.separation = Separation::displacements;
  const Vec<2> steep(1.6, 1.2), flat(-0.6, -0.8);  // magnitudes 2 and 1
  const auto normal = [&](NormalMethod method, bool steep_first, double va, double vb) {
    face.set(0, va, {}, steep_first ? steep : flat), face.set(1, vb, {}, steep_first ? flat : steep);
    face.model.contact.normals = method;
    return face.normal();
  };
  const auto is = [](const Vec<2>& got, const Vec<2>& expected) {
    CHECK((got - expected.normalized()).norm() < 1e-14);
  };
  is(normal(NormalMethod::steepest, true, 1, 3), steep);
  is(normal(NormalMethod::steepest, false, 3, 1), -steep);
  is(normal(NormalMethod::largest, true, 1, 3), -flat);
  is(normal(NormalMethod::largest, true, 3, 1), steep);
  is(normal(NormalMethod::largest, false, 3, 1), flat);
  is(normal(NormalMethod::average, true, 1, 3), steep - flat);
  is(normal(NormalMethod::average, false, 1, 3), flat - steep);
  // one normal for the pair, so that the impulses on both sides are equal and opposite
  is(normal(NormalMethod::own, true, 1, 3), steep);
  is(normal(NormalMethod::own, false, 3, 1), flat);
}

TEST_CASE("a specified normal points from the lower to the higher field, and into a rigid body", "[contact][faces]") {
  FaceAtNode face;
  specify(face.model, Separation::displacements);
  face.set(0, 1, {}, {}), face.set(1, 1, {}, {});
  const Vec<2> n(0.6, 0.8);
  CHECK((face.normal() - n).norm() < 1e-14);
  face.inverse_mass = {1, 0};
  CHECK((face.normal() - n).norm() < 1e-14);
  face.inverse_mass = {0, 1};
  CHECK((face.normal() + n).norm() < 1e-14);
}

TEST_CASE("normals have no component along the normals of symmetry planes", "[contact][faces]") {
  FaceAtNode face;
  specify(face.model, Separation::displacements);
  face.set(0, 1, {0, 0}, {}), face.set(1, 1, {0.3, 0.1}, {});
  face.mirrored_axes = 1;
  CHECK((face.normal() - Vec<2>(0, 1)).norm() < 1e-14);
  CHECK(face.gap() == Approx(0.1));
  face.mirrored_axes = 2;
  CHECK((face.normal() - Vec<2>(1, 0)).norm() < 1e-14);
  face.mirrored_axes = 3;
  CHECK_FALSE(face.find());
}

TEST_CASE("RigidBias weighs the gradient of a rigid body where no plane parts it from the other one",
          "[contact][faces]") {
  Model model = grid_model<2>(Kernel::quadratic_spline, Transfer::flip, UpdateOrder::usl, false, 16);
  add_rigid_tool(model, "0", "0");
  model.contact.separation = Separation::displacements;
  const auto in_place = [&](bool apart) {
    auto seeds = lattice_seeds<2>(model, 6, 10);
    for (Seed seed : lattice_seeds<2>(model, 6, 10)) {
      seed.material = 1;
      if (apart) seed.x[0] += 4;
      seeds.push_back(seed);
    }
    if (apart)
      for (Seed& seed : seeds) seed.x[0] -= 2;
    return seeds;
  };
  const Vec<2> ga(2, 0), gb(0, 1);
  for (const bool apart : {false, true})
    for (const double bias : {0.5, 1.0, 3.0}) {
      INFO("bias " << bias << (apart ? ", apart" : ", overlap"));
      FaceAtNode face(in_place(apart), model);
      face.set(0, 2, {}, ga), face.set(1, 1, {}, gb);
      face.model.contact.rigid_bias = bias;
      const auto normal = [&](NormalMethod method) {
        face.model.contact.normals = method;
        return face.normal();
      };
      for (const auto& [method, expected] : {std::pair<NormalMethod, Vec<2>>{NormalMethod::average, ga - bias * gb},
                                             {NormalMethod::margin, ga - bias * gb},
                                             {NormalMethod::steepest, bias > 2 ? Vec<2>(-gb) : ga},
                                             {NormalMethod::largest, bias > 2 ? Vec<2>(-gb) : ga}})
        CHECK((normal(method) - (apart ? Vec<2>(1, 0) : Vec<2>(expected.normalized()))).norm() < 1e-7);
    }
}
