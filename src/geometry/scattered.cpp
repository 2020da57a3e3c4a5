// SPDX-License-Identifier: MIT
#include "geometry/scattered.hpp"

#include <Eigen/QR>
#include <nanoflann.hpp>

#include <algorithm>
#include <cstdint>

namespace tribo {

struct ScatteredField::Tree {
  std::vector<Vec3> points;
  std::vector<Values> values;
  int dimension;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Tree>, Tree> index;

  Tree(std::vector<Vec3> p, std::vector<Values> v, int dim)
      : points(std::move(p)), values(std::move(v)), dimension(dim), index(dim, *this) {
    index.buildIndex();
  }

  // Interface required by nanoflann.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

ScatteredField::ScatteredField(std::vector<Vec3> points, std::vector<Values> values, int dimension)
    : tree_(std::make_unique<Tree>(std::move(points), std::move(values), dimension)) {}

ScatteredField::~ScatteredField() = default;

ScatteredField::Values ScatteredField::at(const Vec3& x) const {
  const std::size_t wanted = std::min<std::size_t>(tree_->points.size(), tree_->dimension == 2 ? 8 : 16);
  std::vector<std::uint32_t> near(wanted);
  std::vector<double> square(wanted);
  const std::size_t count = tree_->index.knnSearch(x.data(), wanted, near.data(), square.data());
  const double reach = square[count - 1] > 0 ? square[count - 1] : 1.0;
  const auto n = static_cast<Eigen::Index>(count), d = static_cast<Eigen::Index>(tree_->dimension);
  Eigen::VectorXd weight(n);
  for (Eigen::Index k = 0; k < n; ++k) weight[k] = 1 / (square[static_cast<std::size_t>(k)] / reach + 1e-6);
  Vec3 middle = Vec3::Zero();
  for (Eigen::Index k = 0; k < n; ++k)
    middle += weight[k] * weight[k] / weight.squaredNorm() * tree_->points[near[static_cast<std::size_t>(k)]];
  Eigen::MatrixXd A(n, d + 1), b(n, 6);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t p = near[static_cast<std::size_t>(k)];
    A(k, 0) = weight[k];
    A.row(k).tail(d) = weight[k] / std::sqrt(reach) * (tree_->points[p] - middle).head(d).transpose();
    for (Eigen::Index c = 0; c < 6; ++c) b(k, c) = weight[k] * tree_->values[p][static_cast<std::size_t>(c)];
  }
  // The least-squares fit of minimum norm: collinear points do not determine the gradient across their line.
  const Eigen::MatrixXd fit = A.completeOrthogonalDecomposition().solve(b);
  Eigen::RowVectorXd where(d + 1);
  where << 1, (x - middle).head(d).transpose() / std::sqrt(reach);
  const Eigen::RowVectorXd value = where * fit;
  Values out;
  for (std::size_t c = 0; c < 6; ++c) out[c] = value[static_cast<Eigen::Index>(c)];
  return out;
}

}  // namespace tribo
