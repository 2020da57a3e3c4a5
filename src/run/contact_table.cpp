// SPDX-License-Identifier: MIT
#include "run/contact_table.hpp"

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace tribo {
namespace {

// A law of the input with its name and properties.
std::string words_of_law(const MaterialSpec& law) {
  std::string properties;
  for (const auto& child : law.statement.children)
    if (child.children.empty() && !child.text.empty())
      properties +=
          (properties.empty() ? "" : ", ") + child.name + " " + child.text +
          (child.name == "coeff" && child.text.front() == '-' ? ", so that faces in contact do not slide" : "");
  return law.type + " '" + law.name + "'" + (properties.empty() ? "" : " (" + properties + ")");
}

// A law without a name, which the input gives by a number: Coulomb friction, an interface, or no contact.
std::string words_of_law(const ContactLaw& law) {
  if (law.interface())
    return "LinearInterface" + (law.stiffness() > 0 ? format(" (stiffness %.4g)", law.stiffness()) : "");
  ContactState m;
  m.mass = m.dt = m.area = 1.0, m.velocity = Vec3(-1, 1e6, 0);
  const Vec3 impulse = law.response(m).impulse;
  if (impulse.isZero()) return "none, they pass through each other";
  return impulse[1] == 0 ? "without friction" : format("friction %.6g", -impulse[1] / impulse[0]);
}

template <int Dim>
class ContactTable {
 public:
  ContactTable(const Model& model, const System<Dim>& system) : model_(model), system_(system) {}

  std::vector<std::string> lines() {
    if (!model_.contact.active) {
      if (system_.bodies.size() + system_.rigids.size() > 1)
        lines_.emplace_back("contact: none, all bodies share one velocity field and stick where they touch");
      return std::move(lines_);
    }
    const LawsOfPairs laws = pairs();
    add_lines(laws);
    add_shared_fields();
    if (!laws.empty()) lines_.push_back("contact impulses: " + system_.contact_reason);
    return std::move(lines_);
  }

 private:
  using LawsOfPairs = std::map<std::string, std::set<std::pair<int, int>>>;  // pairs of materials by their law

  std::string name(int material) const { return "'" + model_.materials[static_cast<std::size_t>(material)].name + "'"; }

  std::string law_of(int a, int b) const {
    const ContactSpec& c = model_.contact;
    const auto joint = c.joints.find({std::min(a, b), std::max(a, b)});
    std::string out;
    if (joint != c.joints.end())
      for (const auto& m : model_.materials)
        if (m.joint == joint->second.law) out = words_of_law(m) + " where they touch at the start, then ";
    const ContactLaw* law = c.law(a, b);
    for (const auto& m : model_.materials)
      if (m.contact.get() == law) return out + words_of_law(m);
    return out + words_of_law(*law);
  }

  // Contact does not change the motion of two rigid bodies that follow a prescribed motion.
  bool both_prescribed(const Body<Dim>& a, const Body<Dim>& b) const {
    const auto prescribed = [&](const Body<Dim>& body) {
      return body.block < 0 && model_.materials[static_cast<std::size_t>(body.material)].law->rigid();
    };
    return prescribed(a) && prescribed(b);
  }

  // The pairs of materials whose velocity fields differ and that contact can move.
  LawsOfPairs pairs() const {
    std::vector<const Body<Dim>*> bodies;
    for (const auto* list : {&system_.bodies, &system_.rigids})
      for (const auto& body : *list)
        if (body.field != Body<Dim>::no_field) bodies.push_back(&body);
    LawsOfPairs laws;
    std::set<std::pair<int, int>> known;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        const int a = bodies[i]->material, b = bodies[j]->material;
        const bool blocks = bodies[i]->block >= 0 && bodies[j]->block >= 0;  // their joint laws are no contact laws
        if (!blocks && !both_prescribed(*bodies[i], *bodies[j]) && bodies[i]->field != bodies[j]->field &&
            known.insert({a, b}).second)
          laws[law_of(a, b)].insert({a, b});
      }
    return laws;
  }

  // One line for each law; the pairs with the commonest one are not listed if there are several.
  void add_lines(const LawsOfPairs& laws) {
    const auto most = std::max_element(laws.begin(), laws.end(),
                                       [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    for (auto law = laws.begin(); law != laws.end(); ++law)
      if (law != most || law->second.size() == 1)
        lines_.push_back("contact of " + words_of_pairs(law->second) + ": " + law->first);
    if (most == laws.end() || most->second.size() == 1) return;
    const std::string count = " (" + std::to_string(most->second.size()) + "): ";
    lines_.push_back((laws.size() == 1 ? "contact of all pairs" : "contact of all other pairs") + count + most->first);
  }

  void add_shared_fields() {
    for (const Body<Dim>& body : system_.bodies)
      if (const int with = model_.materials[static_cast<std::size_t>(body.material)].share_field_with; with >= 0)
        lines_.push_back("no contact of " + name(body.material) + " and " + name(with) +
                         ": they share one velocity field and stick where they touch");
  }

  // "'a' and 'b'", "'a' with 'b', 'c'; 'b' with 'c'"
  std::string words_of_pairs(const std::set<std::pair<int, int>>& pairs) const {
    if (pairs.size() == 1) {
      const auto [a, b] = *pairs.begin();
      return a == b ? "the bodies of " + name(a) + " with each other" : name(a) + " and " + name(b);
    }
    std::map<int, std::size_t> uses;
    for (const auto& [a, b] : pairs) ++uses[a], ++uses[b];
    std::map<int, std::vector<std::string>> partners;  // by the body of each pair that has more of them
    for (const auto& [a, b] : pairs) {
      const bool second = uses[b] > uses[a];
      partners[second ? b : a].push_back(a == b ? "each other" : name(second ? a : b));
    }
    std::string out;
    for (const auto& [body, others] : partners)
      out += (out.empty() ? "" : "; ") + name(body) + " with " + join(others, ", ");
    return out;
  }

  const Model& model_;
  const System<Dim>& system_;
  std::vector<std::string> lines_;
};

}  // namespace

template <int Dim>
std::vector<std::string> contact_table(const Model& model, const System<Dim>& system) {
  return ContactTable<Dim>(model, system).lines();
}

template std::vector<std::string> contact_table(const Model&, const System<2>&);
template std::vector<std::string> contact_table(const Model&, const System<3>&);

}  // namespace tribo
