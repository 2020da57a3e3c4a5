// SPDX-License-Identifier: MIT
/// Joints in the grid: points on cracks and between bodies that carry a joint law and what it remembers.
///
/// A point takes the velocities of its two faces from the nodes and gives them its force, with the same weights, so
/// that what the joint gains the nodes lose. The law runs once per step, after the velocities are known; its force acts
/// in the next one.
///
/// Between bodies a point moves with the mean of both faces and its normal turns with them. Once one of its faces has
/// gone it is finished for good: the contact law of the two bodies takes over, there and wherever else they meet.
#pragma once

#include "solver/cracks/cracks.hpp"
#include "solver/neighbours/nodes_around.hpp"

#include <limits>
#include <utility>

namespace tribo {

/// Something that happened at a joint, as it goes to the list of events.
struct PlacedEvent {
  double time = 0.0;
  std::size_t surface = 0;
  Vec3 x = Vec3::Zero();
  JointEvent event;  ///< `contact` numbers the points of the surface
};

template <int Dim>
class Joints {
 public:
  Joints(const Model& model, System<Dim>& system, const Cracks<Dim>& cracks);

  bool active() const { return !system_.joints.empty(); }
  /// Finds the nodes of all points; once the masses of a step are known.
  void find();
  /// The point between two bodies, given by their fields, that is nearest to a node, along the face: how far, and the
  /// normal there; infinity if the node is out of reach of all points that still have both faces [length]. After
  /// find().
  struct NearestJoint {
    double distance = std::numeric_limits<double>::infinity();
    Vec<Dim> normal = Vec<Dim>::Zero();
  };
  NearestJoint nearest_joint(std::size_t field_a, std::size_t field_b, const Vec<Dim>& node) const;
  /// The forces of the joints on velocities and accelerations of the nodes.
  void add_forces(double dt);
  /// What the faces do in this step, and what the law makes of it; before anything moves.
  void update_laws(double dt);
  /// Where the points are after cracks have moved.
  void move_points(double dt);
  /// Largest step that is stable with all joints, as find() last saw them; infinity without.
  double stable_step() const { return stable_step_; }

  struct Energies {
    double stored = 0.0;  ///< in the springs
    double lost = 0.0;    ///< friction, dashpots, broken bonds
  };
  Energies energies() const;
  /// Events since the last call.
  std::vector<PlacedEvent> take_events();
  /// Calls f(field of body 1, field of body 2, force on body 1, area that is not open) for the joints between bodies.
  template <class F>
  void each_pair(F&& f) const {
    for (std::size_t s = 0; s < system_.joints.size(); ++s) {
      const JointSurface<Dim>& surface = system_.joints[s];
      if (surface.crack != JointSurface<Dim>::none) continue;
      Vec3 force = Vec3::Zero();
      double area = 0.0;
      for (std::size_t k = 0; k < surface.joints.size(); ++k)
        if (is_supported(s, k))
          force -= surface.force(k), area += surface.joints[k].away ? 0.0 : surface.joints[k].area;
      f(surface.home[0], surface.home[1], force, area);
    }
  }
  /// Work that rigid bodies did on joints, and momentum they gave through them, since the last call [energy, momentum].
  std::pair<double, Vec3> take_rigid_exchange() { return std::exchange(rigid_, {0.0, Vec3::Zero()}); }

  /// The joints themselves belong to the system; all else but the stable step is found anew in every step, or taken
  /// from here before the step ends.
  friend void archive(Archive& a, Joints& joints) {
    auto& [system, cracks, around, surfaces, stiffness, row, increments, happened, events, rigid_sums, reach, points,
           listed, stable] = joints;
    a.version(1);
    a("stable_step", stable);
  }

 private:
  /// One field at one node, as a point sees it.
  struct NodeShare {
    std::uint32_t field;
    std::int64_t node;  ///< position in the field's layers
    double weight;      ///< of its velocity in the point's, and of the point's force on it
    double images;      ///< how many of the point's images push the node with it
    Vec<Dim> slope;     ///< of its velocity in the gradient of the velocities there
    Vec<Dim> mirror;    ///< factors of vectors if the node stands for its image in a symmetry plane
  };
  struct Motion {
    Vec<Dim> velocity = Vec<Dim>::Zero();
    Mat<Dim> gradient = Mat<Dim>::Zero();
  };
  /// Of a sample.
  struct SampleNodes {
    std::array<std::vector<NodeShare>, 2> side;  ///< of body 1 and 2; empty: nothing is there
    std::array<Motion, 2> motion;
    double mass = 0.0;  ///< reduced, of the two faces
    bool whole() const { return !side[0].empty() && !side[1].empty(); }
  };
  struct Surface {
    std::vector<SampleNodes> samples;
    std::vector<double> supported;              ///< per joint: part of its surface that has both faces
    std::vector<std::array<Motion, 2>> motion;  ///< per joint
  };
  Node& node(const NodeShare& share) const {
    return system_.fields[share.field].nodes[static_cast<std::size_t>(share.node)];
  }
  /// 0 of rigid bodies.
  double inverse_mass(const NodeShare& share) const {
    return system_.fields[share.field].rigid_contact ? 0.0 : 1.0 / node(share).mass;
  }
  bool rigid(const JointSurface<Dim>& surface, std::size_t side) const {
    return surface.crack == JointSurface<Dim>::none && system_.fields[surface.home[side]].rigid_contact;
  }
  bool is_supported(std::size_t surface, std::size_t joint) const { return surfaces_[surface].supported[joint] > 0.25; }
  std::pair<Vec<Dim>, Vec<Dim>> place(const JointSurface<Dim>& surface, std::size_t sample) const;
  double find_side(const JointSurface<Dim>& surface, const Vec<Dim>& x, const Vec<Dim>& n, std::size_t side,
                   std::vector<NodeShare>& out) const;
  template <class F>
  void each_part(std::size_t surface, F&& f);
  void list_points();
  void find_stable_step();
  void record_rigid_work(std::size_t surface, const std::vector<Vec3>& before, double dt);
  Motion motion(const std::vector<NodeShare>& shares) const;
  void update(JointSurface<Dim>& surface, std::size_t s, std::size_t first, std::size_t end, double dt);
  static void release(Joint& joint);
  void lead_faces(std::size_t surface);
  void copy_to_crack(const JointSurface<Dim>& surface);

  System<Dim>& system_;
  const Cracks<Dim>& cracks_;
  NodesAround<Dim> around_;
  std::vector<Surface> surfaces_;
  std::vector<std::vector<double>> stiffness_;  ///< scratch: per field and node
  std::vector<double> row_;                     ///< scratch: per joint
  std::vector<JointIncrement> increments_;      ///< scratch
  std::vector<JointEvent> new_events_;          ///< scratch
  std::vector<PlacedEvent> events_;
  std::pair<double, Vec3> rigid_{0.0, Vec3::Zero()};
  struct PointOf {
    std::uint32_t surface, joint;
  };
  double reach_ = 0.0;                                 ///< of the nodes that feel a point, along any axis [length]
  std::vector<std::vector<PointOf>> points_of_block_;  ///< per block: points between bodies that have both faces
  std::vector<std::int64_t> listed_blocks_;            ///< blocks that have some
  double stable_step_ = std::numeric_limits<double>::infinity();
};

}  // namespace tribo
