// SPDX-License-Identifier: MIT
/// The fields of the particle files, by the names in model/quantities.cpp.
#pragma once

#include "output/vtk.hpp"
#include "solver/state/system.hpp"

#include <deque>

namespace tribo {

/// Values of all particles of some bodies, one body after the other, as the files need them.
template <int Dim>
class ParticleFields {
 public:
  /// Fields whose condition is not met (temperature without heat, contact without contact) are left out.
  ParticleFields(const Model& model, std::vector<Body<Dim>*> bodies, const std::vector<std::string>& names);

  std::size_t count() const { return count_; }
  const std::array<const double*, 3>& positions() const { return positions_; }
  const std::vector<OutputField>& fields() const { return fields_; }

  /// What is written if the command file names nothing.
  static const std::vector<std::string>& standard();

 private:
  void add(const std::string& name);
  void add_history();
  std::vector<double>& array() { return arrays_.emplace_back(count_, 0.0); }
  template <class F>
  void each(F&& f);
  template <class F>
  void scalar(const std::string& name, F&& value);
  template <class F>
  void integer(const std::string& name, F&& value);
  template <std::size_t Count, class F>
  void several(const std::string& name, F&& values);
  template <class F>
  void vector(const std::string& name, F&& value);

  const Model& model_;
  std::vector<Body<Dim>*> bodies_;
  std::size_t count_ = 0;
  std::array<const double*, 3> positions_{};
  std::vector<OutputField> fields_;
  std::deque<std::vector<double>> arrays_;
  std::deque<std::vector<std::int64_t>> integers_;
};

}  // namespace tribo
