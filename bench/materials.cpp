// SPDX-License-Identifier: MIT
// Time per point and step of every law: items per second is points per second.

#include "material_point.hpp"

#include <benchmark/benchmark.h>
#include <random>

using namespace tribo;
using namespace tribo::test;

namespace {

// A batch of points in shear, 3e-5 per step, under 200 kPa of pressure.
template <int Dim>
void shear(benchmark::State& state, const std::string& type, const Properties& properties) {
  constexpr int count = 4096;
  const auto law = make_material(type, properties);
  std::vector<std::vector<double>> L(Layout<Dim>::full, std::vector<double>(count)), F = L;
  std::vector<std::vector<double>> stress(Layout<Dim>::symmetric, std::vector<double>(count));
  std::vector<std::vector<double>> history(law->history().size(), std::vector<double>(count));
  std::vector<double> volume(count, 1.0), mass(count, 1.0);
  MaterialPoints<Dim> points;
  for (std::size_t k = 0; k < L.size(); ++k) points.L[k] = L[k].data(), points.F[k] = F[k].data();
  for (std::size_t k = 0; k < stress.size(); ++k) points.stress[k] = stress[k].data();
  std::vector<double*> columns;
  for (auto& h : history) columns.push_back(h.data());
  points.count = count, points.dt = 1e-5;
  points.volume = volume.data(), points.mass = mass.data(), points.history = columns;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i) {
    Mat3 gradient = Mat3::Zero(), deformation = Mat3::Identity();
    gradient(0, 1) = 3 * (1 + 0.1 * normal(random));
    if (Dim == 3) gradient(1, 2) = 0.3 * gradient(0, 1);
    deformation(0, 1) = 0.1 * normal(random), deformation(0, 0) = 1 + 0.1 * normal(random);
    store_full<Dim>(gradient, points.L, i);
    store_full<Dim>(deformation, points.F, i);
    store_symmetric<Dim>(Mat3(-2e5 * Mat3::Identity()), points.stress, i);
  }
  for (int n = 0; n < 100; ++n) law->update(points);  // into yield
  for (auto _ : state) law->update(points);
  state.SetItemsProcessed(state.iterations() * count);
}

const Properties elastic{{"rho", "1"}, {"E", "1e8"}, {"nu", "0.3"}};

Properties soil(Properties more) {
  Properties p = elastic;
  p.insert(p.end(), {{"friction", "30"}, {"dilation", "5"}});
  p.insert(p.end(), more.begin(), more.end());
  return p;
}

template <int Dim>
void add(const std::string& label, const std::string& type, const Properties& properties) {
  benchmark::RegisterBenchmark((label + "/" + std::to_string(Dim) + "D").c_str(),
                               [=](benchmark::State& state) { shear<Dim>(state, type, properties); });
}

const bool registered = [] {
  const auto both = [](const std::string& label, const std::string& type, const Properties& properties) {
    add<2>(label, type, properties);
    add<3>(label, type, properties);
  };
  both("linear elastic", "LinearElastic", elastic);
  both("Mohr-Coulomb elastic", "MohrCoulomb", soil({{"cohesion", "1e12"}}));
  both("Mohr-Coulomb flowing", "MohrCoulomb", soil({{"cohesion", "1e4"}}));
  both("Mohr-Coulomb viscous", "MohrCoulomb", soil({{"cohesion", "1e4"}, {"relaxation_time", "1e-4"}}));
  both("Mohr-Coulomb softening", "MohrCoulomb",
       soil({{"cohesion", "1e4"}, {"cohesion_residual", "1e3"}, {"softening_end", "1e3"}}));
  both("Drucker-Prager flowing", "DruckerPrager", soil({{"cohesion", "1e4"}}));
  both("von Mises flowing", "VonMises",
       {{"rho", "1"}, {"E", "1e8"}, {"nu", "0.3"}, {"yield", "1e4"}, {"Khard", "1e5"}});
  both("von Mises, Johnson-Cook", "VonMises",
       {{"rho", "1"},
        {"E", "1e8"},
        {"nu", "0.3"},
        {"Hardening", "JohnsonCook"},
        {"Ajc", "1e4"},
        {"Bjc", "1e5"},
        {"njc", "0.3"},
        {"Cjc", "0.02"}});
  both("cracking", "IsoSoftening",
       {{"rho", "1"},
        {"E", "1e8"},
        {"nu", "0.3"},
        {"sigmac", "1e6"},
        {"I-Gc", "1e6"},
        {"SofteningI", "Exponential"},
        {"tauc", "1e4"}});
  both("Cam-Clay flowing", "CamClay",
       {{"rho", "1"}, {"lambda", "0.2"}, {"kappa", "0.04"}, {"e0", "1"}, {"M", "0.9"}, {"pc0", "1e4"}, {"nu", "0.3"}});
  both("viscoelastic, 2 elements", "Viscoelastic",
       {{"rho", "1"}, {"K", "1e8"}, {"G0", "1e7"}, {"Gk", "1e7"}, {"tauk", "1e-3"}, {"Gk", "1e7"}, {"tauk", "1e-2"}});
  both("ideal gas", "IdealGas", {{"rho", "1"}, {"P0", "1e5"}});
  both("orthotropic", "Orthotropic",
       {{"rho", "1"},
        {"Ex", "1e8"},
        {"Ey", "1e7"},
        {"Ez", "1e7"},
        {"Gxy", "6e6"},
        {"Gyz", "4e6"},
        {"Gxz", "6e6"},
        {"nuxy", "0.3"},
        {"nuyz", "0.4"},
        {"nuxz", "0.3"}});
  both("neo-Hookean", "NeoHookean", elastic);
  both("Mooney-Rivlin", "MooneyRivlin", elastic);
  return true;
}();

}  // namespace
