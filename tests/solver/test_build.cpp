// SPDX-License-Identifier: MIT
/// Limits that the solver checks when it is built, and numbers of threads above those of the machine.

#include "base/parallel.hpp"
#include "cloud.hpp"
#include "solver/transfer/particle_update.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

/// A law without stress that has `count` history variables.
class HistoryLaw final : public Material {
 public:
  explicit HistoryLaw(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) history_.push_back({"variable" + std::to_string(k), Dimension::none, 0.0});
  }
  void update(const MaterialPoints<2>& points) const override { last_value(points); }
  void update(const MaterialPoints<3>& points) const override { last_value(points); }
  double density() const override { return 1000; }
  using Material::wave_modulus;
  double wave_modulus() const override { return 1e6; }
  const std::vector<HistoryVariable>& history() const override { return history_; }

 private:
  template <int Dim>
  void last_value(const MaterialPoints<Dim>& points) const {
    for (int i = 0; i < points.count; ++i) points.history[history_.size() - 1][i] = 7;
  }
  std::vector<HistoryVariable> history_;
};

}  // namespace

TEST_CASE("a law with more history variables than a batch has pointers for is refused", "[build]") {
  Model model = grid_model<2>(Kernel::linear, Transfer::flip);
  model.materials[0].law = std::make_shared<HistoryLaw>(most_history_variables);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 9));
  Stepper<2> stepper(model, system);
  stepper.advance(1e-6);
  auto& body = system.bodies[0];
  CHECK(body.particles.column(body.history + most_history_variables - 1)[0] == 7);
  model.materials[0].law = std::make_shared<HistoryLaw>(most_history_variables + 1);
  CHECK_THROWS_AS(build_system<2>(model, lattice_seeds<2>(model, 8, 9)), std::logic_error);
}

TEST_CASE("300 threads give the result of one", "[build][threads]") {
  const Kernel kernel = GENERATE(Kernel::linear, Kernel::cpdi);
  INFO(name(kernel));
  const int usual = threads();
  const auto positions = [&](int count) {
    set_threads(count);
    Model model = grid_model<2>(kernel, Transfer::flip, UpdateOrder::usl, false, 160);
    // More than 256 blocks of 8 x 8 nodes are occupied.
    auto system = build_system<2>(model, lattice_seeds<2>(model, 2, 158, 1));
    set_velocity<2>(system.bodies[0], [](const Vec<2>& x) -> Vec<2> { return {std::sin(x[1]), std::cos(x[0])}; });
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 2; ++k) stepper.advance(1e-3);
    std::vector<double> x;
    for (std::size_t i = 0; i < system.bodies[0].particles.size(); ++i)
      x.push_back(system.bodies[0].particles.position(i)[0]);
    return x;
  };
  const auto one = positions(1), many = positions(300);
  set_threads(usual);
  CHECK(one == many);
}

TEST_CASE("each of 300 threads has its own result of a gather", "[build][threads]") {
  const int usual = threads();
  set_threads(300);
  GatherCollector collector;
  for (int round = 0; round < 2; ++round) {
    collector.start();
    CHECK(collector.total().travel == 0);
    std::vector<std::pair<GatherResult*, int>> slots(300);
    parallel_for(300, [&](std::ptrdiff_t k) {
      auto& mine = collector.mine();
      slots[static_cast<std::size_t>(k)] = {&mine, thread_index()};
      mine.travel = std::max(mine.travel, static_cast<double>(k));
      mine.valid = mine.valid && k != 280;
    });
    std::sort(slots.begin(), slots.end());
    for (std::size_t k = 1; k < slots.size(); ++k)
      CHECK((slots[k].first == slots[k - 1].first) == (slots[k].second == slots[k - 1].second));
    CHECK(collector.total().travel == 299);
    CHECK_FALSE(collector.total().valid);
  }
  set_threads(usual);
}
