// SPDX-License-Identifier: MIT
#include "run/load_report.hpp"

#include "base/text.hpp"
#include "solver/loads/face_points.hpp"
#include "solver/loads/loaded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

// The particles of a body by the cells in which they lie.
template <int Dim>
class ParticlesOfCells {
 public:
  ParticlesOfCells(const Lattice<Dim>& lattice, Body<Dim>& body) : lattice_(lattice), body_(body) {
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      particles_.push_back({cell_of(body.particles.position(i)), i});
    std::sort(particles_.begin(), particles_.end());
  }

  // Whether another particle lies in front of a face with this outward normal: along it nearer than one and a half
  // edges, beside it nearer than half an edge.
  bool covers(std::size_t i, const Vec3& normal) const {
    Eigen::Index axis;
    normal.cwiseAbs().maxCoeff(&axis);
    const double sign = normal[axis] < 0 ? -1.0 : 1.0;
    Vec<Dim> edge = 2 * body_.uniform_half_size;
    if (body_.half_size)
      for (int d = 0; d < Dim; ++d) edge[d] = 2 * body_.particles[body_.half_size][static_cast<std::size_t>(d)][i];
    const Vec<Dim> x = body_.particles.position(i);
    for (const double ahead : {0.5, 1.0, 1.5}) {
      Vec<Dim> at = x;
      at[axis] += sign * ahead * edge[axis];
      const std::pair<Cell, std::size_t> from{cell_of(at), 0};
      for (auto p = std::lower_bound(particles_.begin(), particles_.end(), from);
           p != particles_.end() && p->first == from.first; ++p) {
        Vec<Dim> offset = body_.particles.position(p->second) - x;
        const double distance = sign * offset[axis] / edge[axis];
        offset[axis] = 0.0;
        if (distance > 0.25 && distance < 1.5 && (offset.array().abs() < 0.5 * edge.array()).all()) return true;
      }
    }
    return false;
  }

 private:
  using Cell = std::array<int, Dim>;
  Cell cell_of(const Vec<Dim>& x) const {
    Cell cell;
    for (int d = 0; d < Dim; ++d)
      cell[static_cast<std::size_t>(d)] =
          static_cast<int>(std::floor((x[d] - lattice_.origin[d]) / lattice_.spacing[d]));
    return cell;
  }

  const Lattice<Dim>& lattice_;
  Body<Dim>& body_;
  std::vector<std::pair<Cell, std::size_t>> particles_;
};

// For each traction, on how many particles it acts whose face lies inside their body. Bodies that are drawn by a
// deformation do not count: their faces are turned.
template <int Dim>
std::vector<std::size_t> inner_faces(const Model& model, System<Dim>& system) {
  std::vector<std::size_t> count(model.particle_conditions.size(), 0);
  std::unique_ptr<ParticlesOfCells<Dim>> particles;
  const Body<Dim>* of = nullptr;
  const auto is_deformed = [&](const Body<Dim>& body) {
    return std::any_of(model.pieces.begin(), model.pieces.end(),
                       [&](const Piece& p) { return p.material == body.material && p.deformation; });
  };
  bool deformed = false;
  each_loaded(model, system, ParticleCondition::Kind::traction,
              [&](const ParticleCondition& c, Body<Dim>& body, std::size_t i) {
                if (&body != of) {
                  particles = std::make_unique<ParticlesOfCells<Dim>>(system.lattice, body);
                  of = &body, deformed = is_deformed(body);
                }
                if (!deformed && particles->covers(i, ParticleFace<Dim>::of(system, body, i, c.face).normal))
                  ++count[static_cast<std::size_t>(&c - model.particle_conditions.data())];
              });
  return count;
}

// Thermal properties without effect.
std::vector<std::string> remarks_on_heat(const Model& model) {
  std::vector<std::string> out;
  const HeatSpec& heat = model.heat;
  if (!heat.ramps.empty() && !heat.expansion)
    out.emplace_back("the temperature changes, but no material has <alpha>: no body expands");
  for (const Piece& piece : model.pieces) {
    if (piece.material < 0) continue;  // a hole
    const MaterialSpec& material = model.materials[static_cast<std::size_t>(piece.material)];
    const double excess = piece.temperature.value_or(heat.reference) - heat.reference;
    if (excess == 0.0 || material.expansion == 0.0) continue;
    out.push_back(
        format("a body of '%s' starts %.5g %s <StressFreeTemp>: it expands in the first step, which acts like "
               "an impact; a ThermalRamp changes the temperature gradually",
               material.name.c_str(), std::abs(excess), excess > 0 ? "above" : "below"));
    break;
  }
  const auto conducts = [](const MaterialSpec& material) { return material.conductivity > 0; };
  if (!heat.conduction && std::any_of(model.materials.begin(), model.materials.end(), conducts))
    out.emplace_back("<kCond> has no effect: heat is conducted only with <Conduction/> in <Thermal>");
  return out;
}

}  // namespace

template <int Dim>
Remarks describe_loads(const Model& model, System<Dim>& system) {
  Remarks out;
  out.advice = remarks_on_heat(model);
  const std::vector<std::size_t> inner = inner_faces(model, system);
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
      out.lines.push_back(text);
      if (!traction || inner[k] == 0) continue;
      const std::string where = conditions[k].origin.file ? " of " + conditions[k].origin.text() : "";
      out.advice.push_back(
          format("the traction%s acts inside its body: %zu of its %zu particles have another one in front of the "
                 "loaded face; select only the outermost layer, with two particles per cell and axis a strip of "
                 "half a cell",
                 where.c_str(), inner[k], count));
    }
  }
  return out;
}

template Remarks describe_loads(const Model&, System<2>&);
template Remarks describe_loads(const Model&, System<3>&);

}  // namespace tribo
