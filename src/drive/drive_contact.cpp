// SPDX-License-Identifier: MIT
/// A contact law along a path.
///
/// The faces have the reduced mass m per area. In every step they have the trial relative velocity v without the law.
/// The law responds with the impulse J, and they end with v - J/m. The path prescribes either the final velocity or the
/// traction of the law, component by component; v is the unknown.

#include "base/error.hpp"
#include "contact/interface.hpp"
#include "drive/drive.hpp"
#include "drive/solve.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

/// Two faces: axis 0 is the normal.
struct Pair {
  ContactState state;            // its velocity is that at the end of the step
  Vec3 opening = Vec3::Zero();   // displacement jump [length]
  Vec3 traction = Vec3::Zero();  // N, St1, St2 [stress]
  ContactStatus status = ContactStatus::open;
  double stored = 0.0, dissipated = 0.0;  // [energy/area]
};

Pair advanced(const ContactLaw& law, const Pair& from, const Vec3& without, double dt) {
  Pair to = from;
  ContactState& m = to.state;
  m.dt = dt, m.start = from.state.velocity, m.velocity = without;
  const ContactResponse response = law.response(m);
  Vec3 impulse = response.impulse;
  m.velocity = without - impulse / m.mass;
  m.gap += dt * m.velocity[0];
  to.opening += dt * m.velocity;
  if (const InterfaceLaw* interface = law.interface()) {  // the trial velocity is the final one in elastic directions
    const double shear = std::hypot(to.opening[1], to.opening[2]);
    const auto [normal, tangential, energy] = interface->traction(to.opening[0], shear);
    const double along = shear > 0 ? tangential / shear : 0.0;
    impulse += dt * m.area * Vec3(normal, along * to.opening[1], along * to.opening[2]);
    to.stored = m.area * energy;
  }
  m.bond = response.bond;
  // as the particles at a face store it
  m.slip = response.status == ContactStatus::slip ? m.slip + dt * std::hypot(m.velocity[1], m.velocity[2]) : 0.0;
  to.traction = Vec3(0.0 - impulse[0], impulse[1], impulse[2]) / dt;
  to.status = response.status;
  to.dissipated += impulse.dot(m.velocity) - (to.stored - from.stored);
  return to;
}

/// Per component the prescribed velocity or traction of a row.
struct Control {
  Vec3 target = Vec3::Zero();
  std::array<bool, 3> by_traction{};

  Control(const PathRow& row, Problems& problems) {
    const auto columns = contact_columns();
    for (std::size_t k = 0; k < 3; ++k) {
      const double velocity = row.value[k], traction = row.value[3 + k];
      if (!std::isnan(velocity) && !std::isnan(traction))
        problems.add(row.origin, "this row prescribes " + std::string(columns[k].name) + " and " +
                                     std::string(columns[3 + k].name) + "; leave one of them empty");
      by_traction[k] = !std::isnan(traction);
      if (by_traction[k] || !std::isnan(velocity))
        target[static_cast<Eigen::Index>(k)] = by_traction[k] ? traction : velocity;
    }
  }
};

void follow(const ContactDrive& what, const PathRow& row, const Control& control, Pair& pair, Table& out,
            double& time) {
  for (int step = 1; step <= row.steps; ++step) {
    Pair next;
    const auto miss = [&](const Eigen::VectorXd& without) {
      next = advanced(*what.law, pair, without, row.dt);
      Eigen::VectorXd miss_of(3);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const bool traction = control.by_traction[static_cast<std::size_t>(k)];
        // both as velocities
        miss_of[k] = traction ? (next.traction[k] - control.target[k]) * row.dt / what.mass
                              : next.state.velocity[k] - control.target[k];
      }
      return miss_of;
    };
    double scale = std::max(pair.state.velocity.norm(), 1e-300);
    for (Eigen::Index k = 0; k < 3; ++k)
      scale = std::max(scale, std::abs(control.target[k]) *
                                  (control.by_traction[static_cast<std::size_t>(k)] ? row.dt / what.mass : 1.0));
    // Friction holds the faces up to a certain trial velocity: double it until they slide as prescribed.
    bool found = false;
    for (int attempt = 0; attempt < 100 && !found; ++attempt) {
      Eigen::VectorXd without(3);
      for (Eigen::Index k = 0; k < 3; ++k)
        without[k] = control.by_traction[static_cast<std::size_t>(k)]
                         ? (k == 0 ? -1 : 1) * control.target[k] * row.dt / what.mass
                         : control.target[k] * std::pow(2.0, attempt);
      found = solve(
          miss, [&] { return 1e-10 * scale; }, without, 1e-7 * scale);
      if (!(control.target.cwiseAbs().maxCoeff() > 0)) break;
    }
    if (!found)
      throw SimulationError(place(row) + "no motion leads to the prescribed traction or velocity in step " +
                            std::to_string(step) +
                            " of this row: the faces may not be able to carry the traction; "
                            "prescribe a velocity instead, or a larger N");
    pair = next;
    time += row.dt;
    const ContactState& m = pair.state;
    out.rows.push_back({time, pair.traction[0], pair.traction[1], pair.traction[2], m.velocity[0], m.velocity[1],
                        m.velocity[2], m.gap, pair.opening[0], pair.opening[1], pair.opening[2], m.slip,
                        static_cast<double>(pair.status), static_cast<double>(m.bond), pair.stored, pair.dissipated});
  }
}

}  // namespace

std::vector<PathColumn> contact_columns(double velocity_factor, double stress_factor) {
  return {{"vn", velocity_factor}, {"vt1", velocity_factor}, {"vt2", velocity_factor},
          {"N", stress_factor},    {"St1", stress_factor},   {"St2", stress_factor}};
}

Table drive(const ContactDrive& what) {
  Problems problems;
  std::vector<Control> controls;
  for (const auto& row : what.path) controls.emplace_back(row, problems);
  problems.raise();
  Pair pair;
  pair.state.mass = what.mass, pair.state.area = 1.0, pair.state.gap = what.gap, pair.state.cell = what.cell;
  // as in a run: faces in contact at the start are bonded if their law has bonds
  pair.state.bond = what.gap == 0 && what.law->has_memory() ? Bond::whole : Bond::none;
  Table out;
  out.names = {"time", "N",   "St1", "St2",  "vn",    "vt1",  "vt2",    "gap",
               "dn",   "dt1", "dt2", "slip", "touch", "bond", "stored", "dissipated"};
  out.rows.push_back({0, 0, 0, 0, 0, 0, 0, what.gap, 0, 0, 0, 0, 0, static_cast<double>(pair.state.bond), 0, 0});
  double time = 0.0;
  for (std::size_t k = 0; k < what.path.size(); ++k) follow(what, what.path[k], controls[k], pair, out, time);
  return out;
}

}  // namespace tribo
