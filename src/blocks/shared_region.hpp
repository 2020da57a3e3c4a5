// SPDX-License-Identifier: MIT
/// What two overlapping blocks share, its elastic energy, and the force that follows from it.
#pragma once

#include "blocks/overlap.hpp"
#include "contact/joint_geometry.hpp"

#include <span>
#include <vector>

namespace tribo {

/// A part of the region that two blocks share, as springs k A of one depth: their force k A depth and their energy
/// k A depth^2/2 are those of the part.
struct SharedPart {
  Vec3 at = Vec3::Zero();  ///< on the axis of the force, nearest to the centre of the part
  Vec3 n = Vec3::UnitX();  ///< direction of the force on b
  double area = 0.0;       ///< two dimensions: length
  double depth = 0.0;      ///< of the springs, >= 0
  double couple = 0.0;     ///< moment about n on b over the force [length]; 0 in two dimensions
};
/// Number of parts of a pair: enough to resist all relative motions of two bodies.
constexpr std::size_t shared_parts(bool plane) { return plane ? 2 : 4; }

/// The intersection of two convex blocks and its energy per stiffness,
///
///   E = integral of the depth below one face = volume x depth of the centroid.
///
/// The face is the one of either block that is nearest to the centroid, so that E is a continuous function of the
/// positions of the blocks alone. Its gradient is the force: volume times normal at the centroid, and the depth as a
/// pressure on those other faces of the same block that lie in the other one. A flat overlap of depth d has the force
/// A d and the energy A d^2/2, as springs that are spread over it.
class SharedRegion {
 public:
  /// False if the blocks share nothing. `along`: a unit vector from a to b, about normal to the overlap.
  bool find(const PlacedBlock& a, const PlacedBlock& b, const Vec3& along, bool plane);
  double volume() const { return volume_; }  ///< two dimensions: area
  const Vec3& centre() const { return centre_; }
  /// Of the face that the depth is measured from, towards b.
  const Vec3& normal() const { return normal_; }
  /// The number of that face: first those of a, then those of b.
  std::size_t face() const { return face_; }
  double energy() const { return volume_ * (height_ - out_.dot(centre_)); }
  /// The largest depth below a face of a block.
  double deepest(const PlacedBlock& block, std::size_t face) const;
  /// Divides the region in the middle along the axes t, and in space also s; axes.n is normal(). Energies, forces and
  /// moments of the parts add up to those of the region. `parts` has the length shared_parts(plane).
  void share(const JointAxes& axes, std::span<SharedPart> parts) const;

 private:
  using Polygon = std::vector<Vec3>;
  /// A piece of the surface; in two dimensions an edge of two corners.
  struct Side {
    Polygon corners;
    Vec3 out = Vec3::UnitX();
    std::size_t face = 0;
  };
  /// Sums over a piece of the region.
  struct Sums {
    double volume = 0.0;
    Vec3 first = Vec3::Zero();                      ///< moment of the volume
    Vec3 push = Vec3::Zero(), turn = Vec3::Zero();  ///< by the depth on other faces of the block, and its moment
  };
  Side& add_side();
  void find_edges(const PlacedBlock& a, const PlacedBlock& b);
  void find_faces(const PlacedBlock& own, const PlacedBlock& other, bool strictly, std::size_t first_face);
  void choose_face(const PlacedBlock& a, const PlacedBlock& b);
  void add(const Side& side, const Polygon& piece, const Vec3& n, bool pushes, Sums& to) const;
  SharedPart part_of(const Sums& sums) const;

  std::vector<Side> sides_;  // the first count_ are used; the memory is kept
  std::size_t count_ = 0, faces_of_a_ = 0, face_ = 0;
  bool plane_ = true, of_a_ = true;
  double volume_ = 0.0, height_ = 0.0;  // height of the face: out . x
  Vec3 origin_ = Vec3::Zero(), centre_ = Vec3::Zero(), normal_ = Vec3::UnitX(), out_ = Vec3::UnitX();
};

}  // namespace tribo
