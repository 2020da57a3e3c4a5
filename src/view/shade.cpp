// SPDX-License-Identifier: MIT
#include "view/shade.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

template <class Frame>
Shade shade_in(const Frame& frame, const std::string& wanted) {
  const auto dot = wanted.find('.');
  const std::string name = wanted.substr(0, dot);
  const auto* field = frame.field(name);
  if (!field) {
    std::vector<std::string> names;
    for (const auto& f : frame.fields) names.push_back(f.name);
    throw UsageError("the run has no field '" + name + "'" + did_you_mean(name, names) +
                     (name == "history" ? "; the variables of the history are fields with their own names" : "") +
                     "; it has: " + join(names));
  }
  const auto count = static_cast<std::size_t>(field->components);
  int component = -1;
  if (dot != std::string::npos) {
    const std::vector<std::string> names =
        count == 3   ? std::vector<std::string>{"x", "y", "z"}
        : count == 6 ? std::vector<std::string>{"xx", "yy", "zz", "xy", "yz", "xz"}
        : count == 9 ? std::vector<std::string>{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}
                     : std::vector<std::string>{};
    const auto found = std::find(names.begin(), names.end(), wanted.substr(dot + 1));
    if (found == names.end())
      throw UsageError("'" + name + "' has no component '" + wanted.substr(dot + 1) + "'" +
                       (names.empty() ? "" : "; it has: " + join(names)));
    component = static_cast<int>(found - names.begin());
  } else if (count > 3) {
    throw UsageError("'" + name + "' is a tensor; add the component, for example '" + name + ".xx'");
  }
  Shade shade{wanted, {}, field->integers && count == 1};
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const double* v = field->values.data() + i * count;
    if (component >= 0)
      shade.values.push_back(v[component]);
    else if (count == 1)
      shade.values.push_back(v[0]);
    else
      shade.values.push_back(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  }
  return shade;
}

}  // namespace

Shade shade_of(const ParticleFrame& frame, const std::string& wanted) { return shade_in(frame, wanted); }

Shade shade_of(const Scene& scene, const std::string& wanted) {
  const std::string name = wanted.substr(0, wanted.find('.'));
  const bool of_particles = scene.particles.field(name) != nullptr, of_blocks = scene.blocks.field(name) != nullptr;
  const std::vector<double> no_particles(scene.particles.count(), std::nan("")),
      no_blocks(scene.blocks.count(), std::nan(""));
  const bool ask_particles = of_particles || (!of_blocks && scene.particles.count() > 0);
  Shade shade = ask_particles ? shade_in(scene.particles, wanted) : shade_in(scene.blocks, wanted);
  if (of_particles) {
    const auto more = of_blocks ? shade_in(scene.blocks, wanted).values : no_blocks;
    shade.values.insert(shade.values.end(), more.begin(), more.end());
  } else {
    shade.values.insert(shade.values.begin(), no_particles.begin(), no_particles.end());
  }
  return shade;
}

std::string default_field(const Scene& scene) {
  for (const char* name : {"von_mises", "velocity", "displacement", "pressure"})
    if (scene.particles.field(name) || scene.blocks.field(name)) return name;
  const std::vector<ParticleFrame::Field>* both[] = {&scene.particles.fields, &scene.blocks.fields};
  // A scale before categories, and the first component of a tensor at the worst.
  for (const bool integers : {false, true})
    for (const auto* fields : both)
      for (const auto& f : *fields)
        if (f.integers == integers && f.components <= 3) return f.name;
  for (const auto* fields : both)
    for (const auto& f : *fields)
      if (f.components == 6 || f.components == 9) return f.name + ".xx";
  throw UsageError("the run has no field that could be drawn");
}

void extend(std::optional<Range>& range, const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values)
    if (std::isfinite(v)) finite.push_back(v);
  if (finite.empty()) return;
  // Outermost values that are left out at each end: none of fewer than 200.
  const auto left_out = static_cast<std::ptrdiff_t>(0.005 * static_cast<double>(finite.size()));
  const auto lower = finite.begin() + left_out, upper = finite.end() - 1 - left_out;
  std::nth_element(finite.begin(), lower, finite.end());
  const double low = *lower;
  std::nth_element(lower, upper, finite.end());
  const double high = *upper;
  range = range ? Range{std::min((*range)[0], low), std::max((*range)[1], high)} : Range{low, high};
}

Range widened(const std::optional<Range>& spread) {
  Range range = spread.value_or(Range{0, 1});
  // Differences below the digits of the ticks are noise.
  if (!(range[1] - range[0] > 1e-6 * std::max(std::abs(range[0]), std::abs(range[1])))) {
    const double middle = 0.5 * (range[0] + range[1]), half = middle == 0 ? 1.0 : 0.5 * std::abs(middle);
    range = {middle - half, middle + half};
  }
  return range;
}

Range range_of(const std::vector<double>& values) {
  std::optional<Range> range;
  extend(range, values);
  return widened(range);
}

}  // namespace tribo
