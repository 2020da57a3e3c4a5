// SPDX-License-Identifier: MIT
/// Results of a run in its folder, for pictures and reports.
#pragma once

#include "base/error.hpp"
#include "output/vtk.hpp"

#include <map>

namespace tribo {

/// Columns of numbers with names.
struct ResultTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// The column of this name, or null.
  const std::vector<double>* column(std::string_view name) const;
};

/// A file of History: an incomplete last line is left out. Throws FileError.
ResultTable read_table(const std::filesystem::path& file);

/// The state at one output time: particles, rigid blocks and their contacts, and cracks. Any may be empty.
struct Scene {
  double time = 0.0;
  ParticleFrame particles;
  CellFrame blocks, contacts, cracks;
};

/// The error of a provenance.json that cannot be read.
FileError damaged_record(const std::filesystem::path& folder, const std::string& why);

/// Units and names of a run, of provenance.json. All are empty if the record has none.
struct Legend {
  std::string time, length;                  ///< units
  std::map<std::string, std::string> units;  ///< of fields, of columns of history.csv and of energy.csv
  std::vector<std::string> materials;        ///< names in the order of their numbers
  std::vector<std::string> rigid_materials;  ///< names of those that are rigid
  struct Body {
    std::string name;
    double first = 0.0, last = 0.0;  ///< numbers of its particles
  };
  std::vector<Body> bodies;  ///< empty if there are no more than materials
  /// Unit of a field, of a component of it or of a column; empty if it has none.
  std::string unit_of(const std::string& name) const;
};

/// Replaces the values that rigid particles do not have, such as stress, by NaN.
void remove_values_of_rigid_materials(ParticleFrame& frame, const Legend& legend);

/// Adds the field `body` with the number of the body of each particle, from 1; 0 for those that came later.
void add_bodies(ParticleFrame& frame, const Legend& legend);

class RunFolder {
 public:
  /// Throws FileError if the folder holds no run.
  explicit RunFolder(std::filesystem::path folder);

  const std::filesystem::path& path() const { return folder_; }
  bool has_particles() const;
  /// Particle files that are there now; of a run of blocks alone, their files.
  std::vector<CollectionEntry> frames() const;
  /// The state that was written together with a file of `frames`. Of rigid materials, stress, strain and other values
  /// that they do not have are not numbers. Throws FileError.
  Scene scene(const CollectionEntry& frame) const;
  ResultTable history() const { return read_table(folder_ / "history.csv"); }
  ResultTable energy() const { return read_table(folder_ / "energy.csv"); }
  Legend legend() const;
  /// provenance.json as text.
  std::string provenance() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace tribo
