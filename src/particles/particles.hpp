// SPDX-License-Identifier: MIT
/// Particles of one body: one array per component, registered by name for sorting, output and restart.
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

/// The columns that hold one quantity of the particles, or none as long as the quantity is not kept.
template <class Kind>
class ColumnHandle {
 public:
  ColumnHandle() = default;
  explicit ColumnHandle(std::size_t first) : first_(first) {}
  explicit operator bool() const { return first_ != none; }
  /// Number of the first column.
  std::size_t first() const { return first_; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t first_ = none;
};
using ScalarColumn = ColumnHandle<struct ScalarKind>;  ///< one column
using VectorColumn = ColumnHandle<struct VectorKind>;  ///< Dim columns
using MatrixColumn = ColumnHandle<struct MatrixKind>;  ///< Dim x Dim columns, row by row

template <int Dim>
class Particles {
 public:
  using Tensor = std::array<double*, Layout<Dim>::full>;
  using Symmetric = std::array<double*, Layout<Dim>::symmetric>;
  using Vector = std::array<double*, static_cast<std::size_t>(Dim)>;
  using Matrix = std::array<double*, static_cast<std::size_t>(Dim* Dim)>;

  /// A named array of doubles. Vectors and tensors consist of several columns `stress_xx`, ...
  struct Column {
    std::string name;
    Dimension dimension;
    AlignedVector<double> data;
  };

  /// Number of entries that may be read (not written) beyond the last particle.
  static constexpr std::size_t padding = 16;

  /// `with_deformation`: store F; otherwise F() gives null pointers.
  explicit Particles(std::size_t count, bool with_deformation = true) : count_(count), id(count) {
    x_ = add_vector("position", Dimension::length);
    v_ = add_vector("velocity", Dimension::velocity);
    mass_ = add("mass", Dimension::mass);
    volume_ = add("volume", Dimension::none, 1.0);
    if (with_deformation) F_ = add_tensor("F", Dimension::none);
    stress_ = add_symmetric("stress", Dimension::stress);
  }

  /// Number of particles; without the ghosts.
  std::size_t size() const { return count_; }
  /// Number of ghosts, which are copies of particles of other processes. In the columns they follow the particles.
  std::size_t ghosts() const { return ghosts_; }

  /// Registers a column of the given dimension; all particles start with `initial`.
  ScalarColumn add(std::string name, Dimension dimension, double initial = 0.0) {
    columns_.push_back({std::move(name), dimension, AlignedVector<double>(count_ + padding, initial)});
    return ScalarColumn(columns_.size() - 1);
  }
  /// Registers the columns `name_x`, `name_y` (and `name_z`).
  VectorColumn add_vector(const std::string& name, Dimension dimension) {
    constexpr std::array axis{"_x", "_y", "_z"};
    for (std::size_t d = 0; d < Dim; ++d) add(name + axis[d], dimension);
    return VectorColumn(columns_.size() - Dim);
  }
  /// Registers the columns `name_xx`, `name_xy`, ... row by row.
  MatrixColumn add_matrix(const std::string& name, Dimension dimension) {
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) add(name + suffix(i, j), dimension);
    return MatrixColumn(columns_.size() - Dim * Dim);
  }

  double* column(std::size_t k) { return columns_[k].data.data(); }
  const double* column(std::size_t k) const { return columns_[k].data.data(); }
  const std::vector<Column>& columns() const { return columns_; }
  std::vector<Column>& columns() { return columns_; }

  /// Pointers to the columns of a quantity that is kept, one value per particle each.
  double* operator[](ScalarColumn c) { return column(c.first()); }
  const double* operator[](ScalarColumn c) const { return column(c.first()); }
  Vector operator[](VectorColumn c) { return pointers<Vector>(c.first()); }
  Matrix operator[](MatrixColumn c) { return pointers<Matrix>(c.first()); }
  std::array<const double*, static_cast<std::size_t>(Dim)> operator[](VectorColumn c) const {
    std::array<const double*, static_cast<std::size_t>(Dim)> p;
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = column(c.first() + k);
    return p;
  }

  Vector x() { return (*this)[x_]; }
  Vector v() { return (*this)[v_]; }
  double* mass() { return (*this)[mass_]; }
  double* volume() { return (*this)[volume_]; }
  const double* volume() const { return (*this)[volume_]; }
  bool has_deformation() const { return F_ != 0; }
  Tensor F() { return has_deformation() ? pointers<Tensor>(F_) : Tensor{}; }
  Symmetric stress() { return pointers<Symmetric>(stress_); }

  Vec<Dim> position(std::size_t i) const { return gather_vector(x_.first(), i); }
  Vec<Dim> velocity(std::size_t i) const { return gather_vector(v_.first(), i); }

  /// Makes room for so many ghosts; those that exist are kept. The values and numbers of the others are to be set.
  void set_ghosts(std::size_t count) {
    ghosts_ = count;
    ghost_id.resize(count);
    for (Column& column : columns_) column.data.resize(count_ + ghosts_ + padding, 0.0);
  }
  /// Makes room for so many particles, without ghosts. Their values and numbers are to be set.
  void resize(std::size_t count) {
    count_ = count, ghosts_ = 0;
    id.resize(count), ghost_id.clear();
    for (Column& column : columns_) column.data.resize(count + padding, 0.0);
  }
  /// particle i becomes the former particle order[i]; particles that are not in `order`, and ghosts, are removed.
  void reorder(std::span<const std::uint32_t> order);
  /// Appends a copy of each particle of `originals`. The copies receive the numbers first_id, first_id + 1, ...
  void append_copies(std::span<const std::uint32_t> originals, std::int64_t first_id);

  /// Appends particles of `from`, whose columns are the first ones of this object. Further columns are 0 for them.
  void append(const Particles& from, std::span<const std::uint32_t> which);

  /// Columns without their padding.
  friend void archive(Archive& a, Particles& particles) {
    auto& [count, ghosts, columns, spare, x, v, mass, volume, F, stress, ids, ids_of_ghosts] = particles;
    a.version(2);
    a.resizable("id", ids);
    if (a.reading()) particles.resize(ids.size());
    for (Column& column : columns) a.doubles(column.name, {column.data.data(), count});
  }

 private:
  std::size_t add_tensor(const std::string& name, Dimension dimension) {
    for (const auto& [i, j] : Layout<Dim>::full_at) add(name + suffix(i, j), dimension);
    return columns_.size() - Layout<Dim>::full;
  }
  std::size_t add_symmetric(const std::string& name, Dimension dimension) {
    for (const auto& [i, j] : Layout<Dim>::symmetric_at) add(name + suffix(i, j), dimension);
    return columns_.size() - Layout<Dim>::symmetric;
  }
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

  std::size_t count_, ghosts_ = 0;
  std::vector<Column> columns_;
  AlignedVector<double> spare_;
  VectorColumn x_, v_;
  ScalarColumn mass_, volume_;
  std::size_t F_ = 0, stress_ = 0;  // first columns of tensors in the layout of the analysis

 public:
  std::vector<std::int64_t> id;        ///< unique within the run, never changed
  std::vector<std::int64_t> ghost_id;  ///< those of the ghosts
  /// The number of a particle or, from size() on, of a ghost.
  std::int64_t number(std::size_t i) const { return i < count_ ? id[i] : ghost_id[i - count_]; }
};

}  // namespace tribo
