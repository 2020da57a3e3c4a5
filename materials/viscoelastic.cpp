// SPDX-License-Identifier: MIT
/// Linear viscoelastic solid: a spring and Maxwell elements in parallel for shear, elastic in volume.
///
///   G(t) = G0 + sum_k Gk exp(-t/tau_k)                s' = 2 G0 e + sum_k s_k,   s_k' + s_k/tau_k = 2 Gk e'
///   s_k(t+dt) = x s_k + 2 Gk tau_k (1 - x)/dt de,     x = exp(-dt/tau_k)
///
/// This is exact for a constant strain rate and any time step. The tensors rotate with the body (Jaumann rate), as in
/// elastic.hpp. Simo & Hughes, Computational Inelasticity (1998), 10.3.

#include "materials/elastic.hpp"
#include "materials/material.hpp"

#include <numeric>

namespace tribo {
namespace {

struct MaxwellElement {
  double modulus = 0, time = 0;  ///< Gk [stress], tau_k [time]
};

struct ViscoelasticParameters {
  static constexpr std::string_view name = "Viscoelastic";
  static constexpr std::string_view summary =
      "Viscoelastic solid with a Prony series of shear moduli and an elastic volume.";
  static constexpr int number = 7;
  static constexpr std::string_view example = R"(
<Material Type='Viscoelastic' Name='polymer'>
  <rho>1200</rho>
  <K>3e9</K>
  <G0>0.2e9</G0>
  <ntaus>2</ntaus>
  <Gk>0.5e9</Gk>
  <tauk>0.01</tauk>
  <Gk>0.3e9</Gk>
  <tauk>1</tauk>
</Material>)";

  double density = 0, bulk_modulus = 0, long_modulus = 0;
  std::vector<MaxwellElement> elements;

  static auto parameters() {
    using L = ViscoelasticParameters;
    using P = Parameter<L>;
    return std::array{
        P{"rho", &L::density, Dimension::density, positive, "mass density before deformation"},
        P{"K", &L::bulk_modulus, Dimension::stress, positive, "bulk modulus"},
        P{"G0", &L::long_modulus, Dimension::stress, not_negative, "long-term shear modulus"},
    };
  }
  static std::vector<OwnProperty> own_properties() {
    return {{"Gk",
             "shear modulus of an element of the series [stress], > 0, followed by its <tauk>; both are repeated for "
             "each element, at most 8 times"},
            {"tauk", "relaxation time of the preceding <Gk> [time], > 0"},
            {"ntaus", "number of pairs of <Gk> and <tauk>; checked if given"}};
  }

  void prepare(const Statement& statement, const Units& units, Problems& problems) {
    std::vector<double> moduli, times;
    for (const auto& child : statement.children) {
      const bool modulus = child.name == "Gk";
      if (!modulus && child.name != "tauk" && child.name != "ntaus") continue;
      const auto value = to_number(child.text);
      if (!value || !(*value > 0))
        problems.add(child.text_origin, "<" + child.name + "> needs one positive number, not '" + child.text + "'");
      else if (modulus)
        moduli.push_back(*value * units.factor(Dimension::stress));
      else if (child.name == "tauk")
        times.push_back(*value * units.factor(Dimension::time));
    }
    if (moduli.empty() || moduli.size() != times.size())
      problems.add(statement.origin, "a viscoelastic solid needs as many <Gk> as <tauk>, at least one of each; here " +
                                         std::to_string(moduli.size()) + " and " + std::to_string(times.size()));
    const auto* count = statement.child("ntaus");
    if (count && to_number(count->text) && *to_number(count->text) != static_cast<double>(moduli.size()))
      problems.add(count->origin, "<ntaus> is " + count->text + ", but there are " + std::to_string(moduli.size()) +
                                      " <Gk>; leave <ntaus> out");
    if (moduli.size() > 8) problems.add(statement.origin, "a viscoelastic solid has at most 8 <Gk>");
    for (std::size_t k = 0; k < std::min(moduli.size(), times.size()); ++k) elements.push_back({moduli[k], times[k]});
  }

  double short_modulus() const {
    return std::accumulate(elements.begin(), elements.end(), long_modulus,
                           [](double sum, const MaxwellElement& m) { return sum + m.modulus; });
  }
};

class Viscoelastic final : public Material {
 public:
  explicit Viscoelastic(ViscoelasticParameters p) : p_(std::move(p)) {
    history_.push_back({"dissipation", Dimension::stress});
    for (std::size_t k = 0; k < p_.elements.size(); ++k)
      for (const char* component : {"xx", "yy", "zz", "xy", "yz", "xz"})
        history_.push_back({"s" + std::to_string(k + 1) + component, Dimension::stress});
  }

  void update(const MaterialPoints<2>& points) const override { advance<2>(points); }
  void update(const MaterialPoints<3>& points) const override { advance<3>(points); }
  double density() const override { return p_.density; }
  double wave_modulus() const override { return p_.bulk_modulus + 4.0 / 3.0 * p_.short_modulus(); }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored<2>(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored<3>(points); }
  int dissipation_index() const override { return 0; }
  const std::vector<HistoryVariable>& history() const override { return history_; }

 private:
  // Deviatoric stresses of the Maxwell elements at one point.
  using Elements = std::array<Mat3, 8>;

  template <class Points>
  Elements load(const Points& points, int i) const {
    Elements s;
    for (std::size_t k = 0; k < p_.elements.size(); ++k)
      s[k] = load_symmetric<3>(points.history.subspan(1 + 6 * k, 6), i);
    return s;
  }

  struct Result {
    Mat3 stress;
    Elements elements;
    double dissipated;  // per current volume [stress]
  };

  Result advanced(const Mat3& L, double dt, const Mat3& old, const Elements& before) const {
    const Mat3 half = spin_rotation(L, 0.5 * dt), D = 0.5 * dt * (L + L.transpose());
    const Mat3 strain = D - D.trace() / 3 * Mat3::Identity();
    const auto turned = [&](const Mat3& m) { return Mat3(half * m * half.transpose()); };
    Result r{old, before, 0.0};
    for (std::size_t k = 0; k < p_.elements.size(); ++k) r.stress -= before[k];
    r.stress = turned(r.stress) + p_.bulk_modulus * D.trace() * Mat3::Identity() + 2 * p_.long_modulus * strain;
    for (std::size_t k = 0; k < p_.elements.size(); ++k) {
      const auto [G, tau] = p_.elements[k];
      const double ratio = dt / tau, gone = -std::expm1(-ratio), x = 1 - gone;
      const Mat3 start = turned(before[k]), steady = 2 * G / ratio * strain;
      r.elements[k] = x * start + gone * steady;
      r.stress += r.elements[k];
      // integral of s:s dt/(2 G tau) for s = start e + steady (1 - e), e = exp(-t/tau)
      const double rest =
          ratio < 1e-3 ? ratio * ratio * ratio * (1.0 / 3 - 0.25 * ratio) : ratio - gone * (1 + 0.5 * gone);
      r.dissipated += (0.5 * gone * (1 + x) * start.squaredNorm() + gone * gone * start.cwiseProduct(steady).sum() +
                       rest * steady.squaredNorm()) /
                      (2 * G);
      r.elements[k] = turned(r.elements[k]);
    }
    r.stress = turned(r.stress);
    return r;
  }

  template <int Dim>
  void advance(const MaterialPoints<Dim>& points) const {
    for (int i = 0; i < points.count; ++i) {
      Mat3 L = load_full<Dim>(points.L, i);
      const Mat3 old = load_symmetric<Dim>(points.stress, i);
      const Elements before = load(points, i);
      Result r = advanced(L, points.dt, old, before);
      if (Dim == 2 && points.plane_stress) {
        const auto trial = [&](double rate) {
          L(2, 2) = rate;
          r = advanced(L, points.dt, old, before);
          return r.stress(2, 2);
        };
        out_of_plane_rate(trial, wave_modulus(), points.dt);
        constexpr auto zz = static_cast<std::size_t>(Layout<Dim>::full - 1);
        const double stretch = std::exp(L(2, 2) * points.dt);
        points.L[zz][i] = L(2, 2);
        points.F[zz][i] *= stretch, points.volume[i] *= stretch;
        r.stress(2, 2) = 0;
      }
      store_symmetric<Dim>(r.stress, points.stress, i);
      for (std::size_t k = 0; k < p_.elements.size(); ++k)
        store_symmetric<3>(r.elements[k], points.history.subspan(1 + 6 * k, 6), i);
      points.history[0][i] += load_full<Dim>(points.F, i).determinant() * r.dissipated;
    }
  }

  template <int Dim>
  double stored(const MaterialPoints<Dim>& points) const {
    double sum = 0;
    for (int i = 0; i < points.count; ++i) {
      Mat3 rest = load_symmetric<Dim>(points.stress, i);
      const double p = rest.trace() / 3;
      const Elements s = load(points, i);
      double energy = p * p / (2 * p_.bulk_modulus);
      rest -= p * Mat3::Identity();
      for (std::size_t k = 0; k < p_.elements.size(); ++k)
        rest -= s[k], energy += s[k].squaredNorm() / (4 * p_.elements[k].modulus);
      if (p_.long_modulus > 0) energy += rest.squaredNorm() / (4 * p_.long_modulus);
      sum += points.volume[i] * energy;
    }
    return sum;
  }

  ViscoelasticParameters p_;
  std::vector<HistoryVariable> history_;
};

}  // namespace

Catalogue<Material>::Item viscoelastic() { return material_law<ViscoelasticParameters, Viscoelastic>(); }

}  // namespace tribo
