// SPDX-License-Identifier: MIT
/// Columns of history.csv in models of blocks. One table serves the reader, the manual and the output: a new quantity
/// is one entry in block_quantities.cpp.
#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tribo {

/// What a quantity is computed from: the state of an assembly, and the platen or the group of blocks that the history
/// refers to.
class BlockHistorySource {
 public:
  virtual ~BlockHistorySource() = default;
  // Of the platen
  virtual Vec3 platen_force() const = 0;         ///< of the blocks on it                  [force]
  virtual Vec3 platen_displacement() const = 0;  ///< [length]
  virtual double platen_area() const = 0;        ///< of the faces that it holds           [length^2]
  // Component `axis` of the group: the mean over its blocks, of forces the sum
  virtual double displacement(int axis) const = 0;  ///< of the centres                    [length]
  virtual double velocity(int axis) const = 0;      ///< [velocity]
  virtual double rotation(int axis) const = 0;      ///< rotation vector                   [rad]
  virtual double spin(int axis) const = 0;          ///< angular velocity                  [1/time]
  virtual double force(int axis) const = 0;         ///< without gravity and damping       [force]
  // Of the run
  virtual Mat3 mean_stress() const = 0;  ///< by volume                                    [stress]
  virtual Mat3 mean_strain() const = 0;
  virtual std::int64_t bonds() const = 0;  ///< whole ones
  virtual std::int64_t broken_in_tension() const = 0;
  virtual std::int64_t broken_in_shear() const = 0;
  virtual std::int64_t active_contacts() const = 0;  ///< that carry a force
  virtual double unbalanced() const = 0;             ///< largest force on a free block over the mean force of contacts
  virtual double kinetic_energy() const = 0;         ///< [energy]
  virtual double strain_energy() const = 0;          ///< [energy]
  virtual double slip_energy() const = 0;            ///< dissipated so far [energy]
  virtual double dashpot_energy() const = 0;         ///< dissipated so far [energy]
  virtual double released_energy() const = 0;        ///< so far            [energy]
  virtual std::int64_t step() const = 0;             ///< number of steps done
  virtual double step_size() const = 0;              ///< [time]
};

struct BlockQuantityInfo {
  std::string_view name, unit, meaning;
  enum class Of { run, platen, block } of;
  double (*value)(const BlockHistorySource&);
};

const std::vector<BlockQuantityInfo>& block_quantities();
/// The entry of this name in any case for what it refers to, or null.
const BlockQuantityInfo* find_block_quantity(std::string_view name, BlockQuantityInfo::Of of);

}  // namespace tribo
