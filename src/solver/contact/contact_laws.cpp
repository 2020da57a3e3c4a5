// SPDX-License-Identifier: MIT
#include "solver/contact/contact_laws.hpp"

#include "solver/state/limited_interface.hpp"

#include <algorithm>
#include <array>

namespace tribo {

template <int Dim>
ContactLaws<Dim>::ContactLaws(const Model& model, const System<Dim>& system) : field_count_(system.fields.size()) {
  const std::size_t n = field_count_;
  table_.assign(n * n, nullptr);
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const auto& a : *list)
      for (const auto* others : {&system.bodies, &system.rigids})
        for (const auto& b : *others) {
          if (a.field >= n || b.field >= n || a.field == b.field) continue;
          const ContactLaw* law = model.contact.law(a.material, b.material);
          if (law->interface()) {
            const std::pair materials = std::minmax(a.material, b.material);
            auto& limited = interfaces_[materials];
            if (!limited)
              limited = limited_interface(model, system.lattice, *law->interface(), std::array{a.material, b.material});
            law = limited.get();
          }
          table_[a.field * n + b.field] = law;
          any_has_memory_ = any_has_memory_ || law->has_memory();
          any_uses_area_ = any_uses_area_ || law->uses_area();
        }
}

template class ContactLaws<2>;
template class ContactLaws<3>;

}  // namespace tribo
