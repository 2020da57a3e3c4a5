// SPDX-License-Identifier: MIT
#include "material_point.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

const Properties wood{{"rho", "500"}, {"Ex", "12"},   {"Ey", "0.9"},   {"Ez", "0.5"},   {"Gxy", "0.8"},
                      {"Gyz", "0.1"}, {"Gxz", "0.7"}, {"nuxy", "0.4"}, {"nuyz", "0.5"}, {"nuxz", "0.45"}};
const Properties fibre{{"rho", "1600"}, {"EA", "10"}, {"ET", "1"}, {"GA", "0.6"}, {"nuA", "0.3"}, {"nuT", "0.4"}};

// The law with its axes turned by `angle`, in a body that is deformed by F.
Mat3 stress(const Material& law, const Mat3& F, double angle = 0.0) {
  MaterialPoint<3> point(law);
  point.history[0] = angle;
  point.deform(F);
  return point.stress;
}

Mat3 rotation(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

Mat3 some_deformation() {
  Mat3 F;
  F << 1.02, 0.03, -0.01, 0.01, 0.98, 0.02, 0.015, -0.02, 1.01;
  return F;
}

}  // namespace

TEST_CASE("an orthotropic bar stretched along an axis contracts by its Poisson's ratios", "[materials]") {
  const auto law = make_material("4", wood);
  // S_xx = Ex E_xx and E_yy = -nu_xy E_xx, E_zz = -nu_xz E_xx leave the sides free
  const double stretch = 1.05, E = 0.5 * (stretch * stretch - 1), y = std::sqrt(1 - 2 * 0.4 * E),
               z = std::sqrt(1 - 2 * 0.45 * E);
  const Mat3 s = stress(*law, Vec3(stretch, y, z).asDiagonal());
  CHECK(s(0, 0) == Approx(12 * E * stretch / (y * z)).epsilon(1e-12));
  CHECK(std::abs(s(1, 1)) < 1e-13);
  CHECK(std::abs(s(2, 2)) < 1e-13);
}

TEST_CASE("each shear has its own modulus", "[materials]") {
  const auto law = make_material("Orthotropic", wood);
  for (const auto& [i, j, G] : {std::tuple{0, 1, 0.8}, std::tuple{1, 2, 0.1}, std::tuple{0, 2, 0.7}}) {
    Mat3 F = Mat3::Identity();
    F(i, j) = F(j, i) = 1e-7;
    CHECK(stress(*law, F)(i, j) == Approx(2e-7 * G).epsilon(1e-6));
  }
}

TEST_CASE("Poisson's ratios may be given for the other direction, and letters of the axisymmetric axes",
          "[materials]") {
  Properties other{{"rho", "500"}, {"ER", "12"},   {"EZ", "0.9"}, {"ET", "0.5"},
                   {"Gyx", "0.8"}, {"Gzy", "0.1"}, {"Gzx", "0.7"}};
  other.emplace_back("nuyx", std::to_string(0.4 * 0.9 / 12));
  other.emplace_back("nuyz", "0.5");
  other.emplace_back("nuzx", "0.01875");
  const Mat3 F = some_deformation();
  CHECK((stress(*make_material("4", wood), F) - stress(*make_material("4", other), F)).norm() < 1e-13);
}

TEST_CASE("the stress of an orthotropic solid turns with body and axes", "[materials]") {
  const auto law = make_material("4", wood);
  const Mat3 F = some_deformation(), at_rest = stress(*law, F, 0.3);
  const Mat3 R = rotation(2.0, Vec3(1, 2, 3));
  CHECK((stress(*law, R * F, 0.3) - R * at_rest * R.transpose()).norm() < 1e-13);
  // turning the material before the body is deformed: axes at an angle, or the body turned with them
  const Mat3 Q = rotation(0.3, Vec3::UnitZ());
  CHECK((stress(*law, F * Q, 0.0) - at_rest).norm() < 1e-13);
  CHECK((stress(*law, F, 0.0) - at_rest).norm() > 1e-3);
}

TEST_CASE("equal moduli make an orthotropic solid isotropic", "[materials]") {
  const Properties same{{"rho", "1"}, {"Ex", "10"}, {"Ey", "10"},     {"Ez", "10"},     {"Gxy", "4"},
                        {"Gyz", "4"}, {"Gxz", "4"}, {"nuxy", "0.25"}, {"nuyz", "0.25"}, {"nuxz", "0.25"}};
  const auto law = make_material("4", same);
  const Mat3 F = some_deformation(), E = 0.5 * (F.transpose() * F - Mat3::Identity());
  const Mat3 S = 4 * E.trace() * Mat3::Identity() + 8 * E;
  CHECK((stress(*law, F, 0.7) - F * S * F.transpose() / F.determinant()).norm() < 1e-13);
  CHECK(law->wave_modulus() == Approx(12).epsilon(1e-12));
}

TEST_CASE("the energy of an orthotropic solid is the work done on it, and none in a closed cycle", "[materials]") {
  const auto law = make_material("4", wood);
  MaterialPoint<3> point(*law);
  point.history[0] = 0.4;
  Mat3 L;
  L << 0.02, 0.05, 0, -0.01, -0.03, 0.02, 0.04, 0, 0.01;
  for (int k = 0; k < 1000; ++k) point.step(L, 1e-3);
  CHECK(point.stored_energy() == Approx(point.work).epsilon(1e-6));
  for (int k = 0; k < 1000; ++k) point.step(-L, 1e-3);
  CHECK(point.stress.norm() < 1e-11);
  CHECK(std::abs(point.work) < 1e-12);
}

TEST_CASE("the axis of a transversely isotropic solid is z or y", "[materials]") {
  const auto along_z = make_material("2", fibre), along_y = make_material("Transverse2", fibre);
  const auto young = [](const Material& law, int axis) {
    // from the stress of a small stretch without lateral strain, by inverting the stiffness of normal strains
    Mat3 C;
    for (int k = 0; k < 3; ++k) {
      Mat3 F = Mat3::Identity();
      F(k, k) += 1e-8;
      C.col(k) = stress(law, F).diagonal() / 1e-8;
    }
    return 1 / C.inverse()(axis, axis);
  };
  CHECK(young(*along_z, 2) == Approx(10).epsilon(1e-6));
  CHECK(young(*along_z, 0) == Approx(1).epsilon(1e-6));
  CHECK(young(*along_y, 1) == Approx(10).epsilon(1e-6));
  CHECK(young(*along_y, 2) == Approx(1).epsilon(1e-6));
  // isotropic across the axis: turning about it changes nothing
  const Mat3 F = some_deformation();
  CHECK((stress(*along_z, F, 0.8) - stress(*along_z, F)).norm() < 1e-13);
  CHECK((stress(*along_y, F, 0.8) - stress(*along_y, F)).norm() > 1e-4);
  // the same solid in other axes
  const Mat3 swap = rotation(std::acos(0.0), Vec3::UnitX());
  CHECK((stress(*along_y, F) - swap * stress(*along_z, swap.transpose() * F * swap) * swap.transpose()).norm() < 1e-13);
  CHECK(along_z->wave_modulus() >= 10);
  CHECK(along_z->wave_modulus() < 11.5);
}

TEST_CASE("no wave is faster than the wave modulus of an orthotropic solid", "[materials]") {
  const auto law = make_material("4", wood);
  for (const double stretch : {0.9, 1.0, 1.1}) {
    MaterialPoint<3> point(*law);
    const Mat3 F = Vec3(stretch, 1.0, 2 - stretch).asDiagonal();
    point.deform(F);
    // rho_0 c^2 along x by a difference quotient of the first Piola-Kirchhoff stress
    const double d = 1e-6;
    const auto piola = [&](double more) {
      const Mat3 G = F + more * Vec3::UnitX() * Vec3::UnitX().transpose();
      return (G.determinant() * stress(*law, G) * G.inverse().transpose())(0, 0);
    };
    const double speed = stretch * stretch * (piola(d) - piola(-d)) / (2 * d);
    CHECK(speed <= point.wave_modulus() * (1 + 1e-9));
  }
}

TEST_CASE("impossible or doubled constants of an orthotropic solid are refused", "[materials]") {
  const auto with = [](const char* name, const char* value) {
    Properties p = wood;
    for (auto& [key, text] : p)
      if (key == name) text = value;
    return p;
  };
  CHECK_THROWS_WITH(make_material("4", with("nuxy", "3.7")), Catch::Contains("would not store positive energy"));
  Properties both = wood;
  both.emplace_back("nuyx", "0.03");
  CHECK_THROWS_WITH(make_material("4", both), Catch::Contains("only one of them"));
  Properties none = wood;
  none.pop_back();
  CHECK_THROWS_WITH(make_material("4", none), Catch::Contains("<nuxz> or <nuzx>"));
  Properties squeezed = fibre;
  squeezed[4].second = "3.0";
  CHECK_THROWS_WITH(make_material("2", squeezed), Catch::Contains("would not store positive energy"));
}
