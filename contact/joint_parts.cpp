// SPDX-License-Identifier: MIT
#include "contact/joint_parts.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

// Numbers separated by blanks, commas, semicolons or parentheses; none if the text contains anything else.
std::optional<std::vector<double>> read_numbers(std::string text) {
  for (char& c : text)
    if (std::string_view(",;()\t\r\n").find(c) != std::string_view::npos) c = ' ';
  std::vector<double> out;
  for (std::size_t from = text.find_first_not_of(' '); from != std::string::npos;) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const auto value = to_number(std::string_view(text).substr(from, to - from));
    if (!value) return std::nullopt;
    out.push_back(*value);
    from = text.find_first_not_of(' ', to);
  }
  return out;
}

}  // namespace

std::string_view JointEvent::name() const {
  return kind == Kind::slip_change ? "slip_change" : kind == Kind::bond_break ? "bond_break" : "contact_activated";
}

MultiplierTable::MultiplierTable(const Statement& material, const std::string& name, const Units& units,
                                 Problems& problems) {
  for (const auto& child : material.children) {
    if (child.name != name) continue;
    const auto values = read_numbers(child.text);
    if (!values || values->empty() || values->size() % 2 != 0) {
      problems.add(child.text_origin, "<" + name +
                                          "> needs pairs of numbers, multiplier and displacement, as in '1 0, " +
                                          "0.4 0.001, 0 0.002', not '" + child.text + "'");
      return;
    }
    for (std::size_t k = 0; k < values->size(); k += 2) {
      const double multiplier = (*values)[k], displacement = (*values)[k + 1] * units.factor(Dimension::length);
      if (displacement < 0) problems.add(child.text_origin, "<" + name + ">: a displacement must not be negative");
      if (!points_.empty() && !(displacement > points_.back().displacement))
        problems.add(child.text_origin,
                     "<" + name + "> is not sorted: the displacement of each pair must exceed that of the pair before");
      points_.push_back({multiplier, displacement});
    }
  }
  if (!points_.empty() && points_.front().displacement > 0) points_.insert(points_.begin(), {1.0, 0.0});
}

double MultiplierTable::at(double displacement) const {
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const Point &a = points_[k - 1], &b = points_[k];
    if (displacement < b.displacement)
      return a.multiplier +
             (b.multiplier - a.multiplier) * (displacement - a.displacement) / (b.displacement - a.displacement);
  }
  return 0.0;
}

void Dashpots::act(Joint& j, const JointIncrement& d) const {
  j.dashpot_normal = 0, j.dashpot_shear = {};
  if (normal == 0 && shear == 0) return;
  const int bits = static_cast<int>(mode);
  const double vn = d.normal / d.dt;
  const Tangent vs = (1 / d.dt) * d.shear;
  j.dashpot_normal = 2 * normal * std::sqrt(d.mass * j.kn * j.area) * vn;
  if (bits & 1) j.dashpot_normal = std::min(j.dashpot_normal, std::max(0.0, -j.Fn));
  if (!(j.slips && (bits & 2))) j.dashpot_shear = (-2 * shear * std::sqrt(d.mass * j.ks * j.area)) * vs;
  const double gain = -j.dashpot_normal * d.normal + j.dashpot_shear.dot(d.shear);
  j.damped += gain, j.work -= gain;
}

SurfaceProperties SurfaceProperties::between(const SurfaceProperties& a, const SurfaceProperties& b) {
  const auto in_series = [](const std::optional<double>& x, const std::optional<double>& y) -> std::optional<double> {
    if (!x || !y) return std::nullopt;
    return *x + *y > 0 ? *x * *y / (*x + *y) : 0.0;
  };
  SurfaceProperties out{in_series(a.kn, b.kn), in_series(a.ks, b.ks), std::nullopt};
  if (a.friction && b.friction) out.friction = std::min(*a.friction, *b.friction);
  return out;
}

PressureFunction::PressureFunction(const Statement& material, const char* name, const Units& units,
                                   Problems& problems) {
  const Statement* given = material.child(name);
  if (!given) return;
  try {
    function_ = Expression(given->text, given->text_origin, "<" + given->name + ">");
    unit_ = units.factor(Dimension::stress), time_unit_ = units.alternative_time();
  } catch (const InputError& error) {
    problems.add(error);
  }
}

UserAreas::UserAreas(const Statement& material, std::initializer_list<const char*> names, Problems& problems) {
  const Statement* first = nullptr;
  for (const auto& child : material.children) {
    if (std::find(names.begin(), names.end(), child.name) == names.end()) continue;
    const auto values = read_numbers(child.text);
    if (child.name == "area" && values && values->empty()) continue;
    if (first) {
      problems.add(child.origin, "<" + child.name + "> gives the area again; first at " + first->origin.text());
    } else if (!values || values->empty()) {
      problems.add(child.text_origin,
                   "<" + child.name + "> needs an area, or one for each contact, not '" + child.text + "'");
    } else if (values->size() > 1 && !(*std::min_element(values->begin(), values->end()) > 0)) {
      problems.add(child.text_origin, "<" + child.name + ">: the area of every contact must be positive");
    } else if (values->front() < 0) {
      problems.add(child.text_origin, "<" + child.name + "> is " + child.text + " but must be >= 0");
    } else {
      areas_ = *values;
    }
    first = &child;
  }
  if (areas_.size() == 1 && areas_[0] == 0) areas_.clear();  // the default: the area of the host
}

void set_area(Joint& j, const JointSite& site, double user_area) {
  constexpr double pi = std::numbers::pi;
  const bool ball = site.radius > 0 && !(user_area > 0);
  j.area = user_area > 0 ? user_area
           : !ball       ? site.area
           : site.plane  ? 2 * site.radius * site.thickness
                         : pi * site.radius * site.radius;
  if (site.plane) {
    j.radius = ball ? site.radius : j.area / (2 * site.thickness);
    j.inertia = 2.0 / 3 * std::pow(j.radius, 3) * site.thickness, j.polar = 0;
  } else {
    j.radius = ball ? site.radius : std::sqrt(j.area / pi);
    j.inertia = 0.25 * pi * std::pow(j.radius, 4), j.polar = 2 * j.inertia;
  }
}

std::array<double, 4> stiffness_moments(const Joint& j, const JointSite& site) {
  if (site.has_moments) return {site.moments[0], site.moments[1], site.moments[2], site.moments[0] + site.moments[1]};
  if (site.plane) return {j.inertia, 0, 0, 0};
  return {j.inertia, j.inertia, 0, j.polar};
}

void add_work(Joint& j, const Joint& before, const JointIncrement& d) {
  j.work += 0.5 * ((before.Fn + j.Fn) * d.normal - (before.Fs + j.Fs).dot(d.shear) - (before.Mt + j.Mt) * d.twist -
                   (before.Mb + j.Mb).dot(d.bend));
}

std::vector<double> numbers_of(const Statement& material, const std::string& name, std::size_t least, std::size_t most,
                               Problems& problems) {
  const Statement* child = material.child(name);
  if (!child) return {};
  const auto values = read_numbers(child->text);
  if (values && values->size() >= least && values->size() <= most) return *values;
  problems.add(child->text_origin,
               "<" + name + "> needs " +
                   (least == most ? std::to_string(least) : std::to_string(least) + " or " + std::to_string(most)) +
                   " " + plural(most == 1, "number") + ", not '" + child->text + "'");
  return {};
}

void refuse(const Statement& material, std::span<const RefusedProperty> refused, Problems& problems) {
  for (const auto& child : material.children)
    for (const auto& r : refused)
      if (child.name == r.name) problems.add(child.origin, "<" + child.name + "> " + std::string(r.why));
}

void must_be_whole(const Statement& material, std::initializer_list<const char*> names, Problems& problems) {
  for (const char* name : names)
    if (const Statement* child = material.child(name)) {
      const auto value = to_number(child->text);
      if (value && *value != std::floor(*value))
        problems.add(child->text_origin, "<" + std::string(name) + "> needs a whole number, not '" + child->text + "'");
    }
}

}  // namespace tribo
