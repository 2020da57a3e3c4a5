// SPDX-License-Identifier: MIT
/// Tables of reference numbers beside the tests: comma separated, lines that start with # are remarks.
#pragma once

#include "tests/root.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tribo::test {

inline std::vector<std::vector<std::string>> read_table(const std::string& name) {
  std::ifstream in(source_root() / "tests/materials/data" / name);
  if (!in) throw std::runtime_error("cannot read the table " + name);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace tribo::test
