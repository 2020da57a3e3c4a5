// SPDX-License-Identifier: MIT
#include "blocks/facet_increments.hpp"

#include "base/simd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tribo {
namespace {

constexpr std::size_t lanes = 4;

// A vector of four facets.
struct Vectors {
  Vec4 x{}, y{}, z{};

  friend Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vectors operator*(Vec4 f, const Vectors& v) { return {f * v.x, f * v.y, f * v.z}; }
  friend Vectors operator*(double f, const Vectors& v) { return {f * v.x, f * v.y, f * v.z}; }
  Vec4 dot(const Vectors& o) const { return x * o.x + y * o.y + z * o.z; }
  Vectors cross(const Vectors& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  void store(std::size_t k, Vec3& to) const { to = Vec3(x[k], y[k], z[k]); }
};

// Vectors of four objects, each of which has one more number behind its vector.
template <class Get>
Vectors load(Get&& get) {
  Vec4 a = load4(get(0)), b = load4(get(1)), c = load4(get(2)), d = load4(get(3));
  transpose4(a, b, c, d);
  return {a, b, c};
}

// The same with one more number before each vector.
template <class Get>
Vectors load_last(Get&& get) {
  Vec4 a = load4(get(0) - 1), b = load4(get(1) - 1), c = load4(get(2) - 1), d = load4(get(3) - 1);
  transpose4(a, b, c, d);
  return {b, c, d};
}

template <class Get>
Vec4 gather(Get&& get) {
  return Vec4{get(0), get(1), get(2), get(3)};
}

Vec4 root(Vec4 v) {
  for (int k = 0; k < 4; ++k) v[k] = std::sqrt(v[k]);
  return v;
}

// The motion of one body of each facet.
struct Motions {
  Vectors x, v, w, column[3];

  explicit Motions(const std::array<const BlockMotion*, lanes>& of)
      : x(load([&](std::size_t k) { return of[k]->x.data(); })),
        v(load([&](std::size_t k) { return of[k]->v.data(); })),
        w(load([&](std::size_t k) { return of[k]->w.data(); })),
        column{load([&](std::size_t k) { return of[k]->R.data(); }),
               load([&](std::size_t k) { return of[k]->R.data() + 3; }),
               load_last([&](std::size_t k) { return of[k]->R.data() + 6; })} {}
  Vectors rotated(const Vectors& p) const { return p.x * column[0] + p.y * column[1] + p.z * column[2]; }
};

struct Axes {
  Vectors n, s, t;
};

// JointAxes::follow with the mean rotation of both bodies in the step. Facets of bodies at rest keep their axes.
Axes carried(const Axes& old, const Vectors& n, const Vectors& wa, const Vectors& wb, double dt) {
  const Vec4 c = old.n.dot(n), spin = 0.25 * dt * (wa + wb).dot(old.n + n);
  Vectors s = old.s - (old.s.dot(n) / (1 + c)) * (old.n + n);
  s = s - s.dot(n) * n;
  s = (1.5 - 0.5 * s.dot(s)) * s;
  const Vectors across = n.cross(s);
  const Vec4 half = 0.5 * spin, part = 1 / (1 + half * half);
  const Vec4 cosine = (1 - half * half) * part, sine = 2 * half * part;
  Axes out{n, cosine * s + sine * across, cosine * across - sine * s};
  const auto equal = [](const Vectors& u, const Vectors& v) { return (u.x == v.x) & (u.y == v.y) & (u.z == v.z); };
  const auto resting = equal(n, old.n) & equal(wa, wb) & equal(wa, Vectors{});
  for (auto [to, from] : {std::pair(&out.s, &old.s), std::pair(&out.t, &old.t)})
    to->x = resting ? from->x : to->x, to->y = resting ? from->y : to->y, to->z = resting ? from->z : to->z;
  for (int k = 0; k < 4; ++k)
    if (c[k] < -0.999999) {  // reversed in one step: the smallest rotation is undefined
      const JointAxes axes = JointAxes::of_normal(Vec3(n.x[k], n.y[k], n.z[k]));
      out.s.x[k] = axes.s[0], out.s.y[k] = axes.s[1], out.s.z[k] = axes.s[2];
      out.t.x[k] = axes.t[0], out.t.y[k] = axes.t[1], out.t.z[k] = axes.t[2];
    }
  return out;
}

// The facets from `first` on, `count` of which are wanted. The last of them takes the place of those that are missing.
void four_increments(Assembly& blocks, std::size_t first, std::size_t count, double dt, JointIncrement* to) {
  std::array<BlockContact*, lanes> contact{};
  std::array<ContactForce*, lanes> force{};
  std::array<const BlockMotion*, lanes> of_a{}, of_b{};
  std::array<const Vec3*, lanes> shift{};
  static const Vec3 none = Vec3::Zero();
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t at = first + std::min(k, count - 1);
    contact[k] = &blocks.contacts[at], force[k] = &blocks.contact_forces[at];
    of_a[k] = &blocks.motion[contact[k]->a], of_b[k] = &blocks.motion[contact[k]->b];
    shift[k] = blocks.shift.empty() ? &none : &blocks.shift[at];
  }
  const auto of_shift = [&](int d) { return gather([&](std::size_t k) { return (*shift[k])[d]; }); };
  const Vectors by{of_shift(0), of_shift(1), of_shift(2)};
  const auto along = [&](int d) {
    return blocks.box_rate(d, 0) * by.x + blocks.box_rate(d, 1) * by.y + blocks.box_rate(d, 2) * by.z;
  };
  const Vectors speed{along(0), along(1), along(2)};
  const Motions a(of_a), b(of_b);
  const auto of_contact = [&](auto member) {
    return load([&](std::size_t k) { return (contact[k]->*member).data(); });
  };
  const auto of_axes = [&](auto member) {
    return load([&](std::size_t k) { return (contact[k]->axes.*member).data(); });
  };
  const Vec4 on_a = gather([&](std::size_t k) { return contact[k]->on_a; }), on_b = 1 - on_a;
  const Axes old{of_axes(&JointAxes::n), of_axes(&JointAxes::s), of_axes(&JointAxes::t)};
  const Vectors old_at = load([&](std::size_t k) { return force[k]->at.data(); });

  const Vectors xb = b.x + by, vb = b.v + speed;
  const Vectors pa = a.x + a.rotated(of_contact(&BlockContact::pa)), pb = xb + b.rotated(of_contact(&BlockContact::pb));
  Vectors n = on_b * a.rotated(of_contact(&BlockContact::na)) + on_a * b.rotated(of_contact(&BlockContact::nb));
  n = (1 / root(n.dot(n))) * n;
  const Vec4 gap = (pb - pa).dot(n);
  const Vectors at = on_a * pa + on_b * pb;
  const Axes now = carried(old, n, a.w, b.w, dt);

  const Vectors middle = 0.5 * (old_at + at), arm_a = middle - a.x + 0.5 * dt * a.v,
                arm_b = middle - xb + 0.5 * dt * vb;
  const Vectors apart = dt * (vb + b.w.cross(arm_b) - a.v - a.w.cross(arm_a)), turned = dt * (b.w - a.w);
  const Vectors across = 0.5 * (old.n + now.n), s = 0.5 * (old.s + now.s), t = 0.5 * (old.t + now.t);
  const Vec4 normal = across.dot(apart), shear_s = s.dot(apart), shear_t = t.dot(apart);
  const Vec4 twist = across.dot(turned), bend_s = s.dot(turned), bend_t = t.dot(turned);
  for (std::size_t k = 0; k < count; ++k) {
    JointAxes& axes = contact[k]->axes;
    now.n.store(k, axes.n), now.s.store(k, axes.s), now.t.store(k, axes.t), at.store(k, force[k]->at);
    JointIncrement& d = to[k];
    d.normal = normal[k], d.shear = {shear_s[k], shear_t[k]}, d.twist = twist[k], d.bend = {bend_s[k], bend_t[k]};
    d.gap = gap[k], d.dt = dt, d.mass = contact[k]->mass;
  }
}

}  // namespace

void facet_increments(Assembly& blocks, std::size_t begin, std::size_t end, double dt, JointIncrement* to) {
  for (std::size_t k = begin; k < end; k += lanes, to += lanes)
    four_increments(blocks, k, std::min(lanes, end - k), dt, to);
}

}  // namespace tribo
