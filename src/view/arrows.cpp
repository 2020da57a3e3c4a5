// SPDX-License-Identifier: MIT
#include "view/arrows.hpp"

#include "base/text.hpp"
#include "view/frame_answer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace tribo {
namespace {

using Place = std::array<double, 3>;

Place vector_at(const ParticleFrame::Field& field, std::size_t i) {
  return {field.values[3 * i], field.values[3 * i + 1], field.values[3 * i + 2]};
}

double length_of(const Place& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

Place centre_of(const CellFrame& frame, std::size_t c) {
  Place out{};
  for (const auto k : frame.cells[c])
    for (std::size_t d = 0; d < 3; ++d) out[d] += frame.position[k][d] / static_cast<double>(frame.cells[c].size());
  return out;
}

void add(Arrows& arrows, const Place& place, const Place& vector) {
  const double length = length_of(vector);
  if (!(length > 0) || !std::isfinite(length)) return;
  arrows.places.push_back(place), arrows.vectors.push_back(vector);
  arrows.largest = std::max(arrows.largest, length);
}

void add_particles(Arrows& arrows, const ParticleFrame& frame, const std::string& name, const Drawn& shown) {
  const auto* field = frame.field(name);
  if (!field || field->components != 3) return;
  for (const auto i : shown.particles) add(arrows, frame.position[i], vector_at(*field, i));
}

// One arrow for each block at the mean of its faces' centres.
void add_blocks(Arrows& arrows, const CellFrame& blocks, const std::string& name) {
  const auto *field = blocks.field(name), *number = blocks.field("block");
  if (!field || field->components != 3 || !number) return;
  struct Sum {
    Place place{}, vector{};
    double faces = 0.0;
  };
  std::map<double, Sum> sums;
  for (std::size_t c = 0; c < blocks.count(); ++c) {
    Sum& sum = sums[number->values[c]];
    const Place centre = centre_of(blocks, c);
    for (std::size_t d = 0; d < 3; ++d) sum.place[d] += centre[d];
    sum.vector = vector_at(*field, c), sum.faces += 1;
  }
  for (auto& [block, sum] : sums) {
    for (double& x : sum.place) x /= sum.faces;
    add(arrows, sum.place, sum.vector);
  }
}

void add_contacts(Arrows& arrows, const CellFrame& contacts) {
  const auto* force = contacts.field("force");
  for (std::size_t c = 0; force && c < contacts.count(); ++c) add(arrows, centre_of(contacts, c), vector_at(*force, c));
}

// Evenly in space
void thin(Arrows& arrows, std::size_t most) {
  if (arrows.places.size() <= most) return;
  std::vector<std::uint32_t> all(arrows.places.size());
  std::iota(all.begin(), all.end(), 0U);
  Place low = arrows.places.front(), high = low;
  for (const auto& x : arrows.places)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / static_cast<double>(most);
  std::vector<Place> places, vectors;
  for (const auto k : thinned(arrows.places, all, most, size))
    places.push_back(arrows.places[k]), vectors.push_back(arrows.vectors[k]);
  arrows.places = std::move(places), arrows.vectors = std::move(vectors);
}

}  // namespace

std::vector<std::string> arrow_names(const Scene& scene) {
  std::vector<std::string> out;
  for (const auto* fields : {&scene.particles.fields, &scene.blocks.fields})
    for (const auto& f : *fields)
      if (f.components == 3 && f.name != "principal_stress" && f.name != "contact_traction" &&
          std::find(out.begin(), out.end(), f.name) == out.end())
        out.push_back(f.name);
  if (scene.particles.field("contact_traction") || scene.contacts.field("force")) out.push_back(contact_arrows);
  return out;
}

Arrows arrows_of(const Scene& scene, const std::string& name, const Drawn& shown, const Wanted& wanted,
                 std::size_t most) {
  Arrows out;
  if (name.empty()) return out;
  const auto known = arrow_names(scene);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError("there are no arrows of '" + name + "'; there are: " + join(known));
  out.field = name;
  if (name == contact_arrows) {
    // Tractions and forces have different units: one of them is drawn.
    out.field = scene.contacts.field("force") ? "force" : "contact_traction";
    if (scene.contacts.field("force"))
      add_contacts(out, visible_cells(scene.contacts, wanted));
    else
      add_particles(out, scene.particles, out.field, shown);
  } else {
    add_particles(out, scene.particles, name, shown);
    add_blocks(out, visible_cells(scene.blocks, wanted), name);
  }
  out.total = out.places.size();
  thin(out, most);
  return out;
}

}  // namespace tribo
