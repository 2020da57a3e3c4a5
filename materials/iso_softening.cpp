// SPDX-License-Identifier: MIT
/// Brittle solid: elastic until a crack starts, then softening on the plane of the crack until it is free of traction.
///
///   T   the stress without damage (Jaumann rate),  n the normal of the crack, which turns with the material
///   t = T n,  T_n = n.t,  t_s = t - T_n n,  <x> = max(x, 0),  M = lambda + 2 mu
///   sigma = T - d (<T_n>/M C:(n n) + n t_s + t_s n)
///
/// d is the damage of the crack. The crack opens by d <T_n>/M per length and slips by d t_s/mu per length. A closed
/// crack has its full normal stiffness. For a fixed n the stress derives from the energy T:C^-1:T/2 - d Y with
/// Y = (<T_n>^2/M + t_s^2/mu)/2, so that Y is dissipated per unit of damage. On each plane
/// r^2 = (<T_n>/sigmac)^2 + (|t_s|/tauc)^2. The crack starts when the largest r of all planes reaches 1, on that plane.
/// The traction then decreases with opening and slip, linearly or exponentially:
///
///   linear        d = (1 - 1/r) k/(k - 1) <= 1              k_I = 2 Gc_I M/(h sigmac^2),  k_II = 2 Gc_II mu/(h tauc^2)
///   exponential   r (1 - d) = exp(-r d/k)                   k_I and k_II are half of these values
///   1/k = (1 - m)/k_I + m/k_II                              m: the share of shear in r^2
///
/// h = |n_x| h_x + |n_y| h_y + |n_z| h_z is the width of the band of cells that contains the crack, taken when the
/// crack starts. With it the energy per crack area is Gc for any cell size: Bazant & Oh, Mater. Struct. 16 (1983)
/// 155-177. For a constant mode mix, G_I/Gc_I + G_II/Gc_II = 1 at complete failure. Damage on one fixed plane after
/// Nairn, Hammerquist & Aimene, Int. J. Numer. Meth. Engng 111 (2017) 1093-1123, with one damage variable for both
/// modes.

#include "materials/elastic_constants.hpp"
#include "materials/principal.hpp"

#include <algorithm>

namespace tribo {
namespace {

struct IsoSoftening {
  static constexpr std::string_view name = "IsoSoftening";
  static constexpr std::string_view summary =
      "Elastic solid that cracks: softening damage with a fracture energy that does not depend on the cell size.";
  static constexpr int number = 50;

  double density = 0;
  double young_modulus = absent, poisson_ratio = absent, bulk_modulus = absent, shear_modulus = absent;
  double tensile_strength = 0, shear_strength = absent, toughness = 0, shear_toughness = absent;
  bool exponential = false;
  Elasticity elastic;

  static auto parameters() {
    using L = IsoSoftening;
    using P = Parameter<L>;
    constexpr auto stress = Dimension::stress, none = Dimension::none, energy = Dimension::energy_release;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"E", &L::young_modulus, stress, positive, "Young's modulus, with nu", {}, true},
        P{"nu", &L::poisson_ratio, none, between(-1.0, 0.5), "Poisson's ratio, with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus, with G", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus, with K", {}, true},
        P{"sigmac", &L::tensile_strength, stress, positive, "tensile strength"},
        P{"tauc",
          &L::shear_strength,
          stress,
          positive,
          "shear strength (absent: cracks start in tension only)",
          {},
          true},
        P{"I-Gc", &L::toughness, energy, positive, "fracture energy per area in mode I (opening)"},
        P{"II-Gc",
          &L::shear_toughness,
          energy,
          positive,
          "fracture energy per area in mode II (slip), with tauc (default I-Gc)",
          {},
          true},
    };
  }
  static std::vector<OwnProperty> own_properties() {
    return {{"Initiation", "MaxPrinciple: cracks start where the largest principal stress reaches the strength"},
            {"SofteningI", "Linear or Exponential: how the normal traction decreases as a crack opens"},
            {"SofteningII", "the same for the shear traction as it slips; must equal SofteningI"}};
  }

  void prepare(const Statement& statement, Problems& problems) {
    elastic =
        elastic_constants(statement, {young_modulus, poisson_ratio, bulk_modulus, shear_modulus}, false, problems);
    const auto word = [&](const char* key, const std::vector<std::string>& valid) {
      const Statement* s = statement.child(key);
      if (!s) return std::size_t{0};
      const auto found = std::find(valid.begin(), valid.end(), s->text);
      if (found != valid.end()) return static_cast<std::size_t>(found - valid.begin()) % (valid.size() / 2);
      problems.add(s->text_origin, "<" + s->name + "> cannot be '" + s->text + "'" + did_you_mean(s->text, valid) +
                                       "; valid: " + join(valid));
      return std::size_t{0};
    };
    word("Initiation", {"MaxPrinciple", "1"});
    const std::vector<std::string> laws{"Linear", "Exponential", "1", "2"};
    exponential = word("SofteningI", laws) == 1;
    if (const Statement* s = statement.child("SofteningII"); s && (word("SofteningII", laws) == 1) != exponential)
      problems.add(s->origin, "<SofteningII> must equal <SofteningI>: both modes share one damage variable");
    if (const Statement* s = statement.child("II-Gc"); s && !given(shear_strength))
      problems.add(s->origin, "<II-Gc> needs <tauc>, the shear strength");
    if (!given(shear_toughness)) shear_toughness = toughness;
  }

  void weaken(double factor) { tensile_strength /= factor, shear_strength /= factor; }

  double wave_modulus() const { return elastic.wave_modulus(); }

  struct State {
    double damage = 0, nx = 0, ny = 0, nz = 0;
    double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;  // T - sigma
    double band = 0, opening = 0, dissipation = 0;
  };
  static auto history() {
    using V = StateVariable<State>;
    constexpr auto none = Dimension::none, stress = Dimension::stress;
    return std::make_tuple(
        V{"damage", none, &State::damage}, V{"crack_normal_x", none, &State::nx}, V{"crack_normal_y", none, &State::ny},
        V{"crack_normal_z", none, &State::nz}, V{"released_xx", stress, &State::xx},
        V{"released_yy", stress, &State::yy}, V{"released_zz", stress, &State::zz},
        V{"released_xy", stress, &State::xy}, V{"released_yz", stress, &State::yz},
        V{"released_xz", stress, &State::xz}, V{"crack_band", Dimension::length, &State::band},
        V{"crack_opening", Dimension::length, &State::opening}, V{"dissipation", stress, &State::dissipation});
  }

  /// Cell size at which softening becomes impossible: the cell would release more energy than the crack dissipates.
  double largest_cell() const {
    const double part = exponential ? 1 : 2;
    const double tension = part * toughness * wave_modulus() / (tensile_strength * tensile_strength);
    if (!given(shear_strength)) return tension;
    return std::min(tension, part * shear_toughness * elastic.mu / (shear_strength * shear_strength));
  }

  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    const Mat3 before = old + released(state);
    const Mat3 T = elastic_trial(elastic, motion, before);
    Vec3 n(state.nx, state.ny, state.nz);
    if (state.damage > 0)
      n = spin_rotation(motion.L, motion.dt) * n;
    else
      n = weakest_plane(T);
    const Plane plane = on(n, T);
    const double h = state.damage > 0 ? state.band : width(n, motion.cell);
    const double energy_before = state.damage > 0 ? on({state.nx, state.ny, state.nz}, before).energy(elastic) : 0.0;
    const double r = std::sqrt(plane.tension_share(*this) + plane.shear_share(*this));
    if (r > 1) {
      const double d = std::max(state.damage, damage(r, plane.shear_share(*this) / (r * r), h));
      const double energy = plane.energy(elastic), growth = d - state.damage;
      state.dissipation +=
          motion.F.determinant() * growth * (state.damage > 0 ? 0.5 * (energy + energy_before) : energy);
      state.damage = d;
    }
    if (!(state.damage > 0)) return T;
    n.normalize();
    state.nx = n[0], state.ny = n[1], state.nz = n[2];
    state.band = h;
    state.opening = h * state.damage * plane.open / elastic.wave_modulus();
    const Mat3 released = state.damage * plane.release(elastic);
    state.xx = released(0, 0), state.yy = released(1, 1), state.zz = released(2, 2);
    state.xy = released(0, 1), state.yz = released(1, 2), state.xz = released(0, 2);
    return T - released;
  }

  double energy_density(const Mat3&, const Mat3& stress, const State& state) const {
    const Mat3 T = stress + released(state);
    return elastic.energy(T) - state.damage * on({state.nx, state.ny, state.nz}, T).energy(elastic);
  }

 private:
  /// Traction of the undamaged stress T on the plane with normal n.
  struct Plane {
    Vec3 n, shear;
    double open;  // <T_n>

    double energy(const Elasticity& e) const {
      return 0.5 * (open * open / e.wave_modulus() + shear.squaredNorm() / e.mu);
    }
    double tension_share(const IsoSoftening& law) const {
      const double share = open / law.tensile_strength;
      return share * share;
    }
    double shear_share(const IsoSoftening& law) const {
      return given(law.shear_strength) ? shear.squaredNorm() / (law.shear_strength * law.shear_strength) : 0.0;
    }
    Mat3 release(const Elasticity& e) const {
      const Mat3 slip = n * shear.transpose();
      return open / e.wave_modulus() * (e.lambda * Mat3::Identity() + 2 * e.mu * n * n.transpose()) + slip +
             slip.transpose();
    }
  };

  static Plane on(const Vec3& n, const Mat3& T) {
    const Vec3 t = T * n;
    const double normal = n.dot(t);
    return {n, t - normal * n, std::max(normal, 0.0)};
  }

  static Mat3 released(const State& s) {
    Mat3 m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
  }

  // Width h of the band of cells that contains the crack: one cell along an axis, a staircase in other directions.
  static double width(const Vec3& n, const Vec3& cell) { return n.cwiseAbs().dot(cell); }

  // The plane with the largest r. In the plane of the largest and smallest principal stress the traction on the plane
  // at angle w from the axis of the largest has the components a + b cos 2w and b sin 2w. r^2 is quadratic in cos 2w,
  // with different coefficients for open and closed planes.
  Vec3 weakest_plane(const Mat3& T) const {
    const Principal p = principal(T);
    const auto axis = [&](std::size_t k) { return Vec3(p.axis[k][0], p.axis[k][1], p.axis[k][2]); };
    const double a = 0.5 * (p.value[2] + p.value[0]), b = 0.5 * (p.value[2] - p.value[0]);
    double cosine = 1;
    if (given(shear_strength) && b > 0) {
      const double s2 = tensile_strength * tensile_strength, t2 = shear_strength * shear_strength;
      if (a > 0 && s2 > t2) cosine = std::min(1.0, a * t2 / (b * (s2 - t2)));
      if (a <= 0) {
        const auto square = [&](double c) {
          const double open = std::max(0.0, a + b * c);
          return open * open / s2 + b * b * (1 - c * c) / t2;
        };
        cosine = square(0) > square(1) ? 0 : 1;
      }
    }
    const double half = std::sqrt(0.5 * (1 + cosine));
    return half * axis(2) + std::sqrt(std::max(0.0, 1 - half * half)) * axis(0);
  }

  double damage(double r, double shear_share, double h) const {
    const double part = exponential ? 1 : 2;
    double inverse = (1 - shear_share) * tensile_strength * tensile_strength / (toughness * wave_modulus());
    if (given(shear_strength))
      inverse += shear_share * shear_strength * shear_strength / (shear_toughness * elastic.mu);
    const double k = part / (h * inverse);
    if (!(k > 1)) return 1.0;  // the cell stores more energy than the crack can dissipate
    if (!exponential) return std::min(1.0, (1 - 1 / r) * k / (k - 1));
    double x = r;  // x = r d; Newton's method from above decreases monotonically to the root
    for (int i = 0; i < 50; ++i) {
      const double e = std::exp(-x / k), change = (r - x - e) / (e / k - 1);
      x -= change;
      if (std::abs(change) < 1e-15 * r) break;
    }
    return x / r;
  }
};

}  // namespace

Catalogue<Material>::Item iso_softening() { return material_law<IsoSoftening>(); }

}  // namespace tribo
