// SPDX-License-Identifier: MIT
/// Imperfect interfaces: contact laws whose traction is an elastic function of the displacement jump.
#pragma once

#include "contact/contact_law.hpp"

#include <memory>

namespace tribo {

/// An imperfect interface. In each of its two directions, normal and tangential, it is either elastic or perfectly
/// bonded. The elastic directions have a traction that derives from a potential; it acts at points on the common face
/// of two bodies, or on a crack, which keep their own displacement jump (InterfaceJoint). The bonded directions act at
/// the nodes: response() removes the relative velocity in them.
class InterfaceLaw : public ContactLaw {
 public:
  /// The traction at a displacement jump. It is restoring: positive values reduce a positive jump.
  struct Traction {
    double normal = 0.0;      ///< positive in tension                                     [stress]
    double tangential = 0.0;  ///< along the tangential jump                                [stress]
    double energy = 0.0;      ///< stored energy per area                                   [energy/length^2]
  };
  /// Traction of the elastic directions. `normal`: opening, negative if the faces are pressed together; `tangential`:
  /// length of the tangential jump, >= 0 [length].
  virtual Traction traction(double normal, double tangential) const = 0;
  /// Whether a direction is perfectly bonded.
  virtual bool bonds_normal() const = 0;
  virtual bool bonds_tangential() const = 0;
  /// The same law with directions that are stiffer than `largest` [stress/length] perfectly bonded. If only opening or
  /// only closing is bonded or stiffer, it gets the stiffness `largest`.
  virtual std::shared_ptr<const InterfaceLaw> limited(double largest) const = 0;

  /// Some direction is elastic.
  bool is_elastic() const { return !bonds_normal() || !bonds_tangential(); }
  /// Some direction is bonded.
  bool is_bonded() const { return bonds_normal() || bonds_tangential(); }
  const InterfaceLaw* interface() const final { return this; }
  ContactResponse response(const ContactState& m) const final {
    const Vec3 normal = m.velocity.dot(m.normal) * m.normal;
    ContactResponse out{Vec3::Zero(), is_bonded() ? ContactStatus::stick : ContactStatus::open, m.bond};
    if (bonds_normal()) out.impulse += m.mass * normal;
    if (bonds_tangential()) out.impulse += m.mass * (m.velocity - normal);
    return out;
  }
};

/// A normal direction with one stiffness for opening and one for closing, negative if perfectly bonded: both bonded if
/// neither is elastic below `largest`, else both elastic, with at most that stiffness [stress/length].
inline void limit_normal(double& open, double& closed, double largest) {
  const auto stiff = [&](double D) { return D < 0 || D > largest; };
  if (stiff(open) && stiff(closed)) {
    open = closed = -1;
  } else {
    if (stiff(open)) open = largest;
    if (stiff(closed)) closed = largest;
  }
}

}  // namespace tribo
