// SPDX-License-Identifier: MIT
#include "solver/contact/contact_view.hpp"

#include "base/parallel.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace tribo {
namespace {

constexpr double reach_of_states = 1.5;  // from particles to the nodes whose state they show [cells]
constexpr double reach_of_nodes = 2;     // from particles at a face to the nodes that carry its impulses [cells]
constexpr double depth = 0.5;            // of the face of a particle behind the face of its body [particles]
constexpr double in_front = 0.9;         // a particle this much smaller than its domain covers those behind it
constexpr double carrying = 0.1;      // a node with less force than this has no state [mean force of the nodes around]
constexpr double same_normal = 0.99;  // cosine
constexpr double near = 1.25;         // centres of the particles that may cover one [cells]
constexpr double beyond = 1.2;        // a side with a particle this far from the centre has no free face [half axes]

// Finds the particles that form the faces of their bodies.
template <int Dim>
class FaceRow {
 public:
  FaceRow(const System<Dim>& system, const ParticleCloud<Dim>& cloud) : lattice_(system.lattice), cloud_(cloud) {}

  // Whether a particle of the cloud lies at the face of its body along the unit vector n: no other particle of its
  // field lies in front of its centre, and its domain reaches the face of those beside it but for half a particle.
  bool contains(std::size_t k, const Vec<Dim>& n) const {
    const ParticleDomain<Dim> particle = cloud_.domain(k);
    const double thickness = 2 * (particle.axes.transpose() * n).cwiseAbs().sum();
    const double beside = std::max(0.5 * thickness, 0.25 * lattice_.spacing.maxCoeff());
    double face = particle.reach(particle.x, n);
    const bool covered = any_near(k, [&](const ParticleDomain<Dim>& other) {
      const Vec<Dim> offset = other.x - particle.x;
      if ((offset - offset.dot(n) * n).norm() <= beside) face = std::max(face, other.reach(particle.x, n));
      return covers(other, particle.x, n);
    });
    return !covered && face - particle.reach(particle.x, n) <= depth * thickness;
  }

  // Area of the sides of a particle that no other particle of its field covers, projected along the unit vector n, as a
  // multiple of its volume.
  double area_per_volume(std::size_t k, const Vec<Dim>& n) const {
    constexpr int count = Dim == 2 ? 4 : 16;  // points on a side
    const ParticleDomain<Dim> particle = cloud_.domain(k);
    const Vec<Dim> projected = 0.5 * (particle.axes.inverse() * n);
    double area = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      int exposed = 0;
      for (int q = 0; q < count; ++q) {
        Vec<Dim> at;
        for (int d = 0, rest = q; d < Dim; ++d) {
          if (d == axis) continue;
          at[d] = -0.75 + 0.5 * (rest % 4), rest /= 4;
        }
        at[axis] = std::copysign(beyond, projected[axis]);
        const Vec<Dim> x = particle.x + particle.axes * at;
        exposed += any_near(k, [&](const ParticleDomain<Dim>& other) { return contains(other, x); }) ? 0 : 1;
      }
      area += std::abs(projected[axis]) * exposed / count;
    }
    return area;
  }

 private:
  // Whether f(domain) is true for any other particle of the same field near particle k.
  template <class F>
  bool any_near(std::size_t k, F&& f) const {
    const double distance = near * lattice_.spacing.maxCoeff();
    const Vec<Dim> x = cloud_.centre(k);
    Index<Dim> node;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      node[d] = static_cast<int>(std::lround((x[axis] - lattice_.origin[axis]) / lattice_.spacing[axis]));
    }
    bool found = false;
    cloud_.each_group(node, [&](const ParticleGroup<Dim>& group) {
      if (found || group.field != cloud_.label(k).field || is_far(group, x, distance)) return;
      for (std::uint32_t q = group.begin; q < group.end && !found; ++q)
        found = q != k && (cloud_.centre(q) - x).squaredNorm() <= distance * distance && f(cloud_.domain(q));
    });
    return found;
  }
  static bool is_far(const ParticleGroup<Dim>& group, const Vec<Dim>& x, double distance) {
    return (group.low - x).maxCoeff() > distance || (x - group.high).maxCoeff() > distance;
  }
  static bool contains(const ParticleDomain<Dim>& domain, const Vec<Dim>& x) {
    return (domain.axes.inverse() * (x - domain.x)).cwiseAbs().maxCoeff() < 1;
  }
  // Whether the ray from x along n meets the domain.
  static bool covers(const ParticleDomain<Dim>& domain, const Vec<Dim>& x, const Vec<Dim>& n) {
    if ((domain.x - x).dot(n) <= 0) return false;
    const Mat<Dim> inverse = domain.axes.inverse();
    const Vec<Dim> start = inverse * (x - domain.x), step = inverse * n;
    double enter = 0.0, leave = std::numeric_limits<double>::infinity();
    for (int d = 0; d < Dim; ++d) {
      const double s = start[d], v = step[d];
      if (std::abs(v) < 1e-12) {
        if (std::abs(s) > in_front) return false;
        continue;
      }
      enter = std::max(enter, (-in_front * (v > 0 ? 1.0 : -1.0) - s) / v);
      leave = std::min(leave, (in_front * (v > 0 ? 1.0 : -1.0) - s) / v);
    }
    return enter < leave;
  }

  const Lattice<Dim>& lattice_;
  const ParticleCloud<Dim>& cloud_;
};

// Whether a particle is at the face, for the normals of several pairs; the answer for a similar normal is kept.
template <int Dim>
class FaceTest {
 public:
  FaceTest(const FaceRow<Dim>& row, std::size_t k) : row_(row), k_(k) {}
  bool operator()(const Vec<Dim>& n) {
    for (std::size_t i = 0; i < count_; ++i)
      if (n.dot(normals_[i]) > same_normal) return answers_[i];
    const bool answer = row_.contains(k_, n);
    if (count_ < normals_.size()) normals_[count_] = n, answers_[count_++] = answer;
    return answer;
  }

 private:
  const FaceRow<Dim>& row_;
  std::size_t k_, count_ = 0;
  std::array<Vec<Dim>, 4> normals_;
  std::array<bool, 4> answers_{};
};

// A pair of faces at a node near a particle of one of them.
template <int Dim>
struct Touch {
  const ContactPair* pair;
  std::size_t face;  // position of the face among those of all pairs
  double weight;
  Vec<Dim> out;      // signs of the components of vectors of the pair that point out of the body of the particle
  bool shows_state;  // the particle is so near that it shows the state of the pair
};

// The touches of a particle at the face of its body, with the area of this face.
template <int Dim>
struct FaceParticle {
  ParticleLabel label;
  std::vector<Touch<Dim>> touches;
  Vec<Dim> normal;    // out of its body
  double area = 0.0;  // of the sides of the particle that face along the normal [length^2]
};

template <int Dim>
FaceParticle<Dim> find_touches(const System<Dim>& system, const ContactSearch<Dim>& search,
                               const ParticleCloud<Dim>& cloud, const std::vector<Body<Dim>*>& bodies, std::size_t k) {
  const ParticleLabel& label = cloud.label(k);
  FaceParticle<Dim> found{label, {}, Vec<Dim>::Zero()};
  if (label.image != 0) return found;
  const FaceRow<Dim> row(system, cloud);
  FaceTest<Dim> is_at_face(row, k);
  const ContactPair* const first = search.found().pairs.data();
  Vec<Dim> normal = Vec<Dim>::Zero();
  each_pair_near(search, system.lattice, cloud.planes(), cloud.domain(k), label.field, reach_of_nodes,
                 [&](const ContactPair& pair, const Vec<Dim>& signs, double w, double side, double distance) {
                   if (pair.update_status == ContactStatus::open) return;
                   const Vec<Dim> out = side * signs;
                   const Vec<Dim> n = out.cwiseProduct(pair.state.normal.template head<Dim>());
                   if (!is_at_face(n)) return;
                   const auto face = 2 * static_cast<std::size_t>(&pair - first) + (side > 0 ? 0 : 1);
                   found.touches.push_back({&pair, face, w, out, distance < reach_of_states});
                   normal += w * n;
                 });
  const bool touches =
      std::any_of(found.touches.begin(), found.touches.end(), [](const auto& touch) { return touch.shows_state; });
  if (!touches) return found.touches.clear(), found;
  if (normal.norm() > 0) normal.normalize();
  found.normal = normal;
  const double area = bodies[label.body]->particles.volume()[label.particle] * row.area_per_volume(k, normal);
  found.area = std::isfinite(area) ? area : 0.0;  // not of a domain that is pressed flat
  return found;
}

// The particles at the faces of their bodies, in the order of the cloud.
template <int Dim>
std::vector<FaceParticle<Dim>> find_face_particles(const System<Dim>& system, const ContactSearch<Dim>& search,
                                                   const ParticleCloud<Dim>& cloud,
                                                   const std::vector<Body<Dim>*>& bodies) {
  constexpr std::size_t part_size = 1024;
  std::vector<std::vector<FaceParticle<Dim>>> parts((cloud.size() + part_size - 1) / part_size);
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t part) {
    const std::size_t first = static_cast<std::size_t>(part) * part_size;
    for (std::size_t k = first; k < std::min(first + part_size, cloud.size()); ++k)
      if (auto found = find_touches(system, search, cloud, bodies, k); !found.touches.empty())
        parts[static_cast<std::size_t>(part)].push_back(std::move(found));
  });
  std::vector<FaceParticle<Dim>> all;
  for (auto& part : parts) std::ranges::move(part, std::back_inserter(all));
  return all;
}

// Whether the pairs that carry the force on a particle slide. Those that carry next to no force may slide beside others
// that hold.
template <int Dim>
bool slides(const FaceParticle<Dim>& particle) {
  double weight = 0.0, force = 0.0, slip = 0.0, stick = 0.0;
  for (const Touch<Dim>& t : particle.touches)
    if (t.shows_state) weight += t.weight, force += t.weight * t.pair->update_impulse.norm();
  for (const Touch<Dim>& t : particle.touches)
    if (t.shows_state && t.pair->update_impulse.norm() * weight >= carrying * force)
      (t.pair->update_status == ContactStatus::slip ? slip : stick) += t.weight;
  return slip > stick;
}

}  // namespace

// The force of a pair acts on the particles at each of its faces as a traction in proportion to their weights, so that
// these tractions times the areas of the particles have the contact force as sum.
template <int Dim>
void fill_contact_view(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                       const std::vector<Body<Dim>*>& bodies) {
  const auto particles = find_face_particles(system, search, cloud, bodies);
  const ContactNodes<Dim>& found = search.found();
  std::vector<double> area(2 * found.pairs.size()), share(found.pairs.size());
  for (const FaceParticle<Dim>& particle : particles)
    for (const Touch<Dim>& t : particle.touches) area[t.face] += t.weight * particle.area;
  for (const ContactNode<Dim>& node : found.nodes)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) share[p] = node.ownership;
  for (auto* body : bodies) body->contacts.clear();
  for (const FaceParticle<Dim>& particle : particles) {
    Vec<Dim> traction = Vec<Dim>::Zero();
    for (const Touch<Dim>& t : particle.touches)
      if (area[t.face] > 0)
        traction += share[t.face / 2] * t.weight / (area[t.face] * t.pair->state.dt) *
                    t.out.cwiseProduct(t.pair->update_impulse.template head<Dim>());
    const ParticleLabel& label = particle.label;
    bodies[label.body]->contacts.push_back({label.particle, slides(particle), traction, particle.normal});
  }
  for (auto* body : bodies)
    std::sort(body->contacts.begin(), body->contacts.end(),
              [](const auto& a, const auto& b) { return a.particle < b.particle; });
}

template void fill_contact_view<2>(const System<2>&, const ContactSearch<2>&, const ParticleCloud<2>&,
                                   const std::vector<Body<2>*>&);
template void fill_contact_view<3>(const System<3>&, const ContactSearch<3>&, const ParticleCloud<3>&,
                                   const std::vector<Body<3>*>&);

}  // namespace tribo
