// SPDX-License-Identifier: MIT
/// Materials, bodies, shapes and conditions.

#include "base/schema.hpp"
#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/common_properties.hpp"
#include "input/dialect.hpp"
#include "input/script/translator.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::script {
namespace {

// Properties of the law of a material; empty if there is no such law.
std::vector<std::string> properties_of(const Statement& material) {
  const Attribute* type = material.attribute("Type");
  std::vector<std::string> names;
  const auto add = [&](const auto* law) {
    if (!law) return;
    for (const ParameterInfo& p : law->parameters) {
      names.push_back(p.name);
      if (!p.alias.empty()) names.push_back(p.alias);
    }
    for (const OwnProperty& p : law->own_properties) names.emplace_back(p.name);
  };
  if (type) add(materials().find(type->text)), add(contact_laws().find(type->text)), add(joint_laws().find(type->text));
  return names;
}

// The name of a property as defined by its law. Names in scripts are case-insensitive, and some differ.
std::string property_name(const Statement& material, const std::string& word) {
  static const std::map<std::string, std::string> all{{"a", "alpha"},
                                                      {"aa", "alphaA"},
                                                      {"at", "alphaT"},
                                                      {"ax", "alphax"},
                                                      {"ay", "alphay"},
                                                      {"az", "alphaz"},
                                                      {"direction", "SetDirection"},
                                                      {"settingfunction", "SettingFunction"},
                                                      {"settingfunction2", "SettingFunction2"},
                                                      {"settingfunction3", "SettingFunction3"},
                                                      {"settingfunctionx", "SettingFunction"},
                                                      {"settingfunctiony", "SettingFunction2"},
                                                      {"settingfunctionz", "SettingFunction3"},
                                                      {"ujoption", "UJOption"},
                                                      {"largerotation", "largeRotation"},
                                                      {"pdamping", "PDamping"},
                                                      {"taylorquinney", "TaylorQuinney"},
                                                      {"liquidphase", "LiquidPhase"},
                                                      {"cv", "Cv"},
                                                      {"kcond", "kCond"}};
  if (const auto found = all.find(lower(word)); found != all.end()) return found->second;
  const std::vector<std::string> known = properties_of(material);
  if (std::find(known.begin(), known.end(), word) != known.end()) return word;  // EZ and Ez are two properties
  const auto same =
      std::find_if(known.begin(), known.end(), [&](const auto& name) { return lower(name) == lower(word); });
  return same == known.end() ? word : *same;
}

// Names of types in scripts that differ from the names in the catalogue.
const std::map<std::string, std::string>& scripted_types() {
  static const std::map<std::string, std::string> all{
      {"transverse 1", "2"}, {"transverse 2", "3"}, {"mooney", "8"}, {"ideal gas", "22"}, {"tait liquid", "27"}};
  return all;
}
std::string type_name(const std::string& word) {
  const auto found = scripted_types().find(lower(word));
  return found == scripted_types().end() ? word : found->second;
}

// Unknown types are reported here, where the names of scripts are also known.
void check_type(const Command& c, const std::string& type) {
  if (to_number(type) || materials().find(type) || contact_laws().find(type) || joint_laws().find(type) ||
      !reason_against_type(type).empty())
    return;
  std::vector<std::string> known;
  for (const auto& [name, number] : scripted_types()) known.push_back(name);
  for (const auto& item : materials().items()) known.push_back(item.name);
  for (const auto& item : contact_laws().items()) known.push_back(item.name);
  for (const auto& item : joint_laws().items()) known.push_back(item.name);
  const std::string near = did_you_mean(type, known);
  if (!near.empty()) throw InputError(c.origin(2), "there is no material type '" + type + "'" + near);
}

constexpr std::array box_edges{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
constexpr std::array line_ends{"x1", "x2", "y1", "y2", "z1", "z2"};

Statement element(const std::string& name, const Origin& origin, const std::string& text = {}) {
  Statement s;
  s.name = name, s.origin = s.text_origin = origin, s.text = text;
  return s;
}

}  // namespace

void Translator::material(const Command& c) {
  if (stage_) return material_of_stage(c);
  if (c.size() < 3)
    throw InputError(c.origin(), "'Material' takes 3 arguments, not " + std::to_string(c.size()) + ": id, name, type");
  open(Open::material, c);
  Statement& m = document_.material(
      c.origin());  // first, so that after an error its properties are not assigned to another material
  document_.name_material(c.text(0), c.origin(0));
  attribute(m, "Type", type_name(c.text(2)), c.origin(2));
  attribute(m, "Name", c.text(1), c.origin(1));
  check_type(c, m.attribute("Type")->text);
}

void Translator::property(const Command& c) {
  Statement& m = document_.materials().back();
  const std::string word = lower(c.node.word);
  const auto add = [&](Statement s) { m.children.push_back(std::move(s)); };
  if (word == "contact") {
    Statement s = element("Friction", c.origin());
    Document::refer(s, "law", c.text(0), c.origin(0)), Document::refer(s, "mat", c.text(1), c.origin(1));
    return add(std::move(s));
  }
  const auto known = properties_of(m);
  const bool own = std::find(known.begin(), known.end(), property_name(m, c.node.word)) != known.end();
  if (!own && (word == "friction" || word == "imperfectinterface" || word == "interface")) {
    const std::size_t other = word == "friction" ? 1 : 3;
    if (!c.given(other))
      throw InputError(c.origin(), "'" + c.node.word + "' inside a material needs the other material of the pair as " +
                                       (other == 1 ? "second" : "fourth") + " argument");
    Statement s = number_law(c);
    Document::refer(s, "mat", c.text(other), c.origin(other));
    return add(std::move(s));
  }
  if (word == "sharematfield" || word == "liquidphase") {
    Statement s = element(word == "liquidphase" ? "LiquidPhase" : "shareMatField", c.origin());
    Document::refer_text(s, c.text(0), c.origin(0));
    return add(std::move(s));
  }
  if (word == "color") return;  // colour in plots of NairnFEAMPM
  std::string text;
  for (std::size_t k = 0; k < c.size(); ++k) text += (k ? "," : "") + c.text(k);
  Statement s = element(property_name(m, c.node.word), c.origin(), text);
  s.text_origin = c.origin(0);
  if (s.name == "LiquidPhase") Document::refer_text(s, text, c.origin(0));
  add(std::move(s));
}

void Translator::assigned(const std::string& name, const Node& n) const {
  if (open_ != Open::material || document_.materials().empty()) return;
  const auto known = properties_of(document_.materials().back());
  if (!of_no_law(name) && std::find(known.begin(), known.end(), name) == known.end()) return;
  throw InputError(n.origin, "this sets a variable '" + name + "', not the property of the material; did you mean '" +
                                 name + " " + n.arguments.front().text + "'?");
}

void Translator::unknown_properties(const Statement& material, Problems& problems) {
  const std::vector<std::string> known = properties_of(material);
  for (const Statement& p : material.children) {
    if (known.empty() || std::find(known.begin(), known.end(), p.name) != known.end()) continue;
    const auto reason = reason_against(refused_properties(), p.name);
    if (!reason.empty())
      problems.add(p.origin, "Tribo does not read '" + p.name + "': " + std::string(reason));
    else if (!of_no_law(p.name) && !find_element(p.name, "Material"))
      problems.add(p.origin, not_a_property(p.name, known));
  }
}

void Translator::region(const Command& c) {
  const bool solid = dimension(c) == 3;
  open(Open::region, c);
  block_ = element("Body", c.origin());
  Document::refer(block_, "mat", c.text(0), c.origin(0));
  const std::array names{"vx", "vy", solid ? "vz" : "thick"};
  for (std::size_t k = 1; k < std::min<std::size_t>(4, c.size()); ++k)
    if (c.given(k)) attribute(block_, names[k - 1], c.text(k), c.origin(k));
  if (c.size() > 4 && c.size() % 2 != 0)
    throw InputError(c.origin(), "after the velocity and thickness come pairs: a name and its value");
  for (std::size_t k = 4; k + 1 < c.size(); k += 2) attribute(block_, c.text(k), c.text(k + 1), c.origin(k));
}

void Translator::hole(const Command& c) {
  open(Open::hole, c);
  block_ = element("Hole", c.origin());
}

void Translator::picture(const Command& c) {
  open(Open::picture, c);
  block_ = element("BMP", c.origin());
  constexpr std::array names{"name", "width", "height"};
  for (std::size_t k = 0; k < std::min<std::size_t>(3, c.size()); ++k)
    if (c.given(k)) attribute(block_, names[k], c.text(k), c.origin(k));
}

void Translator::intensity(const Command& c) {
  if (open_ != Open::picture) throw InputError(c.origin(), "'Intensity' belongs into 'BMPRegion ... EndRegion'");
  Statement s = element("Intensity", c.origin());
  Document::refer(s, "mat", c.text(0), c.origin(0));
  attribute(s, "imin", c.text(1), c.origin(1)), attribute(s, "imax", c.text(2), c.origin(2));
  for (std::size_t k = 3; k + 1 < c.size(); k += 2) attribute(s, c.text(k), c.text(k + 1), c.origin(k));
  block_.children.push_back(std::move(s));
}

void Translator::picture_origin(const Command& c) {
  if (open_ != Open::picture) throw InputError(c.origin(), "'Origin' belongs into 'BMPRegion ... EndRegion'");
  Statement s = element("Origin", c.origin());
  attribute(s, "x", c.text(0), c.origin(0)), attribute(s, "y", c.text(1), c.origin(1));
  block_.children.push_back(std::move(s));
}

// x -> R (x - o) + o + t
void Translator::transform(const Command& c) {
  if (open_ != Open::region) throw InputError(c.origin(), "'Transform' belongs into 'Region ... EndRegion'");
  if (c.size() > 5)
    throw InputError(c.origin(5), "rotations about other axes than z are not read; use <Deform> in XMLData");
  const double angle = c.number(0) * M_PI / 180, cosine = std::cos(angle), sine = std::sin(angle);
  const double tx = c.number(1), ty = c.number(2), ox = c.number(3), oy = c.number(4);
  const auto linear = [](double a, double b, double constant) {
    return "(" + written(a) + ")*x+(" + written(b) + ")*y+(" + written(constant) + ")";
  };
  Statement s = element("Deform", c.origin());
  attribute(s, "dX", linear(cosine - 1, -sine, tx - (cosine - 1) * ox + sine * oy), c.origin());
  attribute(s, "dY", linear(sine, cosine - 1, ty - sine * ox - (cosine - 1) * oy), c.origin());
  attribute(s, "F11", written(cosine), c.origin()), attribute(s, "F12", written(-sine), c.origin());
  attribute(s, "F21", written(sine), c.origin()), attribute(s, "F22", written(cosine), c.origin());
  block_.children.push_back(std::move(s));
}

void Translator::rotate(const Command& c) {
  if (open_ != Open::region) throw InputError(c.origin(), "'Rotate' belongs into 'Region ... EndRegion'");
  for (std::size_t k = 0; k + 1 < c.size(); k += 2) {
    const std::string axis = lower(c.text(k));
    if (axis != "x" && axis != "y" && axis != "z")
      throw InputError(c.origin(k), "an axis is x, y or z, not '" + c.text(k) + "'");
    Statement s = element(std::string("Rotate") + static_cast<char>(axis[0] - 'a' + 'A'), c.origin(k), c.text(k + 1));
    s.text_origin = c.origin(k + 1);
    block_.children.push_back(std::move(s));
  }
}

void Translator::initial_velocity(const Command& c) {
  if (open_ != Open::region) throw InputError(c.origin(), "'" + c.node.word + "' belongs into 'Region ... EndRegion'");
  std::string name = lower(c.node.word);
  name.back() = static_cast<char>(name.back() - 'a' + 'A');
  block_.children.push_back(element(name, c.origin(0), c.text(0)));
}

void Translator::initial_stress(const Command& c) {
  if (open_ != Open::region) throw InputError(c.origin(), "'InitialStress' belongs into 'Region ... EndRegion'");
  if (c.size() % 2 != 0) throw InputError(c.origin(), "'InitialStress' takes pairs: a component and its value");
  Statement s = element("InitialStress", c.origin());
  for (std::size_t k = 0; k < c.size(); k += 2) attribute(s, c.text(k), c.text(k + 1), c.origin(k));
  block_.children.push_back(std::move(s));
}

// Parent of the next shape: the list of shapes, or for cut-outs the last shape, the last cut-out in it, ...
Statement& Translator::place(const Command& c, int cuts) {
  if (open_ != Open::region && open_ != Open::hole && open_ != Open::grid && open_ != Open::particles &&
      open_ != Open::action && open_ != Open::blocks)
    throw InputError(
        c.origin(),
        "'" + c.node.word + "' is a shape; it belongs into 'Region', 'Hole', 'GridBC', 'ParticleBC' or 'Blocks'");
  const bool selects = open_ == Open::grid || open_ == Open::particles;
  if (selects && cuts == 0 && !block_.name.empty()) throw InputError(c.origin(), "there is a shape already");
  const bool of_block = open_ == Open::blocks;  // the shape belongs to the line before it, or is cut from its last one
  if (of_block && cuts == 0) must_follow_line(c, "Rect");
  const std::size_t depth = static_cast<std::size_t>(cuts) + (of_block ? 1 : 0);
  if (depth > path_.size()) throw InputError(c.origin(), "'Cut' needs a shape to cut from before it");
  if (selects && block_.name.empty()) block_ = element("BCShape", c.origin());
  path_.resize(depth);
  Statement* at = &block_;
  for (const std::size_t k : path_) at = &at->children[k];
  path_.push_back(at->children.size());
  return *at;
}

void Translator::shape(const Command& c) {
  std::string name = lower(c.node.word);
  const bool solid = c.size() >= 6 && name != "arc" && (name != "line" || dimension(c) == 3);
  if (name == "rect" && solid) name = "box";
  if (name == "oval" && solid) name = "sphere";
  static const std::map<std::string, std::string> names{
      {"rect", "Rect"}, {"oval", "Oval"},     {"line", "Line"},         {"arc", "Arc"},
      {"box", "Box"},   {"sphere", "Sphere"}, {"cylinder", "Cylinder"}, {"torus", "Torus"}};
  Statement s = element(names.at(name), c.origin());
  const bool selects = open_ == Open::grid || open_ == Open::particles;
  const bool line = name == "line", arc = name == "arc";
  const std::size_t edges = solid ? 6 : 4;
  for (std::size_t k = 0; k < edges; ++k) attribute(s, line ? line_ends[k] : box_edges[k], c.text(k), c.origin(k));
  std::vector<std::string> more;
  if (line) more = {"tolerance"};
  if (arc) more = {"start", "end", "tolerance"};
  if (name == "cylinder" || name == "torus") more = {"axis", "radius"};
  if (c.size() > edges + more.size())
    throw InputError(c.origin(edges + more.size()), "'" + c.node.word + "' does not take this argument");
  for (std::size_t k = edges; k < c.size(); ++k)
    if (c.given(k)) attribute(s, more[k - edges], c.text(k), c.origin(k));
  if (selects && (line || arc) && c.node.cuts == 0) {
    if (!block_.name.empty()) throw InputError(c.origin(), "there is a shape already");
    s.name = line ? "BCLine" : "BCArc";
    block_ = std::move(s);
    return;
  }
  place(c, c.node.cuts).children.push_back(std::move(s));
}

void Translator::shape_of_file(const Command& c) {
  const bool heights = lower(c.node.word) == "terrain";
  Statement s = element(heights ? "Terrain" : "Surface", c.origin());
  attribute(s, "file", c.text(0), c.origin(0));
  if (heights) attribute(s, to_number(c.text(1)) ? "zmin" : "below", c.text(1), c.origin(1));
  const std::size_t first = heights ? 2 : 1;
  std::vector<std::string> more{"scale", "x", "y", "z"};
  if (heights)
    more.insert(more.end(), {"width", "depth", "low", "high"});
  else
    more.emplace_back("group");
  for (std::size_t k = first; k < c.size(); ++k)
    if (c.given(k)) attribute(s, more[k - first], c.text(k), c.origin(k));
  place(c, c.node.cuts).children.push_back(std::move(s));
}

void Translator::particle_table(const Command& c) {
  if (open_ != Open::nothing)
    throw InputError(c.origin(),
                     "'ParticleTable' is a body of its own and stands outside of 'Region' and other blocks");
  Statement s = element("ParticleTable", c.origin());
  Document::refer(s, "mat", c.text(0), c.origin(0));
  attribute(s, "file", c.text(1), c.origin(1));
  if (c.size() % 2 != 0) throw InputError(c.origin(), "after the file come pairs: a name and its value");
  for (std::size_t k = 2; k + 1 < c.size(); k += 2) attribute(s, c.text(k), c.text(k + 1), c.origin(k));
  document_.section("MaterialPoints", c.origin()).children.push_back(std::move(s));
}

void Translator::polygon_point(const Command& c) {
  if (c.size() == 0) return close_polygon();
  const bool of_blocks = open_ == Open::blocks && c.node.cuts == 0 && !polygon_ && !block_.children.empty();
  if (of_blocks && find_element("pt", block_.children.back().name)) {
    Statement s = element("pt", c.origin());
    constexpr std::array axes{"x", "y", "z"};
    for (std::size_t k = 0; k < c.size(); ++k) attribute(s, axes[k], c.text(k), c.origin(k));
    block_.children.back().children.push_back(std::move(s));
    return;
  }
  if (c.size() != 2) throw InputError(c.origin(), "a point of a polygon is x, y");
  if (!polygon_) {
    Statement& to = place(c, c.node.cuts);
    to.children.push_back(element("Polygon", c.origin()));
    polygon_ = &to.children.back();
  }
  Statement point = element("pt", c.origin());
  attribute(point, "x", c.text(0), c.origin(0)), attribute(point, "y", c.text(1), c.origin(1));
  polygon_->children.push_back(std::move(point));
}

void Translator::conditions(const Command& c) {
  const bool on_nodes = lower(c.node.word) == "gridbc";
  if (c.given(0)) {
    if (lower(c.text(0)) != "add" || !stage_)
      throw InputError(c.origin(0), "'" + c.node.word + "' takes one argument in a stage only: add, which keeps the " +
                                        "former conditions");
    Statement& section = document_.section(on_nodes ? "GridBCs" : "ParticleBCs", c.origin());
    if (!section.attribute("add")) attribute(section, "add", "yes", c.origin(0));
  }
  open(lower(c.node.word) == "gridbc" ? Open::grid : Open::particles, c);
}

// MoveLine, LoadLine and the like: a shape and its conditions in one block.
void Translator::old_selector(const Command& c) {
  struct Kind {
    std::string_view word;
    const char* element;
    std::vector<const char*> attributes;
  };
  static const std::vector<Kind> kinds{{"line", "BCLine", {"x1", "y1", "x2", "y2", "tolerance"}},
                                       {"arc", "BCArc", {"x1", "y1", "x2", "y2", "start", "end", "tolerance"}},
                                       {"box", "BCBox", {"xmin", "ymin", "zmin", "xmax", "ymax", "zmax", "axis"}},
                                       {"rect", "LdRect", {"xmin", "xmax", "ymin", "ymax"}}};
  const std::string word = lower(c.node.word);
  open(word.starts_with("move") ? Open::grid : Open::particles, c);
  const Kind& kind = *std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return word.ends_with(k.word); });
  block_ = element(kind.element, c.origin());
  for (std::size_t k = 0; k < c.size(); ++k) {
    const bool default_tolerance =
        std::string_view(kind.attributes[k]) == "tolerance" && to_number(c.text(k)).value_or(1) <= 0;
    if (c.given(k) && !default_tolerance) attribute(block_, kind.attributes[k], c.text(k), c.origin(k));
  }
}

Statement& Translator::condition(const Command& c, const std::string& name) {
  if (open_ != Open::grid && open_ != Open::particles)
    throw InputError(c.origin(), "'" + c.node.word + "' belongs into 'GridBC' or 'ParticleBC'");
  if (block_.name.empty())
    throw InputError(c.origin(), "'" + c.node.word + "' needs a shape before it, to which it applies");
  block_.children.push_back(element(name, c.origin()));
  Statement& s = block_.children.back();
  if (!boundary_id_.empty() && open_ == Open::grid) attribute(s, "id", boundary_id_, c.origin());
  return s;
}

std::string Translator::direction(const Command& c, std::size_t k, bool traction) {
  static const std::map<std::string, std::string> all{{"x", "1"}, {"y", "2"}, {"z", "3"}, {"r", "1"},
                                                      {"1", "1"}, {"2", "2"}, {"3", "3"}};
  static const std::map<std::string, std::string> skewed{{"skewxy", "12"}, {"skewrz", "12"},   {"skewxz", "13"},
                                                         {"skewyz", "23"}, {"skewxyz", "123"}, {"12", "12"},
                                                         {"13", "13"},     {"23", "23"},       {"123", "123"}};
  static const std::map<std::string, std::string> faces{{"normal", "11"}, {"shear", "12"}, {"11", "11"}, {"12", "12"}};
  const std::string word = lower(c.text(k));
  if (const auto found = all.find(word); found != all.end()) return found->second;
  const auto& more = traction ? faces : skewed;
  if (const auto found = more.find(word); found != more.end()) return found->second;
  throw InputError(c.origin(k), "'" + c.text(k) + "' is not a direction; valid: x, y, z, " +
                                    (traction ? "normal, shear" : "skewxy, skewxz, skewyz, skewxyz"));
}

// Reads style, value and time from argument k on.
void Translator::style(Statement& s, const Command& c, std::size_t k, const char* value_name) {
  const std::string word = lower(c.text(k));
  attribute(s, "style", word, c.origin(k));
  const bool function = word == "function" || word == "6";
  if (c.given(k + 1)) attribute(s, function ? "function" : value_name, c.text(k + 1), c.origin(k + 1));
  if (c.given(k + 2)) attribute(s, "time", c.text(k + 2), c.origin(k + 2));
}

void Translator::velocity(const Command& c) {
  Statement& s = condition(c, "DisBC");
  attribute(s, "dir", direction(c, 0, false), c.origin(0));
  if (lower(c.text(1)) == "gradient") {
    attribute(s, "style", "function", c.origin(1));
    const std::pair<std::size_t, const char*> of_walls[] = {
        {2, "function"}, {3, "time"}, {4, "depth"}, {5, "gradfxn"}, {6, "dispfxn"}};
    for (const auto& [k, name] : of_walls)
      if (c.given(k)) attribute(s, name, c.text(k), c.origin(k));
    if (!c.given(4)) throw InputError(c.origin(1), "a moving wall needs its depth, the fifth argument");
    return;
  }
  style(s, c, 1, "vel");
  if (c.given(4)) attribute(s, "angle", c.text(4), c.origin(4));
  if (c.given(5)) attribute(s, "angle2", c.text(5), c.origin(5));
}

void Translator::temperature(const Command& c) { style(condition(c, "TempBC"), c, 0, "value"); }

void Translator::load(const Command& c) {
  Statement& s = condition(c, "LoadBC");
  attribute(s, "dir", direction(c, 0, false), c.origin(0));
  style(s, c, 1, "load");
  if (c.given(4)) without_effect(c, 4);
}

void Translator::without_effect(const Command& c, std::size_t k) {
  document_.problems().warn(c.origin(k), "this argument of '" + c.node.word + "', '" + c.text(k) + "', has no effect");
}

void Translator::load_type(const Command& c) {
  const std::string word = lower(c.text(0));
  if (word != "net" && word != "perparticle")
    throw InputError(c.origin(0), "a load is 'net' or 'perParticle', not '" + c.text(0) + "'");
  condition(c, word == "net" ? "net" : "perParticle");
}

void Translator::traction(const Command& c) {
  Statement& s = condition(c, "TractionBC");
  attribute(s, "dir", direction(c, 0, true), c.origin(0));
  attribute(s, "face", c.text(1), c.origin(1));
  const bool number = c.given(5) && to_number(c.text(5));
  if (number) without_effect(c, 5);
  if (number || !c.given(5)) return style(s, c, 2, "stress");
  const std::string word = lower(c.text(2));
  if (word != "function" && word != "6")
    throw InputError(c.origin(5), "a function belongs to the style 'function', not to '" + c.text(2) + "'");
  if (c.given(3) && to_number(c.text(3)) != 0.0)
    throw InputError(c.origin(3),
                     "a traction of style 'function' has no value besides its function; leave it out or 0");
  attribute(s, "style", word, c.origin(2)), attribute(s, "function", c.text(5), c.origin(5));
  if (c.given(4)) attribute(s, "time", c.text(4), c.origin(4));
}

void Translator::heat_flux(const Command& c) {
  Statement& s = condition(c, "HeatFluxBC");
  const std::string kind = lower(c.text(0));
  attribute(s, "dir", kind == "external" ? "1" : kind == "coupled" ? "2" : c.text(0), c.origin(0));
  attribute(s, "face", c.text(1), c.origin(1));
  style(s, c, 2, "value");
}

void Translator::boundary_id(const Command& c) { boundary_id_ = c.given(0) ? c.text(0) : std::string(); }

}  // namespace tribo::script
