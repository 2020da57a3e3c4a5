// SPDX-License-Identifier: MIT
#include "run/step_size.hpp"

#include "solver/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tribo {
namespace {

// The outermost particles on an elastic support of stiffness k are oscillators of mass rho d and stiffness k per area,
// where d is their thickness. Their limit 2 sqrt(rho d/k) is reduced by the Courant number, as that of waves is.
template <int Dim>
double support_limit(const Model& model, Body<Dim>& body) {
  double stiffness = 0.0;
  for (const auto& condition : model.particle_conditions) stiffness += condition.value.stiffness();
  if (!(stiffness > 0)) return std::numeric_limits<double>::infinity();
  double thickness = 2 * body.uniform_half_size.minCoeff();
  if (body.half_size && body.particles.size() > 0)
    for (const double* half : body.particles[body.half_size])
      thickness = std::min(thickness, 2 * *std::min_element(half, half + body.particles.size()));
  return model.time.courant * std::sqrt(body.law->density() * thickness / stiffness);
}

// Mean edge of the particles of a body along an axis, before deformation [length].
template <int Dim>
double particle_edge(Body<Dim>& body, int axis) {
  if (!body.half_size || body.particles.size() == 0) return 2 * body.uniform_half_size[axis];
  const double* half = body.particles[body.half_size][static_cast<std::size_t>(axis)];
  const auto count = body.particles.size();
  return 2 * std::accumulate(half, half + count, 0.0) / static_cast<double>(count);
}

// A node that a body hardly reaches has a small mass m and strains the particle that reaches it by its acceleration. If
// strains follow the momentum update, the stress of the particle changes in a step by -g times its excess, where
//
//   g = k (c dt)^2 V |grad S|^2 rho/m,
//
// c is the speed of waves and k the order of FMPM, which multiplies the velocity of such nodes by k. With uGIMP
// V |grad S|^2 rho/m = 2/(h l) for a particle of edge l however small the mass is; with quadratic splines it is 2/h^2.
// Beyond g = 2 the stress grows from step to step while a face of the body moves across a grid line. The factors are
// below the limits of blocks in free flight, which were measured; other nodes and the corners add to g.
template <int Dim>
double face_limit(const Model& model, const Lattice<Dim>& lattice, Body<Dim>& body, double wave_speed) {
  const Scheme& scheme = model.scheme;
  double length = 0.0;  // [length]
  switch (scheme.kernel) {
    case Kernel::linear:
      break;
    case Kernel::gimp:
    case Kernel::cpdi: {
      const bool cut = body.half_size || body.half_axes;
      double area = std::numeric_limits<double>::infinity();
      for (int d = 0; d < Dim; ++d) area = std::min(area, lattice.spacing[d] * particle_edge(body, d));
      length = (scheme.kernel == Kernel::gimp ? (cut ? 0.8 : 0.88) : (cut ? 0.6 : 0.8)) * std::sqrt(area);
      break;
    }
    case Kernel::quadratic_spline:
      length = 0.75 * lattice.smallest_spacing();
      break;
    case Kernel::cubic_spline:
      length = lattice.smallest_spacing();
  }
  const bool follows = scheme.order != UpdateOrder::usf && !scheme.extrapolate_again;
  if (length == 0.0 || !follows) return std::numeric_limits<double>::infinity();
  const double order = scheme.transfer == Transfer::fmpm ? scheme.filter_order : 1.0;
  const double halves = scheme.order == UpdateOrder::usavg ? 1.2 : 1.0;  // half of the strain precedes the update
  return halves * length / (std::sqrt(order) * wave_speed);
}

// A body whose first particles still have to come from a source is represented by the row that will enter.
template <int Dim>
class RowInstead {
 public:
  RowInstead(System<Dim>& system, std::size_t number) : body_(system.bodies[number]) {
    if (body_.particles.size() > 0) return;
    for (Inflow<Dim>& inflow : system.inflow)
      if (!inflow.row.rigid && inflow.row.body == number) row_ = &inflow.row.particles;
    exchange();
  }
  ~RowInstead() { exchange(); }
  RowInstead(const RowInstead&) = delete;
  RowInstead& operator=(const RowInstead&) = delete;

 private:
  void exchange() {
    if (!row_) return;
    std::swap(body_.particles, *row_);
    body_.refresh();
  }
  Body<Dim>& body_;
  Particles<Dim>* row_ = nullptr;
};

}  // namespace

template <int Dim>
template <class F>
void StepSize<Dim>::each_limit(F&& f) {
  using Cause = StepLimit::Cause;
  const double h = system_.lattice.smallest_spacing();
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    auto& body = system_.bodies[b];
    const RowInstead<Dim> row(system_, b);
    const auto of = static_cast<std::int64_t>(b);
    const Measures m = measure(body);
    if (m.largest_wave_speed > 0) f(model_.time.courant * h / m.largest_wave_speed, StepLimit{Cause::waves, of}, m);
    if (m.largest_wave_speed > 0)
      f(face_limit(model_, system_.lattice, body, m.largest_wave_speed), StepLimit{Cause::faces, of}, m);
    f(viscous_limit(body), StepLimit{Cause::viscosity, of}, m);
    f(conduction_limit(body), StepLimit{Cause::conduction, of}, m);
    f(support_limit(model_, body), StepLimit{Cause::supports, of}, m);
  }
}

template <int Dim>
typename StepSize<Dim>::First StepSize<Dim>::first() {
  First out;
  out.size = std::numeric_limits<double>::infinity();
  each_limit([&](double size, const StepLimit& limit, const Measures& m) {
    out.wave_speed = std::max(out.wave_speed, m.largest_wave_speed);
    if (size < out.size) out.size = size, out.limit = limit;
  });
  if (!(out.wave_speed > 0)) throw SimulationError("no material has a wave speed; the time step cannot be chosen");
  if (model_.time.max_step < out.size) out.size = model_.time.max_step, out.limit = {};
  out.set_by = words(out.limit);
  return out;
}

template <int Dim>
StepLimit StepSize<Dim>::limit() {
  StepLimit out;
  double least = model_.time.max_step;
  const double h = system_.lattice.smallest_spacing();
  each_limit([&](double size, const StepLimit& limit, const Measures& m) {
    if (size < least) least = size, out = limit;
    const double travel = model_.time.velocity_courant * h;
    if (model_.time.adaptive && travel < least * m.largest_speed)
      least = travel / m.largest_speed, out = {StepLimit::Cause::speed, limit.body};
  });
  return out;
}

template <int Dim>
std::string StepSize<Dim>::words(const StepLimit& limit) const {
  using Cause = StepLimit::Cause;
  const std::string of =
      limit.body < 0 ? std::string() : "'" + system_.bodies[static_cast<std::size_t>(limit.body)].name + "'";
  switch (limit.cause) {
    case Cause::time_step:
      return "<TimeStep>";
    case Cause::waves:
      return "the waves in " + of;
    case Cause::faces:
      return "the faces of " + of + " for this scheme";
    case Cause::viscosity:
      return "the viscosity of " + of;
    case Cause::conduction:
      return "the conduction in " + of;
    case Cause::supports:
      return "the elastic supports of " + of;
    case Cause::speed:
      return "the speed of particles of " + of;
    case Cause::joints:
      return "the stiffness of the joints";
  }
  return {};
}

// Explicit diffusion of momentum: dt < h^2 / (2 Dim nu).
template <int Dim>
double StepSize<Dim>::viscous_limit(const Body<Dim>& body) const {
  const double h = system_.lattice.smallest_spacing(), eta = body.law->largest_viscosity();
  if (!(eta > 0)) return std::numeric_limits<double>::infinity();
  return model_.time.courant * h * h * body.law->density() / (2 * Dim * eta);
}

// Explicit diffusion of heat, the same with k / (rho c).
template <int Dim>
double StepSize<Dim>::conduction_limit(const Body<Dim>& body) const {
  const double h = system_.lattice.smallest_spacing();
  if (!model_.heat.conduction || !body.temperature || !(body.conductivity > 0))
    return std::numeric_limits<double>::infinity();
  return model_.time.transport_courant * h * h * body.law->density() * body.heat_capacity /
         (2 * Dim * body.conductivity);
}

template <int Dim>
double StepSize<Dim>::next(double size) {
  static constexpr int every = 10;
  if (!model_.time.adaptive || system_.step % every != 0) return size;
  const Measures all = measure(system_);
  const double h = system_.lattice.smallest_spacing();
  double wanted = std::min(model_.time.max_step, model_.time.courant * h / all.largest_wave_speed);
  for (auto& body : system_.bodies)
    wanted = std::min({wanted, viscous_limit(body), conduction_limit(body), support_limit(model_, body),
                       face_limit(model_, system_.lattice, body, all.largest_wave_speed)});
  if (all.largest_speed > 0) wanted = std::min(wanted, model_.time.velocity_courant * h / all.largest_speed);
  return std::min(wanted, model_.time.max_increase * size);
}

template class StepSize<2>;
template class StepSize<3>;

}  // namespace tribo
