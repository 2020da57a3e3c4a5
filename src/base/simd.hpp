// SPDX-License-Identifier: MIT
/// Short vectors for the transfers between particles and nodes. The data of a node are one Wide: (mass, momentum | -,
/// force).
///
/// GCC/Clang vector extensions, so the same source serves any instruction set. A Wide consists of two halves also with
/// AVX-512: shape function gradients are needed for the force half only, and skipping the other half was measured to
/// save more time than wider registers.
#pragma once

namespace tribo {

using Vec4 = double __attribute__((vector_size(32)));

/// A vector from an array, and into an array, of any alignment: a pointer to vectors would promise that of the vectors.
template <class Vector, class Number>
inline Vector load_vector(const Number* p) {
  Vector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <class Vector, class Number>
inline void store_vector(Number* p, Vector v) {
  __builtin_memcpy(p, &v, sizeof v);
}
inline Vec4 load4(const double* p) { return load_vector<Vec4>(p); }
inline void store4(double* p, Vec4 v) { store_vector(p, v); }

struct Wide {
  Vec4 l, h;
  static Wide zero() { return {Vec4{}, Vec4{}}; }
  static Wide load(const double* p) { return {load4(p), load4(p + 4)}; }
  static Wide join(Vec4 low, Vec4 high) { return {low, high}; }
  void store(double* p) const { store4(p, l), store4(p + 4, h); }
  Vec4 low() const { return l; }
  Vec4 high() const { return h; }
  Wide operator+(const Wide& o) const { return {l + o.l, h + o.h}; }
  friend Wide operator*(double s, const Wide& w) { return {s * w.l, s * w.h}; }
};

/// A Wide whose lower half is zero, stored as its upper half.
struct Upper {
  Vec4 h;
  static Upper zero() { return {Vec4{}}; }
  static Upper from(Vec4 high) { return {high}; }
  Upper operator+(const Upper& o) const { return {h + o.h}; }
  friend Upper operator*(double s, const Upper& u) { return {s * u.h}; }
  friend Wide operator+(const Wide& w, const Upper& u) { return {w.l, w.h + u.h}; }
};

/// As many doubles as fit into one register of the target machine.
#ifdef __AVX512F__
inline constexpr int lane_count = 8;
#else
inline constexpr int lane_count = 4;
#endif
using Lanes = double __attribute__((vector_size(lane_count * 8)));
using IntLanes = int __attribute__((vector_size(lane_count * 4)));

inline Lanes load_lanes(const double* p) { return load_vector<Lanes>(p); }
inline void store_lanes(double* p, Lanes v) { store_vector(p, v); }
inline IntLanes load_lanes(const int* p) { return load_vector<IntLanes>(p); }
inline void store_lanes(int* p, IntLanes v) { store_vector(p, v); }

/// Transposes the 4 x 4 matrix with rows a, b, c, d: four components of four points <-> four points of four components.
inline void transpose4(Vec4& a, Vec4& b, Vec4& c, Vec4& d) {
  const Vec4 ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

}  // namespace tribo
