// SPDX-License-Identifier: MIT
/// Contact between materials.
#pragma once

#include "base/statement.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tribo {

class ContactLaw;
class JointLaw;

/// Method for the contact normal between two bodies at a node.
enum class NormalMethod {
  margin,    ///< plane with the largest margin between the particle domains; exact for flat faces
  logistic,  ///< logistic regression of the particle positions
  linear,    ///< linear regression of the particle positions
  average,   ///< mean of both volume gradients
  steepest,  ///< the volume gradient of larger magnitude
  largest,   ///< the volume gradient of the body with the larger volume at the node
  own,       ///< the volume gradient of the deformable body; of two deformable bodies, the one defined first
  specified
};
/// Method for the gap between two bodies at a node.
enum class Separation { edges, positions, displacements };

/// Contact between materials.
struct ContactSpec {
  bool active = false;
  NormalMethod normals = NormalMethod::margin;
  Separation separation = Separation::edges;
  double position = 0.8;    ///< Separation::positions: distance in cells at which bodies touch, or minus an exponent
  double rigid_bias = 1.0;  ///< weight of the volume gradient of a rigid body
  Vec3 direction = Vec3::UnitX();  ///< specified normal
  /// Impulses: whether the contact conditions hold at faces, between nodes; unset: see choose_impulses().
  std::optional<bool> at_faces;
  std::shared_ptr<const ContactLaw> default_law;
  std::map<std::pair<int, int>, std::shared_ptr<const ContactLaw>>
      pair_laws;  ///< by pair of materials, smaller index first; the same twice: between the bodies of a material
  /// A joint law that is assigned to a pair of materials.
  struct Joint {
    std::shared_ptr<const JointLaw> law;
    std::array<int, 2> materials{};  ///< materials of body 1 and body 2
    Origin origin;
  };
  /// Joint laws by pair of materials, smaller index first. They act where the faces touch at the start.
  std::map<std::pair<int, int>, Joint> joints;
  /// By entry of Model::materials: the material whose laws act. Each body of a material whose bodies touch each other
  /// has an entry of its own, after all others. Empty: there are none.
  std::vector<int> kinds;
  int kind(int material) const { return kinds.empty() ? material : kinds[static_cast<std::size_t>(material)]; }
  bool keeps_memory = false;  ///< a law of some stage of the run has a memory, so particles have columns for it
  /// The contact law of a pair, which acts where there is no joint. Of a material with itself: between its bodies.
  const ContactLaw* law(int a, int b) const {
    a = kind(a), b = kind(b);
    const auto found = pair_laws.find({std::min(a, b), std::max(a, b)});
    return (found == pair_laws.end() ? default_law : found->second).get();
  }
};

}  // namespace tribo
