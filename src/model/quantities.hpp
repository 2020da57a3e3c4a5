// SPDX-License-Identifier: MIT
/// Columns of history.csv. One table serves the reader, the manual and the output: a new quantity is one entry in
/// quantities.cpp.
#pragma once

#include "model/measures.hpp"

#include <string_view>
#include <vector>

namespace tribo {

/// What a quantity is computed from: the state of a run, seen from what the history refers to (all particles, a
/// material, or one particle).
class HistorySource {
 public:
  virtual ~HistorySource() = default;
  virtual const Measures& measures() const = 0;
  virtual const RunEnergies& energies() const = 0;
  /// Force of a rigid material, of conditions or of a symmetry plane on the rest [force].
  virtual Vec3 reaction() const = 0;
  virtual ContactSums contact() const = 0;
  virtual double heat_supplied() const = 0;     ///< by conditions so far          [energy]
  virtual double contact_heat() const = 0;      ///< by sliding contact so far     [energy]
  virtual double grid_damping() const = 0;      ///< present coefficient           [1/time]
  virtual double particle_damping() const = 0;  ///< present coefficient           [1/time]
  virtual std::int64_t step() const = 0;        ///< number of steps done
  virtual double step_size() const = 0;         ///< [time]
  virtual double processor_time() const = 0;    ///< of all threads so far   [s]
  virtual double elapsed_time() const = 0;      ///< of the clock, since the first row of the history [s]
  /// Of the centre of mass; zero without mass [velocity].
  Vec3 velocity() const {
    const Measures& m = measures();
    return m.mass > 0 ? Vec3(m.momentum / m.mass) : Vec3(Vec3::Zero());
  }
};

/// What a quantity can refer to.
enum class Scope {
  run,       ///< only the whole run
  material,  ///< also one material
  particle   ///< also one particle
};

struct QuantityInfo {
  std::string_view name;
  std::string_view unit;     ///< generic, e.g. `velocity`
  std::string_view meaning;  ///< one phrase
  Scope scope;
  double (*value)(const HistorySource&);
};

/// Quantities of history.csv, with the names of NairnMPM and additional ones.
const std::vector<QuantityInfo>& global_quantities();
/// The entry with this name, in any case, or with an alternative name of NairnMPM (`temp`, `sRR`); null if there is
/// none.
const QuantityInfo* find_global_quantity(std::string_view name);
/// Whether a quantity is a mean strain, which needs the deformation gradient.
bool is_strain(const QuantityInfo& quantity);
/// Whether it is an elastic or plastic share of the mean strain.
bool is_elastic_strain(const QuantityInfo& quantity);
/// Whether it needs the deformation gradient.
bool is_deformation(const QuantityInfo& quantity);
/// The number or name in `history 3`; empty for other quantities.
std::string_view history_variable_of(std::string_view name);

}  // namespace tribo
