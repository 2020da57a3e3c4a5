// SPDX-License-Identifier: MIT
/// Vectors, matrices and the layout of tensors in particle columns.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <string_view>

namespace tribo {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;
using Vec3 = Vec<3>;
using Mat3 = Mat<3>;

/// Layout of tensors with one array per component.
/// Two dimensions keep the out-of-plane normal component and omit the components that are always zero.
/// Symmetric tensors are in VTK's order. Axisymmetric models: x = r, y = z (axis), z = hoop direction.
template <int Dim>
struct Layout;

template <>
struct Layout<2> {
  static constexpr int symmetric = 4;  ///< xx yy zz xy
  static constexpr int full = 5;       ///< xx xy yx yy zz
  static constexpr std::array<std::array<int, 2>, symmetric> symmetric_at{{{0, 0}, {1, 1}, {2, 2}, {0, 1}}};
  static constexpr std::array<std::array<int, 2>, full> full_at{{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 2}}};
};

template <>
struct Layout<3> {
  static constexpr int symmetric = 6;  ///< xx yy zz xy yz xz
  static constexpr int full = 9;       ///< row by row: xx xy xz yx yy yz zx zy zz
  static constexpr std::array<std::array<int, 2>, symmetric> symmetric_at{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  static constexpr std::array<std::array<int, 2>, full> full_at{
      {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}};
};

/// Tensor of point `i`, stored in one array per component, as a 3x3 matrix.
template <int Dim, class Columns>
Mat3 load_symmetric(const Columns& c, int i) {
  Mat3 m = Mat3::Zero();
  for (int k = 0; k < Layout<Dim>::symmetric; ++k) {
    const auto [r, s] = Layout<Dim>::symmetric_at[static_cast<std::size_t>(k)];
    m(r, s) = m(s, r) = c[static_cast<std::size_t>(k)][i];
  }
  return m;
}

template <int Dim, class Columns>
void store_symmetric(const Mat3& m, const Columns& c, int i) {
  for (int k = 0; k < Layout<Dim>::symmetric; ++k) {
    const auto [r, s] = Layout<Dim>::symmetric_at[static_cast<std::size_t>(k)];
    c[static_cast<std::size_t>(k)][i] = m(r, s);
  }
}

template <int Dim, class Columns>
Mat3 load_full(const Columns& c, int i) {
  Mat3 m = Mat3::Zero();
  for (int k = 0; k < Layout<Dim>::full; ++k) {
    const auto [r, s] = Layout<Dim>::full_at[static_cast<std::size_t>(k)];
    m(r, s) = c[static_cast<std::size_t>(k)][i];
  }
  return m;
}

template <int Dim, class Columns>
void store_full(const Mat3& m, const Columns& c, int i) {
  for (int k = 0; k < Layout<Dim>::full; ++k) {
    const auto [r, s] = Layout<Dim>::full_at[static_cast<std::size_t>(k)];
    c[static_cast<std::size_t>(k)][i] = m(r, s);
  }
}

}  // namespace tribo
