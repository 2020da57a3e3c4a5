// SPDX-License-Identifier: MIT
// Batches of any size do what their points would do alone.

#include "material_point.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

std::vector<std::pair<std::string, Properties>> laws() {
  const Properties soil{{"rho", "1"},       {"E", "1e3"},       {"nu", "0.3"},   {"cohesion", "3"},
                        {"friction", "30"}, {"dilation", "10"}, {"tension", "2"}};
  Properties soft = soil;
  soft.insert(soft.end(), {{"cohesion_residual", "1"}, {"softening_end", "0.05"}, {"relaxation_time", "0.3"}});
  return {{"LinearElastic", {{"rho", "1"}, {"E", "1e3"}, {"nu", "0.3"}}},
          {"NeoHookean", {{"rho", "1"}, {"E", "1e3"}, {"nu", "0.3"}}},
          {"MooneyRivlin", {{"rho", "1"}, {"E", "1e3"}, {"nu", "0.3"}, {"G2", "100"}, {"UJOption", "2"}}},
          {"MohrCoulomb", soil},
          {"MohrCoulomb", soft}};
}

template <int Dim>
void check(const std::string& type, const Properties& properties, int count, bool plane_stress, double spin) {
  const auto law = make_material(type, properties);
  const auto n = static_cast<std::size_t>(count);
  std::vector<MaterialPoint<Dim>> alone(n, MaterialPoint<Dim>(*law, plane_stress));
  std::vector<std::vector<double>> L(Layout<Dim>::full, std::vector<double>(n)), F = L;
  std::vector<std::vector<double>> stress(Layout<Dim>::symmetric, std::vector<double>(n));
  std::vector<std::vector<double>> history(law->history().size(), std::vector<double>(n));
  std::vector<double> volume(n), mass(n, law->density());
  MaterialPoints<Dim> points;
  for (std::size_t k = 0; k < L.size(); ++k) points.L[k] = L[k].data(), points.F[k] = F[k].data();
  for (std::size_t k = 0; k < stress.size(); ++k) points.stress[k] = stress[k].data();
  std::vector<double*> columns;
  for (auto& h : history) columns.push_back(h.data());
  points.count = count, points.dt = 0.7, points.plane_stress = plane_stress;
  points.volume = volume.data(), points.mass = mass.data(), points.history = columns;

  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int step = 0; step < 4; ++step) {
    for (std::size_t i = 0; i < n; ++i) {
      Mat3 gradient = Mat3::Zero();
      for (const auto& [r, c] : Layout<Dim>::full_at) gradient(r, c) = 5e-3 * normal(random);
      if (plane_stress) gradient(2, 2) = 0;
      gradient(0, 1) += spin, gradient(1, 0) -= spin;
      alone[i].step(gradient, points.dt);
      store_full<Dim>(gradient, points.L, static_cast<int>(i));
      // the motion as the engine hands it over: plane stress without the out-of-plane stretch of this step
      Mat3 moved = alone[i].F;
      if (plane_stress) moved(2, 2) /= std::exp(alone[i].L(2, 2) * points.dt);
      store_full<Dim>(moved, points.F, static_cast<int>(i));
      volume[i] = moved.determinant();
    }
    law->update(points);
  }
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    worst = std::max(worst, (load_symmetric<Dim>(points.stress, static_cast<int>(i)) - alone[i].stress).norm());
    for (std::size_t k = 0; k < history.size(); ++k)
      worst = std::max(worst, std::abs(history[k][i] - alone[i].history[k]));
    worst = std::max(worst, std::abs(volume[i] - alone[i].volume));
  }
  INFO(type << " " << Dim << "D, " << count << " points, spin " << spin);
  REQUIRE(worst < 5e-11);  // plane stress is solved to 1e-14 of the modulus, 1.3e3
}

}  // namespace

TEST_CASE("batches of odd sizes equal single points", "[materials]") {
  for (const auto& [type, properties] : laws())
    for (const int count : {1, 3, 17, 127, 128, 129, 300})
      for (const double spin : {0.0, 1.0}) {
        check<2>(type, properties, count, false, spin);
        check<2>(type, properties, count, true, spin);
        check<3>(type, properties, count, false, spin);
      }
}
