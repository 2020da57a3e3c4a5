// SPDX-License-Identifier: MIT
/// The common face of two bodies, from the intersection of the sides of their particle domains.
#pragma once

#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// A piece of the common face of two bodies.
template <int Dim>
struct CommonFacePiece {
  Vec<Dim> x;  ///< position halfway between the faces                                    [length]
  Vec<Dim> n;  ///< unit normal out of the first body
  /// Area, in plane analyses times the thickness, in axisymmetric ones per radian [length^2].
  double area = 0.0;
  double size = 0.0;  ///< largest edge of the two particle domains                                [length]
  /// Number of the part of a side of the first body; consecutive pieces of the same part have the same number.
  std::uint32_t side_number{};
  std::int64_t side{};  ///< the side: number of its particle times twice the dimension, plus number of the side
};

/// Pieces of the common face of two bodies in the current configuration. Two sides of particle domains have a common
/// face if they are opposite each other, their normals are antiparallel to within `largest_angle` [rad], and their
/// distance is at most a twentieth of a cell. In two dimensions the pieces are the Gauss points of the intersection of
/// two sides, in three its centroid; sums over the pieces are exact for linear functions.
template <int Dim>
std::vector<CommonFacePiece<Dim>> common_face_pieces(const Model& model, System<Dim>& system, Body<Dim>& a,
                                                     Body<Dim>& b, double largest_angle);

/// Smooths stepped faces. Where the sides of particle domains approximate a smooth face by steps, each piece is
/// projected to the mean plane of the pieces around it: it gets the normal of this plane, and its position and area
/// are those of its projection. Flat faces, corners and curved faces do not change.
template <int Dim>
void smooth_steps(const Lattice<Dim>& lattice, std::vector<CommonFacePiece<Dim>>& pieces);

}  // namespace tribo
