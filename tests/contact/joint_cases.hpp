// SPDX-License-Identifier: MIT
/// A single contact between two bodies with a joint law and prescribed motion.
#pragma once

#include "contact/joint_law.hpp"

#include <catch2/catch.hpp>

#include <initializer_list>
#include <string>
#include <utility>

namespace tribo::test {

using Properties = std::vector<std::pair<std::string, std::string>>;

inline Properties operator+(Properties a, const Properties& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Statement joint_statement(const Properties& properties) {
  Statement s;
  s.name = "Material";
  for (const auto& [name, value] : properties) {
    Statement child;
    child.name = name, child.text = value;
    s.children.push_back(child);
  }
  return s;
}

/// The text of all problems with a law, then of the warnings.
inline std::string complaints(const char* type, const Properties& properties) {
  Problems problems;
  joint_laws().find(type)->make(joint_statement(properties), {}, Units{}, problems);
  std::string out;
  try {
    problems.raise();
  } catch (const InputError& error) {
    out = error.what();
  }
  for (const auto& w : problems.warnings()) out += "warning: " + w.message + "\n";
  return out;
}

class Contact {
 public:
  Contact(const char* type, const Properties& properties, const JointSite& site, const Units& units = {})
      : gap_(site.gap) {
    Problems problems;
    law_ = joint_laws().find(type)->make(joint_statement(properties), {}, units, problems);
    problems.raise();
    joint = law_->start(site);
  }

  Joint joint;
  std::vector<JointEvent> events;
  double dt = 1.0, mass = 0.0;

  /// One step; the gap follows the opening.
  Contact& move(double normal, Tangent shear = {}, double twist = 0, Tangent bend = {}) {
    JointIncrement d;
    gap_ += normal;
    d.normal = normal, d.shear = shear, d.twist = twist, d.bend = bend, d.gap = gap_, d.dt = dt, d.mass = mass;
    d.poisson_normal = poisson_normal, d.poisson_shear = poisson_shear;
    law_->update({&joint, 1}, {&d, 1}, events);
    return *this;
  }
  Contact& shear(double s, double t = 0) { return move(0, {s, t}); }
  /// Equal steps along s.
  Contact& slide(int steps, double by) {
    for (int k = 0; k < steps; ++k) shear(by);
    return *this;
  }
  double poisson_normal = 0;
  Tangent poisson_shear;

  std::string state() const { return law_->state_text(joint); }
  double own(std::string_view name) const {
    const auto names = law_->own_names();
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == name) return law_->own_values(joint)[k];
    throw std::logic_error("no such number");
  }
  int count(JointEvent::Kind kind) const {
    int out = 0;
    for (const auto& e : events) out += e.kind == kind;
    return out;
  }

 private:
  std::shared_ptr<JointLaw> law_;
  double gap_;
};

inline Approx near(double value, double tolerance = 1e-9) { return Approx(value).epsilon(tolerance).margin(1e-14); }

}  // namespace tribo::test
