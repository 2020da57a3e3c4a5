// SPDX-License-Identifier: MIT
/// What the particles at the start tell about the form of bodies: how thick these are, and what lies on their sides.
#pragma once

#include "grid/lattice.hpp"
#include "model/model.hpp"
#include "particles/seed.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tribo {

/// The cubes of half a cell that particles cover, at the start of a run.
template <int Dim>
class Voxels {
 public:
  static constexpr int per_cell = 2;  ///< cubes per cell and axis

  /// `model`: its symmetry planes and its axis of rotation mirror the cubes.
  Voxels(const Model& model, const Lattice<Dim>& lattice);

  /// Adds the domain of a particle, or other cubes; sort() must be called after the last one.
  void add(const Seed& seed);
  void add(const Voxels& other) { keys_.insert(keys_.end(), other.keys_.begin(), other.keys_.end()); }
  void sort();
  /// Adds the mirror images of the cubes up to a number of cubes from the planes, and sorts.
  void add_images(int reach);

  bool empty() const { return keys_.empty(); }
  /// Numbers of the lowest and highest cubes along the axes.
  struct Box {
    Index<Dim> low, high;
  };
  /// Of all cubes; there must be some.
  Box box() const;
  /// Cubes that are farther apart along an axis do not touch, even by way of a mirror image.
  static constexpr int margin = 2 * per_cell + 1;
  bool contains(Index<Dim> voxel) const;

  /// The position of the cube around a point in the order of the cubes; nullopt if there is none.
  std::optional<std::size_t> cube_around(const Vec<Dim>& x) const;
  /// The connected body of each cube, by the position of one of its cubes.
  std::vector<std::size_t> connected() const;
  /// For each cube the edge of the largest block of cubes, up to `most`, whose corner with the highest numbers it is.
  std::vector<int> largest_cubes(int most) const;

  /// The thickness of the connected body that is thinnest behind the faces where it touches `other` [cells]: the median
  /// length of lines through the body, normal to these faces. Faces touch if they are less than a cell apart; nullopt
  /// if none do. Bodies that a symmetry plane cuts are taken whole.
  std::optional<double> thickness_behind(const Voxels& other) const;
  /// Whether such lines from the faces of `rigid`, a tenth of them at least, end at a face of `rigid` that is opposite
  /// to the first one.
  bool lies_between(const Voxels& rigid) const;

 private:
  using Key = std::uint64_t;
  /// A line from a cube at a face through the body.
  struct Chord {
    std::size_t cube;  // position in keys_
    double length;     // [cubes]
    Vec<Dim> normal;   // outward, where the line starts
    Vec<Dim> last;     // its last point in the body, from the low corner of the grid [cubes]
  };
  static Key key_of(const Index<Dim>& voxel);
  static Index<Dim> voxel_of(Key key);
  std::vector<std::size_t> touching(const Voxels& other) const;
  std::vector<Chord> chords_from(const Voxels& other) const;
  std::optional<Vec<Dim>> towards(const Vec<Dim>& point) const;

  Vec<Dim> low_, size_;  // of the grid, of a cube [length]
  // Cube number of the plane at the low and high end of each axis in which the bodies are mirrored.
  std::array<std::array<std::optional<int>, 2>, Dim> mirror_;
  double volume_ = 0.0;    // of the particles [cubes]
  std::vector<Key> keys_;  // in order
};

}  // namespace tribo
