// SPDX-License-Identifier: MIT
/// Nodes of a velocity field that represent the same degrees of freedom, the ownership of nodes, and sums over nodes.
///
/// A scatter also writes to nodes beyond symmetry planes, walls and periodic edges. These nodes are images: their
/// values are contributions to nodes inside. After every scatter the values of the images are added to the nodes
/// inside
/// (sum_images); before every gather the images receive the values of the nodes inside (copy_images). All sums over
/// nodes weight a node with its ownership, so that the mass of a node is counted once.
#pragma once

#include "solver/state/energy_ledger.hpp"
#include "solver/state/system.hpp"

#include <memory>

namespace tribo {

/// The kind of nodal values, which determines the treatment of images.
enum class ImageValues {
  /// Mass, momentum (or velocity) and force (or acceleration): normal components change sign in a mirror image.
  vectors,
  forces,   ///< the same, but only the forces were scattered since the last sum
  scalars,  ///< no component changes sign in a mirror image
  cells     ///< values of cells, stored at their lowest node: only periodic edges have images
};

/// The exchange of values between images and the nodes inside, for one velocity field.
template <int Dim>
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// Finds the images among the blocks that exist; to be called after every change of the field's map.
  virtual void locate(const BlockMap<Dim>& map) = 0;
  /// Adds the values of the images to the nodes inside, and sets the images to zero.
  virtual void sum_images(NodeNumbers nodes, ImageValues values = ImageValues::vectors) const = 0;
  /// Copies the values of the nodes inside to their images: the transpose of sum_images.
  virtual void copy_images(NodeNumbers nodes, ImageValues values = ImageValues::vectors) const = 0;
  /// The weight of a node (its position in the nodal arrays) in sums over nodes. A node on a symmetry plane also
  /// carries the mass of its mirror image, so its weight is reduced by one half for every such plane.
  virtual double ownership(std::int64_t node) const = 0;
  /// Whether there may be images. Then the exchange writes to nodes that no particle reaches.
  virtual bool has_images() const = 0;
  /// Whether this node is an image, which sum_images sets to zero.
  virtual bool is_image(const Index<Dim>& node) const = 0;
  /// Bit d is set if a symmetry plane normal to axis d passes through this node.
  virtual int mirrored_axes(const Index<Dim>& node) const = 0;
  /// Replaces a node beyond symmetry planes by its mirror image inside. Bit d of the result is set if the image is that
  /// in a plane normal to axis d, so that component d of a vector has the opposite sign there.
  virtual int reflect(Index<Dim>& node) const = 0;

  /// Sets the reactions of the symmetry planes to zero at the start of a step.
  virtual void begin_step() = 0;
  /// Adds the scattered forces that cross the symmetry planes to the reactions; to be called before sum_images.
  virtual void add_plane_reactions(const NodeLayer& nodes) = 0;
  /// Sets the velocities and accelerations normal to symmetry planes to zero at the nodes on them. The corresponding
  /// forces, for example by gravity, are added to the reactions.
  virtual void hold_planes(NodeLayer& nodes) = 0;
  /// Ends the step: adds the reactions of all processes.
  virtual void end_step() = 0;
  /// Force of the symmetry plane at the low (0) or high (1) end of an axis on the material in the last step [force].
  virtual double plane_reaction(int axis, int side) const = 0;
};

/// The exchange of a grid: OpenExchange if it has no plane, wall or periodic edge, else EdgeExchange. Throws InputError
/// for a plane that is not a grid line.
template <int Dim>
std::unique_ptr<Exchange<Dim>> make_exchange(const GridSpec& grid, const Lattice<Dim>& lattice);

/// The exchanges of all velocity fields, by number of the field.
template <int Dim>
using Exchanges = std::vector<std::unique_ptr<Exchange<Dim>>>;

}  // namespace tribo
