// SPDX-License-Identifier: MIT
/// Joints in the grid: points on cracks and between bodies with a joint law and its history variables.
///
/// The velocities of the two faces at a joint are interpolated from the nodes, and the force of the joint is
/// distributed to the nodes with the same weights. The work of the joint is therefore equal and opposite to that of
/// the nodal forces. The joint law is evaluated once per step, after the momentum update, and its force acts in the
/// next step.
///
/// A joint between bodies moves with the mean velocity of both faces, and its normal rotates with them. Once one of
/// its faces has moved away, the joint is permanently inactive. The contact law of the two bodies then acts there, as
/// at all nodes out of the range of joints.
#pragma once

#include "solver/cracks/cracks.hpp"
#include "solver/joints/face_nodes.hpp"
#include "solver/joints/sample_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tribo {

/// An event at a joint, with its time and place, for the list of events.
struct PlacedEvent {
  double time = 0.0;
  std::size_t surface = 0;
  Vec3 x = Vec3::Zero();
  JointEvent event;  ///< `event.contact` is the number of the joint on the surface
};

/// All joints of a system.
template <int Dim>
class Joints {
 public:
  Joints(const Model& model, System<Dim>& system, const Cracks<Dim>& cracks);

  bool active() const { return !system_.joints.empty(); }
  /// Finds the nodes and weights of all integration points, and the stable time step. To be called once the nodal
  /// masses of a step are known.
  void find();
  /// A joint between two bodies near a node: the distance along the face [length] and the normal. The distance is
  /// infinite if the node is out of the range of all joints with both faces.
  struct NearJoint {
    double distance = std::numeric_limits<double>::infinity();
    Vec<Dim> normal = Vec<Dim>::Zero();
  };
  /// The joint that is closest to the position `node` [length], or the first one that is found not farther than
  /// `close_enough` [length]. The bodies are identified by their velocity fields. To be called after find().
  NearJoint near_joint(std::size_t field_a, std::size_t field_b, const Vec<Dim>& node, double close_enough) const;
  /// Adds the joint forces to the nodal accelerations, and their effect over a time dt to the nodal velocities.
  void add_forces(double dt);
  /// Finds the velocities of the faces from those of the nodes. `filtered`: from the filtered velocities
  /// (Field::filter).
  void find_motion(bool filtered);
  /// Computes the displacement increments of the joints from the velocities that find_motion() found and evaluates the
  /// joint laws. To be called wherever the strain of the particles is updated, with the same velocities and the same
  /// share dt of the step: otherwise the jump of a joint and the strain next to it belong to different velocities,
  /// which adds energy. `time`: at the end of this share.
  void update_laws(double dt, double time);
  /// Updates positions and axes of the joints with the velocities that find_motion() found. To be called after cracks
  /// have moved, which they do with the same velocities.
  void move_points(double dt);
  /// Largest stable time step with all joints [time], computed by the last find(); infinite without joints.
  double stable_step() const { return stable_step_; }

  /// For the first step after joints have become stiffer by this factor.
  void stiffened(double factor) { stable_step_ /= std::sqrt(std::max(1.0, factor)); }

  struct Energies {
    double stored = 0.0;      ///< elastic energy of the joints [energy]
    double dissipated = 0.0;  ///< dissipated by friction, dashpots and broken bonds [energy]
    double slip = 0.0;        ///< the part of it that friction dissipated [energy]
    double dashpot = 0.0;     ///< the part of it that dashpots dissipated [energy]
    double decohesion = 0.0;  ///< the part of it that cohesive zones dissipated [energy]
  };
  Energies energies() const;
  /// Returns the events since the last call and clears the list.
  std::vector<PlacedEvent> take_events();
  /// Calls f(field of body 1, field of body 2, force on body 1, closed area, stored energy of an imperfect
  /// interface) for every surface of joints between bodies, and for every imperfect interface on a crack, for which the
  /// first field is the number of fields plus that of the crack, the second the number of fields.
  template <class F>
  void each_pair(F&& f) const {
    for (std::size_t s = 0; s < system_.joints.size(); ++s) {
      const JointSurface<Dim>& surface = system_.joints[s];
      const bool of_crack = surface.crack != JointSurface<Dim>::none;
      if (of_crack && !surface.interface) continue;
      Vec3 force = Vec3::Zero();
      double area = 0.0, stored = 0.0;
      for (std::size_t k = 0; k < surface.joints.size(); ++k)
        if (is_supported(s, k))
          force -= surface.force(k), area += surface.joints[k].away ? 0.0 : surface.joints[k].area;
      if (surface.interface)
        for (const Joint& joint : surface.joints) stored += joint.strain;
      const std::size_t fields = system_.fields.size();
      f(of_crack ? fields + surface.crack : surface.field[0], of_crack ? fields : surface.field[1], force, area,
        stored);
    }
  }
  /// Work of rigid bodies on joints and the impulse of rigid bodies transferred by joints since the last call [energy,
  /// momentum].
  std::pair<double, Vec3> take_rigid_exchange() { return std::exchange(rigid_, {0.0, Vec3::Zero()}); }

  /// Saves and restores the stable step. The joints are part of the system; all other members are computed in every
  /// step or are emptied before it ends.
  friend void archive(Archive& a, Joints& joints) {
    auto& [system, face_nodes, surfaces, slabs, row_sums, largest_of_slab, increments, events_of_part, events,
           rigid_sums, reach, points, points_of, stable] = joints;
    a.version(1);
    a("stable_step", stable);
  }

 private:
  using Share = NodeWeight<Dim>;
  static constexpr std::ptrdiff_t fewest_for_threads = 64;  ///< joints or points; fewer are not worth several threads
  /// Velocity of a face and its gradient.
  struct Motion {
    Vec<Dim> velocity = Vec<Dim>::Zero();
    Mat<Dim> gradient = Mat<Dim>::Zero();
  };
  /// The nodes around an integration point and the motion of its two faces.
  struct SampleNodes {
    /// Nodes of body 1 and body 2; empty: the face has moved away.
    std::array<std::vector<Share>, 2> side;
    NodeRange<Dim> range;
    std::array<Motion, 2> motion;
    double scaled_sum = 0.0;  ///< of the amounts of the weights times the roots of the mobilities
    double sum = 0.0;         ///< of the amounts of the weights
    bool has_both_faces() const { return !side[0].empty() && !side[1].empty(); }
  };
  /// What an integration point contributes to a joint.
  struct Contribution {
    std::uint32_t sample;
    double fraction;  ///< of the surface area of the joint
  };
  /// Data of one surface of joints within a step.
  struct Surface {
    std::vector<SampleNodes> samples;
    /// The integration points in an order in which successive ones have about the same nodes.
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> first;         ///< per joint, and after the last: its first entry in `contributions`
    std::vector<Contribution> contributions;  ///< joint by joint
    std::vector<double> supported_fraction;   ///< per joint: fraction of its surface with both faces
    std::vector<double> row;                  ///< scratch: per joint
    /// Per joint, if its law has dashpots: reduced mass of the parts of the two faces that move with it [mass].
    std::vector<double> mass;
    std::vector<std::array<Motion, 2>> motion;  ///< per joint
  };
  Node& node(const Share& share) const {
    return system_.fields[share.field].nodes[static_cast<std::size_t>(share.node)];
  }
  bool rigid(const JointSurface<Dim>& surface, std::size_t side) const {
    return surface.crack == JointSurface<Dim>::none && system_.fields[surface.field[side]].rigid_contact;
  }
  bool is_supported(std::size_t surface, std::size_t joint) const {
    return surfaces_[surface].supported_fraction[joint] > 0.25;
  }
  std::pair<Vec<Dim>, Vec<Dim>> place(const JointSurface<Dim>& surface, std::size_t sample) const;
  static bool extrapolates(const std::vector<Share>& side);
  void find_nodes(std::size_t surface);
  void order_samples(std::size_t surface);
  void list_contributions(std::size_t surface);
  void schedule();
  /// Calls f(joint) for all joints of a surface, on several threads.
  template <class F>
  void each_joint(std::size_t surface, F&& f) {
    parallel_for(
        static_cast<std::ptrdiff_t>(system_.joints[surface].joints.size()),
        [&](std::ptrdiff_t joint) { f(static_cast<std::size_t>(joint)); }, fewest_for_threads);
  }
  /// Calls f(nodes, area fraction) for the integration points of a joint that have both faces.
  template <class F>
  void each_contribution(std::size_t s, std::size_t joint, F&& f) const {
    const Surface& surface = surfaces_[s];
    for (std::size_t i = surface.first[joint]; i < surface.first[joint + 1]; ++i) {
      const SampleNodes& nodes = surface.samples[surface.contributions[i].sample];
      if (nodes.has_both_faces()) f(nodes, surface.contributions[i].fraction);
    }
  }
  /// Calls f(slab, surface, nodes, joint, area fraction), which may add to the nodes, for the joints of all integration
  /// points with both faces.
  template <class F>
  void add_to_nodes(F&& f) {
    slabs_.each([&](std::size_t slab, std::uint32_t s, std::uint32_t k) {
      const JointSample<Dim>& sample = system_.joints[s].samples[k];
      for (std::size_t c = 0; c < sample.area_fraction.size(); ++c)
        if (sample.area_fraction[c] > 0) f(slab, s, surfaces_[s].samples[k], sample.joint[c], sample.area_fraction[c]);
    });
  }
  template <class F>
  void each_point(F&& f) const;
  void list_points();
  void find_stable_step();
  template <class Row, class Column>
  double find_row_sums(const Row& row, const Column& sum_of_columns);
  void clear_row_sums();
  double find_masses(double ratio);
  void record_rigid_work(std::size_t surface, const std::vector<Vec3>& before, double dt);
  Motion motion(const std::vector<Share>& shares, bool filtered) const;
  void find_motion_of(std::size_t surface, bool filtered);
  void find_increments(std::size_t surface, double dt, double time);
  void evaluate_law(std::size_t surface, double time);
  static void release(Joint& joint);
  void prescribe_face_velocities(std::size_t surface);
  void copy_to_crack(const JointSurface<Dim>& surface);

  System<Dim>& system_;
  FaceNodes<Dim> face_nodes_;
  std::vector<Surface> surfaces_;
  SampleSlabs<Dim> slabs_;                               ///< the integration points with both faces
  std::vector<std::vector<double>> row_sums_;            ///< scratch: per field and node, see find_row_sums()
  std::vector<double> largest_of_slab_;                  ///< scratch: of the row sums
  std::vector<JointIncrement> increments_;               ///< scratch
  std::vector<std::vector<JointEvent>> events_of_part_;  ///< scratch
  std::vector<PlacedEvent> events_;
  std::pair<double, Vec3> rigid_{0.0, Vec3::Zero()};
  struct PointOf {
    std::uint32_t surface, joint;
  };
  struct PointRange {
    std::uint32_t first, end;
  };
  double reach_ = 0.0;           ///< largest distance along an axis between a joint and the nodes in its range [length]
  std::vector<PointOf> points_;  ///< joints between bodies that have both faces, in the order of their blocks
  BlockTable<Dim, PointRange> points_of_{PointRange{0, 0}};  ///< per block: range of points_
  double stable_step_ = std::numeric_limits<double>::max();
};

}  // namespace tribo
