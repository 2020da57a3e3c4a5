// SPDX-License-Identifier: MIT
/// Law of a rock joint: linear elastic springs, then Mohr-Coulomb slip with weakening, dilation, pore pressure, healing
/// and dashpots. Symbols and signs are those of joint_law.hpp; A is the contact area and P the pore pressure.
///
///   elastic step    F_n += k_n A d_n,   F_s -= k_s A d_s
///   strength        N = F_n + A P <= A sigma_c,   |F_s| <= (1-w) F_P + w F_R
///                   F_P = c A - N tan phi,   F_R = c* A - N tan phi*   (peak and residual)
///                   w(slip) rises from 0 at the peak to 1 at the residual strength
///   dilation        while the joint slips, F_n -= k_n A tan psi |d_s|
///
/// Sign of dilation: psi > 0 opens the joint while it slips, in either direction of shear. Between faces that cannot
/// move apart it makes F_n more compressive; under constant F_n the gap grows by tan psi |d_s|.
/// Sign of the initial shear stress: `stress-shear` is the traction on body 2 along +s and +t. It is a restoring
/// traction: a shear displacement of body 2 along +t reduces it.
///
/// docs/joints.md gives the reasons for each branch, and the differences from the published description.

#include "contact/spring_network_law.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr int slips_now = 1, tears_now = 2, slipped = 4, torn_before = 8;

struct Mohr final : JointLaw {
  static constexpr std::string_view name = "Mohr";
  static constexpr std::string_view summary =
      "Rock joint with Mohr-Coulomb slip, weakening, dilation, pore pressure, healing and dashpots.";
  static constexpr int number = 0;
  static constexpr std::string_view example = R"(
<Material Type='Mohr' Name='joint'>
  <stiffness-normal>1e9</stiffness-normal>
  <stiffness-shear>5e8</stiffness-shear>
  <friction>35</friction>
  <friction-residual>30</friction-residual>
  <cohesion>0.2e6</cohesion>
  <tension>0.1e6</tension>
</Material>)";

  double kn = 0, ks = 0;
  double c = 0, c_residual = 0, phi = 0, phi_residual = 0, tension = 0, tension_residual = 0;
  double psi = 0, psi_residual = 0, dilation_zero = std::numeric_limits<double>::infinity();
  double slip_length = 0, healing = 0, constant_pressure = 0, gap_shift = 0, keep_pressure = 0, in_equilibrium = 0;
  PressureFunction pressure_function;
  double normal_stress = 0, normal_force = 0, state_at_start = 0, opening_at_start = 0;
  Tangent shear_stress, shear_force, shear_at_start;
  Dashpots dashpots;
  double dashpot_normal = 0, dashpot_shear = 0, dashpot_mode = 0;
  MultiplierTable table;
  UserAreas own_areas;
  // from the above
  double tan_phi = 0, tan_phi_residual = 0, tan_psi = 0, tan_psi_residual = 0;

  static auto parameters() {
    using L = Mohr;
    using P = Parameter<L>;
    using D = Dimension;
    constexpr Range slope{0.0, 90.0, false, true};
    return std::array{
        P{"stiffness-normal", &L::kn, D::interface_stiffness, not_negative, "normal stiffness per area", 0.0},
        P{"stiffness-shear", &L::ks, D::interface_stiffness, not_negative, "shear stiffness per area", 0.0},
        P{"cohesion", &L::c, D::stress, not_negative, "peak cohesion", 0.0},
        P{"cohesion-residual", &L::c_residual, D::stress, not_negative, "residual cohesion", 0.0},
        P{"friction", &L::phi, D::angle, slope, "peak friction angle", 0.0},
        P{"friction-residual", &L::phi_residual, D::angle, slope, "residual friction angle", 0.0},
        P{"tension", &L::tension, D::stress, not_negative, "peak tensile strength", 0.0},
        P{"tension-residual", &L::tension_residual, D::stress, not_negative, "residual tensile strength", 0.0},
        P{"dilation", &L::psi, D::angle, slope,
          "peak dilation angle; with a positive angle the joint opens while it slips", 0.0},
        P{"dilation-residual", &L::psi_residual, D::angle, slope, "residual dilation angle", 0.0},
        P{"dilation-zero",
          &L::dilation_zero,
          D::length,
          not_negative,
          "shear displacement beyond which the joint no longer dilates (default: no limit)",
          {},
          true},
        P{"slip-dc", &L::slip_length, D::length, not_negative,
          "slip over which the strength falls from peak to residual; 0: it falls at once", 0.0},
        P{"healing", &L::healing, D::none, within(0, 1),
          "1: the shear strength is restored when sliding ends; 0: it is not", 0.0},
        P{"pore-pressure", &L::constant_pressure, D::stress, not_negative, "pressure of the pore fluid", 0.0},
        P{"keep-pressure-when-open", &L::keep_pressure, D::none, within(0, 1),
          "1: the pore pressure also acts on open faces; 0: it does not", 0.0},
        P{"pressure-in-equilibrium", &L::in_equilibrium, D::none, within(0, 1),
          "1: the normal stress or force at the start is the effective one, to which the pore pressure is added; 0: it "
          "is the total one",
          0.0},
        P{"rgap", &L::gap_shift, D::length, not_negative, "gap at which the faces count as closed", 0.0},
        P{"dashpot-ratio-normal", &L::dashpot_normal, D::none, within(0, 1),
          "normal dashpot, as a fraction of critical damping", 0.0},
        P{"dashpot-ratio-shear", &L::dashpot_shear, D::none, within(0, 1),
          "shear dashpot, as a fraction of critical damping. It also acts while the joint slides, and limits the speed "
          "of sliding, unless dashpot-mode contains 2",
          0.0},
        P{"dashpot-mode", &L::dashpot_mode, D::none, within(0, 3),
          "limits of the dashpots, a sum of 1 (the normal dashpot exerts no tension) and 2 (no shear dashpot acts "
          "while the joint slides)",
          0.0},
        P{"stress-normal", &L::normal_stress, D::stress, any_value, "normal stress at the start, positive in tension",
          0.0},
        P{"force-normal", &L::normal_force, D::force, any_value,
          "normal force of each contact at the start, instead of stress-normal", 0.0},
        P{"disp-normal", &L::opening_at_start, D::length, any_value, "opening at the start", 0.0},
        P{"state", &L::state_at_start, D::none, within(0, 15),
          "state at the start, a sum of 1 (the joint slips), 2 (it tears, that is, fails in tension), 4 (it slipped "
          "before) and 8 (it tore before)",
          0.0}};
  }
  static std::vector<OwnProperty> own_properties() {
    return {
        {"pore-pressure-function",
         "pore pressure as a function of x, y, z and t [stress], which is added to pore-pressure"},
        {"user_area",
         "area of each contact, instead of the computed one: one number, or a list with one number for each contact of "
         "a crack or interface [length^2]"},
        {"area",
         "without a value: the initial area is kept, which Tribo always does; with a value: the same as user_area"},
        {"slip-table",
         "pairs of a multiplier and a slip [length] in increasing order of slip, instead of slip-dc. Multiplier 1 "
         "means the peak strength, 0 the residual strength"},
        {"stress-shear",
         "shear traction on body 2 at the start along s and t [stress]; a single number is that along t (default 0)"},
        {"force-shear",
         "shear force on body 2 at the start along s and t [force], instead of stress-shear; a single number is that "
         "along t"},
        {"disp-shear",
         "shear displacement at the start along s and t [length]; a single number is that along t (default 0)"},
        {"table-pos", ""},
        {"slip", ""},
        {"stress-effective", ""},
        {"dashpot-force", ""},
        {"state-string", ""}};
  }

  void prepare(const Statement& s, const Units& units, Problems& problems) {
    static constexpr RefusedProperty refused[] = {
        {"table-pos", "selects one entry of <slip-table>; Tribo reads the whole table from <slip-table>"},
        {"slip", "is a result: a column of the output"},
        {"stress-effective", "is a result: a column of the output"},
        {"dashpot-force", "is a result: columns of the output"},
        {"state-string", "is a result; set the number <state> instead"}};
    refuse(s, refused, problems);
    must_be_whole(s, {"healing", "dashpot-mode", "state", "keep-pressure-when-open", "pressure-in-equilibrium"},
                  problems);
    const auto either = [&](const char* a, const char* b) {
      if (s.child(a) && s.child(b))
        problems.add(s.child(b)->origin,
                     "<" + std::string(a) + "> and <" + b + "> exclude each other; give one of them");
    };
    either("stress-normal", "force-normal"), either("stress-shear", "force-shear"), either("slip-dc", "slip-table");
    const auto pair = [&](const char* of, Dimension dimension) {
      const auto v = numbers_of(s, of, 1, 2, problems);
      const double factor = units.factor(dimension);
      return v.empty() ? Tangent{} : v.size() == 1 ? Tangent{0, factor * v[0]} : factor * Tangent{v[0], v[1]};
    };
    shear_stress = pair("stress-shear", Dimension::stress), shear_force = pair("force-shear", Dimension::force);
    shear_at_start = pair("disp-shear", Dimension::length);
    table = MultiplierTable(s, "slip-table", units, problems);
    pressure_function = PressureFunction(s, "pore-pressure-function", units, problems);
    own_areas = UserAreas(s, {"user_area", "area"}, problems);
    dashpots = {dashpot_normal, dashpot_shear, dashpot_mode};
    tan_phi = std::tan(phi), tan_phi_residual = std::tan(phi_residual);
    tan_psi = std::tan(psi), tan_psi_residual = std::tan(psi_residual);
    if (phi > 0 && !s.child("friction-residual"))
      problems.warn(s.child("friction")->origin,
                    "<friction-residual> is not given, so it is 0: this joint is frictionless after its first slip. "
                    "Give <friction-residual>, the same as <friction> if it does not weaken");
    if (tension > 0 && tan_phi > 0 && tension * tan_phi > c)
      problems.warn(s.child("tension")->origin,
                    "<tension> exceeds cohesion/tan(friction), the apex of the shear strength: under a normal stress "
                    "between the two the joint has no shear strength");
  }

  Joint start(const JointSite& site) const override {
    Joint j;
    set_area(j, site, own_areas.of(site.number));
    j.kn = kn, j.ks = ks;
    j.Fn = normal_stress * j.area + normal_force, j.Fs = j.area * shear_stress + shear_force;
    j.pressure = site.pressure;
    if (in_equilibrium > 0) j.Fn -= j.area * pressure_in(j);
    j.gap = site.gap, j.opening = opening_at_start, j.shear = shear_at_start;
    j.state = static_cast<int>(state_at_start);
    j.slips = j.state & slips_now;
    j.shear_weak = j.state != 0, j.torn = (j.state & (tears_now | torn_before)) != 0;
    if (j.state != 0) {
      // A joint that has failed closes at the gap at which its initial force vanishes, and may be open.
      const double overlap_gap = j.gap - gap_shift;
      if (j.Fn != 0 && kn * j.area > 0) j.rest_gap = overlap_gap - j.Fn / (kn * j.area);
      j.away = overlap_gap - j.rest_gap > 0 && !(tension_residual > 0);
    }
    j.strain = j.start = strain_energy(j);
    return j;
  }

  double damping_ratio() const override { return dashpots.largest_ratio(); }
  double pore_pressure(const Vec3& at, double time) const override { return pressure_function.at(at, time); }
  bool has_pore_pressure() const override { return constant_pressure != 0 || pressure_function.given(); }
  double pressure_in(const Joint& j) const { return constant_pressure + j.pressure; }

  static double strain_energy(const Joint& j) {
    return spring_energy(j.Fn, j.Fn, j.kn * j.area) + spring_energy(j.Fs.norm(), j.Fs.norm(), j.ks * j.area);
  }

  /// The weight w, from 0 at the peak to 1 at the residual strength.
  double weakening(const Joint& j) const {
    if (j.torn) return 1.0;
    if (!table.empty()) return 1 - table.at(j.slip);
    if (slip_length > 0) return std::min(j.slip / slip_length, 1.0);
    return j.shear_weak ? 1.0 : 0.0;
  }

  void step(Joint& j, const JointIncrement& d, std::size_t contact, std::vector<JointEvent>& events) const {
    const Joint before = j;
    const double A = j.area, kA = j.kn * A;
    const bool slid = j.state & slips_now;
    if (j.state & slips_now) j.state |= slipped;
    if (j.state & tears_now) j.state |= torn_before;
    j.state &= ~(slips_now | tears_now);
    const bool failed = j.state != 0;
    j.opening += d.normal, j.shear += d.shear, j.gap = d.gap;
    j.pressure = d.pressure;
    const double pressure = pressure_in(j);
    j.slips = false;
    const double overlap_gap = d.gap - gap_shift;
    const auto report_slip = [&] {
      if (j.slips != slid)
        events.push_back({JointEvent::Kind::slip_change, contact, 1, j.slips, false, false, 0.0, 0.0});
    };

    // The first failure, and each one of a joint that had healed, is an event.
    bool whole = !j.shear_weak;
    const auto report_break = [&](int mode, double strength, double force) {
      if (whole && j.shear_weak && (c > 0 || tension > 0))
        events.push_back(
            {JointEvent::Kind::bond_break, contact, mode, false, false, false, strength, before.strain, force});
    };

    if (failed && overlap_gap - j.rest_gap > 0 && !(tension_residual > 0)) {
      // Faces that have separated have torn, also if they had only slipped before: when they close again, no cohesion
      // is left, as after a failure in tension.
      j.shear_weak = j.torn = true;
      j.Fn = keep_pressure > 0 ? -A * pressure : 0.0, j.Fs = {};
      j.dashpot_normal = 0, j.dashpot_shear = {};
      j.strain = keep_pressure > 0 ? strain_energy(j) : 0.0;
      j.away = true;
      add_work(j, before, d);
      report_break(1, 0.0, 0.0);
      report_slip();
      return;
    }
    // When separated faces close again, only their overlap causes pressure.
    const double dn = j.away ? std::max(d.normal, overlap_gap - j.rest_gap) : d.normal;
    j.away = false;

    const double trial = j.Fn + kA * dn;
    double N = trial + A * pressure;
    const double most = A * (failed ? tension_residual : tension);
    const bool tears = N > most;
    if (tears) N = most, j.state |= tears_now;

    double dilated = 0.0, shear_strength = 0.0;
    if (tears && !(tension_residual > 0)) {
      j.Fs = {};
    } else {
      if (slid)
        j.slip += d.shear.norm();
      else if (healing > 0)
        j.slip = 0, j.shear_weak = j.torn = false, whole = true;
      const double w = weakening(j);
      const double peak = c * A - N * tan_phi, residual = c_residual * A - N * tan_phi_residual;
      const double limit = std::max(0.0, peak - (peak - residual) * w);
      shear_strength = A > 0 ? limit / A : 0.0;
      Tangent T = j.Fs - (j.ks * A) * d.shear;
      const double size = T.norm();
      if (size >= limit && size > 0) T *= limit / size, j.slips = true, j.state |= slips_now;
      j.Fs = T;
      if (j.slips && j.shear.norm() < dilation_zero) {
        dilated = (tan_psi - (tan_psi - tan_psi_residual) * w) * d.shear.norm();
        N -= kA * dilated;
      }
    }
    if (!failed && j.state != 0) j.rest_gap = overlap_gap - (kA > 0 ? trial / kA : 0.0);
    j.rest_gap += dilated;
    if (tears) j.torn = true;
    if (j.slips || tears) j.shear_weak = true;
    j.Fn = N - A * pressure;

    j.strain = strain_energy(j);
    if (j.slips) {
      Tangent slid_by = d.shear;
      if (j.ks * A > 0) slid_by += (1 / (j.ks * A)) * (j.Fs - before.Fs);
      j.slid += 0.5 * (before.Fs + j.Fs).dot(slid_by);
    }
    add_work(j, before, d);
    dashpots.act(j, d);
    if (tears)
      report_break(1, failed ? tension_residual : tension, most - A * pressure);
    else
      report_break(2, shear_strength, j.Fs.norm());
    report_slip();
  }

  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>& events) const override {
    for (std::size_t k = 0; k < joints.size(); ++k) step(joints[k], increments[k], k, events);
  }

  void adopt(Joint& j, const JointLaw&, const JointSite& site) const override {
    Joint like = j;
    like.kn = kn, like.ks = ks;
    if (const double area = own_areas.of(site.number); area > 0 && area != j.area) set_area(like, site, area);
    if (j.kn != kn || j.ks != ks || j.area != like.area) restiffen(j, like, j.gap - gap_shift, strain_energy);
  }
  /// Its strengths are those of the peak again.
  bool bond(Joint& j) const override {
    if (j.away || !(j.shear_weak || j.torn)) return false;
    j.state &= slips_now, j.slip = 0, j.shear_weak = j.torn = false;
    return true;
  }
  /// Its strengths are the residual ones from now on.
  bool unbond(Joint& j) const override {
    if (j.torn) return false;
    if (j.state == 0) j.rest_gap = j.gap - gap_shift - (j.kn * j.area > 0 ? j.Fn / (j.kn * j.area) : 0.0);
    j.state |= slipped | torn_before, j.shear_weak = j.torn = true;
    return true;
  }

  std::string state_text(const Joint& j) const override {
    std::string out;
    for (const auto& [bit, word] :
         {std::pair{slips_now, "slip-n"}, {tears_now, "tension-n"}, {slipped, "slip-p"}, {torn_before, "tension-p"}})
      if (j.state & bit) out += (out.empty() ? "" : " ") + std::string(word);
    return out;
  }
  std::vector<std::string_view> own_names() const override { return {"stress_effective"}; }
  std::vector<double> own_values(const Joint& j) const override {
    return {j.area > 0 ? j.Fn / j.area + pressure_in(j) : 0.0};
  }
  double stiffness() const override { return std::max(kn, ks); }
  std::span<const double> user_areas() const override { return own_areas.all(); }
  double proximity() const override { return gap_shift; }
  std::shared_ptr<const JointLaw> with_surface(const SurfaceProperties& surface) const override {
    auto law = std::make_shared<Mohr>(*this);
    if (surface.kn) law->kn = *surface.kn;
    if (surface.ks) law->ks = *surface.ks;
    if (surface.friction) {
      law->phi = law->phi_residual = std::atan(*surface.friction);
      law->tan_phi = law->tan_phi_residual = *surface.friction;
    }
    return law;
  }
  // Springs of the same stiffness with the residual friction and dilation; fluid does not keep its pressure there.
  std::shared_ptr<const JointLaw> for_new_contacts() const override {
    auto law = std::make_shared<SpringNetwork>();
    law->kn = kn, law->ks = ks, law->mu = tan_phi_residual, law->gap_shift = gap_shift;
    law->psi = psi_residual, law->tan_psi = tan_psi_residual, law->dilation_zero = dilation_zero;
    law->dashpots = dashpots;
    return law;
  }
};

}  // namespace

Catalogue<JointLaw>::Item mohr() { return catalogue_item<JointLaw, Mohr, Mohr>({}); }

}  // namespace tribo
