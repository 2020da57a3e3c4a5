// SPDX-License-Identifier: MIT
/// Parameters and methods of the spring network law.

#include "base/text.hpp"
#include "contact/spring_network_law.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

auto SpringNetwork::parameters() {
  using L = SpringNetwork;
  using P = Parameter<L>;
  using D = Dimension;
  constexpr Range slope{0.0, 90.0, false, true};
  return std::array{
      P{"kn", &L::kn, D::interface_stiffness, not_negative, "normal stiffness per area", 0.0},
      P{"ks", &L::ks, D::interface_stiffness, not_negative, "shear stiffness per area", 0.0},
      P{"fric", &L::mu, D::none, not_negative,
        "friction coefficient of an unbonded contact; if it is not given, tan(sn_fa) is used", 0.0},
      P{"rgap", &L::gap_shift, D::length, any_value, "gap at which the faces count as closed", 0.0},
      P{"sn_bmul", &L::bend_factor, D::none, not_negative,
        "factor of the limit of the bending moment of an unbonded contact", 1.0},
      P{"sn_tmul", &L::twist_factor, D::none, not_negative,
        "factor of the limit of the twisting moment of an unbonded contact", 1.0},
      P{"sn_mode", &L::mode, D::none, within(0, 1),
        "normal force of an unbonded contact: 0 it follows from the gap, 1 it is the sum of its increments; 1 holds in "
        "any case with <bond>, <compute-stiffness> or <assign-stiffness>",
        0.0},
      P{"sn_rmul", &L::radius_factor, D::none, positive,
        "radius of the contact area of balls, divided by the radius of the smaller ball", 1.0},
      P{"sn_mcf", &L::moment_share, D::none, within(0, 1),
        "weight beta of the moments in the stresses at the rim of the contact area", 1.0},
      P{"sn_ten", &L::tension, D::stress, not_negative, "tensile strength of the bond", 0.0},
      P{"sn_tendc", &L::tension_length, D::length, not_negative,
        "elongation over which the tensile strength falls to zero; 0: it falls at once", 0.0},
      P{"sn_coh", &L::c, D::stress, not_negative, "cohesion of the bond", 0.0},
      P{"sn_cohdc", &L::shear_length, D::length, not_negative,
        "slip over which the shear strength falls to the residual one; 0: it falls at once", 0.0},
      P{"sn_cohres", &L::c_residual, D::stress, not_negative, "residual cohesion after failure in shear", 0.0},
      P{"sn_fa", &L::phi, D::angle, slope, "friction angle of the bond", 0.0},
      P{"sn_dil", &L::psi, D::angle, slope,
        "dilation angle; with a positive angle an unbonded contact opens while it slips", 0.0},
      P{"sn_dilzero",
        &L::dilation_zero,
        D::length,
        not_negative,
        "shear displacement beyond which the contact no longer dilates (default: no limit)",
        {},
        true},
      P{"sn_heal", &L::heals, D::none, within(0, 1),
        "1: a broken bond heals when sliding ends under pressure; 0: it does not", 0.0},
      P{"sn_non_diag", &L::non_diagonal, D::none, within(0, 1),
        "factor of the shear components of the fictitious stress, which represents Poisson's ratio", 0.0},
      P{"sn_pois", &L::nu, D::none, between(-1, 1), "Poisson's ratio of the elastic body that the bonds represent",
        0.0},
      P{"sn_porp", &L::constant_pressure, D::stress, any_value, "pressure of the pore fluid", 0.0},
      P{"sn_porp_equilibrium", &L::in_equilibrium, D::none, within(0, 1),
        "1: the normal force at the start is the effective one, to which the pore pressure is added; 0: it is the "
        "total one",
        0.0},
      P{"dp_nratio", &L::dashpot_normal, D::none, within(0, 1), "normal dashpot, as a fraction of critical damping",
        0.0},
      P{"dp_sratio", &L::dashpot_shear, D::none, within(0, 1),
        "shear dashpot, as a fraction of critical damping. It also acts while the contact slides, unless dp_mode "
        "contains 2",
        0.0},
      P{"dp_mode", &L::dashpot_mode, D::none, within(0, 3),
        "limits of the dashpots, a sum of 1 (the normal dashpot exerts no tension) and 2 (no shear dashpot acts while "
        "the contact slides)",
        0.0}};
}

std::vector<OwnProperty> SpringNetwork::own_properties() {
  return {
      {"sn_porp_function",
       "pressure of the pore fluid as a function of x, y, z and t [stress], which is added to sn_porp"},
      {"user_area",
       "area of each contact, instead of the computed one: one number, or a list with one number for each contact of a "
       "crack or interface [length^2]"},
      {"sn_area", "another name of user_area"},
      {"krot",
       "rotational stiffnesses about n, s and t, in two dimensions a single number about s [force length]. Default: ks "
       "J, kn I_s and kn I_t with the second moments J, I_s and I_t of the contact area; 0 with assign-stiffness"},
      {"sn_tentab",
       "pairs of a multiplier of sn_ten and an elongation [length] in increasing order of elongation, instead of "
       "sn_tendc"},
      {"sn_cohtab",
       "pairs of a multiplier and a slip [length] in increasing order of slip, instead of sn_cohdc. The multiplier "
       "applies to the difference between peak and residual shear strength"},
      {"sn_force", "forces of each contact at the start: -F_n, F_ss, F_st, along n, s and t [force]"},
      {"sn_moment", "moments of each contact at the start: M_t, M_bs, M_bt, about n, s and t [force length]"},
      {"area",
       "without a value: the initial area is kept, which Tribo always does; with a value: the same as user_area"},
      {"compute-stiffness",
       "'emod E poisson nu': elastic constants E and nu of the body that the bonds represent; they give kn = ks = E/d, "
       "with the distance d between the centres of the blocks"},
      {"assign-stiffness", "'kn k kratio kappa': kn = k and ks = k/kappa without rotational stiffness"},
      {"bond",
       "bonds contacts at the start: 'gap g' those with a gap of at most g (default 0), 'gap a b' those with a gap "
       "from a to b"},
      {"unbond", "removes the bonds of contacts at the start, which are selected as in <bond>"},
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

namespace {

/// Values of `words` in the text of a method, `word value(s) word value(s)`.
std::vector<std::vector<double>> arguments(const Statement& s, const std::vector<std::string>& words,
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

std::optional<SpringNetwork::Methods::Gaps> gaps(const Statement& s, const char* method, const Units& units,
                                                 Problems& problems) {
  const Statement* m = s.child(method);
  if (!m) return std::nullopt;
  SpringNetwork::Methods::Gaps out;
  const auto v = arguments(*m, {"gap"}, problems)[0];
  const double length = units.factor(Dimension::length);
  if (v.size() > 2 || (v.size() == 2 && v[0] > v[1]))
    problems.add(m->origin, "<" + m->name + "> takes 'gap g', the largest gap, or 'gap a b' with a <= b");
  else if (!v.empty())
    out = {v.size() == 2 ? v[0] * length : out.low, v.back() * length};
  return out;
}

}  // namespace

void SpringNetwork::read_stiffness(const Statement& s, const Units& units, Problems& problems) {
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

void SpringNetwork::prepare(const Statement& s, const Units& units, Problems& problems) {
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
  must_be_whole(s, {"sn_mode", "sn_heal", "dp_mode", "sn_porp_equilibrium"}, problems);
  read_stiffness(s, units, problems);
  methods.bond = gaps(s, "bond", units, problems), methods.unbond = gaps(s, "unbond", units, problems);
  if (methods.bond) mode = 1;
  for (const auto& [length, of] : {std::pair{"sn_tendc", "sn_tentab"}, {"sn_cohdc", "sn_cohtab"}})
    if (s.child(length) && s.child(of))
      problems.add(s.child(length)->origin,
                   "<" + std::string(length) + "> and <" + of + "> exclude each other; give one of them");
  pressure_function = PressureFunction(s, "sn_porp_function", units, problems);
  tension_table = MultiplierTable(s, "sn_tentab", units, problems);
  shear_table = MultiplierTable(s, "sn_cohtab", units, problems);
  turns_with_area = !s.child("krot") && !s.child("assign-stiffness");
  own_areas = UserAreas(s, {"user_area", "sn_area", "area"}, problems);
  auto rotation = numbers_of(s, "krot", 1, 3, problems);
  for (double& k : rotation) k *= units.factor(Dimension::force) * units.factor(Dimension::length);
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

Catalogue<JointLaw>::Item spring_network() { return catalogue_item<JointLaw, SpringNetwork, SpringNetwork>({}); }

}  // namespace tribo
