// SPDX-License-Identifier: MIT
/// Contact laws from a list of properties, and contact states for tests.
#pragma once

#include "contact/contact_law.hpp"

#include <initializer_list>
#include <random>
#include <utility>

namespace tribo::test {

using LawProperties = std::initializer_list<std::pair<const char*, const char*>>;

inline std::unique_ptr<ContactLaw> make_law(const char* type, LawProperties properties, const Units& units = {}) {
  Statement s;
  s.name = "Material";
  for (const auto& [name, value] : properties) {
    Statement child;
    child.name = name, child.text = value;
    s.children.push_back(child);
  }
  Problems problems;
  auto law = contact_laws().find(type)->make(s, {}, units, problems);
  problems.raise();
  return law;
}

/// ma = 2, mb = 3, va = (1, -0.5), vb = (-1, 0.7), n = (0.8, 0.6), A = 0.25, dt = 1e-3.
inline ContactState plain_meeting() {
  ContactState m;
  m.mass = 1.2, m.dt = 1e-3, m.area = 0.25;
  m.normal = Vec3(0.8, 0.6, 0);
  m.velocity = Vec3(-2, 1.2, 0);
  return m;
}

inline ContactState mirrored(ContactState m) {
  m.normal *= -1, m.velocity *= -1, m.start *= -1;
  return m;
}

/// Change of kinetic energy by an impulse.
inline double energy_change(const ContactState& m, const Vec3& impulse) {
  return -impulse.dot(m.velocity - 0.5 * impulse / m.mass);
}

inline ContactState random_meeting(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> some(0, 1);
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  ContactState m;
  m.mass = 0.1 + some(random), m.dt = 0.01 + 0.1 * some(random), m.area = some(random);
  m.gap = 0.05 * normal(random);
  m.normal = vector().normalized();
  m.velocity = vector(), m.start = vector();
  m.slip = 0.02 * some(random);
  const double bond = some(random);
  m.bond = bond < 0.3 ? Bond::none : bond < 0.6 ? Bond::whole : Bond::broken;
  return m;
}

}  // namespace tribo::test
