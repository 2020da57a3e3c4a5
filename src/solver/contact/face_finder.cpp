// SPDX-License-Identifier: MIT
#include "solver/contact/face_finder.hpp"

#include "solver/contact/face_geometry.hpp"
#include "solver/contact/face_tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

using namespace face_tolerance;

// A body with less than this fraction of the other one's volume at a node just reaches over the face.
constexpr double little_volume = 0.03;

}  // namespace

template <int Dim>
FaceFinder<Dim>::FaceFinder(const Model& model, const System<Dim>& system, const ParticleCloud<Dim>& cloud,
                            const ContactLaws<Dim>& laws)
    : model_(model),
      system_(system),
      cloud_(cloud),
      normals_(model.contact, system, cloud),
      needs_areas_(laws.any_uses_area() || model.heat.contact_heating || model.contact.normals != NormalMethod::margin),
      h_(system.lattice.spacing.maxCoeff()) {}

template <int Dim>
bool FaceFinder<Dim>::find(const ContactNode<Dim>& node, std::span<const ContactMember> members, ContactPair& pair,
                           ContactFace& face, NearParticles<Dim>& near) const {
  const ContactMember &a = members[pair.a], &b = members[pair.b];
  if (pair.crack >= 0 || !pair.law->uses_face()) return false;
  auto n = normals_.find(node, a, b, near);
  pair.has_no_face = face.missing = !n;
  if (pair.has_no_face) return false;
  for (int d = 0; d < Dim; ++d)
    if (node.mirrored_axes >> d & 1) (*n)[d] = 0.0;
  const double norm = n->norm();
  pair.has_no_face = face.missing = !(norm > 1e-6);
  if (pair.has_no_face) return false;
  *n /= norm;
  pair.state.normal.setZero();
  pair.state.normal.template head<Dim>() = *n;
  face.gap_correction = 0.0;
  if (model_.contact.separation == Separation::edges && !near.sides[0].empty() && !near.sides[1].empty())
    face.gap_correction = gap_correction<Dim>(near.sides[0], near.sides[1], *n, band * h_, max_gap_correction * h_);
  pair.state.gap = gap_between_sides(node, a, b, near, *n) + face.gap_correction;
  pair.state.area = area(node, a, b, near, *n);
  if (system_.contact_at_faces || model_.heat.contact_heating) {
    const double of_a = face_position<Dim>(near.sides[0], *n, band * h_),
                 of_b = -face_position<Dim>(near.sides[1], -*n, band * h_);
    pair.face_position = common_face_position(a, b, of_a, of_b);
  }
  face.foremost_offset.setZero();
  // Faces farther apart do not meet before the face is found anew.
  const bool near_each_other = pair.state.gap < 0.2 * h_;
  if (near_each_other && system_.contact_at_faces && model_.contact.separation == Separation::edges)
    face.foremost_offset.template head<Dim>() =
        foremost_offset<Dim>({&near.sides[0], &near.sides[1]},
                             {system_.fields[a.field].curved, system_.fields[b.field].curved}, *n, band * h_, h_);
  for (int d = 0; d < Dim; ++d)
    if (node.mirrored_axes >> d & 1) face.foremost_offset[d] = 0.0;
  pair.foremost_offset = face.foremost_offset;
  face.normal = pair.state.normal, face.area = pair.state.area;
  if (!model_.contact.joints.empty()) face.offset_along_face = offset_along_face(near, *n);
  return true;
}

// The share of the node in the area of the face, |sum_p V_p grad w_Ip . n|, the smaller one of both sides: where one
// face ends before the other, they are in contact only along the shorter one. A body that just reaches over the face
// has little volume at a node inside the other body, whose gradient is zero there. The force of its stress on that node
// is proportional to its own gradient, so the area is that of this gradient: bonds and friction with cohesion would
// otherwise have no strength there, and the node would strain the body without limit.
template <int Dim>
double FaceFinder<Dim>::area(const ContactNode<Dim>& node, const ContactMember& a, const ContactMember& b,
                             NearParticles<Dim>& near, const Vec<Dim>& n) const {
  const auto projected_gradient = [&](const ContactMember& m) {
    return std::abs(Eigen::Map<const Vec<Dim>>(m.volumes->gradient).dot(n));
  };
  const double of_a = projected_gradient(a), of_b = projected_gradient(b);
  if (needs_areas_) {
    // The volume gradient of a thin body also contains its back face, so it is no measure of the area.
    const bool thin_a = is_thin(node, near, 0, n), thin_b = is_thin(node, near, 1, -n);
    if (thin_a && thin_b) return std::max(of_a, of_b);
    if (thin_a || thin_b) return thin_a ? of_b : of_a;
  }
  const double least = std::min(of_a, of_b);
  const double volume_a = a.volumes->volume, volume_b = b.volumes->volume;
  const double ratio = std::min(volume_a, volume_b) / (little_volume * std::max(volume_a, volume_b));
  const double of_light = volume_a < volume_b ? of_a : of_b;
  return ratio < 1 ? of_light + ratio * (least - of_light) : least;
}

// Whether the back face of a side, opposite to `out`, lies within the support of the shape function of the node.
template <int Dim>
bool FaceFinder<Dim>::is_thin(const ContactNode<Dim>& node, NearParticles<Dim>& near, std::size_t side,
                              const Vec<Dim>& out) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const double support = cloud_.reach() - h_;
  for (const auto* group : near.groups[side]) {
    if (group->reach_bound(centre, -out) < support) continue;
    near.reach.resize(group->end - group->begin);
    cloud_.compute_reach(*group, centre, -out, near.reach.data());
    if (*std::max_element(near.reach.begin(), near.reach.end()) >= support) return false;
  }
  return true;
}

// The gap by the method of the model (Separation), without the correction for curved faces.
template <int Dim>
double FaceFinder<Dim>::gap_between_sides(const ContactNode<Dim>& node, const ContactMember& a, const ContactMember& b,
                                          NearParticles<Dim>& near, const Vec<Dim>& n) const {
  const ContactSpec& c = model_.contact;
  if (c.separation == Separation::edges) {
    if (near.sides[0].empty() || near.sides[1].empty()) return std::numeric_limits<double>::infinity();
    return -face_position<Dim>(near.sides[1], -n, band * h_) - face_position<Dim>(near.sides[0], n, band * h_);
  }
  // The first moment of the volume at the node holds positions or displacements.
  const auto mean = [](const ContactMember& m) {
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(m.volumes->moment) / m.volumes->volume);
  };
  const Vec<Dim> xa = mean(a), xb = mean(b);
  if (c.separation == Separation::displacements) return (xb - xa).dot(n);
  const double across = n.cwiseProduct(system_.lattice.spacing).norm();
  if (c.position > 0) return (xb - xa).dot(n) - c.position * across;
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const auto distance = [&](const Vec<Dim>& x) {
    const double e = (x - centre).dot(n) / (1.25 * across), q = -c.position;
    return e > 0 ? 2 * std::pow(e, q) - 1 : 1 - 2 * std::pow(-e, q);
  };
  return across * (distance(xb) - distance(xa));
}

// The distance along the face from the node to the nearest particle at the face; of the two sides, the larger distance.
template <int Dim>
double FaceFinder<Dim>::offset_along_face(NearParticles<Dim>& near, const Vec<Dim>& n) const {
  double farthest = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = near.sides[side];
    const double face = face_position<Dim>(of, side == 0 ? n : Vec<Dim>(-n), band * h_);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < of.size(); ++i)
      if (of.reach[i] >= face - cached_depth * h_) nearest = std::min(nearest, of.offset_squared[i]);
    if (std::isfinite(nearest)) farthest = std::max(farthest, std::sqrt(nearest));
  }
  return farthest;
}

template class FaceFinder<2>;
template class FaceFinder<3>;

}  // namespace tribo
