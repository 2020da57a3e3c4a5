// SPDX-License-Identifier: MIT
#include "run/load_report.hpp"

#include "base/text.hpp"
#include "solver/loads/face_points.hpp"
#include "solver/loads/loaded.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo {
namespace {

using LoadedPoint = std::pair<Vec3, double>;  // its position, and the area on which a traction acts, or 1

std::string along(LoadDirection direction) {
  switch (direction) {
    case LoadDirection::x:
      return "along x";
    case LoadDirection::y:
      return "along y";
    case LoadDirection::z:
      return "along z";
    case LoadDirection::normal:
      return "along the outward normal";
    case LoadDirection::tangential:
      return "along the tangent";
  }
  return "";
}

// The sum of the values at all points at the time at which it is largest, and whether it changes. Some of many points
// tell this time.
std::pair<double, bool> largest_sum(const ParticleCondition& condition, const std::vector<LoadedPoint>& points,
                                    double end) {
  static constexpr int times = 100;
  static constexpr std::size_t many = 2000;
  const auto sum_at = [&](double time, std::size_t stride) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); i += stride)
      sum += points[i].second * condition.value.at(time, points[i].first);
    return sum;
  };
  const std::size_t stride = 1 + (points.size() - 1) / many;
  double largest = sum_at(0.0, stride), when = 0.0;
  bool changes = false;
  for (int k = 1; k <= times; ++k) {
    const double time = end * k / times, sum = sum_at(time, stride);
    changes = changes || sum != largest;
    if (std::abs(sum) > std::abs(largest)) largest = sum, when = time;
  }
  if (stride > 1) largest = sum_at(when, 1);
  return {condition.net ? largest / static_cast<double>(points.size()) : largest, changes};
}

}  // namespace

template <int Dim>
std::vector<std::string> describe_loads(const Model& model, System<Dim>& system) {
  std::vector<std::string> lines;
  const auto& conditions = model.particle_conditions;
  for (const auto kind : {ParticleCondition::Kind::force, ParticleCondition::Kind::traction}) {
    const bool traction = kind == ParticleCondition::Kind::traction;
    std::vector<std::vector<LoadedPoint>> points(conditions.size());
    each_loaded(model, system, kind, [&](const ParticleCondition& c, Body<Dim>& body, std::size_t i) {
      LoadedPoint point{Vec3::Zero(), 1.0};
      for (std::size_t d = 0; d < Dim; ++d) point.first[static_cast<Eigen::Index>(d)] = body.particles.x()[d][i];
      if (traction) point.second = ParticleFace<Dim>::of(system, body, i, c.face).area;
      points[static_cast<std::size_t>(&c - conditions.data())].push_back(point);
    });
    for (std::size_t k = 0; k < conditions.size(); ++k) {
      if (points[k].empty()) continue;
      const std::size_t count = points[k].size();
      double area = 0.0;
      for (const LoadedPoint& p : points[k]) area += p.second;
      std::string text = std::string(traction ? "traction " : "force ") + along(conditions[k].direction) + ": on " +
                         std::to_string(count) + " " + plural(count == 1, "particle");
      if (traction) text += format(", area %.5g", area);
      if (!conditions[k].value.style->motion) {
        const auto [sum, changes] = largest_sum(conditions[k], points[k], model.time.end);
        text += format(", %s%.5g in all", changes ? "up to " : "", sum);
        if (!traction && !conditions[k].net && count > 1) text += ", the value given is for each of them";
      }
      lines.push_back(text);
    }
  }
  return lines;
}

template std::vector<std::string> describe_loads(const Model&, System<2>&);
template std::vector<std::string> describe_loads(const Model&, System<3>&);

}  // namespace tribo
