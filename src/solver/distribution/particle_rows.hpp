// SPDX-License-Identifier: MIT
/// Particles in messages between processes.
#pragma once

#include "base/bytes.hpp"
#include "solver/state/system.hpp"

#include <cstddef>
#include <span>

namespace tribo {

/// Appends the values of a column in the ranges of some bins.
inline void write_column(ByteWriter& to, const double* column, std::span<const Bin> bins) {
  for (const Bin& bin : bins) to.values(std::span<const double>(column + bin.begin, bin.end - bin.begin));
}

/// Appends the numbers and all columns of the particles in some bins.
template <int Dim>
void write_rows(ByteWriter& to, const Particles<Dim>& particles, std::span<const Bin> bins) {
  for (const Bin& bin : bins)
    to.values(std::span<const std::int64_t>(particles.id.data() + bin.begin, bin.end - bin.begin));
  for (const auto& column : particles.columns()) write_column(to, column.data.data(), bins);
}

/// Reads rows that were written for `count` particles to the places from `first`, of particles or ghosts.
template <int Dim>
void read_rows(ByteReader& from, Particles<Dim>& particles, std::size_t first, std::size_t count) {
  const bool of_ghosts = first >= particles.size();
  auto& numbers = of_ghosts ? particles.ghost_id : particles.id;
  from.values(std::span(numbers).subspan(first - (of_ghosts ? particles.size() : 0), count));
  for (auto& column : particles.columns()) from.values(std::span<double>(column.data.data() + first, count));
}

/// Number of particles in some bins.
template <int Dim>
std::size_t particles_in(std::span<const BinContent<Dim>> bins) {
  std::size_t count = 0;
  for (const auto& bin : bins) count += bin.count;
  return count;
}

}  // namespace tribo
