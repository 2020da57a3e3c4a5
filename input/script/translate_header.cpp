// SPDX-License-Identifier: MIT
/// Commands for the solver, output, grid, gravity and tasks.

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/format_version.hpp"
#include "input/script/commands.hpp"
#include "input/script/translator.hpp"
#include "input/xml.hpp"
#include "model/shape_functions.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::script {
namespace {

// The code of a name. If the name is unknown, an error lists the valid names.
std::string choice(const Command& c, std::size_t k, const std::vector<std::pair<std::string, std::string>>& all,
                   const std::string& what) {
  const std::string given = c.text(k), word = lower(given);
  std::vector<std::string> names;
  for (const auto& [name, code] : all) {
    if (lower(name) == word || code == given) return code;
    names.push_back(name);
  }
  throw InputError(c.origin(k),
                   "'" + given + "' is not a valid " + what + did_you_mean(given, names) + "; valid: " + join(names));
}

// The last command that gives an attribute counts.
void replace_attribute(Statement& s, const std::string& name, const std::string& text, const Origin& origin) {
  std::erase_if(s.attributes, [&](const Attribute& a) { return a.name == name; });
  attribute(s, name, text, origin);
}

// The element of a command that sets one number: it has the name of the command, with one exception.
std::string element_of(const std::string& command) {
  const std::string word = lower(command);
  if (word == "maximumtime") return "MaxTime";
  const auto& all = commands();
  const auto same = [&](const CommandInfo& info) { return lower(info.name) == word; };
  return std::string(std::find_if(all.begin(), all.end(), same)->name);
}

// Numbers of cells are often results of divisions.
std::string count(const Command& c, std::size_t k) {
  const double n = c.number(k), nearest = std::round(n);
  if (!(std::abs(n - nearest) < 1e-6 * std::max(1.0, std::abs(n))) || !(std::abs(n) < 1e15))
    throw InputError(c.origin(k), "a number of cells must be whole, not " + written(n) +
                                      "; choose a cell size that divides the length, or round with int()");
  return written(nearest);
}

}  // namespace

void Translator::version(const Command& c) {
  // As it is written: 3.10 is not the number 3.1
  std::string text = c.given(0) ? c.node.arguments[0].text : "";
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  if (const std::string problem = problem_of_format_version(text); !problem.empty())
    throw InputError(c.origin(0), "the version " + problem);
  document_.set_version(text, c.origin(0));
}

void Translator::title(const Command& c) { document_.describe("Title: " + c.text(0)); }
void Translator::user(const Command& c) { document_.describe("User Name: " + c.text(0)); }

void Translator::comment(const Command& c) {
  std::string text;
  for (std::size_t k = 0; k < c.size(); ++k) text += (k ? "," : "") + c.text(k);
  document_.describe("Comment: " + text);
}

void Translator::header(const Command& c) {
  for (const Piece& line : c.node.lines) document_.describe(line.text);
}

void Translator::analysis(const Command& c) {
  if (const Statement* before = document_.find("Header", "Analysis"))
    throw InputError(c.origin(), "'Analysis' is given twice; first at " + before->origin.text());
  analysis_ = 10;  // if the name is unknown, one error message is sufficient
  const std::string code = choice(
      c, 0, {{"Plane Strain MPM", "10"}, {"Plane Stress MPM", "11"}, {"3D MPM", "12"}, {"Axisymmetric MPM", "13"}},
      "analysis");
  analysis_ = static_cast<int>(*to_number(code));
  document_.set("Header", "Analysis", c.origin(0), code);
  if (c.given(1)) must_be_cells(c, 1);
}

void Translator::element_type(const Command& c) { must_be_cells(c, 0); }

// The element type of an analysis: the cells of the grid.
void Translator::must_be_cells(const Command& c, std::size_t k) const {
  const char* cells = dimension(c) == 3 ? "8 node brick" : "4 node quadrilateral";
  if (lower(c.text(k)) != cells)
    throw InputError(c.origin(k),
                     "the cells of this analysis are \"" + std::string(cells) + "\", not '" + c.text(k) + "'");
}

void Translator::units(const Command& c) {
  consistent_ = true;
  Statement& s = document_.set("Header", "ConsistentUnits", c.origin());
  constexpr std::array names{"length", "mass", "time"};
  for (std::size_t k = 0; k < c.size(); ++k) attribute(s, names[k], c.text(k), c.origin(k));
  const Units given{.length = c.text(0), .mass = c.text(1), .time = c.text(2)};
  length_in_m_ = given.size_in_si(Dimension::length).value_or(0.0);
  time_in_s_ = given.size_in_si(Dimension::time).value_or(0.0);
}

void Translator::method(const Command& c) {
  std::string update = c.text(0);
  const bool minus = !update.empty() && update.back() == '-', plus = !update.empty() && update.back() == '+';
  if (minus || plus) update.pop_back();
  static const std::map<std::string, std::string> codes{{"usf", "0"}, {"usavg", "2"}, {"usl", "3"}, {"szs", "3"},
                                                        {"0", "0"},   {"2", "2"},     {"3", "3"}};
  const auto code = codes.find(lower(update));
  if (code == codes.end())
    throw InputError(c.origin(0),
                     "'" + c.text(0) + "' is not an update method; valid: USF, USAVG, USL, the last two with + or -");
  document_.set("MPMHeader", "MPMMethod", c.origin(0), code->second);
  if (minus) document_.set("MPMHeader", "SkipPostExtrapolation", c.origin(0));
  const std::string shape = c.given(1) ? c.text(1) : "uGIMP";
  Statement& s = document_.set("MPMHeader", "GIMP", c.origin(1));
  const auto kernel = kernel_of(shape);
  attribute(s, "type", kernel ? words_of(*kernel).front() : shape, c.origin(1));
}

void Translator::transfer(const Command& c) {
  Statement& s = document_.set("MPMHeader", "Transfer", c.origin());
  const std::string type = c.text(0);
  attribute(s, "type", type, c.origin(0));
  if (!c.given(1)) return;
  const std::string word = lower(type);
  if (word == "flip" || word == "pic" || word == "apic")
    throw InputError(c.origin(1), "'" + type + "' takes no second argument" +
                                      (word == "apic" ? ""
                                                      : "; for a part of FLIP and the rest of PIC write 'Transfer "
                                                        "blend,0.99', with the fraction of FLIP"));
  attribute(s, word == "blend" ? "fraction" : "order", c.text(1), c.origin(1));
}

void Translator::time_step(const Command& c) {
  document_.set("MPMHeader", "TimeStep", c.origin(0), c.text(0));
  if (c.given(1)) document_.set("MPMHeader", "MaxTime", c.origin(1), c.text(1));
  if (c.given(2)) document_.set("MPMHeader", "TimeFactor", c.origin(2), c.text(2));
}

void Translator::courant(const Command& c) {
  document_.set("MPMHeader", "TimeFactor", c.origin(0), c.text(0));
  if (c.given(1)) document_.set("MPMHeader", "TransTimeFactor", c.origin(1), c.text(1));
}

// The first interval, or a further one that applies later.
void Translator::archive_time(const Command& c) {
  if (!document_.find("MPMHeader", "ArchiveTime")) {
    Statement& s = document_.set("MPMHeader", "ArchiveTime", c.origin(0), c.text(0));
    if (c.given(2)) attribute(s, "maxProps", c.text(2), c.origin(2));
    if (c.given(1)) document_.set("MPMHeader", "FirstArchiveTime", c.origin(1), c.text(1));
    return;
  }
  if (!c.given(1))
    throw InputError(c.origin(), "a further '" + c.node.word + "' needs the time from which on its interval applies");
  Statement& s = document_.add("MPMHeader", "ArchiveGroup", c.origin());
  attribute(s, "time", c.text(0), c.origin(0)), attribute(s, "start", c.text(1), c.origin(1));
  if (c.given(2)) attribute(s, "maxProps", c.text(2), c.origin(2));
}

void Translator::archive(const Command& c) {
  Statement& s = document_.set("MPMHeader", "ArchiveRoot", c.origin(0), c.text(0));
  if (lower(c.node.word) == "archiveunique") attribute(s, "unique", "1", c.origin());
  if (c.size() < 2) return;
  Node times = c.node;
  times.arguments.erase(times.arguments.begin());
  archive_time({times, c.variables});
}

void Translator::global_archive(const Command& c) {
  Statement& s = document_.add("MPMHeader", "GlobalArchive", c.origin());
  attribute(s, "type", c.text(0), c.origin(0));
  const ElementSpec& element = *find_element("GlobalArchive", "MPMHeader");
  const auto is_attribute = [&](const AttributeSpec& a) { return lower(a.name) == lower(c.text(0)); };
  if (std::any_of(element.attributes.begin(), element.attributes.end(), is_attribute))
    throw InputError(c.origin(0),
                     "the first argument of 'GlobalArchive' is a quantity ('tribo list'), not the attribute '" +
                         c.text(0) + "'; for example: GlobalArchive contacty,material,\"a\",with,\"b\"");
  if (c.size() > 2 && !to_number(c.text(1))) return pairs(s, element, c, 1);
  if (c.size() > 2) {
    std::string point;
    for (std::size_t k = 1; k < c.size(); ++k) point += (k > 1 ? "," : "") + written(c.number(k));
    attribute(s, "pt", point, c.origin(1));
    return;
  }
  if (!c.given(1)) return;
  const std::string of = c.text(1);
  if (const auto number = to_number(of); number && *number <= 0)
    attribute(s, "material", of, c.origin(1));
  else
    Document::refer(s, "material", of, c.origin(1));
}

void Translator::to_archive(const Command& c) {
  for (std::size_t k = 0; k < c.size(); ++k)
    attribute(document_.add("MPMHeader", "MPMArchive", c.origin(k)), "result", c.text(k), c.origin(k));
}

void Translator::points_per_element(const Command& c) {
  const double n = c.number(0);
  document_.set("MPMHeader", "MatlPtsPerElement", c.origin(0), written(std::pow(n, dimension(c))));
}

void Translator::plain(const Command& c) {
  document_.set("MPMHeader", element_of(c.node.word), c.origin(0), c.text(0));
}

// A number or a function.
void Translator::rate(const Command& c) {
  if (c.given(1) && c.number(1) != 0)
    throw InputError(c.origin(1), "a fraction of PIC is no longer part of '" + c.node.word +
                                      "'; for a blend of FLIP and " + "PIC write 'Transfer blend," +
                                      written(1 - c.number(1)) + "'");
  Statement& s = document_.set("MPMHeader", element_of(c.node.word), c.origin(0));
  const std::string text = c.text(0);
  if (to_number(text))
    s.text = text;
  else
    attribute(s, "function", text, c.origin(0));
}

void Translator::feedback(const Command& c) {
  Statement& s = document_.set("MPMHeader", element_of(c.node.word), c.origin(0), c.text(0));
  if (c.given(1)) attribute(s, "target", c.text(1), c.origin(1));
  if (c.given(2)) attribute(s, "max", c.text(2), c.origin(2));
}

void Translator::extrapolate_rigid(const Command& c) { document_.set("MPMHeader", "ExtrapolateRigid", c.origin()); }

// Not a property of the model; use --threads.
void Translator::processors(const Command& c) { c.number(0); }

Statement& Translator::multimaterial_mode(const Command& c) {
  auto& header = document_.section("MPMHeader", c.origin());
  for (auto& s : header.children)
    if (s.name == "MultiMaterialMode") return s;
  return document_.add("MPMHeader", "MultiMaterialMode", c.origin());
}

void Translator::multimaterial(const Command& c) {
  Statement& s = multimaterial_mode(c);
  s.origin = c.origin();
  static const std::vector<std::pair<std::string, std::string>> norms{
      {"maxgrad", "0"}, {"maxvol", "1"}, {"avggrad", "2"}, {"owngrad", "3"},
      {"specify", "4"}, {"linreg", "5"}, {"logreg", "6"}};
  if (!c.given(0)) return;
  const std::string norm = choice(c, 0, norms, "way to find normals");
  attribute(s, "Normals", norm, c.origin(0));
  if (c.given(1)) attribute(s, norm == "4" ? "Azimuth" : "RigidBias", c.text(1), c.origin(1));
  if (c.given(2)) attribute(s, "Polar", c.text(2), c.origin(2));
}

// Arguments: vmin and enabled (obsolete), normals and their parameters.
void Translator::old_multimaterial(const Command& c) {
  Node node = c.node;
  node.arguments.erase(node.arguments.begin(),
                       node.arguments.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, c.size())));
  multimaterial({node, c.variables});
}

void Translator::contact_law(const Command& c) {
  Statement s;
  s.name = "Friction", s.origin = c.origin();
  Document::refer(s, "law", c.text(0), c.origin(0));
  multimaterial_mode(c).children.push_back(std::move(s));
}

// The law of the older commands: a friction coefficient, a word, or the stiffnesses of an interface.
Statement Translator::number_law(const Command& c) {
  Statement s;
  s.name = "Friction", s.origin = c.origin(), s.text_origin = c.origin(0);
  const std::string word = lower(c.node.word);
  if (word.find("interface") == std::string::npos) {
    static const std::map<std::string, std::string> words{
        {"stick", "-5"}, {"ignore", "-11"}, {"single", "-11"}, {"none", "0"}};
    const auto found = words.find(lower(c.text(0)));
    s.text = found == words.end() ? c.text(0) : found->second;
    return s;
  }
  s.text = "11";
  attribute(s, "Dt", c.text(0), c.origin(0)), attribute(s, "Dnt", c.text(1), c.origin(1));
  if (c.given(2)) attribute(s, "Dnc", c.text(2), c.origin(2));
  return s;
}

void Translator::old_friction(const Command& c) {
  const std::string word = lower(c.node.word);
  if (word.ends_with("mm")) {
    multimaterial_mode(c).children.push_back(number_law(c));
    return;
  }
  const std::size_t material = word == "friction" ? 1 : 3;
  if (c.given(material))
    throw InputError(c.origin(material), "the law of a pair of materials belongs into 'Material ... Done'");
  crack_setting(c, "Friction") = number_law(c);
}

void Translator::contact_position(const Command& c) {
  Statement s;
  s.name = "ContactPosition", s.origin = c.origin(), s.text = c.text(0), s.text_origin = c.origin(0);
  if (lower(c.node.word) == "contactpositioncracks")
    crack_setting(c, "ContactPosition") = std::move(s);
  else
    multimaterial_mode(c).children.push_back(std::move(s));
}

Statement& Translator::grid_axis(const Command& c, std::size_t axis) {
  constexpr std::array elements{"Horiz", "Vert", "Depth"};
  auto& mesh = document_.section("Mesh", c.origin());
  if (mesh.children.empty()) document_.add("Mesh", "Grid", c.origin());
  auto& children = mesh.children.front().children;
  for (Statement& s : children)
    if (s.name == elements[axis]) return s;
  Statement& s = children.emplace_back();
  s.name = elements[axis], s.origin = c.origin();
  return s;
}

void Translator::grid_cells(const Command& c) {
  const std::string word = lower(c.node.word);
  const std::size_t axis = word == "gridhoriz" ? 0 : word == "gridvert" ? 1 : 2;
  constexpr std::array counts{"nx", "ny", "nz"};
  Statement& s = grid_axis(c, axis);
  s.origin = c.origin();
  replace_attribute(s, counts[axis], count(c, 0), c.origin(0));
  if (c.given(1)) {
    const bool low = !c.given(2) || c.number(2) < 0;
    replace_attribute(s, low ? "symmin" : "symmax", c.text(1), c.origin(1));
    if (c.given(3)) replace_attribute(s, low ? "symmax" : "symmin", c.text(3), c.origin(3));
  }
}

void Translator::grid_edge(const Command& c) {
  static const std::vector<std::string> edges{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", "x", "y", "z"};
  const std::string edge = lower(c.text(0));
  if (std::find(edges.begin(), edges.end(), edge) == edges.end())
    throw InputError(c.origin(0),
                     "the edge cannot be '" + c.text(0) + "'" + did_you_mean(edge, edges) + "; valid: " + join(edges));
  static const std::vector<std::pair<std::string, std::string>> kinds{
      {"periodic", "periodic"}, {"wall", "wall"}, {"symmetry", "sym"}};
  const std::string kind = choice(c, 1, kinds, "kind");
  Statement& s = grid_axis(c, static_cast<std::size_t>(edge.front() - 'x'));
  if (kind == "periodic") {
    if (edge.size() > 1)
      throw InputError(c.origin(0),
                       "both edges of an axis are periodic; write " + edge.substr(0, 1) + " in place of " + edge);
    if (c.given(2)) throw InputError(c.origin(2), "a periodic axis has no coordinate");
    replace_attribute(s, "periodic", "1", c.origin(1));
    return;
  }
  if (edge.size() == 1)
    throw InputError(c.origin(0), "a wall or a plane of symmetry is at one edge; write " + edge + "min or " + edge +
                                      "max in place of " + edge);
  if (!c.given(2)) throw InputError(c.origin(1), "the coordinate of the " + lower(c.text(1)) + " is missing");
  replace_attribute(s, kind + edge.substr(1), c.text(2), c.origin(2));
}

void Translator::grid_box(const Command& c) {
  auto& mesh = document_.section("Mesh", c.origin());
  if (mesh.children.empty()) document_.add("Mesh", "Grid", c.origin());
  Statement& grid = mesh.children.front();
  grid.origin = c.origin();
  constexpr std::array names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  for (std::size_t k = 0; k < c.size(); ++k) attribute(grid, names[k], c.text(k), c.origin(k));
}

void Translator::grid_thickness(const Command& c) {
  auto& mesh = document_.section("Mesh", c.origin());
  if (mesh.children.empty()) document_.add("Mesh", "Grid", c.origin());
  attribute(mesh.children.front(), "thickness", c.text(0), c.origin(0));
}

void Translator::gravity(const Command& c) {
  constexpr std::array names{"BodyXForce", "BodyYForce", "BodyZForce"};
  const auto set = [&](const std::string& name, const Origin& origin, const std::string& text) {
    const Statement* before = document_.find("Gravity", name);
    if (before && before->text != text && to_number(before->text) != 0.0)
      document_.problems().warn(origin, "this replaces the gravity of " + before->origin.text() + ", " + before->text +
                                            ": a model has one gravity along each axis");
    document_.set("Gravity", name, origin, text);
  };
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!c.given(k)) continue;
    const std::string text = c.text(k);
    set(to_number(text) ? names[k] : std::string("Grid") + names[k], c.origin(k), text);
  }
  if (c.given(1)) return;
  if (!(length_in_m_ > 0 && time_in_s_ > 0))
    throw InputError(c.origin(), "'Gravity' without a number for y needs units with a size; give its components");
  const std::string standard = written(-9.80665 * time_in_s_ * time_in_s_ / length_in_m_);
  if (c.size() > 0)
    document_.problems().warn(c.origin(), "'Gravity' without a second number sets the standard gravity along y, " +
                                              standard + "; write 'Gravity " + c.text(0) + ",0' for none");
  set("BodyYForce", c.origin(), standard);
}

void Translator::conduction(const Command& c) {
  static const std::vector<std::pair<std::string, std::string>> yes_no{{"yes", "1"}, {"no", "0"}},
      options{{"adiabatic", "EnergyCoupling"},
              {"mechanical energy", "EnergyCoupling"},
              {"isothermal", ""},
              {"friction", "ContactHeating"},
              {"crack tips", "CrackTipHeating"},
              {"crack friction", "CrackContactHeating"}};
  if (choice(c, 0, yes_no, "choice") == "1") document_.set("Thermal", "Conduction", c.origin(0));
  for (std::size_t k = 1; k < c.size(); ++k) {
    const std::string element = c.given(k) ? choice(c, k, options, "option") : "";
    if (!element.empty()) document_.set("Thermal", element, c.origin(k));
  }
}

void Translator::task(const Command& c) {
  task_ = &document_.add("CustomTasks", "Schedule", c.origin());
  attribute(*task_, "name", c.text(0), c.origin(0));
}

void Translator::parameter(const Command& c) {
  if (!task_) throw InputError(c.origin(), "'Parameter' belongs to a 'CustomTask' before it");
  Statement s;
  s.name = "Parameter", s.origin = c.origin(), s.text = c.text(1), s.text_origin = c.origin(1);
  attribute(s, "name", c.text(0), c.origin(0));
  // numbers of materials are known at the end; a number that is not positive is the id of a condition
  static const std::set<std::string> materials{"material", "matname", "mat", "selectmaterial", "volumegradient"};
  const bool of_files = lower(task_->attribute("name")->text) == "vtkarchive" && lower(c.text(0)) == "material";
  if (materials.count(lower(c.text(0))) && c.given(1) && !of_files && to_number(s.text).value_or(1) > 0)
    Document::refer_text(s, s.text, s.text_origin);
  task_->children.push_back(std::move(s));
}

void Translator::entity(const Command& c) { entities_[c.text(0)] = c.text(1); }

// Adds lines of XML to the open body or condition, or to a section; line numbers are those of the script.
void Translator::xml_data(const Command& c) {
  const bool in_block = !c.given(0) && open_ != Open::nothing && open_ != Open::material;
  const std::string where = c.given(0) ? c.text(0) : "End";
  static const std::map<std::string, std::string> sections{{"header", "Header"},
                                                           {"mpmheader", "MPMHeader"},
                                                           {"mesh", "Mesh"},
                                                           {"materialpoints", "MaterialPoints"},
                                                           {"blocks", "Blocks"},
                                                           {"cracklist", "CrackList"},
                                                           {"material", "Material"},
                                                           {"gridbcs", "GridBCs"},
                                                           {"particlebcs", "ParticleBCs"},
                                                           {"thermal", "Thermal"},
                                                           {"gravity", "Gravity"},
                                                           {"customtasks", "CustomTasks"},
                                                           {"end", "End"}};
  const auto found = sections.find(lower(where));
  if (found == sections.end()) {
    std::vector<std::string> names;
    for (const auto& [word, name] : sections) names.push_back(name);
    throw InputError(c.origin(0),
                     "there is no section '" + where + "'" + did_you_mean(where, names) + "; valid: " + join(names));
  }
  std::string text = "<!DOCTYPE x [";
  for (const auto& [name, value] : entities_) text += "<!ENTITY " + name + " \"" + value + "\">";
  text += "]>" + std::string(static_cast<std::size_t>(std::max(0, c.origin().line - 1)), '\n') + "<x>\n";
  for (const Piece& line : c.node.lines) text += line.text + "\n";
  xml_lines_.push_back({c.origin().line + 1, c.origin().line + static_cast<int>(c.node.lines.size())});
  const Statement read = read_xml(text + "</x>", c.origin().file);
  task_ = nullptr;  // its address may change
  for (const Statement& child : read.children) {
    if (in_block) {
      if (block_.name.empty())
        throw InputError(c.origin(), "'XMLData' inside '" + opened_by_ + "' needs a shape before it");
      block_.children.push_back(child);
      if (open_ == Open::blocks) path_ = {block_.children.size() - 1};
    } else if (found->second == "Material") {
      document_.materials().push_back(child);
      if (c.given(1)) document_.name_material(c.text(1), c.origin(1));
    } else if (found->second == "End" && child.name == "Stage") {
      document_.add_stage(child);
    } else if (found->second == "End") {
      Statement& section = document_.section(child.name, child.origin);
      section.attributes.insert(section.attributes.end(), child.attributes.begin(), child.attributes.end());
      section.children.insert(section.children.end(), child.children.begin(), child.children.end());
    } else {
      add_to_section(document_.section(found->second, child.origin), child);
    }
  }
}

// <MultiMaterialMode> adds to the one of MultimaterialMPM or ContactMM.
void Translator::add_to_section(Statement& section, const Statement& child) {
  Statement* former = nullptr;
  if (child.name == "MultiMaterialMode")
    for (Statement& s : section.children)
      if (s.name == child.name) former = &s;
  if (!former) {
    section.children.push_back(child);
    return;
  }
  for (const Attribute& a : child.attributes) {
    if (former->attribute(a.name)) throw InputError(a.origin, "'" + a.name + "' is given twice");
    former->attributes.push_back(a);
  }
  former->children.insert(former->children.end(), child.children.begin(), child.children.end());
}

}  // namespace tribo::script
