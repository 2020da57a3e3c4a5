// SPDX-License-Identifier: MIT
#include "particles/particles.hpp"

#include "base/parallel.hpp"

namespace tribo {

template <int Dim>
void Particles<Dim>::reorder(std::span<const std::uint32_t> order) {
  // One spare column is exchanged with each sorted column, so sorting needs no second copy of the particles.
  static constexpr std::ptrdiff_t piece = 1 << 14;
  count_ = order.size(), ghosts_ = 0;
  ghost_id.clear();
  const auto n = static_cast<std::ptrdiff_t>(count_);
  const std::ptrdiff_t pieces = (n + piece - 1) / piece;
  spare_.resize(count_ + padding, 0.0);
  for (auto& column : columns_) {
    const double* from = column.data.data();
    double* to = spare_.data();
    parallel_for(pieces, [&](std::ptrdiff_t k) {
      for (std::ptrdiff_t i = k * piece; i < std::min(n, (k + 1) * piece); ++i)
        to[i] = from[order[static_cast<std::size_t>(i)]];
    });
    std::swap(column.data, spare_);
  }
  std::vector<std::int64_t> ids(count_);
  for (std::size_t i = 0; i < count_; ++i) ids[i] = id[order[i]];
  id.swap(ids);
}

template <int Dim>
void Particles<Dim>::append_copies(std::span<const std::uint32_t> originals, std::int64_t first_id) {
  const std::size_t before = count_;
  resize(before + originals.size());
  for (Column& column : columns_)
    for (std::size_t k = 0; k < originals.size(); ++k) column.data[before + k] = column.data[originals[k]];
  for (std::size_t k = 0; k < originals.size(); ++k) id[before + k] = first_id + static_cast<std::int64_t>(k);
}

template <int Dim>
void Particles<Dim>::append(const Particles& from, std::span<const std::uint32_t> which) {
  const std::size_t before = count_;
  resize(before + which.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
    for (std::size_t k = 0; k < which.size(); ++k)
      columns_[c].data[before + k] = c < from.columns_.size() ? from.columns_[c].data[which[k]] : 0.0;
  for (std::size_t k = 0; k < which.size(); ++k) id[before + k] = from.id[which[k]];
}

template class Particles<2>;
template class Particles<3>;

}  // namespace tribo
