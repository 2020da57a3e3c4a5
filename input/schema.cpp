// SPDX-License-Identifier: MIT
/// The table of keywords as an XML schema.

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/dialect.hpp"
#include "materials/material.hpp"

#include <map>
#include <set>
#include <sstream>

namespace tribo {
namespace {

/// Elements of the same name may differ by parent; the schema contains their union, since it has no local elements.
struct Union {
  std::map<std::string, const AttributeSpec*> attributes;
  std::set<std::string> children;
  std::string meaning;
};

std::map<std::string, Union> unions() {
  std::map<std::string, Union> all;
  std::set<std::string> shapes;
  for (const auto& e : dialect())
    if (e.shape) shapes.emplace(e.name);
  for (const auto& e : dialect()) {
    auto& u = all[std::string(e.name)];
    if (u.meaning.empty()) u.meaning = e.meaning;
    for (const auto& a : e.attributes) u.attributes.emplace(a.name, &a);
    for (const auto& parent : words_of(e.parents)) {
      if (parent == "@shape")
        for (const auto& s : shapes) all[s].children.emplace(e.name);
      else
        all[parent].children.emplace(e.name);
    }
  }
  auto& material = all["Material"];
  const auto add = [&](const auto& items) {
    for (const auto& item : items) {
      for (const auto& p : item.parameters) {
        material.children.insert(p.name);
        if (!p.alias.empty()) material.children.insert(p.alias);
      }
      for (const auto& p : item.own_properties)
        if (!p.meaning.empty()) material.children.emplace(p.name);
    }
  };
  add(materials().items());
  add(contact_laws().items());
  add(joint_laws().items());
  for (const auto name : {"alpha", "Cv", "Cp", "kCond", "color", "PDamping", "largeRotation", "SetDirection",
                          "SettingFunction", "SettingFunction2", "SettingFunction3", "mirrored", "rho"})
    material.children.emplace(name);
  return all;
}

}  // namespace

std::string schema() {
  const auto all = unions();
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n";
  const auto& material = all.at("Material").children;
  for (const auto& name : material)
    if (!all.count(name))
      out << "<xs:element name=\"" << name
          << "\"><xs:complexType mixed=\"true\"><xs:anyAttribute "
             "processContents=\"skip\"/></xs:complexType></xs:element>\n";
  for (const auto& [name, u] : all) {
    out << "<xs:element name=\"" << name << "\">";
    if (!u.meaning.empty())
      out << "<xs:annotation><xs:documentation>" << escaped(u.meaning) << "</xs:documentation></xs:annotation>";
    out << "<xs:complexType mixed=\"true\">";
    if (!u.children.empty()) {
      out << "<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">";
      for (const auto& child : u.children) out << "<xs:element ref=\"" << child << "\"/>";
      out << "</xs:choice>";
    }
    for (const auto& [attribute, spec] : u.attributes) {
      out << "<xs:attribute name=\"" << attribute << "\"";
      if (spec->type == ValueType::choice) {
        out << "><xs:simpleType><xs:restriction base=\"xs:string\">";
        for (const auto& word : words_of(spec->choices)) out << "<xs:enumeration value=\"" << escaped(word) << "\"/>";
        out << "</xs:restriction></xs:simpleType></xs:attribute>";
      } else if (spec->type == ValueType::version) {
        out << "><xs:simpleType><xs:restriction base=\"xs:string\"><xs:pattern "
               "value=\"(0|[1-9][0-9]*)(\\.(0|[1-9][0-9]*)){0,2}\"/></xs:restriction></xs:simpleType></xs:attribute>";
      } else {
        out << " type=\""
            << (spec->type == ValueType::number    ? "xs:double"
                : spec->type == ValueType::integer ? "xs:integer"
                                                   : "xs:string")
            << "\"/>";
      }
    }
    out << "</xs:complexType></xs:element>\n";
  }
  out << "</xs:schema>\n";
  return out.str();
}

}  // namespace tribo
