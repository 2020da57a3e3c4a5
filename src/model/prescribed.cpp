// SPDX-License-Identifier: MIT
#include "model/prescribed.hpp"

#include "base/text.hpp"

#include <cmath>

namespace tribo {
namespace {

using P = Prescribed;
using At = ConditionPoint;

double function_at(const P& p, const At& at) {
  if (at.time < p.time) return 0.0;
  auto variables = Variables::at(at.position, (at.time - p.time) / p.function_time);
  variables.dt = at.dt / p.function_time;
  return p.function_scale * p.function(variables);
}

// The first six are those of NairnMPM, with its numbers.
constexpr Style styles[] = {
    {.words = "constant 1", .at = [](const P& p, const At& at) { return at.time >= p.time ? p.value : 0.0; }},
    {.words = "linear 2",
     .per = Dimension::time,
     .at = [](const P& p, const At& at) { return at.time >= p.time ? p.value * (at.time - p.time) : 0.0; }},
    {.words = "sine 3",
     .time = Style::Time::angular_frequency,
     .at = [](const P& p, const At& at) { return p.value * std::sin(p.time * at.time); }},
    {.words = "cosine 4",
     .time = Style::Time::angular_frequency,
     .at = [](const P& p, const At& at) { return p.value * std::cos(p.time * at.time); }},
    // Absorbing boundary for plane waves, Lysmer & Kuhlemeyer (1969)
    {.words = "silent 5", .motion = true, .at = [](const P&, const At& at) { return -at.impedance * at.velocity; }},
    {.words = "function 6", .function = true, .at = function_at},
    // Elastic support (Winkler foundation): the traction is proportional to the displacement
    {.words = "elastic",
     .per = Dimension::length,
     .motion = true,
     .elastic = true,
     .at = [](const P& p, const At& at) { return at.time >= p.time ? -p.value * at.displacement : 0.0; }},
};

}  // namespace

const Style* style_of(std::string_view word) {
  for (const Style& style : styles)
    for (const auto& known : words_of(style.words))
      if (known == lower(word)) return &style;
  return nullptr;
}

const std::string& all_style_words() {
  static const std::string all = [] {
    std::string out;
    for (const Style& style : styles) out += (out.empty() ? "" : " ") + std::string(style.words);
    return out;
  }();
  return all;
}

}  // namespace tribo
