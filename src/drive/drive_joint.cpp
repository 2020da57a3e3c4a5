// SPDX-License-Identifier: MIT
/// A joint law along a path: one contact between a machine and the ground.
///
/// The increments of the path move body 2, or the far ends of the machine's springs. A spring of stiffness K carries
/// the initial force of the joint plus K (D - u), D the displacement of its far end, u that of body 2. Without mass
/// u is found so that spring and joint are in balance; with mass, by leapfrog.

#include "base/error.hpp"
#include "drive/drive.hpp"
#include "drive/solve.hpp"
#include "output/number.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

enum Column : std::size_t { dn, dss, dst, dtwist, dbs, dbt, Fn, Fss, Fst, Pn, Pss, Pst, Ffn, Ffss, Ffst, pressure };

/// Per axis n, s, t the force of the joint on the machine: positive against the motion.
Vec3 resistance(const Joint& j) { return {j.Fn, -j.Fs.s, -j.Fs.t}; }
Vec3 damped_resistance(const Joint& j) {
  return resistance(j) + Vec3(j.dashpot_normal, -j.dashpot_shear.s, -j.dashpot_shear.t);
}

class Machine {
 public:
  explicit Machine(const JointDrive& what)
      : what_(what),
        joint_(what.law->start(with_pressure(what))),
        at_start_(resistance(joint_)),
        springs_(what.spring_normal, what.spring_shear, what.spring_shear),
        velocity_(what.velocity[0], what.velocity[1], what.velocity[2]) {}

  void follow(const PathRow& row, Table& out) {
    const Vec3 from = resistance(joint_);
    const double pressure_before = pressure_;
    for (int step = 1; step <= row.steps; ++step) {
      events_.clear();
      time_ += row.dt;
      if (!std::isnan(row.value[pressure]))
        pressure_ = pressure_before + (row.value[pressure] - pressure_before) * step / row.steps;
      for (std::size_t k = 0; k < 3; ++k) far_[static_cast<Eigen::Index>(k)] += given(row, dn + k);
      if (what_.mass > 0)
        swing(row);
      else
        balance(row, from, step);
      record(out);
    }
  }

  void record(Table& out) const {
    const Joint& j = joint_;
    std::vector<double> row{time_,
                            j.Fn,
                            j.Fs.s,
                            j.Fs.t,
                            j.Mt,
                            j.Mb.s,
                            j.Mb.t,
                            static_cast<double>(j.state),
                            j.slip,
                            j.strain,
                            j.slid,
                            j.damped,
                            -j.dashpot_normal,
                            j.dashpot_shear.s,
                            j.dashpot_shear.t,
                            j.released(),
                            j.opening,
                            j.shear.s,
                            j.shear.t,
                            j.gap,
                            j.rest_gap,
                            j.away ? 0.0 : 1.0};
    double broke = 0, changed = 0, activated = 0;
    for (const auto& e : events_) {
      if (e.kind == JointEvent::Kind::bond_break) broke = e.mode;
      if (e.kind == JointEvent::Kind::slip_change) changed = e.mode;
      if (e.kind == JointEvent::Kind::activated) activated = 1;
    }
    row.insert(row.end(), {broke, changed, activated});
    for (const double x : what_.law->own_values(j)) row.push_back(x);
    if (what_.mass > 0) row.insert(row.end(), {velocity_[0], velocity_[1], velocity_[2]});
    if (has_springs()) {
      const Vec3 s = spring_forces(motion_);
      row.insert(row.end(), {s[0], s[1], s[2]});
    }
    out.rows.push_back(std::move(row));
  }

  std::vector<std::string> names() const {
    std::vector<std::string> out{"time",       "Fn",        "Fss",        "Fst",         "Mt",
                                 "Mbs",        "Mbt",       "state",      "slip",        "E_strain",
                                 "E_slip",     "E_dashpot", "Fdn",        "Fdss",        "Fdst",
                                 "E_released", "un",        "uss",        "ust",         "gap",
                                 "rest_gap",   "active",    "bond_break", "slip_change", "contact_activated"};
    for (const auto name : what_.law->own_names()) out.emplace_back(name);
    if (what_.mass > 0) out.insert(out.end(), {"vn", "vss", "vst"});
    if (has_springs()) out.insert(out.end(), {"Sn", "Sss", "Sst"});
    return out;
  }

  /// The largest frequency squared, which limits the step of leapfrog.
  double stiffest() const {
    const double n = joint_.kn * joint_.area + what_.spring_normal, s = joint_.ks * joint_.area + what_.spring_shear;
    return std::max(n, s) / what_.mass;
  }

 private:
  static JointSite with_pressure(const JointDrive& what) {
    JointSite site = what.site;
    site.pressure = what.law->pore_pressure(Vec3::Zero(), 0.0);
    return site;
  }
  static double given(const PathRow& row, std::size_t column) {
    return std::isnan(row.value[column]) ? 0.0 : row.value[column];
  }
  bool has_springs() const { return springs_.maxCoeff() > 0; }
  Vec3 spring_forces(const Vec3& u) const { return at_start_ + springs_.cwiseProduct(far_ - u); }

  JointIncrement increment(const PathRow& row, const Vec3& u) const {
    JointIncrement d;
    d.normal = u[0], d.shear = {u[1], u[2]};
    d.twist = given(row, dtwist), d.bend = {given(row, dbs), given(row, dbt)};
    d.gap = joint_.gap + u[0], d.dt = row.dt, d.time = time_, d.mass = what_.dashpot_mass;
    d.pressure = what_.law->pore_pressure(Vec3::Zero(), time_) + pressure_;
    d.poisson_normal = given(row, Ffn), d.poisson_shear = {given(row, Ffss), given(row, Ffst)};
    return d;
  }
  Joint after(const PathRow& row, const Vec3& u, std::vector<JointEvent>& events) const {
    Joint j = joint_;
    const JointIncrement d = increment(row, u);
    what_.law->update({&j, 1}, {&d, 1}, events);
    return j;
  }

  // Leapfrog: velocities at the middle of steps, forces at their ends.
  void swing(const PathRow& row) {
    Vec3 force = Vec3(given(row, Pn), given(row, Pss), given(row, Pst)) - damped_resistance(joint_);
    for (Eigen::Index k = 0; k < 3; ++k)
      if (springs_[k] > 0) force[k] += spring_forces(motion_)[k];
    velocity_ += row.dt / what_.mass * force;
    const Vec3 u = row.dt * velocity_;
    joint_ = after(row, u, events_), motion_ += u;
  }

  void balance(const PathRow& row, const Vec3& from, int step) {
    Vec3 u = Vec3::Zero(), target = Vec3::Zero();
    std::vector<Eigen::Index> sought;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto c = static_cast<std::size_t>(k);
      const double force = row.value[Fn + c];
      if (!std::isnan(force)) {  // shear forces act on body 2
        target[k] = from[k] + ((k == 0 ? force : -force) - from[k]) * step / row.steps;
        sought.push_back(k);
      } else if (springs_[k] > 0) {
        sought.push_back(k);
      } else {
        u[k] = given(row, dn + c);
      }
    }
    const double kA = joint_.kn * joint_.area, sA = joint_.ks * joint_.area;
    Joint next;
    std::vector<JointEvent> events;
    const auto miss = [&](const Eigen::VectorXd& x) {
      for (std::size_t k = 0; k < sought.size(); ++k) u[sought[k]] = x[static_cast<Eigen::Index>(k)];
      events.clear();
      next = after(row, u, events);
      Eigen::VectorXd out(x.size());
      for (std::size_t k = 0; k < sought.size(); ++k) {
        const Eigen::Index i = sought[k];
        const bool by_force = !std::isnan(row.value[Fn + static_cast<std::size_t>(i)]);
        const double pull = by_force ? target[i] + given(row, Pn + static_cast<std::size_t>(i))
                                     : spring_forces(motion_ + u)[i] + given(row, Pn + static_cast<std::size_t>(i));
        // as displacements
        out[static_cast<Eigen::Index>(k)] = (resistance(next)[i] - pull) / ((i == 0 ? kA : sA) + springs_[i]);
      }
      return out;
    };
    const double force = std::max({resistance(joint_).norm(), target.norm(), spring_forces(motion_).norm()});
    const double scale = std::max(force / std::max({kA, sA, 1e-300}), (far_ - motion_).norm() * 1e-3);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sought.size()));
    for (std::size_t k = 0; k < sought.size(); ++k)
      if (springs_[sought[k]] > 0)
        x[static_cast<Eigen::Index>(k)] = 0.5 * given(row, dn + static_cast<std::size_t>(sought[k]));
    if (!solve(
            miss, [&] { return 1e-10 * std::max(scale, 1e-300); }, x, 1e-7 * std::max(scale, 1e-300)))
      throw SimulationError(place(row) + "no motion balances the joint in step " + std::to_string(step) +
                            " of this row: it may not be able to carry the force, or it jumps; prescribe the motion, "
                            "use smaller steps, or give body 2 a 'mass'");
    joint_ = next, events_ = events, motion_ += u;
  }

  const JointDrive& what_;
  Joint joint_;
  Vec3 at_start_, springs_, velocity_, far_ = Vec3::Zero(), motion_ = Vec3::Zero();
  std::vector<JointEvent> events_;
  double time_ = 0.0;
  double pressure_ = 0.0;  // of the path [stress]
};

void check_row(const JointDrive& what, const PathRow& row, Problems& problems) {
  constexpr const char* axes[] = {"n", "ss", "st"};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool moved = !std::isnan(row.value[dn + k]), held = !std::isnan(row.value[Fn + k]);
    const bool spring = (k == 0 ? what.spring_normal : what.spring_shear) > 0;
    const std::string d = std::string("d") + axes[k], F = std::string("F") + axes[k];
    if (moved && held) problems.add(row.origin, "this row prescribes " + d + " and " + F + "; leave one of them empty");
    if (held && (what.mass > 0 || spring))
      problems.add(row.origin, F + " cannot be prescribed where a mass or a spring moves the joint; give the load P" +
                                   axes[k] + " or the motion " + d);
    if (moved && row.value[dn + k] != 0 && what.mass > 0 && !spring)
      problems.add(row.origin, d + " moves the far end of a spring; a body with mass but without " +
                                   (k == 0 ? "'spring-normal'" : "'spring-shear'") + " moves by itself");
    if (!std::isnan(row.value[Pn + k]) && what.mass == 0 && !spring)
      problems.add(row.origin, std::string("P") + axes[k] + " needs a 'block' or a spring");
  }
}

}  // namespace

std::vector<PathColumn> joint_columns(double length_factor, double force_factor, double stress_factor) {
  return {{"dn", length_factor}, {"dss", length_factor}, {"dst", length_factor}, {"dtwist", 1.0},
          {"dbs", 1.0},          {"dbt", 1.0},           {"Fn", force_factor},   {"Fss", force_factor},
          {"Fst", force_factor}, {"Pn", force_factor},   {"Pss", force_factor},  {"Pst", force_factor},
          {"Ffn", force_factor}, {"Ffss", force_factor}, {"Ffst", force_factor}, {"pressure", stress_factor}};
}

Table drive(const JointDrive& what) {
  Problems problems;
  Machine machine(what);
  for (const auto& row : what.path) {
    check_row(what, row, problems);
    if (what.mass > 0 && row.dt * std::sqrt(machine.stiffest()) >= 2)
      problems.add(row.origin, "this time step is too large for the mass and its springs: it must be below " +
                                   number_text(2 / std::sqrt(machine.stiffest())));
  }
  problems.raise();
  Table out;
  out.names = machine.names();
  machine.record(out);
  for (const auto& row : what.path) machine.follow(row, out);
  return out;
}

}  // namespace tribo
