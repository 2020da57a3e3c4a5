// SPDX-License-Identifier: MIT
/// What a finely divided crack costs: whole steps of a square with a straight line of segments across three quarters of
/// it, against the square without a crack.
///
///   bench_crack <segments> [threads [cells]]
///
/// `cells`: of the square, unless told 160, along each axis.

#include "base/parallel.hpp"
#include "cpu_time.hpp"
#include "make_law.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"

#include "contact/contact_law.hpp"

#include <cmath>
#include <cstdio>
#include <string>

using namespace tribo;

namespace {

// To be run in turns, as machines are faster at some times than at others.
class Case {
 public:
  Case(int cells, int segments)
      : cells_(cells),
        model_(make_model(segments)),
        seeds_(make_seeds()),
        system_(build_system<2>(model_, seeds_)),
        stepper_(model_, system_) {}

  /// Of a particle's step.
  Times cost(int steps) { return cost_of_steps(stepper_, seeds_.size(), steps); }

 private:
  Model make_model(int segments) const {
    Model model;
    model.analysis = Analysis::plane_strain;
    model.scheme.order = UpdateOrder::usl;
    model.scheme.extrapolate_again = false;
    model.scheme.kernel = Kernel::quadratic_spline;
    model.scheme.transfer = Transfer::flip;
    for (std::size_t d = 0; d < 2; ++d) {
      model.grid.low[d] = -6, model.grid.high[d] = cells_ + 6;
      model.grid.cells[d] = cells_ + 12;
    }
    MaterialSpec spec;
    spec.name = "solid";
    spec.law = make<Material>(materials(), "NeoHookean", {{"rho", "1"}, {"G", "0.4"}, {"Lame", "0.6"}});
    model.materials.push_back(spec);
    if (segments == 0) return model;
    CrackSpec crack;
    const double from = 0.125 * cells_, length = 0.75 * cells_, slope = 0.1;
    for (std::uint32_t k = 0; k <= static_cast<std::uint32_t>(segments); ++k) {
      const double s = length * k / segments;
      crack.points.emplace_back(from + s, 0.45 * cells_ + 0.3 + slope * s, 0.0);
      if (k > 0) crack.pieces.push_back({k - 1, k, 0});
    }
    crack.law = make<ContactLaw>(contact_laws(), "CoulombFriction", {{"coeff", "0.3"}});
    model.cracks.push_back(crack);
    return model;
  }

  std::vector<Seed> make_seeds() const {
    std::vector<Seed> seeds;
    const int points = 2 * cells_;
    for (int j = 0; j < points; ++j)
      for (int i = 0; i < points; ++i) {
        Seed s;
        s.x = Vec3(0.5 * (i + 0.5), 0.5 * (j + 0.5), 0);
        s.half_size.head<2>().setConstant(0.25);
        s.volume = s.mass = 0.25;
        s.v = Vec3(0.0, s.x[1] > 0.5 * cells_ ? -0.005 : 0.005, 0);
        seeds.push_back(s);
      }
    return seeds;
  }

  const int cells_;
  Model model_;
  std::vector<Seed> seeds_;
  System<2> system_;
  Stepper<2> stepper_;
};

}  // namespace

int main(int argc, char** argv) {
  const int segments = argc > 1 ? std::stoi(argv[1]) : 1000, cells = argc > 3 ? std::stoi(argv[3]) : 160;
  set_threads(argc > 2 ? std::stoi(argv[2]) : 1);
  Case without(cells, 0), with(cells, segments);
  without.cost(2), with.cost(2);
  const int turns = 5, steps = 10;
  Times of_without, of_with;
  for (int k = 0; k < turns; ++k) {
    of_without += without.cost(steps) / turns;
    const Times first = with.cost(1);
    of_with += (first.cpu > 1e3 ? first : with.cost(steps)) / turns;  // few steps if they take long
  }
  std::printf("%d segments: without %.1f ns cpu per particle-step, with %.1f, ratio %.2f; elapsed %.1f, %.1f\n",
              segments, of_without.cpu, of_with.cpu, of_with.cpu / of_without.cpu, of_without.wall, of_with.wall);
  return 0;
}
