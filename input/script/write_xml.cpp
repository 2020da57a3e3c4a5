// SPDX-License-Identifier: MIT
#include "input/script/write_xml.hpp"

#include "base/text.hpp"

namespace tribo {
namespace {

void write(const Statement& s, int depth, int& line, std::string& out) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  if (depth > 1 && s.origin.line > 0 && s.origin.line != line) {
    line = s.origin.line;
    if (depth == 2 || s.name == "Material") out += indent + "<!-- line " + std::to_string(line) + " -->\n";
  }
  out += indent + "<" + s.name;
  for (const auto& a : s.attributes) out += " " + a.name + "='" + escaped(a.text, '\'') + "'";
  if (s.text.empty() && s.children.empty()) {
    out += "/>\n";
    return;
  }
  out += ">" + escaped(s.text, '\0');
  if (!s.children.empty()) {
    out += "\n";
    for (const auto& child : s.children) write(child, depth + 1, line, out);
    out += indent;
  }
  out += "</" + s.name + ">\n";
}

}  // namespace

std::string xml_text(const Statement& root) {
  std::string out = "<?xml version='1.0'?>\n";
  if (root.origin.file) out += "<!-- from " + *root.origin.file + " -->\n";
  int line = 0;
  write(root, 0, line, out);
  return out;
}

}  // namespace tribo
