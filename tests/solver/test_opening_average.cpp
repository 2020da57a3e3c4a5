// SPDX-License-Identifier: MIT
/// Openings of sand, averaged over the particles of a cell.
#include "cloud.hpp"

#include "material_point.hpp"
#include "solver/opening_average.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace tribo;
using namespace tribo::test;

namespace {

constexpr std::size_t plastic_volume = 1, dissipation = 3, opening = 4;  // columns of MohrCoulomb
constexpr double bulk = 1e6 / (3 * (1 - 2 * 0.3));

std::shared_ptr<const Material> sand(double cohesion = 0) {
  return make_material(
      "MohrCoulomb", {{"rho", "1600"}, {"E", "1e6"}, {"nu", "0.3"}, {"cohesion", text(cohesion)}, {"friction", "30"}});
}

/// A block of sand, each particle with an opening of its own that its deformation contains.
template <int Dim>
System<Dim> loose(const Model& model) {
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 5, 13, 2, 0.2));
  settle(system);
  auto& body = system.bodies[0];
  std::mt19937 random(11);
  std::uniform_real_distribution<double> some(0, 0.1);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double o = some(random);
    body.history_columns[opening][i] = body.history_columns[plastic_volume][i] = o;
    body.particles.volume()[i] *= std::exp(o);
    Mat3 F = Mat3::Identity();
    F.topLeftCorner<Dim, Dim>() *= std::exp(o / Dim);
    store_full<Dim>(F, body.particles.F(), static_cast<int>(i));
  }
  return system;
}

template <int Dim>
Model sand_model(std::shared_ptr<const Material> law = sand()) {
  Model model = grid_model<Dim>(Kernel::quadratic_spline, Transfer::flip);
  model.materials[0].law = std::move(law);
  model.splitting.emplace();  // keeps the deformation gradient
  return model;
}

/// Numbers of the particles by cell.
template <int Dim>
std::map<std::array<int, 3>, std::vector<std::size_t>> by_cell(Body<Dim>& body) {
  std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    std::array<int, 3> cell{};
    for (std::size_t d = 0; d < Dim; ++d) cell[d] = static_cast<int>(std::floor(body.particles.x()[d][i]));
    cells[cell].push_back(i);
  }
  return cells;
}

template <int Dim>
void press(Body<Dim>& body, double pressure) {
  for (std::size_t k = 0; k < 3; ++k) std::fill_n(body.particles.stress()[k], body.particles.size(), -pressure);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the particles of a cell have one opening, and together the volume they had", "[opening]",
                       ((int Dim), Dim), 2, 3) {
  const Model model = sand_model<Dim>();
  auto system = loose<Dim>(model);
  auto& body = system.bodies[0];
  std::vector<double> before(body.particles.volume(), body.particles.volume() + body.particles.size());
  Distribution<Dim> alone(model, system, 1, 3);
  OpeningAverage<Dim>(model, system, alone).apply();
  for (const auto& [cell, numbers] : by_cell(body)) {
    double had = 0, has = 0;
    for (const std::size_t i : numbers) {
      had += before[i], has += body.particles.volume()[i];
      const double o = body.history_columns[opening][i];
      CHECK(o == Approx(body.history_columns[opening][numbers.front()]).epsilon(1e-14));
      CHECK(body.history_columns[plastic_volume][i] == Approx(o).epsilon(1e-13));
      CHECK(body.particles.volume()[i] == Approx(std::exp(o) / std::pow(2.0, Dim)).epsilon(1e-13));
      const Mat3 F = load_full<Dim>(body.particles.F(), static_cast<int>(i));
      CHECK(F.determinant() == Approx(std::exp(o)).epsilon(1e-13));
      if (Dim == 2) CHECK(F(2, 2) == 1.0);
    }
    CHECK(has == Approx(had).epsilon(1e-13));
  }
}

TEST_CASE("pressed particles close when their cell is open, and the energy they lose is dissipated", "[opening]") {
  const Model model = sand_model<2>();
  auto system = loose<2>(model);
  auto& body = system.bodies[0];
  const double pressure = GENERATE(0.03, 0.2) * bulk;  // less and more than the openings can relieve
  press(body, pressure);
  Distribution<2> alone(model, system, 1, 3);
  OpeningAverage<2>(model, system, alone).apply();
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double left = -body.particles.stress()[0][i], o = body.history_columns[opening][i];
    CHECK((left == Approx(0).margin(1e-9 * bulk) || o == 0.0));  // never pressed and open
    const double J = body.particles.volume()[i] * 1600 / body.particles.mass()[i];
    CHECK(body.history_columns[dissipation][i] ==
          Approx(J * (pressure * pressure - left * left) / (2 * bulk)).epsilon(1e-9));
    // what is closed is the relieved pressure over the bulk modulus
    const double average = o + (pressure - left) / bulk;
    CHECK(body.history_columns[plastic_volume][i] == Approx(o).margin(1e-13));
    CHECK(J == Approx(std::exp(average)).epsilon(1e-12));
  }
}

TEST_CASE("openings of cohesive soil are cracks and stay with their particles", "[opening]") {
  const Model model = sand_model<2>(sand(1e3));
  auto system = loose<2>(model);
  auto& body = system.bodies[0];
  const std::vector<double> start(body.history_columns[opening], body.history_columns[opening] + body.particles.size());
  Distribution<2> alone(model, system, 1, 3);
  OpeningAverage<2>(model, system, alone).apply();
  for (std::size_t i = 0; i < body.particles.size(); ++i) CHECK(body.history_columns[opening][i] == start[i]);
}

TEST_CASE("no opening is averaged in plane stress, where each particle has its own thickness", "[opening]") {
  Model model = sand_model<2>();
  model.analysis = Analysis::plane_stress;
  auto system = loose<2>(model);
  auto& body = system.bodies[0];
  const double first = body.history_columns[opening][0];
  Distribution<2> alone(model, system, 1, 3);
  OpeningAverage<2>(model, system, alone).apply();
  CHECK(body.history_columns[opening][0] == first);
}
