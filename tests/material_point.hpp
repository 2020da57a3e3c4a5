// SPDX-License-Identifier: MIT
/// One material point of any law, driven by velocity gradients or by a mixture of these and stresses.
#pragma once

#include "materials/material.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace tribo::test {

using Properties = std::vector<std::pair<std::string, std::string>>;

/// A <Material> statement with one child per property, one line each, in the file `deck`.
inline Statement material_statement(const Properties& properties) {
  const auto file = std::make_shared<const std::string>("deck");
  Statement s;
  s.name = "Material";
  s.origin = {file, 1, 1};
  int line = 2;
  for (const auto& [name, text] : properties) {
    Statement child;
    child.name = name;
    child.text = text;
    child.origin = {file, line, 1};
    child.text_origin = {file, line++, static_cast<int>(name.size()) + 3};
    s.children.push_back(child);
  }
  return s;
}

/// A law from the catalogue in consistent units. Throws InputError with what the law complains about.
inline std::unique_ptr<Material> make_material(std::string_view type, const Properties& properties,
                                               const std::vector<std::string>& handled_elsewhere = {}) {
  const auto* item = materials().find(type);
  if (!item) throw std::runtime_error("no material " + std::string(type));
  Problems problems;
  auto law = item->make(material_statement(properties), handled_elsewhere, Units{}, problems);
  problems.raise();
  return law;
}

/// The properties of both lists.
inline Properties with(Properties properties, const Properties& more) {
  properties.insert(properties.end(), more.begin(), more.end());
  return properties;
}

/// The value of a property with all digits of the number.
inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

/// A diagonal tensor.
inline Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

/// A symmetric tensor from its components in the order xx yy zz xy yz xz.
inline Mat3 symmetric(double xx, double yy, double zz, double xy = 0, double yz = 0, double xz = 0) {
  Mat3 m;
  m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return m;
}

/// e^m.
Mat3 exponential(const Mat3& m);

template <int Dim>
class MaterialPoint {
 public:
  explicit MaterialPoint(const Material& law, bool plane_stress = false) : law_(&law), plane_stress_(plane_stress) {
    for (const auto& v : law.history()) history.push_back(v.initial);
    mass = law.density();
  }

  Mat3 F = Mat3::Identity();
  Mat3 stress = Mat3::Zero();
  std::vector<double> history;
  double volume = 1.0, mass = 1.0;  ///< of unit initial volume
  double temperature = 0.0, reference_temperature = 0.0;
  Mat3 L = Mat3::Zero();  ///< of the last step, with the out-of-plane rate of plane stress
  double work = 0.0;      ///< of the stress, per initial volume, by the trapezoidal rule

  /// Advances by the constant velocity gradient `gradient`, F by its exact exponential.
  void step(const Mat3& gradient, double dt);

  /// Moves to the deformation gradient `target` in one step of unit time.
  void deform(const Mat3& target);

  /// As `step`, but the normal components in `free` of the velocity gradient are found so that these stresses take the
  /// values in `target` (Newton's method, difference quotients). Throws if they cannot be found to `tolerance`
  /// [stress].
  void step_mixed(Mat3 gradient, double dt, const std::vector<int>& free, const Mat3& target, double tolerance);

  double history_value(std::string_view name) const {
    for (std::size_t k = 0; k < history.size(); ++k)
      if (law_->history()[k].name == name) return history[k];
    throw std::runtime_error("no history variable " + std::string(name));
  }

  double stored_energy() {
    return view([&](const MaterialPoints<Dim>& points) { return law_->stored_energy(points); }, 1.0);
  }
  double wave_modulus() {
    return view([&](const MaterialPoints<Dim>& points) { return law_->wave_modulus(points); }, 1.0);
  }

 private:
  void update(double dt) {
    view([&](const MaterialPoints<Dim>& points) { return law_->update(points), 0.0; }, dt);
  }

  // Calls the law with the point as a batch of one and copies the results back.
  template <class Function>
  double view(Function&& f, double dt) {
    std::array<double, Layout<Dim>::full> l, d;
    std::array<double, Layout<Dim>::symmetric> s;
    MaterialPoints<Dim> points;
    for (std::size_t k = 0; k < l.size(); ++k) points.L[k] = &l[k], points.F[k] = &d[k];
    for (std::size_t k = 0; k < s.size(); ++k) points.stress[k] = &s[k];
    store_full<Dim>(L, points.L, 0);
    store_full<Dim>(F, points.F, 0);
    store_symmetric<Dim>(stress, points.stress, 0);
    std::vector<double*> columns;
    for (double& h : history) columns.push_back(&h);
    points.count = 1, points.dt = dt, points.plane_stress = plane_stress_;
    points.mass = &mass, points.volume = &volume, points.history = columns;
    points.temperature = &temperature, points.reference_temperature = reference_temperature;
    const double result = f(std::as_const(points));
    L = load_full<Dim>(points.L, 0);
    F = load_full<Dim>(points.F, 0);
    stress = load_symmetric<Dim>(points.stress, 0);
    return result;
  }

  const Material* law_;
  bool plane_stress_;
};

}  // namespace tribo::test
