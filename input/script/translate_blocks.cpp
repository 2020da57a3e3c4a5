// SPDX-License-Identifier: MIT
/// Rigid blocks. Their lines follow from the table of keywords: a line is an element inside <Blocks>.

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/script/commands.hpp"
#include "input/script/translator.hpp"

#include <algorithm>
#include <deque>
#include <iterator>

namespace tribo::script {
namespace {

bool is_inside(const ElementSpec& element, std::string_view parent) {
  return find_element(element.name, parent) == &element;
}

// Elements with shapes, or with points, to name what a line that is out of place belongs to.
std::string elements_with(const std::string& child) {
  std::vector<std::string> names;
  for (const ElementSpec& e : dialect())
    if (is_inside(e, "Blocks") && find_element(child, e.name)) names.emplace_back(e.name);
  return join(names, " or ");
}

std::string_view arguments_of(const ElementSpec& element) {
  if (find_element("Rect", element.name)) return "attribute, value, ...; the following shapes belong to it";
  if (find_element("pt", element.name)) return "attribute, value, ...; the following PolyPt belong to it";
  return "attribute, value, ...";
}

// The attribute for the reference to a material, contact law or joint law of the script that this attribute makes;
// empty if its value is something else. References are numbers, since names in the file would change the numbers of
// materials.
std::string reference_of(const ElementSpec& element, const std::string& attribute, const std::string& value) {
  if (attribute == "law" || attribute == "lawname") return "law";
  if (attribute == "touchname") return lower(value) == "none" ? "" : attribute;  // which can only be a name
  const bool material = attribute == "mat" || attribute == "matname";
  if (element.name != "GlobalArchive") return material ? "mat" : "";
  if (attribute == "with" || attribute == "withname") return "with";
  const bool condition = to_number(value).value_or(1) <= 0;  // the id of a condition
  return (material || attribute == "material") && !condition ? "material" : "";
}

}  // namespace

const std::vector<CommandInfo>& lines_of_blocks() {
  static std::deque<std::string> meanings;  // its texts stay in their place
  static const std::vector<CommandInfo> all = [] {
    std::vector<CommandInfo> out;
    for (const ElementSpec& e : dialect()) {
      if (!is_inside(e, "Blocks")) continue;
      meanings.push_back("a line in Blocks; " + std::string(e.meaning));
      out.push_back({e.name, 0, 99, arguments_of(e), meanings.back()});
    }
    return out;
  }();
  return all;
}

const ElementSpec* find_element_of_blocks(std::string_view name) {
  for (const CommandInfo& line : lines_of_blocks())
    if (lower(line.name) == lower(name)) return find_element(line.name, "Blocks");
  return nullptr;
}

// Pairs of an attribute of an element and its value.
void Translator::pairs(Statement& s, const ElementSpec& element, const Command& c, std::size_t first) {
  std::vector<std::string> known;
  for (const AttributeSpec& a : element.attributes)
    if (!s.attribute(a.name)) known.emplace_back(a.name);
  for (std::size_t k = first; k < c.size(); k += 2) {
    const std::string given = c.text(k);
    const auto name = std::find_if(known.begin(), known.end(), [&](const auto& a) { return lower(a) == lower(given); });
    if (name == known.end())
      throw InputError(c.origin(k), "'" + c.node.word + "' has no attribute '" + given + "'" +
                                        did_you_mean(given, known) + "; valid: " + join(known));
    if (!c.given(k + 1)) throw InputError(c.origin(k), "the value of '" + given + "' is missing");
    if (s.attribute(*name)) throw InputError(c.origin(k), "'" + given + "' is given twice");
    const std::string value = c.text(k + 1);
    const std::string reference = reference_of(element, *name, value);
    if (reference.empty())
      attribute(s, *name, value, c.origin(k + 1));
    else
      Document::refer(s, reference, value, c.origin(k + 1));
  }
}

void Translator::blocks(const Command& c) {
  if (blocks_ && !stage_) throw InputError(c.origin(), "'Blocks' is given twice; first at " + blocks_->text());
  open(Open::blocks, c);
  if (!stage_) blocks_ = c.origin();
  block_ = Statement{};
  block_.name = "Blocks", block_.origin = block_.text_origin = c.origin();
  pairs(block_, *find_element("Blocks", stage_ ? "Stage" : "JANFEAInput"), c, 0);
}

// The element is added first, so that after an error its shapes are not those of the line before.
void Translator::line_of_blocks(const Command& c, const ElementSpec& element) {
  const ElementSpec* spec = stage_ ? find_element(element.name, "Stage") : &element;
  if (!spec)
    throw InputError(c.origin(), "'" + c.node.word + "' cannot change in a stage; of 'Blocks' there can be Platen");
  Statement& s = block_.children.emplace_back();
  s.name = element.name, s.origin = s.text_origin = c.origin();
  path_ = {block_.children.size() - 1};  // its shapes follow
  pairs(s, *spec, c, 0);
}

// A shape or a point of a polygon belongs to the last line.
void Translator::must_follow_line(const Command& c, const std::string& child) const {
  if (stage_)
    throw InputError(c.origin(),
                     "'" + c.node.word + "': in a stage a platen keeps the faces that it has; there are no shapes");
  if (block_.children.empty() || !find_element(child, block_.children.back().name))
    throw InputError(c.origin(),
                     "'" + c.node.word + "' inside 'Blocks' belongs to a line before it: " + elements_with(child));
}

// In a stage the settings of the blocks and the lines stand beside each other.
void Translator::store_blocks() {
  Statement& section = document_.section("Blocks", opened_at_);
  const auto append = [](auto& from, auto& to) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  if (stage_) {
    std::vector<Statement> lines = std::move(block_.children);
    block_.children.clear();
    if (!block_.attributes.empty()) section.children.push_back(std::move(block_));
    append(lines, section.children);
    return;
  }
  section.origin = section.text_origin = block_.origin;
  append(block_.attributes, section.attributes), append(block_.children, section.children);
}

}  // namespace tribo::script
