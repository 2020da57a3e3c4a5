// SPDX-License-Identifier: MIT
#include "input/dialect/rows.hpp"

namespace tribo::keywords {

AttributeSpec number(std::string_view name, std::string_view meaning, bool required) {
  return {name, T::number, meaning, {}, required};
}

AttributeSpec text(std::string_view name, std::string_view meaning, bool required) {
  return {name, T::text, meaning, {}, required};
}

AttributeSpec function(std::string_view name, std::string_view meaning) { return {name, T::function, meaning}; }

AttributeSpec units(std::string_view known) {
  return {"units", T::choice, "unit of the numbers of this element; only in files without <ConsistentUnits>", known};
}

std::vector<AttributeSpec> box(bool three) {
  std::vector<AttributeSpec> out;
  for (const auto name : {"xmin", "xmax", "ymin", "ymax"})
    out.push_back({name, T::coordinate, "coordinate of this edge", {}, true});
  if (three)
    for (const auto name : {"zmin", "zmax"}) out.push_back({name, T::coordinate, "coordinate of this edge", {}, true});
  out.push_back(units(lengths));
  return out;
}

std::vector<AttributeSpec> ends() {
  std::vector<AttributeSpec> out;
  constexpr std::string_view end =
                                 "coordinate of end 1 or 2 of the line, for an arc of corner 1 or 2 of its box; "
                                 "required unless it is given as xmin to ymax",
                             corner =
                                 "another name of x1 and y1 (min) or x2 and y2 (max); required unless these are given";
  for (const std::string_view name : {"x1", "y1", "z1", "x2", "y2", "z2"})
    out.push_back({name, T::coordinate, name[0] == 'z' ? "the same along z, in three dimensions" : end});
  for (const std::string_view name : {"xmin", "ymin", "zmin", "xmax", "ymax", "zmax"})
    out.push_back({name, T::coordinate, name[0] == 'z' ? "another name of z1 (min) or z2 (max)" : corner});
  out.push_back(
      {"tolerance", T::text,
       "largest distance from the line: a length, or '*f' for f cells (default '*0.1'; required without a grid)"});
  return out;
}

std::vector<AttributeSpec> stress_components() {
  return {
      text("file", "file of a table with the columns x, y, z of points and xx, yy, zz, xy, yz, xz of the stress there"),
      function("xx", "component xx of the stress as a function of x, y, z"),
      function("yy", "component yy of the stress as a function of x, y, z"),
      function("zz", "component zz of the stress as a function of x, y, z"),
      function("xy", "component xy of the stress as a function of x, y, z"),
      function("yz", "component yz of the stress as a function of x, y, z"),
      function("xz", "component xz of the stress as a function of x, y, z")};
}

std::vector<AttributeSpec> contact_law() {
  return {text("law", "number or name of the law; this, lawname or a number as text is required"),
          text("lawname", "name of the law; this, law or a number as text is required"),
          number("Dn", "old form, with a number of at least 10 as text: the same as Dnt"),
          number("Dnt", "old form: normal stiffness of the interface in tension [stress/length]"),
          number("Dnc", "old form: normal stiffness of the interface in compression [stress/length]"),
          number("Dt", "old form: tangential stiffness of the interface [stress/length]")};
}

std::vector<AttributeSpec> operator+(std::vector<AttributeSpec> a, const std::vector<AttributeSpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace tribo::keywords
