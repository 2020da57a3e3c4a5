// SPDX-License-Identifier: MIT
/// A part of the pre-flight report.
#pragma once

#include <string>
#include <vector>

namespace tribo {

struct Remarks {
  std::vector<std::string> lines;   ///< what the model contains
  std::vector<std::string> advice;  ///< what may be wrong with it, and what to do
};

}  // namespace tribo
