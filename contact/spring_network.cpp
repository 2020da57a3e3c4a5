// SPDX-License-Identifier: MIT
/// Bond of a spring network: normal, shear, twist and bending springs whose strengths may soften, then friction.
///
///   bonded     F_n += k_n A d_n + dF^f_n,  F_s += dF^f_s - k_s A d_s,  M -= K theta
///              dF^f: the increment of the force of the fictitious stress (see poisson_force in joint_geometry.hpp)
///   failure    sigma = F_n/A + beta |M_b| R/I + P > sigma_c  in tension, or in shear
///              tau = |F_s|/A + beta |M_t| R/J > c - (F_n/A + P) tan phi
///   unbonded   N = min(F_n + A P, 0),  |F_s| <= mu |N|,
///              |M_b| <= 2.1 lambda_b |N| R/4,  |M_t| <= 0.65 lambda_t mu |N| R
///
/// Dilation (`sn_dil` > 0) opens an unbonded contact while it slips. If the faces cannot move apart, F_n becomes more
/// compressive by k_n A tan psi |d_s|.
///
/// docs/joints.md gives the reasons for each branch, and the differences from the published description.

#include "base/text.hpp"
#include "contact/joint_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tribo {
namespace {

enum State : int { loose = 0, torn = 1, sheared = 2, bonded = 3, softening = 4, unloaded = 5, healed = 6 };

/// Methods given in the input, which are applied once before the first step.
struct Methods {
  struct Gaps {
    double low = -std::numeric_limits<double>::infinity(), high = 0.0;
    bool contains(double gap) const { return gap >= low && gap <= high; }
  };
  std::optional<double> modulus;  ///< compute-stiffness; its Poisson's ratio is the law's
  std::optional<Gaps> bond, unbond;
};

struct SpringNetwork final : JointLaw {
  static constexpr std::string_view name = "SpringNetwork";
  static constexpr std::string_view summary =
      "Bond of a spring network with moments, softening, friction and a correction for Poisson's ratio.";
  static constexpr int number = 0;

  double kn = 0, ks = 0, own_area = 0, krot_n = 0, krot_s = 0, krot_t = 0;
  double mu = 0, gap_shift = 0, bend_factor = 1, twist_factor = 1, mode = 0, moment_share = 1;
  double tension = 0, tension_length = 0, c = 0, shear_length = 0, c_residual = 0, phi = 0;
  double psi = 0, dilation_zero = std::numeric_limits<double>::infinity(), heals = 0;
  double non_diagonal = 0, nu = 0, pressure = 0, radius_factor = 1;
  double dashpot_normal = 0, dashpot_shear = 0, dashpot_mode = 0;
  Dashpots dashpots;
  MultiplierTable tension_table, shear_table;
  Methods methods;
  std::vector<double> force, moment;  // at the start: -F_n, F_ss, F_st; M_t, M_bs, M_bt
  double tan_phi = 0, tan_psi = 0;

  static auto parameters() {
    using L = SpringNetwork;
    using P = Parameter<L>;
    using D = Dimension;
    constexpr Range slope{0.0, 90.0, false, true};
    return std::array{
        P{"kn", &L::kn, D::interface_stiffness, not_negative, "normal stiffness per area", 0.0},
        P{"ks", &L::ks, D::interface_stiffness, not_negative, "shear stiffness per area", 0.0},
        P{"user_area", &L::own_area, D::none, not_negative, "area used instead of the computed contact area", 0.0,
          false, "sn_area"},
        P{"fric", &L::mu, D::none, not_negative, "friction coefficient (default: tangent of sn_fa)", 0.0},
        P{"rgap", &L::gap_shift, D::length, any_value, "gap at which the faces count as closed", 0.0},
        P{"sn_bmul", &L::bend_factor, D::none, not_negative,
          "factor of the bending moment limit of an unbonded contact", 1.0},
        P{"sn_tmul", &L::twist_factor, D::none, not_negative, "factor of the twist moment limit of an unbonded contact",
          1.0},
        P{"sn_mode", &L::mode, D::none, within(0, 1),
          "normal force of an unbonded contact: 0 from the gap, 1 by increments; 1 if <bond>, <compute-stiffness> or "
          "<assign-stiffness> is used",
          0.0},
        P{"sn_rmul", &L::radius_factor, D::none, positive, "factor on the radius of balls", 1.0},
        P{"sn_mcf", &L::moment_share, D::none, within(0, 1), "weight beta of the moments in the rim stresses", 1.0},
        P{"sn_ten", &L::tension, D::stress, not_negative, "tensile strength", 0.0},
        P{"sn_tendc", &L::tension_length, D::length, not_negative,
          "elongation from the tensile peak to zero strength; 0: the drop is sudden", 0.0},
        P{"sn_coh", &L::c, D::stress, not_negative, "cohesion", 0.0},
        P{"sn_cohdc", &L::shear_length, D::length, not_negative,
          "slip at which the cohesion has vanished; 0: the drop is sudden", 0.0},
        P{"sn_cohres", &L::c_residual, D::stress, not_negative, "residual cohesion after failure in shear", 0.0},
        P{"sn_fa", &L::phi, D::angle, slope, "friction angle of the bond", 0.0},
        P{"sn_dil", &L::psi, D::angle, slope, "dilation angle, positive: an unbonded contact opens while it slips",
          0.0},
        P{"sn_dilzero",
          &L::dilation_zero,
          D::length,
          not_negative,
          "shear displacement beyond which the contact no longer dilates",
          {},
          true},
        P{"sn_heal", &L::heals, D::none, within(0, 1), "1: a broken bond heals when sliding ends under pressure", 0.0},
        P{"sn_non_diag", &L::non_diagonal, D::none, within(0, 1),
          "factor of the shear components of the fictitious stress", 0.0},
        P{"sn_pois", &L::nu, D::none, between(-1, 1), "Poisson's ratio of the elastic body that the bonds represent",
          0.0},
        P{"sn_porp", &L::pressure, D::stress, any_value, "pressure of pore fluid", 0.0},
        P{"dp_nratio", &L::dashpot_normal, D::none, within(0, 1), "fraction of critical damping", 0.0},
        P{"dp_sratio", &L::dashpot_shear, D::none, within(0, 1), "fraction of critical damping", 0.0},
        P{"dp_mode", &L::dashpot_mode, D::none, within(0, 3),
          "sum of 1 (no tension by the normal dashpot) and 2 (no shear dashpot while sliding)", 0.0}};
  }
  static std::vector<OwnProperty> own_properties() {
    return {
        {"krot", "rotational stiffnesses about n, s, t; one number: about s (two dimensions)"},
        {"sn_tentab", "pairs of multiplier and elongation, sorted by elongation, instead of sn_tendc"},
        {"sn_cohtab", "pairs of multiplier and slip, sorted by slip, instead of sn_cohdc"},
        {"sn_force", "forces of each contact at the start: -F_n, F_ss, F_st"},
        {"sn_moment", "moments of each contact at the start: M_t, M_bs, M_bt"},
        {"area", "method without a value: the initial area is kept, as is always the case in Tribo"},
        {"compute-stiffness",
         "'emod E poisson nu': kn = ks = E/d of an elastic body, d the distance between the block centres"},
        {"assign-stiffness", "'kn k kratio kappa': kn = k and ks = k/kappa, no rotational stiffness"},
        {"bond",
         "bonds contacts; 'gap g': those with a gap of at most g (default 0); 'gap a b': those with a gap from a to b"},
        {"unbond", "removes the bond of contacts, selected as in bond"},
        {"sn_tabpos", ""},
        {"emod", ""},
        {"kratio", ""},
        {"sn_radius", ""},
        {"sn_state", ""},
        {"sn_shear", ""},
        {"sn_sigma", ""},
        {"sn_esigma", ""},
        {"sn_tau", ""},
        {"sn_ndisp", ""},
        {"sn_sdisp", ""},
        {"sn_slip", ""},
        {"sn_slipb", ""},
        {"sn_slipt", ""},
        {"sn_pois_force", ""},
        {"dp_force", ""}};
  }

  /// Values of `words` in the text of a method, `word value(s) word value(s)`.
  static std::vector<std::vector<double>> arguments(const Statement& s, const std::vector<std::string>& words,
                                                    Problems& problems) {
    std::vector<std::vector<double>> out(words.size());
    std::vector<double>* current = nullptr;
    std::string text = s.text;
    std::replace(text.begin(), text.end(), ',', ' ');  // scripts separate words by commas
    for (const auto& word : words_of(text)) {
      const auto known = std::find(words.begin(), words.end(), word);
      const auto value = to_number(word);
      if (known != words.end())
        current = &out[static_cast<std::size_t>(known - words.begin())];
      else if (value && current)
        current->push_back(*value);
      else
        problems.add(s.text_origin, "<" + s.name + "> has no argument '" + word + "'" + did_you_mean(word, words) +
                                        "; it is followed by " + join(words, " and ") + ", each with its number");
    }
    return out;
  }

  void read_stiffness(const Statement& s, const Units& units, Problems& problems) {
    const Statement *compute = s.child("compute-stiffness"), *assign = s.child("assign-stiffness");
    if (compute && assign)
      problems.add(assign->origin, "<compute-stiffness> and <assign-stiffness> exclude each other; give one of them");
    for (const Statement* m : {compute, assign})
      for (const char* other : {"kn", "ks", "krot"})
        if (m && s.child(other))
          problems.add(s.child(other)->origin, "<" + m->name + "> sets <" + other + ">; leave one of them out");
    if (compute) {
      const auto v = arguments(*compute, {"emod", "poisson"}, problems);
      if (v[0].size() != 1 || v[1].size() > 1 || !(v[0].front() > 0))
        problems.add(compute->origin, "<compute-stiffness> needs 'emod E', positive, and perhaps 'poisson nu'");
      else
        methods.modulus = v[0].front() * units.factor(Dimension::stress);
      if (v[1].size() == 1) {
        nu = v[1].front();
        if (!(nu > -1 && nu < 1)) problems.add(compute->origin, "<compute-stiffness>: poisson must be in (-1, 1)");
      }
    }
    if (assign) {
      const auto v = arguments(*assign, {"kn", "kratio"}, problems);
      if (v[0].size() != 1 || v[1].size() != 1 || v[0].front() < 0 || v[1].front() < 0) {
        problems.add(assign->origin, "<assign-stiffness> needs 'kn k kratio kappa', not negative; kappa is kn/ks");
      } else {
        kn = v[0].front() * units.factor(Dimension::interface_stiffness);
        ks = v[1].front() > 0 ? kn / v[1].front() : 0.0;
        nu = 0;
      }
    }
    if (compute || assign) mode = 1;
  }

  std::optional<Methods::Gaps> gaps(const Statement& s, const char* method, const Units& units,
                                    Problems& problems) const {
    const Statement* m = s.child(method);
    if (!m) return std::nullopt;
    Methods::Gaps out;
    const auto v = arguments(*m, {"gap"}, problems)[0];
    const double length = units.factor(Dimension::length);
    if (v.size() > 2 || (v.size() == 2 && v[0] > v[1]))
      problems.add(m->origin, "<" + m->name + "> takes 'gap g', the largest gap, or 'gap a b' with a <= b");
    else if (!v.empty())
      out = {v.size() == 2 ? v[0] * length : out.low, v.back() * length};
    return out;
  }

  void prepare(const Statement& s, const Units& units, Problems& problems) {
    static constexpr std::string_view result = "is a result: a column of the output";
    static constexpr RefusedProperty refused[] = {
        {"sn_tabpos", "selects one entry of a table; Tribo reads the whole table from <sn_tentab> or <sn_cohtab>"},
        {"emod", "is a result; set it by <compute-stiffness>emod E poisson nu</compute-stiffness>"},
        {"kratio", "is a result; set it by <assign-stiffness>kn k kratio kappa</assign-stiffness>"},
        {"sn_radius", "is a result: it follows from the area, or from <sn_rmul> and the radii of the balls"},
        {"sn_state", "is a result; set it by <bond/> or <unbond/>"},
        {"sn_shear", result},
        {"sn_sigma", result},
        {"sn_esigma", result},
        {"sn_tau", result},
        {"sn_ndisp", result},
        {"sn_sdisp", result},
        {"sn_slip", result},
        {"sn_slipb", result},
        {"sn_slipt", result},
        {"sn_pois_force", result},
        {"dp_force", result}};
    refuse(s, refused, problems);
    must_be_whole(s, {"sn_mode", "sn_heal", "dp_mode"}, problems);
    read_stiffness(s, units, problems);
    methods.bond = gaps(s, "bond", units, problems), methods.unbond = gaps(s, "unbond", units, problems);
    if (methods.bond) mode = 1;
    for (const auto& [length, of] : {std::pair{"sn_tendc", "sn_tentab"}, {"sn_cohdc", "sn_cohtab"}})
      if (s.child(length) && s.child(of))
        problems.add(s.child(length)->origin,
                     "<" + std::string(length) + "> and <" + of + "> exclude each other; give one of them");
    tension_table = MultiplierTable(s, "sn_tentab", units, problems);
    shear_table = MultiplierTable(s, "sn_cohtab", units, problems);
    const auto rotation = numbers_of(s, "krot", 1, 3, problems);
    if (rotation.size() == 1) krot_s = rotation[0];
    if (rotation.size() == 3) krot_n = rotation[0], krot_s = rotation[1], krot_t = rotation[2];
    if (rotation.size() == 2)
      problems.add(s.child("krot")->origin, "<krot> needs one number (about s) or three (about n, s, t)");
    for (const double k : rotation)
      if (k < 0) problems.add(s.child("krot")->origin, "<krot> must not be negative");
    force = numbers_of(s, "sn_force", 3, 3, problems), moment = numbers_of(s, "sn_moment", 3, 3, problems);
    for (double& f : force) f *= units.factor(Dimension::force);
    for (double& m : moment) m *= units.factor(Dimension::force) * units.factor(Dimension::length);
    dashpots = {dashpot_normal, dashpot_shear, dashpot_mode};
    tan_phi = std::tan(phi), tan_psi = std::tan(psi);
    if (phi > 0 && !s.child("fric")) mu = tan_phi;
  }

  Joint start(const JointSite& site) const override {
    Joint j;
    JointSite here = site;
    here.radius *= radius_factor;
    set_area(j, here, own_area);
    const auto [is, it, ist, polar] = stiffness_moments(j, here);
    j.kn = kn, j.ks = ks;
    j.twist_stiffness = krot_n, j.bend_stiffness = {krot_s, krot_t, 0.0};
    if (methods.modulus) {
      const double per_length = *methods.modulus / site.distance;
      j.kn = j.ks = per_length;
      j.twist_stiffness = per_length * polar, j.bend_stiffness = {per_length * is, per_length * it, -per_length * ist};
    }
    j.gap = site.gap;
    if (!force.empty()) j.Fn = -force[0], j.Fs = {force[1], force[2]};
    if (!moment.empty()) j.Mt = moment[0], j.Mb = {moment[1], moment[2]};
    if (methods.bond && methods.bond->contains(site.gap))
      j.state = bonded, j.poisson_normal = site.poisson_normal, j.poisson_shear = site.poisson_shear;
    if (methods.unbond && methods.unbond->contains(site.gap)) {
      j.state = loose, j.poisson_normal = 0, j.poisson_shear = {};
      if (j.kn * j.area > 0) j.rest_gap = site.gap - gap_shift - j.Fn / (j.kn * j.area);
    }
    j.away = j.state == loose && site.gap - gap_shift - j.rest_gap > 0;
    j.strain = j.start = strain_energy(j);
    return j;
  }

  static Tangent bend(const Joint& j, const Tangent& turn) {
    const auto& k = j.bend_stiffness;
    return {k[0] * turn.s + k[2] * turn.t, k[2] * turn.s + k[1] * turn.t};
  }
  /// The elastic rotation that belongs to a bending moment. Directions without stiffness do not rotate.
  static Tangent turn(const Joint& j, const Tangent& m) {
    const auto& k = j.bend_stiffness;
    const double det = k[0] * k[1] - k[2] * k[2];
    if (det > 0) return {(k[1] * m.s - k[2] * m.t) / det, (k[0] * m.t - k[2] * m.s) / det};
    return {k[0] > 0 ? m.s / k[0] : 0.0, k[1] > 0 ? m.t / k[1] : 0.0};
  }

  // With the fictitious stress the stored energy of a bond is half the product of total and elastic force. Summed over
  // the bonds of a body this equals 1/2 sigma : epsilon.
  static double strain_energy(const Joint& j) {
    const double kA = j.kn * j.area, sA = j.ks * j.area;
    return spring_energy(j.Fn, j.Fn - j.poisson_normal, kA) +
           (sA > 0 ? 0.5 * j.Fs.dot(j.Fs - j.poisson_shear) / sA : 0.0) + 0.5 * j.Mb.dot(turn(j, j.Mb)) +
           spring_energy(j.Mt, j.Mt, j.twist_stiffness);
  }

  /// Effective normal stress at the rim of the contact [stress], tension positive.
  double rim_stress(const Joint& j) const {
    return j.Fn / j.area + moment_share * j.Mb.norm() * j.radius / j.inertia + pressure;
  }
  /// Shear stress at the rim [stress].
  double rim_shear(const Joint& j) const {
    return j.Fs.norm() / j.area + (j.polar > 0 ? moment_share * std::abs(j.Mt) * j.radius / j.polar : 0.0);
  }
  double shear_strength(const Joint& j) const { return std::max(0.0, c - (j.Fn / j.area + pressure) * tan_phi); }

  struct Break {
    int mode = 0;  // 0: none, 1: in tension, 2: in shear
    double strength = 0.0;
  };

  /// Scales a softening bond back to its strength envelope. Returns true if no tensile strength remains.
  bool soften(Joint& j) const {
    const double sigma = rim_stress(j);
    double strength = tension * remaining(tension_table, tension_length, j.elongation);
    if (sigma < strength) {
      j.state = unloaded;
      return false;
    }
    j.elongation += (sigma - strength) / j.kn;
    strength = tension * remaining(tension_table, tension_length, j.elongation);
    j.state = softening;
    const double factor = sigma > 0 ? strength / sigma : 0.0, pressed = j.area * pressure;
    j.Fn = (j.Fn + pressed) * factor - pressed;
    j.Mb *= factor;
    return !(strength > 0);
  }

  /// Step of a bonded contact: elastic increments, then the strength criteria. Returns the mode of failure, if any.
  Break update_bonded(Joint& j, const JointIncrement& d, double energy_before) const {
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
    if (j.state == healed) {
      if (rim_stress(j) > 0) out = {1, tension};
    } else if (j.state == bonded) {
      if (rim_stress(j) > tension) {
        j.onset = strain_energy(j);
        if (!may_soften || soften(j)) out = {1, tension};
      }
    } else if (soften(j)) {
      out = {1, tension};
    }
    if (out.mode == 0 && rim_shear(j) > shear_strength(j)) {
      if (j.state == bonded || j.state == healed) j.onset = strain_energy(j);
      out = {2, shear_strength(j)};
    }
    if (out.mode == 1 && j.state == healed) j.onset = energy_before;
    return out;
  }

  /// Changes a bond that failed in `mode_of_break` to an unbonded contact. The gap without force is chosen so that the
  /// normal force is continuous.
  void break_bond(Joint& j, int mode_of_break, double overlap_gap) const {
    j.state = mode_of_break;
    j.poisson_normal = 0, j.poisson_shear = {};
    j.slip = 0;
    j.rest_gap = overlap_gap - (j.kn * j.area > 0 ? j.Fn / (j.kn * j.area) : 0.0);
  }

  /// Scales `f` down to the magnitude `limit`. Returns true if it was larger.
  static bool clip(Tangent& f, double limit) {
    const double size = f.norm();
    if (!(size > limit)) return false;
    f *= limit / size;
    return true;
  }

  /// Step of an unbonded contact. `fresh`: the bond failed in this step, so the forces already include the increments.
  void update_unbonded(Joint& j, const JointIncrement& d, bool fresh, bool slid, double overlap_gap) const {
    const double A = j.area, kA = j.kn * A, pressed = A * pressure;
    if (fresh) {
      j.Fn = std::min(j.Fn + pressed, 0.0) - pressed;
    } else {
      // When separated faces close again, only their overlap causes pressure.
      const double dn = j.away ? std::max(d.normal, overlap_gap - j.rest_gap) : d.normal;
      j.Fn =
          mode > 0 ? std::min(j.Fn + kA * dn + pressed, 0.0) - pressed : kA * std::min(overlap_gap - j.rest_gap, 0.0);
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

  /// Adds the work dissipated by friction in the step from the state `before`; it is negative.
  static void add_friction(Joint& j, const Joint& before, const JointIncrement& d) {
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

  void step(Joint& j, const JointIncrement& d, std::size_t contact, std::vector<JointEvent>& events) const {
    using Kind = JointEvent::Kind;
    const Joint before = j;
    j.opening += d.normal, j.shear += d.shear, j.gap = d.gap;
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
      events.push_back({Kind::bond_break, contact, broke.mode, false, false, false, broke.strength, j.onset});
    report_slip();
  }

  void update(std::span<Joint> joints, std::span<const JointIncrement> increments,
              std::vector<JointEvent>& events) const override {
    for (std::size_t k = 0; k < joints.size(); ++k) step(joints[k], increments[k], k, events);
  }

  bool is_bonded(const Joint& j) const override { return j.state >= bonded; }
  std::string state_text(const Joint& j) const override {
    constexpr const char* names[] = {"unbonded",         "unbonded-tension", "unbonded-shear", "bonded",
                                     "bonded-softening", "bonded-unloaded",  "healed"};
    return names[static_cast<std::size_t>(std::clamp(j.state, 0, 6))];
  }
  std::vector<std::string_view> own_names() const override {
    return {"elongation", "sn_shear", "sn_sigma", "sn_esigma", "sn_tau", "sn_slip", "sn_slipb", "sn_slipt"};
  }
  std::vector<double> own_values(const Joint& j) const override {
    const double sigma = rim_stress(j);
    return {j.elongation, shear_strength(j),   sigma - pressure,    sigma,
            rim_shear(j), j.slips ? 1.0 : 0.0, j.bends ? 1.0 : 0.0, j.twists ? 1.0 : 0.0};
  }
  double stiffness() const override { return std::max(kn, ks); }
  bool needs_distance() const override { return methods.modulus.has_value(); }
  double poisson() const override { return nu; }
  double off_diagonal() const override { return non_diagonal; }
  double user_area() const override { return own_area; }
};

}  // namespace

Catalogue<JointLaw>::Item spring_network() { return catalogue_item<JointLaw, SpringNetwork, SpringNetwork>({}); }

}  // namespace tribo
