// SPDX-License-Identifier: MIT
#include "input/dialect.hpp"

#include "input/dialect/rows.hpp"

namespace tribo {

const std::vector<ElementSpec>& dialect() {
  static const std::vector<ElementSpec> all = [] {
    keywords::Rows rows;
    for (const auto add :
         {keywords::add_header, keywords::add_output, keywords::add_settings, keywords::add_grid, keywords::add_bodies,
          keywords::add_shapes, keywords::add_laws, keywords::add_contact, keywords::add_cracks,
          keywords::add_shared_fields, keywords::add_blocks, keywords::add_conditions, keywords::add_heat_and_gravity,
          keywords::add_tasks, keywords::add_stages})
      add(rows);
    return rows.take();
  }();
  return all;
}

}  // namespace tribo
