// SPDX-License-Identifier: MIT
/// The interface between the engine and the laws of contact: two velocity fields that meet at a node.
///
/// Conventions. a and b are the two sides, n the unit normal from a to b, "relative" always b minus a. The impulse J
/// acts on a, -J on b; J . n > 0 pulls them together (tension). m is the reduced mass m_a m_b / (m_a + m_b), so that
/// J = m v ends the relative velocity v: the faces stick. Tractions are impulses over area and step.
#pragma once

#include "base/catalogue.hpp"
#include "base/types.hpp"

#include <functional>
#include <memory>

namespace tribo {

/// What the faces did; kept by the particles near them and shown in the output.
enum class ContactStatus { open, stick, slip };

/// Whether an adhesive bond joins the faces.
enum class Bond { none, whole, broken };

/// Two fields at one node, as far as their law may know.
struct ContactState {
  double mass = 0.0;  ///< reduced mass                                                        [mass]
  double dt = 0.0;    ///< step                                                                [time]
  double area = 0.0;  ///< of the faces at this node                                           [length^2]
  double gap = 0.0;   ///< between the faces at the start of the step, negative: overlap       [length]
  Vec3 normal = Vec3::UnitX();
  Vec3 velocity = Vec3::Zero();  ///< relative, at the end of the step if the law did nothing  [velocity]
  Vec3 start = Vec3::Zero();     ///< relative velocity at the start of the step               [velocity]
  Vec3 opening = Vec3::Zero();   ///< relative displacement since the faces were together      [length]
  double slip = 0.0;             ///< way the faces slid since they last stuck                 [length]
  double cell = 1.0;             ///< size of the grid's cells                                 [length]
  Bond bond = Bond::none;
};

struct ContactResponse {
  Vec3 impulse = Vec3::Zero();  ///< on a                                                      [mass velocity]
  ContactStatus status = ContactStatus::open;
  Bond bond = Bond::none;
  double stored = 0.0;  ///< energy in the interface at the end of the step                    [energy]
};

/// Viscosity over shear rate [stress time](1/time); from a liquid's material.
using Viscosity = std::function<double(double rate)>;

class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  /// Must not create kinetic energy unless it takes it from `stored`; must give the mirrored answer for mirrored sides.
  virtual ContactResponse response(const ContactState& state) const = 0;

  /// The law reads normal and gap.
  virtual bool looks_at_faces() const { return true; }
  /// Imperfect interfaces act only in the momentum update, on displacements.
  virtual bool interface() const { return false; }
  /// The law reads `slip` or `bond`, which the particles then keep.
  virtual bool remembers() const { return false; }
  /// The law reads `area`.
  virtual bool uses_area() const { return false; }
  /// Stiffness of an interface, the largest of its directions [stress/length]; 0 for laws without.
  virtual double stiffness() const { return 0.0; }
  /// Number of the liquid whose viscosity the law needs, or 0; it is given before the run.
  virtual int liquid() const { return 0; }
  virtual void set_viscosity(const Viscosity&) {}
};

/// Catalogue entry of a law, see material_law: `Law` has name, summary, number, parameters() and prepare().
template <class Law>
Catalogue<ContactLaw>::Item contact_law(const std::vector<std::string>& aliases = {}) {
  return catalogue_item<ContactLaw, Law, Law>(aliases);
}

/// All contact laws; generated from contact/CMakeLists.txt.
const Catalogue<ContactLaw>& contact_laws();

}  // namespace tribo
