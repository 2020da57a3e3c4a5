// SPDX-License-Identifier: MIT
#include "run/body_report.hpp"

#include "base/text.hpp"
#include "particles/fill.hpp"
#include "run/body_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace tribo {
namespace {

/// Collects the lines and the advice.
class BodyReport {
 public:
  /// `thin`: bodies that are thin. `given`: per material that particles have, the one that the file gives to them:
  /// bodies of a material that touch each other have materials of their own.
  BodyReport(const Model& model, std::vector<ThinBody> thin, std::vector<int> given)
      : model_(model), thin_(std::move(thin)), given_(std::move(given)) {}

  Remarks of(const Seeds& seeds) {
    constexpr std::size_t many = 8;                 // of a material; these share a line
    std::vector<std::vector<PlacedVolume>> groups;  // by material, in the order of their first body
    std::map<int, std::size_t> group_of;
    for (const PlacedVolume& placed : volume_error(model_, seeds)) {
      const auto [found, is_new] = group_of.try_emplace(given_material(placed), groups.size());
      if (is_new) groups.emplace_back();
      groups[found->second].push_back(placed);
      remark_volume(placed);
    }
    for (const auto& group : groups) {
      if (group.size() > many)
        add_bodies(group);
      else
        for (const PlacedVolume& placed : group) add_body(placed);
    }
    for (std::size_t t = 0; t < model_.tables.size(); ++t) add_table(t, seeds);
    for (const ThinBody& body : thin_)
      out_.advice.push_back("a body of " + name(material_of(body.pieces.front())) + " is " +
                            counted(body.cells, "cell") +
                            " thick: it neither bends nor carries contact stress well below 3");
    return std::move(out_);
  }

 private:
  std::string name(int material) const { return "'" + model_.materials[static_cast<std::size_t>(material)].name + "'"; }
  int material_of(int piece) const { return model_.pieces[static_cast<std::size_t>(piece)].material; }
  int given_material(const PlacedVolume& placed) const {
    return given_[static_cast<std::size_t>(material_of(placed.piece))];
  }

  void remark_volume(const PlacedVolume& placed) {
    constexpr double much = 0.05;
    if (placed.exact && std::abs(*placed.error()) > much)
      out_.advice.push_back(
          format("the particles of %s hold %+.1f %% of its volume: smaller cells, more particles per "
                 "cell, or edges on grid lines",
                 name(material_of(placed.piece)).c_str(), 100 * *placed.error()));
  }

  void add_body(const PlacedVolume& placed) {
    out_.lines.push_back(format("body of %-20s %9lld %s, volume %.6g", (name(material_of(placed.piece)) + ":").c_str(),
                                static_cast<long long>(placed.points), plural(placed.points == 1, "particle").c_str(),
                                placed.placed) +
                         exact_volume(placed) + thickness(placed.piece));
  }

  void add_bodies(const std::vector<PlacedVolume>& list) {
    PlacedVolume sum = list.front();
    long least = sum.points, most = sum.points;
    for (std::size_t k = 1; k < list.size(); ++k) {
      least = std::min(least, list[k].points), most = std::max(most, list[k].points);
      sum.points += list[k].points, sum.placed += list[k].placed;
      sum.exact = sum.exact && list[k].exact ? std::optional(*sum.exact + *list[k].exact) : std::nullopt;
    }
    out_.lines.push_back(format("%zu bodies of %-18s %7ld particles, %ld to %ld each, volume %.6g", list.size(),
                                (name(given_material(sum)) + ":").c_str(), sum.points, least, most, sum.placed) +
                         exact_volume(sum));
  }

  void add_table(std::size_t number, const Seeds& seeds) {
    const ParticleTable& of = model_.tables[number];
    double volume = 0.0, mass = 0.0;
    for (const Seed& seed : seeds)
      if (seed.table == static_cast<int>(number)) volume += seed.volume, mass += seed.mass;
    out_.lines.push_back(format("table of %-19s %9zu %s, volume %.6g, mass %.6g", (name(of.material) + ":").c_str(),
                                of.position.size(), plural(of.position.size() == 1, "particle").c_str(), volume, mass));
  }

  static std::string exact_volume(const PlacedVolume& placed) {
    if (!placed.exact) return {};
    const double error = placed.error().value_or(0.0);
    // With a sign, but for what rounds to zero.
    const std::string percentage = std::abs(error) < 5e-5 ? std::string("0.00") : format("%+.2f", 100 * error);
    return format(" (exact %.6g, %s %%)", *placed.exact, percentage.c_str());
  }

  // The thickness of the thin body of which a shape is a part.
  std::string thickness(int piece) const {
    for (const ThinBody& body : thin_)
      if (std::find(body.pieces.begin(), body.pieces.end(), piece) != body.pieces.end())
        return ", " + counted(body.cells, "cell") + " thick";
    return {};
  }

  const Model& model_;
  std::vector<ThinBody> thin_;
  std::vector<int> given_;
  Remarks out_;
};

}  // namespace

template <int Dim>
Remarks describe_bodies(const Model& model, const System<Dim>& system, const Seeds& seeds) {
  std::vector<int> given(model.materials.size());
  std::iota(given.begin(), given.end(), 0);
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const auto& body : *list) given[static_cast<std::size_t>(body.own_material)] = body.material;
  return BodyReport(model, thin_bodies(model, seeds, system.lattice), std::move(given)).of(seeds);
}

template Remarks describe_bodies(const Model&, const System<2>&, const Seeds&);
template Remarks describe_bodies(const Model&, const System<3>&, const Seeds&);

}  // namespace tribo
