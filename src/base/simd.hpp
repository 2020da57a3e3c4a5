/// Short vectors for the transfers between particles and nodes: a node is one Wide, (mass, momentum | -, force).
///
/// GCC/Clang vector extensions, so the same source serves any instruction set; without AVX-512 a Wide is two halves,
/// because compilers keep vectors wider than the machine's in memory.
#pragma once

namespace tribo {

using Vec4 = double __attribute__((vector_size(32), aligned(8), may_alias));

inline Vec4 load4(const double* p) { return *reinterpret_cast<const Vec4*>(p); }
inline void store4(double* p, Vec4 v) { *reinterpret_cast<Vec4*>(p) = v; }

#ifdef __AVX512F__

struct Wide {
  using Eight = double __attribute__((vector_size(64), aligned(8), may_alias));
  Eight v;
  static Wide zero() { return {Eight{}}; }
  static Wide load(const double* p) { return {*reinterpret_cast<const Eight*>(p)}; }
  static Wide join(Vec4 low, Vec4 high) { return {__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7)}; }
  void store(double* p) const { *reinterpret_cast<Eight*>(p) = v; }
  Vec4 low() const { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
  Vec4 high() const { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
  Wide operator+(const Wide& o) const { return {v + o.v}; }
  friend Wide operator*(double s, const Wide& w) { return {s * w.v}; }
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
  friend Wide operator*(double s, const Wide& w) { return {s * w.l, s * w.h}; }
};

#endif

/// Rows a, b, c, d become columns: four components of four points <-> four points of four components.
inline void transpose4(Vec4& a, Vec4& b, Vec4& c, Vec4& d) {
  const Vec4 ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

}  // namespace tribo
