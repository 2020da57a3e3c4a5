// SPDX-License-Identifier: MIT
#include "solver/contact/contact_laws.hpp"

#include "solver/state/limited_interface.hpp"

#include <algorithm>
#include <array>

namespace tribo {

template <int Dim>
ContactLaws<Dim>::ContactLaws(const Model& model, const System<Dim>& system) : kind_of_(system.fields.size(), no_kind) {
  list_kinds(system);
  const std::size_t n = kinds_.size();
  table_.assign(n * n, nullptr);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      if (kinds_[a].fields == 0 || kinds_[b].fields == 0 || (a == b && kinds_[a].fields == 1)) continue;
      const std::array materials{kinds_[a].material, kinds_[b].material};
      const ContactLaw* law = model.contact.law(materials[0], materials[1]);
      if (law->interface()) {
        auto& limited = interfaces_[std::minmax(a, b)];
        if (!limited) limited = limited_interface(model, system.lattice, *law->interface(), materials);
        law = limited.get();
      }
      table_[a * n + b] = law;
      any_has_memory_ = any_has_memory_ || law->has_memory();
      any_uses_area_ = any_uses_area_ || law->uses_area();
    }
}

// Materials that share a field have the laws of the last one.
template <int Dim>
void ContactLaws<Dim>::list_kinds(const System<Dim>& system) {
  std::map<int, std::size_t> numbers;  // of the kinds, by material
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const auto& body : *list) {
      if (body.field >= kind_of_.size()) continue;
      const auto [entry, is_new] = numbers.try_emplace(body.material, kinds_.size());
      if (is_new) kinds_.push_back({body.material});
      kind_of_[body.field] = entry->second;
    }
  for (const std::size_t kind : kind_of_)
    if (kind != no_kind) ++kinds_[kind].fields;
}

template class ContactLaws<2>;
template class ContactLaws<3>;

}  // namespace tribo
