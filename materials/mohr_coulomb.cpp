// SPDX-License-Identifier: MIT
/// Mohr-Coulomb plasticity and viscoplasticity over batches of points.
///
/// The trial stress (Jaumann rate) is that of elastic_step. It is returned to the pyramid in principal stress space,
/// see mohr_coulomb_return.hpp. Rate dependence after Duvaut & Lions (1972), backward Euler: sigma = (trial + b
/// returned)/(1 + b), b = dt/eta.

#include "materials/mohr_coulomb_batch.hpp"
#include "materials/plane_stress.hpp"

namespace tribo {
namespace {

class MohrCoulomb final : public Material {
 public:
  explicit MohrCoulomb(MohrCoulombLaw law) : law_(law), edges_(law_) {}

  void update(const MaterialPoints<2>& points) const override { advance<2>(points); }
  void update(const MaterialPoints<3>& points) const override { advance<3>(points); }
  double density() const override { return law_.density; }
  double wave_modulus() const override { return law_.elastic.wave_modulus(); }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored<2>(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored<3>(points); }
  int dissipation_index() const override { return 3; }
  std::optional<Opening> opening() const override {
    if (!law_.cohesionless()) return std::nullopt;  // cracks stay open
    return Opening{4, 1, law_.elastic.bulk()};
  }
  std::shared_ptr<const Material> weakened(double factor) const override {
    MohrCoulombLaw law = law_;
    law.weaken(factor);
    return std::make_shared<MohrCoulomb>(law);
  }
  const std::vector<HistoryVariable>& history() const override {
    static const std::vector<HistoryVariable> variables{
        {"plastic_shear"}, {"plastic_volume"}, {"tension_strain"}, {"dissipation", Dimension::stress}, {"opening"}};
    return variables;
  }

 private:
  template <int Dim>
  void advance(const MaterialPoints<Dim>& points) const {
    for (int begin = 0; begin < points.count; begin += chunk) {
      const Slice<Dim> slice(points, begin);
      if constexpr (Dim == 2) {
        if (points.plane_stress) {
          for (int i = 0; i < slice.points.count; ++i) plane_stress_point(slice, i);
          continue;
        }
      }
      elastic_step<Dim>(slice.points, law_.elastic);
      close_openings(slice);
      yield_beyond(slice);
    }
  }

  // Closes what is open before it is pressed, see MohrCoulombLaw::close.
  template <int Dim>
  void close_openings(const Slice<Dim>& slice) const {
    double* __restrict volume = slice.columns[1];
    double* __restrict opening = slice.columns[4];
    const int count = slice.points.count;
    if (!law_.cohesionless() || !(*std::max_element(opening, opening + count) > 0)) return;
    double* __restrict xx = slice.points.stress[0];
    double* __restrict yy = slice.points.stress[1];
    double* __restrict zz = slice.points.stress[2];
    const double bulk = law_.elastic.bulk(), compliance = 1 / (3 * bulk);
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      const double strain = std::min(std::max(-compliance * (xx[i] + yy[i] + zz[i]), 0.0), opening[i]);
      opening[i] -= strain, volume[i] -= strain;
      xx[i] += bulk * strain, yy[i] += bulk * strain, zz[i] += bulk * strain;
    }
  }

  template <int Dim>
  void yield_beyond(const Slice<Dim>& slice) const {
    if (law_.softens()) {
      for (int i = 0; i < slice.points.count; ++i)
        plastic_point(slice, i, Pyramid(law_.elastic, law_.strength(slice.columns[0][i], slice.columns[2][i])));
      return;
    }
    std::array<double, chunk> bound;
    yield_bound(slice.points, law_.pyramid().strength(), bound.data());
    if (!any_beyond(bound, slice.points.count)) return;
    const PlasticHistory plastic_history(slice, law_.elastic);
    const Face face(law_, slice.points.dt);
    Edges edges = edges_;
    edges.share = slice.points.dt / (slice.points.dt + law_.relaxation_time);
    const bool with_edges = law_.viscosity == 0;  // with viscosity the shares of the planes at edges are not constant
    if constexpr (Dim == 2) {
      flow(slice, face, plastic_history, bound.data());
      if (with_edges && any_beyond(bound, slice.points.count)) flow(slice, edges, plastic_history, bound.data());
    } else {
      Spectrum spectrum;
      decompose(slice, spectrum);
      flow(slice, spectrum, face, plastic_history, bound.data());
      if (with_edges && any_beyond(bound, slice.points.count))
        flow(slice, spectrum, edges, plastic_history, bound.data());
    }
    for (int i = 0; i < slice.points.count; ++i)
      if (bound[static_cast<std::size_t>(i)] > 0) plastic_point(slice, i, law_.pyramid());
  }

  void plastic_point(const Slice<2>& slice, int i, const Pyramid& pyramid) const {
    const auto& stress = slice.points.stress;
    const double mean = 0.5 * (stress[0][i] + stress[1][i]), half = 0.5 * (stress[0][i] - stress[1][i]);
    const double shear = stress[3][i], zz = stress[2][i];
    const double radius = std::sqrt(half * half + shear * shear);
    const double low = mean - radius, high = mean + radius;
    // positions of the in-plane principal values and of zz in the sorted triple
    const std::size_t z = zz <= low ? 0 : zz <= high ? 1 : 2, l = z == 0 ? 1 : 0, h = z == 2 ? 1 : 2;
    Triple trial;
    trial[l] = low, trial[h] = high, trial[z] = zz;
    if (!pyramid.yields(trial[0], trial[2])) return;
    MohrCoulombState state = slice.load(i);
    const Triple change = law_.flow(trial, slice.points.dt, volume_ratio<2>(slice.points, i), state);
    const double mean_change = 0.5 * (change[h] + change[l]);
    const double turn = radius > 0 ? 0.5 * (change[h] - change[l]) / radius : 0.0;
    stress[0][i] -= mean_change + turn * half;
    stress[1][i] -= mean_change - turn * half;
    stress[2][i] -= change[z];
    stress[3][i] -= turn * shear;
    slice.store(state, i);
  }

  void plastic_point(const Slice<3>& slice, int i, const Pyramid& pyramid) const {
    const auto& s = slice.points.stress;
    const Principal p = principal(s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]);
    if (!pyramid.yields(p.value[0], p.value[2])) return;
    MohrCoulombState state = slice.load(i);
    const Triple change = law_.flow(p.value, slice.points.dt, volume_ratio<3>(slice.points, i), state);
    const double first = change[0] - change[1], last = change[2] - change[1];
    const Triple &n = p.axis[0], &m = p.axis[2];
    s[0][i] -= change[1] + first * n[0] * n[0] + last * m[0] * m[0];
    s[1][i] -= change[1] + first * n[1] * n[1] + last * m[1] * m[1];
    s[2][i] -= change[1] + first * n[2] * n[2] + last * m[2] * m[2];
    s[3][i] -= first * n[0] * n[1] + last * m[0] * m[1];
    s[4][i] -= first * n[1] * n[2] + last * m[1] * m[2];
    s[5][i] -= first * n[0] * n[2] + last * m[0] * m[2];
    slice.store(state, i);
  }

  void plane_stress_point(const Slice<2>& slice, int i) const {
    const auto& points = slice.points;
    Motion motion{load_full<2>(points.F, i), load_full<2>(points.L, i), points.dt};
    const Mat3 old = load_symmetric<2>(points.stress, i);
    const MohrCoulombState start = slice.load(i);
    const double F_zz = motion.F(2, 2);
    MohrCoulombState state;
    Mat3 stress;
    const auto trial = [&](double rate) {
      motion.L(2, 2) = rate;
      motion.F(2, 2) = F_zz * std::exp(rate * motion.dt);
      state = start;
      stress = law_.stress(motion, old, state);
      return stress(2, 2);
    };
    out_of_plane_rate(trial, law_.elastic.wave_modulus(), motion.dt);
    points.L[4][i] = motion.L(2, 2);
    points.F[4][i] = motion.F(2, 2);
    points.volume[i] *= motion.F(2, 2) / F_zz;
    stress(2, 2) = 0;
    store_symmetric<2>(stress, points.stress, i);
    slice.store(state, i);
  }

  template <int Dim>
  double stored(const MaterialPoints<Dim>& points) const {
    double sum = 0;
    for (int i = 0; i < points.count; ++i)
      sum += points.volume[i] * law_.elastic.energy(load_symmetric<Dim>(points.stress, i));
    return sum;
  }

  MohrCoulombLaw law_;
  Edges edges_;
};

}  // namespace

Catalogue<Material>::Item mohr_coulomb() { return material_law<MohrCoulombLaw, MohrCoulomb>(); }

}  // namespace tribo
