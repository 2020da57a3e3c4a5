// SPDX-License-Identifier: MIT
#include "run/restart.hpp"

#include "blocks/assembly.hpp"

namespace tribo {
namespace {

template <int Dim, class F>
void each_body(System<Dim>& system, F&& f) {
  int k = 0;
  for (auto* bodies : {&system.bodies, &system.rigids})
    for (auto& body : *bodies) f(body, "body" + std::to_string(k++) + ".");
}

// Calls f(name, numbers) for all that is kept of a crack; what f writes into the numbers goes back.
template <int Dim, class F>
void each_column(Crack<Dim>& crack, F&& f) {
  const auto vectors = [&](const char* name, std::vector<Vec<Dim>>& of) {
    std::vector<double> flat;
    for (const auto& v : of) flat.insert(flat.end(), v.data(), v.data() + Dim);
    f(name, flat);
    for (std::size_t k = 0; k < of.size(); ++k) std::copy_n(flat.data() + k * Dim, Dim, of[k].data());
  };
  vectors("x", crack.x), vectors("lower", crack.face[0]), vectors("upper", crack.face[1]);
  vectors("traction", crack.traction);
  f("gap", crack.gap), f("slip", crack.slip), f("bond", crack.bond), f("touch", crack.status);
  std::vector<double> tips;
  const auto each_number = [&](auto&& g) {
    for (CrackTip& tip : crack.tips)
      for (double* v : {&tip.J, &tip.K[0], &tip.K[1], &tip.rest}) g(*v);
  };
  each_number([&](double& v) { tips.push_back(v); });
  f("tips", tips);
  std::size_t k = 0;
  each_number([&](double& v) { v = tips[k++]; });
}

// What changes when a crack grows: how many points and pieces were drawn, the pieces, their part inside, per tip where
// it is.
template <int Dim>
std::vector<double> shape_of(const Crack<Dim>& crack) {
  std::vector<double> out{static_cast<double>(crack.x.size()), static_cast<double>(crack.drawn_points),
                          static_cast<double>(crack.drawn_pieces), static_cast<double>(crack.pieces.size())};
  for (const auto& piece : crack.pieces) out.insert(out.end(), piece.begin(), piece.end());
  out.insert(out.end(), crack.inside.begin(), crack.inside.end());
  for (const CrackTip& tip : crack.tips)
    for (const auto v : {std::size_t{tip.point}, std::size_t{tip.behind}, tip.body, std::size_t{tip.lives}})
      out.push_back(static_cast<double>(v));
  return out;
}

template <int Dim>
void give_shape(Crack<Dim>& crack, const std::vector<double>& shape) {
  std::size_t k = 0;
  const auto next = [&] { return static_cast<std::uint32_t>(shape.at(k++)); };
  const std::size_t points = next();
  while (crack.x.size() < points) crack.add_point(crack.x.size(), Vec<Dim>::Zero());
  crack.drawn_points = next(), crack.drawn_pieces = next();
  crack.pieces.resize(next());
  for (auto& piece : crack.pieces)
    for (auto& point : piece) point = next();
  crack.inside.resize(crack.pieces.size());
  for (double& part : crack.inside) part = shape.at(k++);
  for (CrackTip& tip : crack.tips) tip.point = next(), tip.behind = next(), tip.body = next(), tip.lives = next() != 0;
}

// The same for a surface of joints.
template <int Dim, class F>
void each_column(JointSurface<Dim>& surface, F&& f) {
  std::vector<double> places, joints;
  const auto each_place = [&](auto&& g) {
    for (std::size_t k = 0; k < surface.joints.size(); ++k)
      for (double* v :
           {surface.x[k].data(), surface.axes[k].n.data(), surface.axes[k].s.data(), surface.axes[k].t.data()})
        for (int d = 0; d < (v == surface.x[k].data() ? Dim : 3); ++d) g(v[d]);
  };
  const auto each_state = [&](auto&& g) {
    for (Joint& joint : surface.joints) each_number(joint, g);
  };
  each_place([&](double& v) { places.push_back(v); });
  each_state([&](double& v) { joints.push_back(v); });
  f("places", places), f("joints", joints), f("mass1", surface.mass[0]), f("mass2", surface.mass[1]);
  std::size_t k = 0;
  each_place([&](double& v) { v = places[k++]; });
  k = 0;
  each_state([&](double& v) { v = joints[k++]; });
}

// Calls f(name, numbers) for all columns of cracks and joints.
template <int Dim, class F>
void each_surface(System<Dim>& system, F&& f) {
  const auto all = [&](auto& list, const std::string& kind) {
    for (std::size_t c = 0; c < list.size(); ++c)
      each_column(list[c], [&](const char* name, std::vector<double>& column) {
        f(kind + std::to_string(c) + "." + name, column);
      });
  };
  all(system.cracks, "crack"), all(system.joints, "joints");
}

}  // namespace

void save_blocks(Assembly& blocks, double initial_energy, CheckpointWriter& to) {
  to.put("energy", initial_energy);
  to.put("pairs", std::span<const std::int64_t>(blocks.found_pairs()));
  blocks.each_column(
      [&](const char* name, std::vector<double>& column) { to.put(name, std::span<const double>(column)); });
}

double load_blocks(const Checkpoint& from, Assembly& blocks) {
  const auto mismatch = [] { throw FileError("the checkpoint belongs to another command file: its blocks differ"); };
  if (!from.has("blocks.motion")) mismatch();
  blocks.set_found_pairs(from.integers("pairs"));
  blocks.each_column([&](const char* name, std::vector<double>& column) {
    const auto values = from.doubles(name);
    if (values.size() != column.size()) mismatch();
    column = values;
  });
  return from.number("energy");
}

template <int Dim>
CheckpointWriter save_state(const RunState& state, System<Dim>& system, Stepper<Dim>& stepper) {
  CheckpointWriter out;
  out.put("dimension", std::int64_t{Dim});
  out.put("counters", std::array<std::int64_t, 5>{state.archive, state.history, state.checkpoint, system.step,
                                                  stepper.particle_sort().returned});
  out.put("clock", std::array{system.time, system.drift, system.sorted ? 1.0 : 0.0, state.initial_energy, state.dt,
                              stepper.filter().next, stepper.joints().stable_step()});
  const EnergyLedger& l = stepper.ledger();
  out.put("ledger", std::array{l.external_work, l.damping_work, l.rigid_work, stepper.damping().grid,
                               stepper.damping().particle, stepper.damping().grid_feedback,
                               stepper.damping().particle_feedback, l.impulse[0], l.impulse[1], l.impulse[2]});
  for (std::size_t f = 0; f < system.fields.size(); ++f) {
    const auto& c = stepper.conditions(f);
    out.put("conditions" + std::to_string(f), std::array{c.work(), c.impulse()[0], c.impulse()[1], c.impulse()[2]});
  }
  const Vec3& rigid = stepper.contact().ledger().rigid_impulse;
  std::vector<double> pairs{stepper.contact().ledger().rigid_work, rigid[0], rigid[1], rigid[2]};
  for (const auto& [fields, entry] : stepper.contact().ledger().pairs)
    pairs.insert(pairs.end(), {static_cast<double>(fields.first), static_cast<double>(fields.second), entry.friction,
                               entry.impact, entry.interface, entry.stored});
  out.put("contact", std::span<const double>(pairs));
  out.put("heat",
          std::array{stepper.heat().supplied, stepper.heat().from_contact, stepper.heat().time_since_reduction});
  for (std::size_t c = 0; c < system.cracks.size(); ++c)
    out.put("crack" + std::to_string(c) + ".shape", std::span<const double>(shape_of(system.cracks[c])));
  each_surface(system, [&](const std::string& name, std::vector<double>& column) {
    out.put(name, std::span<const double>(column));
  });
  if (system.blocks) save_blocks(*system.blocks, state.initial_block_energy, out);
  each_body(system, [&](Body<Dim>& body, const std::string& prefix) {
    out.put(prefix + "id", std::span<const std::int64_t>(body.particles.id));
    std::vector<std::int64_t> bins;
    for (const Bin& bin : body.bins.list())
      bins.insert(bins.end(), {bin.block, std::int64_t{bin.begin}, std::int64_t{bin.end}});
    out.put(prefix + "bins", std::span<const std::int64_t>(bins));
    for (const auto& column : body.particles.columns())
      out.put(prefix + column.name, std::span<const double>(column.data.data(), body.particles.size()));
  });
  return out;
}

template <int Dim>
RunState load_state(const Checkpoint& checkpoint, System<Dim>& system, Stepper<Dim>& stepper) {
  const auto mismatch = [] { throw FileError("the checkpoint belongs to another command file: its particles differ"); };
  if (checkpoint.integer("dimension") != Dim) mismatch();
  RunState state;
  const auto counters = checkpoint.integers("counters");
  const auto clock = checkpoint.doubles("clock"), ledger = checkpoint.doubles("ledger");
  state.archive = counters.at(0), state.history = counters.at(1), state.checkpoint = counters.at(2);
  system.step = counters.at(3), stepper.particle_sort().returned = static_cast<long>(counters.at(4));
  system.time = clock.at(0), system.drift = clock.at(1), system.sorted = clock.at(2) != 0.0;
  state.initial_energy = clock.at(3), state.dt = clock.at(4), stepper.filter().next = clock.at(5);
  stepper.joints().set_stable_step(clock.at(6));
  stepper.ledger() = {ledger.at(0), ledger.at(1), ledger.at(2), {ledger.at(7), ledger.at(8), ledger.at(9)}};
  stepper.damping().grid = ledger.at(3), stepper.damping().particle = ledger.at(4);
  stepper.damping().grid_feedback = ledger.at(5), stepper.damping().particle_feedback = ledger.at(6);
  for (std::size_t f = 0; f < system.fields.size(); ++f) {
    const auto values = checkpoint.doubles("conditions" + std::to_string(f));
    stepper.conditions(f).set_work(values.at(0));
    stepper.conditions(f).set_impulse({values.at(1), values.at(2), values.at(3)});
  }
  const auto pairs = checkpoint.doubles("contact");
  stepper.contact().ledger().rigid_work = pairs.at(0);
  stepper.contact().ledger().rigid_impulse = {pairs.at(1), pairs.at(2), pairs.at(3)};
  for (std::size_t k = 4; k + 5 < pairs.size(); k += 6) {
    auto& entry =
        stepper.contact().ledger().pairs[{static_cast<std::size_t>(pairs[k]), static_cast<std::size_t>(pairs[k + 1])}];
    entry.friction = pairs[k + 2], entry.impact = pairs[k + 3], entry.interface = pairs[k + 4],
    entry.stored = pairs[k + 5];
  }
  const auto heat = checkpoint.doubles("heat");
  stepper.heat().supplied = heat.at(0), stepper.heat().from_contact = heat.at(1);
  stepper.heat().time_since_reduction = heat.at(2);
  for (std::size_t c = 0; c < system.cracks.size(); ++c)
    give_shape(system.cracks[c], checkpoint.doubles("crack" + std::to_string(c) + ".shape"));
  each_surface(system, [&](const std::string& name, std::vector<double>& column) {
    const auto values = checkpoint.doubles(name);
    if (values.size() != column.size()) mismatch();
    column = values;
  });
  if (system.blocks) state.initial_block_energy = load_blocks(checkpoint, *system.blocks);
  each_body(system, [&](Body<Dim>& body, const std::string& prefix) {
    const auto ids = checkpoint.integers(prefix + "id");
    if (ids.size() != body.particles.size()) mismatch();
    body.particles.id = ids;
    const auto flat = checkpoint.integers(prefix + "bins");
    std::vector<Bin> bins;
    for (std::size_t k = 0; k + 2 < flat.size(); k += 3)
      bins.push_back({flat[k], static_cast<std::uint32_t>(flat[k + 1]), static_cast<std::uint32_t>(flat[k + 2])});
    body.bins.restore(system.lattice, std::move(bins));
    for (auto& column : body.particles.columns()) {
      const auto values = checkpoint.doubles(prefix + column.name);
      if (values.size() != body.particles.size()) mismatch();
      std::copy(values.begin(), values.end(), column.data.begin());
    }
  });
  if (system.sorted) stepper.locate_nodes();
  return state;
}

template CheckpointWriter save_state<2>(const RunState&, System<2>&, Stepper<2>&);
template CheckpointWriter save_state<3>(const RunState&, System<3>&, Stepper<3>&);
template RunState load_state<2>(const Checkpoint&, System<2>&, Stepper<2>&);
template RunState load_state<3>(const Checkpoint&, System<3>&, Stepper<3>&);

}  // namespace tribo
