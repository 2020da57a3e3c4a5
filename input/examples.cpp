// SPDX-License-Identifier: MIT
#include "input/examples.hpp"

#include "base/schema.hpp"
#include "base/text.hpp"
#include "input/xml.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace tribo {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

// The words of a mark of a passage, `example` and names or `end`; none if the line is no mark.
std::vector<std::string> mark(const std::string& line) {
  std::vector<std::string> words = words_of(line);
  if (words.size() < 2 || (words.front() != "!" && words.front() != "<!--")) return {};
  words.erase(words.begin());
  if (words.back() == "-->") words.pop_back();
  if (words.empty()) return {};
  const bool marks = words.front() == "example" || (words.front() == "end" && words.size() == 1);
  return marks ? words : std::vector<std::string>{};
}

struct Open {
  std::vector<std::string> keys;
  std::string text;
};

}  // namespace

const std::vector<ExampleFile>& example_files() {
  // A line {name, text} for each file, written by CMake.
  static const std::vector<ExampleFile> files{
#include "input/manual_examples.inc"
  };
  return files;
}

std::string without_indentation(std::string_view text) {
  std::vector<std::string> lines = lines_of(text);
  while (!lines.empty() && words_of(lines.back()).empty()) lines.pop_back();
  while (!lines.empty() && words_of(lines.front()).empty()) lines.erase(lines.begin());
  std::size_t common = std::string::npos;
  for (const auto& line : lines) common = std::min(common, line.find_first_not_of(' '));
  std::string out;
  for (const auto& line : lines) out += (line.size() > common ? line.substr(common) : std::string()) + "\n";
  return out;
}

std::vector<Example> passages(const ExampleFile& file) {
  std::vector<Example> out;
  std::vector<Open> open;
  const auto wrong = [&](const std::string& what) { return std::logic_error(std::string(file.name) + ": " + what); };
  for (const auto& line : lines_of(file.text)) {
    const auto words = mark(line);
    if (words.empty()) {
      for (auto& o : open) o.text += line + "\n";
    } else if (words.front() == "example") {
      open.push_back({{words.begin() + 1, words.end()}, ""});
    } else {
      if (open.empty()) throw wrong("an end without example");
      for (const auto& key : open.back().keys)
        out.push_back({key, without_indentation(open.back().text), !file.name.ends_with(".xml"), file.name});
      open.pop_back();
    }
  }
  if (!open.empty()) throw wrong("the example of " + open.back().keys.front() + " has no end");
  return out;
}

const std::vector<Example>& examples() {
  static const std::vector<Example> all = [] {
    std::vector<Example> out;
    for (const auto& file : example_files())
      for (auto& e : passages(file)) out.push_back(std::move(e));
    return out;
  }();
  return all;
}

std::string example_of(std::string_view key, bool script) {
  for (const auto& e : examples())
    if (e.key == key && e.script == script) return e.text;
  return {};
}

std::string material_in_script(std::string_view xml) {
  const Statement s = read_xml(xml, nullptr);
  const auto name = s.attribute("Name"), type = s.attribute("Type");
  if (!name || !type) return {};
  // The number of a material is the number of its command; the name stands for both.
  std::string out = "Material \"" + name->text + "\",\"" + name->text + "\",\"" + type->text + "\"\n";
  for (const auto& p : s.children) {
    const bool plain =
        to_number(p.text) || std::all_of(p.text.begin(), p.text.end(), [](unsigned char c) { return std::isalpha(c); });
    out += "  " + p.name + (p.text.empty() ? "" : " " + (plain ? p.text : "\"" + p.text + "\"")) + "\n";
  }
  return out + "Done\n";
}

}  // namespace tribo
