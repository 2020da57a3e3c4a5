// SPDX-License-Identifier: MIT
#include "input/script/script.hpp"

#include "base/error.hpp"
#include "base/schema.hpp"
#include "input/script/interpreter.hpp"
#include "input/script/python_program.hpp"
#include "input/script/translator.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

namespace tribo {

bool is_script(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] != '<';
}

namespace {

// The value of a variable that is set on the command line: a number, a formula of numbers such as 10/3, or a text.
script::Value given_value(const std::string& name, const std::string& text) {
  if (const auto number = to_number(text)) return *number;
  const bool is_formula = !name.ends_with('$') && text.find_first_of("0123456789") != std::string::npos &&
                          text.find_first_not_of("0123456789.eE+-*/^() ") == std::string::npos;
  if (!is_formula) return text;
  try {
    return script::evaluate_number({text, Origin{}}, {});
  } catch (const InputError&) {
    return text;
  }
}

// Runs a script; the translator stores the elements that its commands produce, `python` the commands themselves.
// Problems of commands are added to `problems`, unless the script does not run to its end.
std::string interpret(std::string_view text, const Origin& begin, Settings& settings, script::Translator& translator,
                      Problems& problems, script::PythonProgram* python = nullptr) {
  const script::Program program = script::parse(text, begin);
  script::Interpreter interpreter(program, [&](const script::Command& c) {
    translator.take(c);
    if (python) python->take(c);
  });
  interpreter.before_assignment = [&](const std::string& name, const script::Node& n) { translator.assigned(name, n); };
  for (const std::string& name : script::assigned_variables(program))
    if (const std::string* value = settings.find(name)) interpreter.fix(name, given_value(name, *value));
  try {
    interpreter.run();
  } catch (const InputError& error) {
    if (!interpreter.ran_to_end()) throw;
    problems.add(error);
  }
  if (interpreter.values_lost()) translator.lose_values();
  return interpreter.output();
}

// What is made of values that are not known would only give further problems.
void raise_in_words_of_scripts(const Problems& problems, const script::Translator& translator) {
  Problems told;
  for (const Problem& p : in_words_of_scripts(problems.list(), translator.xml_lines())) told.add(p.origin, p.message);
  told.raise();
}

}  // namespace

Script read_script(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const Origin begin{file_name, 1, 1};
  script::Translator translator(begin);
  Problems problems;
  std::string output = interpret(text, begin, settings, translator, problems);
  Statement root = translator.finish(problems);
  if (translator.values_lost()) raise_in_words_of_scripts(problems, translator);
  return {std::move(root), std::move(output), std::move(problems), translator.warnings(), translator.xml_lines()};
}

std::string script_as_python(std::string_view text, const std::string& file_name, Settings settings) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const Origin begin{std::make_shared<const std::string>(file_name), 1, 1};
  const std::filesystem::path file(file_name);
  script::Translator translator(begin);
  script::PythonProgram python(file.stem().string());
  Problems problems;
  interpret(text, begin, settings, translator, problems, &python);
  translator.finish(problems);
  problems.raise();
  return python.text(file.filename().string());
}

namespace {

// The command that produces an element; empty for elements of the same name.
std::string command_of(const std::string& element) {
  static const std::map<std::string, std::string> all{{"TimeFactor", "CFLFactor"},
                                                      {"TransTimeFactor", "CFLFactor"},
                                                      {"MaxTime", "MaximumTime"},
                                                      {"FirstArchiveTime", "ArchiveTime"},
                                                      {"MPMArchive", "ToArchive"},
                                                      {"MatlPtsPerElement", "PtsPerElement"},
                                                      {"GIMP", "MPMMethod"},
                                                      {"MultiMaterialMode", "MultimaterialMPM"},
                                                      {"Friction", "ContactMM"},
                                                      {"Grid", "GridRect"},
                                                      {"Horiz", "GridHoriz"},
                                                      {"Vert", "GridVert"},
                                                      {"Depth", "GridDepth"},
                                                      {"Body", "Region"},
                                                      {"BMP", "BMPRegion"},
                                                      {"pt", "PolyPt"},
                                                      {"Polygon", "PolyPt"},
                                                      {"Deform", "Transform"},
                                                      {"BCShape", "GridBC"},
                                                      {"BCLine", "GridBC"},
                                                      {"BCArc", "GridBC"},
                                                      {"LdShape", "ParticleBC"},
                                                      {"LdRect", "ParticleBC"},
                                                      {"ArchiveGroup", "ArchiveTime"},
                                                      {"ContactHeating", "Conduction"},
                                                      {"GridBodyXForce", "Gravity"},
                                                      {"GridBodyYForce", "Gravity"},
                                                      {"GridBodyZForce", "Gravity"},
                                                      {"DisBC", "Velocity"},
                                                      {"TempBC", "Temperature"},
                                                      {"LoadBC", "Load"},
                                                      {"TractionBC", "Traction"},
                                                      {"HeatFluxBC", "HeatFlux"},
                                                      {"CrackList", "NewCrack"},
                                                      {"Schedule", "CustomTask"},
                                                      {"BodyXForce", "Gravity"},
                                                      {"BodyYForce", "Gravity"},
                                                      {"BodyZForce", "Gravity"},
                                                      {"EnergyCoupling", "Conduction"}};
  const auto found = all.find(element);
  return found == all.end() ? element : found->second;
}

// The value of an attribute in the text of a tag; empty if it is not there.
std::string value_of(std::string_view attributes, const std::string& name) {
  const std::string begin = " " + name + "='";
  const auto at = attributes.find(begin);
  if (at == std::string_view::npos) return {};
  const auto from = at + begin.size();
  return std::string(attributes.substr(from, attributes.find('\'', from) - from));
}

// '<Name attributes/>' becomes 'Name'; sections of the file are the script.
std::string without_tags(const std::string& text) {
  static const std::set<std::string> sections{"JANFEAInput", "MPMHeader", "Header", "Mesh", "MaterialPoints"};
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
    while (end < text.size() && in_name(text[end])) ++end;
    const auto close = text.find('>', end);
    const bool tag = text[at] == '<' && end > at + 1 && close != std::string::npos &&
                     (text[end] == '>' || text[end] == ' ' || text[end] == '/') && close < end + 60;
    if (!tag) {
      out += text[at++];
      continue;
    }
    const std::string name = text.substr(at + 1, end - at - 1);
    const std::string_view attributes = std::string_view(text).substr(end, close - end);
    const bool of_pair = name == "Friction" && attributes.find("matname") != std::string_view::npos;
    const std::string type = value_of(attributes, "type"), order = value_of(attributes, "order");
    if (name == "Transfer" && !type.empty()) {
      out += "'Transfer " + type + (order.empty() ? "" : "," + order) + "'";
    } else {
      out += sections.count(name) ? "the script" : "'" + (of_pair ? "Contact" : command_of(name)) + "'";
      if (name == "GIMP" && !type.empty()) out += " with " + (type == "quadratic" ? "B2SPLINE" : type);
    }
    at = close + 1;
  }
  return out;
}

}  // namespace

std::string in_words_of_scripts(const std::string& text) { return without_tags(text); }

std::vector<Problem> in_words_of_scripts(std::vector<Problem> problems,
                                         const std::vector<std::array<int, 2>>& xml_lines) {
  for (Problem& p : problems) {
    const bool xml = std::any_of(xml_lines.begin(), xml_lines.end(), [&](const auto& lines) {
      return p.origin.line >= lines[0] && p.origin.line <= lines[1];
    });
    if (xml) continue;
    p.message = without_tags(p.message);
    const auto at = p.message.find("'GridBC'");  // the blocks of nodes and of particles have the same element
    if (at == 0 && p.message.find("particle") != std::string::npos) p.message.replace(at, 8, "'ParticleBC'");
  }
  return problems;
}

std::string run_commands(Statement& root, Settings& settings, Problems& problems) {
  std::string output;
  while (true) {
    const auto found = std::find_if(root.children.begin(), root.children.end(),
                                    [](const Statement& s) { return s.name == "Commands"; });
    if (found == root.children.end()) return output;
    const Statement commands = std::move(*found);
    root.children.erase(found);
    const Statement* header = root.child("Header");
    const Statement* analysis = header ? header->child("Analysis") : nullptr;
    std::vector<std::string> names;
    for (const auto& s : root.children)
      if (const Attribute* name = s.name == "Material" ? s.attribute("Name") : nullptr) names.push_back(name->text);
    script::Translator translator(commands.origin);
    translator.surround(analysis ? static_cast<int>(to_number(analysis->text).value_or(0)) : 0, names,
                        header && header->child("ConsistentUnits"));
    Problems of_commands;
    output += interpret(commands.text, commands.text_origin, settings, translator, of_commands);
    std::vector<Statement> sections = translator.finish_sections(of_commands);
    if (translator.values_lost()) raise_in_words_of_scripts(of_commands, translator);
    problems.add(of_commands);
    for (Statement& section : sections) {
      const auto same = std::find_if(root.children.begin(), root.children.end(), [&](const Statement& s) {
        return s.name == section.name && s.name != "Material" && s.name != "Stage" && s.name != "When";
      });
      if (same == root.children.end())
        root.children.push_back(std::move(section));
      else
        std::move(section.attributes.begin(), section.attributes.end(), std::back_inserter(same->attributes)),
            std::move(section.children.begin(), section.children.end(), std::back_inserter(same->children));
    }
  }
}

}  // namespace tribo
