// SPDX-License-Identifier: MIT
/// Parameter tables of laws. Reading, ranges, units, defaults and the manual use the same table.
#pragma once

#include "base/statement.hpp"
#include "base/units.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// Admissible values of a number.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
  std::string text() const;  ///< `> 0`, `in [0, 1)`
};

inline constexpr Range any_value{};
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::infinity(), false, false};
/// Open interval.
constexpr Range between(double low, double high) { return {low, high, true, true}; }
/// Closed interval.
constexpr Range within(double low, double high) { return {low, high, false, false}; }

/// Description of a parameter for the reader, the XSD and the manual.
struct ParameterInfo {
  std::string name;
  std::string alias;  ///< a second accepted spelling, or empty
  Dimension dimension = Dimension::none;
  Range range;
  std::optional<double> fallback;  ///< default value; absent: the parameter is required (unless `optional`)
  bool optional = false;           ///< not required; if absent, the member keeps its initial value
  std::string meaning;
};

/// One line of a law's parameter table.
template <class Law>
struct Parameter {
  std::string_view name;             ///< as written in the input
  double Law::*member;               ///< member that receives the value
  Dimension dimension;               ///< converted to consistent units on reading; angles to radians
  Range range;                       ///< checked on reading, in input units
  std::string_view meaning;          ///< one phrase for the manual
  std::optional<double> fallback{};  ///< default value; absent: required (unless `optional`)
  bool optional = false;             ///< not required; if absent, the member keeps its initial value
  std::string_view alias{};          ///< second accepted spelling

  ParameterInfo info() const {
    return {std::string(name), std::string(alias), dimension, range, fallback, optional, std::string(meaning)};
  }
};

/// The value of a whole or decimal number that fills `text` completely; none otherwise.
std::optional<double> to_number(std::string_view text);

/// Error message for a child of <Material> that is not a property of its law.
std::string not_a_property(const std::string& name, const std::vector<std::string>& valid);

/// Values of the parameters in `table`, read from the children of `statement` (<E>1e6</E>), in table order and
/// consistent units. Missing, unknown, repeated, malformed and out-of-range entries are added to `problems`. Absent
/// optional parameters give no value. Children named in `handled_elsewhere` are skipped.
std::vector<std::optional<double>> read_parameters(const Statement& statement, const std::vector<ParameterInfo>& table,
                                                   const std::vector<std::string>& handled_elsewhere,
                                                   const Units& units, Problems& problems);

/// Sets the members of `law` from a statement, with the table `Law::parameters()`. See read_parameters.
template <class Law>
void read_law(Law& law, const Statement& statement, const std::vector<std::string>& handled_elsewhere,
              const Units& units, Problems& problems) {
  const auto table = Law::parameters();
  std::vector<ParameterInfo> infos;
  for (const auto& p : table) infos.push_back(p.info());
  const auto values = read_parameters(statement, infos, handled_elsewhere, units, problems);
  if constexpr (std::tuple_size_v < decltype(table) >> 0)  // a law may have no parameters
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k]) law.*(table[k].member) = *values[k];
}

}  // namespace tribo
