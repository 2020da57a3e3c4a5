// SPDX-License-Identifier: MIT
/// Contact between materials: methods for normals and gaps, and the laws of pairs.

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tribo {
namespace {

std::string law_names() {
  std::vector<std::string> contact, joint;
  for (const auto& item : contact_laws().items()) contact.push_back(item.name);
  for (const auto& item : joint_laws().items()) joint.push_back(item.name);
  return join(contact) + "; or of a joint: " + join(joint);
}

NormalMethod normal_method(const std::string& word) {
  struct Name {
    std::string_view number, word;
    NormalMethod method;
  };
  using N = NormalMethod;
  static constexpr Name all[] = {{"0", "maxgrad", N::steepest},  {"1", "maxvol", N::largest},
                                 {"2", "avggrad", N::average},   {"3", "owngrad", N::own},
                                 {"4", "specify", N::specified}, {"5", "linreg", N::linear},
                                 {"6", "logreg", N::logistic},   {"7", "margin", N::margin}};
  for (const auto& name : all)
    if (word == name.number || word == name.word) return name.method;
  return N::margin;
}

Statement property(const Statement& from, const char* name, const std::string& value) {
  Statement s;
  s.name = name, s.text = value, s.origin = s.text_origin = from.origin;
  return s;
}

}  // namespace

// The law named by number or name in <Friction> or <CrackList>; null after a problem.
const MaterialSpec* Builder::named_law(const Statement& s) {
  const Attribute* a = s.attribute("lawname") ? s.attribute("lawname") : s.attribute("law");
  const auto law = [](const MaterialSpec& m) {
    return tribo::contact_laws().find(m.type) || tribo::joint_laws().find(m.type);
  };
  std::vector<std::string> names;
  for (const auto& m : model_.materials)
    if (law(m)) names.push_back(m.name);
  const MaterialSpec* found = nullptr;
  const auto number = a->name == "law" ? to_number(a->text) : std::nullopt;
  if (!number) {
    for (const auto& m : model_.materials)
      if (m.name == a->text && (!found || law(m))) found = &m;
  } else if (*number >= 1 && *number <= static_cast<double>(model_.materials.size()) &&
             *number == std::floor(*number)) {
    found = &model_.materials[static_cast<std::size_t>(*number) - 1];
  }
  const std::string valid =
      names.empty() ? "this file defines none: give a <Material> of the type of a contact law: " + law_names()
                    : "contact and joint laws: " + join(names);
  if (!found) {
    problems_.add(a->origin,
                  "there is no contact or joint law '" + a->text + "'" + did_you_mean(a->text, names) + "; " + valid);
    return nullptr;
  }
  if (law(*found)) return found;
  const bool known_type = !found->type.empty();  // otherwise its type is the problem, which is reported there
  must(!known_type, a->origin,
       "'" + found->name + "' at " + found->origin.text() + " is a material, not a contact law or a joint law; " +
           valid);
  return nullptr;
}

// The default law of all pairs. It cannot be a joint law, which acts only between faces that touch at the start.
std::shared_ptr<const ContactLaw> Builder::default_law(const Statement& s) {
  const MaterialSpec* found = named_law(s);
  if (!found) return nullptr;
  if (tribo::joint_laws().find(found->type)) {
    const Attribute* a = s.attribute("lawname") ? s.attribute("lawname") : s.attribute("law");
    problems_.add(a->origin,
                  "'" + found->name + "' at " + found->origin.text() + " is the joint law " + found->type +
                      ", which acts only between faces that touch at the start; it cannot be the law of all pairs "
                      "for all contacts. Assign it to two materials by <Friction lawname='" +
                      found->name + "' matname='...'/> inside one of them, or to a <CrackList>");
    return nullptr;
  }
  return found->contact;
}

void Builder::must_suit_grid(const MaterialSpec& law, const Origin& origin) {
  must(!law.joint || (!law.joint->needs_distance() && law.joint->poisson() == 0), origin,
       "'" + law.name +
           "' represents the elasticity of the bodies (compute-stiffness, sn_pois), but bodies in the grid "
           "have their own elasticity; use assign-stiffness");
  for (const char* name : {"krot", "sn_moment"})
    if (const Statement* moment = law.joint ? law.statement.child(name) : nullptr) {
      std::string text = moment->text;
      std::replace(text.begin(), text.end(), ',', ' ');
      const auto words = words_of(text);
      must(std::all_of(words.begin(), words.end(), [](const auto& word) { return to_number(word) == 0.0; }),
           moment->origin,
           "<" + std::string(name) + "> of '" + law.name +
               "' acts on a relative rotation of two faces at a point, but " + origin.text() +
               " uses the law in a grid, where the faces of bodies are deformable and such a rotation is a gap that "
               "varies "
               "along them: the points of a joint resist it together. Leave <" +
               name + "> out");
    }
  if (law.joint && law.joint->user_areas().size() == 1)
    problems_.warn(origin,
                   "<user_area> of '" + law.name +
                       "' is the area of every single point of the crack or interface, not of the whole; give one "
                       "area for each point, or leave it out: the program finds the area of each point");
}

// <Friction>0.3</Friction>: the old form of NairnMPM, in which a number selects the law.
std::shared_ptr<const ContactLaw> Builder::law_by_number(const Statement& s) {
  const double value = text_number(s, Dimension::none);
  Statement law;
  law.name = "Material", law.origin = s.origin;
  std::string_view type = "CoulombFriction";
  if (value <= -10) {
    type = "IgnoreContact";
  } else if (value < 10) {
    law.children.push_back(property(s, "coeff", s.text));
  } else {
    type = "LinearInterface";
    for (const char* name : {"Dn", "Dnt", "Dnc", "Dt"})
      if (const Attribute* a = s.attribute(name))
        law.children.push_back(property(s, std::string_view(name) == "Dn" ? "Dnt" : name, a->text));
  }
  return tribo::contact_laws().find(type)->make(law, {}, model_.units, problems_);
}

void Builder::contact() {
  for (const auto& m : model_.materials)
    if (m.contact && m.contact->liquid() != 0) liquid_of(m);
  const Statement* mode = root_.child("MPMHeader")->child("MultiMaterialMode");
  if (!mode) {
    for (const auto* m : material_statements_)
      if (const auto* f = m->child("Friction"))
        problems_.add(f->origin,
                      "a contact law of two materials needs <MultiMaterialMode> in <MPMHeader>; without it materials "
                      "stick together");
    return;
  }
  ContactSpec& c = model_.contact;
  c.active = true;
  c.normals = normal_method(word(*mode, "Normals", "margin"));
  if (has(*mode, "Impulses")) c.at_faces = word(*mode, "Impulses") == "faces";
  c.rigid_bias = number(*mode, "RigidBias", Dimension::none, 1.0);
  must(c.rigid_bias > 0, mode->origin, "'RigidBias' must be positive");
  const bool angles = has(*mode, "Azimuth") || has(*mode, "Polar");
  if (c.normals == NormalMethod::specified)
    must(has(*mode, "Azimuth"), mode->attribute("Normals")->origin,
         "a specified normal needs its angles: Azimuth (from x, degrees) and in three dimensions Polar (from z)");
  else
    must(!angles, mode->origin, "'Azimuth' and 'Polar' belong to Normals='specify'");
  const double azimuth = number(*mode, "Azimuth", Dimension::angle),
               polar = number(*mode, "Polar", Dimension::angle, std::numbers::pi / 2);
  c.direction = Vec3(std::cos(azimuth) * std::sin(polar), std::sin(azimuth) * std::sin(polar), std::cos(polar));
  if (model_.dimension() == 2) c.direction[2] = 0.0, c.direction.normalize();

  const bool particles =
      c.normals == NormalMethod::margin || c.normals == NormalMethod::logistic || c.normals == NormalMethod::linear;
  if (const auto* p = mode->child("ContactPosition")) {
    c.position = text_number(*p, Dimension::none, 0.8);
    must(c.position != 0, p->text_origin, "<ContactPosition> is a number of cells, or minus an exponent, not 0");
    if (!particles) c.separation = Separation::positions;
  } else if (has(*mode, "Normals") && !particles) {
    c.separation = Separation::displacements;
  }
  if (const Attribute* s = mode->attribute("Separation"))
    c.separation = s->text == "edges"       ? Separation::edges
                   : s->text == "positions" ? Separation::positions
                                            : Separation::displacements;

  if (const auto* f = mode->child("Friction"))
    c.default_law = f->attribute("law") || f->attribute("lawname") ? default_law(*f) : law_by_number(*f);
  else
    c.default_law = tribo::contact_laws().find("CoulombFriction")->make(Statement{}, {}, model_.units, problems_);
  pair_laws();
  shared_fields();
}

void Builder::pair_laws() {
  std::map<std::pair<int, int>, Origin> given;
  for (std::size_t k = 0; k < material_statements_.size(); ++k)
    for (const auto& f : material_statements_[k]->children) {
      if (f.name != "Friction") continue;
      const std::string type = word(*material_statements_[k], "Type");
      must(!tribo::contact_laws().find(type) && !tribo::joint_laws().find(type), f.origin,
           "<Friction> belongs to a material, not to a contact law");
      if (!has(f, "mat") && !has(f, "matname")) {
        problems_.add(f.origin,
                      "<Friction> inside a material needs 'mat' or 'matname', the other material of the pair");
        continue;
      }
      const int self = static_cast<int>(k), other = material(f);
      if (self == other) separate(self, f);
      const std::pair pair{std::min(self, other), std::max(self, other)};
      const auto [entry, fresh] = given.try_emplace(pair, f.origin);
      if (!fresh) problems_.add(f.origin, "this pair of materials already has a law, at " + entry->second.text());
      pair_law(f, self, other);
    }
}

// A law of a material with itself acts between its bodies, each of which then has a velocity field of its own.
void Builder::separate(int material, const Statement& f) {
  MaterialSpec& spec = model_.materials[static_cast<std::size_t>(material)];
  if (!spec.law) return;  // its type is reported as unknown
  must(!spec.law->rigid(), f.origin,
       "contact does not change the motion of rigid bodies, so '" + spec.name + "' needs no law with itself");
  must(!material_statements_[static_cast<std::size_t>(material)]->child("shareMatField"), f.origin,
       "a law between the bodies of '" + spec.name + "' contradicts its <shareMatField>");
  spec.separate = true;
}

// Gives each body of a separate material an entry of its own in the list of materials. Particles without a body would
// all have the same velocity field.
void Builder::separate_bodies() {
  const auto count = static_cast<int>(model_.materials.size());
  std::vector<int> bodies(model_.materials.size(), 0);
  std::vector<int> kinds(model_.materials.size());
  std::iota(kinds.begin(), kinds.end(), 0);
  for (Piece& piece : model_.pieces) {
    if (piece.material < 0 || piece.material >= count) continue;
    const int kind = piece.material;
    if (!model_.materials[static_cast<std::size_t>(kind)].separate) continue;
    MaterialSpec own = model_.materials[static_cast<std::size_t>(kind)];
    own.name += " " + std::to_string(++bodies[static_cast<std::size_t>(kind)]);
    piece.material = static_cast<int>(model_.materials.size());
    model_.materials.push_back(std::move(own));
    kinds.push_back(kind);
  }
  if (kinds.size() > static_cast<std::size_t>(count)) model_.contact.kinds = std::move(kinds);
  const auto refuse = [&](int material, const std::string& what) {
    if (material < 0 || material >= count) return;
    const MaterialSpec& spec = model_.materials[static_cast<std::size_t>(material)];
    must(!spec.separate, spec.origin,
         "'" + spec.name + "' has a contact law with itself, which is not implemented for " + what);
  };
  for (const ParticleTable& table : model_.tables) refuse(table.material, "tables of particles");
  for (const PointSpec& point : model_.points) refuse(point.material, "single particles");
  for (const SourceSpec& source : model_.sources) refuse(source.material, "inlets");
  for (const auto& placement : model_.placements)
    for (const Piece& piece : placement.pieces) refuse(piece.material, "bodies that a stage places");
  for (const auto& [pair, joint] : model_.contact.joints)
    for (const int material : joint.materials) refuse(material, "materials with a joint");
}

// Body 1 of a joint is the material that contains <Friction>.
void Builder::pair_law(const Statement& f, int self, int other) {
  const std::pair pair{std::min(self, other), std::max(self, other)};
  ContactSpec& c = model_.contact;
  if (!has(f, "law") && !has(f, "lawname")) {
    if (const auto law = law_by_number(f)) c.pair_laws[pair] = law;
    return;
  }
  const MaterialSpec* law = named_law(f);
  if (!law) return;
  must_suit_grid(*law, f.origin);
  must(!law->joint || self != other, f.origin,
       "joint laws between the bodies of one material are not implemented: give these bodies materials of their own");
  if (law->joint)
    c.joints[pair] = {law->joint, {self, other}, f.origin};
  else if (law->contact)
    c.pair_laws[pair] = law->contact;
}

void Builder::shared_fields() {
  for (std::size_t k = 0; k < material_statements_.size(); ++k) {
    const auto* s = material_statements_[k]->child("shareMatField");
    if (!s) continue;
    const auto number = to_number(s->text);
    const int count = static_cast<int>(material_statements_.size());
    if (!number || *number < 1 || *number > count || *number != std::floor(*number)) {
      problems_.add(s->origin, "<shareMatField> needs the number of a material; the number of materials is " +
                                   std::to_string(count));
      continue;
    }
    const int with = static_cast<int>(*number) - 1;
    auto& spec = model_.materials[k];
    const auto& other = model_.materials[static_cast<std::size_t>(with)];
    if (!spec.law || !other.law) {
      must(!tribo::contact_laws().find(other.type), s->origin,
           "'" + other.name + "' is a contact law and has no velocity field");
      continue;
    }
    must(with != static_cast<int>(k), s->origin, "a material cannot share with itself");
    must(!spec.law->rigid() && !other.law->rigid(), s->origin, "rigid materials do not share a velocity field");
    must(!other.separate, s->origin,
         "the bodies of '" + other.name +
             "' have a velocity field each, since it has a contact law with itself; no other material can share them");
    must(other.share_field_with < 0, s->origin,
         "'" + other.name + "' itself shares the field of another material; use the number of that material");
    spec.share_field_with = with;
  }
}

void Builder::liquid_of(const MaterialSpec& law) {
  const int number = law.contact->liquid();
  const Statement* s = law.statement.child("LiquidPhase");
  if (number < 1 || number > static_cast<int>(model_.materials.size())) {
    problems_.add(s->origin, "there is no material number '" + s->text + "'; this file has " +
                                 std::to_string(model_.materials.size()));
    return;
  }
  const auto& liquid = model_.materials[static_cast<std::size_t>(number) - 1];
  if (!liquid.law || !liquid.law->liquid()) {
    if (liquid.law || liquid.contact)
      problems_.add(s->origin,
                    "'" + liquid.name + "' at " + liquid.origin.text() +
                        " is not a liquid; <LiquidPhase> needs a material with a viscosity, such as TaitLiquid");
    return;
  }
  law.contact->set_viscosity([m = liquid.law](double rate) { return m->viscosity(rate); });
}

}  // namespace tribo
