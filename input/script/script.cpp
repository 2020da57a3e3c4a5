// SPDX-License-Identifier: MIT
#include "input/script/script.hpp"

#include "base/error.hpp"
#include "base/schema.hpp"
#include "input/script/interpreter.hpp"
#include "input/script/translator.hpp"

#include <algorithm>
#include <iterator>

namespace tribo {

bool is_script(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] != '<';
}

namespace {

// Runs a script; the translator stores the elements that its commands produce.
std::string interpret(std::string_view text, const Origin& begin, Settings& settings, script::Translator& translator) {
  const script::Program program = script::parse(text, begin);
  script::Interpreter interpreter(program, [&](const script::Command& c) { translator.take(c); });
  for (const std::string& name : script::assigned_variables(program))
    if (const std::string* value = settings.find(name)) {
      const auto number = to_number(*value);
      interpreter.fix(name, number ? script::Value(*number) : script::Value(*value));
    }
  try {
    interpreter.run();
  } catch (const InputError& error) {
    if (!interpreter.ran_to_end()) throw;
    Problems problems = translator.misnamed();
    problems.add(error);
    problems.raise();
  }
  return interpreter.output();
}

}  // namespace

Script read_script(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const Origin begin{file_name, 1, 1};
  script::Translator translator(begin);
  std::string output = interpret(text, begin, settings, translator);
  return {translator.finish(), std::move(output), translator.warnings()};
}

std::string run_commands(Statement& root, Settings& settings) {
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
    output += interpret(commands.text, commands.text_origin, settings, translator);
    for (Statement& section : translator.finish_sections()) {
      const auto same = std::find_if(root.children.begin(), root.children.end(), [&](const Statement& s) {
        return s.name == section.name && s.name != "Material";
      });
      if (same == root.children.end())
        root.children.push_back(std::move(section));
      else
        std::move(section.children.begin(), section.children.end(), std::back_inserter(same->children));
    }
  }
}

}  // namespace tribo
