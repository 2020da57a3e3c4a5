// SPDX-License-Identifier: MIT
/// The manual as text, list and Markdown.

#include "base/error.hpp"
#include "base/text.hpp"
#include "input/manual.hpp"

#include <algorithm>
#include <set>
#include <sstream>

namespace tribo {
namespace {

std::string plain(const std::string& name) {
  return lower(name.front() == '<' ? name.substr(1, name.size() - 2) : name);
}

const char* title(const std::string& kind) {
  if (kind == "element") return "Elements of XML command files";
  if (kind == "material") return "Materials";
  if (kind == "contact law") return "Contact laws";
  if (kind == "joint law") return "Joint laws";
  if (kind == "custom task") return "Custom tasks";
  if (kind == "command") return "Scripted commands";
  if (kind == "history") return "Quantities of history.csv";
  if (kind == "history of blocks") return "Quantities of history.csv in models of blocks";
  if (kind == "grid field") return "Fields of the grid files";
  return "Fields of the particle files";
}

// Text in a cell of a Markdown table
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c == '|')
      out += "\\|";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  return out;
}

std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += "      " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return out;
}

// Before the properties that are needed together: laws also have properties that are required alone.
const char* needs(const ManualEntry& entry) { return entry.kind == "custom task" ? "Required" : "Also required"; }

// A block of code in Markdown
std::string fenced(const std::string& language, const std::string& text) {
  return text.empty() ? "" : "\n```" + language + "\n" + text + "```\n";
}

std::string bare(const std::string& name) { return name.front() == '<' ? name.substr(1, name.size() - 2) : name; }

// Attributes of elements and properties of laws with this name.
std::string rows_named(const std::string& wanted) {
  std::string out;
  for (const auto& e : manual())
    for (const auto& r : e.rows) {
      if (plain(r.name) != wanted || r.name == "text") continue;  // the text of an element is no attribute
      out += (r.name.front() == '<' ? "property " : "attribute ") + r.name + " of " + e.kind + " " + e.name + "\n";
      if (!r.kind.empty() || !r.meaning.empty())
        out += "    " + r.kind + (r.kind.empty() || r.meaning.empty() ? "" : "; ") + r.meaning + "\n";
    }
  return out;
}

// Whether a text has each of these words, in any order.
bool mentions(const std::string& text, const std::string& words) {
  const std::string all = lower(text);
  std::istringstream list(words);
  for (std::string word; list >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}

// One line for each entry, and for each of its rows, that mentions these words.
std::string entries_about(const std::string& words) {
  std::string out;
  for (const auto& e : manual()) {
    if (mentions(e.name + " " + e.usage + " " + e.meaning, words))
      out += "  " + e.kind + " " + e.name + ": " + (e.meaning.empty() ? e.usage : e.meaning) + "\n";
    for (const auto& r : e.rows)
      if (mentions(r.name + " " + r.meaning, words))
        out += "  " + e.kind + " " + e.name + ", " + r.name + ": " + (r.meaning.empty() ? r.kind : r.meaning) + "\n";
  }
  return out.empty() ? ""
                     : "nothing has the name '" + words + "'; these mention it ('tribo doc NAME' tells more):\n" + out;
}

}  // namespace

std::string manual_text(std::string_view name) {
  std::string out;
  std::vector<std::string> known;
  const std::string wanted = name.empty() ? "" : plain(std::string(name));
  for (const auto& e : manual()) {
    known.push_back(bare(e.name));
    for (const auto& r : e.rows) known.push_back(bare(r.name));
    if (!wanted.empty() && plain(e.name) != wanted) continue;
    out += e.kind + " " + e.name + (e.usage.empty() ? "" : "  " + e.usage) + "\n";
    if (!e.meaning.empty()) out += "    " + e.meaning + "\n";
    std::size_t width = 0;
    for (const auto& r : e.rows) width = std::max(width, r.name.size());
    for (const auto& r : e.rows) {
      out += "      " + r.name;
      if (!r.kind.empty() || !r.meaning.empty()) out += std::string(width - r.name.size() + 2, ' ') + r.kind;
      if (!r.meaning.empty()) out += (r.kind.empty() ? "" : "; ") + r.meaning;
      out += "\n";
    }
    if (!e.needs.empty()) out += "    " + std::string(needs(e)) + ": " + e.needs + "\n";
    if (!e.example.empty()) out += "    example:\n" + indented(e.example);
    if (!e.script.empty()) out += "    in a script:\n" + indented(e.script);
  }
  if (out.empty() && !wanted.empty()) out = rows_named(wanted);
  if (out.empty() && wanted.size() > 2) out = entries_about(wanted);
  if (out.empty())
    throw UsageError(
        "there is no element, attribute, material, law, property, task, command, quantity or field named '" +
        std::string(name) + "'" + did_you_mean(std::string(name), known) + "; 'tribo list' names all");
  return out;
}

std::string manual_list() {
  std::string out, kind;
  for (const auto& e : manual()) {
    if (e.kind != kind) out += (out.empty() ? "" : "\n") + std::string(title(e.kind)) + "\n";
    kind = e.kind;
    out += "  " + e.name + std::string(e.name.size() < 24 ? 24 - e.name.size() : 1, ' ') + e.meaning + "\n";
  }
  return out;
}

std::string manual_markdown() {
  std::string out =
      "# All keywords\n\nGenerated by `tribo doc --markdown` from the tables that the program uses to read its input. "
      "`tribo doc NAME` prints one entry. Every entry has an example, which the tests read as part of a complete file; "
      "its numbers are in m, kg and s unless it shows other units. Where a table says *required*, the program refuses "
      "a file "
      "without it.\n";
  std::string kind;
  for (const auto& e : manual()) {
    const bool output = e.kind.starts_with("history") || e.kind.ends_with("field");
    if (e.kind != kind) {
      out += "\n## " + std::string(title(e.kind)) + "\n\n";
      if (output) out += "| name | unit | | example |\n|-|-|-|-|\n";
    }
    kind = e.kind;
    if (output) {
      const std::string example = e.example.substr(0, e.example.find('\n'));
      out += "| `" + e.name + "` | " + cell(e.usage) + " | " + cell(e.meaning) + " | `" + example + "` |\n";
      continue;
    }
    const std::string usage = e.usage.empty() ? "" : "*" + cell(e.usage) + "* – ";
    out += "\n### `" + e.name + "`\n\n" + usage + cell(e.meaning) + "\n";
    if (!e.rows.empty()) out += "\n| | | |\n|-|-|-|\n";
    for (const auto& r : e.rows) out += "| `" + r.name + "` | " + cell(r.kind) + " | " + cell(r.meaning) + " |\n";
    if (!e.needs.empty()) out += "\n" + std::string(needs(e)) + ": " + cell(e.needs) + ".\n";
    out += fenced(e.kind == "command" ? "text" : "xml", e.example);
    if (!e.script.empty()) out += "\nIn a script:\n" + fenced("text", e.script);
  }
  return out;
}

std::string manual_names() {
  std::set<std::string> names;
  for (const auto& e : manual()) names.insert(bare(e.name));
  std::string out;
  for (const auto& n : names) out += n + "\n";
  return out;
}

}  // namespace tribo
