// SPDX-License-Identifier: MIT
/// Networks of springs over Voronoi cells as elastic bodies: Bolander and Saito, Eng. Fract. Mech. 61 (1998) 569-591;
/// fictitious stress: Asahina et al., Int. J. Rock Mech. Min. Sci. 75 (2015) 189-201.

#include "blocks/block_cases.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr double E = 50e9;

/// A periodic body of Voronoi cells that is strained as a whole.
class Periodic {
 public:
  Periodic(std::size_t cells, bool plane, std::shared_ptr<const JointLaw> law, bool plane_stress = true,
           std::vector<Vec3> references = {})
      : nuclei_(scattered(cells, Vec3::Ones(), plane, plane ? 0.6 / std::sqrt(cells) : 0.6 / std::cbrt(cells))),
        cells_(voronoi(nuclei_, Vec3::Zero(), plane ? Vec3(1, 1, 0) : Vec3(1, 1, 1), plane, 1.0, {true, true, !plane})),
        body_(cells_, references.empty() ? nuclei_ : references, std::move(law), plane, plane_stress, 1.0, 0) {
    for (auto& b : body_.bodies) b.held = 63;
  }

  /// Strains it, then iterates the fictitious stress to convergence. The strain is so small that the shape stays.
  Mat3 stress(const Mat3& strain, int settle) {
    constexpr double tiny = 1e-13;
    for (std::size_t k = 0; k < body_.bodies.size(); ++k) body_.motion[k].v = tiny * strain * nuclei_[k];
    body_.box_rate = tiny * strain;
    body_.advance(1.0);
    body_.box_rate.setZero();
    for (auto& m : body_.motion) m.v.setZero();
    for (int k = 0; k < settle; ++k) body_.advance(1.0);
    return body_.mean_stress() / tiny;
  }
  /// Largest deviation of a block's stress from the mean.
  double scatter() const {
    const Mat3 mean = body_.mean_stress();
    double most = 0;
    for (std::size_t k = 0; k < body_.block_count(); ++k)
      most = std::max(most, (body_.stress_of(k) - mean).cwiseAbs().maxCoeff());
    return most / mean.cwiseAbs().maxCoeff();
  }
  const Tessellation& cells() const { return cells_; }
  const std::vector<Vec3>& nuclei() const { return nuclei_; }
  Assembly& body() { return body_; }

 private:
  std::vector<Vec3> nuclei_;
  Tessellation cells_;
  Assembly body_;
};

Mat3 strain(double xx, double yy, double zz, double xy) {
  Mat3 e;
  e << xx, xy, 0, xy, yy, 0, 0, 0, zz;
  return e;
}

}  // namespace

TEST_CASE("Voronoi cells fill a periodic box, and A n (x_j - x_i) sums to its volume", "[blocks]") {
  for (const bool plane : {true, false}) {
    Periodic net(plane ? 60 : 16, plane, elastic_bonds(E, 0.0));
    double volume = 0;
    for (std::size_t k = 0; k < net.body().block_count(); ++k) volume += net.body().bodies[k].volume;
    Mat3 sum = Mat3::Zero();
    for (const BlockFacet& f : net.cells().facets)
      sum += f.geometry.area * f.geometry.normal *
             (net.nuclei()[static_cast<std::size_t>(f.b)] + f.shift - net.nuclei()[static_cast<std::size_t>(f.a)])
                 .transpose();
    CHECK(std::abs(volume - 1) < 1e-12);
    const Mat3 unit = plane ? Mat3(Vec3(1, 1, 0).asDiagonal()) : Mat3(Mat3::Identity());
    CHECK((sum - unit).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("springs E/d over Voronoi cells are an elastic body without transverse contraction", "[blocks]") {
  for (const bool plane : {true, false})
    for (const Mat3& e : {strain(1e-4, 0, 0, 0), strain(0, 0, 0, 0.5e-4)}) {
      Periodic net(plane ? 60 : 16, plane, elastic_bonds(E, 0.0));
      const Mat3 s = net.stress(e, 0);
      CHECK((s - E * e).cwiseAbs().maxCoeff() < 1e-13 * E * 1e-4);
      CHECK(net.scatter() < 1e-13);
    }
}

TEST_CASE("distances between centres of mass in place of nuclei disturb the stress", "[blocks]") {
  std::vector<Vec3> centres;
  {
    const Periodic exact(60, true, elastic_bonds(E, 0.0));
    for (const auto& s : exact.cells().shapes) centres.push_back(mass_properties(s, true, 1.0).centre);
  }
  Periodic net(60, true, elastic_bonds(E, 0.0), true, centres);
  const Mat3 s = net.stress(strain(1e-4, 0, 0, 0), 0);
  CHECK(std::abs(s(0, 0) / (E * 1e-4) - 1) < 0.02);
  CHECK(net.scatter() > 1e-3);
}

TEST_CASE("the fictitious stress gives the constants of an isotropic body", "[blocks]") {
  constexpr double nu = 0.25;
  const auto constants = [&](bool plane, bool plane_stress, double off_diagonal) {
    Periodic stretched(plane ? 60 : 16, plane, elastic_bonds(E, nu, off_diagonal), plane_stress);
    const Mat3 s = stretched.stress(strain(1e-4, 0, 0, 0), 60);
    if (off_diagonal > 0) CHECK(stretched.scatter() < 1e-13);
    Periodic sheared(plane ? 60 : 16, plane, elastic_bonds(E, nu, off_diagonal), plane_stress);
    const Mat3 t = sheared.stress(strain(0, 0, 0, 0.5e-4), 60);
    return Vec3(Vec3(s(0, 0), s(1, 1), t(0, 1)) / 1e-4);
  };
  const auto close = [](const Vec3& c, double c11, double c12, double g, double tolerance) {
    CHECK(std::abs(c[0] / c11 - 1) < tolerance);
    CHECK(std::abs(c[1] / c12 - 1) < 4 * tolerance);
    CHECK(std::abs(c[2] / g - 1) < tolerance);
  };
  close(constants(true, true, 1.0), E / (1 - nu * nu), nu * E / (1 - nu * nu), 20e9, 1e-12);
  close(constants(true, false, 1.0), 60e9, 20e9, 20e9, 1e-12);
  close(constants(false, false, 1.0), 60e9, 20e9, 20e9, 1e-12);
  CHECK(constants(true, true, 0.0)[2] == Approx(25e9).epsilon(1e-9));
}

TEST_CASE("the fictitious stress is objective with its off-diagonal part only", "[blocks]") {
  constexpr double nu = 0.25, angle = 30 * 3.14159265358979323846 / 180;
  Mat3 Q = Mat3::Identity();
  Q << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  const Mat3 pull = Q * strain(1e6 / E, -nu * 1e6 / E, 0, 0) * Q.transpose();
  for (const double off_diagonal : {1.0, 0.0}) {
    Periodic net(60, true, elastic_bonds(E, nu, off_diagonal));
    const Mat3 s = Q.transpose() * net.stress(pull, 60) * Q;
    if (off_diagonal > 0) {
      CHECK((s - strain(1e6, 0, 0, 0)).cwiseAbs().maxCoeff() < 1e-2);
    } else {
      CHECK(s(0, 0) == Approx(1.09375e6).epsilon(0.01));
      CHECK(s(1, 1) == Approx(-0.09375e6).epsilon(0.05));
      CHECK(s(0, 1) == Approx(0.054127e6).epsilon(0.05));
    }
  }
}
