// SPDX-License-Identifier: MIT
#include "run/rank_plan.hpp"

#include "base/memory.hpp"
#include "base/text.hpp"
#include "particles/fill.hpp"
#include "solver/build.hpp"
#include "solver/step.hpp"
#include "solver/transfer/scattered_columns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace tribo {
namespace {

// A step of this program takes about so long per particle and thread, in the plane and in space [s].
constexpr double seconds_per_particle[] = {30e-9, 70e-9};
// A usual network: bytes per second, and the time of a message or of one stage of a sum over all processes [s].
constexpr double bandwidth = 12.5e9, latency = 2e-6;
constexpr int sums_per_step = 20;
// Of the time of a step, the part of the transfers to nodes, which copies take part in.
constexpr double part_of_scatters = 1.0 / 3;
// Models with more particles are only counted, and what depends on contact is left out.
constexpr std::int64_t most_built = 20'000'000;

// The place of a block on the Morton curve.
template <int Dim>
std::uint64_t morton(const Index<Dim>& block) {
  std::uint64_t key = 0;
  for (int bit = 0; bit < 64 / Dim; ++bit)
    for (std::size_t d = 0; d < Dim; ++d)
      key |= (static_cast<std::uint64_t>(block[d]) >> bit & 1) << (bit * Dim + static_cast<int>(d));
  return key;
}

// Calls f(block) for the blocks of the lattice that are at most so many layers from one.
template <int Dim, class F>
void each_around(const Lattice<Dim>& lattice, std::int64_t block, int layers, F&& f) {
  Index<Dim> low = lattice.block_at(block), high = low;
  for (std::size_t d = 0; d < Dim; ++d)
    low[d] = std::max(low[d] - layers, 0), high[d] = std::min(high[d] + layers, lattice.blocks[d] - 1);
  each_in_box<Dim>(low, high, [&](const Index<Dim>& n) { f(lattice.block_index(n)); });
}

}  // namespace

template <int Dim>
std::vector<RankShare> share_of_ranks(const Lattice<Dim>& lattice, const BlockCounts& blocks, int ranks, int layers,
                                      const std::vector<std::int64_t>& common) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  std::int64_t total = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    order.emplace_back(morton<Dim>(lattice.block_at(blocks[k].first)), k), total += blocks[k].second;
  std::ranges::sort(order);
  std::vector<RankShare> out(static_cast<std::size_t>(ranks));
  std::unordered_map<std::int64_t, std::size_t> owner;
  owner.reserve(blocks.size());
  std::int64_t before = 0;
  for (const auto& [key, k] : order) {
    const auto& [block, count] = blocks[k];
    // the rank whose part of the sum of all weights contains the end of the weight of the block
    const auto rank = static_cast<std::size_t>(std::clamp<double>(
        std::ceil(static_cast<double>(before + count) * ranks / static_cast<double>(total)) - 1, 0, ranks - 1));
    before += count;
    owner[block] = rank;
    out[rank].particles += count, ++out[rank].blocks;
  }
  std::unordered_set<std::int64_t> known_by_all;
  for (const std::int64_t block : common)
    each_around(lattice, block, layers, [&](std::int64_t around) { known_by_all.insert(around); });
  std::vector<std::set<std::size_t>> partners(out.size());
  std::vector<std::size_t> others;
  for (const auto& [block, count] : blocks) {
    const std::size_t own = owner[block];
    others.clear();
    if (known_by_all.contains(block)) {
      for (std::size_t rank = 0; rank < out.size(); ++rank)
        if (rank != own) others.push_back(rank);
    } else {
      each_around(lattice, block, layers, [&](std::int64_t around) {
        const auto at = owner.find(around);
        if (at != owner.end() && at->second != own) others.push_back(at->second);
      });
      std::ranges::sort(others);
      others.erase(std::unique(others.begin(), others.end()), others.end());
    }
    for (const std::size_t other : others) {
      out[own].sent += count, out[other].ghosts += count;
      partners[own].insert(other), partners[other].insert(own);
    }
  }
  for (std::size_t rank = 0; rank < out.size(); ++rank)
    out[rank].partners = static_cast<std::int64_t>(partners[rank].size());
  return out;
}

double imbalance(const std::vector<RankShare>& shares) {
  double all = 0.0, most = 0.0;
  for (const RankShare& share : shares)
    all += static_cast<double>(share.particles), most = std::max(most, static_cast<double>(share.particles));
  return all > 0 ? most * static_cast<double>(shares.size()) / all : 1.0;
}

namespace {

// What the particles of a model need.
struct Needs {
  BlockCounts blocks;
  std::vector<std::int64_t> common;
  int layers = 1;
  double bytes = 0.0;                      // of a particle and what belongs to it
  std::vector<double> bytes_of_transfers;  // per copy, of each transfer of a step
  bool is_built = false;
};

template <int Dim>
class Planner {
 public:
  explicit Planner(const Model& model)
      : model_(model), lattice_(lattice_of(model)), transfers_(make_transfers<Dim>(model.scheme)) {}

  Needs needs() {
    Needs out;
    count(out);
    particles_ <= most_built ? take_from_system(out) : estimate(out);
    return out;
  }
  const Lattice<Dim>& lattice() const { return lattice_; }

 private:
  static Lattice<Dim> lattice_of(const Model& model) {
    Vec<Dim> low, high;
    Index<Dim> cells;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      low[axis] = model.grid.low[d], high[axis] = model.grid.high[d], cells[d] = model.grid.cells[d];
    }
    return {low, high, cells};
  }

  void count(Needs& out) {
    std::unordered_map<std::int64_t, std::int64_t> counts;
    std::int64_t last = -1;
    std::int64_t* here = nullptr;
    place_points(
        model_,
        [&](const Seed& seed) {
          Index<Dim> block;
          for (std::size_t d = 0; d < Dim; ++d) {
            const auto axis = static_cast<Eigen::Index>(d);
            const double cells = (seed.x[axis] - lattice_.origin[axis]) / lattice_.spacing[axis];
            const int lowest = static_cast<int>(std::floor(cells - transfers_->shift()));
            block[d] = std::clamp(lowest / block_edge<Dim>, 0, lattice_.blocks[d] - 1);
          }
          ++particles_;
          if (const std::int64_t number = lattice_.block_index(block); number != last || !here)
            here = &counts[number], last = number;
          ++*here;
        },
        false);
    out.blocks.assign(counts.begin(), counts.end());
    std::ranges::sort(out.blocks);
  }

  void take_from_system(Needs& out) {
    System<Dim> system = build_system<Dim>(model_, place_points(model_));
    Stepper<Dim> stepper(model_, system);
    stepper.sort_if_due();
    out.is_built = true;
    out.layers = stepper.distribution().layers();
    std::vector<KnownBins<Dim>> known;
    double bytes = 0.0;
    for (auto* list : {&system.bodies, &system.rigids})
      for (auto& body : *list) {
        known.push_back({&body, body.bins.contents()});
        bytes += static_cast<double>(body.particles.size() * sizeof(double) * (body.particles.columns().size() + 1));
      }
    out.bytes = bytes / static_cast<double>(std::max<std::int64_t>(particles_, 1));
    if (has_common_blocks(model_, system))
      out.common = find_common_blocks(model_, system, transfers_->stencil_width(), known);
    auto& body = system.bodies.empty() ? system.rigids.front() : system.bodies.front();
    const bool whole = reads_whole_ghosts(model_, system);
    each_transfer([&](Scatter what, bool from_start) {
      const auto columns = whole ? changing_columns(body) : scattered_columns(body, what, from_start);
      out.bytes_of_transfers.push_back(static_cast<double>(columns.size() * sizeof(double)));
    });
  }

  // From the columns that every particle has.
  void estimate(Needs& out) const {
    out.layers = Dim == 2 ? 1 : transfers_->colours_per_axis() > 2 ? 2 : 1;
    constexpr int stress = Dim == 2 ? 4 : 6, deformation = Dim == 2 ? 5 : 9;
    const int affine = model_.scheme.transfer == Transfer::apic ? Dim * Dim : 0;
    const int domain = model_.scheme.kernel == Kernel::cpdi ? Dim * Dim : 0;
    out.bytes = sizeof(double) * (5.0 * Dim + stress + deformation + affine + domain + 5);
    each_transfer([&](Scatter what, bool from_start) {
      int columns = what == Scatter::filtered ? Dim : 0;
      if (what == Scatter::momentum || what == Scatter::momentum_and_force)
        columns += Dim + affine + (from_start ? 0 : Dim + domain);
      if (what == Scatter::force || what == Scatter::momentum_and_force) columns += stress + 1;
      out.bytes_of_transfers.push_back(static_cast<double>(sizeof(double)) * columns);
    });
  }

  // Calls f(sums, from_start) for the transfers to nodes of a step.
  template <class F>
  void each_transfer(F&& f) const {
    const Scheme& scheme = model_.scheme;
    if (scheme.order == UpdateOrder::usl)
      f(Scatter::momentum_and_force, false);
    else
      f(Scatter::momentum, false), f(Scatter::force, false);
    if (scheme.extrapolate_again && scheme.order != UpdateOrder::usf) f(Scatter::momentum, true);
    if (scheme.transfer == Transfer::xpic || scheme.transfer == Transfer::fmpm)
      for (int pass = 1; pass < scheme.filter_order; ++pass) f(Scatter::filtered, false);
  }

  const Model& model_;
  Lattice<Dim> lattice_;
  std::unique_ptr<Transfers<Dim>> transfers_;
  std::int64_t particles_ = 0;
};

// Mean and largest value over the ranks.
struct Spread {
  double mean = 0.0, most = 0.0;
  template <class F>
  Spread(const std::vector<RankShare>& shares, F&& of) {
    for (const RankShare& share : shares) {
      const auto value = static_cast<double>(of(share));
      mean += value / static_cast<double>(shares.size()), most = std::max(most, value);
    }
  }
};

template <int Dim>
std::string plan(const Model& model, int ranks, int threads) {
  Planner<Dim> planner(model);
  const Needs needs = planner.needs();
  const auto shares = share_of_ranks<Dim>(planner.lattice(), needs.blocks, ranks, needs.layers, needs.common);
  const Spread particles(shares, [](const RankShare& s) { return s.particles; });
  const Spread ghosts(shares, [](const RankShare& s) { return s.ghosts; });
  const Spread sent(shares, [](const RankShare& s) { return s.sent; });
  const Spread partners(shares, [](const RankShare& s) { return s.partners; });
  double per_step = 0.0;  // bytes that a copy receives
  for (const double bytes : needs.bytes_of_transfers) per_step += bytes;
  const auto transfers = static_cast<double>(needs.bytes_of_transfers.size());
  const double all = particles.mean * ranks;
  const double per_thread = seconds_per_particle[Dim - 2] / threads;
  const double work = per_thread * (particles.most + part_of_scatters * ghosts.most);
  const double messages = sent.most * per_step / bandwidth + transfers * partners.most * latency +
                          sums_per_step * std::ceil(std::log2(std::max(ranks, 2))) * latency;
  std::string out = format("%d processes share %.4g particles in %zu blocks of the grid, along a Morton curve\n", ranks,
                           all, needs.blocks.size());
  out += format("particles of a process: mean %.4g, most %.4g; imbalance %.4f\n", particles.mean, particles.most,
                imbalance(shares));
  out += format("copies of particles of other processes: mean %.4g, most %.4g\n", ghosts.mean, ghosts.most);
  out += format("processes with which one exchanges values: mean %.3g, most %.0f\n", partners.mean, partners.most);
  out += format(
      "sent in a transfer to the nodes, of which a step has %.0f: mean %.3g MB, most %.3g MB; %.3g bytes per "
      "particle\n",
      transfers, 1e-6 * sent.mean * per_step / transfers, 1e-6 * sent.most * per_step / transfers,
      all > 0 ? sent.mean * ranks * per_step / transfers / all : 0.0);
  out += format("memory of the particles of a process, with copies: most %.3g MB\n",
                1e-6 * needs.bytes * (particles.most + ghosts.most));
  out += format(
      "modelled efficiency: %.2f (%s per process, %.0f ns per particle, step and thread; %.3g GB/s and "
      "%.0f us per message)\n",
      per_thread * particles.mean / (work + messages), counted(threads, "thread").c_str(),
      1e9 * seconds_per_particle[Dim - 2], 1e-9 * bandwidth, 1e6 * latency);
  if (!needs.common.empty())
    out += format(
        "each process has copies of what is near contact on faces, cracks, joints, blocks or periodic edges: "
        "%zu blocks\n",
        needs.common.size());
  if (!needs.is_built) out += "the model is large: what is near contact, cracks and joints is not considered\n";
  if (const auto empty = std::ranges::count(shares, 0, &RankShare::particles); empty > 0)
    out += format("%s without particles: take fewer\n", counted(static_cast<std::size_t>(empty), "process").c_str());
  return out;
}

}  // namespace

std::string plan_for_ranks(const Model& model, int ranks, int threads) {
  if (model.only_blocks())
    throw InputError(model.blocks->origin, "blocks without a grid are computed by a single process");
  return with_memory_for("this model", model.grid.origin, [&] {
    return model.dimension() == 2 ? plan<2>(model, ranks, threads) : plan<3>(model, ranks, threads);
  });
}

template std::vector<RankShare> share_of_ranks<2>(const Lattice<2>&, const BlockCounts&, int, int,
                                                  const std::vector<std::int64_t>&);
template std::vector<RankShare> share_of_ranks<3>(const Lattice<3>&, const BlockCounts&, int, int,
                                                  const std::vector<std::int64_t>&);

}  // namespace tribo
