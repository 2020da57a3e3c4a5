/// Symmetry planes, walls, periodic edges and prescribed velocities on the nodes of one field.
#pragma once

#include "grid/nodes.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace tribo {

/// What was scattered since the nodes were last folded.
enum class Fold {
  everything,
  forces,
  scalars,  ///< everything, and no component turns over in a mirror
  cells     ///< everything, of cells named after their lowest node: only periodic edges have any beyond
};

/// Nodal conditions of the model, translated to the nodes that exist at present.
template <int Dim>
class Conditions {
 public:
  /// Nodes are chosen once from the whole lattice. Throws InputError for a condition that selects no node, or a plane
  /// that is not a grid line.
  Conditions(const Model& model, const Lattice<Dim>& lattice);

  /// Finds the nodes among the blocks that exist; call after every change of the map.
  void locate(const BlockMap<Dim>& map);

  /// Brings what was scattered beyond a plane back inside. A symmetry plane adds the mirror image; a wall gives the
  /// boundary-modified shape functions, in which the node k beyond the wall stands for (k+1) v0 - k v1.
  /// Steffen, Kirby & Berzins (2008); exact for linear fields. On a periodic axis the nodes from the lowest to the last
  /// but one stand for all that are a whole number of periods away.
  void fold(NodeLayer& nodes, Fold what = Fold::everything) const;
  /// Adds what goes through the symmetry planes to their reactions; call with the forces that fold() is about to bring
  /// inside.
  void count_plane_forces(const NodeLayer& nodes);
  /// Takes what forces on nodes, as gravity, put across the symmetry planes out of velocities and accelerations there.
  void stay_on_planes(NodeLayer& nodes);
  /// Whether fold() brings this node's values inside.
  bool folds(const Index<Dim>& node) const;
  /// What a node counts in sums over nodes: nodes on symmetry planes carry their mirror images, too.
  double share(std::int64_t node) const { return share_.empty() ? 1.0 : share_[static_cast<std::size_t>(node)]; }
  /// Bits of the axes whose symmetry plane goes through this node.
  int mirrored(const Index<Dim>& node) const;
  /// The values beyond the planes that belong to the values inside. Inverse of fold in the sense of the transfers.
  void extend(NodeLayer& nodes, Fold what = Fold::everything) const;

  /// Sets velocities before a strain update and remembers the change.
  void impose(NodeLayer& nodes, double time, double dt);
  /// Sets velocities to those at time + dt after the momentum update. Accelerations follow the prescribed velocity from
  /// `time` to time + dt, not the difference that extrapolation left at a node: only in the `first` step, when a body
  /// may start with another velocity than its supports, is that difference part of the reaction.
  void impose_update(NodeLayer& nodes, double time, double dt, bool after_impose, bool first);
  /// Removes the constrained components from filter increments.
  void release(NodeLayer& nodes) const;

  /// Force of the symmetry plane at the low (0) or high (1) end of an axis on the material since begin_step() [force].
  double plane_reaction(int axis, int side) const;
  void begin_step() { std::fill(plane_reactions_.begin(), plane_reactions_.end(), 0.0); }
  /// Reaction force of the last step by condition [force], and work done on the material so far [energy].
  const std::vector<Vec3>& reactions() const { return reactions_; }
  double work() const { return work_; }
  void set_work(double work) { work_ = work; }
  /// Impulse of the conditions on the material so far, planes of symmetry and walls not included.
  const Vec3& impulse() const { return impulse_; }
  void set_impulse(const Vec3& impulse) { impulse_ = impulse; }

 private:
  enum class Edge { symmetry, wall, period };
  struct Plane {
    int axis, node, inward;  ///< inward: +1 at the low end, -1 at the high end; of a period its number of cells
    Edge kind;
  };
  // A ghost node k beyond a plane with its plane node and the node inside that it stands for in a mirror or a period,
  // or the first behind a wall.
  struct Ghost {
    std::int64_t ghost, plane, inside;
    int depth;
  };
  struct OnPlane {
    std::int64_t node;
    std::size_t plane;
  };
  // A node with the conditions on it that share a direction.
  struct Chosen {
    Index<Dim> node;
    Vec<Dim> direction;
    std::vector<std::size_t> conditions;
  };
  struct Located {
    std::int64_t node;
    std::size_t chosen;
    double pending = 0.0;
  };

  std::optional<Ghost> ghost_of(const Plane& plane, std::int64_t at, Index<Dim> node, const BlockMap<Dim>& map) const;
  double prescribed(const Chosen& chosen, const Vec<Dim>& x, double time, double dt) const;

  const Model& model_;
  Lattice<Dim> lattice_;
  std::vector<Plane> planes_;
  std::vector<Chosen> chosen_;
  std::vector<Located> located_;
  std::vector<std::vector<Ghost>> ghosts_;  ///< per plane
  std::vector<OnPlane> mirror_nodes_[3];    ///< nodes on symmetry planes, by axis
  std::vector<double> share_;               ///< empty without symmetry planes
  std::vector<double> plane_reactions_;     ///< per plane
  std::vector<Vec3> reactions_;
  double work_ = 0.0;
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace tribo
