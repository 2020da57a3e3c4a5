// SPDX-License-Identifier: MIT
/// One explicit step of the material point method. The algorithm is Stepper::advance in step.cpp; its parts are in
/// step_nodes.cpp, step_particles.cpp and step_records.cpp.
#pragma once

#include "solver/boundary/nodal_conditions.hpp"
#include "solver/contact/contact.hpp"
#include "solver/cracks/crack_tips.hpp"
#include "solver/cracks/cracks.hpp"
#include "solver/distribution/distribution.hpp"
#include "solver/heat/heat.hpp"
#include "solver/heat/temperature_ramps.hpp"
#include "solver/joints/interface_faces.hpp"
#include "solver/joints/joints.hpp"
#include "solver/loads/body_forces.hpp"
#include "solver/loads/damping.hpp"
#include "solver/loads/nodal_work.hpp"
#include "solver/loads/particle_loads.hpp"
#include "solver/loads/tractions.hpp"
#include "solver/opening_average.hpp"
#include "solver/particle_sort.hpp"
#include "solver/particle_splitting.hpp"
#include "solver/rigid/rigid_blocks.hpp"
#include "solver/rigid/rigid_bodies.hpp"
#include "solver/state/system_loops.hpp"
#include "solver/state/travel.hpp"
#include "solver/transfer/affine_at_walls.hpp"
#include "solver/transfer/b_bar.hpp"
#include "solver/transfer/system_transfers.hpp"
#include "solver/velocity_filter.hpp"

namespace tribo {

/// Time spent in the parts of the step [s].
struct StepWatches {
  Stopwatch all, sort, scatter, grid, gather;
};

/// Advances a system by time steps and owns all parts of the algorithm.
template <int Dim>
class Stepper {
 public:
  /// Throws InputError if a nodal condition, a temperature condition or a load selects no node or particle.
  Stepper(const Model& model, System<Dim>& system);

  /// Advances the system by dt [time]. Sorts the particles first if one of them may have moved by a cell since the
  /// last sort. Throws SimulationError if a particle left the grid or a value is not finite.
  void advance(double dt);
  /// Sorts the particles if that is due.
  void sort_if_due() {
    if (sort_.is_due()) sort();
  }
  /// Before the first step of a run in several processes, while each has all particles: divides them.
  void distribute();
  /// Rebuilds blocks and nodes for the present bins; needed after a restart.
  void locate_nodes();

  /// To be called before the last step of a stage is saved: forgets what depends on the model of the next one.
  void end_stage() { contact_.forget_faces(), system_.sorted = false; }
  /// The next step is the first one with other conditions on nodes, or with particles that were placed: what the
  /// conditions change then is a reaction, as in the first step of a run.
  void expect_jump() { jump_ = true; }

  /// From now on each step measures its balance of forces, for unbalanced_ratio().
  void measure_balance() { measures_balance_ = true; }
  /// Of the last step: the sum of the magnitudes of the unbalanced nodal forces, m |a|, over that of the internal and
  /// external ones, |f| + m |g|.
  double unbalanced_ratio() const { return unbalanced_ratio_; }

  /// Nodal conditions and image exchange of a velocity field.
  NodalConditions<Dim>& conditions(std::size_t field) { return conditions_[field]; }
  const Exchange<Dim>& exchange(std::size_t field) const { return *exchanges_[field]; }
  const Transfers<Dim>& transfers() const { return *transfers_; }
  EnergyLedger& ledger() { return ledger_; }
  Contact<Dim>& contact() { return contact_; }
  const Contact<Dim>& contact() const { return contact_; }
  Joints<Dim>& joints() { return joints_; }
  const Joints<Dim>& joints() const { return joints_; }
  HeatConduction<Dim>& heat() { return heat_; }
  const HeatConduction<Dim>& heat() const { return heat_; }
  VelocityDamping<Dim>& damping() { return damping_; }
  ParticleLoads<Dim>& loads() { return loads_; }
  VelocityFilter<Dim>& filter() { return filter_; }
  const VelocityFilter<Dim>& filter() const { return filter_; }
  ParticleSort<Dim>& particle_sort() { return sort_; }
  const ParticleSplitting<Dim>& splitting() const { return splitting_; }
  Distribution<Dim>& distribution() { return distribution_; }
  const Distribution<Dim>& distribution() const { return distribution_; }
  /// Kinetic energy of the nodes at the end of the last step [energy]. While a rank computes alone, it is the one that
  /// all ranks found together in keep_grid_kinetic().
  double grid_kinetic();
  void keep_grid_kinetic() { grid_kinetic_.reset(), grid_kinetic_ = grid_kinetic(); }
  void forget_grid_kinetic() { grid_kinetic_.reset(); }
  const RigidBodies<Dim>& rigid_bodies() const { return rigid_bodies_; }
  const StepWatches& watches() const { return watches_; }

  /// Saves and restores all data that change from step to step, including the system. To restore, the stepper must
  /// have been constructed from the same model.
  friend void archive(Archive& a, Stepper& stepper) {
    auto& [model, system, loops, ledger, watches, transfers, distribution, of_all, sort, splitting, exchanges,
           conditions, cracks, crack_tips, interface_faces, joints, contact, loads, tractions, body_forces, nodal_work,
           damping, rigid_bodies, rigid_blocks, heat, ramps, affine_at_walls, b_bar, openings, filter, jump, measures,
           ratio, travel, grid_kinetic] = stepper;
    a.version(5);
    a("system", system);
    a("ledger", ledger), a("sort", sort), a("splitting", splitting), a.each("conditions", conditions),
        a("interface_faces", interface_faces), a("joints", joints);
    a("contact", contact), a("loads", loads), a("damping", damping), a("heat", heat), a("filter", filter);
    if (a.reading() && system.sorted) stepper.locate_nodes();
    a.enter("kept"), contact.archive_kept(a), a.leave();
  }

 private:
  /// Which quantity the nodes store before the momentum update.
  enum class Known { momentum, velocity };

  bool stress_last() const { return model_.scheme.order == UpdateOrder::usl; }
  // Whether the particles are strained by velocities that are extrapolated again after their update.
  bool extrapolates_again() const { return model_.scheme.extrapolate_again && model_.scheme.order != UpdateOrder::usf; }
  // Whether FMPM filters the velocities after the momentum update in this step.
  bool filters_update() const { return filter_.active() && model_.scheme.transfer == Transfer::fmpm; }
  double strain_time(double dt) const;
  double flip_share() const;

  // step.cpp
  void begin_step();
  void transfer_to_nodes(double dt);
  void update_stress_first(double dt);
  void update_from_nodes(double dt);
  void strain_again(double dt, double strain_dt);
  void move_rigid_blocks(double dt);
  void measure_crack_tips(double dt);
  void grow_cracks();
  void end_step(double dt);

  // step_nodes.cpp
  void sort();
  BlockTable<Dim, std::uint64_t> around_own_particles() const;
  void zero_nodes();
  void scatter(Scatter what);
  // What a scatter of mass and momentum adds besides the sums over the particles of deformable bodies.
  void scatter_rest(bool from_start);
  void sum_images(ImageValues values);
  void copy_images();
  void divide_by_mass();
  void find_contact();
  void update_momentum(double dt, Known known);
  void add_joint_forces(double dt);
  void impose(double time, double dt);
  void impose_update(double dt, bool after_impose);

  // step_particles.cpp
  // `with_forces`: scatters the forces of the new stress, too.
  void strain(double dt, bool from_start, bool with_forces = false);
  double damping_of(const Body<Dim>& body) const;
  void damp_particles(double dt);
  // `with_momentum`: scatters the mass and the new momentum to Field::nodes_again, too.
  void move_particles(double dt, double strain_dt, bool with_momentum);
  void stop_if_invalid(const std::vector<GatherResult>& gathered);
  Target<Dim> nodes_of(const Body<Dim>& body) { return {body, system_.fields, &Field<Dim>::nodes}; }
  Gather gather_options() const;

  // step_records.cpp
  void record_update(double dt);
  void record_changes(double dt);
  void record_balance();
  void record_joints();

  const Model& model_;
  System<Dim>& system_;
  SystemLoops<Dim> loops_;
  EnergyLedger ledger_;
  StepWatches watches_;
  std::unique_ptr<Transfers<Dim>> transfers_;
  Distribution<Dim> distribution_;
  SystemTransfers<Dim> of_all_;  // the transfers of all bodies
  ParticleSort<Dim> sort_;
  ParticleSplitting<Dim> splitting_;
  Exchanges<Dim> exchanges_;                      // per velocity field
  std::vector<NodalConditions<Dim>> conditions_;  // per velocity field
  Cracks<Dim> cracks_;
  CrackTips<Dim> crack_tips_;
  InterfaceFaces<Dim> interface_faces_;
  Joints<Dim> joints_;
  Contact<Dim> contact_;
  ParticleLoads<Dim> loads_;
  Tractions<Dim> tractions_;
  BodyForces<Dim> body_forces_;
  NodalWork<Dim> nodal_work_;
  VelocityDamping<Dim> damping_;
  RigidBodies<Dim> rigid_bodies_;
  RigidBlocks<Dim> rigid_blocks_;
  HeatConduction<Dim> heat_;
  TemperatureRamps<Dim> ramps_;
  AffineAtWalls<Dim> affine_at_walls_;
  BBar<Dim> b_bar_;
  OpeningAverage<Dim> openings_;
  VelocityFilter<Dim> filter_;
  bool jump_ = false, measures_balance_ = false;
  double unbalanced_ratio_ = 0.0;
  Travel travel_;  // of the last step
  std::optional<double> grid_kinetic_;
};

}  // namespace tribo
