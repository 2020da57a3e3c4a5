// SPDX-License-Identifier: MIT
/// Short vectors for the transfers between particles and nodes. The data of a node are one Wide: (mass, momentum | -,
/// force).
///
/// GCC/Clang vector extensions, so the same source serves any instruction set. A Wide is one register where the machine
/// computes with 512 bits at a time, and otherwise two halves. Zen 3 and Zen 4 compute with 256 bits also in AVX-512:
/// there it saves time to skip the half that shape function gradients do not need. The results are the same.
#pragma once

#include <type_traits>

#if defined(__AVX512F__) && !defined(__znver3__) && !defined(__znver4__)
#define TRIBO_WIDE_REGISTERS
#endif

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

#ifdef TRIBO_WIDE_REGISTERS

struct Wide {
  using Register = double __attribute__((vector_size(64)));
  Register all;
  static Wide zero() { return {Register{}}; }
  static Wide load(const double* p) { return {load_vector<Register>(p)}; }
  static Wide join(Vec4 low, Vec4 high) { return {__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7)}; }
  void store(double* p) const { store_vector(p, all); }
  Vec4 low() const { return __builtin_shufflevector(all, all, 0, 1, 2, 3); }
  Vec4 high() const { return __builtin_shufflevector(all, all, 4, 5, 6, 7); }
  Wide operator+(const Wide& o) const { return {all + o.all}; }
  Wide operator*(const Wide& o) const { return {all * o.all}; }
  friend Wide operator*(double s, const Wide& w) { return {s * w.all}; }
};

/// A Wide whose lower half is zero.
struct Upper {
  Wide::Register all;
  static Upper from(Vec4 high) { return {Wide::join(Vec4{}, high).all}; }
  friend Upper operator*(double s, const Upper& u) { return {s * u.all}; }
  friend Wide operator+(const Wide& w, const Upper& u) { return {w.all + u.all}; }
};

#else

struct Wide {
  Vec4 l, h;
  static Wide zero() { return {Vec4{}, Vec4{}}; }
  static Wide load(const double* p) { return {load4(p), load4(p + 4)}; }
  static Wide join(Vec4 low, Vec4 high) { return {low, high}; }
  void store(double* p) const { store4(p, l), store4(p + 4, h); }
  Vec4 low() const { return l; }
  Vec4 high() const { return h; }
  Wide operator+(const Wide& o) const { return {l + o.l, h + o.h}; }
  Wide operator*(const Wide& o) const { return {l * o.l, h * o.h}; }
  friend Wide operator*(double s, const Wide& w) { return {s * w.l, s * w.h}; }
};

/// A Wide whose lower half is zero, stored as its upper half.
struct Upper {
  Vec4 h;
  static Upper from(Vec4 high) { return {high}; }
  friend Upper operator*(double s, const Upper& u) { return {s * u.h}; }
  friend Wide operator+(const Wide& w, const Upper& u) { return {w.l, w.h + u.h}; }
};

#endif

/// Stands for a zero term of a sum, which is not computed.
struct Nothing {
  friend Nothing operator*(double, Nothing) { return {}; }
  friend Nothing operator*(Nothing, Nothing) { return {}; }
  template <class Vector>
  friend Vector operator+(const Vector& v, Nothing) {
    return v;
  }
};

/// A Vec4 or Wide from an array, and into an array.
template <class Vector>
inline Vector load_as(const double* p) {
  if constexpr (std::is_same_v<Vector, Vec4>)
    return load4(p);
  else
    return Vector::load(p);
}
inline void store_all(double* p, const Vec4& v) { store4(p, v); }
inline void store_all(double* p, const Wide& v) { v.store(p); }
inline Vec4 low_half(const Vec4& v) { return v; }
inline Vec4 low_half(const Wide& v) { return v.low(); }

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
