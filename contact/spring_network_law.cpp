// SPDX-License-Identifier: MIT
/// What a bond of the spring network does in a step.

#include "contact/spring_network_law.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

Tangent bend(const Joint& j, const Tangent& turn) {
  const auto& k = j.bend_stiffness;
  return {k[0] * turn.s + k[2] * turn.t, k[2] * turn.s + k[1] * turn.t};
}
/// The elastic rotation that belongs to a bending moment. Directions without stiffness do not rotate.
Tangent turn(const Joint& j, const Tangent& m) {
  const auto& k = j.bend_stiffness;
  const double det = k[0] * k[1] - k[2] * k[2];
  if (det > 0) return {(k[1] * m.s - k[2] * m.t) / det, (k[0] * m.t - k[2] * m.s) / det};
  return {k[0] > 0 ? m.s / k[0] : 0.0, k[1] > 0 ? m.t / k[1] : 0.0};
}

// With the fictitious stress the stored energy of a bond is half the product of total and elastic force. Summed over
// the bonds of a body this equals 1/2 sigma : epsilon.
double strain_energy(const Joint& j) {
  const double kA = j.kn * j.area, sA = j.ks * j.area;
  return spring_energy(j.Fn, j.Fn - j.poisson_normal, kA) +
         (sA > 0 ? 0.5 * j.Fs.dot(j.Fs - j.poisson_shear) / sA : 0.0) + 0.5 * j.Mb.dot(turn(j, j.Mb)) +
         spring_energy(j.Mt, j.Mt, j.twist_stiffness);
}

/// Scales `f` down to the magnitude `limit`. Returns true if it was larger.
bool clip(Tangent& f, double limit) {
  const double size = f.norm();
  if (!(size > limit)) return false;
  f *= limit / size;
  return true;
}

/// Adds the work dissipated by friction in the step from the state `before`; it is negative.
void add_friction(Joint& j, const Joint& before, const JointIncrement& d) {
  if (j.slips) {
    Tangent by = d.shear;
    if (j.ks * j.area > 0) by += (1 / (j.ks * j.area)) * (j.Fs - before.Fs);
    j.slid += 0.5 * (before.Fs + j.Fs).dot(by);
  }
  if (j.bends) j.slid += 0.5 * (before.Mb + j.Mb).dot(d.bend + turn(j, j.Mb - before.Mb));
  if (j.twists)
    j.slid +=
        0.5 * (before.Mt + j.Mt) * (d.twist + (j.twist_stiffness > 0 ? (j.Mt - before.Mt) / j.twist_stiffness : 0.0));
}

}  // namespace

Joint SpringNetwork::start(const JointSite& site) const {
  Joint j;
  JointSite here = site;
  here.radius *= radius_factor;
  set_area(j, here, own_areas.of(site.number));
  const auto [is, it, ist, polar] = stiffness_moments(j, here);
  j.kn = kn, j.ks = ks;
  j.twist_stiffness = krot_n, j.bend_stiffness = {krot_s, krot_t, 0.0};
  if (turns_with_area && !site.part_of_face)
    j.twist_stiffness = ks * polar, j.bend_stiffness = {kn * is, kn * it, -kn * ist};
  if (methods.modulus) {
    const double per_length = *methods.modulus / site.distance;
    j.kn = j.ks = per_length;
    if (!site.part_of_face || methods.bond)
      j.twist_stiffness = per_length * polar, j.bend_stiffness = {per_length * is, per_length * it, -per_length * ist};
  }
  j.gap = site.gap;
  if (!force.empty()) j.Fn = -force[0], j.Fs = {force[1], force[2]};
  j.pressure = site.pressure;
  if (in_equilibrium > 0) j.Fn -= j.area * pressure_in(j);
  if (!moment.empty()) j.Mt = moment[0], j.Mb = {moment[1], moment[2]};
  if (methods.bond && methods.bond->contains(site.gap))
    j.state = bonded, j.poisson_normal = site.poisson_normal, j.poisson_shear = site.poisson_shear;
  if (methods.unbond && methods.unbond->contains(site.gap)) {
    j.state = loose, j.poisson_normal = 0, j.poisson_shear = {};
    // The given force belongs to this gap. Without one, faces that overlap press on each other.
    if (j.Fn != 0 && j.kn * j.area > 0) j.rest_gap = site.gap - gap_shift - j.Fn / (j.kn * j.area);
  }
  j.away = j.state == loose && site.gap - gap_shift - j.rest_gap > 0;
  j.strain = j.start = strain_energy(j);
  return j;
}

// The factors by which a change of the law or of the area changes stiffnesses are the same for all contacts, so that
// those with an area or a shape of their own keep it.
void SpringNetwork::adopt(Joint& j, const JointLaw& former, const JointSite& site) const {
  const auto* before = dynamic_cast<const SpringNetwork*>(&former);
  if (!before) return;
  Joint like = j;
  if (const double area = own_areas.of(site.number); area > 0 && area != j.area) set_area(like, site, area);
  const auto ratio = [](double now, double then) { return then > 0 ? now / then : 1.0; };
  if (methods.modulus && before->methods.modulus) {
    const double stiffer = *methods.modulus / *before->methods.modulus;
    like.kn *= stiffer, like.ks *= stiffer;
  } else if (methods.modulus) {
    like.kn = like.ks = *methods.modulus / site.distance;
  } else if (before->methods.modulus) {
    like.kn = kn, like.ks = ks;
  } else {
    like.kn *= ratio(kn, before->kn), like.ks *= ratio(ks, before->ks);
  }
  if (!turns_with_area) {
    like.twist_stiffness = krot_n, like.bend_stiffness = {krot_s, krot_t, 0.0};
  } else if (before->turns_with_area) {
    like.twist_stiffness *= ratio(like.ks, j.ks) * ratio(like.polar, j.polar);
    for (double& k : like.bend_stiffness) k *= ratio(like.kn, j.kn) * ratio(like.inertia, j.inertia);
  } else {
    const bool alone = !site.part_of_face;
    like.twist_stiffness = alone ? like.ks * like.polar : 0.0;
    like.bend_stiffness = {alone ? like.kn * like.inertia : 0.0, alone ? like.kn * like.inertia : 0.0, 0.0};
  }
  const auto same = [&](double Joint::*of) { return like.*of == j.*of; };
  if (same(&Joint::kn) && same(&Joint::ks) && same(&Joint::area) && same(&Joint::twist_stiffness) &&
      like.bend_stiffness == j.bend_stiffness)
    return;
  restiffen(j, like, j.gap - gap_shift, strain_energy);
}

// The fictitious stress that a new bond would start with is not known.
bool SpringNetwork::bond(Joint& j) const {
  if (j.state >= bonded || j.away || nu != 0) return false;
  j.state = bonded, j.elongation = j.onset = j.slip = 0;
  j.poisson_normal = 0, j.poisson_shear = {};
  j.slips = j.bends = j.twists = false;
  return true;
}

bool SpringNetwork::unbond(Joint& j) const {
  if (j.state < bonded) return false;
  break_bond(j, loose, j.gap - gap_shift);
  return true;
}

double SpringNetwork::proximity() const {
  const double bonds = methods.bond ? methods.bond->high : 0.0;
  return std::max({0.0, gap_shift, bonds});
}

// A stiffness that is computed from a modulus is replaced as a whole.
std::shared_ptr<const JointLaw> SpringNetwork::with_surface(const SurfaceProperties& surface) const {
  auto law = std::make_shared<SpringNetwork>(*this);
  if (methods.modulus && (surface.kn || surface.ks)) {
    law->methods.modulus.reset();
    law->kn = surface.kn.value_or(*surface.ks), law->ks = surface.ks.value_or(*surface.kn);
  }
  if (surface.kn) law->kn = *surface.kn;
  if (surface.ks) law->ks = *surface.ks;
  if (surface.friction) law->mu = *surface.friction;
  return law;
}

std::shared_ptr<const JointLaw> SpringNetwork::for_new_contacts() const {
  auto law = std::make_shared<SpringNetwork>(*this);
  law->methods.bond.reset(), law->methods.unbond.reset();
  law->force.clear(), law->moment.clear(), law->own_areas = {};
  law->mode = law->nu = law->constant_pressure = 0;
  law->pressure_function = {};
  return law;
}

double SpringNetwork::rim_stress(const Joint& j) const {
  return j.Fn / j.area + moment_share * j.radius / j.inertia * j.Mb.norm() + pressure_in(j);
}

double SpringNetwork::rim_shear(const Joint& j) const {
  return j.Fs.norm() / j.area + (j.polar > 0 ? moment_share * std::abs(j.Mt) * j.radius / j.polar : 0.0);
}

double SpringNetwork::shear_strength(const Joint& j) const {
  return std::max(0.0, c - (j.Fn / j.area + pressure_in(j)) * tan_phi);
}

bool SpringNetwork::soften(Joint& j) const {
  const double sigma = rim_stress(j);
  double strength = tension * remaining(tension_table, tension_length, j.elongation);
  if (sigma < strength) {
    j.state = unloaded;
    return false;
  }
  j.elongation += (sigma - strength) / j.kn;
  strength = tension * remaining(tension_table, tension_length, j.elongation);
  j.state = softening;
  const double factor = sigma > 0 ? strength / sigma : 0.0, pressed = j.area * pressure_in(j);
  j.Fn = (j.Fn + pressed) * factor - pressed;
  j.Mb *= factor;
  return !(strength > 0);
}

SpringNetwork::Break SpringNetwork::update_bonded(Joint& j, const JointIncrement& d, double energy_before) const {
  const bool poisson = j.state != healed;
  const double fn = poisson ? d.poisson_normal : 0.0;
  const Tangent fs = poisson ? d.poisson_shear : Tangent{};
  j.Fn += j.kn * j.area * d.normal + fn - j.poisson_normal;
  j.Fs += fs - j.poisson_shear - (j.ks * j.area) * d.shear;
  j.poisson_normal = fn, j.poisson_shear = fs;
  j.Mb -= bend(j, d.bend), j.Mt -= j.twist_stiffness * d.twist;
  j.slips = j.bends = j.twists = false;

  Break out;
  const bool may_soften = tension_length > 0 || !tension_table.empty();
  const double pull = j.Fn;
  if (j.state == healed) {
    if (rim_stress(j) > 0) out = {1, 0.0, j.Fn};  // healed bonds have no tensile strength
  } else if (j.state == bonded) {
    if (rim_stress(j) > tension) {
      j.onset = strain_energy(j);
      if (!may_soften || soften(j)) out = {1, tension, pull};
    }
  } else if (const double strength = tension * remaining(tension_table, tension_length, j.elongation); soften(j)) {
    out = {1, strength, pull};
  }
  if (out.mode == 0 && rim_shear(j) > shear_strength(j)) {
    if (j.state == bonded || j.state == healed) j.onset = strain_energy(j);
    out = {2, shear_strength(j), j.Fs.norm()};
  }
  if (out.mode == 1 && j.state == healed) j.onset = energy_before;
  return out;
}

void SpringNetwork::break_bond(Joint& j, int mode_of_break, double overlap_gap) {
  j.state = mode_of_break;
  j.poisson_normal = 0, j.poisson_shear = {};
  j.slip = 0;
  j.rest_gap = overlap_gap - (j.kn * j.area > 0 ? j.Fn / (j.kn * j.area) : 0.0);
}

void SpringNetwork::update_unbonded(Joint& j, const JointIncrement& d, bool fresh, bool slid,
                                    double overlap_gap) const {
  const double A = j.area, kA = j.kn * A, pressed = A * pressure_in(j);
  if (fresh) {
    j.Fn = std::min(j.Fn + pressed, 0.0) - pressed;
  } else {
    // When separated faces close again, only their overlap causes pressure.
    const double dn = j.away ? std::max(d.normal, overlap_gap - j.rest_gap) : d.normal;
    j.Fn = mode > 0 ? std::min(j.Fn + kA * dn + pressed, 0.0) - pressed : kA * std::min(overlap_gap - j.rest_gap, 0.0);
    j.Fs -= (j.ks * A) * d.shear;
    j.Mt -= j.twist_stiffness * d.twist, j.Mb -= bend(j, d.bend);
    if (slid) j.slip += d.shear.norm();
  }
  j.away = false;
  const double N = std::min(j.Fn + pressed, 0.0);
  const double residual = -mu * N + (j.state == sheared ? c_residual * A : 0.0);
  double limit = residual;
  if (j.state == sheared && (shear_length > 0 || !shear_table.empty()))
    limit += (std::max(0.0, c * A - N * tan_phi) - residual) * remaining(shear_table, shear_length, j.slip);
  j.slips = clip(j.Fs, std::max(limit, 0.0));
  if (j.slips && !fresh && j.shear.norm() < dilation_zero) {
    const double dilated = tan_psi * d.shear.norm();
    j.rest_gap += dilated, j.Fn -= kA * dilated;
  }
  j.bends = clip(j.Mb, 2.1 * bend_factor * -N * j.radius / 4);
  const double most = 0.65 * twist_factor * mu * -N * j.radius;
  j.twists = j.polar > 0 && std::abs(j.Mt) > most;
  if (j.twists) j.Mt = std::copysign(most, j.Mt);
  if (heals > 0 && (j.state == torn || j.state == sheared) && slid && !j.slips && N < 0) j.state = healed;
}

void SpringNetwork::step(Joint& j, const JointIncrement& d, std::size_t contact,
                         std::vector<JointEvent>& events) const {
  using Kind = JointEvent::Kind;
  const Joint before = j;
  j.opening += d.normal, j.shear += d.shear, j.gap = d.gap;
  j.pressure = d.pressure;
  const double overlap_gap = d.gap - gap_shift;
  const auto report_slip = [&] {
    const bool s = j.slips != before.slips, b = j.bends != before.bends, t = j.twists != before.twists;
    constexpr int code[] = {0, 1, 2, 4, 3, 5, 6, 7};  // by shear 1, bend 2, twist 4
    if (const int which = code[(s ? 1 : 0) + (b ? 2 : 0) + (t ? 4 : 0)])
      events.push_back({Kind::slip_change, contact, which, j.slips, j.twists, j.bends, 0.0, 0.0});
  };
  if (j.state < bonded && overlap_gap - j.rest_gap > 0) {
    j.Fn = j.Mt = 0, j.Fs = j.Mb = {};
    j.dashpot_normal = 0, j.dashpot_shear = {};
    j.slips = j.bends = j.twists = false;
    j.strain = 0, j.away = true;
    add_work(j, before, d);
    report_slip();
    return;
  }
  if (j.away) events.push_back({Kind::activated, contact, 0, false, false, false, 0.0, 0.0});
  Break broke;
  if (j.state >= bonded) {
    broke = update_bonded(j, d, before.strain);
    if (broke.mode) break_bond(j, broke.mode, overlap_gap);
  }
  if (j.state < bonded) update_unbonded(j, d, broke.mode != 0, before.slips, overlap_gap);
  j.strain = strain_energy(j);
  if (broke.mode != 1) add_friction(j, before, d);  // energy released by tensile failure is not friction
  add_work(j, before, d);
  dashpots.act(j, d);
  if (broke.mode)
    events.push_back(
        {Kind::bond_break, contact, broke.mode, false, false, false, broke.strength, j.onset, broke.force});
  report_slip();
}

void SpringNetwork::update(std::span<Joint> joints, std::span<const JointIncrement> increments,
                           std::vector<JointEvent>& events) const {
  for (std::size_t k = 0; k < joints.size(); ++k) step(joints[k], increments[k], k, events);
}

std::string SpringNetwork::state_text(const Joint& j) const {
  constexpr const char* names[] = {"unbonded",         "unbonded-tension", "unbonded-shear", "bonded",
                                   "bonded-softening", "bonded-unloaded",  "healed"};
  return names[static_cast<std::size_t>(std::clamp(j.state, 0, 6))];
}

std::vector<std::string_view> SpringNetwork::own_names() const {
  return {"elongation", "sn_shear", "sn_sigma", "sn_esigma", "sn_tau",
          "sn_slip",    "sn_slipb", "sn_slipt", "sn_radius", "kratio"};
}

std::vector<double> SpringNetwork::own_values(const Joint& j) const {
  const bool touches = j.area > 0;  // a face that its block has left behind has no area, and no stress
  const double pressure = pressure_in(j), sigma = touches ? rim_stress(j) : pressure;
  return {j.elongation,
          touches ? shear_strength(j) : 0.0,
          sigma - pressure,
          sigma,
          touches ? rim_shear(j) : 0.0,
          j.slips ? 1.0 : 0.0,
          j.bends ? 1.0 : 0.0,
          j.twists ? 1.0 : 0.0,
          j.radius,
          j.kn > 0 && j.ks > 0 ? j.kn / j.ks : 0.0};
}

}  // namespace tribo
