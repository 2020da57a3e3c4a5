// SPDX-License-Identifier: MIT
/// Where the contact conditions hold if the command file does not say it: at nodes or at faces.
#pragma once

#include "grid/lattice.hpp"
#include "model/model.hpp"
#include "particles/seeds.hpp"

#include <vector>

namespace tribo {

/// Whether contact impulses act on faces or on nodes, and why.
///
/// With impulses on nodes, the cells next to a face move as one: a body of few cells, or one between rigid bodies, is
/// far too stiff, and friction acts within a body, so that it turns a ball too little. With impulses on faces all this
/// is right, at a higher cost and without the numerical damping.
struct ImpulseChoice {
  bool at_faces = false;
  std::string reason;  ///< "on faces, because 'plate' is 1 cell thick"; empty without contact
};

/// The end of a reason for a choice that a user should examine.
inline constexpr const char* faces_may_be_better = "so that its contact is too stiff; Impulses='faces' may be better";

/// The choice of the command file. Without one, faces if a deformable body touches another one at the start and is at
/// most three cells thick behind its face there, or lies between faces of rigid bodies on opposite sides; bodies with a
/// joint or an interface between them do not touch in this sense. Faces, too, if a body in contact is curved or
/// inelastic or the shape functions are splines, unless more than 16 deformable bodies are in contact or the model has
/// cracks, joints, interface laws or films of liquid. Of models with rigid blocks and none of these, those in which a
/// disc or a ball may touch bodies in the grid. Nodes otherwise, and wherever normals and gaps are not found from the
/// particle domains.
template <int Dim>
ImpulseChoice choose_impulses(const Model& model, const Seeds& seeds, const Lattice<Dim>& lattice);

}  // namespace tribo
