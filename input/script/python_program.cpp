// SPDX-License-Identifier: MIT
#include "input/script/python_program.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/script/python_text.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tribo::script {
namespace {

const CommandInfo& info_of(const std::string& word) {
  const auto& all = commands();
  return *std::find_if(all.begin(), all.end(), [&](const CommandInfo& c) { return lower(c.name) == word; });
}

// The command that ends a block, in lower case; empty for other commands.
std::string end_of(const CommandInfo& info) {
  const auto at = info.arguments.find("up to End");
  return at == std::string_view::npos ? "" : lower(info.arguments.substr(at + 6));
}

std::vector<std::string> values(const Command& c, std::size_t first = 0) {
  std::vector<std::string> out;
  for (std::size_t k = first; k < c.size(); ++k) out.push_back(python_value(c.text(k)));
  return out;
}

// The place of the first attribute of a command, after which there are only pairs of an attribute and its value.
std::size_t first_attribute(const Command& c, const std::string& word) {
  if (word == "region") return 4;
  if (word == "particletable") return 2;
  if (word == "globalarchive") return c.size() > 2 && !to_number(c.text(1)) ? 1 : c.size();
  return c.size();
}

// Values, and attributes as keyword arguments where their names may be such.
std::vector<std::string> arguments_of(const Command& c, std::size_t attributes) {
  std::set<std::string> names;
  for (std::size_t k = attributes; k + 1 < c.size(); k += 2)
    if (!is_python_name(c.text(k)) || !names.insert(c.text(k)).second) return values(c);
  std::vector<std::string> out;
  for (std::size_t k = 0; k < std::min(attributes, c.size()); ++k) out.push_back(python_value(c.text(k)));
  for (std::size_t k = attributes; k + 1 < c.size(); k += 2)
    out.push_back(c.text(k) + "=" + python_value(c.text(k + 1)));
  return out;
}

}  // namespace

void PythonProgram::add(const std::string& line) { program_.push_back(line); }

void PythonProgram::call(const std::string& begin, const std::vector<std::string>& arguments, const std::string& end) {
  add(python_call(begin, arguments, end, 4 * ends_.size()));
}

void PythonProgram::take(const Command& c) {
  const std::string word = lower(c.node.word);
  if (material_) return word == "done" ? end_of_material() : property(c, word);
  if (word != "polypt" || c.node.cuts > 0) end_of_polygon();
  if (!ends_.empty() && word == ends_.back()) {
    if (program_.back().ends_with(":")) add(std::string(4 * ends_.size(), ' ') + "pass");
    if (region_)
      end_of_region();
    else
      ends_.pop_back();
    return;
  }
  static const std::set<std::string> of_head{"title", "analysis", "consistentunits", "version"};
  if (of_head.contains(word)) return head(c, word);
  if (word == "header" || word == "xmldata") {
    if (region_) region_->shorter = false;
    return lines(c, word);
  }
  described_ |= word == "name" || word == "comment", gravity_ |= word == "gravity";
  if (word == "material") {
    material_.emplace().head = values(c);
    return;
  }
  if (word == "region") return begin_region(c);
  if (word == "polypt" && c.node.cuts == 0) return corner(c);
  if (region_) shape(c, word);
  any(c, info_of(word));
}

// A command by the method of its name.
void PythonProgram::any(const Command& c, const CommandInfo& info) {
  const std::string word = lower(info.name);
  const bool of_blocks = !ends_.empty() && ends_.back() == "endblocks" && find_element_of_blocks(word);
  const std::size_t attributes = of_blocks || word == "blocks" ? 0 : first_attribute(c, word);
  std::vector<std::string> arguments = arguments_of(c, attributes);
  const std::string end = end_of(info);
  if (c.node.cuts > 0 || word == "name") {
    std::string name(info.name);
    for (int k = 0; k < c.node.cuts; ++k) name.insert(0, "Cut ");
    arguments.insert(arguments.begin(), "\"" + name + "\"");
    return call("m.command", arguments);
  }
  call((end.empty() ? "m." : "with m.") + python_method(info.name), arguments, end.empty() ? "" : ":");
  if (!end.empty()) ends_.push_back(end);
}

// What the constructor of a model takes, unless it comes too late for it.
void PythonProgram::head(const Command& c, const std::string& word) {
  if (word == "title" && !described_ && title_.empty() && !c.text(0).empty()) {
    title_ = python_value(c.text(0)), described_ = true;
  } else if (word == "analysis") {
    const std::string analysis = lower(c.text(0));
    static const std::map<std::string, std::string> numbers{
        {"10", "plane strain mpm"}, {"11", "plane stress mpm"}, {"12", "3d mpm"}, {"13", "axisymmetric mpm"}};
    const auto number = numbers.find(analysis);
    analysis_ = number == numbers.end() ? analysis : number->second;
    solid_ = analysis_.starts_with("3d");
    if (c.given(1)) call("m.element", {python_value(c.text(1))});
  } else if (word == "consistentunits" && c.size() == 3 && units_.empty() && !gravity_) {
    units_ = values(c);
  } else if (word == "version") {  // as it is written: 3.10 is not 3.1
    call("m.version", {"tribo.Expression(" + python_value("\"" + c.node.arguments[0].text + "\"") + ")"});
  } else {
    any(c, info_of(word));
  }
}

// Commands with lines of text.
void PythonProgram::lines(const Command& c, const std::string& word) {
  std::string text;
  for (const Piece& line : c.node.lines) text += line.text + "\n";
  if (word == "header") {
    described_ = true;
    if (!text.empty()) text.pop_back();
    const std::string margin(4 * ends_.size(), ' ');
    add(margin + "with m.header():");
    return add(margin + "    " +
               (text.find_first_not_of(" \n") == std::string::npos ? "pass" : "m.text(" + python_lines(text) + ")"));
  }
  std::vector<std::string> arguments{c.given(0) ? python_value(c.text(0)) : "None", python_lines("\n" + text)};
  if (c.given(1)) arguments.push_back(python_value(c.text(1)));
  add(std::string(4 * ends_.size(), ' ') + "m.xml_data(" + join(arguments) + ")");
}

void PythonProgram::property(const Command& c, const std::string& word) {
  PythonMaterial& m = *material_;
  std::vector<std::string> arguments = values(c);
  arguments.insert(arguments.begin(), "\"" + c.node.word + "\"");
  m.calls.push_back(python_call("m.command", arguments, "", 4 * ends_.size()));
  if (word == "contact" && c.size() == 2) {
    m.contacts.emplace_back(python_value(c.text(1)), python_value(c.text(0)));
    return;
  }
  // the law of a pair has arguments of its own; other values with commas are one text
  static const std::set<std::string> of_pairs{"contact", "friction", "imperfectinterface", "interface"};
  m.shorter &= m.contacts.empty() && c.size() > 0 && (c.size() == 1 || !of_pairs.contains(word));
  m.shorter &=
      std::none_of(m.properties.begin(), m.properties.end(), [&](const auto& p) { return p.first == c.node.word; });
  std::string text;
  for (std::size_t k = 0; k < c.size(); ++k) text += (k ? "," : "") + c.text(k);
  m.properties.emplace_back(c.node.word, python_value(text));
}

void PythonProgram::end_of_material() {
  const PythonMaterial m = std::move(*material_);
  material_.reset();
  if (!m.shorter) {
    std::vector<std::string> head = m.head;
    head.insert(head.begin(), "\"Material\"");
    call("m.command", head);
    for (const std::string& line : m.calls) add(line);
    return call("m.command", {"\"Done\""});
  }
  std::vector<std::string> arguments{m.head[0]};
  if (m.head.size() > 2) arguments.push_back(m.head[2]);
  if (m.head.size() > 2 && m.head[1] != m.head[0]) arguments.push_back("called=" + m.head[1]);
  static const std::set<std::string> taken{"name", "type", "called", "contact", "properties"};
  const bool named = std::all_of(m.properties.begin(), m.properties.end(),
                                 [&](const auto& p) { return is_python_name(p.first) && !taken.contains(p.first); });
  for (std::size_t k = 0; k < m.properties.size(); ++k) {
    const auto& [name, value] = m.properties[k];
    const std::string begin = k == 0 ? "properties={" : "", end = k + 1 == m.properties.size() ? "}" : "";
    arguments.push_back(named ? name + "=" + value : begin + "\"" + name + "\": " + value + end);
  }
  for (std::size_t k = 0; k < m.contacts.size(); ++k)
    arguments.push_back((k == 0 ? "contact={" : "") + m.contacts[k].first + ": " + m.contacts[k].second +
                        (k + 1 == m.contacts.size() ? "}" : ""));
  call("m.material", arguments);
}

// A region is written with all of its commands, and at its end in the shorter form if it has only shapes.
void PythonProgram::begin_region(const Command& c) {
  PythonRegion region;
  region.line = program_.size();
  region.shorter = c.given(1) && c.given(2) && (c.size() < 4 || c.given(3));
  const std::vector<std::string> given = arguments_of(c, 4);
  region.arguments = {given[0]};
  if (region.shorter) {
    const bool moves = to_number(c.text(1)) != 0.0 || to_number(c.text(2)) != 0.0 || (solid_ && c.size() > 3);
    const std::string depth = solid_ && c.size() > 3 ? ", " + given[3] : "";
    if (moves) region.arguments.push_back("velocity=(" + given[1] + ", " + given[2] + depth + ")");
    if (!solid_ && c.size() > 3) region.arguments.push_back("thickness=" + given[3]);
    for (std::size_t k = 4; k < given.size(); ++k) {
      region.shorter &= given.size() < c.size();  // attributes as keyword arguments
      region.arguments.push_back(given[k]);
    }
  }
  any(c, info_of("region"));
  region_ = std::move(region);
}

// The corners of a polygon are one call.
void PythonProgram::corner(const Command& c) {
  if (c.size() == 0) {
    end_of_polygon();
    return call("m.poly_pt", {});
  }
  corners_.push_back("(" + join(values(c)) + ")");
}

void PythonProgram::end_of_polygon() {
  if (corners_.empty()) return;
  call("m.points", corners_);
  if (region_) {
    const std::string text = join(corners_);
    region_->shapes.push_back("tribo.polygon(" + text + ")");
    region_->shorter &= text.size() < 90;  // a longer one is easier to read in several lines
  }
  corners_.clear();
}

void PythonProgram::shape(const Command& c, const std::string& word) {
  PythonRegion& region = *region_;
  static const std::map<std::string, std::string> of_six{
      {"rect", "box"}, {"oval", "sphere"}, {"box", "box"}, {"sphere", "sphere"}};
  std::string name = word;
  if (const auto found = of_six.find(word); found != of_six.end() && c.size() == 6) name = found->second;
  const bool known = of_six.contains(word) || (word == "cylinder" && c.size() == 7);
  region.shorter &= known && c.node.cuts <= 1 && (c.node.cuts == 0 || !region.shapes.empty());
  if (!region.shorter) return;
  const std::string made = "tribo." + name + "(" + join(values(c)) + ")";
  if (c.node.cuts == 0)
    region.shapes.push_back(made);
  else
    region.shapes.back() += " - " + made;
}

void PythonProgram::end_of_region() {
  const PythonRegion region = std::move(*region_);
  region_.reset(), ends_.pop_back();
  if (!region.shorter || region.shapes.empty()) return;
  program_.resize(region.line);
  std::vector<std::string> arguments = region.arguments;
  arguments.insert(arguments.begin() + 1, region.shapes.begin(), region.shapes.end());
  call("m.body", arguments);
}

std::string PythonProgram::text(const std::string& source) const {
  const auto last = analysis_.find(" mpm");
  std::vector<std::string> arguments{"\"" + analysis_.substr(0, last) + "\""};
  if (!title_.empty()) arguments.push_back("title=" + title_);
  arguments.push_back(units_.empty() ? "units=None" : "units=(" + join(units_) + ")");
  arguments.push_back("name=" + python_value(name_));
  std::string out =
      "\"\"\"The model of " + source + ", built in Python.\n\nWritten by `tribo convert " + source + " -o " + name_ +
      ".py`: the commands in the order in which they run, with values\nin place of variables.\n\"\"\"\n\n" +
      "import tribo\n\n" + python_call("m = tribo.Model", arguments, "", 0) + "\n";
  for (const std::string& line : program_) out += line + "\n";
  return out + "\nif __name__ == \"__main__\":\n    m.run()\n";
}

}  // namespace tribo::script
