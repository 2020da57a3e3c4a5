// SPDX-License-Identifier: MIT
/// Signs in the particles that the results of a run lose their meaning.
#pragma once

#include "solver/state/system.hpp"

namespace tribo {

/// Range of the volume ratio V/V0.
struct VolumeRange {
  double low = 0.5, high = 2.0;
};

/// Particles with a property out of bounds, and the worst of them.
struct BadParticles {
  std::int64_t count = 0;
  double worst = 0.0;         ///< the property of the worst one
  Vec3 place = Vec3::Zero();  ///< of the worst one [length]
};

struct ParticleQuality {
  BadParticles compressed;  ///< volume ratio below the ordinary range
  BadParticles expanded;    ///< volume ratio above it
  /// Domains that were stretched beyond a cell; `worst` is their length in cells. Beside such a particle there are
  /// cells without any, so that the body can come apart numerically.
  BadParticles stretched;
};

/// Quality of the particles of a body, whose law is ordinarily in a range of volumes; the result does not depend on the
/// number of threads. A domain counts as stretched if the shortest vectors that span it include one longer than 1.25
/// cells and longer than one and a half of its initial size, so that simple shear does not count. Without a deformation
/// gradient the edge of the cube with its volume is taken instead. Matter that may expand without a limit, such as
/// sand, liquids and gas, has no stretched domains: its neighbours change in a flow.
template <int Dim>
ParticleQuality particle_quality(Body<Dim>& body, const Lattice<Dim>& lattice, const VolumeRange& ordinary);

/// Least and largest volume ratio of the particles of a body; 1 without particles.
template <int Dim>
VolumeRange volume_range(Body<Dim>& body);

}  // namespace tribo
