// SPDX-License-Identifier: MIT
/// Columns of a table of particles, with the places of their numbers.
#pragma once

#include "base/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

struct ParticleColumns {
  struct Column {
    std::string name;
    Origin origin;
    std::vector<double> values;  ///< as in the file, one for each particle
    std::vector<int> places;     ///< column of each number in its line; empty if the file has no lines
  };
  Origin file;             ///< the table as a whole
  std::size_t count = 0;   ///< of particles
  std::vector<int> lines;  ///< of the particles in the file; empty if the file has no lines
  std::vector<Column> columns;

  /// The column of this name, or null.
  const Column* find(std::string_view name) const;
  /// The place of a number: `file:line:column` if the file has lines.
  Origin place(const Column& column, std::size_t particle) const;
  /// ` of particle 7` if the file has no lines, otherwise empty.
  std::string which(std::size_t particle) const;
};

/// Reads a table of comma-separated values; the first row has the names. `valid`: the names that columns may have.
/// Problems are collected.
ParticleColumns particle_columns_of_text(std::string_view text, const std::string& path,
                                         const std::vector<std::string>& valid, Problems& problems);
/// Reads a file of VTK. Its arrays velocity, stress and size become columns of their components, other arrays of one
/// component whose name is valid a column each; all others are left out. Throws FileError.
ParticleColumns particle_columns_of_vtk(const std::string& path, const std::vector<std::string>& valid);

}  // namespace tribo
