// SPDX-License-Identifier: MIT
#include "input/builder.hpp"

#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "input/dialect.hpp"
#include "input/read.hpp"
#include "input/script/script.hpp"
#include "input/script/write_xml.hpp"
#include "input/xml.hpp"

#include <cmath>
#include <cstdio>
#include <set>

namespace tribo {

Model Builder::build() {
  header();
  number_materials();
  if (of_blocks()) {
    only_of_blocks();
    time_control(*root_.child("MPMHeader"));
    archive(*root_.child("MPMHeader"));
    materials();
    report_unknown_fields();
    gravity();
    with_memory_for("the blocks", place_of("Blocks"), [&] { blocks(); });
    stages();
    problems_.raise();
    for (const auto& w : problems_.warnings()) warn(w.origin, w.message);
    return std::move(model_);
  }
  mesh();
  mpm_header();
  materials();
  report_unknown_fields();
  check_cells();
  check_wave_steps();
  contact();
  with_memory_for("the cracks", place_of("CrackList"), [&] { cracks(); });
  fracture();
  with_memory_for("the bodies", place_of("MaterialPoints"), [&] { bodies(); });
  conditions();
  tasks();
  heat();
  gravity();
  if (root_.child("Blocks")) with_memory_for("the blocks", place_of("Blocks"), [&] { blocks(); });
  check_histories();
  stages();
  separate_bodies();
  problems_.raise();
  for (const auto& w : problems_.warnings()) warn(w.origin, w.message);
  return std::move(model_);
}

Origin Builder::place_of(std::string_view element) const {
  const Statement* found = root_.child(element);
  return found ? found->origin : root_.origin;
}

double Builder::number(const Statement& s, std::string_view attribute, Dimension dimension, double fallback) {
  const Attribute* a = s.attribute(attribute);
  if (!a) return fallback;
  return converted(s, a->text, a->origin, dimension, fallback);
}

double Builder::text_number(const Statement& s, Dimension dimension, double fallback) {
  return converted(s, s.text, s.text.empty() ? s.origin : s.text_origin, dimension, fallback);
}

double Builder::converted(const Statement& s, const std::string& text, const Origin& origin, Dimension dimension,
                          double fallback) {
  const double value = to_number(text).value_or(fallback);
  const double out = value * model_.units.factor(dimension) * unit_factor(s, dimension);
  // With room for squares and products
  const bool sound = out == 0 ? value == 0 : std::abs(out) < 1e100 && std::abs(out) > 1e-100;
  must(sound, origin, "'" + text + "' is too " + (std::abs(out) < 1 ? "small" : "large") + " to be computed with");
  return sound ? out : fallback;
}

std::optional<std::string> Builder::content_of(const std::filesystem::path& file, const Origin& origin) {
  try {
    return with_memory_for("the contents of '" + printable(file.string()) + "'", origin,
                           [&] { return read_file(file); });
  } catch (const FileError& error) {
    problems_.add(origin, error.what());
    return std::nullopt;
  }
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
  return converted(s, a->text, a->origin, Dimension::length, fallback);
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

namespace {

using Place = std::pair<int, int>;  // line and column

Place place_of(const Origin& origin) { return {origin.line, origin.column}; }

// The places of all attributes and texts, and those of elements without text.
void collect_places(const Statement& s, std::set<Place>& values, std::set<Place>& elements) {
  for (const Attribute& a : s.attributes) values.insert(place_of(a.origin));
  if (s.text.empty())
    elements.insert(place_of(s.origin));
  else
    values.insert(place_of(s.text_origin));
  for (const Statement& child : s.children) collect_places(child, values, elements);
}

// Adds the problems that `check` throws to those already found, so that all are told in one round. Those on a line that
// has a problem already may be its consequence. If something is missing in the tree, so may be those of elements, and
// only problems of values are added.
template <class Check>
void add_problems(const Statement& root, bool complete, Problems& problems, const Check& check) {
  std::set<int> lines;
  for (const Problem& p : problems.list()) lines.insert(p.origin.line);
  std::set<Place> values, elements;
  collect_places(root, values, elements);
  const auto of_value = [&](const Place& p) { return values.count(p) > 0 && elements.count(p) == 0; };
  try {
    check();
  } catch (const InputError& error) {
    for (const Problem& p : error.problems())
      if (lines.count(p.origin.line) == 0 && (complete || of_value(place_of(p.origin))))
        problems.add(p.origin, p.message);
  }
}

}  // namespace

Model build_model(const Statement& root, const std::filesystem::path& folder) {
  Problems problems;
  check_statements(root, problems);
  if (problems.empty()) return build_with_stages(root, folder);
  const bool complete = is_complete(root);
  const Statement usable = complete ? root : complete_part(root);
  add_problems(root, complete, problems, [&] {
    Builder builder(usable, folder);
    if (is_complete(usable))
      builder.build();
    else
      builder.check_materials();
  });
  problems.raise();
  return {};
}

namespace {

constexpr std::uintmax_t most_text = std::uintmax_t{1} << 30;  // bytes of a command file

std::string warning_text(const Origin& origin, const std::string& message) {
  return origin.text() + ": warning: " + message;
}

/// What is known about a text besides its statements.
struct About {
  std::vector<std::string> warnings;
  Problems problems;  ///< of the commands of a script, which the statements then lack, and of settings
  bool script = false;
  std::vector<std::array<int, 2>> xml_lines;
};

// The statements of a text, as far as it could be translated.
Statement statements_of(const std::string& text, const std::shared_ptr<const std::string>& name, Settings settings,
                        std::FILE* output, About& about) {
  std::string written;
  Statement root;
  if (is_script(text)) {
    Script script = read_script(text, name, settings);
    root = std::move(script.root), written = std::move(script.output);
    about.script = true, about.xml_lines = std::move(script.xml_lines);
    about.problems = std::move(script.problems);
    for (const auto& w : script.warnings) about.warnings.push_back(warning_text(w.origin, w.message));
  } else {
    root = read_xml(text, name, settings);
    written = run_commands(root, settings, about.problems);
  }
  for (const auto& [variable, value] : settings.values())
    if (!settings.used(variable))
      about.problems.add({name, 1, 1}, "the file has no variable or entity '" + variable + "' to set" +
                                           did_you_mean(variable, {settings.seen().begin(), settings.seen().end()}));
  if (about.problems.empty()) std::fputs(written.c_str(), output);
  return root;
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

// The model with warnings of the reader before its own. Problems of a script are told in its words.
Model model_of(const std::string& text, const std::string& file, const std::filesystem::path& folder,
               const Settings& settings) {
  About about;
  const auto name = std::make_shared<const std::string>(printable(file));
  const Statement root = statements_of(text, name, settings, stdout, about);
  try {
    if (!about.problems.empty()) add_problems(root, false, about.problems, [&] { build_model(root, folder); });
    about.problems.raise();
    Model model = build_model(root, folder);
    model.warnings.insert(model.warnings.begin(), about.warnings.begin(), about.warnings.end());
    model.file = file, model.settings = settings.values(), model.source = text, model.meaning = meaning_of(root);
    return model;
  } catch (const InputError& error) {
    if (!about.script) throw;
    throw InputError(in_words_of_scripts(error.problems(), about.xml_lines));
  }
}

}  // namespace

Statement read_statements(const std::filesystem::path& file, Settings settings, std::FILE* output) {
  About about;
  const auto name = std::make_shared<const std::string>(printable(file.string()));
  return with_memory_for("the contents of this file", Origin{name, 1, 1}, [&] {
    Statement root = statements_of(read_file(file, most_text), name, std::move(settings), output, about);
    about.problems.raise();
    return root;
  });
}

Model read_model(const std::filesystem::path& file, const Settings& settings) {
  const auto name = std::make_shared<const std::string>(printable(file.string()));
  return with_memory_for("the contents of this file", Origin{name, 1, 1}, [&] {
    return model_of(read_file(file, most_text), file.string(), file.parent_path(), settings);
  });
}

Model read_model_text(std::string_view text, const std::string& name, const Settings& settings) {
  return model_of(std::string(text), name, {}, settings);
}

Statement read_statements_text(std::string_view text, const std::string& name, Settings settings, std::FILE* output) {
  About about;
  Statement root = statements_of(std::string(text), std::make_shared<const std::string>(printable(name)),
                                 std::move(settings), output, about);
  about.problems.raise();
  return root;
}

std::string read_as_python(const std::filesystem::path& file, const Settings& settings, std::FILE* output) {
  const std::string name = printable(file.string());
  const std::string text = read_file(file, most_text);
  if (!is_script(text))
    throw InputError({std::make_shared<const std::string>(name), 1, 1},
                     "a Python program is made from a script, and this is XML, which has no commands; in Python "
                     "tribo.run(\"" +
                         file.filename().string() + "\") runs the file as it is");
  read_statements_text(text, name, settings, output);  // reports every problem, also of settings
  return script_as_python(text, name, settings);
}

}  // namespace tribo
