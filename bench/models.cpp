// SPDX-License-Identifier: MIT
/// What an addition to a model costs: whole steps of a model with settings of its entities or variables, against the
/// same model without them.
///
///   bench_models <model> <threads> <steps> <name>=<value> ...

#include "base/parallel.hpp"
#include "cpu_time.hpp"
#include "input/read.hpp"
#include "particles/fill.hpp"
#include "run/step_size.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"

#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>

using namespace tribo;

namespace {

// To be run in turns, as machines are faster at some times than at others.
template <int Dim>
class Case {
 public:
  explicit Case(Model model)
      : model_(std::move(model)),
        system_(build_system<Dim>(model_, place_points(model_))),
        stepper_(model_, system_),
        dt_(StepSize<Dim>(model_, system_).first().size) {}

  /// Of a particle's step.
  Times cost(int steps) { return cost_of_steps(stepper_, particle_count(system_), steps, dt_); }

 private:
  Model model_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
  double dt_;
};

template <int Dim>
void compare(Model plain, Model changed, int steps) {
  Case<Dim> without(std::move(plain)), with(std::move(changed));
  without.cost(2), with.cost(2);
  constexpr int turns = 5;
  Times of_without, of_with;
  for (int k = 0; k < turns; ++k) of_without += without.cost(steps) / turns, of_with += with.cost(steps) / turns;
  std::printf("without %.1f ns cpu per particle-step, with %.1f, ratio %.2f; elapsed %.1f, %.1f\n", of_without.cpu,
              of_with.cpu, of_with.cpu / of_without.cpu, of_without.wall, of_with.wall);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) return std::fputs("usage: bench_models <model> <threads> <steps> <name>=<value> ...\n", stderr), 2;
  set_threads(std::stoi(argv[2]));
  std::map<std::string, std::string> values;
  for (int k = 4; k < argc; ++k) {
    const std::string setting = argv[k];
    const std::size_t equals = setting.find('=');
    values[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  Model plain = read_model(argv[1]), changed = read_model(argv[1], values);
  const bool space = plain.analysis == Analysis::solid;
  (space ? compare<3> : compare<2>)(std::move(plain), std::move(changed), std::stoi(argv[3]));
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 3;
}
