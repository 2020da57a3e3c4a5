// SPDX-License-Identifier: MIT
/// Particles of one body: one array per component, registered by name for sorting, output and restart alike.
#pragma once

#include "base/aligned.hpp"
#include "base/archive.hpp"
#include "base/types.hpp"
#include "base/units.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tribo {

template <int Dim>
class Particles {
 public:
  using Tensor = std::array<double*, Layout<Dim>::full>;
  using Symmetric = std::array<double*, Layout<Dim>::symmetric>;
  using Vector = std::array<double*, static_cast<std::size_t>(Dim)>;

  /// One array of doubles and what it is called; tensors and vectors are several columns `stress_xx`, ...
  struct Column {
    std::string name;
    Dimension dimension;
    AlignedVector<double> data;
  };

  /// Lanes that may be read (not written) beyond the last particle.
  static constexpr std::size_t padding = 16;

  /// `with_deformation`: keep F; else F() gives null pointers.
  explicit Particles(std::size_t count, bool with_deformation = true) : count_(count), id(count) {
    x_ = add_vector("position", Dimension::length);
    v_ = add_vector("velocity", Dimension::velocity);
    mass_ = add("mass", Dimension::mass);
    volume_ = add("volume", Dimension::none, 1.0);
    if (with_deformation) F_ = add_tensor("F", Dimension::none);
    stress_ = add_symmetric("stress", Dimension::stress);
  }

  std::size_t size() const { return count_; }

  /// Registers a column; returns its number. All particles start with `initial`.
  std::size_t add(std::string name, Dimension dimension, double initial = 0.0) {
    columns_.push_back({std::move(name), dimension, AlignedVector<double>(count_ + padding, initial)});
    return columns_.size() - 1;
  }
  std::size_t add_vector(const std::string& name, Dimension dimension) {
    constexpr std::array axis{"_x", "_y", "_z"};
    for (std::size_t d = 0; d < Dim; ++d) add(name + axis[d], dimension);
    return columns_.size() - Dim;
  }
  std::size_t add_tensor(const std::string& name, Dimension dimension) {
    for (const auto& [i, j] : Layout<Dim>::full_at) add(name + suffix(i, j), dimension);
    return columns_.size() - Layout<Dim>::full;
  }
  std::size_t add_symmetric(const std::string& name, Dimension dimension) {
    for (const auto& [i, j] : Layout<Dim>::symmetric_at) add(name + suffix(i, j), dimension);
    return columns_.size() - Layout<Dim>::symmetric;
  }

  double* column(std::size_t k) { return columns_[k].data.data(); }
  const double* column(std::size_t k) const { return columns_[k].data.data(); }
  const std::vector<Column>& columns() const { return columns_; }
  std::vector<Column>& columns() { return columns_; }

  Vector vector(std::size_t first) { return pointers<Vector>(first); }
  Vector x() { return vector(x_); }
  Vector v() { return vector(v_); }
  double* mass() { return column(mass_); }
  double* volume() { return column(volume_); }
  const double* volume() const { return column(volume_); }
  bool has_deformation() const { return F_ != 0; }
  Tensor F() { return has_deformation() ? pointers<Tensor>(F_) : Tensor{}; }
  Symmetric stress() { return pointers<Symmetric>(stress_); }

  Vec<Dim> position(std::size_t i) const { return gather_vector(x_, i); }
  Vec<Dim> velocity(std::size_t i) const { return gather_vector(v_, i); }

  /// particle i becomes the former particle order[i].
  void reorder(std::span<const std::uint32_t> order);

  /// Columns without their padding.
  friend void archive(Archive& a, Particles& particles) {
    auto& [count, columns, spare, x, v, mass, volume, F, stress, ids] = particles;
    a.version(1);
    a("id", ids);
    for (Column& column : columns) a.doubles(column.name, {column.data.data(), count});
  }

 private:
  static std::string suffix(int i, int j) {
    constexpr std::string_view axis = "xyz";
    return std::string{'_', axis[static_cast<std::size_t>(i)], axis[static_cast<std::size_t>(j)]};
  }
  template <class P>
  P pointers(std::size_t first) {
    P p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = column(first + k);
    return p;
  }
  Vec<Dim> gather_vector(std::size_t first, std::size_t i) const {
    Vec<Dim> out;
    for (std::size_t d = 0; d < Dim; ++d) out[static_cast<Eigen::Index>(d)] = column(first + d)[i];
    return out;
  }

  std::size_t count_;
  std::vector<Column> columns_;
  AlignedVector<double> spare_;
  std::size_t x_ = 0, v_ = 0, mass_ = 0, volume_ = 0, F_ = 0, stress_ = 0;

 public:
  std::vector<std::int64_t> id;  ///< given at the start, kept for life
};

}  // namespace tribo
