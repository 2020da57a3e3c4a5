// SPDX-License-Identifier: MIT
/// What many bodies cost: whole steps of bodies in a square or cubic array that touch all their neighbours, are
/// pressed together and slide, against one body of the same particles.
///
///   bench_many <cubes|spheres|discs> <number> [threads [cells]]
///
/// `number`: of bodies, rounded up to complete the array; a body is `cells` (unless told 8) wide.

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

enum class Shape { cubes, spheres, discs };

// The bodies, or one body of all particles: to be run in turns, as machines are faster at some times than at others.
template <int Dim>
class Case {
 public:
  Case(Shape shape, int per_axis, int cells, bool contact)
      : shape_(shape),
        per_axis_(per_axis),
        cells_(cells),
        model_(make_model(contact)),
        seeds_(make_seeds(contact)),
        begin_(cpu_seconds()),
        system_(build_system<Dim>(model_, seeds_)),
        stepper_(model_, system_) {
    stepper_.advance(0.25);
    set_up_ = cpu_seconds() - begin_;
  }

  Times cost(int steps) { return cost_of_steps(stepper_, seeds_.size(), steps); }
  /// CPU time from the particles to the end of the first step [s].
  double set_up() const { return set_up_; }
  std::size_t particles() const { return seeds_.size(); }

 private:
  Model make_model(bool contact) const {
    Model model;
    model.analysis = Dim == 2 ? Analysis::plane_strain : Analysis::solid;
    model.scheme.order = UpdateOrder::usl;
    model.scheme.extrapolate_again = false;
    model.scheme.kernel = Kernel::quadratic_spline;
    model.scheme.transfer = Transfer::flip;
    for (std::size_t d = 0; d < Dim; ++d) {
      model.grid.low[d] = -6, model.grid.high[d] = cells_ * per_axis_ + 6;
      model.grid.cells[d] = cells_ * per_axis_ + 12;
    }
    int bodies = 1;
    for (int d = 0; d < Dim && contact; ++d) bodies *= per_axis_;
    for (int k = 0; k < bodies; ++k) {
      MaterialSpec spec;
      spec.name = "body " + std::to_string(k + 1);
      spec.law = make<Material>(materials(), "NeoHookean", {{"rho", "1"}, {"G", "0.4"}, {"Lame", "0.6"}});
      model.materials.push_back(spec);
    }
    model.contact.active = contact;
    model.contact.default_law = make<ContactLaw>(contact_laws(), "CoulombFriction", {{"coeff", "0.3"}});
    return model;
  }

  std::vector<Seed> make_seeds(bool contact) const {
    std::vector<Seed> seeds;
    const int points = 2 * cells_ * per_axis_;
    const double speed = 0.001;   // of the bodies against each other
    const double strain = 0.002;  // by which they are compressed
    for (int k = 0; k < (Dim == 3 ? points : 1); ++k)
      for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i) {
          Seed s;
          const int index[3] = {i, j, k};
          Vec3 from_centre = Vec3::Zero();
          int body = 0;
          for (int d = Dim; d-- > 0;) {
            const int place = index[d] / (2 * cells_);
            body = body * per_axis_ + place;
            s.x[d] = 0.5 * (index[d] + 0.5);
            from_centre[d] = s.x[d] - (place + 0.5) * cells_;
          }
          if (shape_ != Shape::cubes && from_centre.norm() > 0.5 * cells_) continue;
          s.half_size.template head<Dim>().setConstant(0.25);
          s.volume = std::pow(0.5, Dim), s.mass = s.volume;
          s.material = contact ? body : 0;
          for (int d = 0; d < Dim; ++d) {
            s.F(d, d) = 1.0 - strain;
            s.v[d] = (index[d] / (2 * cells_) + index[(d + 1) % Dim] / (2 * cells_)) % 2 == 0 ? speed : -speed;
          }
          seeds.push_back(s);
        }
    return seeds;
  }

  const Shape shape_;
  const int per_axis_, cells_;
  Model model_;
  std::vector<Seed> seeds_;
  double begin_, set_up_ = 0.0;
  System<Dim> system_;
  Stepper<Dim> stepper_;
};

template <int Dim>
void compare(Shape shape, int number, int cells) {
  int per_axis = 1, count = 1;
  while (count < number) ++per_axis, count = Dim == 2 ? per_axis * per_axis : per_axis * per_axis * per_axis;
  Case<Dim> one(shape, per_axis, cells, false), many(shape, per_axis, cells, true);
  constexpr double work = 2e6;  // particle-steps per turn
  const int turns = 5, steps = std::clamp(static_cast<int>(work / static_cast<double>(one.particles())), 4, 20);
  one.cost(2), many.cost(2);
  Times of_one, of_many;
  for (int k = 0; k < turns; ++k) {
    of_one += one.cost(steps) / turns, of_many += many.cost(steps) / turns;
  }
  std::printf(
      "%d bodies, %zu particles: one %.1f ns cpu per particle-step, many %.1f, ratio %.2f; elapsed %.1f, %.1f; "
      "set-up %.2f, %.2f s\n",
      count, one.particles(), of_one.cpu, of_many.cpu, of_many.cpu / of_one.cpu, of_one.wall, of_many.wall,
      one.set_up(), many.set_up());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "cubes";
  const int number = argc > 2 ? std::stoi(argv[2]) : 64, cells = argc > 4 ? std::stoi(argv[4]) : 8;
  set_threads(argc > 3 ? std::stoi(argv[3]) : 1);
  if (name == "discs")
    compare<2>(Shape::discs, number, cells);
  else
    compare<3>(name == "spheres" ? Shape::spheres : Shape::cubes, number, cells);
  return 0;
}
