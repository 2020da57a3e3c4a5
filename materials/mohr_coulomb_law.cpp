// SPDX-License-Identifier: MIT
#include "materials/mohr_coulomb_law.hpp"

#include <numbers>

namespace tribo {
namespace {

// Finds x > 0 with x = y(x). For softening y increases with x up to `far()`, its value when the strength is completely
// lost; for hardening y decreases from y(0). One secant step is exact where y is linear. If the material softens faster
// than it can unload elastically there are several solutions; one of them is returned.
template <class Function, class Far>
double increment(Function&& y, Far&& far, double resolution) {
  double x0 = 0, g0 = -y(0);
  double x1 = -g0;
  if (!(x1 > 0)) return 0;
  double low = 0, high = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 100; ++k) {
    const double g1 = x1 - y(x1);
    if (std::abs(g1) <= std::max(1e-14 * x1, resolution)) return x1;
    (g1 < 0 ? low : high) = x1;
    double x2 = x1 - g1 * (x1 - x0) / (g1 - g0);
    if (!(x2 > low && x2 < high) || k > 30) {
      if (std::isinf(high)) high = std::max(2 * x1, 1.000001 * far());
      x2 = 0.5 * (low + high);
    }
    if (x2 == low || x2 == high) return x2;
    x0 = x1, g0 = g1, x1 = x2;
  }
  return x1;
}

}  // namespace

std::array<Parameter<MohrCoulombLaw>, 17> MohrCoulombLaw::parameters() {
  using L = MohrCoulombLaw;
  constexpr Range acute{0, 90, false, true};
  const auto stress = Dimension::stress;
  const auto angle = Dimension::angle;
  const auto none = Dimension::none;
  return {{
      {"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
      {"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
      {"nu", &L::poisson_ratio, none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
      {"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
      {"G", &L::shear_modulus, stress, positive, "shear modulus; with K, instead of E and nu", {}, true},
      {"cohesion", &L::cohesion, stress, not_negative, "cohesion c"},
      {"friction", &L::friction, angle, acute, "angle of internal friction phi"},
      {"dilation", &L::dilation, angle, acute,
       "dilation angle psi, at most the friction angle; with a positive angle the volume increases under plastic shear",
       0.0},
      {"tension",
       &L::tension,
       stress,
       not_negative,
       "tensile strength (default: c cot phi, the apex of the pyramid)",
       {},
       true},
      {"relaxation_time", &L::relaxation_time, Dimension::time, not_negative,
       "relaxation time eta of Duvaut-Lions viscoplasticity; 0: the strength does not depend on the rate", 0.0},
      {"viscosity", &L::viscosity, Dimension::viscosity, not_negative,
       "Perzyna viscosity of the active yield planes, instead of relaxation_time; 0: the strength does not depend on "
       "the rate",
       0.0},
      {"cohesion_residual",
       &L::cohesion_residual,
       stress,
       not_negative,
       "cohesion when the plastic shear reaches softening_end (default: cohesion)",
       {},
       true},
      {"friction_residual",
       &L::friction_residual,
       angle,
       acute,
       "friction angle when the plastic shear reaches softening_end (default: friction)",
       {},
       true},
      {"dilation_residual",
       &L::dilation_residual,
       angle,
       acute,
       "dilation angle when the plastic shear reaches softening_end (default: dilation)",
       {},
       true},
      {"tension_residual",
       &L::tension_residual,
       stress,
       not_negative,
       "tensile strength when the plastic tension strain reaches softening_end; it needs tension (default: tension)",
       {},
       true},
      {"softening_start", &L::softening_start, none, not_negative, "plastic shear strain at which softening starts",
       0.0},
      {"softening_end", &L::softening_end, none, positive, "plastic shear strain at which softening ends", {}, true},
  }};
}

void MohrCoulombLaw::prepare(const Statement& statement, Problems& problems) {
  elastic = elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus}, false, problems);
  const auto origin = [&](std::string_view word) {
    const Statement* child = statement.child(word);
    return child ? child->origin : statement.origin;
  };
  if (dilation > friction)
    problems.add(origin("dilation"), "<dilation> must not exceed <friction>: the flow would create energy");
  if (cohesion == 0 && friction == 0)
    problems.add(origin("cohesion"), "<cohesion> and <friction> are both 0: the material would have no strength");
  if (relaxation_time > 0 && viscosity > 0)
    problems.add(origin("viscosity"), "<relaxation_time> and <viscosity> exclude each other; give one");
  check_softening(statement, problems);
  pyramid_.emplace(elastic, limit(cohesion, friction, dilation, tension));
}

void MohrCoulombLaw::weaken(double factor) {
  for (double* stress : {&cohesion, &cohesion_residual, &tension, &tension_residual})
    if (given(*stress)) *stress /= factor;
  for (double* angle : {&friction, &friction_residual}) *angle = std::atan(std::tan(*angle) / factor);
  dilation = std::min(dilation, friction), dilation_residual = std::min(dilation_residual, friction_residual);
  pyramid_.emplace(elastic, limit(cohesion, friction, dilation, tension));
}

void MohrCoulombLaw::check_softening(const Statement& statement, Problems& problems) {
  const auto origin = [&](std::string_view word) {
    const Statement* child = statement.child(word);
    return child ? child->origin : statement.origin;
  };
  angles_soften_ = given(friction_residual) || given(dilation_residual);
  tension_softens_ = given(tension_residual);
  softens_ = angles_soften_ || tension_softens_ || given(cohesion_residual);
  if (softens_ && !given(softening_end))
    problems.add(statement.origin,
                 "residual strengths need <softening_end>, the plastic shear at which they are reached");
  if (!softens_ && given(softening_end))
    problems.add(origin("softening_end"),
                 "<softening_end> needs at least one of cohesion_residual, friction_residual, dilation_residual, "
                 "tension_residual");
  if (given(softening_end) && !(softening_end > softening_start))
    problems.add(origin("softening_end"), "<softening_end> must exceed <softening_start>");
  if (tension_softens_ && !given(tension))
    problems.add(origin("tension_residual"), "<tension_residual> needs <tension>, the strength before softening");
  if (!given(cohesion_residual)) cohesion_residual = cohesion;
  if (!given(friction_residual)) friction_residual = friction;
  if (!given(dilation_residual)) dilation_residual = dilation;
  if (!given(tension_residual)) tension_residual = tension;
  if (angles_soften_ && dilation_residual > friction_residual)
    problems.add(origin(statement.child("dilation_residual") ? "dilation_residual" : "friction_residual"),
                 "the residual dilation angle must not exceed the residual friction angle");
  if (cohesion_residual == 0 && friction_residual == 0)
    problems.add(origin("cohesion_residual"),
                 std::string(softens_ ? "residual " : "") +
                     "cohesion and friction are both 0: the material would have no strength");
}

Strength MohrCoulombLaw::limit(double c, double phi, double psi, double cut_off) const {
  const double sine = std::sin(phi), cosine = std::cos(phi);
  const double apex = sine > 0 ? c * cosine / sine : std::numeric_limits<double>::infinity();
  return {c, sine, cosine, std::sin(psi), given(cut_off) ? std::min(cut_off, apex) : apex};
}

Strength MohrCoulombLaw::strength(double kappa, double kappa_t) const {
  const auto progress = [&](double k) {
    return std::clamp((k - softening_start) / (softening_end - softening_start), 0.0, 1.0);
  };
  const double x = progress(kappa), x_t = progress(kappa_t);
  const auto between = [](double from, double to, double at) { return from + at * (to - from); };
  const double c = between(cohesion, cohesion_residual, x), cut_off = between(tension, tension_residual, x_t);
  if (angles_soften_ && x > 0)
    return limit(c, between(friction, friction_residual, x), between(dilation, dilation_residual, x), cut_off);
  Strength s = pyramid_->strength();
  s.cohesion = c;
  const double apex =
      s.sin_friction > 0 ? c * s.cos_friction / s.sin_friction : std::numeric_limits<double>::infinity();
  s.tension = given(cut_off) ? std::min(cut_off, apex) : apex;
  return s;
}

// The return with the strength that belongs to the plastic strains at the end of the step (implicit). `share`: the
// fraction of the way from the trial stress to the pyramid that is plastic flow (Duvaut-Lions).
Returned MohrCoulombLaw::return_implicitly(const Triple& trial, double share, double drag,
                                           MohrCoulombState& state) const {
  const double before = state.plastic_shear, before_t = state.tension_strain;
  const auto shear_of = [&](const Returned& r) {
    const double d0 = trial[0] - r.stress[0], d1 = trial[1] - r.stress[1], d2 = trial[2] - r.stress[2];
    const double mean = (d0 + d1 + d2) / 3;
    const double square = (d0 - mean) * (d0 - mean) + (d1 - mean) * (d1 - mean) + (d2 - mean) * (d2 - mean);
    return share * std::sqrt(0.5 * square) / (2 * elastic.mu);
  };
  Returned now{};
  if (!softens_) {
    now = pyramid_->nearest(trial, drag);
    state.plastic_shear += shear_of(now);
    state.tension_strain += share * now.opening;
    state.opening += share * now.opening;
    return now;
  }
  const auto attempt = [&](double dk, double dt) {
    now = Pyramid(elastic, strength(before + dk, before_t + dt)).nearest(trial, drag);
  };
  constexpr double all = std::numeric_limits<double>::infinity();
  const auto with_opening = [&](double opened) {
    const auto sheared = [&](double dk) { return attempt(dk, opened), shear_of(now); };
    return increment(
        sheared, [&] { return sheared(all); }, 1e-16 * before);
  };
  double opened = 0;
  if (tension_softens_) {
    const auto open = [&](double dt) { return with_opening(dt), share * now.opening; };
    const auto far = [&] { return attempt(all, all), share * now.opening; };
    opened = increment(open, far, 1e-16 * before_t);
  }
  // If the material softens faster than it unloads, the increments can be those of a jump along the softening branch.
  // The stress is then computed with the strength at these increments.
  const double sheared = with_opening(opened);
  attempt(sheared, opened);
  state.plastic_shear += sheared;
  state.tension_strain += opened;
  state.opening += share * now.opening;
  return now;
}

Triple MohrCoulombLaw::close(const Triple& trial, MohrCoulombState& state) const {
  Triple change{};
  if (!cohesionless() || !(state.opening > 0)) return change;
  const double mean = (trial[0] + trial[1] + trial[2]) / 3;
  const double strain = std::clamp(-mean / elastic.bulk(), 0.0, state.opening);
  state.opening -= strain, state.plastic_volume -= strain;
  change.fill(elastic.bulk() * strain);
  return change;
}

Triple MohrCoulombLaw::flow(const Triple& trial, double dt, double J, MohrCoulombState& state) const {
  const double share = dt / (dt + relaxation_time);  // b/(1 + b), b = dt/eta
  const Returned back = return_implicitly(trial, share, viscosity > 0 ? viscosity / dt : 0.0, state);
  Triple change;
  for (std::size_t i = 0; i < 3; ++i) change[i] = share * (trial[i] - back.stress[i]);
  // plastic strain increment C^-1 : change
  const double mean = (change[0] + change[1] + change[2]) / 3, volume = mean / elastic.bulk();
  double work = 0;
  for (std::size_t i = 0; i < 3; ++i)
    work += (trial[i] - change[i]) * ((change[i] - mean) / (2 * elastic.mu) + volume / 3);
  state.plastic_volume += volume;
  state.dissipation += J * work;
  return change;
}

Mat3 MohrCoulombLaw::stress(const Motion& motion, const Mat3& old, MohrCoulombState& state) const {
  Mat3 trial = elastic_trial(elastic, motion, old);
  Principal p = principal(trial);
  const auto add = [&p](Mat3& to, const Triple& change, double sign) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n(p.axis[k][0], p.axis[k][1], p.axis[k][2]);
      to += sign * change[k] * n * n.transpose();
    }
  };
  if (state.opening > 0) {
    add(trial, close(p.value, state), 1.0);
    p = principal(trial);
  }
  if (!Pyramid(elastic, softens_ ? strength(state.plastic_shear, state.tension_strain) : pyramid_->strength())
           .yields(p.value[0], p.value[2]))
    return trial;
  const Triple change = flow(p.value, motion.dt, motion.F.determinant(), state);
  add(trial, change, -1.0);
  return trial;
}

}  // namespace tribo
