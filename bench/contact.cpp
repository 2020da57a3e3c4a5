// SPDX-License-Identifier: MIT
/// What contact costs: whole steps of two bodies that meet across the whole grid, against one body of the same
/// particles. Two halves of a square of 160 x 160 or a cube of 32^3 cells (unless told),
/// pressed together and sliding.
///
///   bench_contact <2|3> <kernel> <transfer> <threads> [nodes|faces [cells]]

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

// One body, or two in contact: to be run in turns, as machines are faster at some times than at others.
template <int Dim>
class Case {
 public:
  Case(int cells, Kernel kernel, Transfer transfer, bool contact, bool faces)
      : cells_(cells),
        model_(make_model(kernel, transfer, contact, faces)),
        seeds_(make_seeds(contact)),
        system_(build_system<Dim>(model_, seeds_)),
        stepper_(model_, system_) {}

  /// Of a particle's step.
  Times cost(int steps) { return cost_of_steps(stepper_, seeds_.size(), steps); }

 private:
  const int cells_;

  Model make_model(Kernel kernel, Transfer transfer, bool contact, bool faces) const {
    Model model;
    model.analysis = Dim == 2 ? Analysis::plane_strain : Analysis::solid;
    model.scheme.order = UpdateOrder::usl;
    model.scheme.extrapolate_again = false;
    model.scheme.kernel = kernel;
    model.scheme.transfer = transfer;
    for (std::size_t d = 0; d < Dim; ++d) {
      model.grid.low[d] = -6, model.grid.high[d] = cells_ + 6;
      model.grid.cells[d] = cells_ + 12;
    }
    for (const char* name : {"lower", "upper"}) {
      MaterialSpec spec;
      spec.name = name;
      spec.law = make<Material>(materials(), "NeoHookean", {{"rho", "1"}, {"G", "0.4"}, {"Lame", "0.6"}});
      model.materials.push_back(spec);
    }
    model.contact.active = contact;
    model.contact.at_faces = faces;
    model.contact.default_law = make<ContactLaw>(contact_laws(), "CoulombFriction", {{"coeff", "0.3"}});
    return model;
  }

  std::vector<Seed> make_seeds(bool contact) const {
    std::vector<Seed> seeds;
    const int per_axis = 2 * cells_;
    for (int k = 0; k < (Dim == 3 ? per_axis : 1); ++k)
      for (int j = 0; j < per_axis; ++j)
        for (int i = 0; i < per_axis; ++i) {
          Seed s;
          const int index[3] = {i, j, k};
          for (int d = 0; d < Dim; ++d) s.x[d] = 0.5 * (index[d] + 0.5);
          s.half_size.template head<Dim>().setConstant(0.25);
          s.volume = std::pow(0.5, Dim), s.mass = s.volume;
          const bool upper = s.x[1] > cells_ / 2;
          s.material = upper && contact ? 1 : 0;
          s.v = Vec3(upper ? 0.005 : -0.005, upper ? -0.005 : 0.005, 0);
          seeds.push_back(s);
        }
    return seeds;
  }

  Model model_;
  std::vector<Seed> seeds_;
  System<Dim> system_;
  Stepper<Dim> stepper_;
};

template <int Dim>
std::pair<Times, Times> costs(int cells, Kernel kernel, Transfer transfer, bool faces) {
  Case<Dim> one(cells, kernel, transfer, false, faces), two(cells, kernel, transfer, true, faces);
  const int warm = 5, turns = 20, steps = 5;
  one.cost(warm), two.cost(warm);
  Times cost_one, cost_two;
  for (int k = 0; k < turns; ++k) cost_one += one.cost(steps) / turns, cost_two += two.cost(steps) / turns;
  return {cost_one, cost_two};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string dim = argc > 1 ? argv[1] : "2", kernel = argc > 2 ? argv[2] : "quadratic",
                    transfer = argc > 3 ? argv[3] : "flip", where = argc > 5 ? argv[5] : "nodes";
  set_threads(argc > 4 ? std::stoi(argv[4]) : 1);
  const int cells = argc > 6 ? std::stoi(argv[6]) : dim == "2" ? 160 : 32;
  const Kernel k = kernel == "gimp" ? Kernel::gimp : Kernel::quadratic_spline;
  const Transfer t = transfer == "apic" ? Transfer::apic : transfer == "fmpm" ? Transfer::fmpm : Transfer::flip;
  const auto [one, two] = (dim == "2" ? costs<2> : costs<3>)(cells, k, t, where == "faces");
  std::printf(
      "%sD %s %s: one body %.1f ns cpu per particle-step, two in contact %.1f, ratio %.3f; elapsed %.1f, %.1f\n",
      dim.c_str(), kernel.c_str(), transfer.c_str(), one.cpu, two.cpu, two.cpu / one.cpu, one.wall, two.wall);
  return 0;
}
