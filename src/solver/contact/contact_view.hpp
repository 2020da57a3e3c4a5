// SPDX-License-Identifier: MIT
/// Particle columns that show contact in the output.
#pragma once

#include "solver/contact/contact_particles.hpp"

namespace tribo {

/// Fills the columns Body::contact_view of all bodies that have them from the last momentum update: contact state (0
/// open, 1 stick, 2 slip), traction on the particle's body [stress], and outward normal. Only the particles at the face
/// have them: those whose domains reach it within half a particle, and with no other particle of the body in front. So
/// the sum of their tractions times the areas of their sides is the contact force.
///
/// `cloud`: the particles around all contact nodes, of `bodies`, now.
template <int Dim>
void fill_contact_view(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                       const std::vector<Body<Dim>*>& bodies);

}  // namespace tribo
