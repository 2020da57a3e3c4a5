// SPDX-License-Identifier: MIT
#include "solver/contact/contact_view.hpp"

#include <algorithm>

namespace tribo {

template <int Dim>
void fill_contact_view(const System<Dim>& system, const ContactSearch<Dim>& search, const ParticleCloud<Dim>& cloud,
                       const std::vector<Body<Dim>*>& bodies) {
  constexpr double closed = 0.1;  // a larger gap counts as open [cells]
  const double h = system.lattice.spacing.maxCoeff();
  for (auto* body : bodies)
    if (body->contact_state) {
      const std::size_t count = body->particles.size();
      std::fill_n(body->particles[body->contact_state], count, 0.0);
      for (const auto& vector : {body->contact_traction, body->contact_normal})
        for (double* component : body->particles[vector]) std::fill_n(component, count, 0.0);
    }
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const ParticleLabel& label = cloud.label(k);
    auto& body = *bodies[label.body];
    if (!body.contact_state) continue;
    double slip = 0.0, stick = 0.0, total = 0.0;
    Vec<Dim> traction = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero();
    each_pair_near(search, system.lattice, cloud.domain(k), label.field,
                   [&](const ContactPair& pair, double w, double side) {
                     if (pair.state.gap > closed * h) return;
                     // The nodes on one side of a face may carry the pressure of those on the other side, too. So the
                     // area of nodes without an impulse counts in the mean traction.
                     total += w * pair.state.area;
                     if (pair.update_status == ContactStatus::open) return;
                     (pair.update_status == ContactStatus::slip ? slip : stick) += w;
                     normal += side * w * pair.state.normal.template head<Dim>();
                     traction += side * w / pair.state.dt * pair.update_impulse.template head<Dim>();
                   });
    if (slip + stick == 0.0) continue;
    body.particles[body.contact_state][label.particle] = slip > stick ? 2.0 : 1.0;
    if (total > 0) traction /= total;
    if (normal.norm() > 0) normal.normalize();
    for (std::size_t d = 0; d < Dim; ++d) {
      body.particles[body.contact_traction][d][label.particle] = traction[static_cast<Eigen::Index>(d)];
      body.particles[body.contact_normal][d][label.particle] = normal[static_cast<Eigen::Index>(d)];
    }
  }
}

template void fill_contact_view<2>(const System<2>&, const ContactSearch<2>&, const ParticleCloud<2>&,
                                   const std::vector<Body<2>*>&);
template void fill_contact_view<3>(const System<3>&, const ContactSearch<3>&, const ParticleCloud<3>&,
                                   const std::vector<Body<3>*>&);

}  // namespace tribo
