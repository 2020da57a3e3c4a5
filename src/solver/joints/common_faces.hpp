// SPDX-License-Identifier: MIT
/// Where the particles of two bodies touch.
#pragma once

#include "solver/state/system.hpp"

#include <vector>

namespace tribo {

/// A piece of the common face of two bodies.
template <int Dim>
struct CommonFacePiece {
  Vec<Dim> x;               ///< halfway between the faces                                    [length]
  Vec<Dim> n;               ///< unit normal out of the first body
  double area = 0.0;        ///< as the model counts areas: with thickness, or per radian     [length^2]
  double size = 0.0;        ///< largest edge of the particles                                [length]
  std::uint32_t side_of{};  ///< pieces of one part of one side of a particle have the same number, one after the other
};

/// Pieces of the common face of two bodies, as their particles' domains lie now: where sides of domains are opposite
/// each other, with normals that differ by less than 30 degrees, and closer than a twentieth of a cell. In two
/// dimensions the points of Gauss's rule, in three the centroids of what two sides have in common; sums over pieces are
/// exact for linear functions.
template <int Dim>
std::vector<CommonFacePiece<Dim>> common_face_pieces(const Model& model, System<Dim>& system, Body<Dim>& a,
                                                     Body<Dim>& b);

/// Levels steps: where sides of domains make a stair along a smooth face, all pieces get the place and normal of the
/// plane through those around them and the area they cover of it. Flat faces, corners and curved faces stay as they
/// are.
template <int Dim>
void level_steps(const Lattice<Dim>& lattice, std::vector<CommonFacePiece<Dim>>& pieces);

}  // namespace tribo
