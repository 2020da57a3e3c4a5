// SPDX-License-Identifier: MIT
#include "base/schema.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace tribo {

std::string Range::text() const {
  const bool lower = std::isfinite(low), upper = std::isfinite(high);
  std::ostringstream out;
  if (lower && upper)
    out << "in " << (low_open ? "(" : "[") << low << ", " << high << (high_open ? ")" : "]");
  else if (lower)
    out << (low_open ? "> " : ">= ") << low;
  else if (upper)
    out << (high_open ? "< " : "<= ") << high;
  else
    out << "any number";
  return out.str();
}

std::optional<double> to_number(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string not_a_property(const std::string& name, const std::vector<std::string>& valid) {
  return "<" + name + "> is not a property of this material" +
         (valid.empty() ? ", which has none" : did_you_mean(name, valid) + "; valid: " + join(valid));
}

namespace {

// The number in consistent units, which must not leave the range of numbers.
double converted(double number, const ParameterInfo& parameter, const Units& units, const Statement& child,
                 Problems& problems) {
  const double out = number * units.factor(parameter.dimension);
  // With room for squares and products: 1e300 has no meaning in any unit
  const bool large = !(std::abs(out) < 1e100), small = out != 0 && std::abs(out) < 1e-100;
  if (large || small || (out == 0 && number != 0))
    problems.add(child.text_origin, "<" + child.name + "> is " + child.text + ", which is too " +
                                        (large ? "large" : "small") + " to be computed with");
  return out;
}

}  // namespace

std::vector<std::optional<double>> read_parameters(const Statement& statement, const std::vector<ParameterInfo>& table,
                                                   const std::vector<std::string>& handled_elsewhere,
                                                   const Units& units, Problems& problems) {
  std::vector<std::optional<double>> values(table.size());
  std::vector<const Statement*> seen(table.size(), nullptr);

  for (const auto& child : statement.children) {
    if (std::find(handled_elsewhere.begin(), handled_elsewhere.end(), child.name) != handled_elsewhere.end()) continue;
    const auto entry = std::find_if(table.begin(), table.end(), [&](const ParameterInfo& p) {
      return p.name == child.name || (!p.alias.empty() && p.alias == child.name);
    });
    if (entry == table.end()) {
      std::vector<std::string> names;
      for (const auto& p : table) names.push_back(p.name);
      problems.add(child.origin, not_a_property(child.name, names));
      continue;
    }
    const auto k = static_cast<std::size_t>(entry - table.begin());
    if (seen[k]) {
      problems.add(child.origin, "<" + child.name + "> is given twice; first at " + seen[k]->origin.text());
      continue;
    }
    seen[k] = &child;
    const auto number = to_number(child.text);
    if (!number)
      problems.add(child.text_origin, "<" + child.name + "> needs one number, not '" + child.text + "'");
    else if (!entry->range.contains(*number))
      problems.add(child.text_origin, "<" + child.name + "> is " + child.text + " but must be " + entry->range.text());
    else
      values[k] = converted(*number, *entry, units, child, problems);
  }

  for (std::size_t k = 0; k < table.size(); ++k) {
    if (seen[k]) continue;
    if (table[k].fallback)
      values[k] = *table[k].fallback * units.factor(table[k].dimension);
    else if (!table[k].optional)
      problems.add(statement.origin, "<" + table[k].name + "> is missing (" + table[k].meaning + ")");
  }
  return values;
}

}  // namespace tribo
