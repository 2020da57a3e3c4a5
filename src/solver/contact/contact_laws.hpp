// SPDX-License-Identifier: MIT
/// The contact law between every two velocity fields.
#pragma once

#include "contact/interface.hpp"
#include "solver/state/system.hpp"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace tribo {

/// Table of the contact laws of a model by pairs of fields, and what they need from the contact search.
template <int Dim>
class ContactLaws {
 public:
  /// Fills the table for all bodies, deformable or rigid, that have a velocity field of their own.
  ContactLaws(const Model& model, const System<Dim>& system);

  /// The law between two fields on the same side of all cracks (Field::home); null if it is the same field.
  const ContactLaw* between(std::size_t field_a, std::size_t field_b) const {
    return table_[field_a * field_count_ + field_b];
  }
  std::size_t field_count() const { return field_count_; }
  /// Some law reads slip or bonds, which the particles keep.
  bool any_has_memory() const { return any_has_memory_; }
  /// Some law reads the contact area.
  bool any_uses_area() const { return any_uses_area_; }

 private:
  std::size_t field_count_;
  std::vector<const ContactLaw*> table_;                                           // field_count_ x field_count_
  std::map<std::pair<int, int>, std::shared_ptr<const InterfaceLaw>> interfaces_;  // limited, by materials
  bool any_has_memory_ = false, any_uses_area_ = false;
};

}  // namespace tribo
