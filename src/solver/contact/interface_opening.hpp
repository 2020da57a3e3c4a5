// SPDX-License-Identifier: MIT
/// Opening displacements of imperfect interfaces at contact nodes.
#pragma once

#include "solver/contact/near_particles.hpp"

namespace tribo {

/// The jump of the displacement across the interface at a node, second side minus first [length].
///
/// The displacement of a side is the weighted mean of its particles near the node. Each particle's displacement is
/// first extrapolated along the normal to the interface with the deformation gradient of the particle; without that,
/// the strain between the particles and the interface would count as opening. It is not extrapolated along the
/// interface: under stiff springs round-off that alternates from node to node would grow.
///
/// `centre`: position of the node; `near`: the particles around it, of `cloud`; `bodies`: those of the cloud;
/// `spacing`: edges of a cell; `middle`: position of the interface along the unit normal n, from the node [length].
template <int Dim>
Vec3 interface_opening(const ParticleCloud<Dim>& cloud, const std::vector<Body<Dim>*>& bodies,
                       const NearParticles<Dim>& near, const Vec<Dim>& centre, const Vec<Dim>& spacing, double middle,
                       const Vec<Dim>& n);

}  // namespace tribo
