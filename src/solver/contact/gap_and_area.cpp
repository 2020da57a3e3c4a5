// SPDX-License-Identifier: MIT
/// How two fields face each other at a node: gap, area, opening, and what their particles remember.

#include "solver/contact/contact.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
template <int Dim>
void Contact<Dim>::face(const ContactNode& node, ContactPair& pair, Faces& kept, Scratch& s) {
  kept.node = node.number, kept.a = members_[pair.a].field, kept.b = members_[pair.b].field;
  kept.count = {};
  kept.apart = false;
  if (pair.crack >= 0 || !pair.law->looks_at_faces()) return;
  const ContactMember &a = members_[pair.a], &b = members_[pair.b];
  look_around(node, s, a, b);
  auto n = chosen_normal(node, s, a, b);
  pair.apart = kept.apart = !n;
  if (pair.apart) return;
  for (int d = 0; d < Dim; ++d)
    if (node.mirrored >> d & 1) (*n)[d] = 0.0;
  const double norm = n->norm();
  pair.apart = kept.apart = !(norm > 1e-6);
  if (pair.apart) return;
  *n /= norm;
  pair.state.normal.setZero();
  pair.state.normal.template head<Dim>() = *n;
  kept.play = 0.0;
  if (model_.contact.separation == Separation::edges && !s.sides[0].empty() && !s.sides[1].empty())
    kept.play = play_between<Dim>(s.sides[0], s.sides[1], *n, band * h_, smooth * h_);
  pair.state.gap = separation(node, pair, s, *n) + kept.play;
  pair.state.area = area(node, pair, s, *n);
  if (model_.contact.at_faces || model_.heat.contact_heating) {
    const double of_a = face_position<Dim>(s.sides[0], *n, band * h_),
                 of_b = -face_position<Dim>(s.sides[1], -*n, band * h_);
    pair.face = face_between(pair, of_a, of_b);
  }
  kept.normal = pair.state.normal, kept.area = pair.state.area;
  if (!model_.contact.joints.empty()) kept.beside = beside(s, *n);
  if (keeps_faces_) keep(kept, s, *n);
  if (pair.law->interface()) pair.state.opening = opening(node, s, *n);
  if (pair.law->remembers()) recall(node, pair, s);
}

// Where the common face lies along the normal: rigid ones do not yield.
template <int Dim>
double Contact<Dim>::face_between(const ContactPair& pair, double of_a, double of_b) const {
  if (members_[pair.a].inverse_mass == 0.0) return of_a;
  return members_[pair.b].inverse_mass == 0.0 ? of_b : 0.5 * (of_a + of_b);
}

// From the volume gradients: of both sides for interfaces, which belong to both while they are open; else of the
// smaller, as faces that end elsewhere than their partners meet on the smaller.
template <int Dim>
double Contact<Dim>::area(const ContactNode& node, const ContactPair& pair, Scratch& s, const Vec<Dim>& n) const {
  const auto slope = [&](const ContactMember& m) {
    const VolumeNode& v = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return std::abs(Eigen::Map<const Vec<Dim>>(v.gradient).dot(n));
  };
  const double of_a = slope(members_[pair.a]), of_b = slope(members_[pair.b]);
  if (needs_areas_) {
    // The gradient of a thin body contains its back.
    const bool thin_a = is_thin(node, s, 0, n), thin_b = is_thin(node, s, 1, -n);
    if (thin_a && thin_b) return std::max(of_a, of_b);
    if (thin_a || thin_b) return thin_a ? of_b : of_a;
  }
  return pair.law->interface() ? 0.5 * (of_a + of_b) : std::min(of_a, of_b);
}

// Whether the back of a side, seen along `out`, is as near to the node as to change its gradient there.
template <int Dim>
bool Contact<Dim>::is_thin(const ContactNode& node, Scratch& s, std::size_t side, const Vec<Dim>& out) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const double support = cloud_.reach() - h_;
  for (const auto* group : s.groups[side]) {
    if (group->bound(centre, -out) < support) continue;
    s.reach.resize(group->end - group->begin);
    cloud_.measure(*group, centre, -out, s.reach.data());
    if (*std::max_element(s.reach.begin(), s.reach.end()) >= support) return false;
  }
  return true;
}

template <int Dim>
double Contact<Dim>::separation(const ContactNode& node, const ContactPair& pair, Scratch& s, const Vec<Dim>& n) const {
  const ContactSpec& c = model_.contact;
  if (c.separation == Separation::edges) {
    if (s.sides[0].empty() || s.sides[1].empty()) return std::numeric_limits<double>::infinity();
    return -face_position<Dim>(s.sides[1], -n, band * h_) - face_position<Dim>(s.sides[0], n, band * h_);
  }
  // Mean position (or displacement) of the particles at the node, along the normal
  const auto mean = [&](const ContactMember& m) {
    const VolumeNode& v = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(v.moment) / v.volume);
  };
  const Vec<Dim> xa = mean(members_[pair.a]), xb = mean(members_[pair.b]);
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

// How far along the face it is to the nearest particle at it, of the side that begins farther away.
template <int Dim>
double Contact<Dim>::beside(Scratch& s, const Vec<Dim>& n) const {
  double farthest = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    ParticleSet<Dim>& of = s.sides[side];
    const double face = face_position<Dim>(of, side == 0 ? n : Vec<Dim>(-n), band * h_);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < of.size(); ++i)
      if (of.reach[i] >= face - kept_depth * h_) nearest = std::min(nearest, of.sideways[i]);
    if (std::isfinite(nearest)) farthest = std::max(farthest, std::sqrt(nearest));
  }
  return farthest;
}

template <int Dim>
double Contact<Dim>::weight(const Vec<Dim>& distance) const {
  double w = 1.0;
  for (int d = 0; d < Dim; ++d) w *= std::max(0.0, 1.0 - std::abs(distance[d]) / (1.5 * system_.lattice.spacing[d]));
  return w;
}

// Jump of the displacement at the interface: each side's mean, carried to the interface along its normal by its own
// deformation, so that strain between the particles and the interface does not count. Carried along the interface, too,
// what alternates from node to node there would grow out of round-off under stiff springs.
template <int Dim>
Vec3 Contact<Dim>::opening(const ContactNode& node, Scratch& s, const Vec<Dim>& n) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const double middle =
      0.5 * (face_position<Dim>(s.sides[0], n, band * h_) - face_position<Dim>(s.sides[1], -n, band * h_));
  const Vec<Dim> at = centre + middle * n;
  const auto displacement = [&](std::size_t side) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    double total = 0.0;
    each_point_of(s.groups[side], centre, [&](const ParticleDomain<Dim>& p, const ParticleLabel& label) {
      const double w = weight(p.x - centre);
      if (!(w > 0)) return;
      auto& body = *bodies_[label.body];
      const auto origin = body.particles[body.origin];
      Vec<Dim> u = p.x;
      for (std::size_t d = 0; d < Dim; ++d) u[static_cast<Eigen::Index>(d)] -= origin[d][label.particle];
      if (body.particles.has_deformation()) {
        const Mat3 F = load_full<Dim>(body.particles.F(), static_cast<int>(label.particle));
        Mat<Dim> since_start = F.template topLeftCorner<Dim, Dim>();
        if (body.first_inverse) {
          Mat<Dim> first;
          for (std::size_t k = 0; k < Dim * Dim; ++k)
            first(static_cast<int>(k) / Dim, static_cast<int>(k) % Dim) =
                body.particles[body.first_inverse][k][label.particle];
          since_start *= first;
        }
        u += (Mat<Dim>::Identity() - since_start.inverse()) * (at - p.x).dot(n) * n;
      }
      sum += w * u, total += w;
    });
    return Vec<Dim>(total > 0 ? Vec<Dim>(sum / total) : sum);
  };
  Vec3 jump = Vec3::Zero();
  jump.template head<Dim>() = displacement(1) - displacement(0);
  return jump;
}

// What the particles near the node remember.
template <int Dim>
void Contact<Dim>::recall(const ContactNode& node, ContactPair& pair, const Scratch& s) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  double total = 0.0, slip = 0.0, whole = 0.0, broken = 0.0;
  const auto recollect = [&](const ParticleDomain<Dim>& p, const ParticleLabel& label) {
    auto& body = *bodies_[label.body];
    if (!body.contact_slip) return;
    const double w = weight(p.x - centre);
    const double bond = body.particles[body.contact_bond][label.particle];
    total += w, slip += w * body.particles[body.contact_slip][label.particle];
    whole += bond > 0 ? w : 0.0, broken += bond < 0 ? w : 0.0;
  };
  for (const auto& groups : s.groups) each_point_of(groups, centre, recollect);
  pair.state.slip = total > 0 ? slip / total : 0.0;
  pair.state.cell = h_;
  pair.state.bond = whole == 0 && broken == 0 ? Bond::none : broken > whole ? Bond::broken : Bond::whole;
  // Faces that touch at the very start are joined.
  if (system_.step == 0 && std::abs(pair.state.gap) < 1e-6 * h_ && pair.state.bond == Bond::none)
    pair.state.bond = Bond::whole;
}

template void Contact<2>::face(const ContactNode&, ContactPair&, Faces&, Scratch&);
template void Contact<3>::face(const ContactNode&, ContactPair&, Faces&, Scratch&);
template double Contact<2>::face_between(const ContactPair&, double, double) const;
template double Contact<3>::face_between(const ContactPair&, double, double) const;
template double Contact<2>::weight(const Vec<2>&) const;
template double Contact<3>::weight(const Vec<3>&) const;

}  // namespace tribo
