// SPDX-License-Identifier: MIT
/// Mirror images of particles in the symmetry planes of the grid.
#pragma once

#include "solver/state/particle_domain.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace tribo {

/// The symmetry planes, and the images of particles in them. Next to a plane, the face of a body is that of the whole
/// body, so the particles that determine it include the images beyond the plane.
///
/// An image has a number whose ternary digit d is 0, or 1 or 2 if it is that in the plane at the low or high end of
/// axis d. Image 0 is the particle itself.
template <int Dim>
class MirrorPlanes {
 public:
  static constexpr std::uint32_t image_count = Dim == 2 ? 9 : 27;

  MirrorPlanes() = default;
  MirrorPlanes(const GridSpec& grid, const Lattice<Dim>& lattice) {
    for (std::size_t d = 0; d < Dim; ++d) {
      at_[d] = grid.symmetry[d];
      const auto axis = static_cast<Eigen::Index>(d);
      for (std::size_t end = 0; end < 2; ++end)
        if (at_[d][end])
          node_[d][end] = static_cast<int>(std::lround((*at_[d][end] - lattice.origin[axis]) / lattice.spacing[axis]));
    }
    for (std::uint32_t image = 1; image < image_count; ++image)
      if (exists(image)) images_.push_back(image);
  }

  /// The numbers of all images, without the particle itself.
  const std::vector<std::uint32_t>& images() const { return images_; }
  /// Whether there are the planes of an image.
  bool exists(std::uint32_t image) const {
    for (std::size_t d = 0; d < Dim; ++d, image /= 3)
      if (image % 3 != 0 && !at_[d][image % 3 - 1]) return false;
    return image == 0;
  }
  /// The image of a point [length].
  Vec<Dim> point(Vec<Dim> x, std::uint32_t image) const {
    for (std::size_t d = 0; d < Dim; ++d, image /= 3)
      if (image % 3 != 0)
        x[static_cast<Eigen::Index>(d)] = 2 * *at_[d][image % 3 - 1] - x[static_cast<Eigen::Index>(d)];
    return x;
  }
  /// The image of a domain.
  ParticleDomain<Dim> domain(ParticleDomain<Dim> p, std::uint32_t image) const {
    if (image == 0) return p;
    p.x = point(p.x, image);
    for (Eigen::Index d = 0; d < Dim; ++d, image /= 3)
      if (image % 3 != 0) p.axes.row(d) *= -1;
    return p;
  }
  /// Replaces a node beyond the planes by the node whose image it is. Returns the signs of the components of vectors of
  /// the one at the other.
  Vec<Dim> reflect(Index<Dim>& node) const {
    Vec<Dim> signs = Vec<Dim>::Ones();
    if (images_.empty()) return signs;
    for (std::size_t d = 0; d < Dim; ++d)
      for (std::size_t end = 0; end < 2; ++end) {
        const int plane = node_[d][end];
        if (!at_[d][end] || (end == 0 ? node[d] >= plane : node[d] <= plane)) continue;
        node[d] = 2 * plane - node[d];
        signs[static_cast<Eigen::Index>(d)] = -1.0;
      }
    return signs;
  }

 private:
  std::array<std::array<std::optional<double>, 2>, Dim> at_{};  // coordinates, by axis and end [length]
  std::array<std::array<int, 2>, Dim> node_{};                  // their nodes along the axis
  std::vector<std::uint32_t> images_;
};

}  // namespace tribo
