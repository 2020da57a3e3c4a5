// SPDX-License-Identifier: MIT
#include "solver/contact/contact_view.hpp"

#include "base/parallel.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tribo {
namespace {

constexpr double closed = 0.1;        // a larger gap counts as open [cells]
constexpr double depth = 0.5;         // of the face of a particle behind the face of its body [particles]
constexpr double in_front = 0.9;      // a particle this much smaller than its domain covers those behind it
constexpr double carrying = 0.1;      // a node with less force than this has no state [mean force of the nodes around]
constexpr double same_normal = 0.99;  // cosine
constexpr double near = 1.25;         // centres of the particles that may cover one [cells]

// Finds the particles that form the faces of their bodies.
template <int Dim>
class FaceRow {
 public:
  FaceRow(const System<Dim>& system, const ParticleCloud<Dim>& cloud) : lattice_(system.lattice), cloud_(cloud) {}

  // Whether a particle of the cloud lies at the face of its body along the unit vector n: no other particle of its
  // field lies in front of its centre, and its domain reaches the face of those beside it but for half a particle.
  bool contains(std::size_t k, const Vec<Dim>& n) const {
    const double h = lattice_.spacing.maxCoeff();
    const ParticleDomain<Dim> particle = cloud_.domain(k);
    const double thickness = 2 * (particle.axes.transpose() * n).cwiseAbs().sum();
    const double beside = std::max(0.5 * thickness, 0.25 * h);
    Index<Dim> node;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      node[d] = static_cast<int>(std::lround((particle.x[axis] - lattice_.origin[axis]) / lattice_.spacing[axis]));
    }
    double face = particle.reach(particle.x, n);
    bool covered = false;
    cloud_.each_group(node, [&](const ParticleGroup<Dim>& group) {
      if (covered || group.field != cloud_.label(k).field || is_far(group, particle.x, near * h)) return;
      for (std::uint32_t q = group.begin; q < group.end && !covered; ++q) {
        if (q == k || (cloud_.centre(q) - particle.x).squaredNorm() > near * near * h * h) continue;
        const ParticleDomain<Dim> other = cloud_.domain(q);
        const Vec<Dim> offset = other.x - particle.x;
        covered = covers(other, particle.x, n);
        if ((offset - offset.dot(n) * n).norm() <= beside) face = std::max(face, other.reach(particle.x, n));
      }
    });
    return !covered && face - particle.reach(particle.x, n) <= depth * thickness;
  }

 private:
  static bool is_far(const ParticleGroup<Dim>& group, const Vec<Dim>& x, double distance) {
    return (group.low - x).maxCoeff() > distance || (x - group.high).maxCoeff() > distance;
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

}  // namespace

template <int Dim>
void fill_contact_view(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                       const std::vector<Body<Dim>*>& bodies) {
  const double h = system.lattice.spacing.maxCoeff();
  std::vector<std::optional<ContactOfParticle<Dim>>> contacts(cloud.size());
  const FaceRow<Dim> row(system, cloud);
  parallel_for(static_cast<std::ptrdiff_t>(cloud.size()), [&](std::ptrdiff_t at) {
    const auto k = static_cast<std::size_t>(at);
    const ParticleLabel& label = cloud.label(k);
    if (label.image != 0) return;
    FaceTest<Dim> is_at_face(row, k);
    // Calls f(pair, weight, signs of the components of vectors that point out of the body of the particle).
    const auto each_touching_pair = [&](auto&& f) {
      each_pair_near(search, system.lattice, cloud.planes(), cloud.domain(k), label.field,
                     [&](const ContactPair& pair, const Vec<Dim>& signs, double w, double side) {
                       if (pair.state.gap > closed * h) return;
                       const Vec<Dim> out = side * signs;
                       if (is_at_face(out.cwiseProduct(pair.state.normal.template head<Dim>()))) f(pair, w, out);
                     });
    };
    double weight = 0.0, force = 0.0, total = 0.0;
    Vec<Dim> traction = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero();
    each_touching_pair([&](const ContactPair& pair, double w, const Vec<Dim>& out) {
      // The nodes on one side of a face may carry the pressure of those on the other side, too. So the area of nodes
      // without an impulse counts in the mean traction.
      total += w * pair.state.area;
      if (pair.update_status == ContactStatus::open) return;
      weight += w, force += w * pair.update_impulse.norm();
      normal += w * out.cwiseProduct(pair.state.normal.template head<Dim>());
      traction += w / pair.state.dt * out.cwiseProduct(pair.update_impulse.template head<Dim>());
    });
    if (weight == 0.0) return;
    double slip = 0.0, stick = 0.0;  // weights of the pairs in either state
    each_touching_pair([&](const ContactPair& pair, double w, const Vec<Dim>&) {
      // Nodes that carry next to no force may slide beside those that hold
      const bool carries = pair.update_impulse.norm() * weight >= carrying * force;
      if (pair.update_status != ContactStatus::open && carries)
        (pair.update_status == ContactStatus::slip ? slip : stick) += w;
    });
    if (total > 0) traction /= total;
    if (normal.norm() > 0) normal.normalize();
    contacts[k] = {label.particle, slip > stick, traction, normal};
  });
  for (auto* body : bodies) body->contacts.clear();
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts[k]) bodies[cloud.label(k).body]->contacts.push_back(*contacts[k]);
  for (auto* body : bodies)
    std::sort(body->contacts.begin(), body->contacts.end(),
              [](const auto& a, const auto& b) { return a.particle < b.particle; });
}

template void fill_contact_view<2>(const System<2>&, const ContactSearch<2>&, const ParticleCloud<2>&,
                                   const std::vector<Body<2>*>&);
template void fill_contact_view<3>(const System<3>&, const ContactSearch<3>&, const ParticleCloud<3>&,
                                   const std::vector<Body<3>*>&);

}  // namespace tribo
