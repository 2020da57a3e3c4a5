// SPDX-License-Identifier: MIT
#include "geometry/crossing.hpp"

#include <cmath>

namespace tribo {
namespace {

/// Exact sum of doubles, stored as components that do not overlap, sorted by magnitude.
/// Shewchuk, Discrete Comput. Geom. 18 (1997) 305-363.
class ExactSum {
 public:
  void add(double b) {
    double q = b;
    int kept = 0;
    for (int k = 0; k < count_; ++k) {
      const double sum = q + parts_[k], part = sum - q;
      const double error = (q - (sum - part)) + (parts_[k] - part);
      q = sum;
      if (error != 0) parts_[kept++] = error;
    }
    if (q != 0) parts_[kept++] = q;
    count_ = kept;
  }
  void add_product(double a, double b) {
    const double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }
  void add_product(double a, double b, double c) {
    const double p = a * b, low = std::fma(a, b, -p);
    add_product(low, c);
    add_product(p, c);
  }
  int sign() const { return count_ == 0 ? 0 : parts_[count_ - 1] > 0 ? 1 : -1; }

 private:
  double parts_[256];
  int count_ = 0;
};

int sign(double x) { return (x > 0) - (x < 0); }

/// Double-double number: the sum of two doubles, the second of which is the round-off of the first. Dekker, Numer.
/// Math. 18 (1971) 224-242.
struct Twofold {
  double high = 0.0, low = 0.0;

  /// Exact sum of two doubles.
  static Twofold sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  friend Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold s = sum(a.high, b.high);
    return sum(s.high, s.low + a.low + b.low);
  }
  friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + Twofold{-b.high, -b.low}; }
  friend Twofold operator*(const Twofold& a, const Twofold& b) {
    const double p = a.high * b.high;
    return sum(p, std::fma(a.high, b.high, -p) + (a.high * b.low + a.low * b.high));
  }
};

constexpr double fine_doubt = 1e-29;  // bound of the relative round-off of the determinants below in Twofold

// Sign of (a - b)(c - d) - (e - f)(g - h).
int sign_of_difference(double a, double b, double c, double d, double e, double f, double g, double h) {
  const double left = (a - b) * (c - d), right = (e - f) * (g - h), det = left - right;
  constexpr double doubt = 1e-15;  // larger than the bound (3 + 16 eps) eps of the relative round-off
  const double size = std::abs(left) + std::abs(right);
  if (std::abs(det) > doubt * size) return sign(det);
  if ((a == b || c == d) && (e == f || g == h)) return 0;
  const Twofold fine = Twofold::sum(a, -b) * Twofold::sum(c, -d) - Twofold::sum(e, -f) * Twofold::sum(g, -h);
  if (std::abs(fine.high) > fine_doubt * size) return sign(fine.high);
  ExactSum sum;
  sum.add_product(a, c), sum.add_product(-a, d), sum.add_product(-b, c), sum.add_product(b, d);
  sum.add_product(-e, g), sum.add_product(e, h), sum.add_product(f, g), sum.add_product(-f, h);
  return sum.sign();
}

// Sign of (b - a) x (c - a): 1 if a, b, c turn left.
int turn(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
  return sign_of_difference(b[0], a[0], c[1], a[1], b[1], a[1], c[0], a[0]);
}

// Sign of component k of (b - a) x (d - c).
int cross(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return sign_of_difference(b[i], a[i], d[j], c[j], b[j], a[j], d[i], c[i]);
}

// Sign of (b - a) . (c - a) x (d - a).
int volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  double det = 0.0, size = 0.0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double left = v[i] * w[j], right = v[j] * w[i];
    det += u[k] * (left - right), size += std::abs(u[k]) * (std::abs(left) + std::abs(right));
  }
  constexpr double doubt = 2e-15;  // larger than the bound (7 + 56 eps) eps of the relative round-off
  if (std::abs(det) > doubt * size) return sign(det);
  if (size == 0) return 0;  // every product has a factor 0
  Twofold fine;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto part = [&](const Vec3& x, int n) { return Twofold::sum(x[n], -a[n]); };
    fine = fine + part(b, k) * (part(c, i) * part(d, j) - part(c, j) * part(d, i));
  }
  if (std::abs(fine.high) > fine_doubt * size) return sign(fine.high);
  // The determinant of the rows (x, 1), expanded so that each product of three coordinates occurs once.
  ExactSum sum;
  const Vec3* p[4] = {&a, &b, &c, &d};
  for (int omitted = 0; omitted < 4; ++omitted) {
    const Vec3* q[3];
    for (int k = 0, n = 0; k < 4; ++k)
      if (k != omitted) q[n++] = p[k];
    const double s = omitted % 2 == 0 ? 1.0 : -1.0;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      sum.add_product(s * (*q[0])[k], (*q[1])[i], (*q[2])[j]);
      sum.add_product(-s * (*q[0])[k], (*q[1])[j], (*q[2])[i]);
    }
  }
  return sum.sign();
}

// On which side of the segment a corner lies, with the symbolic perturbation of crossing.hpp.
int side_of_way(const Vec<2>& from, const Vec<2>& to, const Vec<2>& corner) {
  if (const int s = turn(from, to, corner)) return s;
  if (const int s = sign(to[1] - from[1])) return s;
  return sign(from[0] - to[0]);
}
int side_of_way(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b) {
  if (const int s = volume(from, to, a, b)) return s;
  for (int k = 0; k < 3; ++k)
    if (const int s = cross(b, a, from, to, k)) return s;
  return 0;
}

}  // namespace

int side_of(const std::array<Vec<2>, 2>& piece, const Vec<2>& p) {
  const auto& [a, b] = piece;
  if (const int s = turn(a, b, p)) return s;
  if (const int s = sign(a[1] - b[1])) return s;
  return sign(b[0] - a[0]);
}

int side_of(const std::array<Vec<3>, 3>& piece, const Vec<3>& p) {
  const auto& [a, b, c] = piece;
  if (const int s = volume(a, b, c, p)) return s;
  for (int k = 0; k < 3; ++k)
    if (const int s = cross(a, b, a, c, k)) return s;
  return 0;
}

int crossing(const std::array<Vec<2>, 2>& piece, const Vec<2>& from, const Vec<2>& to) {
  const int start = side_of(piece, from);
  if (start == side_of(piece, to)) return 0;
  return side_of_way(from, to, piece[0]) == side_of_way(from, to, piece[1]) ? 0 : start;
}

int crossing(const std::array<Vec<3>, 3>& piece, const Vec<3>& from, const Vec<3>& to) {
  const int start = side_of(piece, from);
  if (start == side_of(piece, to)) return 0;
  const int first = side_of_way(from, to, piece[0], piece[1]);
  if (first != side_of_way(from, to, piece[1], piece[2])) return 0;
  return first == side_of_way(from, to, piece[2], piece[0]) ? start : 0;
}

}  // namespace tribo
