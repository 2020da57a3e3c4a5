// SPDX-License-Identifier: MIT
/// The fields of the particle files; model/output_fields.cpp lists them.
#pragma once

#include "model/output_fields.hpp"
#include "output/vtk.hpp"
#include "run/particle_blocks.hpp"
#include "solver/state/system.hpp"

#include <functional>
#include <memory>

namespace tribo {

/// Limits the edges of a domain to 1.5 cells and makes the others longer, up to this length, so that the volume stays:
/// particles further apart no longer interact, so that a longer domain is a thread which the motion has torn.
/// `axes`: half axes as columns; `cell`: edges of a cell [length].
template <int Dim>
Mat<Dim> limited(Mat<Dim> axes, const Vec<Dim>& cell);

/// How the numbers of fields are kept. Positions are always in double precision, domains and sizes in single precision.
enum class Precision { single, full };

/// Values of particles, as the files need them. Two fields are always
/// there: `domain`, the half axes of the domains, one after the other, in the reduced basis of the lattice of particles
/// and limited(), and `size`, the lengths of their edges (the third is zero in the plane).
template <int Dim>
class ParticleFields {
 public:
  /// `bodies`: all bodies of the model that are written; variables of their laws are fields. `ranges`: the particles,
  /// one range after the other. Fields that need what the model does not have (temperature without heat, contact
  /// without contact) are left out. Throws SimulationError if a number is not finite.
  ParticleFields(const Model& model, std::vector<Body<Dim>*> bodies, std::span<const ParticleRange<Dim>> ranges,
                 const std::vector<std::string>& names, Precision precision);
  /// All particles as they are stored, one body after the other.
  ParticleFields(const Model& model, const std::vector<Body<Dim>*>& bodies, const std::vector<std::string>& names,
                 Precision precision)
      : ParticleFields(model, bodies, whole(bodies), names, precision) {}

  std::size_t count() const { return count_; }
  /// Memory that it holds, and that each particle needs.
  std::size_t bytes() const { return count_ * bytes_of_particle(); }
  std::size_t bytes_of_particle() const {
    std::size_t sum = integers_.size() * sizeof(std::int64_t);
    for (const auto& rows : doubles_) sum += rows.width * sizeof(double);
    for (const auto& rows : floats_) sum += rows.width * sizeof(float);
    return sum;
  }
  const OutputRows& positions() const { return positions_; }
  const std::vector<OutputField>& fields() const { return fields_; }

 private:
  // Successive particles, and the index of the first among all.
  struct Part : ParticleRange<Dim> {
    std::size_t at;
  };
  static std::vector<ParticleRange<Dim>> whole(const std::vector<Body<Dim>*>& bodies);
  // Rows of a field, not initialised.
  template <class Number>
  struct Rows {
    std::unique_ptr<Number[]> numbers;  // NOLINT(*-avoid-c-arrays)
    std::size_t width, count;
    Rows(std::size_t row_count, std::size_t row_width)
        : numbers(std::make_unique_for_overwrite<Number[]>(row_count * row_width)),  // NOLINT(*-avoid-c-arrays)
          width(row_width),
          count(row_count) {}
    std::size_t size() const { return count * width; }
  };
  void fill(std::span<const ParticleRange<Dim>> ranges);
  void add_positions();
  void add(const Model& model, const ParticleField& field);
  void add_integers(const ParticleField& field);
  void add_numbers(const ParticleField& field);
  void add_history();
  void add_domains();
  // Where the numbers of a field go, in one of two precisions.
  struct Target {
    double* doubles;
    float* floats;
    void set(std::size_t at, double value) const {
      if (doubles)
        doubles[at] = value;
      else
        floats[at] = static_cast<float>(value);
    }
  };
  // Adds a field with rows of `width` numbers.
  Target add_rows(const std::string& name, std::size_t width, bool single);

  std::vector<Body<Dim>*> bodies_;
  std::size_t count_ = 0;
  bool limits_;  ///< CPDI: particles interact as far as their domains reach
  bool single_;
  OutputRows positions_;
  std::vector<OutputField> fields_;
  std::vector<std::function<void(const Part&)>> fills_;  // until the fields are filled
  std::vector<Rows<double>> doubles_;
  std::vector<Rows<float>> floats_;
  std::vector<std::unique_ptr<std::int64_t[]>> integers_;  // NOLINT(*-avoid-c-arrays)
};

}  // namespace tribo
