// SPDX-License-Identifier: MIT
/// The contact law between every two velocity fields.
#pragma once

#include "contact/interface.hpp"
#include "solver/state/system.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace tribo {

/// The contact laws of a model by pairs of fields, and what they need from the contact search. The bodies of a material
/// that touch each other have fields of their own but the same laws, so that there is one entry per pair of materials.
template <int Dim>
class ContactLaws {
 public:
  /// Takes in all bodies, deformable or rigid, that have a velocity field of their own.
  ContactLaws(const Model& model, const System<Dim>& system);

  /// The law between two different fields on the same side of all cracks (Field::base_field); null if one of them has
  /// no body.
  const ContactLaw* between(std::size_t field_a, std::size_t field_b) const {
    const std::size_t a = kind_of_[field_a], b = kind_of_[field_b];
    return std::max(a, b) == no_kind ? nullptr : table_[a * kinds_.size() + b];
  }
  /// Some law reads slip or bonds, which the particles keep.
  bool any_has_memory() const { return any_has_memory_; }
  /// Some law reads the contact area.
  bool any_uses_area() const { return any_uses_area_; }

 private:
  static constexpr auto no_kind = static_cast<std::size_t>(-1);
  // The fields with the same laws.
  struct Kind {
    int material;  // of their bodies
    std::size_t fields = 0;
  };
  void list_kinds(const System<Dim>& system);

  std::vector<Kind> kinds_;
  std::vector<std::size_t> kind_of_;      // per field
  std::vector<const ContactLaw*> table_;  // per pair of kinds; null if no two fields form such a pair
  std::map<std::pair<std::size_t, std::size_t>, std::shared_ptr<const InterfaceLaw>> interfaces_;  // limited, by kinds
  bool any_has_memory_ = false, any_uses_area_ = false;
};

}  // namespace tribo
