// SPDX-License-Identifier: MIT
/// Conduction: heat is conserved and flows from hot to cold; symmetry planes, prescribed temperatures and fluxes.

#include "cloud.hpp"
#include "contact/contact_cases.hpp"

using namespace tribo;
using namespace tribo::test;

namespace {

// rho c = 2000, k = 500: the diffusivity is a quarter of a cell squared per unit of time.
template <int Dim>
Model heat_model(Kernel kernel) {
  Model model = grid_model<Dim>(kernel, Transfer::flip);
  model.heat.kept = model.heat.conduction = true;
  model.materials[0].heat_capacity = 2;
  model.materials[0].conductivity = 500;
  return model;
}

double& temperature(Body<2>& body, std::size_t i) { return body.particles[body.temperature][i]; }
double& temperature(Body<3>& body, std::size_t i) { return body.particles[body.temperature][i]; }

template <int Dim>
void set_temperature(Body<Dim>& body, const std::function<double(const Vec<Dim>&)>& f) {
  for (std::size_t i = 0; i < body.particles.size(); ++i) temperature(body, i) = f(body.particles.position(i));
}

template <int Dim>
double heat_of(System<Dim>& system) {
  return measure(system).heat;
}

constexpr double step = 1e-3;  // of the stable mechanical one, 1/37

}  // namespace

TEMPLATE_TEST_CASE_SIG("conduction keeps the heat, whatever the temperatures", "[heat]", ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  Model model = heat_model<Dim>(kernel);
  model.materials[0].conductivity = 5e4;  // small-scale differences are smoothed several times
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 8, 12, 2, kernel == Kernel::cpdi ? 0.0 : 0.2));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 100);
  set_temperature<Dim>(system.bodies[0], [&](const Vec<Dim>&) { return any(random); });
  const double before = heat_of(system);
  Stepper<Dim> stepper(model, system);
  for (int k = 0; k < 30; ++k) stepper.advance(step);
  CHECK(heat_of(system) == Approx(before).epsilon(1e-13));
}

TEMPLATE_TEST_CASE_SIG("a linear temperature stays as it is away from the surface", "[heat]", ((int Dim), Dim), 2, 3) {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  const Model model = heat_model<Dim>(kernel);
  auto system = build_system<Dim>(model, lattice_seeds<Dim>(model, 3, 21));
  Body<Dim>& body = system.bodies[0];
  const auto linear = [](const Vec<Dim>& x) { return 5 + x[0] - 2 * x[1] + 0.5 * x[Dim - 1]; };
  set_temperature<Dim>(body, linear);
  Stepper<Dim> stepper(model, system);
  stepper.advance(step);  // the surface is heard eight cells deep
  double worst = 0.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<Dim> x = body.particles.position(i);
    if ((x.array() > 11.5).all() && (x.array() < 12.5).all())
      worst = std::max(worst, std::abs(temperature(body, i) - linear(x)));
  }
  CHECK(worst < 1e-11);
}

TEST_CASE("smoothing of small-scale differences spares a curved temperature", "[heat]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  Model model = heat_model<2>(kernel);
  model.materials[0].conductivity = 6e5;  // alpha dt = 0.3: smoothed in the first step
  auto system = build_system<2>(model, lattice_seeds<2>(model, 3, 21));
  Body<2>& body = system.bodies[0];
  const auto parabola = [](const Vec<2>& x) { return 0.5 * (x[0] - 12) * (x[0] - 12); };
  set_temperature<2>(body, parabola);
  Stepper<2> stepper(model, system);
  stepper.advance(step);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vec<2> x = body.particles.position(i);
    if ((x.array() > 11.5).all() && (x.array() < 12.5).all())
      CHECK(temperature(body, i) == Approx(parabola(x) + 0.3).margin(1e-9));
  }
}

TEST_CASE("heat flows from hot to cold, with the conductivity", "[heat]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  const Model model = heat_model<2>(kernel);
  auto system = build_system<2>(model, lattice_seeds<2>(model, 4, 20));
  Body<2>& body = system.bodies[0];
  // Half a wave of 16 cells between insulated faces decays as exp(-alpha k^2 t). Differences over cells change k^2 by
  // (kh)^2/12 = 0.3 %; the surface of splines without a wall is about a tenth of a cell off at both ends.
  const bool spline = kernel == Kernel::quadratic_spline || kernel == Kernel::cubic_spline;
  const double wave = std::acos(-1.0) / 16;
  const auto shape = [&](const Vec<2>& x) { return std::cos(wave * (x[0] - 4)); };
  set_temperature<2>(body, shape);
  Stepper<2> stepper(model, system);
  const int steps = 2000;
  for (int k = 0; k < steps; ++k) stepper.advance(step);
  double with = 0.0, all = 0.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double s = shape(body.particles.position(i));
    with += s * temperature(body, i), all += s * s;
  }
  const double rate = -std::log(with / all) / (steps * step);
  CHECK(rate == Approx(0.25 * wave * wave).epsilon(spline ? 0.02 : 0.004));
}

TEST_CASE("a symmetry plane stands for the other half, for heat as for motion", "[heat]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  Model whole = heat_model<2>(kernel), half = whole;
  half.grid.symmetry[0][0] = 12.0;
  auto all = build_system<2>(whole, lattice_seeds<2>(whole, 8, 16));
  auto seeds = lattice_seeds<2>(half, 8, 16);
  std::erase_if(seeds, [](const Seed& s) { return s.x[0] < 12; });
  auto some = build_system<2>(half, seeds);
  const auto hill = [](const Vec<2>& x) { return 100 - (x[0] - 12) * (x[0] - 12) + x[1]; };
  set_temperature<2>(all.bodies[0], hill), set_temperature<2>(some.bodies[0], hill);
  Stepper<2> a(whole, all), b(half, some);
  for (int k = 0; k < 300; ++k) a.advance(step), b.advance(step);
  std::map<std::pair<double, double>, double> right;
  const auto place = [](const Vec<2>& x) { return std::pair(std::round(1e6 * x[0]), std::round(1e6 * x[1])); };
  Body<2>&ba = all.bodies[0], &bb = some.bodies[0];
  for (std::size_t i = 0; i < ba.particles.size(); ++i) right[place(ba.particles.position(i))] = temperature(ba, i);
  for (std::size_t i = 0; i < bb.particles.size(); ++i)
    CHECK(temperature(bb, i) == Approx(right.at(place(bb.particles.position(i)))).epsilon(1e-11));
}

TEST_CASE("what held nodes and fluxes supply is the heat gained", "[heat]") {
  const Kernel kernel = GENERATE(from_range(all_kernels));
  INFO(name(kernel));
  Model model = heat_model<2>(kernel);
  SECTION("held nodes") {
    TemperatureCondition c;
    c.where = rectangle(7, 9, 0, 24);
    c.temperature.value = 10;
    model.temperature_conditions.push_back(c);
    auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 50; ++k) stepper.advance(step);
    CHECK(heat_of(system) > 0);
    CHECK(stepper.heat().supplied == Approx(heat_of(system)).epsilon(1e-12));
  }
  SECTION("a flux") {
    ParticleCondition c;
    c.kind = ParticleCondition::Kind::heat_flux;
    c.where = rectangle(8, 16, 15.5, 16);
    c.face = DomainFace::high_y;
    c.value.value = 7;
    model.particle_conditions.push_back(c);
    auto system = build_system<2>(model, lattice_seeds<2>(model, 8, 16));
    Stepper<2> stepper(model, system);
    for (int k = 0; k < 50; ++k) stepper.advance(step);
    CHECK(heat_of(system) == Approx(50 * step * 7 * 8).epsilon(1e-12));
    CHECK(stepper.heat().supplied == Approx(heat_of(system)).epsilon(1e-12));
  }
}

TEST_CASE("the work of friction between two sliding blocks becomes heat, and is taken from their motion",
          "[heat][contact]") {
  const double friction = 0.3, speed = 0.5, pressing = 1, height = 2, length = 8, dt = 2e-3;
  Model model = heat_model<2>(Kernel::gimp);
  model.heat.contact_heating = true;
  model.materials.push_back(model.materials[0]);
  model.materials[0].name = "lower", model.materials[1].name = "upper";
  model.materials[1].heat_capacity = 5;  // the shares of the two sides differ
  model.contact.active = true;
  model.contact.default_law = make_law("CoulombFriction", {{"coeff", "0.3"}});
  // Accelerations towards the interface, in proportion to the distance from it, press the blocks against each other.
  model.body_force.function[1].emplace("12-y", Origin{});
  std::vector<Seed> seeds;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 16; ++i) {
      Seed s;
      s.x = Vec3(8 + 0.5 * i + 0.25, 10 + 0.5 * j + 0.25, 0);
      s.half_size = Vec3(0.25, 0.25, 0);
      s.volume = 0.25, s.mass = 250;
      s.material = j < 4 ? 0 : 1;
      seeds.push_back(s);
    }
  auto system = build_system<2>(model, seeds);
  Stepper<2> stepper(model, system);
  set_velocity<2>(system.bodies[0], [&](const Vec<2>&) -> Vec<2> { return {-0.5 * speed, 0.0}; });
  set_velocity<2>(system.bodies[1], [&](const Vec<2>&) -> Vec<2> { return {0.5 * speed, 0.0}; });
  const double mass = 1000 * height * length;
  const int steps = 200;
  for (int k = 0; k < steps; ++k) stepper.advance(dt);
  const Measures lower = measure(system.bodies[0], false), upper = measure(system.bodies[1], false);
  const double time = steps * dt;
  // The impulse of the normal traction follows from the momentum balance of the upper block across the interface.
  const double normal_impulse = mass * pressing * height / 2 * time + upper.momentum[1];
  const double shear_impulse = 0.5 * mass * speed - upper.momentum[0];
  CHECK(normal_impulse > 0.5 * mass * pressing * height / 2 * time);
  CHECK(shear_impulse == Approx(friction * normal_impulse).epsilon(0.02));
  CHECK(lower.momentum[0] == Approx(-upper.momentum[0]).epsilon(1e-9));
  const double slower = (upper.momentum[0] - lower.momentum[0]) / mass;
  CHECK(slower < 0.8 * speed);
  const PairLedger contact = stepper.contact().ledger().total();
  CHECK(stepper.heat().from_contact == Approx(contact.friction).epsilon(1e-12));
  // Balance of energy: what motion and strain lost, and the body force supplied, is the heat of sliding and what the
  // FLIP update dissipates, which is never negative and here less than a twentieth of the initial energy.
  const double initial = 2 * 0.5 * mass * 0.25 * speed * speed;
  const double now = lower.kinetic + upper.kinetic + lower.stored + upper.stored;
  const double lost = initial + stepper.ledger().external_work - now - contact.impact;
  CHECK(stepper.heat().from_contact < lost);
  CHECK(stepper.heat().from_contact > lost - 0.05 * initial);
  CHECK(heat_of(system) == Approx(stepper.heat().from_contact).epsilon(1e-12));
}
