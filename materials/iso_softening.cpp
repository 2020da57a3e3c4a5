// SPDX-License-Identifier: MIT
/// Brittle solid: elastic until a crack starts, then softening on the plane of the crack until it is free of traction.
///
///   T    the Kirchhoff stress without damage (Jaumann rate), C the isotropic stiffness, M = lambda + 2 mu,
///        <x> = max(x, 0)
///   n_i  the normals of up to three orthogonal cracks, which turn with the material; T_ij = n_i.T n_j
///   tau = T - C:(sum over i of e_i n_i n_i + sum over i < j of g_ij (n_i n_j + n_j n_i)/2),  sigma = tau/J
///
/// The Kirchhoff stress tau is the force per area of the matter before cracks opened. The volume ratio J of a cracked
/// point grows by the openings of its cracks, and the void in them carries no stress. With the Cauchy stress in place
/// of tau, a point under stress along its crack would gain elastic energy from opening, without work.
///
/// Crack i opens by the strain e_i and slips by the share of the crack in g_ij. With its damage d_i,
///
///   M e_i/d_i = p_i = <T_ii - lambda sum over j != i of e_j>
///   slip of crack i along n_j = d_i q_ij/mu,  q_ij = T_ij (1 - d_j)/(1 - d_i d_j),  tau_ij = (1 - d_i) q_ij
///
/// p_i and q_ij are the tractions on plane i without its own damage, and the actual ones are smaller by 1 - d_i; a
/// closed crack has its full normal stiffness. For fixed normals the stress derives from the energy
/// T:C^-1:T/2 - (sum of e_i T_ii + sum of g_ij T_ij)/2, so that Y_i = (p_i^2/M + |q_i|^2/mu)/2 is dissipated per unit
/// of d_i. It is integrated exactly for a constant mode mix, since a shock may break a point within one step. On each
/// plane r^2 = (p/sigmac)^2 + (|q|/tauc)^2. The first crack starts when the largest r of all planes reaches 1, on that
/// plane. The second starts on a plane normal to the first one, where the normal traction is largest; the third is
/// normal to both. Thus matter that has cracked in all directions carries no tension. The traction then decreases with
/// opening and slip, linearly or exponentially:
///
///   linear        d = (1 - 1/r) k/(k - 1) <= 1              k_I = 2 Gc_I M/(h sigmac^2),  k_II = 2 Gc_II mu/(h tauc^2)
///   exponential   r (1 - d) = exp(-r d/k)                   k_I and k_II are half of these values
///   1/k = (1 - m)/k_I + m/k_II                              m: the share of shear in r^2
///
/// h = |n_x| h_x + |n_y| h_y + |n_z| h_z is the width of the band of cells that contains the crack, taken when the
/// crack starts. With it the energy per crack area is Gc for any cell size: Bazant & Oh, Mater. Struct. 16 (1983)
/// 155-177. For a constant mode mix, G_I/Gc_I + G_II/Gc_II = 1 at complete failure. Damage on fixed planes after
/// Nairn, Hammerquist & Aimene, Int. J. Numer. Meth. Engng 111 (2017) 1093-1123, with one damage variable for both
/// modes; several orthogonal cracks after Rots & Blaauwendraad, HERON 34 (1989) 1-59.

#include "materials/elastic_constants.hpp"
#include "materials/principal.hpp"

#include <algorithm>
#include <limits>

namespace tribo {
namespace {

struct IsoSoftening {
  static constexpr std::string_view name = "IsoSoftening";
  static constexpr std::string_view summary =
      "Elastic solid that cracks by softening damage, with a fracture energy that does not depend on the cell size.";
  static constexpr int number = 50;
  static constexpr std::string_view needs = one_elastic_pair;
  static constexpr std::string_view example = R"(
<Material Type='IsoSoftening' Name='concrete'>
  <rho>2400</rho>
  <E>30e9</E>
  <nu>0.2</nu>
  <sigmac>3e6</sigmac>
  <I-Gc>100</I-Gc>
  <SofteningI>Linear</SofteningI>
</Material>)";

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
        P{"E", &L::young_modulus, stress, positive, "Young's modulus; with nu", {}, true},
        P{"nu", &L::poisson_ratio, none, between(-1.0, 0.5), "Poisson's ratio; with E", {}, true},
        P{"K", &L::bulk_modulus, stress, positive, "bulk modulus; with G, instead of E and nu", {}, true},
        P{"G", &L::shear_modulus, stress, positive, "shear modulus; with K, instead of E and nu", {}, true},
        P{"sigmac", &L::tensile_strength, stress, positive, "tensile strength"},
        P{"tauc",
          &L::shear_strength,
          stress,
          positive,
          "shear strength (default: cracks start in tension only)",
          {},
          true},
        P{"I-Gc", &L::toughness, energy, positive, "fracture energy per area in mode I (opening)"},
        P{"II-Gc",
          &L::shear_toughness,
          energy,
          positive,
          "fracture energy per area in mode II (slip); with tauc (default: I-Gc)",
          {},
          true},
    };
  }
  static std::vector<OwnProperty> own_properties() {
    return {{"Initiation",
             "criterion of the start of a crack; must be MaxPrinciple (default): the largest principal stress reaches "
             "the strength"},
            {"SofteningI", "how the normal traction decreases as a crack opens: Linear (default) or Exponential"},
            {"SofteningII", "how the shear traction decreases as a crack slips; must equal SofteningI"}};
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
    double damage = 0, damage_2 = 0, damage_3 = 0;
    double nx = 0, ny = 0, nz = 0;                          // normal of the first crack
    double mx = 0, my = 0, mz = 0;                          // of the second; the third is normal to both
    double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;  // T - sigma
    double band = 0, band_2 = 0, band_3 = 0, opening = 0, dissipation = 0;
  };
  static auto history() {
    using V = StateVariable<State>;
    constexpr auto none = Dimension::none, stress = Dimension::stress, length = Dimension::length;
    return std::make_tuple(V{"damage", none, &State::damage}, V{"damage_2", none, &State::damage_2},
                           V{"damage_3", none, &State::damage_3}, V{"crack_normal_x", none, &State::nx},
                           V{"crack_normal_y", none, &State::ny}, V{"crack_normal_z", none, &State::nz},
                           V{"crack_normal_2_x", none, &State::mx}, V{"crack_normal_2_y", none, &State::my},
                           V{"crack_normal_2_z", none, &State::mz}, V{"released_xx", stress, &State::xx},
                           V{"released_yy", stress, &State::yy}, V{"released_zz", stress, &State::zz},
                           V{"released_xy", stress, &State::xy}, V{"released_yz", stress, &State::yz},
                           V{"released_xz", stress, &State::xz}, V{"crack_band", length, &State::band},
                           V{"crack_band_2", length, &State::band_2}, V{"crack_band_3", length, &State::band_3},
                           V{"crack_opening", length, &State::opening}, V{"dissipation", stress, &State::dissipation});
  }

  /// Cell size at which softening becomes impossible: the cell would release more energy than the crack dissipates.
  double largest_cell() const {
    const double part = exponential ? 1 : 2;
    const double tension = part * toughness * wave_modulus() / (tensile_strength * tensile_strength);
    if (!given(shear_strength)) return tension;
    return std::min(tension, part * shear_toughness * elastic.mu / (shear_strength * shear_strength));
  }

  Mat3 stress(const Motion& motion, const Mat3& old, State& state) const {
    const double J = motion.F.determinant();
    const Mat3 T = elastic_trial(elastic, motion, old + released(state));
    Cracks cracks = cracks_of(state);
    const bool cracked = cracks.any();
    if (!cracked && strength_ratio(tractions(weakest_plane(T), T)) <= 1) {
      store(cracks, T - T / J, state);
      return T / J;
    }
    if (cracked)
      turn(cracks, spin_rotation(motion.L, motion.dt));
    else
      cracks.normal.col(0) = weakest_plane(T);
    if (cracks.damage[1] == 0 && cracks.damage[2] == 0) choose_second(cracks, T);
    for (int i = 0; i < 3; ++i) grow(cracks, i, T, motion.cell, state.dissipation);
    const Response response = respond(cracks, T);
    state.opening = cracks.band[0] * response.opening[0];
    const Mat3 stress = response.stress / J;
    store(cracks, T - stress, state);
    return stress;
  }

  double energy_density(const Mat3& F, const Mat3& stress, const State& state) const {
    const Mat3 T = stress + released(state);
    const Cracks cracks = cracks_of(state);
    return (elastic.energy(T) - (cracks.any() ? respond(cracks, T).released_energy : 0.0)) / F.determinant();
  }

 private:
  /// Up to three orthogonal cracks: normals as columns, damage, and widths of their bands of cells.
  struct Cracks {
    Mat3 normal;
    Vec3 damage, band;
    bool any() const { return damage.maxCoeff() > 0; }
  };
  /// Stress of the cracked material, and of each crack: its opening strain e_i and its tractions p_i and |q_i|.
  struct Response {
    Mat3 stress;  // tau
    Vec3 opening, normal, shear;
    double released_energy;
  };
  struct Tractions {
    double normal, shear;  // <T_n>, |t_s|
  };

  static Cracks cracks_of(const State& s) {
    const Vec3 n(s.nx, s.ny, s.nz), m(s.mx, s.my, s.mz);
    Cracks cracks;
    cracks.normal << n, m, n.cross(m);
    cracks.damage = {s.damage, s.damage_2, s.damage_3};
    cracks.band = {s.band, s.band_2, s.band_3};
    return cracks;
  }

  static void store(const Cracks& cracks, const Mat3& released, State& s) {
    s.damage = cracks.damage[0], s.damage_2 = cracks.damage[1], s.damage_3 = cracks.damage[2];
    s.nx = cracks.normal(0, 0), s.ny = cracks.normal(1, 0), s.nz = cracks.normal(2, 0);
    s.mx = cracks.normal(0, 1), s.my = cracks.normal(1, 1), s.mz = cracks.normal(2, 1);
    s.band = cracks.band[0], s.band_2 = cracks.band[1], s.band_3 = cracks.band[2];
    s.xx = released(0, 0), s.yy = released(1, 1), s.zz = released(2, 2);
    s.xy = released(0, 1), s.yz = released(1, 2), s.xz = released(0, 2);
  }

  static Mat3 released(const State& s) {
    Mat3 m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
  }

  static Tractions tractions(const Vec3& n, const Mat3& T) {
    const Vec3 t = T * n;
    const double normal = n.dot(t);
    return {std::max(normal, 0.0), (t - normal * n).norm()};
  }

  double shear_share(double shear) const {
    return given(shear_strength) ? shear * shear / (shear_strength * shear_strength) : 0.0;
  }
  double strength_ratio(const Tractions& t) const {
    return std::hypot(t.normal / tensile_strength, std::sqrt(shear_share(t.shear)));
  }

  /// The normals turn with the material and stay orthonormal.
  static void turn(Cracks& cracks, const Mat3& rotation) {
    const Vec3 n = (rotation * cracks.normal.col(0)).normalized();
    Vec3 m = rotation * cracks.normal.col(1);
    m = (m - n.dot(m) * n).normalized();
    cracks.normal << n, m, n.cross(m);
  }

  /// The second normal is the direction of the largest stress in the plane of the first crack.
  void choose_second(Cracks& cracks, const Mat3& T) const {
    const Vec3 n = cracks.normal.col(0);
    Vec3 a = Vec3::Unit(0);
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(n[axis]) < std::abs(n.dot(a))) a = Vec3::Unit(axis);
    a = (a - n.dot(a) * n).normalized();
    const Vec3 b = n.cross(a);
    cracks.normal << n, a, b;
    const Mat3 sigma = respond(cracks, T).stress;
    const double angle = 0.5 * std::atan2(2 * a.dot(sigma * b), a.dot(sigma * a) - b.dot(sigma * b));
    const Vec3 m = std::cos(angle) * a + std::sin(angle) * b;
    cracks.normal << n, m, n.cross(m);
  }

  /// Damage of crack i grows if the tractions on its plane exceed the strength.
  void grow(Cracks& cracks, int i, const Mat3& T, const Vec3& cell, double& dissipation) const {
    const Response response = respond(cracks, T);
    const double r = strength_ratio({response.normal[i], response.shear[i]});
    if (!(r > 1)) return;
    double& d = cracks.damage[i];
    if (d == 0) cracks.band[i] = width(cracks.normal.col(i), cell);
    const double energy = 0.5 * (response.normal[i] * response.normal[i] / elastic.wave_modulus() +
                                 response.shear[i] * response.shear[i] / elastic.mu);
    const Softening softening = softening_of(shear_share(response.shear[i]) / (r * r), cracks.band[i]);
    const double larger = std::max(d, softening.damage(r));
    dissipation += 2 * energy / (r * r) * (softening.dissipated(larger) - softening.dissipated(d));
    d = larger;
  }

  Response respond(const Cracks& cracks, const Mat3& T) const {
    const Vec3& d = cracks.damage;
    const Mat3 local = cracks.normal.transpose() * T * cracks.normal;
    Response response;
    response.opening = openings(local.diagonal(), d);
    const double total = response.opening.sum();
    Mat3 stress = local;
    stress.diagonal() -= elastic.lambda * total * Vec3::Ones() + 2 * elastic.mu * response.opening;
    response.normal = (local.diagonal() - elastic.lambda * (total * Vec3::Ones() - response.opening)).cwiseMax(0.0);
    response.released_energy = 0.5 * response.opening.dot(local.diagonal());
    Vec3 shear_squared(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double both = 1 - d[i] * d[j];  // 0 if both planes are free of traction
      const double on_i = both > 0 ? local(i, j) * (1 - d[j]) / both : 0.0;
      const double on_j = both > 0 ? local(i, j) * (1 - d[i]) / both : 0.0;
      stress(i, j) = stress(j, i) = (1 - d[i]) * on_i;
      response.released_energy += 0.5 * local(i, j) * (local(i, j) - stress(i, j)) / elastic.mu;
      shear_squared[i] += on_i * on_i, shear_squared[j] += on_j * on_j;
    }
    response.shear = shear_squared.cwiseSqrt();
    response.stress = cracks.normal * stress * cracks.normal.transpose();
    return response;
  }

  /// Opening strains: e_i >= 0 and M e_i/d_i + lambda (sum of the others) >= T_ii, one of them an equality for each i.
  /// The matrix is positive definite, so that exactly one of the eight sets of open cracks fulfils all conditions.
  Vec3 openings(const Vec3& trial, const Vec3& d) const {
    const double M = elastic.wave_modulus(), lambda = elastic.lambda;
    Vec3 best(0, 0, 0);
    double smallest_violation = std::numeric_limits<double>::infinity();
    for (unsigned set = 0; set < 8; ++set) {
      // e_i = d_i (T_ii - lambda S)/(M - lambda d_i) with the sum S of all openings
      double a = 0, b = 0;
      bool possible = true;
      for (int i = 0; i < 3; ++i)
        if (set >> i & 1U) {
          possible = possible && d[i] > 0;
          a += d[i] * trial[i] / (M - lambda * d[i]), b += d[i] / (M - lambda * d[i]);
        }
      if (!possible) continue;
      const double sum = a / (1 + lambda * b);
      Vec3 e(0, 0, 0);
      double violation = 0;
      for (int i = 0; i < 3; ++i) {
        const double driving = trial[i] - lambda * sum;
        if (set >> i & 1U)
          e[i] = d[i] * driving / (M - lambda * d[i]), violation = std::max(violation, -driving);
        else if (d[i] > 0)
          violation = std::max(violation, driving);
      }
      if (violation < smallest_violation) smallest_violation = violation, best = e;
      if (violation == 0) break;
    }
    return best;
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

  /// Softening in units of the strength: traction f(x) over the opening x = r d, with f(0) = 1.
  struct Softening {
    double k;
    bool exponential;

    /// Damage at the traction r without damage.
    double damage(double r) const {
      if (!(k > 1)) return 1.0;  // the cell stores more energy than the crack can dissipate
      if (!exponential) return std::min(1.0, (1 - 1 / r) * k / (k - 1));
      double x = r;  // Newton's method from above decreases monotonically to the root of x + f(x) = r
      for (int i = 0; i < 50; ++i) {
        const double e = std::exp(-x / k), change = (r - x - e) / (e / k - 1);
        x -= change;
        if (std::abs(change) < 1e-15 * r) break;
      }
      return x / r;
    }

    /// Energy dissipated until the damage d: the integral of f from 0 to x less the part f x/2 that unloading returns.
    double dissipated(double d) const {
      if (!(k > 1)) return 0.5 * d;
      if (!exponential) return 0.5 * d / (1 - d * (k - 1) / k);
      if (d >= 1) return k;
      double x = 0;  // Newton's method from below increases monotonically to the root of x (1 - d) = d f(x)
      for (int i = 0; i < 200; ++i) {
        const double e = std::exp(-x / k), change = (d * e - x * (1 - d)) / (1 - d + d * e / k);
        x += change;
        if (!(change > 1e-15 * x)) break;
      }
      const double f = std::exp(-x / k);
      return k * (1 - f) - 0.5 * x * f;
    }
  };

  Softening softening_of(double shear_share, double h) const {
    const double part = exponential ? 1 : 2;
    double inverse = (1 - shear_share) * tensile_strength * tensile_strength / (toughness * wave_modulus());
    if (given(shear_strength))
      inverse += shear_share * shear_strength * shear_strength / (shear_toughness * elastic.mu);
    return {part / (h * inverse), exponential};
  }
};

}  // namespace

Catalogue<Material>::Item iso_softening() { return material_law<IsoSoftening>(); }

}  // namespace tribo
