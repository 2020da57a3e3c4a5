// SPDX-License-Identifier: MIT
#include "solver/joints/joints.hpp"

#include "base/parallel.hpp"
#include "solver/joints/velocity_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo {

template <int Dim>
Joints<Dim>::Joints(const Model& model, System<Dim>& system, const Cracks<Dim>& cracks)
    : system_(system), cracks_(cracks), nodes_around_(model, system.lattice), surfaces_(system.joints.size()) {
  // The range is that of transfers from particles with domains of up to one cell.
  reach_ = (std::max(1.5, reach_of(model.scheme.kernel)) + 0.5) * system.lattice.spacing.maxCoeff();
  for (const auto& surface : system.joints)
    if (surface.crack == JointSurface<Dim>::none)
      points_of_block_.resize(static_cast<std::size_t>(system.lattice.block_count()));
}

// The nodes on one side of a face with their weights (fit_face_velocity). Returns the mass near the integration point.
template <int Dim>
double Joints<Dim>::find_face_nodes(const JointSurface<Dim>& surface, const Vec<Dim>& x, const Vec<Dim>& n,
                                    std::size_t side, std::vector<NodeWeight>& out) const {
  const double h = system_.lattice.spacing.maxCoeff();
  const bool of_crack = surface.crack != JointSurface<Dim>::none;
  const Vec<Dim> side_point = of_crack ? Vec<Dim>(x + (side == 0 ? -1e-6 : 1e-6) * h * n) : x;
  out.clear();
  thread_local typename Cracks<Dim>::NodeBox around;
  typename Cracks<Dim>::PointSides sides;
  if (cracks_.active()) {
    cracks_.find_nodes(x, around);
    sides = cracks_.sides_of(around, side_point);
  }
  double shapes = 0.0, mass = 0.0;
  thread_local std::vector<FitNode<Dim>> nodes;
  nodes.clear();
  nodes_around_.each(x, [&](double weight, const Index<Dim>& node) {
    Index<Dim> inside = node;
    const Vec<Dim> mirror = nodes_around_.fold(inside);
    const int across = cracks_.active() ? cracks_.side_of_node(sides, node) : 0;
    const Vec<Dim> offset = (system_.lattice.position(node) - x) / h;
    // the nodal mass includes the mass of the images
    const double images = std::exp2(nodes_around_.planes_through(inside));
    const std::size_t first = out.size();
    double total = 0.0;
    for (std::size_t f = 0; f < system_.fields.size(); ++f) {
      const Field<Dim>& field = system_.fields[f];
      if (field.side != across || (of_crack ? field.rigid_contact : field.base_field != surface.field[side])) continue;
      const auto position = field.map.node(inside);
      if (position < 0) continue;
      const double m = field.nodes[static_cast<std::size_t>(position)].mass;
      if (!(m > 0)) continue;
      total += m;
      out.push_back({static_cast<std::uint32_t>(f), position, 0.0, images, Vec<Dim>::Zero(), mirror});
      nodes.push_back({offset, weight * m});
    }
    if (out.size() == first) return;
    shapes += weight, mass += weight * total;
    for (std::size_t i = first; i < out.size(); ++i) nodes[i].shape /= total, nodes[i].mass = total;
  });
  if (!(mass > 0)) return 0.0;
  for (FitNode<Dim>& node : nodes) node.mass *= shapes / mass;
  constexpr double aligned = 1 - 1e-5;  // 0.26 degrees
  Eigen::Index axis = 0;
  if (surface.interface)
    fit_face_velocity(nodes, light_at_interfaces);
  else if (n.cwiseAbs().maxCoeff(&axis) > aligned)
    fit_aligned_face_velocity(nodes, static_cast<int>(axis));
  else
    fit_face_velocity(nodes, light_at_joints);
  for (std::size_t i = 0; i < out.size(); ++i) out[i].weight = nodes[i].weight, out[i].slope = nodes[i].slope / h;
  return mass;
}

// The few nodes that a face reaches before it has moved away entirely lie on one side of the integration point. The
// velocity there would be an extrapolation, which amplifies that of light nodes.
template <int Dim>
bool Joints<Dim>::extrapolates(const std::vector<NodeWeight>& side) {
  constexpr double largest_sum = 3.0;  // of the amounts of the weights, whose sum is one
  double sum = 0.0;
  for (const NodeWeight& share : side) sum += std::abs(share.weight);
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
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    JointSurface<Dim>& surface = system_.joints[s];
    Surface& surface_nodes = surfaces_[s];
    const bool of_interface = surface.interface && surface.crack == JointSurface<Dim>::none;
    surface_nodes.samples.resize(surface.samples.size());
    parallel_for(static_cast<std::ptrdiff_t>(surface_nodes.samples.size()), [&](std::ptrdiff_t sample) {
      const auto k = static_cast<std::size_t>(sample);
      SampleNodes& sample_nodes = surface_nodes.samples[k];
      if (surface.mass[0][k] == surface.detached) {
        for (auto& side : sample_nodes.side) side.clear();
        return;
      }
      const auto [x, n] = place(surface, k);
      // The faces of an interface are on either side of its points, by half of the opening.
      const double opening = of_interface ? surface.joints[surface.samples[k].joint[0]].opening : 0.0;
      for (std::size_t f = 0; f < 2; ++f) {
        const Vec<Dim> at = x + (f == 0 ? -0.5 : 0.5) * opening * n;
        const double mass = find_face_nodes(surface, at, n, f, sample_nodes.side[f]);
        double& first = surface.mass[f][k];
        if (first == 0) first = mass;
        constexpr double enough = 0.05;  // below this fraction of the first mass, the face has moved away
        if (mass < enough * first || extrapolates(sample_nodes.side[f])) sample_nodes.side[f].clear();
      }
      const bool apart = opening > system_.lattice.spacing.maxCoeff();
      if (surface.crack == JointSurface<Dim>::none && (apart || !sample_nodes.has_both_faces()))
        surface.mass[0][k] = surface.mass[1][k] = surface.detached;
    });
    surface_nodes.supported_fraction.assign(surface.joints.size(), 0.0);
    each_contribution(s, [&](SampleNodes&, std::uint32_t joint, double fraction) {
      surface_nodes.supported_fraction[joint] += fraction;
    });
  }
  list_points();
  find_stable_step();
}

// Calls f(nodes, joint, area fraction) for the joints of all integration points with both faces.
template <int Dim>
template <class F>
void Joints<Dim>::each_contribution(std::size_t s, F&& f) {
  const auto& samples = system_.joints[s].samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    SampleNodes& sample_nodes = surfaces_[s].samples[k];
    if (!sample_nodes.has_both_faces()) continue;
    for (std::size_t c = 0; c < samples[k].area_fraction.size(); ++c)
      if (samples[k].area_fraction[c] > 0) f(sample_nodes, samples[k].joint[c], samples[k].area_fraction[c]);
  }
}

// The leapfrog scheme is stable if the largest eigenvalue of M^-1/2 K M^-1/2 is below 4/dt^2; the largest row sum
// bounds this eigenvalue (Gershgorin).
template <int Dim>
void Joints<Dim>::find_stable_step() {
  const auto scaled = [&](const NodeWeight& share) {
    return std::abs(share.weight) * std::sqrt(share.images * inverse_mass(share));
  };
  const double largest = find_row_sums(scaled, scaled);
  constexpr double share_of_limit = 0.5;
  stable_step_ = largest > 0 ? share_of_limit * 2 / std::sqrt(largest) : std::numeric_limits<double>::max();
  double ratio = 0.0;
  for (const auto& surface : system_.joints) ratio = std::max(ratio, surface.law->damping_ratio());
  if (ratio > 0) stable_step_ = std::min(stable_step_, share_of_limit * find_masses(ratio));
}

// Row sums of a matrix of the stiffnesses of all joints at each node, whose entry for two nodes of a joint is
// kA row(node) column(other node). Returns the largest one.
template <int Dim>
template <class Row, class Column>
double Joints<Dim>::find_row_sums(const Row& row, const Column& column) {
  stiffness_.resize(system_.fields.size());
  const auto each_share = [&](const SampleNodes& sample_nodes, auto&& f) {
    for (const auto& side : sample_nodes.side)
      for (const NodeWeight& share : side) f(share);
  };
  const auto stiffness = [&](const NodeWeight& share) -> double& {
    return stiffness_[share.field][static_cast<std::size_t>(share.node)];
  };
  for (auto& surface_nodes : surfaces_)
    for (const SampleNodes& sample_nodes : surface_nodes.samples)
      each_share(sample_nodes, [&](const NodeWeight& share) {
        stiffness_[share.field].resize(system_.fields[share.field].nodes.size());
        stiffness(share) = 0.0;
      });
  double largest = 0.0;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    auto& joints = system_.joints[s].joints;
    row_.assign(joints.size(), 0.0);
    each_contribution(s, [&](SampleNodes& sample_nodes, std::uint32_t joint, double fraction) {
      each_share(sample_nodes, [&](const NodeWeight& share) { row_[joint] += fraction * column(share); });
    });
    each_contribution(s, [&](SampleNodes& sample_nodes, std::uint32_t joint, double fraction) {
      const Joint& j = joints[joint];
      const double row_factor = std::max(j.kn, j.ks) * j.area * row_[joint] * fraction;
      each_share(sample_nodes, [&](const NodeWeight& share) {
        double& sum = stiffness(share);
        sum += row_factor * row(share);
        largest = std::max(largest, sum);
      });
    });
  }
  return largest;
}

// The mass of a joint is the one with which its spring has the frequency sqrt(S), where S is the largest row sum of
// M^-1 K at its nodes. For joints that move together, it is the joint's part of the reduced mass of both faces; the
// nodes of a joint count for all joints that they belong to, so that their whole mass would be too large. The row sums
// of the dashpots of ratio beta are then at most 2 beta sqrt(S), and the scheme is stable if S dt^2/4 + beta sqrt(S) dt
// <= 1. Returns the largest such dt.
template <int Dim>
double Joints<Dim>::find_masses(double ratio) {
  const double largest = find_row_sums(
      [&](const NodeWeight& share) { return std::abs(share.weight) * share.images * inverse_mass(share); },
      [](const NodeWeight& share) { return std::abs(share.weight); });
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const auto& joints = system_.joints[s].joints;
    row_.assign(joints.size(), 0.0);
    each_contribution(s, [&](SampleNodes& sample_nodes, std::uint32_t joint, double) {
      for (const auto& side : sample_nodes.side)
        for (const NodeWeight& share : side)
          row_[joint] = std::max(row_[joint], stiffness_[share.field][static_cast<std::size_t>(share.node)]);
    });
    auto& mass = surfaces_[s].mass;
    mass.resize(joints.size());
    for (std::size_t k = 0; k < joints.size(); ++k)
      mass[k] = row_[k] > 0 ? std::max(joints[k].kn, joints[k].ks) * joints[k].area / row_[k] : 0.0;
  }
  if (!(largest > 0)) return std::numeric_limits<double>::max();
  return 2 * (std::sqrt(1 + ratio * ratio) - ratio) / std::sqrt(largest);
}

template <int Dim>
void Joints<Dim>::add_forces(double dt) {
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    const JointSurface<Dim>& surface = system_.joints[s];
    each_contribution(s, [&](SampleNodes& sample_nodes, std::uint32_t joint, double fraction) {
      if (!is_supported(s, joint)) return;
      const Vec<Dim> force =
          fraction / surfaces_[s].supported_fraction[joint] * surface.force(joint).template head<Dim>();
      for (std::size_t f = 0; f < 2; ++f)
        for (const NodeWeight& share : sample_nodes.side[f]) {
          Node& at = node(share);
          const double shared = (f == 0 ? -1.0 : 1.0) * share.images * share.weight * inverse_mass(share);
          const Vec<Dim> a = shared * share.mirror.cwiseProduct(force);
          for (int d = 0; d < Dim; ++d) at.acceleration[d] += a[d], at.velocity[d] += dt * a[d];
        }
    });
  }
}

// Velocity and velocity gradient of a face, interpolated from the nodes of one side.
template <int Dim>
auto Joints<Dim>::motion(const std::vector<NodeWeight>& shares, bool filtered) const -> Motion {
  Motion out;
  for (const NodeWeight& share : shares) {
    const Field<Dim>& field = system_.fields[share.field];
    const auto at = static_cast<std::size_t>(share.node);
    const double* velocity = filtered && !field.rigid_contact ? field.filter[at].velocity : field.nodes[at].velocity;
    const Vec<Dim> v = share.mirror.cwiseProduct(Eigen::Map<const Vec<Dim>>(velocity));
    out.velocity += share.weight * v;
    out.gradient += v * share.slope.transpose();
  }
  return out;
}

// Velocities of the faces of all joints of a surface.
template <int Dim>
void Joints<Dim>::find_motion(std::size_t s, bool filtered) {
  Surface& surface_nodes = surfaces_[s];
  surface_nodes.motion.assign(system_.joints[s].joints.size(), {});
  for (SampleNodes& sample_nodes : surface_nodes.samples)
    for (std::size_t f = 0; f < 2; ++f) sample_nodes.motion[f] = motion(sample_nodes.side[f], filtered);
  each_contribution(s, [&](SampleNodes& sample_nodes, std::uint32_t joint, double fraction) {
    const double share = fraction / surface_nodes.supported_fraction[joint];
    for (std::size_t f = 0; f < 2; ++f) {
      surface_nodes.motion[joint][f].velocity += share * sample_nodes.motion[f].velocity;
      surface_nodes.motion[joint][f].gradient += share * sample_nodes.motion[f].gradient;
    }
  });
}

template <int Dim>
void Joints<Dim>::find_motion() {
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    find_motion(s, false);
    if (system_.joints[s].crack != JointSurface<Dim>::none) prescribe_face_velocities(s);
  }
}

template <int Dim>
void Joints<Dim>::update_laws(double dt, double time, bool filtered) {
  if (!(dt > 0)) return;
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    JointSurface<Dim>& surface = system_.joints[s];
    Surface& surface_nodes = surfaces_[s];
    const std::size_t count = surface.joints.size();
    find_motion(s, filtered);
    increments_.assign(count, {});
    if (surface.law->damping_ratio() > 0)
      for (std::size_t k = 0; k < count; ++k) increments_[k].mass = surface_nodes.mass[k];
    for (std::size_t k = 0; k < count; ++k) {
      Vec3 jump = Vec3::Zero();
      jump.template head<Dim>() = surface_nodes.motion[k][1].velocity - surface_nodes.motion[k][0].velocity;
      JointIncrement& d = increments_[k];
      d.normal = dt * jump.dot(surface.axes[k].n), d.shear = dt * surface.axes[k].tangent(jump);
      d.gap = surface.joints[k].gap + d.normal, d.dt = dt, d.time = time;
      Vec3 at = Vec3::Zero();
      at.template head<Dim>() = surface.x[k];
      d.pressure = surface.law->pore_pressure(at, d.time);
    }
    std::vector<Vec3> before;
    if (rigid(surface, 0) || rigid(surface, 1))
      for (std::size_t k = 0; k < count; ++k) before.push_back(surface.force(k));
    // the law is evaluated for ranges of consecutive joints with both faces
    for (std::size_t first = 0, end = 0; first < count; first = end + 1) {
      for (end = first; end < count && is_supported(s, end);) ++end;
      update(surface, s, first, std::min(end, std::max(first, surface.deforming)), time);
      if (end < count) release(surface.joints[end]);
    }
    if (!before.empty()) record_rigid_work(s, before, dt);
  }
}

template <int Dim>
void Joints<Dim>::update(JointSurface<Dim>& surface, std::size_t s, std::size_t first, std::size_t end, double time) {
  new_events_.clear();
  surface.law->update({surface.joints.data() + first, end - first}, {increments_.data() + first, end - first},
                      new_events_);
  for (JointEvent& event : new_events_) {
    event.contact += first;
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
    for (std::size_t k = 0; k < surface.joints.size(); ++k) {
      const auto& [below, above] = surfaces_[s].motion[k];
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
    }
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
