// SPDX-License-Identifier: MIT
/// <Drive>: a single law driven along a path.

#include "contact/contact_law.hpp"
#include "input/builder.hpp"
#include "input/dialect.hpp"
#include "input/read.hpp"
#include "input/xml.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tribo {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Velocity gradient or stress of one column in a standard test: `rate` is a factor of the test's strain rate,
/// `pressure` a factor of its confining pressure.
struct TestColumn {
  std::string_view name;
  double rate = 0.0, pressure = 0.0;
};
struct StandardTest {
  std::string_view name;
  std::vector<TestColumn> columns;
  bool confined = false;
};

const StandardTest& standard_test(const std::string& name) {
  static const std::vector<StandardTest> all{
      {"simple_shear", {{"Lxy", 1}}},
      {"uniaxial_stress", {{"Lxx", 1}, {"syy"}, {"szz"}}},
      {"oedometer", {{"Lxx", -1}}},
      {"triaxial_compression", {{"Lxx", -1}, {"syy", 0, -1}, {"szz", 0, -1}}, true},
      {"triaxial_extension", {{"Lxx", 1}, {"syy", 0, -1}, {"szz", 0, -1}}, true},
      {"isotropic", {{"Lxx", -1.0 / 3}, {"Lyy", -1.0 / 3}, {"Lzz", -1.0 / 3}}}};
  for (const auto& test : all)
    if (test.name == name) return test;
  return all.front();  // not reached: check() has refused other words
}

}  // namespace

// The path of a standard test. `initial` is set to the confining pressure.
std::vector<PathRow> Builder::test_path(const Statement& s, Mat3& initial) {
  const StandardTest& test = standard_test(word(s, "test"));
  const double strain = number(s, "strain", Dimension::none), rate = number(s, "rate", Dimension::rate, 1.0);
  const double steps = number(s, "steps", Dimension::none, 100.0), pressure = number(s, "pressure", Dimension::stress);
  must(std::abs(strain) > 0, s.origin, "a standard test needs 'strain', the strain at its end");
  must(rate > 0, s.origin, "'rate' must be positive; a negative 'strain' reverses the test");
  must(steps >= 1 && steps <= 1e7, s.origin, "'steps' must be a whole number, at least 1 and at most 1e7");
  must(test.confined || !has(s, "pressure"), s.origin, "only triaxial tests have a confining 'pressure'");
  const auto columns = material_columns();
  PathRow row;
  row.origin = s.origin;
  row.steps = static_cast<int>(std::max(1.0, steps));
  row.dt = std::abs(strain) / (rate * row.steps);
  row.value.assign(columns.size(), nothing);
  for (const auto& c : test.columns)
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == c.name) row.value[k] = std::copysign(rate, strain) * c.rate + pressure * c.pressure;
  if (test.confined) initial = -pressure * Mat3::Identity();
  return {row};
}

std::vector<PathRow> Builder::path(const Statement& s, const std::vector<PathColumn>& columns) {
  const Statement* path = s.child("Path");
  if (!path) {
    problems_.add(s.origin, "<Drive> needs <Path>" + std::string(has(s, "material") ? " or the attribute 'test'" : ""));
    return {};
  }
  const Attribute* file = path->attribute("file");
  must(!file || path->text.empty(), path->origin, "<Path> has both a file and rows; give one of them");
  const double time = model_.units.factor(Dimension::time);
  if (!file) return read_path(path->text, path->text_origin, columns, time, problems_);
  const auto place = folder_ / file->text;
  const auto text = content_of(place, file->origin);
  if (!text) return {};
  return read_path(*text, {std::make_shared<const std::string>(place.string()), 1, 1}, columns, time, problems_);
}

void Builder::only_of_joints(const Statement& s) {
  for (const auto name :
       {"area", "thickness", "distance", "block", "spring-normal", "spring-shear", "vn", "vss", "vst"})
    must(!has(s, name), s.origin, "'" + std::string(name) + "' belongs to joint laws");
}

MaterialDrive Builder::material_drive(const Statement& s, const MaterialSpec& spec) {
  MaterialDrive out;
  out.law = spec.law;
  for (const auto name : {"mass", "gap"})
    must(!has(s, name), s.origin, "'" + std::string(name) + "' belongs to contact and joint laws");
  only_of_joints(s);
  must(!spec.law || !spec.law->rigid(), s.attribute("material")->origin,
       "'" + spec.name + "' is rigid and has no stress");
  const auto& units = model_.units;
  if (has(s, "test")) {
    must(!s.child("Path"), s.origin, "<Drive> has a 'test' and a <Path>; give one of them");
    out.path = test_path(s, out.initial_stress);
  } else {
    for (const auto name : {"strain", "rate", "steps", "pressure"})
      must(!has(s, name), s.origin,
           "'" + std::string(name) + "' belongs to a standard test, which is selected by 'test'");
    out.path = path(s, material_columns(units.factor(Dimension::rate), units.factor(Dimension::stress)));
  }
  out.angle = number(s, "angle", Dimension::angle);
  out.cell = number(s, "cell", Dimension::length, 1.0);
  check_cell(spec, out.cell, s.origin);
  out.reference_temperature = model_.heat.reference;
  out.temperature = number(s, "temp", Dimension::temperature, model_.heat.reference);
  if (work_heating()) {
    must(spec.heat_capacity > 0, spec.origin, "<EnergyCoupling> needs the heat capacity of '" + spec.name + "': <Cv>");
    must(!spec.law || spec.law->dissipation_index() >= 0, s.origin,
         "<EnergyCoupling> converts dissipated work to heat, but '" + spec.name + "' dissipates nothing");
    if (spec.law) out.warmed_by_work = spec.taylor_quinney / (spec.law->density() * spec.heat_capacity);
  }
  must(!has(s, "temp") || (spec.law && spec.law->feels_temperature()) || work_heating(), s.origin,
       "'" + spec.name + "' does not depend on temperature; leave 'temp' out");
  if (const Statement* initial = s.child("InitialStress")) {
    constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "xz"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto [r, c] = Layout<3>::symmetric_at[k];
      if (has(*initial, names[k]))
        out.initial_stress(r, c) = out.initial_stress(c, r) = number(*initial, names[k], Dimension::stress);
    }
    out.initial_stress_origin = initial->origin;
  } else if (out.initial_stress.norm() > 0) {
    out.initial_stress_origin = s.origin;
  }
  return out;
}

ContactDrive Builder::contact_drive(const Statement& s, const MaterialSpec& spec) {
  ContactDrive out;
  out.law = spec.contact;
  for (const auto name : {"test", "strain", "rate", "steps", "pressure", "angle", "temp"})
    must(!has(s, name), s.origin, "'" + std::string(name) + "' belongs to materials; contact laws need <Path>");
  must(!s.child("InitialStress"), s.origin, "<InitialStress> belongs to materials");
  only_of_joints(s);
  out.mass = number(s, "mass", Dimension::none, 1.0);
  out.gap = number(s, "gap", Dimension::length);
  out.cell = number(s, "cell", Dimension::length, 1.0);
  must(out.mass > 0 && out.cell > 0, s.origin, "'mass' and 'cell' must be positive");
  const auto& units = model_.units;
  out.path = path(s, contact_columns(units.factor(Dimension::velocity), units.factor(Dimension::stress)));
  if (spec.contact && spec.contact->liquid() != 0) liquid_of(spec);
  return out;
}

JointDrive Builder::joint_drive(const Statement& s, const MaterialSpec& spec) {
  JointDrive out;
  out.law = spec.joint, out.origin = s.origin;
  for (const auto name : {"test", "strain", "rate", "steps", "pressure", "angle", "temp", "cell"})
    must(!has(s, name), s.origin, "'" + std::string(name) + "' does not belong to joint laws, which need <Path>");
  must(!s.child("InitialStress"), s.origin,
       "<InitialStress> belongs to materials; the initial forces of a joint law are among its properties");
  const auto& units = model_.units;
  JointSite& site = out.site;
  site.plane = has(s, "thickness");
  site.thickness = number(s, "thickness", Dimension::length, 1.0);
  site.area = number(s, "area", Dimension::none, 1.0);
  site.gap = number(s, "gap", Dimension::length), site.distance = number(s, "distance", Dimension::length);
  out.mass = number(s, "block", Dimension::mass);
  out.dashpot_mass = number(s, "mass", Dimension::mass, out.mass / units.factor(Dimension::mass));
  const double per_length = units.factor(Dimension::force) / units.factor(Dimension::length);
  out.spring_normal = per_length * number(s, "spring-normal", Dimension::none);
  out.spring_shear = per_length * number(s, "spring-shear", Dimension::none);
  constexpr std::array<const char*, 3> axes{"vn", "vss", "vst"};
  for (std::size_t k = 0; k < 3; ++k) {
    out.velocity[k] = number(s, axes[k], Dimension::velocity);
    must(!has(s, axes[k]) || out.mass > 0, s.origin, "'" + std::string(axes[k]) + "' needs the mass 'block'");
  }
  must(site.area > 0 && site.thickness > 0, s.origin, "'area' and 'thickness' must be positive");
  must(site.distance >= 0 && out.mass >= 0 && out.dashpot_mass >= 0 && out.spring_normal >= 0 && out.spring_shear >= 0,
       s.origin, "'distance', 'mass', 'block' and the springs must not be negative");
  must(!spec.joint || !spec.joint->needs_distance() || site.distance > 0, s.origin,
       "<compute-stiffness> of '" + spec.name + "' needs 'distance', the distance between the centres of the bodies");
  must(!spec.joint || spec.joint->user_areas().size() <= 1, s.origin,
       "<user_area> of '" + spec.name + "' has an area for each point of a crack; a single contact takes one area");
  out.path = path(s, joint_columns(units.factor(Dimension::length), units.factor(Dimension::force),
                                   units.factor(Dimension::stress)));
  return out;
}

Drive Builder::build_drive() {
  if (root_.child("Header")) header();
  if (const auto* h = root_.child("MPMHeader")) reference_temperature(*h);
  number_materials();
  materials();
  const Statement* s = root_.child("Drive");
  if (!s) {
    problems_.add(root_.origin,
                  "this file has no <Drive>, which 'tribo drive' needs: the law to drive and the "
                  "path. To run the model, use 'tribo run'");
    problems_.raise();
    return {};
  }
  struct Kind {
    const char *attribute, *name;
    bool (*fits)(const std::string& type);
  };
  static constexpr Kind kinds[] = {
      {"material", "material", [](const std::string& t) { return tribo::materials().find(t) != nullptr; }},
      {"contact", "contact law", [](const std::string& t) { return tribo::contact_laws().find(t) != nullptr; }},
      {"joint", "joint law", [](const std::string& t) { return tribo::joint_laws().find(t) != nullptr; }}};
  const auto asked =
      std::count_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return has(*s, k.attribute); });
  must(asked == 1, s->origin,
       "<Drive> needs one of the attributes 'material', 'contact' and 'joint', the name of a law");
  Drive out;
  for (const Kind& kind : kinds) {
    const Attribute* a = s->attribute(kind.attribute);
    if (!a || asked != 1) continue;
    std::vector<std::string> names;
    const MaterialSpec* found = nullptr;
    const bool is_wrong = std::any_of(model_.materials.begin(), model_.materials.end(), [&](const MaterialSpec& spec) {
      return spec.name == a->text && spec.type.empty();
    });
    if (is_wrong) continue;  // its type is not known, as has been told
    for (const auto& spec : model_.materials) {
      if (!kind.fits(spec.type)) continue;
      names.push_back(spec.name);
      if (spec.name == a->text) found = &spec;
    }
    if (!found)
      problems_.add(a->origin, "there is no " + std::string(kind.name) + " named '" + a->text + "'" +
                                   did_you_mean(a->text, names) +
                                   (names.empty() ? "; this file has none" : "; valid: " + join(names)));
    else if (&kind == &kinds[0])
      out = material_drive(*s, *found);
    else if (&kind == &kinds[1])
      out = contact_drive(*s, *found);
    else
      out = joint_drive(*s, *found);
  }
  problems_.raise();
  for (const auto& w : problems_.warnings())
    std::fprintf(stderr, "%s: warning: %s\n", w.origin.text().c_str(), w.message.c_str());
  return out;
}

namespace {

Drive drive_of(const Statement& root, const std::filesystem::path& folder) {
  Problems problems;
  check_statements(root, problems, true);
  problems.raise();
  return Builder(root, folder).build_drive();
}

}  // namespace

Drive read_drive(const std::filesystem::path& file, const Settings& settings) {
  return drive_of(read_statements(file, settings), file.parent_path());
}

Drive read_drive_text(std::string_view text, const std::string& name, const Settings& settings) {
  return drive_of(read_statements_text(text, name, settings), {});
}

}  // namespace tribo
