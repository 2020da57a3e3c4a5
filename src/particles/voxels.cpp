// SPDX-License-Identifier: MIT
#include "particles/voxels.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace tribo {
namespace {

constexpr int bits = 21;                        // of a key, per axis
constexpr std::int64_t bias = 1 << (bits - 1);  // keeps the numbers of cubes positive
constexpr std::uint64_t mask = (1u << bits) - 1;
constexpr std::size_t max_chords = 2'000;
constexpr double march = 0.2;      // steps along a line [cubes]
constexpr double opposite = -0.8;  // largest cosine of the angle between opposite normals
constexpr double share = 0.1;      // of the lines that must end at an opposite face

// The cube that contains a point.
template <int Dim>
Index<Dim> around(const Vec<Dim>& point) {
  Index<Dim> voxel;
  for (std::size_t d = 0; d < Dim; ++d) voxel[d] = static_cast<int>(std::floor(point[static_cast<Eigen::Index>(d)]));
  return voxel;
}

}  // namespace

template <int Dim>
Voxels<Dim>::Voxels(const Model& model, const Lattice<Dim>& lattice)
    : low_(lattice.low), size_(lattice.spacing / per_cell) {
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    const auto number = [&](double x) { return static_cast<int>(std::lround((x - low_[axis]) / size_[axis])); };
    for (std::size_t side = 0; side < 2; ++side)
      if (const auto& plane = model.grid.symmetry[d][side]) mirror_[d][side] = number(*plane);
    if (d == 0 && model.analysis == Analysis::axisymmetric) mirror_[0][0] = number(0.0);
  }
}

template <int Dim>
typename Voxels<Dim>::Key Voxels<Dim>::key_of(const Index<Dim>& voxel) {
  Key key = 0;
  for (std::size_t d = Dim; d-- > 0;) key = key << bits | (static_cast<Key>(voxel[d] + bias) & mask);
  return key;
}

template <int Dim>
Index<Dim> Voxels<Dim>::voxel_of(Key key) {
  Index<Dim> voxel;
  for (int& component : voxel) component = static_cast<int>(static_cast<std::int64_t>(key & mask) - bias), key >>= bits;
  return voxel;
}

// A particle covers the cubes whose centres lie in its domain, or if there is none the one that contains its own
// centre.
template <int Dim>
void Voxels<Dim>::add(const Seed& seed) {
  const Mat3 whole = seed.F * seed.half_axes.value_or(Mat3(seed.half_size.asDiagonal()));
  const Mat<Dim> axes = size_.cwiseInverse().asDiagonal() * whole.template topLeftCorner<Dim, Dim>();
  const Vec<Dim> centre = (seed.x.template head<Dim>() - low_).cwiseQuotient(size_);
  const Vec<Dim> reach = axes.cwiseAbs().rowwise().sum();
  volume_ += std::abs(axes.determinant()) * (1 << Dim);
  Index<Dim> home, low, high;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    home[d] = static_cast<int>(std::floor(centre[k]));
    low[d] = static_cast<int>(std::ceil(centre[k] - reach[k] - 0.5));
    high[d] = static_cast<int>(std::floor(centre[k] + reach[k] - 0.5));
  }
  if (low == home && high == home) {
    keys_.push_back(key_of(home));
    return;
  }
  const Mat<Dim> inverse = axes.inverse();
  const std::size_t before = keys_.size();
  each_in_box<Dim>(low, high, [&](const Index<Dim>& voxel) {
    Vec<Dim> offset = Vec<Dim>::Constant(0.5) - centre;
    for (std::size_t d = 0; d < Dim; ++d) offset[static_cast<Eigen::Index>(d)] += voxel[d];
    if ((inverse * offset).cwiseAbs().maxCoeff() < 1 + 1e-6) keys_.push_back(key_of(voxel));
  });
  if (keys_.size() == before) keys_.push_back(key_of(home));
}

template <int Dim>
void Voxels<Dim>::sort() {
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
}

template <int Dim>
typename Voxels<Dim>::Box Voxels<Dim>::box() const {
  Box box{voxel_of(keys_.front()), voxel_of(keys_.front())};
  for (const Key key : keys_) {
    const Index<Dim> voxel = voxel_of(key);
    for (std::size_t d = 0; d < Dim; ++d)
      box.low[d] = std::min(box.low[d], voxel[d]), box.high[d] = std::max(box.high[d], voxel[d]);
  }
  return box;
}

template <int Dim>
bool Voxels<Dim>::contains(Index<Dim> voxel) const {
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto& [low, high] = mirror_[d];
    if (low && voxel[d] < *low) voxel[d] = 2 * *low - 1 - voxel[d];
    if (high && voxel[d] >= *high) voxel[d] = 2 * *high - 1 - voxel[d];
  }
  return std::binary_search(keys_.begin(), keys_.end(), key_of(voxel));
}

template <int Dim>
void Voxels<Dim>::add_images(int reach) {
  for (std::size_t d = 0; d < Dim; ++d)
    for (const auto& plane : mirror_[d]) {
      if (!plane) continue;
      std::vector<Key> images;
      for (const Key key : keys_) {
        Index<Dim> voxel = voxel_of(key);
        const int image = 2 * *plane - 1 - voxel[d];
        if (std::abs(image - *plane) > reach) continue;
        voxel[d] = image;
        images.push_back(key_of(voxel));
      }
      keys_.insert(keys_.end(), images.begin(), images.end());
    }
  sort();
}

template <int Dim>
std::optional<std::size_t> Voxels<Dim>::cube_around(const Vec<Dim>& x) const {
  const Key key = key_of(around<Dim>((x - low_).cwiseQuotient(size_)));
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  if (found == keys_.end() || *found != key) return std::nullopt;
  return static_cast<std::size_t>(found - keys_.begin());
}

// A block with edge n ends at a cube if blocks with edge n - 1 end at all its neighbours with lower numbers. The keys
// are in order, so that the neighbours in one direction are found in a single pass.
template <int Dim>
std::vector<int> Voxels<Dim>::largest_cubes(int most) const {
  constexpr std::size_t corners = (1u << Dim) - 1;
  std::array<Key, corners> step{};
  std::array<std::size_t, corners> at{};
  for (std::size_t c = 0; c < corners; ++c)
    for (std::size_t d = 0; d < Dim; ++d)
      if ((c + 1) >> d & 1u) step[c] += Key{1} << (bits * d);
  std::vector<int> edge(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    int least = most - 1;
    for (std::size_t c = 0; c < corners; ++c) {
      while (keys_[at[c]] + step[c] < keys_[i]) ++at[c];
      least = keys_[at[c]] + step[c] == keys_[i] ? std::min(least, edge[at[c]]) : 0;
    }
    edge[i] = least + 1;
  }
  return edge;
}

// The keys are in order, so that the neighbours in one direction are found in a single pass.
template <int Dim>
std::vector<std::size_t> Voxels<Dim>::connected() const {
  std::vector<std::size_t> root(keys_.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (std::size_t d = 0; d < Dim; ++d) {
    const Key step = Key{1} << (bits * d);
    for (std::size_t i = 0, j = 0; i < keys_.size(); ++i) {
      while (j < keys_.size() && keys_[j] < keys_[i] + step) ++j;
      if (j < keys_.size() && keys_[j] == keys_[i] + step)
        root[std::max(find(i), find(j))] = std::min(find(i), find(j));
    }
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) root[i] = find(i);
  return root;
}

// The unit vector from a point to the cubes of these bodies within a cell around it: against the normal of their face.
template <int Dim>
std::optional<Vec<Dim>> Voxels<Dim>::towards(const Vec<Dim>& point) const {
  const Index<Dim> home = around<Dim>(point);
  Index<Dim> low = home, high = home;
  for (std::size_t d = 0; d < Dim; ++d) low[d] -= per_cell, high[d] += per_cell;
  Vec<Dim> sum = Vec<Dim>::Zero();
  each_in_box<Dim>(low, high, [&](const Index<Dim>& voxel) {
    if (!contains(voxel)) return;
    for (std::size_t d = 0; d < Dim; ++d) sum[static_cast<Eigen::Index>(d)] += voxel[d] - home[d];
  });
  const double norm = sum.norm();
  return norm > 1e-6 ? std::optional<Vec<Dim>>(sum / norm) : std::nullopt;
}

// The cubes that are less than a cell from those of `other` along an axis, by their positions in keys_.
template <int Dim>
std::vector<std::size_t> Voxels<Dim>::touching(const Voxels& other) const {
  std::vector<std::size_t> found;
  const auto merge = [&](Key mine, Key theirs) {  // where keys are equal after these are added
    for (std::size_t i = 0, j = 0; i < keys_.size(); ++i) {
      while (j < other.keys_.size() && other.keys_[j] + theirs < keys_[i] + mine) ++j;
      if (j < other.keys_.size() && other.keys_[j] + theirs == keys_[i] + mine) found.push_back(i);
    }
  };
  for (std::size_t d = 0; d < Dim; ++d)
    for (int distance = 1; distance <= per_cell; ++distance) {
      const Key step = static_cast<Key>(distance) << (bits * d);
      merge(step, 0), merge(0, step);
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <int Dim>
std::vector<typename Voxels<Dim>::Chord> Voxels<Dim>::chords_from(const Voxels& other) const {
  std::vector<Chord> chords;
  const std::vector<std::size_t> cubes = touching(other);
  const std::size_t stride = cubes.size() / max_chords + 1;
  for (std::size_t k = 0; k < cubes.size(); k += stride) {
    const Index<Dim> voxel = voxel_of(keys_[cubes[k]]);
    Vec<Dim> start;
    for (std::size_t d = 0; d < Dim; ++d) start[static_cast<Eigen::Index>(d)] = voxel[d] + 0.5;
    const auto normal = other.towards(start);
    if (!normal) continue;
    const auto length = [&](const Vec<Dim>& direction) {
      double inside = 0.0;
      while (contains(around<Dim>(start + (inside + march) * direction))) inside += march;
      return inside;
    };
    const double inwards = length(-*normal), outwards = length(*normal);
    chords.push_back({cubes[k], inwards + outwards + march, *normal, start - inwards * *normal});
  }
  return chords;
}

template <int Dim>
std::optional<double> Voxels<Dim>::thickness_behind(const Voxels& other) const {
  const std::vector<Chord> chords = chords_from(other);
  if (chords.empty()) return std::nullopt;
  const std::vector<std::size_t> body = connected();
  std::map<std::size_t, std::vector<double>> lengths;  // by body
  for (const Chord& chord : chords) lengths[body[chord.cube]].push_back(chord.length);
  double least = std::numeric_limits<double>::infinity();
  for (auto& [number, of_body] : lengths) {
    const auto median = of_body.begin() + static_cast<std::ptrdiff_t>(of_body.size() / 2);
    std::nth_element(of_body.begin(), median, of_body.end());
    least = std::min(least, *median);
  }
  // Surfaces fill their outermost cubes only partly.
  return least / per_cell * std::min(1.0, volume_ / static_cast<double>(keys_.size()));
}

template <int Dim>
bool Voxels<Dim>::lies_between(const Voxels& rigid) const {
  const std::vector<Chord> chords = chords_from(rigid);
  const auto ends_opposite = [&](const Chord& chord) {
    const auto normal = rigid.towards(chord.last);
    return normal && normal->dot(chord.normal) < opposite;
  };
  const auto count = std::count_if(chords.begin(), chords.end(), ends_opposite);
  return count > 0 && static_cast<double>(count) >= share * static_cast<double>(chords.size());
}

template class Voxels<2>;
template class Voxels<3>;

}  // namespace tribo
