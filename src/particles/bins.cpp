// SPDX-License-Identifier: MIT
#include "particles/bins.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribo {

template <int Dim>
std::int64_t Bins<Dim>::sort(const Lattice<Dim>& lattice, Particles<Dim>& particles) {
  const std::size_t n = particles.size();
  const auto x = particles.x();

  // Sort key: block (lexicographic), then cell in the block.
  static constexpr std::ptrdiff_t piece = 1 << 14;
  std::vector<std::int64_t> key(n);
  const auto pieces = (static_cast<std::ptrdiff_t>(n) + piece - 1) / piece;
  std::vector<std::int64_t> lost(static_cast<std::size_t>(pieces), -1);
  parallel_for(pieces, [&](std::ptrdiff_t p) {
    const auto end = std::min(n, static_cast<std::size_t>((p + 1) * piece));
    for (auto i = static_cast<std::size_t>(p * piece); i < end; ++i) {
      Index<Dim> block;
      std::int64_t cell = 0;
      for (std::size_t d = Dim; d-- > 0;) {
        const auto axis = static_cast<Eigen::Index>(d);
        if (!(x[d][i] >= lattice.low[axis] && x[d][i] <= lattice.high[axis])) {
          if (lost[static_cast<std::size_t>(p)] < 0) lost[static_cast<std::size_t>(p)] = static_cast<std::int64_t>(i);
          block = {};
          break;
        }
        const auto base =
            static_cast<int>(std::floor((x[d][i] - lattice.origin[axis]) / lattice.spacing[axis] - shift_));
        block[d] = base / block_edge<Dim>;
        cell = cell * block_edge<Dim> + base % block_edge<Dim>;
      }
      key[i] = lattice.block_index(block) * block_nodes<Dim> + cell;
    }
  });
  for (const auto i : lost)
    if (i >= 0) return i;

  // Occupied blocks, numbered consecutively in lexicographic order.
  const auto [least, most] = std::minmax_element(key.begin(), key.end());
  const std::int64_t first = n > 0 ? *least / block_nodes<Dim> : 0, last = n > 0 ? *most / block_nodes<Dim> : -1;
  std::vector<int> rank(static_cast<std::size_t>(last - first + 1), 0);
  const auto rank_of = [&](std::int64_t k) -> int& {
    return rank[static_cast<std::size_t>(k / block_nodes<Dim> - first)];
  };
  for (const auto k : key) rank_of(k) = 1;
  std::vector<std::int64_t> occupied;
  for (std::size_t b = 0; b < rank.size(); ++b)
    if (rank[b]) rank[b] = static_cast<int>(occupied.size()), occupied.push_back(first + static_cast<std::int64_t>(b));

  // Stable counting sort.
  const auto dense = [&](std::int64_t k) {
    return static_cast<std::size_t>(rank_of(k)) * block_nodes<Dim> + static_cast<std::size_t>(k % block_nodes<Dim>);
  };
  std::vector<std::uint32_t> start(occupied.size() * block_nodes<Dim> + 1, 0);
  for (const auto k : key) ++start[dense(k) + 1];
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  bins_.clear();
  for (std::size_t b = 0; b < occupied.size(); ++b)
    bins_.push_back({occupied[b], start[b * block_nodes<Dim>], start[(b + 1) * block_nodes<Dim>]});
  std::vector<std::uint32_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[start[dense(key[i])]++] = static_cast<std::uint32_t>(i);
  // Now start[c] is the end of cell c. Within a cell the particles are ordered by number, so that the order, and with
  // it every sum over particles, does not depend on how the particles came there.
  parallel_for(static_cast<std::ptrdiff_t>(occupied.size()), [&](std::ptrdiff_t b) {
    for (std::size_t c = static_cast<std::size_t>(b) * block_nodes<Dim>;
         c < (static_cast<std::size_t>(b) + 1) * block_nodes<Dim>; ++c)
      std::sort(order.begin() + (c == 0 ? 0 : start[c - 1]), order.begin() + start[c],
                [&](std::uint32_t i, std::uint32_t j) { return particles.id[i] < particles.id[j]; });
  });

  own_ = bins_.size();
  cells_.clear();
  for (std::size_t b = 0; b < occupied.size(); ++b)
    cells_.push_back(range_of({start.data() + b * block_nodes<Dim>, block_nodes<Dim>}, bins_[b].begin));

  particles.reorder(order);
  paint(lattice);
  return -1;
}

template <int Dim>
std::vector<BinContent<Dim>> Bins<Dim>::contents() const {
  std::vector<BinContent<Dim>> out;
  for (std::size_t b = 0; b < own_; ++b)
    out.push_back({bins_[b].block, bins_[b].end - bins_[b].begin, cells_[b].low, cells_[b].high});
  return out;
}

template <int Dim>
void Bins<Dim>::assign(const Lattice<Dim>& lattice, std::span<const BinContent<Dim>> own,
                       std::span<const BinContent<Dim>> ghosts) {
  bins_.clear(), cells_.clear();
  std::uint32_t end = 0;
  for (const auto list : {own, ghosts})
    for (const BinContent<Dim>& bin : list) {
      bins_.push_back({bin.block, end, end + bin.count}), end += bin.count;
      cells_.push_back({bin.low, bin.high});
    }
  own_ = own.size();
  paint(lattice);
}

// From the ends of the particles of each cell of a block, which begin with the particle `begin`.
template <int Dim>
auto Bins<Dim>::range_of(std::span<const std::uint32_t> ends, std::uint32_t begin) -> CellRange {
  CellRange range;
  range.low.fill(block_edge<Dim> - 1), range.high.fill(0);
  for (std::size_t c = 0; c < ends.size(); ++c) {
    if (ends[c] == (c == 0 ? begin : ends[c - 1])) continue;
    auto rest = static_cast<int>(c);
    for (std::size_t d = 0; d < Dim; ++d, rest /= block_edge<Dim>) {
      const int at = rest % block_edge<Dim>;
      range.low[d] = std::min(range.low[d], at), range.high[d] = std::max(range.high[d], at);
    }
  }
  return range;
}

// The lowest node of a stencil is in the cells of the last sort or in those next to them.
template <int Dim>
std::vector<BlockReach<Dim>> Bins<Dim>::reach(const Lattice<Dim>& lattice, int width) const {
  std::vector<BlockReach<Dim>> out;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    BlockReach<Dim> nodes{bins_[b].block, {}, {}};
    const Index<Dim> middle = lattice.block_at(bins_[b].block);
    for (std::size_t d = 0; d < Dim; ++d) {
      const int last = block_edge<Dim> - 1;  // of the block
      nodes.low[d] = std::max(cells_[b].low[d] - 1, middle[d] > 0 ? -block_edge<Dim> : 0);
      nodes.high[d] =
          std::min(cells_[b].high[d] + width, middle[d] + 1 < lattice.blocks[d] ? last + block_edge<Dim> : last);
    }
    out.push_back(nodes);
  }
  return out;
}

template <int Dim>
void Bins<Dim>::paint(const Lattice<Dim>& lattice) {
  std::size_t count = 1;
  for (int d = 0; d < Dim; ++d) count *= static_cast<std::size_t>(colours_per_axis_);
  colours_.assign(count, {});
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    // Bins of a checkpoint may be damaged.
    if (bins_[k].block < 0 || bins_[k].block >= lattice.block_count() || bins_[k].begin != before(k) ||
        bins_[k].end < bins_[k].begin)
      refuse_checkpoint("the bins of particles do not follow each other");
    const auto block = lattice.block_at(bins_[k].block);
    std::size_t colour = 0;
    for (const int b : block)
      colour = colour * static_cast<std::size_t>(colours_per_axis_) + static_cast<std::size_t>(b % colours_per_axis_);
    colours_[colour].push_back(static_cast<std::uint32_t>(k));
  }
  by_block_.resize(bins_.size());
  std::iota(by_block_.begin(), by_block_.end(), 0U);
  std::ranges::sort(by_block_, {}, [&](std::uint32_t k) { return bins_[k].block; });
  before_.assign(count, {0});
  for (std::size_t colour = 0; colour < count; ++colour)
    for (const std::uint32_t k : colours_[colour])
      before_[colour].push_back(before_[colour].back() + bins_[k].end - bins_[k].begin);
}

template <int Dim>
bool Bins<Dim>::hold(const Lattice<Dim>& lattice, const Particles<Dim>& particles) const {
  for (const Bin& bin : bins_) {
    const auto block = lattice.block_at(bin.block);
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      const Vec<Dim> cells = ((particles.position(i) - lattice.origin).array() / lattice.spacing.array()) - shift_;
      for (int d = 0; d < Dim; ++d) {
        const double from = cells[d] - block[static_cast<std::size_t>(d)] * block_edge<Dim>;
        if (!(from >= -1 && from <= block_edge<Dim> + 1)) return false;
      }
    }
  }
  return true;
}

template class Bins<2>;
template class Bins<3>;

}  // namespace tribo
