// SPDX-License-Identifier: MIT
/// The interface of contact laws: the impulse that two velocity fields exchange at a grid node in one step.
///
/// Conventions. The two sides are a and b, and n is the unit normal from a to b. Relative quantities are those of b
/// minus those of a. The impulse J acts on a, and -J on b; J . n > 0 is tension. The reduced mass is m = m_a m_b / (m_a
/// + m_b), so that J = m v removes the relative velocity v, which means that the faces stick. A traction is an impulse
/// divided by the contact area and the step.
#pragma once

#include "base/catalogue.hpp"
#include "base/types.hpp"

#include <functional>
#include <memory>

namespace tribo {

/// State of a contact: without an impulse, without sliding, or sliding.
enum class ContactStatus { open, stick, slip };

/// State of the adhesive bond between two faces: never bonded, bonded, or broken.
enum class Bond { none, whole, broken };

/// State of a pair of fields at a node, which its law reads.
struct ContactState {
  double mass = 0.0;             ///< reduced mass                                                  [mass]
  double dt = 0.0;               ///< step                                                          [time]
  double area = 0.0;             ///< share of the node in the contact area                         [length^2]
  double gap = 0.0;              ///< between the faces at the start of the step; negative: overlap  [length]
  Vec3 normal = Vec3::UnitX();   ///< unit normal from a to b
  Vec3 velocity = Vec3::Zero();  ///< relative, at the end of the step without the impulse          [velocity]
  Vec3 start = Vec3::Zero();     ///< relative velocity at the start of the step                    [velocity]
  double slip = 0.0;             ///< length of sliding since the faces last stuck                  [length]
  double cell = 1.0;             ///< cell size of the grid                                         [length]
  Bond bond = Bond::none;        ///< at the start of the step
};

/// Result of a contact law for one step.
struct ContactResponse {
  Vec3 impulse = Vec3::Zero();                 ///< on a                                            [mass velocity]
  ContactStatus status = ContactStatus::open;  ///< in this step
  Bond bond = Bond::none;                      ///< at the end of the step
};

/// Viscosity [stress time] of a liquid as a function of its shear rate [1/time].
using Viscosity = std::function<double(double rate)>;

class InterfaceLaw;

/// A contact law. It has no state of its own: what it depends on is in the ContactState.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  /// The impulse and the new state for one step. A law must not add kinetic energy. If a and b are exchanged, the
  /// impulse must change its sign only.
  virtual ContactResponse response(const ContactState& state) const = 0;

  /// The law reads normal and gap, so that it needs a face.
  virtual bool uses_face() const { return true; }
  /// The law as an imperfect interface; null if it is none.
  virtual const InterfaceLaw* interface() const { return nullptr; }
  /// The law gives no impulse to faces that are apart and do not meet within the step, g + dt v_n > 0.
  virtual bool needs_closed_faces() const { return false; }
  /// The law reads `slip` or `bond`, which the particles then store.
  virtual bool has_memory() const { return false; }
  /// The law reads `area`.
  virtual bool uses_area() const { return false; }
  /// The largest stiffness of an interface over its elastic directions [stress/length]; 0 for other laws. It limits
  /// the time step.
  virtual double stiffness() const { return 0.0; }
  /// Number of the material whose viscosity the law needs, or 0. The viscosity is set before the run.
  virtual int liquid() const { return 0; }
  /// Sets that viscosity.
  virtual void set_viscosity(const Viscosity&) {}
};

/// Catalogue entry of a law. `Law` has name, summary, number, parameters() and prepare(), see material_law.
template <class Law>
Catalogue<ContactLaw>::Item contact_law(const std::vector<std::string>& aliases = {}) {
  return catalogue_item<ContactLaw, Law, Law>(aliases);
}

/// All contact laws; generated from contact/CMakeLists.txt.
const Catalogue<ContactLaw>& contact_laws();
/// The same list, to which a program may add laws of its own.
Catalogue<ContactLaw>& extensible_contact_laws();

}  // namespace tribo
