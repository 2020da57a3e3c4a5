// SPDX-License-Identifier: MIT
#include "particles/seed_maker.hpp"

#include "base/text.hpp"

#include <Eigen/LU>

#include <cmath>

namespace tribo {
namespace {

std::string text(const Vec3& x) {
  return "(" + std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) + ")";
}

template <class Functions>
bool given(const Functions& functions) {
  for (const auto& f : functions)
    if (f) return true;
  return false;
}
bool varies(const Piece& piece) { return piece.deformation || given(piece.velocity_function) || piece.stress.given(); }

void check_finite(const Seed& seed, const Origin& origin) {
  if (!seed.x.allFinite() || !seed.v.allFinite() || !seed.stress.allFinite() || !seed.F.allFinite())
    throw InputError(origin, "a function of this body has no finite value at " + text(seed.x));
}

}  // namespace

const Material& SeedMaker::law(int material, const Origin& origin) const {
  if (material < 0 || material >= static_cast<int>(model_.materials.size()))
    throw InputError(origin, "this body has no material");
  const auto& spec = model_.materials[static_cast<std::size_t>(material)];
  if (!spec.law) throw InputError(origin, "'" + spec.name + "' is a contact law and cannot be the material of a body");
  return *spec.law;
}

void SeedMaker::check_stress(const Piece& piece) const {
  if ((piece.K0 || piece.stress.given()) && !keeps_stress(law(piece.material, piece.origin)))
    throw InputError(piece.origin, "'" + model_.materials[static_cast<std::size_t>(piece.material)].name +
                                       "' keeps no initial stress: its stress is a function of the deformation. Use "
                                       "<Deform> instead");
}

Seed SeedMaker::pattern(std::size_t p, const Vec3& spacing) const {
  const Piece& piece = model_.pieces[p];
  Seed seed;
  seed.piece = static_cast<int>(p);
  seed.material = piece.material;
  seed.mass = law(piece.material, piece.origin).density();
  seed.angle = piece.angle;
  seed.temperature = piece.temperature.value_or(model_.heat.reference);
  seed.v = piece.velocity;
  seed.half_size = 0.5 * spacing;
  if (model_.dimension() == 2) seed.half_size[2] = 0.5 * thickness(piece.thickness);
  seed.volume = 8.0 * seed.half_size.prod();
  return seed;
}

// Out-of-plane thickness; one radian for axisymmetric analyses.
double SeedMaker::thickness(const std::optional<double>& own) const {
  return model_.analysis == Analysis::axisymmetric ? 1.0 : own.value_or(model_.grid.thickness);
}

Seed SeedMaker::cut(const Seed& pattern, const CutCell& cell, double whole) const {
  Seed seed = pattern;
  const bool flat = model_.dimension() == 2;
  seed.volume *= cell.volume / whole;
  Mat3 axes = cell.half_axes(flat);
  // A box of the same volume; joined cells are not larger than the grid's, as uGIMP needs
  seed.half_size = pattern.half_size * std::pow(cell.volume / whole, flat ? 0.5 : 1.0 / 3);
  seed.half_size = seed.half_size.cwiseMin(pattern.half_size.cwiseMax(0.5 * grid_.cell));
  if (flat) axes(2, 2) = seed.half_size[2] = pattern.half_size[2];
  seed.half_axes = axes;
  return seed;
}

Seed SeedMaker::at(const Piece& piece, const Seed& pattern, const Vec3& x) const {
  Seed seed = pattern;
  seed.x = x;
  const auto set = [](double& target, const std::optional<Expression>& function, const Variables& at) {
    if (function) target = (*function)(at);
  };
  if (varies(piece)) {
    const auto here = Variables::at(x);
    for (std::size_t k = 0; k < 3; ++k) set(seed.v[static_cast<Eigen::Index>(k)], piece.velocity_function[k], here);
    piece.stress.set(x, seed.stress);
    if (piece.deformation) deform(piece, here, seed);
  }
  weigh(seed, x[0], piece.origin);
  check_finite(seed, piece.origin);
  return seed;
}

void SeedMaker::deform(const Piece& piece, const Variables& at, Seed& seed) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (piece.deformation->shift[i]) seed.x[row] += (*piece.deformation->shift[i])(at);
    for (std::size_t j = 0; j < 3; ++j)
      if (piece.deformation->F[i][j]) seed.F(row, static_cast<Eigen::Index>(j)) = (*piece.deformation->F[i][j])(at);
  }
  if (!(seed.F.determinant() > 0.0))
    throw InputError(piece.origin, "the initial deformation is singular or inverts the body (det F = " +
                                       std::to_string(seed.F.determinant()) + ") at " + text(seed.x));
  if (!grid_.contains(seed.x))
    throw InputError(piece.origin, "the initial deformation moves a point out of the grid, to " + text(seed.x));
}

// Sets volume and mass of a domain whose centre is at radius r before any deformation.
void SeedMaker::weigh(Seed& seed, double r, const Origin& origin) const {
  if (model_.analysis == Analysis::axisymmetric) {
    if (!(r > 0.0) || !(seed.x[0] >= 0.0))
      throw InputError(origin, "a point lies at radius " + std::to_string(std::min(r, seed.x[0])) +
                                   "; radii must be positive in an axisymmetric analysis");
    seed.volume *= r;
  }
  seed.mass *= seed.volume;
}

Seed SeedMaker::of_table(std::size_t table, std::size_t row) const {
  const ParticleTable& of = model_.tables[table];
  Seed seed;
  seed.x = of.position[row], seed.v = of.velocity[row], seed.half_size = of.half_size[row];
  if (!grid_.contains(seed.x))
    throw InputError(of.place(row), "the particle " + std::to_string(row + 1) + " of this table, at " + text(seed.x) +
                                        ", lies outside the grid");
  for (int d = 0; d < model_.dimension(); ++d)
    if (2 * seed.half_size[d] > grid_.cell[d] * (1 + 1e-9))
      throw InputError(of.place(row), "the domain of particle " + std::to_string(row + 1) + " is " +
                                          format("%g", 2 * seed.half_size[d]) + " long along " + "xyz"[d] +
                                          ", more than a cell, " + format("%g", grid_.cell[d]) +
                                          "; particles are at most as large as a cell");
  seed.material = of.material, seed.angle = of.angle;
  seed.temperature = of.temperatures.empty() ? of.temperature.value_or(model_.heat.reference) : of.temperatures[row];
  seed.volume = of.volume[row];
  seed.mass = of.mass.empty() ? law(of.material, of.origin).density() * seed.volume : of.mass[row];
  if (!of.stress.empty()) {
    const auto& s = of.stress[row];
    seed.stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  }
  seed.table = static_cast<int>(table), seed.row = row;
  return seed;
}

Seed SeedMaker::at(const PointSpec& point, int per_axis) const {
  if (!grid_.contains(point.position))
    throw InputError(point.origin, "the point " + text(point.position) + " lies outside the grid");
  const Material& material = law(point.material, point.origin);
  Seed seed;
  seed.x = point.position;
  seed.v = point.velocity;
  seed.angle = point.angle;
  seed.temperature = point.temperature.value_or(model_.heat.reference);
  seed.material = point.material;
  for (int k = 0; k < 3; ++k) seed.half_size[k] = 0.5 * grid_.cell[k] / (k < model_.dimension() ? per_axis : 1);
  if (point.half_size) seed.half_size = *point.half_size;
  if (model_.dimension() == 2) seed.half_size[2] = 0.5 * thickness(point.thickness);
  if (!(seed.half_size.minCoeff() > 0.0)) throw InputError(point.origin, "the domain of the point has no volume");
  seed.volume = 8.0 * seed.half_size.prod();
  seed.mass = material.density();
  weigh(seed, point.position[0], point.origin);
  if (point.mass) seed.mass = *point.mass;
  if (!(seed.mass > 0.0)) throw InputError(point.origin, "the mass of the point must be positive");
  return seed;
}

}  // namespace tribo
