// SPDX-License-Identifier: MIT
#include "solver/contact/interface_opening.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {

template <int Dim>
Vec3 interface_opening(const ParticleCloud<Dim>& cloud, const std::vector<Body<Dim>*>& bodies,
                       const NearParticles<Dim>& near, const Vec<Dim>& centre, const Vec<Dim>& spacing, double middle,
                       const Vec<Dim>& n) {
  const Vec<Dim> at = centre + middle * n;
  const auto displacement = [&](std::size_t side) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    double total = 0.0;
    each_particle<Dim>(cloud, near.groups[side], centre, [&](const ParticleDomain<Dim>& p, const ParticleLabel& label) {
      const double w = particle_weight<Dim>(p.x - centre, spacing);
      if (!(w > 0)) return;
      auto& body = *bodies[label.body];
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

template Vec3 interface_opening<2>(const ParticleCloud<2>&, const std::vector<Body<2>*>&, const NearParticles<2>&,
                                   const Vec<2>&, const Vec<2>&, double, const Vec<2>&);
template Vec3 interface_opening<3>(const ParticleCloud<3>&, const std::vector<Body<3>*>&, const NearParticles<3>&,
                                   const Vec<3>&, const Vec<3>&, double, const Vec<3>&);

}  // namespace tribo
