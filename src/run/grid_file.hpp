// SPDX-License-Identifier: MIT
/// The grid files; model/output_fields.cpp lists their fields.
#pragma once

#include "model/model.hpp"
#include "model/output_fields.hpp"
#include "output/vtk.hpp"
#include "solver/state/system.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <unordered_map>
#include <vector>

namespace tribo {

/// A node of the lattice with all velocity fields that have mass there; zero where none has. Several fields (bodies in
/// contact, the two sides of a crack) add up: masses and momenta.
template <int Dim>
GridNodeState grid_node_state(const System<Dim>& system, const Index<Dim>& node);

/// The states of the nodes with mass, by their numbers in the lattice.
using GridNodes = std::unordered_map<std::int64_t, GridNodeState>;

/// In a run of several processes: rank 0 receives the nodes of all of them. All ranks must call it together.
template <int Dim>
GridNodes collect_grid_nodes(const System<Dim>& system);

/// The fields that the model asks for at all nodes of the grid at present.
class GridFile {
 public:
  /// `collected`: the nodes of all processes, if there are several, otherwise null. Throws SimulationError if a number
  /// is not finite.
  template <int Dim>
  GridFile(const Model& model, const System<Dim>& system, const GridNodes* collected = nullptr);
  /// Writes them as .vti. Throws FileError.
  void write(const std::filesystem::path& path) const;
  /// Memory that it holds.
  std::size_t bytes() const;

 private:
  struct Column {
    const GridField* field;
    std::vector<std::vector<double>> components;
  };
  std::vector<OutputField> fields() const;

  double time_;
  std::array<double, 3> origin_{}, spacing_{1, 1, 1};
  std::array<int, 3> nodes_{1, 1, 1};
  std::size_t count_ = 1;
  std::vector<Column> columns_;
};

}  // namespace tribo
