// SPDX-License-Identifier: MIT
/// What the rows of the table of keywords are written with. Each file of this folder adds the rows of one subject.
#pragma once

#include "input/dialect.hpp"

#include <utility>

namespace tribo::keywords {

using T = ValueType;

/// Units of legacy files.
constexpr std::string_view times = "ms msec s sec us microsec", lengths = "m cm mm microns in ft",
                           velocities = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec", masses = "kg g mg lbs oz",
                           velocities_and_lengths = "m/sec mm/msec mm/sec cm/sec in/sec ft/sec m cm mm microns in ft";

/// The table of keywords while it is filled; `add({...})` adds a row.
class Rows {
 public:
  void operator()(ElementSpec row) { all_.push_back(std::move(row)); }
  std::vector<ElementSpec> take() { return std::move(all_); }

 private:
  std::vector<ElementSpec> all_;
};

// Attributes
AttributeSpec number(std::string_view name, std::string_view meaning, bool required = false);
AttributeSpec text(std::string_view name, std::string_view meaning, bool required = false);
AttributeSpec function(std::string_view name, std::string_view meaning);
/// The attribute `units` with these units.
AttributeSpec units(std::string_view known);

/// The edges of a rectangle, or of a box in three dimensions.
std::vector<AttributeSpec> box(bool three);
/// The ends of a line and the distance from it.
std::vector<AttributeSpec> ends();
/// Cauchy stress as functions of position and from a table.
std::vector<AttributeSpec> stress_components();
/// The law between two faces, in the new and in the old form.
std::vector<AttributeSpec> contact_law();

std::vector<AttributeSpec> operator+(std::vector<AttributeSpec> a, const std::vector<AttributeSpec>& b);

// The rows by subject, in the order of the manual.
void add_header(Rows& add);
void add_output(Rows& add);
void add_settings(Rows& add);
void add_grid(Rows& add);
void add_bodies(Rows& add);
void add_shapes(Rows& add);
void add_laws(Rows& add);
void add_contact(Rows& add);
void add_cracks(Rows& add);
void add_shared_fields(Rows& add);
void add_blocks(Rows& add);
void add_conditions(Rows& add);
void add_heat_and_gravity(Rows& add);
void add_tasks(Rows& add);
void add_stages(Rows& add);

}  // namespace tribo::keywords
