// SPDX-License-Identifier: MIT
/// The examples of the manual: every entry has one, the program reads all of them, and what it refuses to do without is
/// marked in the manual.

#include "base/text.hpp"
#include "input/examples.hpp"
#include "input/manual.hpp"
#include "input/read.hpp"
#include "input/xml.hpp"
#include "root.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <functional>

using namespace tribo;

namespace {

std::filesystem::path example_path(std::string_view name) {
  return test::source_root() / "input" / "manual_examples" / name;
}

// Whether a text contains a word that is not part of a longer one.
bool contains_word(const std::string& text, const std::string& word) {
  const auto part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !part(text[at - 1])) && (end == text.size() || !part(text[end]))) return true;
  }
  return false;
}

std::string problems_in(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A complete file with a material, contact law or joint law, which is given as an element or as commands, and in use.
std::string file_with_law(const std::string& kind, const std::string& name, const std::string& law) {
  const bool of_contact = kind == "contact law", of_joints = kind == "joint law";
  return "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/>"
         "</Header><MPMHeader><GIMP/><MaxTime>1</MaxTime><ArchiveTime>0.5</ArchiveTime><MultiMaterialMode>" +
         (of_contact ? "<Friction lawname='" + name + "'/>" : std::string()) +
         "</MultiMaterialMode></MPMHeader><Mesh><Grid xmin='0' xmax='4' ymin='0' ymax='4'><Horiz nx='8'/><Vert ny='8'/>"
         "</Grid></Mesh><MaterialPoints><Body matname='" +
         (kind == "material" ? name : "base_liquid") +
         "'><Rect xmin='1' xmax='3' ymin='1' ymax='2'/></Body><Body matname='base_solid'><Rect xmin='1' xmax='3' "
         "ymin='2' ymax='3'/></Body></MaterialPoints>"
         "<Material Type='TaitLiquid' "
         "Name='base_liquid'><rho>1000</rho><K>2e7</K><viscosity>1e-3</viscosity></Material>"
         "<Material Type='LinearElastic' Name='base_solid'><rho>2000</rho><E>1e8</E><nu>0.2</nu></Material>" +
         (of_joints ? "<CrackList lawname='" + name +
                          "'><pt x='1.3' y='2.6' tip='-1'/><pt x='2.6' y='2.6' tip='-1'/></CrackList>"
                    : std::string()) +
         law + "</JANFEAInput>";
}

std::string problems_of_law(const std::string& kind, const std::string& name, const std::string& law) {
  return problems_in([&] { read_model_text(file_with_law(kind, name, law), "example"); });
}

bool is_law(const ManualEntry& e) { return e.kind == "material" || e.kind == "contact law" || e.kind == "joint law"; }

// All attributes of a tree in turn are left out, or with `texts` all texts; calls check(statement, name of the
// attribute).
void leave_out_each(Statement& s, const std::function<void(const Statement&, const std::string&)>& check) {
  for (std::size_t k = 0; k < s.attributes.size(); ++k) {
    const Attribute left = s.attributes[k];
    s.attributes.erase(s.attributes.begin() + static_cast<std::ptrdiff_t>(k));
    check(s, left.name);
    s.attributes.insert(s.attributes.begin() + static_cast<std::ptrdiff_t>(k), left);
  }
  if (!s.text.empty()) {
    const std::string left = std::exchange(s.text, "");
    check(s, "text");
    s.text = left;
  }
  for (auto& c : s.children) leave_out_each(c, check);
}

// The problems at the place of a statement itself; others follow from references to it.
std::string problems_at(const Statement& root, const Statement& s) {
  try {
    root.child("Drive") ? void() : void(build_model(root, example_path("")));
  } catch (const InputError& error) {
    for (const auto& p : error.problems())
      if (p.origin.line == s.origin.line && p.origin.column == s.origin.column) return p.message;
  }
  return "";
}

// The row of an element in the manual.
std::string row_of(const std::string& element, const std::string& attribute) {
  std::string all;
  for (const auto& e : manual())
    if (e.kind == "element" && e.name == "<" + element + ">")
      for (const auto& r : e.rows)
        if (r.name == attribute) all += r.meaning + "\n";
  return all;
}

}  // namespace

TEST_CASE("every entry of the manual has an example that contains its name", "[input][manual]") {
  for (const auto& e : manual()) {
    INFO(e.kind << " " << e.name << ": add an example to a file of input/manual_examples, or to the file of the law");
    CHECK_FALSE(e.example.empty());
    const bool element = e.kind == "element";
    const std::string name = element ? e.name.substr(1, e.name.size() - 2) : e.name;
    CHECK(contains_word(e.example, element ? "<" + name : name));
    if (is_law(e)) CHECK(contains_word(e.script, name));
    CHECK(std::count(e.example.begin(), e.example.end(), '\n') <= 60);
  }
}

TEST_CASE("every example of the manual belongs to an entry", "[input][manual]") {
  for (const auto& example : examples()) {
    INFO(example.file << ": " << example.key);
    CHECK(std::any_of(manual().begin(), manual().end(), [&](const ManualEntry& e) {
      const std::string name = e.name.front() == '<' ? e.name.substr(1, e.name.size() - 2) : e.name;
      return example.script == (e.kind == "command") && e.example == example.text &&
             (example.key == name || example.key.ends_with("/" + name));
    }));
  }
}

TEST_CASE("passages of examples are cut between their marks", "[input][manual]") {
  const auto cut = passages({"a.xml",
                             "<!-- example A B -->\n  <A>\n    <!-- example C -->\n    <C/>\n    <!-- end -->\n"
                             "    <!-- a comment -->\n  </A>\n<!-- end -->\n"});
  REQUIRE(cut.size() == 3);
  CHECK(cut[0].key == "C");
  CHECK(cut[0].text == "<C/>\n");
  CHECK(cut[2].key == "B");
  CHECK(cut[2].text == "<A>\n  <C/>\n  <!-- a comment -->\n</A>\n");
  CHECK_FALSE(cut[2].script);
  CHECK_THROWS(passages({"a.fmcmd", "! example Rect\nRect 0,1,0,1\n"}));
  CHECK_THROWS(passages({"a.fmcmd", "! end\n"}));
}

TEST_CASE("the files with the examples of the manual are valid", "[input][manual]") {
  REQUIRE(example_files().size() > 10);
  for (const auto& file : example_files()) {
    const auto path = example_path(file.name);
    const bool drives = file.text.find("<Drive") != std::string_view::npos;
    CHECK(problems_in([&] { drives ? void(read_drive(path)) : void(read_model(path)); }) == "");
  }
}

TEST_CASE("the examples of laws are valid, as elements and in scripts", "[input][manual]") {
  for (const auto& e : manual()) {
    if (!is_law(e) || e.example.empty()) continue;
    const std::string name = read_xml(e.example, nullptr).attribute("Name")->text;
    INFO(e.name);
    CHECK(problems_of_law(e.kind, name, e.example) == "");
    CHECK(problems_of_law(e.kind, name, "<Commands><![CDATA[\n" + e.script + "]]></Commands>") == "");
  }
}

TEST_CASE("the manual marks the properties that laws need", "[input][manual]") {
  for (const auto& e : manual()) {
    if (!is_law(e) || e.example.empty()) continue;
    const Statement law = read_xml(e.example, nullptr);
    const std::string name = law.attribute("Name")->text;
    for (const auto& row : e.rows) {
      const std::string property = row.name.substr(1, row.name.size() - 2);
      const auto given = std::count_if(law.children.begin(), law.children.end(),
                                       [&](const Statement& c) { return c.name == property; });
      const bool required = row.meaning.ends_with("required");
      INFO(e.name << " without <" << property << ">");
      if (required) CHECK(given > 0);
      if (given != 1) continue;
      const std::size_t from = e.example.find("<" + property + ">"), to = e.example.find('\n', from);
      const std::string without = e.example.substr(0, from) + e.example.substr(to);
      const bool refused = !problems_of_law(e.kind, name, without).empty();
      if (required) CHECK(refused);
      if (refused) CHECK((required || contains_word(e.needs, property)));
    }
  }
}

TEST_CASE("the manual marks the attributes that elements need", "[input][manual]") {
  for (const auto& file : example_files()) {
    if (!file.name.ends_with(".xml")) continue;
    Statement root = read_statements(example_path(file.name));
    leave_out_each(root, [&](const Statement& s, const std::string& attribute) {
      const std::string row = row_of(s.name, attribute);
      const std::string problem = problems_at(root, s);
      INFO(file.name << ":" << s.origin.line << ": <" << s.name << "> without " << attribute << ": " << problem);
      // A coordinate that is left out may put the body beyond the grid; that does not make it a required one.
      const bool elsewhere = problem.starts_with("the edge of the grid");
      // Which parameters of a task need a value is known by the task.
      const bool of_task = s.name == "Parameter" && attribute == "text";
      if (!problem.empty() && !elsewhere && !of_task && !row.empty()) CHECK(row.find("required") != std::string::npos);
    });
  }
}

TEST_CASE("the manual names the parameters that tasks need", "[input][manual]") {
  for (const auto& e : manual()) {
    if (e.kind != "custom task") continue;
    Statement root = read_statements(example_path("tasks.xml"));
    for (auto& section : root.children)
      for (auto& schedule : section.children) {
        const Attribute* name = schedule.attribute("name");
        if (section.name != "CustomTasks" || !name || name->text != e.name) continue;
        const Statement whole = schedule;
        for (std::size_t k = 0; k < whole.children.size(); ++k) {
          schedule.children.erase(schedule.children.begin() + static_cast<std::ptrdiff_t>(k));
          const std::string parameter = words_of(whole.children[k].attribute("name")->text).front();
          const std::string problem = problems_in([&] { build_model(root, example_path("")); });
          INFO(e.name << " without " << parameter << ": " << problem);
          if (!problem.empty()) CHECK(contains_word(e.needs, parameter));
          schedule = whole;
        }
      }
  }
}

TEST_CASE("the examples of histories and fields are valid", "[input][manual]") {
  std::string histories, of_blocks, fields;
  for (const auto& e : manual()) {
    if (e.kind == "history") histories += e.example;
    if (e.kind == "history of blocks") of_blocks += e.example;
    if (e.kind == "field" || e.kind == "grid field") {
      // <Output> may be given once, so its words are collected
      const std::size_t from = e.example.find('\'') + 1;
      CHECK(e.example.substr(from, e.example.rfind('\'') - from) == e.name);
      if (e.kind == "field") fields += e.name + " ";
    }
  }
  const std::string start =
      "<JANFEAInput version='3'><Header><Analysis>12</Analysis><ConsistentUnits length='m' mass='kg' "
      "time='s'/></Header>"
      "<MPMHeader><MaxTime>1</MaxTime><ArchiveTime>0.5</ArchiveTime>";
  CHECK(
      problems_in([&] {
        read_model_text(
            start + histories + "<Output fields='" + fields +
                "' grid='mass velocity'/><GIMP/><MultiMaterialMode/></MPMHeader><Mesh><Grid xmin='0' xmax='4' ymin='0' "
                "ymax='4' zmin='0' zmax='4'><Horiz nx='8'/><Vert ny='8'/><Depth nz='8'/></Grid></Mesh>"
                "<MaterialPoints><Body matname='rock'><Box xmin='1' xmax='3' ymin='1' ymax='2' zmin='1' zmax='3'/>"
                "</Body><Body matname='tool'><Box xmin='1' xmax='3' ymin='2' ymax='3' zmin='1' zmax='3'/></Body>"
                "</MaterialPoints><Material Type='MohrCoulomb' Name='rock'><rho>2000</rho><E>1e8</E><nu>0.2</nu>"
                "<cohesion>1e5</cohesion><friction>30</friction></Material><Material Type='RigidContact' Name='tool'/>"
                "<GridBCs><BCShape><Box xmin='1' xmax='3' ymin='0.9' ymax='1.1' zmin='1' zmax='3'/><DisBC dir='2' "
                "vel='0' id='-1'/></BCShape></GridBCs></JANFEAInput>",
            "histories");
      }) == "");
  CHECK(
      problems_in([&] {
        read_model_text(
            start + of_blocks +
                "</MPMHeader><Blocks lawname='rub'><BoxBlock name='rock' xmin='0' xmax='1' ymin='0' ymax='1' zmin='0' "
                "zmax='1' rho='2600'/><Platen name='top' vy='-0.01' E='1e9'><Box xmin='0' xmax='1' ymin='0.9' "
                "ymax='1.1' zmin='0' zmax='1'/></Platen></Blocks><Material Type='SpringNetwork' Name='rub'><kn>1e9</kn>"
                "<ks>5e8</ks><fric>0.5</fric></Material></JANFEAInput>",
            "blocks");
      }) == "");
}
