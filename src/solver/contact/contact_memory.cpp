// SPDX-License-Identifier: MIT
#include "solver/contact/contact_memory.hpp"

#include "base/parallel.hpp"
#include "solver/contact/face_geometry.hpp"
#include "solver/contact/face_tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

// The gap of a pair is exact only if it is found from the domains; one from the positions of the particles does not
// vanish where faces touch.
template <int Dim>
bool ContactMemory<Dim>::domains_touch(const ContactPair& pair, NearParticles<Dim>& near) const {
  constexpr double touching = 1e-6;  // cells
  if (std::abs(pair.state.gap) < touching * h_) return true;
  if (near.sides[0].empty() || near.sides[1].empty()) return false;
  const Vec<Dim> n = pair.state.normal.template head<Dim>();
  const double band = face_tolerance::band * h_;
  const double gap = -face_position<Dim>(near.sides[1], -n, band) - face_position<Dim>(near.sides[0], n, band);
  return std::abs(gap) < touching * h_;
}

template <int Dim>
void ContactMemory<Dim>::read(const ContactNode<Dim>& node, ContactPair& pair, NearParticles<Dim>& near) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  double total = 0.0, slip = 0.0, whole = 0.0, broken = 0.0;
  const auto add = [&](const ParticleDomain<Dim>& p, const ParticleLabel& label) {
    auto& body = *bodies_[label.body];
    if (!body.contact_slip) return;
    const double w = particle_weight<Dim>(p.x - centre, system_.lattice.spacing);
    const double bond = body.particles[body.contact_bond][label.particle];
    total += w, slip += w * body.particles[body.contact_slip][label.particle];
    whole += bond > 0 ? w : 0.0, broken += bond < 0 ? w : 0.0;
  };
  for (const auto& groups : near.groups) each_particle<Dim>(cloud_, groups, centre, add);
  pair.state.slip = total > 0 ? slip / total : 0.0;
  pair.state.cell = h_;
  pair.state.bond = whole == 0 && broken == 0 ? Bond::none : broken > whole ? Bond::broken : Bond::whole;
  if (system_.step == 0 && pair.state.bond == Bond::none && domains_touch(pair, near)) pair.state.bond = Bond::whole;
}

template <int Dim>
void ContactMemory<Dim>::update() const {
  parallel_for(static_cast<std::ptrdiff_t>(cloud_.size()), [&](std::ptrdiff_t k) {
    const ParticleLabel& label = cloud_.label(static_cast<std::size_t>(k));
    auto& body = *bodies_[label.body];
    if (!body.contact_slip || label.image != 0) return;
    double touching = 0.0, sliding = 0.0, way = 0.0, whole = 0.0, broken = 0.0;
    each_pair_near(search_, system_.lattice, cloud_.planes(), cloud_.domain(static_cast<std::size_t>(k)), label.field,
                   1.5, [&](const ContactPair& pair, const Vec<Dim>&, double w, double, double) {
                     if (!pair.law->has_memory()) return;
                     // Nodes on the two sides of a face share its pressure, often unevenly; those with little of it
                     // slide in the vibrations of bodies that stick.
                     const double force = w * std::max(0.0, -pair.impulse.dot(pair.state.normal));
                     if (pair.response.status != ContactStatus::open) touching += force;
                     if (pair.response.status == ContactStatus::slip) {
                       const Vec3 v = pair.state.velocity - pair.impulse / pair.state.mass;
                       sliding += force;
                       way += force * pair.state.dt * (v - v.dot(pair.state.normal) * pair.state.normal).norm();
                     }
                     if (pair.response.bond == Bond::whole) whole += w;
                     if (pair.response.bond == Bond::broken) broken += w;
                   });
    // Slip is the distance of sliding since the faces last stuck. While they do not touch it stays, so that chatter
    // does not give back the static friction.
    double& slip = body.particles[body.contact_slip][label.particle];
    if (touching > 0) slip = sliding > 0.5 * touching ? slip + way / sliding : 0.0;
    if (whole + broken > 0) body.particles[body.contact_bond][label.particle] = broken > whole ? -1.0 : 1.0;
  });
}

template class ContactMemory<2>;
template class ContactMemory<3>;

}  // namespace tribo
