// SPDX-License-Identifier: MIT
/// Criteria for the growth of crack tips, and the direction of growth.

#include "geometry/crossing.hpp"
#include "solver/cracks/crack_build.hpp"
#include "solver/cracks/crack_tips.hpp"
#include "solver/neighbours/body_occupancy.hpp"

#include <cmath>

namespace tribo {
namespace {

/// Angle of the largest hoop stress. Erdogan, Sih, J. Basic Eng. 85 (1963) 519-525.
double hoop_angle(double K1, double K2) {
  if (K2 == 0) return 0.0;
  return 2 * std::atan((K1 - std::hypot(K1, std::sqrt(8.0) * K2)) / (4 * K2));
}

/// Stress intensity factor of the pure mode 1 that has the same hoop stress at this angle.
double hoop_intensity(double K1, double K2, double angle) {
  const double c = std::cos(0.5 * angle);
  return c * (K1 * c * c - 1.5 * K2 * std::sin(angle));
}

/// The local minimum of the strain energy density near the angle of the largest hoop stress. Returns the density at
/// the distance r times 16 pi G r, and its angle. Sih,
/// Int. J. Fracture 10 (1974) 305-321.
std::pair<double, double> least_energy_density(double K1, double K2, double kappa) {
  const auto density = [&](double a) {
    const double c = std::cos(a), s = std::sin(a);
    return (1 + c) * (kappa - c) * K1 * K1 + 2 * s * (2 * c - kappa + 1) * K1 * K2 +
           ((kappa + 1) * (1 - c) + (1 + c) * (3 * c - 1)) * K2 * K2;
  };
  // golden section
  double low = hoop_angle(K1, K2) - 0.7, high = low + 1.4;
  constexpr double part = 0.3819660112501051;
  for (int k = 0; k < 60; ++k) {
    const double a = low + part * (high - low), b = high - part * (high - low);
    (density(a) < density(b) ? high : low) = density(a) < density(b) ? b : a;
  }
  const double angle = 0.5 * (low + high);
  return {density(angle), angle};
}

}  // namespace

std::optional<double> CrackTips<2>::angle_of_growth(const Crack<2>& crack, const CrackTip& tip) const {
  const MaterialSpec& material = model_.materials[static_cast<std::size_t>(system_.bodies[tip.body].material)];
  const Toughness& toughness = material.toughness;
  const auto [K1, K2] = tip.K;
  double angle = hoop_angle(K1, K2);
  if (!tip.has_K && material.growth.when != Growth::When::release_rate) return std::nullopt;
  switch (material.growth.when) {
    case Growth::When::never:
      return std::nullopt;
    case Growth::When::hoop_stress:
      if (!(hoop_intensity(K1, K2, angle) >= *toughness.KIc)) return std::nullopt;
      break;
    case Growth::When::energy_density: {
      const double k = kappa(*moduli_[tip.body]);
      const auto [density, density_angle] = least_energy_density(K1, K2, k);
      if (!(hoop_intensity(K1, K2, angle) > 0 && density >= 2 * (k - 1) * *toughness.KIc * *toughness.KIc))
        return std::nullopt;
      angle = density_angle;
      break;
    }
    case Growth::When::empirical:
      if (!(std::pow(std::max(K1, 0.0) / *toughness.KIc, toughness.KIexp) +
                std::pow(std::abs(K2) / *toughness.KIIc, toughness.KIIexp) >=
            1))
        return std::nullopt;
      break;
    case Growth::When::release_rate:
      if (!(tip.J >= *toughness.JIc)) return std::nullopt;
      angle = 0.0;
      break;
  }
  const Vec<2> along = crack.direction_at(tip, tip_length * cell_), up(-along[1], along[0]);
  const Vec<2> opening = (tip.end == 1 ? 1 : -1) * crack.opening(tip.previous);
  const double normal_opening = opening.dot(up), shear_opening = opening.dot(along);
  switch (material.growth.way) {
    case Growth::Way::of_criterion:
      return angle;
    case Growth::Way::straight_on:
      return 0.0;
    case Growth::Way::normal_to_opening:
      return std::atan2(-shear_opening, normal_opening);
    case Growth::Way::hoop_of_opening:
      return hoop_angle(normal_opening, shear_opening);
    case Growth::Way::as_at_start:
      return std::atan2(tip.initial_direction.dot(up), tip.initial_direction.dot(along));
  }
  return std::nullopt;
}

bool CrackTips<2>::grow() {
  bool grew = false;
  for (std::size_t c = 0; c < system_.cracks.size(); ++c)
    for (std::size_t t = 0; t < system_.cracks[c].tips.size(); ++t) {
      CrackTip& tip = system_.cracks[c].tips[t];
      if (!tip.active || system_.time < tip.earliest_growth) continue;
      const auto angle = angle_of_growth(system_.cracks[c], tip);
      if (!angle) continue;
      extend(c, tip, *angle);
      grew = true;
    }
  return grew;
}

double CrackTips<2>::longest(std::size_t number) const {
  double most = 0.0;
  for (std::size_t c = 0; c < system_.cracks.size(); ++c) {
    if (number < system_.cracks.size() && c != number) continue;
    const Crack<2>& crack = system_.cracks[c];
    double length = 0.0;
    for (std::size_t p = 0; p < crack.main_pieces; ++p)
      length += (crack.x[crack.pieces[p][1]] - crack.x[crack.pieces[p][0]]).norm();
    most = std::max(most, length);
  }
  return most;
}

// Extends the tip by one increment. The speed of growth is limited by the speed of surface waves.
void CrackTips<2>::extend(std::size_t c, CrackTip& tip, double angle) {
  Crack<2>& crack = system_.cracks[c];
  const double full_length = model_.fracture->hop * system_.lattice.smallest_spacing();
  const Vec<2> from = crack.x[tip.point];
  const Vec<2> ahead = Eigen::Rotation2Dd(angle) * crack.direction_at(tip, tip_length * cell_);
  double length = full_length;
  for (const auto& other : system_.cracks)
    for (std::size_t p = 0; p < other.main_pieces; ++p) {
      const auto [a, b] = other.pieces[p];
      if (&other == &crack && (a == tip.point || b == tip.point)) continue;
      const auto corners = other.corners(p);
      if (crossing(corners, from, from + 1.1 * full_length * ahead) == 0) continue;
      // the tip stops just before the other crack
      const Vec<2> area = Crack<2>::area(corners);
      length = std::min(length, 0.99 * area.dot(corners[0] - from) / area.dot(ahead));
      tip.active = false;
    }
  grow_to(crack, tip, from + length * ahead);
  // J may be negative only where the contour meets a loaded surface, where it is no energy release rate.
  tip.released += std::max(tip.J, 0.0) * length * model_.grid.thickness;
  const auto& law = *system_.bodies[tip.body].law;
  const double shear_speed =
      std::sqrt((moduli_[tip.body] ? moduli_[tip.body]->G : law.wave_modulus() / 3) / law.density());
  constexpr double rayleigh_ratio = 0.9;  // speed of surface waves over that of shear waves
  tip.earliest_growth = system_.time + length / (rayleigh_ratio * shear_speed);

  const Vec<2> reach = Vec<2>::Constant(8 * cell_);
  const BodyOccupancy<2> occupancy(model_, system_, from - reach, from + reach);
  // the tolerance spans gaps between stretched particles
  if (!occupancy.contains(crack.x[tip.point], 0.5)) {
    tip.active = false;
    extend_straight(crack, tip, cell_, extension_cells_);
  }
  if (!tip.active) tip.J = 0.0, tip.K = {}, tip.has_K = false;  // the crack ends at a surface and has no tip there
}

}  // namespace tribo
