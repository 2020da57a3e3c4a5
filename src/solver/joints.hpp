/// Joints in the grid: points on cracks and between bodies that carry a joint law and what it remembers.
///
/// A point takes the velocities of its two faces from the nodes and gives them its force, with the same weights, so
/// that what the joint gains the nodes lose. The law runs once per step, after the velocities are known; its force acts
/// in the next one.
#pragma once

#include "solver/cracks.hpp"
#include "solver/nodes_around.hpp"

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
  /// The forces of the joints on velocities and accelerations of the nodes.
  void push(double dt);
  /// What the faces do in this step, and what the law makes of it; before anything moves.
  void follow(double dt);
  /// Where the points are after cracks have moved.
  void settle(double dt);
  /// Largest step that is stable with all joints, as find() last saw them; infinity without.
  double stable_step() const { return stable_step_; }
  void set_stable_step(double dt) { stable_step_ = dt; }

  struct Energies {
    double stored = 0.0;  ///< in the springs
    double lost = 0.0;    ///< friction, dashpots, broken bonds
  };
  Energies energies() const;
  /// Events since the last call.
  std::vector<PlacedEvent> take_events();

 private:
  /// One field at one node, as a point sees it.
  struct Share {
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
  struct Reach {
    std::array<std::vector<Share>, 2> side;  ///< of body 1 and 2; empty: nothing is there
    std::array<Motion, 2> motion;
    double mass = 0.0;  ///< reduced, of the two faces
    bool whole() const { return !side[0].empty() && !side[1].empty(); }
  };
  struct Surface {
    std::vector<Reach> samples;
    std::vector<double> held;                   ///< per joint: part of its surface that has both faces
    std::vector<std::array<Motion, 2>> motion;  ///< per joint
  };
  Node& node(const Share& share) const {
    return system_.fields[share.field].nodes[static_cast<std::size_t>(share.node)];
  }
  bool holds(std::size_t surface, std::size_t joint) const { return surfaces_[surface].held[joint] > 0.25; }
  std::pair<Vec<Dim>, Vec<Dim>> place(const JointSurface<Dim>& surface, std::size_t sample) const;
  double find_side(const JointSurface<Dim>& surface, const Vec<Dim>& x, const Vec<Dim>& n, std::size_t side,
                   std::vector<Share>& out) const;
  template <class F>
  void each_part(std::size_t surface, F&& f);
  void find_stable_step();
  Motion motion(const std::vector<Share>& shares) const;
  void update(JointSurface<Dim>& surface, std::size_t s, std::size_t first, std::size_t end, double dt);
  static void let_go(Joint& joint);
  void lead(std::size_t surface);
  void show(const JointSurface<Dim>& surface);

  System<Dim>& system_;
  const Cracks<Dim>& cracks_;
  NodesAround<Dim> around_;
  std::vector<Surface> surfaces_;
  std::vector<std::vector<double>> stiffness_;  ///< scratch: per field and node
  std::vector<double> row_;                     ///< scratch: per joint
  std::vector<JointIncrement> increments_;      ///< scratch
  std::vector<JointEvent> happened_;            ///< scratch
  std::vector<PlacedEvent> events_;
  double stable_step_ = std::numeric_limits<double>::infinity();
};

}  // namespace tribo
