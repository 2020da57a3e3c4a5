// SPDX-License-Identifier: MIT
#include "solver/joints/joints.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo {

template <int Dim>
Joints<Dim>::Joints(const Model& model, System<Dim>& system, const Cracks<Dim>& cracks)
    : system_(system), face_nodes_(model, system, cracks), surfaces_(system.joints.size()) {
  // The range is that of transfers from particles with domains of up to one cell.
  reach_ = (std::max(1.5, reach_of(model.scheme.kernel)) + 0.5) * system.lattice.spacing.maxCoeff();
}

// The few nodes that a face reaches before it has moved away entirely lie on one side of the integration point. The
// velocity there would be an extrapolation, which amplifies that of light nodes.
template <int Dim>
bool Joints<Dim>::extrapolates(const std::vector<Share>& side) {
  constexpr double largest_sum = 3.0;  // of the amounts of the weights, whose sum is one
  double sum = 0.0;
  for (const Share& share : side) sum += std::abs(share.weight);
  return sum > largest_sum;
}

// Current position of an integration point and the normal there.
template <int Dim>
std::pair<Vec<Dim>, Vec<Dim>> Joints<Dim>::place(const JointSurface<Dim>& surface, std::size_t s) const {
  const JointSample<Dim>& sample = surface.samples[s];
  if (surface.crack == JointSurface<Dim>::none) {
    const JointAxes& axes = surface.axes[sample.joint[0]];
    const Vec3 offset = sample.local[0] * axes.n + axes.vector({sample.local[1], sample.local[2]});
    return {surface.x[sample.joint[0]] + offset.template head<Dim>(), axes.n.template head<Dim>()};
  }
  const Crack<Dim>& crack = system_.cracks[surface.crack];
  typename JointSample<Dim>::Corners corners;
  Vec<Dim> x = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = crack.x[sample.point[k]], x += sample.weight[k] * corners[k];
  return {x, Crack<Dim>::area(corners).normalized()};
}

template <int Dim>
void Joints<Dim>::find() {
  if (!active()) return;
  face_nodes_.list_fields();
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    const bool changes = system_.joints[s].interface != nullptr;  // interfaces add and remove joints during a run
    if (changes || surfaces_[s].order.empty()) order_samples(s), list_contributions(s);
    find_nodes(s);
    Surface& nodes = surfaces_[s];
    nodes.supported_fraction.resize(system_.joints[s].joints.size());
    each_joint(s, [&](std::size_t joint) {
      double sum = 0.0;
      each_contribution(s, joint, [&](const SampleNodes&, double fraction) { sum += fraction; });
      nodes.supported_fraction[joint] = sum;
    });
  }
  schedule();
  list_points();
  find_stable_step();
}

// Finds the nodes of all integration points of a surface.
template <int Dim>
void Joints<Dim>::find_nodes(std::size_t s) {
  JointSurface<Dim>& surface = system_.joints[s];
  auto& samples = surfaces_[s].samples;
  const auto& order = surfaces_[s].order;
  const bool of_interface = surface.interface && surface.crack == JointSurface<Dim>::none;
  samples.resize(surface.samples.size());
  const auto find_sample = [&](std::size_t k, std::array<typename FaceNodes<Dim>::Memory, 2>& memory) {
    SampleNodes& nodes = samples[k];
    nodes.range = {}, nodes.sum = nodes.scaled_sum = 0.0;
    if (surface.mass[0][k] == surface.detached) {
      for (auto& side : nodes.side) side.clear();
      return;
    }
    const auto [x, n] = place(surface, k);
    // The faces of an interface are on either side of its points, by half of the opening.
    const double opening = of_interface ? surface.joints[surface.samples[k].joint[0]].opening : 0.0;
    for (std::size_t f = 0; f < 2; ++f) {
      const Vec<Dim> at = x + (f == 0 ? -0.5 : 0.5) * opening * n;
      const double mass = face_nodes_.find(surface, at, n, f, memory[f], nodes.side[f], nodes.range);
      double& first = surface.mass[f][k];
      if (first == 0) first = mass;
      constexpr double enough = 0.05;  // below this fraction of the first mass, the face has moved away
      if (mass < enough * first || extrapolates(nodes.side[f])) nodes.side[f].clear();
      for (const Share& share : nodes.side[f])
        nodes.sum += std::abs(share.weight), nodes.scaled_sum += std::abs(share.weight) * std::sqrt(share.mobility);
    }
    const bool apart = opening > system_.lattice.spacing.maxCoeff();
    if (surface.crack == JointSurface<Dim>::none && (apart || !nodes.has_both_faces()))
      surface.mass[0][k] = surface.mass[1][k] = surface.detached;
  };
  constexpr std::size_t part = 64;  // of successive points, which often have the same nodes
  parallel_for(static_cast<std::ptrdiff_t>((samples.size() + part - 1) / part), [&](std::ptrdiff_t p) {
    std::array<typename FaceNodes<Dim>::Memory, 2> memory;
    const std::size_t start = part * static_cast<std::size_t>(p);
    for (std::size_t k = start; k < std::min(samples.size(), start + part); ++k) find_sample(order[k], memory);
  });
}

// Orders the integration points by the lowest of the nodes around them. Their places may change afterwards, which costs
// time only.
template <int Dim>
void Joints<Dim>::order_samples(std::size_t s) {
  const JointSurface<Dim>& surface = system_.joints[s];
  std::vector<std::pair<Index<Dim>, std::uint32_t>> keys;
  for (std::uint32_t k = 0; k < surface.samples.size(); ++k)
    keys.emplace_back(face_nodes_.lowest_node(place(surface, k).first), k);
  if (!surface.interface) std::sort(keys.begin(), keys.end());  // else they are ordered anew in every step
  surfaces_[s].order.clear();
  for (const auto& key : keys) surfaces_[s].order.push_back(key.second);
}

// Lists the contributions of the integration points joint by joint.
template <int Dim>
void Joints<Dim>::list_contributions(std::size_t s) {
  const JointSurface<Dim>& surface = system_.joints[s];
  auto& first = surfaces_[s].first;
  auto& contributions = surfaces_[s].contributions;
  first.assign(surface.joints.size() + 1, 0);
  const auto each_corner = [&](auto&& f) {
    for (std::uint32_t k = 0; k < surface.samples.size(); ++k)
      for (std::size_t c = 0; c < surface.samples[k].area_fraction.size(); ++c)
        if (surface.samples[k].area_fraction[c] > 0)
          f(k, surface.samples[k].joint[c], surface.samples[k].area_fraction[c]);
  };
  each_corner([&](std::uint32_t, std::uint32_t joint, double) { ++first[joint + 1]; });
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  contributions.resize(first.back());
  std::vector<std::uint32_t> next = first;
  each_corner([&](std::uint32_t k, std::uint32_t joint, double fraction) {
    contributions[next[joint]++] = {k, fraction};
  });
}

template <int Dim>
void Joints<Dim>::schedule() {
  slabs_.clear();
  for (std::uint32_t s = 0; s < surfaces_.size(); ++s)
    for (std::uint32_t k = 0; k < surfaces_[s].samples.size(); ++k)
      if (const SampleNodes& nodes = surfaces_[s].samples[k]; nodes.has_both_faces()) slabs_.add({s, k, nodes.range});
  slabs_.sort();
}

template <int Dim>
void Joints<Dim>::add_forces(double dt) {
  add_to_nodes([&](std::size_t, std::uint32_t s, SampleNodes& nodes, std::uint32_t joint, double fraction) {
    if (!is_supported(s, joint)) return;
    const Vec<Dim> force =
        fraction / surfaces_[s].supported_fraction[joint] * system_.joints[s].force(joint).template head<Dim>();
    for (std::size_t f = 0; f < 2; ++f)
      for (const Share& share : nodes.side[f]) {
        Node& at = node(share);
        const double shared = (f == 0 ? -1.0 : 1.0) * share.weight * share.mobility;
        const Vec<Dim> a = shared * share.mirror(force);
        for (int d = 0; d < Dim; ++d) at.acceleration[d] += a[d], at.velocity[d] += dt * a[d];
      }
  });
}

// Velocity of a face and its gradient, interpolated from the nodes of one side.
template <int Dim>
auto Joints<Dim>::motion(const std::vector<Share>& shares, bool filtered) const -> Motion {
  Motion out;
  for (const Share& share : shares) {
    const Field<Dim>& field = system_.fields[share.field];
    const auto at = static_cast<std::size_t>(share.node);
    const double* velocity = filtered && !field.rigid_contact ? field.filter[at].velocity : field.nodes[at].velocity;
    const Vec<Dim> v = share.mirror(Eigen::Map<const Vec<Dim>>(velocity));
    out.velocity += share.weight * v;
    out.gradient += v * share.slope.transpose();
  }
  return out;
}

// Velocities of the faces of all joints of a surface.
template <int Dim>
void Joints<Dim>::find_motion_of(std::size_t s, bool filtered) {
  Surface& surface = surfaces_[s];
  parallel_for(
      static_cast<std::ptrdiff_t>(surface.samples.size()),
      [&](std::ptrdiff_t k) {
        SampleNodes& nodes = surface.samples[static_cast<std::size_t>(k)];
        for (std::size_t f = 0; f < 2; ++f) nodes.motion[f] = motion(nodes.side[f], filtered);
      },
      fewest_for_threads);
  surface.motion.resize(system_.joints[s].joints.size());
  each_joint(s, [&](std::size_t joint) {
    std::array<Motion, 2> of_joint;
    each_contribution(s, joint, [&](const SampleNodes& nodes, double fraction) {
      const double share = fraction / surface.supported_fraction[joint];
      for (std::size_t f = 0; f < 2; ++f) {
        of_joint[f].velocity += share * nodes.motion[f].velocity;
        of_joint[f].gradient += share * nodes.motion[f].gradient;
      }
    });
    surface.motion[joint] = of_joint;
  });
}

template <int Dim>
void Joints<Dim>::find_motion(bool filtered) {
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    find_motion_of(s, filtered);
    if (system_.joints[s].crack != JointSurface<Dim>::none) prescribe_face_velocities(s);
  }
}

template <int Dim>
void Joints<Dim>::update_laws(double dt, double time) {
  if (!(dt > 0)) return;
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    const JointSurface<Dim>& surface = system_.joints[s];
    find_increments(s, dt, time);
    std::vector<Vec3> before;
    if (rigid(surface, 0) || rigid(surface, 1))
      for (std::size_t k = 0; k < surface.joints.size(); ++k) before.push_back(surface.force(k));
    evaluate_law(s, time);
    if (!before.empty()) record_rigid_work(s, before, dt);
  }
}

// Increments of displacement of the joints of a surface from the velocities of their faces.
template <int Dim>
void Joints<Dim>::find_increments(std::size_t s, double dt, double time) {
  const JointSurface<Dim>& surface = system_.joints[s];
  const Surface& nodes = surfaces_[s];
  const bool dashpots = surface.law->damping_ratio() > 0;
  increments_.assign(surface.joints.size(), {});
  each_joint(s, [&](std::size_t k) {
    JointIncrement& d = increments_[k];
    Vec3 jump = Vec3::Zero();
    jump.template head<Dim>() = nodes.motion[k][1].velocity - nodes.motion[k][0].velocity;
    d.normal = dt * jump.dot(surface.axes[k].n), d.shear = dt * surface.axes[k].tangent(jump);
    d.gap = surface.joints[k].gap + d.normal, d.dt = dt, d.time = time;
    if (dashpots) d.mass = nodes.mass[k];
  });
  if (!surface.law->has_pore_pressure()) return;
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {  // formulas of the user are evaluated by one thread
    Vec3 at = Vec3::Zero();
    at.template head<Dim>() = surface.x[k];
    increments_[k].pressure = surface.law->pore_pressure(at, time);
  }
}

// Evaluates the law of a surface for ranges of consecutive joints with both faces. Every thread takes parts of the
// surface; the events are listed in the order of the joints.
template <int Dim>
void Joints<Dim>::evaluate_law(std::size_t s, double time) {
  constexpr std::size_t part = 256;
  JointSurface<Dim>& surface = system_.joints[s];
  const std::size_t count = surface.joints.size();
  const std::size_t parts = (count + part - 1) / part;
  if (events_of_part_.size() < parts) events_of_part_.resize(parts);
  parallel_for(static_cast<std::ptrdiff_t>(parts), [&](std::ptrdiff_t p) {
    const std::size_t start = part * static_cast<std::size_t>(p), stop = std::min(count, start + part);
    thread_local std::vector<JointEvent> events;
    auto& found = events_of_part_[static_cast<std::size_t>(p)];
    found.clear();
    for (std::size_t first = start, end = 0; first < stop; first = end + 1) {
      for (end = first; end < stop && is_supported(s, end);) ++end;
      if (const std::size_t last = std::min(end, surface.deforming); last > first) {
        events.clear();
        surface.law->update({surface.joints.data() + first, last - first}, {increments_.data() + first, last - first},
                            events);
        for (JointEvent& event : events) event.contact += first, found.push_back(event);
      }
      if (end < stop) release(surface.joints[end]);
    }
  });
  for (std::size_t p = 0; p < parts; ++p)
    for (const JointEvent& event : events_of_part_[p]) {
      Vec3 x = Vec3::Zero();
      x.template head<Dim>() = surface.x[event.contact];
      events_.push_back({time, s, x, event});
    }
}

// Removes the forces of a joint one of whose faces has moved away.
template <int Dim>
void Joints<Dim>::release(Joint& joint) {
  joint.Fn = joint.dashpot_normal = joint.strain = 0.0;
  joint.Fs = joint.dashpot_shear = Tangent{};
}

// Prescribes the velocities of the crack faces at the joints.
template <int Dim>
void Joints<Dim>::prescribe_face_velocities(std::size_t s) {
  const JointSurface<Dim>& surface = system_.joints[s];
  Crack<Dim>& crack = system_.cracks[surface.crack];
  crack.is_prescribed.assign(crack.x.size(), 0);
  crack.prescribed_velocity.resize(crack.x.size());
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    if (!is_supported(s, k)) continue;
    crack.is_prescribed[surface.point[k]] = 1;
    for (std::size_t f = 0; f < 2; ++f)
      crack.prescribed_velocity[surface.point[k]][f] = surfaces_[s].motion[k][f].velocity;
  }
}

// Joints on cracks are at the crack points. Joints between bodies move with the mean velocity of both faces, and their
// normals rotate with the faces.
template <int Dim>
void Joints<Dim>::move_points(double dt) {
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    JointSurface<Dim>& surface = system_.joints[s];
    std::vector<Vec<Dim>> normals;
    if (surface.crack != JointSurface<Dim>::none) normals = system_.cracks[surface.crack].normals();
    each_joint(s, [&](std::size_t k) {
      const Motion &below = surfaces_[s].motion[k][0], &above = surfaces_[s].motion[k][1];
      const Mat<Dim> rate = 0.5 * (below.gradient + above.gradient);
      const Vec<Dim> old = surface.axes[k].n.template head<Dim>();
      Vec3 normal = Vec3::Zero();
      if (normals.empty()) {
        surface.x[k] += 0.5 * dt * (below.velocity + above.velocity);
        normal.template head<Dim>() = old - dt * (rate.transpose() * old);
      } else {
        surface.x[k] = system_.cracks[surface.crack].x[surface.point[k]];
        normal.template head<Dim>() = normals[surface.point[k]];
      }
      double spin = 0.0;
      if constexpr (Dim == 3) {
        const Vec3 vorticity(rate(2, 1) - rate(1, 2), rate(0, 2) - rate(2, 0), rate(1, 0) - rate(0, 1));
        spin = 0.5 * dt * vorticity.dot(normal);
      }
      surface.axes[k].follow(normal.normalized(), spin);
    });
    if (!normals.empty()) copy_to_crack(surface);
  }
}

template <int Dim>
void Joints<Dim>::copy_to_crack(const JointSurface<Dim>& surface) {
  Crack<Dim>& crack = system_.cracks[surface.crack];
  for (std::size_t k = 0; k < surface.joints.size(); ++k) {
    const std::size_t point = surface.point[k];
    const Joint& joint = surface.joints[k];
    crack.traction[point] = -surface.force(k).template head<Dim>() / joint.area;
    crack.slip[point] = joint.slip;
    crack.status[point] = joint.away ? 0.0 : joint.slips ? 2.0 : 1.0;
  }
}

template <int Dim>
auto Joints<Dim>::energies() const -> Energies {
  Energies out;
  for (const auto& surface : system_.joints) {
    out.dissipated += surface.dissipated;
    for (const Joint& joint : surface.joints)
      out.stored += joint.strain, out.slip -= joint.slid, out.dashpot -= joint.damped,
          out.dissipated += joint.released() - joint.slid - joint.damped,
          out.decohesion += joint.area * (joint.decohesion[0] + joint.decohesion[1]);
  }
  return out;
}

template <int Dim>
std::vector<PlacedEvent> Joints<Dim>::take_events() {
  return std::exchange(events_, {});
}

template class Joints<2>;
template class Joints<3>;

}  // namespace tribo
