/// One explicit step. The algorithm is in step.cpp, on one screen.
#pragma once

#include "solver/b_bar.hpp"
#include "solver/contact.hpp"
#include "solver/cracks.hpp"
#include "solver/fracture.hpp"
#include "solver/heat.hpp"
#include "solver/joints.hpp"
#include "solver/rigid_blocks.hpp"
#include "solver/transfer.hpp"

namespace tribo {

/// Energy and momentum that entered or left during the run, besides the nodal conditions.
struct Ledger {
  double external_work = 0.0;   ///< by body forces, loads and tractions        [energy]
  double damping_work = 0.0;    ///< taken out by damping, >= 0                 [energy]
  double rigid_work = 0.0;      ///< by rigid particles                         [energy]
  Vec3 impulse = Vec3::Zero();  ///< of all of these                            [momentum]
};

/// Where the time of the steps goes.
struct StepWatches {
  Stopwatch all, sort, scatter, grid, filter, gather;
};

template <int Dim>
class Stepper {
 public:
  Stepper(const Model& model, System<Dim>& system);

  /// Advances by dt: sorts if some particle may have left its bin's reach, then one step of the chosen order.
  /// Throws SimulationError if a particle left the grid or something is not a number.
  void advance(double dt);

  Conditions<Dim>& conditions(std::size_t field) { return conditions_[field]; }
  /// Force of the rigid bodies, in their order, on the material in the last step [force].
  const std::vector<Vec3>& rigid_reactions() const { return rigid_reactions_; }
  Ledger& ledger() { return ledger_; }
  const Transfers<Dim>& transfers() const { return *transfers_; }
  Contact<Dim>& contact() { return contact_; }
  const Contact<Dim>& contact() const { return contact_; }
  Joints<Dim>& joints() { return joints_; }
  const Joints<Dim>& joints() const { return joints_; }
  const StepWatches& watches() const { return watches_; }
  HeatConduction<Dim>& heat() { return heat_; }
  const HeatConduction<Dim>& heat() const { return heat_; }
  /// Rebuilds blocks and nodes for the present bins; needed after a restart.
  void allocate();
  /// Coefficient of grid and particle damping with feedback, kept for restart.
  double grid_damping = 0.0, particle_damping = 0.0;
  double grid_feedback = 0.0, particle_feedback = 0.0;  ///< part of the above that feedback built up
  /// Times a particle was returned to the grid, see Model::leave_limit.
  long pushed_back = 0;
  /// Time of the next filtered step when filters run by period; kept for restart.
  double next_filter = 0.0;

 private:
  void sort();
  void push_back(Body<Dim>& body);
  void push_joints(double dt, bool find);
  void book_joints();
  void apply_body_force(std::size_t field, double dt);
  Vec3 body_force_at(const Vec<Dim>& x, double dt) const;
  void load_tips(double dt);
  void grow_cracks();
  void account_body_force(double dt);
  void account_damping(std::size_t field, double dt);
  void account_particle_damping(const Body<Dim>& body, double rate, double dt);
  /// Work, and impulse.
  using Exchange = Eigen::Vector4d;
  template <class F>
  Exchange sum_over_nodes(std::size_t field, F&& term);
  void clear();
  void scatter(Scatter what, bool from_start = false);
  void divide_by_mass();
  /// What the nodes hold before the momentum update; forces always.
  enum class Known { momentum, velocity, velocity_and_folded_force };
  void accelerate(double dt, Known known);
  void filter(double dt, bool from_start);
  void use_filtered(double dt);
  void strain(double dt, bool from_start);
  void move(double dt, double strain_dt);
  void remember_positions();
  void remember_domains();
  Vec3 load_on(Body<Dim>& body, std::size_t i, double dt) const;
  void apply_loads(double dt);
  void account_loads(double dt);
  void apply_traction(const ParticleCondition& condition, Body<Dim>& body, std::size_t particle);
  void apply_tractions();
  void account_tractions(double dt);
  void follow_rigid(double dt);
  void move_rigid(double dt);
  void extend();
  void impose(double time, double dt);
  void impose_update(double dt, bool after_impose);
  void impose_rigid(std::size_t field, std::size_t rigid, double dt, bool update, bool after_impose);
  void impose_rigid(double dt, bool update, bool after_impose);
  Gather gather_options() const;
  [[noreturn]] void stop_at_bad_particle() const;
  bool filter_now();

  const Model& model_;
  System<Dim>& system_;
  std::unique_ptr<Transfers<Dim>> transfers_;
  std::vector<Conditions<Dim>> conditions_;
  Cracks<Dim> cracks_;
  Contact<Dim> contact_;
  Joints<Dim> joints_;
  RigidBlocks<Dim> blocks_;
  Fracture<Dim> fracture_;
  HeatConduction<Dim> heat_;
  BBar<Dim> b_bar_;
  Ledger ledger_;
  StepWatches watches_;
  bool filtering_ = false;             ///< XPIC or FMPM acts in this step
  std::vector<Vec3> rigid_reactions_;  ///< by rigid body
  double rigid_travel_ = 0.0;
  struct Push {
    std::size_t field;
    std::int64_t node;
    Vec<Dim> force;
  };
  std::vector<Push> pushes_;         ///< of the tractions in this step
  std::vector<double> sums_;         ///< per piece of a loop
  std::vector<Exchange> exchanges_;  ///< per block of nodes
  std::vector<double> load_share_;   ///< per particle condition: 1, or 1 / particles found for net loads
};

}  // namespace tribo
