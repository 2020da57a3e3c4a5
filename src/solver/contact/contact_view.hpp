// SPDX-License-Identifier: MIT
/// What files show of contact at particles.
#pragma once

#include "solver/contact/contact_particles.hpp"

namespace tribo {

/// Fills Body::contacts of all bodies from the last momentum update. Only the particles at the face are there: those
/// whose domains reach it within half a particle, and with no other particle of the body in front. The sum of their
/// tractions times the areas of their free sides, projected along the normal, is the contact force.
///
/// `cloud`: the particles around all contact nodes, of `bodies`, now.
template <int Dim>
void fill_contact_view(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                       const std::vector<Body<Dim>*>& bodies);

}  // namespace tribo
