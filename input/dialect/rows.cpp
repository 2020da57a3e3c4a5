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
  return {"units", T::choice, "unit of the value, in legacy files only", known};
}

std::vector<AttributeSpec> box(bool three) {
  std::vector<AttributeSpec> out;
  for (const auto name : {"xmin", "xmax", "ymin", "ymax"}) out.push_back({name, T::coordinate, "edge", {}, true});
  if (three)
    for (const auto name : {"zmin", "zmax"}) out.push_back({name, T::coordinate, "edge", {}, true});
  out.push_back(units(lengths));
  return out;
}

std::vector<AttributeSpec> ends() {
  std::vector<AttributeSpec> out;
  constexpr std::string_view end = "end; the ends or the corners are required",
                             corner = "corner; the corners or the ends are required";
  for (const std::string_view name : {"x1", "y1", "z1", "x2", "y2", "z2"})
    out.push_back({name, T::coordinate, name[0] == 'z' ? "end" : end});
  for (const std::string_view name : {"xmin", "ymin", "zmin", "xmax", "ymax", "zmax"})
    out.push_back({name, T::coordinate, name[0] == 'z' ? "corner" : corner});
  out.push_back({"tolerance", T::text, "distance, or *f for f cells (default *0.1; required without a grid)"});
  return out;
}

std::vector<AttributeSpec> stress_components() {
  return {text("file", "table with columns x, y, z of points and xx, yy, zz, xy, yz, xz of the stress there"),
          function("xx", ""),
          function("yy", ""),
          function("zz", ""),
          function("xy", ""),
          function("yz", ""),
          function("xz", "")};
}

std::vector<AttributeSpec> contact_law() {
  return {text("law", "number or name of the contact law; this, lawname or a number as text is required"),
          text("lawname", "name of the contact law; this, law or a number as text is required"),
          number("Dn", "old form: normal stiffness of an interface"),
          number("Dnt", "normal stiffness in tension"),
          number("Dnc", "normal stiffness in compression"),
          number("Dt", "tangential stiffness")};
}

std::vector<AttributeSpec> operator+(std::vector<AttributeSpec> a, const std::vector<AttributeSpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace tribo::keywords
