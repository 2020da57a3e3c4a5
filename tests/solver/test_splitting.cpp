// SPDX-License-Identifier: MIT
/// Splitting of stretched particles and merging of crushed ones.
#include "cloud.hpp"

#include "base/parallel.hpp"
#include "solver/particle_splitting.hpp"
#include "solver/state/particle_domain.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace tribo;
using namespace tribo::test;

namespace {

template <int Dim>
Mat<Dim> random_matrix(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  return Mat<Dim>::NullaryExpr([&] { return number(random); });
}

/// Deforms all particles by F, with random velocities and stresses, as if the body had been stretched that far.
template <int Dim>
void deform(Body<Dim>& body, const Mat<Dim>& F) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const Vec<Dim> centre = Vec<Dim>::Constant(12);
  auto& particles = body.particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec<Dim> x = centre + F * (particles.position(i) - centre);
    for (std::size_t d = 0; d < Dim; ++d)
      particles.x()[d][i] = x[static_cast<Eigen::Index>(d)], particles.v()[d][i] = number(random);
    Mat3 whole = Mat3::Identity();
    whole.topLeftCorner<Dim, Dim>() = F;
    store_full<Dim>(whole, particles.F(), static_cast<int>(i));
    particles.volume()[i] *= F.determinant();
    store_symmetric<Dim>(Mat3(1e3 * Vec3(number(random), number(random), number(random)).asDiagonal()),
                         particles.stress(), static_cast<int>(i));
    if (body.affine)
      for (double* column : particles[body.affine]) column[i] = number(random);
  }
}

template <int Dim>
Model splitting_model(Transfer transfer = Transfer::flip, Kernel kernel = Kernel::quadratic_spline) {
  Model model = grid_model<Dim>(kernel, transfer);
  model.splitting.emplace();
  return model;
}

template <int Dim>
double domain_volume(Body<Dim>& body) {
  const DomainReader<Dim> domain(body);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < body.particles.size(); ++i)
    sum += std::ldexp(std::abs(domain(i).axes.determinant()), Dim);
  return sum;
}

template <int Dim>
double longest_edge(Body<Dim>& body) {
  const DomainReader<Dim> domain(body);
  double longest = 0.0;
  for (std::uint32_t i = 0; i < body.particles.size(); ++i)
    longest = std::max(longest, 2 * domain(i).axes.colwise().norm().maxCoeff());
  return longest;
}

// All that splitting and merging conserve.
void check_conserved(const Measures& before, const Measures& after) {
  CHECK(after.mass == Approx(before.mass).epsilon(1e-13));
  CHECK(after.volume == Approx(before.volume).epsilon(1e-13));
  CHECK((after.momentum - before.momentum).norm() < 1e-10);
  CHECK((after.centre - before.centre).norm() < 1e-12);
  CHECK((after.displacement - before.displacement).norm() < 1e-12);
  CHECK((after.stress - before.stress).norm() < 1e-9);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the axes of a lattice of particles become the shortest ones, whatever the shear", "[splitting]",
                       ((int Dim), Dim), 2, 3) {
  std::mt19937 random(3);
  const Vec<Dim> cell = Vec<Dim>::LinSpaced(Dim, 0.5, 1.5);
  for (const double shear : {0.2, 0.7, 3.3, 57.8, 1000.4}) {
    Mat<Dim> F = Mat<Dim>::Identity();
    F(0, 1) = shear;
    const Mat<Dim> initial = Mat<Dim>::Identity() + random_matrix<Dim>(random, 0.1);
    const auto basis = reduced<Dim>({F * initial, initial}, cell);
    CHECK((basis.current - F * basis.initial).norm() < 1e-9 * shear);
    CHECK(std::abs(basis.initial.determinant()) == Approx(std::abs(initial.determinant())));
    const Mat<Dim> steps = initial.inverse() * basis.initial;
    CHECK((steps - Mat<Dim>(steps.array().round())).norm() < 1e-9 * shear);
    // Lagrange's algorithm: |a . b| <= |b|^2/2 for each pair of axes
    const Mat<Dim> in_cells = cell.cwiseInverse().asDiagonal() * basis.current,
                   products = in_cells.transpose() * in_cells;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j)
        if (i != j) CHECK(std::abs(products(i, j)) <= 0.5 * products(j, j) * (1 + 1e-6));
  }
}

TEMPLATE_TEST_CASE_SIG("stretched particles split, and nothing but their number changes", "[splitting]",
                       ((int Dim), Dim), 2, 3) {
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic);
  const Kernel kernel = GENERATE(Kernel::gimp, Kernel::quadratic_spline, Kernel::cpdi);
  const Model model = splitting_model<Dim>(transfer, kernel);
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 11, 13));
  auto& body = system.bodies[0];
  Mat<Dim> F = Mat<Dim>::Identity();
  F(0, 0) = 2.6, F(1, 0) = 0.4;  // the longest edges are 1.3 cells
  deform<Dim>(body, F);
  settle(system);
  const Measures before = measure(system);
  const std::size_t count = body.particles.size();
  EnergyLedger ledger;
  ParticleSplitting<Dim> splitting(model, system, ledger);
  REQUIRE(splitting.apply());
  CHECK(body.particles.size() == 2 * count);
  CHECK(splitting.split_count() == static_cast<std::int64_t>(count));
  const Measures after = measure(system);
  check_conserved(before, after);
  CHECK((after.angular_momentum - before.angular_momentum).norm() < 1e-9);
  CHECK(after.kinetic == Approx(before.kinetic).epsilon(1e-13));
  CHECK(after.stored == Approx(before.stored).epsilon(1e-13));
  CHECK(ledger.damping_work == 0.0);
  CHECK(domain_volume(body) == Approx(after.volume).epsilon(1e-12));
  CHECK(longest_edge(body) < 1);
  CHECK(std::set<std::int64_t>(body.particles.id.begin(), body.particles.id.end()).size() == 2 * count);
  if (body.half_size)
    for (const double* half : body.particles[body.half_size])
      for (std::size_t i = 0; i < body.particles.size(); ++i) CHECK((half[i] > 0 && half[i] <= 0.5));
  CHECK_FALSE(splitting.apply());
}

TEST_CASE("simple shear splits no particle", "[splitting]") {
  const Model model = splitting_model<2>();
  auto system = build_system<2>(model, lattice_seeds<2>(model, 11, 13));
  Mat<2> F = Mat<2>::Identity();
  F(0, 1) = GENERATE(1.0, 4.4, 19.7);
  deform<2>(system.bodies[0], F);
  EnergyLedger ledger;
  ParticleSplitting<2> splitting(model, system, ledger);
  CHECK_FALSE(splitting.apply());
}

TEST_CASE("particles split as often as they may, and not where loads act", "[splitting]") {
  Model model = splitting_model<2>();
  model.splitting->generations = 2;
  auto system = build_system<2>(model, lattice_seeds<2>(model, 11, 13));
  auto& body = system.bodies[0];
  Mat<2> F = Mat<2>::Identity();
  F(0, 0) = 16;  // within 8 cells of the centre: positions stay in the grid
  const std::size_t count = body.particles.size();
  for (std::size_t i = 0; i < count; ++i)
    store_full<2>(Mat3(Vec3(16, 1, 1).asDiagonal()), body.particles.F(), static_cast<int>(i));
  body.load_set = body.particles.add("load_set", Dimension::none);
  body.particles[body.load_set][3] = 1.0;
  EnergyLedger ledger;
  ParticleSplitting<2> splitting(model, system, ledger);
  REQUIRE(splitting.apply());
  CHECK(body.particles.size() == 4 * (count - 1) + 1);
}

TEMPLATE_TEST_CASE_SIG("crushed particles merge, and the energy of their relative motion is recorded", "[splitting]",
                       ((int Dim), Dim), 2, 3) {
  const Transfer transfer = GENERATE(Transfer::flip, Transfer::apic);
  const Model model = splitting_model<Dim>(transfer);
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 10, 14));
  auto& body = system.bodies[0];
  Mat<Dim> F = Mat<Dim>::Identity();
  F(0, 0) = 0.4;
  deform<Dim>(body, F);
  settle(system);
  const Measures before = measure(system);
  const std::size_t count = body.particles.size();
  EnergyLedger ledger;
  ParticleSplitting<Dim> splitting(model, system, ledger);
  REQUIRE(splitting.apply());
  CHECK(body.particles.size() + static_cast<std::size_t>(splitting.merged_count()) == count);
  CHECK(splitting.merged_count() > static_cast<std::int64_t>(count / 4));
  const Measures after = measure(system);
  check_conserved(before, after);
  if (transfer == Transfer::apic) CHECK((after.angular_momentum - before.angular_momentum).norm() < 1e-9);
  CHECK(ledger.damping_work > 0);
  CHECK(ledger.particle_loss == Approx(before.kinetic - after.kinetic).epsilon(1e-9));
  CHECK(after.kinetic + after.stored + ledger.damping_work == Approx(before.kinetic + before.stored).epsilon(1e-12));
  CHECK(domain_volume(body) == Approx(after.volume).epsilon(1e-12));
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    CHECK(load_full<Dim>(body.particles.F(), static_cast<int>(i)).determinant() == Approx(0.4));
}

TEST_CASE("particles that merge keep the integral of stress and the ratio of their volume", "[splitting]") {
  const Model model = splitting_model<2>();
  auto system = build_system<2>(model, lattice_seeds<2>(model, 10, 14));
  auto& body = system.bodies[0];
  Mat<2> F = Mat<2>::Identity();
  F(0, 0) = 0.4;
  deform<2>(body, F);
  auto& particles = body.particles;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  for (std::size_t i = 0; i < particles.size(); ++i) {  // each is turned and swells a little
    const double swelling = 1 + number(random);
    Mat3 own = load_full<2>(particles.F(), static_cast<int>(i));
    own.topLeftCorner<2, 2>() = swelling * (Eigen::Rotation2Dd(number(random)).toRotationMatrix() * F);
    store_full<2>(own, particles.F(), static_cast<int>(i));
    particles.volume()[i] *= swelling * swelling;
  }
  settle(system);
  const Measures before = measure(system);
  EnergyLedger ledger;
  ParticleSplitting<2> splitting(model, system, ledger);
  REQUIRE(splitting.apply());
  REQUIRE(splitting.merged_count() > 10);
  check_conserved(before, measure(system));
  for (std::size_t i = 0; i < particles.size(); ++i)
    CHECK(load_full<2>(particles.F(), static_cast<int>(i)).determinant() ==
          Approx(particles.volume()[i] * body.law->density() / particles.mass()[i]).epsilon(1e-12));
}

TEST_CASE("a jet that stretches splits to the same bits on any number of threads", "[splitting][threads]") {
  const int usual = threads();
  const auto run = [&](int count) {
    set_threads(count);
    const Model model = splitting_model<2>(Transfer::apic);
    auto system = build_system<2>(model, lattice_seeds<2>(model, 10, 14));
    set_velocity<2>(system.bodies[0], [](const Vec<2>& x) -> Vec<2> { return {40 * (x[0] - 12), -10 * (x[1] - 12)}; });
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 60; ++k) stepper.advance(1e-3);
    CHECK(stepper.splitting().split_count() > 0);
    const auto& particles = system.bodies[0].particles;
    std::vector<double> bits;
    for (const auto& column : particles.columns())
      bits.insert(bits.end(), column.data.begin(), column.data.begin() + static_cast<std::ptrdiff_t>(particles.size()));
    for (const std::int64_t id : particles.id) bits.push_back(static_cast<double>(id));
    return bits;
  };
  const auto one = run(1);
  CHECK(run(2) == one);
  CHECK(run(7) == one);
  set_threads(usual);
}
