// SPDX-License-Identifier: MIT
#include "run/expanded_matter.hpp"

#include "base/text.hpp"
#include "materials/material.hpp"
#include "run/ordinary_volume.hpp"

#include <cmath>

namespace tribo {
namespace {

constexpr double noticed = 1.02;     // mean volume ratio of a body
constexpr double large_ratio = 1.3;  // volume ratio of a single particle

// Volumes of the particles of a body, now and at the start [volume], and the number of large particles.
struct Expansion {
  double volume = 0.0, initial = 0.0;
  long long large = 0;
};

template <int Dim>
Expansion expansion(Body<Dim>& body) {
  Expansion sum;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const double volume = body.particles.volume()[i], initial = body.particles.mass()[i] / body.law->density();
    sum.volume += volume, sum.initial += initial;
    if (volume > large_ratio * initial) ++sum.large;
  }
  return sum;
}

std::string remedy(const Scheme& scheme) {
  if (scheme.transfer == Transfer::apic) return "more particles per cell, or a smaller <TimeFactor>";
  const std::string best = "<Transfer type='APIC'/> preserves volumes best";
  if (scheme.transfer != Transfer::fmpm && scheme.transfer != Transfer::xpic) return best;
  return best + ", because FMPM and XPIC smooth the velocity within a cell of a free surface";
}

}  // namespace

template <int Dim>
std::vector<std::string> expanded_matter(const Model& model, System<Dim>& system) {
  std::vector<std::string> lines;
  for (auto& body : system.bodies) {
    const MaterialSpec& material = model.materials[static_cast<std::size_t>(body.material)];
    if (material.type == "IdealGas" || std::isfinite(ordinary_volume(material).high)) continue;
    const Expansion sum = expansion(body);
    if (!(sum.volume > noticed * sum.initial)) continue;
    lines.push_back(format("volume: '%s' has %.3g times its initial volume at the end, and %lld of its particles more "
                           "than %.2g times; this is right where it dilates or flies apart, but where it lies at rest "
                           "it is an error: ",
                           body.name.c_str(), sum.volume / sum.initial, sum.large, large_ratio) +
                    remedy(model.scheme));
  }
  return lines;
}

template std::vector<std::string> expanded_matter<2>(const Model&, System<2>&);
template std::vector<std::string> expanded_matter<3>(const Model&, System<3>&);

}  // namespace tribo
