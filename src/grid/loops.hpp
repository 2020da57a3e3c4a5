// SPDX-License-Identifier: MIT
/// Parallel loops over all nodes or particles. Two calls must not write to the same data.
#pragma once

#include "base/parallel.hpp"
#include "grid/nodes.hpp"

#include <algorithm>
#include <cstring>

namespace tribo {

/// Calls f(first, last) for ranges that cover 0 ... n - 1.
inline void each_piece(std::size_t n, auto&& f) {
  static constexpr std::size_t piece = 1024;
  parallel_for(static_cast<std::ptrdiff_t>((n + piece - 1) / piece), [&](std::ptrdiff_t k) {
    const std::size_t first = static_cast<std::size_t>(k) * piece;
    f(first, std::min(n, first + piece));
  });
}

/// Calls f(i) for i = 0 ... n - 1.
inline void each_index(std::size_t n, auto&& f) {
  each_piece(n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) f(i);
  });
}

template <class N>
void each_node(AlignedVector<N>& nodes, auto&& f) {
  each_index(nodes.size(), [&](std::size_t i) { f(nodes[i]); });
}

template <class N>
void zero(AlignedVector<N>& nodes) {
  each_piece(nodes.size(), [&](std::size_t first, std::size_t last) {
    std::memset(static_cast<void*>(nodes.data() + first), 0, sizeof(N) * (last - first));
  });
}

}  // namespace tribo
