// SPDX-License-Identifier: MIT
#include "input/builder.hpp"

#include "input/dialect.hpp"
#include "input/read.hpp"
#include "input/script/script.hpp"
#include "input/script/write_xml.hpp"
#include "input/xml.hpp"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace tribo {

Model Builder::build() {
  header();
  number_materials();
  if (of_blocks()) {
    only_of_blocks();
    time_control(*root_.child("MPMHeader"));
    archive(*root_.child("MPMHeader"));
    materials();
    gravity();
    blocks();
    problems_.raise();
    for (const auto& w : problems_.warnings()) warn(w.origin, w.message);
    return std::move(model_);
  }
  mesh();
  mpm_header();
  materials();
  check_cells();
  contact();
  cracks();
  fracture();
  bodies();
  conditions();
  heat();
  gravity();
  if (root_.child("Blocks")) blocks();
  tasks();
  check_histories();
  problems_.raise();
  for (const auto& w : problems_.warnings()) warn(w.origin, w.message);
  return std::move(model_);
}

double Builder::number(const Statement& s, std::string_view attribute, Dimension dimension, double fallback) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return fallback;
  return to_number(a->text).value_or(fallback) * model_.units.factor(dimension) * unit_factor(s, dimension);
}

double Builder::text_number(const Statement& s, Dimension dimension, double fallback) {
  return to_number(s.text).value_or(fallback) * model_.units.factor(dimension) * unit_factor(s, dimension);
}

std::optional<std::string> Builder::content_of(const std::filesystem::path& file, const Origin& origin) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (in) return text.str();
  problems_.add(origin, "cannot read the file '" + file.string() + "'");
  return std::nullopt;
}

double Builder::coordinate(const Statement& s, std::string_view attribute, int axis, double fallback) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return fallback;
  const auto k = static_cast<std::size_t>(axis);
  const double h = (model_.grid.high[k] - model_.grid.low[k]) / model_.grid.cells[k];
  if (a->text.rfind("min", 0) == 0 || a->text.rfind("max", 0) == 0) {
    must(!of_blocks(), a->origin,
         "'" + a->text + "' refers to the edge of a grid, which a model of blocks does not have");
    const std::string rest = a->text.substr(3);
    const double cells = rest.empty() ? 0.0 : rest == "+" ? 1.0 : rest == "-" ? -1.0 : to_number(rest).value_or(0.0);
    return (a->text[1] == 'i' ? model_.grid.low[k] : model_.grid.high[k]) + cells * h;
  }
  return to_number(a->text).value_or(fallback) * unit_factor(s, Dimension::length);
}

std::string Builder::word(const Statement& s, std::string_view attribute, const std::string& fallback) const {
  const Attribute* a = s.attribute(attribute);
  return a ? a->text : fallback;
}

// A file that the command file names.
std::filesystem::path Builder::data_file(const std::string& name) {
  model_.data_files.push_back(name);
  return folder_ / name;
}

Expression Builder::function(const std::string& text, const Origin& origin, const std::string& keyword) {
  Expression f = particle_function(text, origin, keyword);
  must(!f.uses_start(), origin,
       "x0, y0 and z0 (the initial position of a particle) are defined in <ParticleBodyXForce> only");
  return f;
}

Expression Builder::particle_function(const std::string& text, const Origin& origin, const std::string& keyword) {
  try {
    return Expression(text, origin, keyword);
  } catch (const InputError& error) {
    problems_.add(error);
    return Expression(0.0);
  }
}

std::optional<Expression> Builder::function(const Statement& s, std::string_view attribute) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return std::nullopt;
  return function(a->text, a->origin, "'" + a->name + "' of <" + s.name + ">");
}

double Builder::unit_factor(const Statement& s, Dimension dimension) {
  const Attribute* a = s.attribute("units");
  if (!a) return 1.0;
  if (!model_.units.legacy) {
    problems_.add(a->origin,
                  "'units' has a meaning in legacy files only; this file has <ConsistentUnits>, so write the number in "
                  "its units");
    return 1.0;
  }
  struct Unit {
    std::string_view name;
    Dimension dimension;
    double factor;
  };
  using D = Dimension;
  static constexpr Unit all[] = {{"s", D::time, 1},
                                 {"sec", D::time, 1},
                                 {"ms", D::time, 1e-3},
                                 {"msec", D::time, 1e-3},
                                 {"us", D::time, 1e-6},
                                 {"microsec", D::time, 1e-6},
                                 {"m", D::length, 1000},
                                 {"cm", D::length, 10},
                                 {"mm", D::length, 1},
                                 {"microns", D::length, 1e-3},
                                 {"in", D::length, 25.4},
                                 {"ft", D::length, 304.8},
                                 {"m/sec", D::velocity, 1e3},
                                 {"mm/msec", D::velocity, 1e3},
                                 {"mm/sec", D::velocity, 1},
                                 {"cm/sec", D::velocity, 10},
                                 {"in/sec", D::velocity, 25.4},
                                 {"ft/sec", D::velocity, 304.8},
                                 {"kg", D::mass, 1000},
                                 {"g", D::mass, 1},
                                 {"mg", D::mass, 1e-3},
                                 {"lbs", D::mass, 453.59237},
                                 {"oz", D::mass, 28.349523125}};
  std::vector<std::string> fitting;
  for (const auto& unit : all)
    if (unit.dimension == dimension) {
      if (unit.name == a->text) return unit.factor;
      fitting.emplace_back(unit.name);
    }
  for (const auto& unit : all)  // the unit belongs to another value of the same element, where it is checked
    if (unit.name == a->text && !fitting.empty() && s.attributes.size() > 2) return 1.0;
  if (!fitting.empty())
    problems_.add(a->origin, "'" + a->text + "' is not a unit of " + std::string(dimension_name(dimension)) +
                                 "; valid: " + join(fitting));
  return 1.0;
}

double Builder::tolerance(const Statement& s) {
  const double h = (model_.grid.high[0] - model_.grid.low[0]) / model_.grid.cells[0];
  const Attribute* a = s.attribute("tolerance");
  if (!a) return 0.1 * h;
  const bool cells = !a->text.empty() && a->text[0] == '*';
  const auto value = to_number(cells ? std::string_view(a->text).substr(1) : std::string_view(a->text));
  if (!value || *value < 0) {
    problems_.add(a->origin, "a tolerance must be a distance, or *f for f cells, not '" + a->text + "'");
    return h;
  }
  return *value * (cells ? h : 1.0);
}

void Builder::warn(const Origin& origin, const std::string& message) {
  model_.warnings.push_back(origin.text() + ": warning: " + message);
}

void Builder::must(bool condition, const Origin& origin, const std::string& message) {
  if (!condition) problems_.add(origin, message);
}

RegionPtr Builder::placed(const Statement& s, const std::function<RegionPtr()>& make) {
  try {
    return make();
  } catch (const InputError& error) {
    problems_.add(error);
  } catch (const std::runtime_error& error) {
    problems_.add(s.origin, "<" + s.name + ">: " + error.what());
  }
  return rectangle(0, 0, 0, 0);
}

Model build_model(const Statement& root, const std::filesystem::path& folder) {
  Problems problems;
  check_statements(root, problems);
  problems.raise();
  return Builder(root, folder).build();
}

namespace {

std::string warning_text(const Origin& origin, const std::string& message) {
  return origin.text() + ": warning: " + message;
}

// The statements of a text. Warnings are added to `warnings`, if it is not null.
Statement statements_of(const std::string& text, const std::shared_ptr<const std::string>& name, Settings settings,
                        std::FILE* output, std::vector<std::string>* warnings = nullptr) {
  std::string written;
  Statement root;
  if (is_script(text)) {
    Script script = read_script(text, name, settings);
    root = std::move(script.root), written = std::move(script.output);
    if (warnings)
      for (const auto& w : script.warnings) warnings->push_back(warning_text(w.origin, w.message));
  } else {
    root = read_xml(text, name, settings);
    written = run_commands(root, settings);
  }
  Problems problems;
  for (const auto& [variable, value] : settings.values())
    if (!settings.used(variable))
      problems.add({name, 1, 1}, "the file has no variable or entity '" + variable + "' to set" +
                                     did_you_mean(variable, {settings.seen().begin(), settings.seen().end()}));
  problems.raise();
  std::fputs(written.c_str(), output);
  return root;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream buffer;
  if (!in || !(buffer << in.rdbuf())) throw FileError("cannot read '" + file.string() + "'");
  return std::move(buffer).str();
}

// Positions in the command file are left out: they change without any effect on the model.
std::string meaning_of(Statement root) {
  const auto forget = [](auto& self, Statement& s) -> void {
    s.origin = {};
    for (Statement& child : s.children) self(self, child);
  };
  forget(forget, root);
  return xml_text(root);
}

Model model_of(const std::string& text, const std::string& file, const std::filesystem::path& folder,
               const Settings& settings) {
  std::vector<std::string> warnings;
  const Statement root = statements_of(text, std::make_shared<const std::string>(file), settings, stdout, &warnings);
  Model model = build_model(root, folder);
  model.warnings.insert(model.warnings.begin(), warnings.begin(), warnings.end());
  model.file = file, model.settings = settings.values(), model.source = text, model.meaning = meaning_of(root);
  return model;
}

}  // namespace

Statement read_statements(const std::filesystem::path& file, Settings settings, std::FILE* output) {
  return statements_of(text_of(file), std::make_shared<const std::string>(file.string()), std::move(settings), output);
}

Model read_model(const std::filesystem::path& file, const Settings& settings) {
  return model_of(text_of(file), file.string(), file.parent_path(), settings);
}

Model read_model_text(std::string_view text, const std::string& name) {
  return model_of(std::string(text), name, {}, {});
}

}  // namespace tribo
