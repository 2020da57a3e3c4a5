// SPDX-License-Identifier: MIT
/// Columns of joints in files of results, the same for joints in the grid and for contacts of blocks.
#pragma once

#include "contact/joint_geometry.hpp"
#include "contact/joint_law.hpp"
#include "run/columns.hpp"

namespace tribo {

/// Names of the columns that describe an event: its name, and its values.
const std::vector<std::string>& joint_event_columns();
/// The texts of these columns.
std::vector<std::string> joint_event_texts(const JointEvent& event);

/// Adds to each contact the state in words, the quantities that only single laws have, the forces of dashpots and of
/// the fictitious stress, and its energies.
class JointColumns {
 public:
  /// `laws`: those of all contacts of the file. A quantity that the law of a contact does not have is 0 there.
  explicit JointColumns(std::span<const JointLaw* const> laws);
  /// `dashpot`: energy dissipated by dashpots.
  void add(Columns& out, const JointLaw& law, const Joint& joint, const JointAxes& axes, double dashpot) const;

 private:
  std::vector<std::string_view> names_;
};

}  // namespace tribo
