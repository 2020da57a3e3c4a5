// SPDX-License-Identifier: MIT
/// A bulk law along a path.

#include "base/error.hpp"
#include "drive/drive.hpp"
#include "drive/solve.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

constexpr std::array<std::string_view, 9> rate_names{"Lxx", "Lxy", "Lxz", "Lyx", "Lyy", "Lyz", "Lzx", "Lzy", "Lzz"};
constexpr std::array<std::string_view, 6> stress_names{"sxx", "syy", "szz", "sxy", "syz", "sxz"};
using At = Layout<3>;

std::size_t rate_at(int row, int column) { return static_cast<std::size_t>(3 * row + column); }

/// The material point.
struct Point {
  Mat3 F = Mat3::Identity(), stress = Mat3::Zero();
  Mat3 strain = Mat3::Zero();  // of D dt, summed
  std::vector<double> history;
  double temperature = 0.0;
  std::string failure;  // of the law, which gave no finite stress
};

/// One step of the law as the solver would call it.
Point advanced(const MaterialDrive& what, const Point& from, const Mat3& L, double dt) {
  const Material& law = *what.law;
  Point to = from;
  const Mat3 step = dt * L;
  to.F = Mat3(step.exp()) * from.F;
  to.strain += 0.5 * (step + step.transpose());
  Mat3 rate = L;
  const double mass = law.density();
  double volume = to.F.determinant();
  std::array<double, 6> stress;
  std::vector<double*> history;
  for (double& h : to.history) history.push_back(&h);
  MaterialPoints<3> points;
  points.count = 1, points.dt = dt, points.mass = &mass, points.volume = &volume, points.history = history;
  for (std::size_t k = 0; k < 9; ++k) {
    points.L[k] = &rate(At::full_at[k][0], At::full_at[k][1]);
    points.F[k] = &to.F(At::full_at[k][0], At::full_at[k][1]);
  }
  for (std::size_t k = 0; k < 6; ++k) points.stress[k] = &stress[k];
  points.temperature = &from.temperature, points.reference_temperature = what.reference_temperature;
  points.cell = Vec3::Constant(what.cell);
  store_symmetric<3>(from.stress, points.stress, 0);
  try {
    law.update(points);
  } catch (const StressError& error) {  // a trial, after which smaller ones may follow
    to.failure = error.what();
    to.stress.setConstant(std::numeric_limits<double>::quiet_NaN());
    return to;
  }
  if (what.warmed_by_work > 0) {
    const auto work = static_cast<std::size_t>(law.dissipation_index());
    to.temperature += what.warmed_by_work * (to.history[work] - from.history[work]);
  }
  to.stress = load_symmetric<3>(points.stress, 0);
  return to;
}

/// The prescribed rates of a row, and the components whose stress is prescribed.
struct Control {
  struct Unknown {
    std::size_t component;             // of the stress
    std::vector<std::size_t> entries;  // of L that are unknown with it
    double target;                     // at the end of the row [stress]
  };
  Mat3 L = Mat3::Zero();
  std::vector<Unknown> unknowns;

  Control(const PathRow& row, Problems& problems) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (!std::isnan(row.value[rate_at(r, c)])) L(r, c) = row.value[rate_at(r, c)];
    for (std::size_t k = 0; k < 6; ++k) {
      const double target = row.value[9 + k];
      if (std::isnan(target)) continue;
      const auto [r, c] = At::symmetric_at[k];
      Unknown unknown{k, {}, target};
      for (const std::size_t entry : {rate_at(r, c), rate_at(c, r)})
        if (std::isnan(row.value[entry]) && (unknown.entries.empty() || unknown.entries[0] != entry))
          unknown.entries.push_back(entry);
      if (unknown.entries.empty()) {
        const std::string given =
            r == c ? std::string(rate_names[rate_at(r, c)])
                   : std::string(rate_names[rate_at(r, c)]) + " and " + std::string(rate_names[rate_at(c, r)]);
        problems.add(row.origin, "this row prescribes " + std::string(stress_names[k]) + " and " + given +
                                     "; leave one of them empty");
      }
      unknowns.push_back(unknown);
    }
  }

  Mat3 rates(const Eigen::VectorXd& x) const {
    Mat3 out = L;
    for (std::size_t u = 0; u < unknowns.size(); ++u)
      for (const std::size_t e : unknowns[u].entries)
        out(static_cast<int>(e) / 3, static_cast<int>(e) % 3) = x[static_cast<Eigen::Index>(u)];
    return out;
  }
};

double component(const Mat3& m, std::size_t k) { return m(At::symmetric_at[k][0], At::symmetric_at[k][1]); }

/// Steps through one row from `point` on; `record` is called after each step.
template <class F>
void follow(const MaterialDrive& what, const PathRow& row, const Control& control, Point& point, F&& record) {
  const auto unknowns = static_cast<Eigen::Index>(control.unknowns.size());
  const Mat3 start = point.stress;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
  for (int step = 1; step <= row.steps; ++step) {
    const double share = static_cast<double>(step) / row.steps;
    Eigen::VectorXd target(unknowns);
    for (Eigen::Index u = 0; u < unknowns; ++u) {
      const auto& unknown = control.unknowns[static_cast<std::size_t>(u)];
      const double from = component(start, unknown.component);
      target[u] = from + share * (unknown.target - from);
    }
    Point next;
    const auto miss = [&](const Eigen::VectorXd& at) {
      next = advanced(what, point, control.rates(at), row.dt);
      Eigen::VectorXd out(unknowns);
      for (Eigen::Index u = 0; u < unknowns; ++u)
        out[u] = component(next.stress, control.unknowns[static_cast<std::size_t>(u)].component) - target[u];
      return out;
    };
    const auto tolerance = [&] {
      const double stress =
          std::max(next.stress.cwiseAbs().maxCoeff(), unknowns > 0 ? target.cwiseAbs().maxCoeff() : 0.0);
      return std::max(1e-10 * stress, 1e-15 * what.law->wave_modulus());  // round-off in the law
    };
    const double fine = 1e-4 * std::max(control.L.cwiseAbs().maxCoeff(), 1e-3 / row.dt);
    const bool solved = solve(miss, tolerance, x, fine);
    if (!next.failure.empty())
      throw SimulationError(place(row) + next.failure + ", in step " + std::to_string(step) + " of this row");
    if (!solved)
      throw SimulationError(place(row) + "no rate leads to the prescribed stress in step " + std::to_string(step) +
                            " of this row: the material may not be able to carry it; prescribe "
                            "a rate instead, or a smaller stress, or take smaller steps");
    if (!next.stress.allFinite())
      throw SimulationError(place(row) + "the stress is no number any more in step " + std::to_string(step) +
                            " of this row; is a step too large, or a parameter out of its range?");
    point = next;
    record();
  }
}

}  // namespace

std::vector<PathColumn> material_columns(double rate_factor, double stress_factor) {
  std::vector<PathColumn> out;
  for (const auto name : rate_names) out.push_back({name, rate_factor});
  for (const auto name : stress_names) out.push_back({name, stress_factor});
  return out;
}

Table drive(const MaterialDrive& what) {
  Problems problems;
  std::vector<Control> controls;
  for (const auto& row : what.path) controls.emplace_back(row, problems);
  Point point;
  point.stress = what.initial_stress, point.temperature = what.temperature;
  for (const auto& h : what.law->history()) point.history.push_back(h.name == material_angle ? what.angle : h.initial);
  if (what.initial_stress.norm() > 0) {
    // Laws that store the stress return it after a step without motion.
    const Point still = advanced(what, point, Mat3::Zero(), what.path.empty() ? 1.0 : 1e-12 * what.path[0].dt);
    const double change = (still.stress - point.stress).cwiseAbs().maxCoeff();
    if (change > 1e-6 * point.stress.cwiseAbs().maxCoeff())
      problems.add(what.initial_stress_origin,
                   "this law does not keep an initial stress: it follows from the deformation, or lies beyond yield");
  }
  problems.raise();

  Table out;
  out.names.emplace_back("time");
  for (const auto name : stress_names) out.names.emplace_back(name);
  for (const auto& h : what.law->history()) out.names.push_back(h.name);
  const bool warm = what.warmed_by_work > 0 || what.law->feels_temperature();
  if (warm) out.names.emplace_back("temperature");
  for (const auto name : {"exx", "eyy", "ezz", "exy", "eyz", "exz", "J"}) out.names.emplace_back(name);
  double time = 0.0;
  const auto record = [&] {
    std::vector<double> row{time};
    for (std::size_t k = 0; k < 6; ++k) row.push_back(component(point.stress, k));
    row.insert(row.end(), point.history.begin(), point.history.end());
    if (warm) row.push_back(point.temperature);
    for (std::size_t k = 0; k < 6; ++k) row.push_back(component(point.strain, k));
    row.push_back(point.F.determinant());
    out.rows.push_back(std::move(row));
  };
  record();
  for (std::size_t k = 0; k < what.path.size(); ++k)
    follow(what, what.path[k], controls[k], point, [&] { time += what.path[k].dt, record(); });
  return out;
}

}  // namespace tribo
