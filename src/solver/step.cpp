#include "solver/step.hpp"

#include "base/parallel.hpp"
#include "solver/crossings.hpp"
#include "solver/loaded.hpp"
#include "solver/loops.hpp"
#include "solver/periodic.hpp"

#include <cmath>

namespace tribo {

// The step. Notation: w_Ip weights, S the gather (sum over nodes), S+ the scatter divided by nodal mass.
template <int Dim>
void Stepper<Dim>::advance(double dt) {
  const UpdateOrder order = model_.scheme.order;
  const bool again = model_.scheme.extrapolate_again && order != UpdateOrder::usf;
  const auto lap = watches_.all.lap();
  if (!system_.sorted || system_.drift >= 1.0 - 1e-6) sort();

  filtering_ = filter_now();

  // 1. Particles to nodes: mass and momentum; if stress comes last, forces in the same sweep
  remember_domains();
  cracks_.find();
  clear();
  apply_loads(dt);
  for (auto& conditions : conditions_) conditions.begin_step();
  follow_rigid(dt);
  if (order == UpdateOrder::usl) {
    scatter(Scatter::momentum_and_force);
    apply_tractions();
    if (contact_.keeps_start()) {
      divide_by_mass();
      joints_.find();
      contact_.find(conditions_, joints_);
      contact_.meet(dt, Contact<Dim>::Pass::start);
      accelerate(dt, Known::velocity_and_folded_force);
    } else {
      accelerate(dt, Known::momentum);
      contact_.find(conditions_, joints_);
    }
  } else {
    // 2. Stress first (or half of it): strain from the extrapolated velocities, made to obey contact
    scatter(Scatter::momentum);
    divide_by_mass();
    joints_.find();
    contact_.find(conditions_, joints_);
    contact_.meet(dt, Contact<Dim>::Pass::start);
    impose(system_.time, dt);
    extend();
    if (filtering_) filter(0.0, false);
    strain(order == UpdateOrder::usf ? dt : 0.5 * dt, false);
    if (!contact_.keeps_start()) contact_.part();
    scatter(Scatter::force);
    apply_tractions();
    accelerate(dt, Known::velocity);
  }

  // 3. The nodes now have  m a = f,  v += dt a; contact and prescribed velocities correct both
  contact_.meet(dt, Contact<Dim>::Pass::update);
  impose_update(dt, order != UpdateOrder::usl);
  account_tractions(dt);
  account_body_force(dt);

  // 4. XPIC and FMPM: sharper velocities than the lumped mass gives
  if (filtering_) {
    filter(dt, false);
    use_filtered(dt);
  }

  contact_.book(dt);
  blocks_.take(contact_.rigid_shares(), dt);
  load_tips(dt);
  heat_.conduct(dt, contact_, conditions_);

  // 5. Nodes to particles: velocity, position; stress last unless it waits for better velocities
  if (again) remember_positions();
  const double after = order == UpdateOrder::usl ? dt : order == UpdateOrder::usavg ? 0.5 * dt : 0.0;
  move(dt, again ? 0.0 : after);

  account_loads(0.5 * dt);

  // 6. "+" variants: strain from the velocities of the moved particles, with the weights of the step's start
  if (again) {
    clear();
    scatter(Scatter::momentum, true);
    divide_by_mass();
    contact_.meet(dt, Contact<Dim>::Pass::start);
    impose(system_.time + dt, dt);
    extend();
    if (filtering_) filter(0.0, true);
    strain(after, true);
  }

  system_.time += dt;
  ++system_.step;
  grow_cracks();
}

template <int Dim>
Stepper<Dim>::Stepper(const Model& model, System<Dim>& system)
    : model_(model),
      system_(system),
      transfers_(make_transfers<Dim>(model.scheme)),
      cracks_(model, system, *transfers_),
      contact_(model, system, *transfers_, cracks_),
      joints_(model, system, cracks_),
      blocks_(system),
      fracture_(model, system, cracks_, transfers_->stencil_width()),
      heat_(model, system, *transfers_),
      b_bar_(model.scheme, system, *transfers_, conditions_) {
  for (std::size_t f = 0; f < system.fields.size(); ++f) conditions_.emplace_back(model, system.lattice);
  load_share_ = find_loaded(model, system);
}

template <int Dim>
void Stepper<Dim>::sort() {
  const auto lap = watches_.sort.lap();
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (auto& body : *bodies) {
      bring_home(model_.grid, system_.lattice, body);
      if (body.bins.sort(system_.lattice, body.particles) >= 0) {
        push_back(body);
        if (body.bins.sort(system_.lattice, body.particles) >= 0) stop_at_bad_particle();
      }
    }
  allocate();
  system_.drift = 0.0;
  system_.sorted = true;
}

// Particles that left the grid return to its edge and lose the velocity that took them out, as often as the model
// allows.
template <int Dim>
void Stepper<Dim>::push_back(Body<Dim>& body) {
  if (!model_.leave_limit) stop_at_bad_particle();
  const auto x = body.particles.x(), v = body.particles.v();
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      const double inside = std::clamp(x[d][i], system_.lattice.low[axis], system_.lattice.high[axis]);
      if (x[d][i] == inside || !std::isfinite(x[d][i])) continue;
      if (++pushed_back > *model_.leave_limit) stop_at_bad_particle();
      x[d][i] = inside;
      v[d][i] = 0.0;
    }
}

template <int Dim>
void Stepper<Dim>::allocate() {
  const bool filtering = model_.scheme.transfer == Transfer::xpic || model_.scheme.transfer == Transfer::fmpm;
  cracks_.locate();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    auto& field = system_.fields[f];
    std::vector<std::int64_t> occupied;
    for (auto* bodies : {&system_.bodies, &system_.rigids})
      for (const auto& body : *bodies)
        if (body.field == f || body.field == Body<Dim>::no_field)
          for (const Bin& bin : body.bins.list()) occupied.push_back(bin.block);
    if (field.side != 0) cracks_.add_blocks(field, occupied);
    reach_across(model_.grid, system_.lattice, occupied);
    field.map.rebuild(occupied);
    const auto nodes = static_cast<std::size_t>(field.map.node_count());
    field.nodes.resize(nodes);
    field.rigid.resize(system_.rigids.size());
    for (std::size_t r = 0; r < system_.rigids.size(); ++r)
      if (system_.rigids[r].field == Body<Dim>::no_field) field.rigid[r].resize(nodes);
    if (filtering) field.filter.resize(nodes), field.increment.resize(nodes);
    conditions_[f].locate(field.map);
  }
  contact_.locate();
  heat_.locate();
  b_bar_.locate();
  for (auto& body : system_.bodies) body.refresh();
}

template <int Dim>
void Stepper<Dim>::clear() {
  const auto lap = watches_.grid.lap();
  for (auto& field : system_.fields) zero(field.nodes);
}

template <int Dim>
void Stepper<Dim>::scatter(Scatter what, bool from_start) {
  const auto lap = watches_.scatter.lap();
  if (what != Scatter::momentum) b_bar_.average_stress();
  for (auto& body : system_.bodies) {
    transfers_->scatter(body, Target<Dim>(body, system_.fields, &Field<Dim>::nodes), what, from_start,
                        system_.analysis == Analysis::axisymmetric);
  }
  if (what == Scatter::force) return;
  for (auto& body : system_.rigids)
    if (body.field != Body<Dim>::no_field) {
      auto& field = system_.fields[body.field];
      transfers_->scatter(body, Target<Dim>(field.map, field.nodes), Scatter::momentum, from_start, false);
      blocks_.set_nodes(body);
    }
}

template <int Dim>
void Stepper<Dim>::divide_by_mass() {
  const auto lap = watches_.grid.lap();
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    auto& nodes = system_.fields[f].nodes;
    conditions_[f].count_plane_forces(nodes);
    conditions_[f].fold(nodes);
    each_node(nodes, [](Node& node) {
      if (!(node.mass > 0)) return;
      const double inverse = 1.0 / node.mass;
      for (double& v : node.velocity) v *= inverse;
    });
  }
}

template <int Dim>
void Stepper<Dim>::extend() {
  for (std::size_t f = 0; f < system_.fields.size(); ++f) conditions_[f].extend(system_.fields[f].nodes);
}

template <int Dim>
void Stepper<Dim>::accelerate(double dt, Known known) {
  const auto lap = watches_.grid.lap();
  const bool from_momentum = known == Known::momentum;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    auto& nodes = system_.fields[f].nodes;
    const bool free = !system_.fields[f].rigid_contact;
    const Vec3 gravity = free ? model_.body_force.gravity : Vec3(Vec3::Zero());
    const double damping = free ? grid_damping : 0.0;
    if (known != Known::velocity_and_folded_force) {
      conditions_[f].count_plane_forces(nodes);
      conditions_[f].fold(nodes, from_momentum ? Fold::everything : Fold::forces);
    }
    each_node(nodes, [&](Node& node) {
      if (!(node.mass > 0)) return;
      const double inverse = 1.0 / node.mass;
      for (int d = 0; d < Dim; ++d) {
        const double v = from_momentum ? node.velocity[d] * inverse : node.velocity[d];
        const double a = node.acceleration[d] * inverse + gravity[d] - damping * v;
        node.acceleration[d] = a;
        node.velocity[d] = v + dt * a;
      }
    });
    if (!free) continue;
    apply_body_force(f, dt);
    if (damping != 0.0) account_damping(f, dt);
    conditions_[f].stay_on_planes(nodes);
  }
  push_joints(dt, from_momentum);
  for (const auto& body : system_.bodies) ledger_.impulse += dt * body.total_mass * model_.body_force.gravity;
}

// What joints carry since the last step.
template <int Dim>
void Stepper<Dim>::push_joints(double dt, bool find) {
  if (!joints_.active()) return;
  if (find) joints_.find();
  joints_.push(dt);
  for (std::size_t f = 0; f < system_.fields.size(); ++f) conditions_[f].stay_on_planes(system_.fields[f].nodes);
}

// What joints between bodies do belongs to contact in the histories.
template <int Dim>
void Stepper<Dim>::book_joints() {
  joints_.each_pair([&](std::size_t one, std::size_t two, const Vec3& force, double area) {
    PairLedger& entry = contact_.ledger()[{std::min(one, two), std::max(one, two)}];
    entry.force += one < two ? force : Vec3(-force), entry.area += area;
  });
  const auto [work, impulse] = joints_.take_rigid();
  contact_.rigid_work += work, contact_.rigid_impulse += impulse;
}

// Accelerations that the user gave as functions of position and time.
template <int Dim>
void Stepper<Dim>::apply_body_force(std::size_t f, double dt) {
  const BodyForce& force = model_.body_force;
  if (!force.function[0] && !force.function[1] && !force.function[2]) return;
  const auto& field = system_.fields[f];
  sum_over_nodes(f, [&](std::int64_t n, Node& node) {
    const Vec3 a = body_force_at(system_.lattice.position(field.map.node_at(n)), dt);
    for (int d = 0; d < Dim; ++d) node.acceleration[d] += a[d], node.velocity[d] += dt * a[d];
    return Exchange(Exchange::Zero());
  });
}

template <int Dim>
Vec3 Stepper<Dim>::body_force_at(const Vec<Dim>& place, double dt) const {
  const BodyForce& force = model_.body_force;
  Vec3 x = Vec3::Zero(), a = Vec3::Zero();
  x.head<Dim>() = place;
  auto at = Variables::at(x, system_.time / force.function_time);
  at.dt = dt / force.function_time;
  for (int d = 0; d < Dim; ++d)
    if (const auto& function = force.function[static_cast<std::size_t>(d)]) a[d] = (*function)(at);
  return a;
}

// What drives the tips of cracks.
template <int Dim>
void Stepper<Dim>::load_tips(double dt) {
  if constexpr (Dim == 2) {
    if (!fracture_.active()) return;
    fracture_.measure([&](const Vec<2>& x, const Vec<2>& v) {
      return Vec<2>((model_.body_force.gravity + body_force_at(x, dt)).template head<2>() - grid_damping * v);
    });
  }
}

// Particles near a new tip may lie in bins that no crack cut before.
template <int Dim>
void Stepper<Dim>::grow_cracks() {
  if constexpr (Dim == 2) {
    if (fracture_.active() && fracture_.grow()) system_.sorted = false;
  }
}

// With the velocities at mid step.
template <int Dim>
void Stepper<Dim>::account_body_force(double dt) {
  const BodyForce& force = model_.body_force;
  if (!force.function[0] && !force.function[1] && !force.function[2]) return;
  for (std::size_t f = 0; f < system_.fields.size(); ++f) {
    const auto& field = system_.fields[f];
    if (field.rigid_contact) continue;
    const Exchange sum = sum_over_nodes(f, [&](std::int64_t n, const Node& node) {
      const Vec3 a = body_force_at(system_.lattice.position(field.map.node_at(n)), dt);
      Exchange power = Exchange::Zero();
      for (int d = 0; d < Dim; ++d) {
        power[0] += node.mass * a[d] * (node.velocity[d] - 0.5 * dt * node.acceleration[d]);
        power[1 + d] += node.mass * a[d];
      }
      return Exchange(dt * power);
    });
    ledger_.external_work += sum[0];
    ledger_.impulse += sum.tail<3>();
  }
}

template <int Dim>
void Stepper<Dim>::account_damping(std::size_t f, double dt) {
  const Exchange sum = sum_over_nodes(f, [&](std::int64_t, const Node& node) {
    Exchange taken = Exchange::Zero();
    for (int d = 0; d < Dim; ++d) {
      const double old = node.velocity[d] - dt * node.acceleration[d];
      taken[0] += old * (node.velocity[d] + old) * 0.5;
      taken[1 + d] += old;
    }
    return Exchange(dt * grid_damping * node.mass * taken);
  });
  ledger_.damping_work += sum[0];
  ledger_.impulse -= sum.tail<3>();
}

// The body's share of what damping takes from the field; exact if all bodies of a field are damped alike.
template <int Dim>
void Stepper<Dim>::account_particle_damping(const Body<Dim>& body, double rate, double dt) {
  double field_mass = 0.0;
  for (const auto& other : system_.bodies)
    if (other.field == body.field) field_mass += other.total_mass;
  const Exchange sum = sum_over_nodes(body.field, [&](std::int64_t, const Node& node) {
    Exchange momentum = Exchange::Zero();
    for (int d = 0; d < Dim; ++d) momentum[1 + d] = node.mass * node.velocity[d];
    return momentum;
  });
  ledger_.impulse -= rate * dt * body.total_mass / field_mass * sum.tail<3>();
}

// Sum of f over the nodes with mass, in the order of the blocks for any number of threads.
template <int Dim>
template <class F>
typename Stepper<Dim>::Exchange Stepper<Dim>::sum_over_nodes(std::size_t f, F&& term) {
  auto& field = system_.fields[f];
  exchanges_.assign(field.map.active().size(), Exchange::Zero());
  parallel_for(static_cast<std::ptrdiff_t>(exchanges_.size()), [&](std::ptrdiff_t block) {
    Exchange sum = Exchange::Zero();
    for (std::int64_t n = block * block_nodes<Dim>; n < (block + 1) * block_nodes<Dim>; ++n) {
      Node& node = field.nodes[static_cast<std::size_t>(n)];
      if (node.mass > 0) sum += conditions_[f].share(n) * term(n, node);
    }
    exchanges_[static_cast<std::size_t>(block)] = sum;
  });
  Exchange total = Exchange::Zero();
  for (const Exchange& part : exchanges_) total += part;
  return total;
}

template <int Dim>
void Stepper<Dim>::impose(double time, double dt) {
  const auto lap = watches_.grid.lap();
  for (std::size_t f = 0; f < conditions_.size(); ++f) conditions_[f].impose(system_.fields[f].nodes, time, dt);
  impose_rigid(dt, false, false);
}

template <int Dim>
void Stepper<Dim>::impose_update(double dt, bool after_impose) {
  const auto lap = watches_.grid.lap();
  for (std::size_t f = 0; f < conditions_.size(); ++f)
    conditions_[f].impose_update(system_.fields[f].nodes, system_.time, dt, after_impose, system_.step == 0);
  impose_rigid(dt, true, after_impose);
}

template <int Dim>
void Stepper<Dim>::move(double dt, double strain_dt) {
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.move = true;
  what.dt = dt;
  what.strain_dt = strain_dt;
  switch (model_.scheme.transfer) {
    case Transfer::flip:
      what.flip = 1.0;
      break;
    case Transfer::blend:
      what.flip = model_.scheme.flip_fraction;
      break;
    case Transfer::pic:
    case Transfer::apic:
      what.flip = 0.0;
      break;
    case Transfer::xpic:
    case Transfer::fmpm:
      what.flip = filtering_ ? 0.0 : 1.0;
      break;
  }
  double travel = 0.0;
  extend();
  joints_.follow(dt);
  book_joints();
  cracks_.move(dt);
  joints_.settle(dt);
  b_bar_.average_rates(what, &Field<Dim>::nodes);
  for (auto& body : system_.bodies) {
    what.damping = body.particle_damping + particle_damping;
    if (what.damping != 0.0) account_particle_damping(body, what.damping, dt);
    const auto result = transfers_->gather(body, Target<Dim>(body, system_.fields, &Field<Dim>::nodes), what);
    travel = std::max(travel, result.travel);
    if (!result.valid) stop_at_bad_particle();
  }
  move_rigid(dt);
  for (auto& body : system_.bodies) count_crossings(body, system_.lattice);
  system_.drift += std::max(travel, rigid_travel_);
  contact_.moved(std::max(travel, rigid_travel_));
}

template <int Dim>
void Stepper<Dim>::strain(double dt, bool from_start) {
  if (!(dt > 0)) return;
  const auto lap = watches_.gather.lap();
  Gather what = gather_options();
  what.strain_dt = dt;
  what.from_start = from_start;
  const auto layer = filtering_ ? &Field<Dim>::filter : &Field<Dim>::nodes;
  b_bar_.average_rates(what, layer);
  for (auto& body : system_.bodies) {
    if (!transfers_->gather(body, Target<Dim>(body, system_.fields, layer), what).valid) stop_at_bad_particle();
  }
}

template <int Dim>
Gather Stepper<Dim>::gather_options() const {
  Gather what;
  what.plane_stress = system_.analysis == Analysis::plane_stress;
  what.axisymmetric = system_.analysis == Analysis::axisymmetric;
  what.exponential = model_.scheme.exponential_deformation;
  return what;
}

// CPDI keeps the weights of a step although stress-first schemes change F within it.
template <int Dim>
void Stepper<Dim>::remember_domains() {
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (auto& body : *bodies) {
      if (!body.domain) continue;
      const auto F = body.particles.F();
      for (std::size_t k = 0; k < Dim * Dim; ++k)
        std::copy_n(F[k], body.particles.size(), body.particles.column(*body.domain + k));
    }
}

template <int Dim>
void Stepper<Dim>::remember_positions() {
  const auto remember = [](Body<Dim>& body) {
    const auto from = body.particles.x();
    const auto to = body.particles.vector(*body.start);
    for (std::size_t d = 0; d < Dim; ++d) std::copy_n(from[d], body.particles.size(), to[d]);
  };
  for (auto* bodies : {&system_.bodies, &system_.rigids})
    for (auto& body : *bodies) remember(body);
}

template <int Dim>
void Stepper<Dim>::stop_at_bad_particle() const {
  const auto when = " in step " + std::to_string(system_.step + 1) + " at time " + std::to_string(system_.time);
  for (const auto* bodies : {&system_.bodies, &system_.rigids})
    for (const auto& body : *bodies)
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        const Vec<Dim> x = body.particles.position(i), v = body.particles.velocity(i);
        const bool finite = x.allFinite() && v.allFinite();
        const bool inside = finite && (x.array() >= system_.lattice.low.array()).all() &&
                            (x.array() <= system_.lattice.high.array()).all();
        const double volume = body.particles.volume()[i];
        const bool crushed = finite && volume <= 0;
        if (inside && volume > 0) continue;
        std::string at;
        for (int d = 0; d < Dim; ++d) at += (d ? ", " : "") + std::to_string(x[d]);
        const std::string who =
            "particle " + std::to_string(body.particles.id[i]) + " of '" + body.name + "' at (" + at + ")";
        if (finite && volume > 0)
          throw SimulationError(
              who + " left the grid" + when +
              ": it moves too far, or the run became unstable. Enlarge <Grid>, check the conditions that should "
              "hold it, or return such particles with <LeaveLimit>.");
        throw SimulationError(
            who + (crushed ? " was compressed to no volume" : " has a velocity or strain that is not a number") + when +
            ": usually the step is too large for the present stiffness. Try a smaller <TimeFactor>, adaptive steps "
            "(custom task AdjustTimeStep), or more particles per cell.");
      }
  throw SimulationError("a value on the grid is not a number" + when + "; try a smaller <TimeFactor>");
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace tribo
