/// Contacts that come about: balls that meet anything, polygons that meet, and the check that no other blocks do.

#include "base/error.hpp"
#include "blocks/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

namespace tribo {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::string place(const Vec3& x) {
  return "(" + std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) + ")";
}

/// Calls f(i, j) for all pairs of boxes that overlap, sorted along x.
template <class F>
void each_near_pair(const std::vector<Bounds>& boxes, F&& f) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto i, auto j) {
    return boxes[i].low[0] < boxes[j].low[0] || (boxes[i].low[0] == boxes[j].low[0] && i < j);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].low[0] <= boxes[order[i]].high[0]; ++j) {
      const Bounds &a = boxes[order[i]], &b = boxes[order[j]];
      if ((a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all())
        f(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
}

}  // namespace

BlockShape Assembly::placed(std::size_t k) const {
  BlockShape s = shapes[k];
  for (Vec3& x : s.corners) x = motion[k].x + motion[k].R * x;
  return s;
}

// Points of a block that tell whether any of it moved or turned.
std::array<Vec3, 3> Assembly::marks(std::size_t k) const {
  const BlockMotion& m = motion[k];
  return {m.x, Vec3(m.x + reach_[k] * m.R.col(0)), Vec3(m.x + reach_[k] * m.R.col(1))};
}

void Assembly::remember(std::vector<Vec3>& places) const {
  places.clear();
  for (std::size_t k = 0; k < blocks_; ++k)
    for (const Vec3& x : marks(k)) places.push_back(x);
}

bool Assembly::moved(std::span<const Vec3> since, double distance) const {
  for (std::size_t k = 0; 3 * k < since.size(); ++k) {
    const auto now = marks(k);
    for (std::size_t i = 0; i < 3; ++i)
      if ((now[i] - since[3 * k + i]).squaredNorm() > distance * distance) return true;
  }
  return false;
}

std::pair<BlockContact, JointSite> Assembly::ball_contact(std::uint32_t a, std::uint32_t b) const {
  const double ra = shapes[a].radius, rb = shapes[b].radius;
  const double r = ra > 0 && rb > 0 ? std::min(ra, rb) : std::max(ra, rb);  // of the smaller ball, or of the only one
  const Vec3 apart = motion[b].x - motion[a].x;
  BlockContact c;
  c.a = a, c.b = b, c.na[0] = ra, c.nb[0] = rb;
  c.axes = JointAxes::of_normal(apart.isZero(0.0) ? Vec3(Vec3::UnitX()) : apart);
  // lever arms for the estimate of the largest step
  c.pa = motion[a].R.transpose() * (ra * c.axes.n), c.pb = motion[b].R.transpose() * (-rb * c.axes.n);
  JointSite site;
  site.area = plane_ ? 2 * r * thickness_ : std::numbers::pi * r * r;
  site.distance = apart.norm(), site.gap = site.distance - ra - rb;
  site.plane = plane_, site.thickness = thickness_, site.radius = r;
  return {c, site};
}

// Balls that touch at the start have the common law, for good.
void Assembly::join_balls() {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < blocks_; ++k) {
    if (shapes[k].ball()) balls_.push_back(k);
    smallest =
        std::min(smallest, 0.5 * (plane_ ? std::sqrt(bodies[k].volume / thickness_) : std::cbrt(bodies[k].volume)));
  }
  skin_ = 0.2 * smallest;
  for (const BlockShape& s : shapes) {
    reach_.push_back(s.radius);
    for (const Vec3& x : s.corners) reach_.back() = std::max(reach_.back(), x.norm() + s.radius);
  }
  if (!spec_->law) return;
  for (std::size_t i = 0; i < balls_.size(); ++i)
    for (std::size_t j = i + 1; j < balls_.size(); ++j) {
      const auto [c, site] = ball_contact(balls_[i], balls_[j]);
      if (site.gap <= 1e-6 * smallest) add_contact(c, site, *spec_->law, ContactKind::ball, {}, Vec3::Zero());
    }
}

// Faces without bond that slid or parted leave their pair to what is found anew.
void Assembly::retire_faces() {
  for (const ContactGroup& g : groups) {
    if (g.kind != ContactKind::facet || g.platen) continue;
    for (std::size_t k = g.begin; k < g.end; ++k) {
      Joint& j = joints[k];
      if (j.area == 0 || g.law->is_bonded(j)) continue;
      const BlockContact& c = contacts[k];
      const double size = j.area / thickness_,
                   turned = (motion[c.a].R * c.na).cross(motion[c.b].R * c.nb).norm();  // then corners press, not faces
      if (j.shear.norm() < 0.05 * size && j.gap < 0.05 * size && turned < 0.03) continue;
      j.area = j.Fn = j.Mt = j.strain = j.dashpot_normal = j.poisson_normal = 0;
      j.Fs = j.Mb = j.dashpot_shear = j.poisson_shear = {};
      j.away = true;
    }
  }
}

void Assembly::find_pairs() {
  if (plane_ && !forces.empty()) retire_faces();
  std::set<Pair> lasting;
  for (std::size_t k = 0; k < lasting_; ++k)
    if (joints[k].area > 0)
      lasting.emplace(std::min(contacts[k].a, contacts[k].b), std::max(contacts[k].a, contacts[k].b));
  std::vector<Bounds> boxes(blocks_);
  std::vector<BlockShape> at(blocks_);
  for (std::size_t k = 0; k < blocks_; ++k) {
    at[k] = placed(k);
    boxes[k] = {Vec3::Constant(1e300), Vec3::Constant(-1e300)};
    const Vec3 r = Vec3::Constant(shapes[k].radius + 0.5 * skin_);
    for (const Vec3& x : at[k].corners)
      boxes[k].low = boxes[k].low.cwiseMin(x - r), boxes[k].high = boxes[k].high.cwiseMax(x + r);
  }
  std::vector<Pair> pairs;
  each_near_pair(boxes, [&](std::uint32_t a, std::uint32_t b) {
    const bool faces = !at[a].ball() && !at[b].ball();
    if ((faces && !plane_) || lasting.count({a, b}) || (bodies[a].held == 63 && bodies[b].held == 63)) return;
    if (overlap_depth(at[a], at[b], plane_) < -skin_) return;
    for (int k = 0; k < (faces ? 2 : 1); ++k) pairs.emplace_back(a, b);
  });
  std::sort(pairs.begin(), pairs.end());
  remember(found_at_);
  take_pairs(pairs);
}

namespace {

using Polygon = std::vector<Vec3>;

// What of a polygon lies where n . x <= limit; `spare` is a place to work in.
void cut(Polygon& polygon, const Vec3& n, double limit, Polygon& spare) {
  spare.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double u = n.dot(p) - limit, v = n.dot(q) - limit;
    if (u <= 0) spare.push_back(p);
    if ((u <= 0) != (v <= 0)) spare.push_back(p + u / (u - v) * (q - p));
  }
  polygon.swap(spare);
}

void place_corners(const BlockShape& shape, const BlockMotion& m, Polygon& to) {
  to.clear();
  for (const Vec3& x : shape.corners) to.push_back(m.x + m.R * x);
}

// Outward normal of the edge that begins at a corner; corners go round counter-clockwise.
Vec3 edge_normal(const Polygon& corners, std::size_t k) {
  const Vec3 along = corners[(k + 1) % corners.size()] - corners[k];
  return Vec3(along[1], -along[0], 0).normalized();
}

}  // namespace

// The half of the common polygon on one side along the face, n the direction of the least overlap. Its mean depth is
// the gap, so that springs k_n A add up to k_n times the common area.
Assembly::Overlap Assembly::overlap_of(const BlockContact& c) const {
  thread_local Polygon a, b, common, spare;  // kept from step to step
  place_corners(shapes[c.a], motion[c.a], a), place_corners(shapes[c.b], motion[c.b], b);
  Overlap out;
  double depth = std::numeric_limits<double>::infinity();
  for (const auto& [s, o, sign] : {std::tuple{&a, &b, 1.0}, std::tuple{&b, &a, -1.0}})
    for (std::size_t k = 0; k < s->size(); ++k) {
      const Vec3 n = edge_normal(*s, k);
      const double here = n.dot((*s)[k]);
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& x : *o) least = std::min(least, n.dot(x) - here);
      if (-least < depth) depth = -least, out.n = sign * n;
    }
  out.gap = -depth;
  out.at = 0.5 * (motion[c.a].x + motion[c.b].x);
  if (depth <= 0) return out;
  out.gap = 0;
  common = a;
  for (std::size_t k = 0; k < b.size() && common.size() > 2; ++k) {
    const Vec3 n = edge_normal(b, k);
    cut(common, n, n.dot(b[k]), spare);
  }
  if (common.size() < 3) return out;
  const Vec3 t(out.n[1], -out.n[0], 0);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : common) low = std::min(low, t.dot(x)), high = std::max(high, t.dot(x));
  const double middle = 0.5 * (low + high), side = c.on_a > 0 ? -1.0 : 1.0;
  cut(common, side * t, side * middle, spare);
  if (common.size() < 3 || !(high > low)) return out;
  double area = 0;
  Vec3 first = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < common.size(); ++k) {
    const Vec3 u = common[k] - common[0], v = common[k + 1] - common[0];
    const double part = 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]);
    area += part, first += part / 3 * (u + v);
  }
  out.length = 0.5 * (high - low);
  out.at = area > 0 ? Vec3(common[0] + first / area) : common[0];
  out.gap = -area / out.length;
  return out;
}

void Assembly::overlap_increment(std::size_t k, double dt, JointIncrement& d) {
  BlockContact& c = contacts[k];
  const BlockMotion &a = motion[c.a], &b = motion[c.b];
  const Overlap o = overlap_of(c);
  given[k].at = o.at;
  c.axes.n = o.n, c.axes.s = Vec3::UnitZ(), c.axes.t = Vec3(o.n[1], -o.n[0], 0);
  const Vec3 apart = dt * (b.v + b.w.cross(o.at - b.x) - a.v - a.w.cross(o.at - a.x));
  d.normal = apart.dot(o.n), d.shear = {0.0, apart.dot(c.axes.t)}, d.twist = 0, d.bend = {};
  d.gap = o.gap, d.dt = dt, d.mass = c.mass;
  Joint& j = joints[k];
  if (o.length > 0) j.area = o.length * thickness_, j.radius = 0.5 * o.length;
}

void Assembly::beside_increment(std::size_t k, double dt, JointIncrement& d) {
  BlockContact& c = contacts[k];
  const BlockMotion &a = motion[c.a], &b = motion[c.b];
  const bool first = shapes[c.a].ball();
  const BlockMotion &ball = first ? a : b, &body = first ? b : a;
  const NearestPoint near = nearest_point(shapes[first ? c.b : c.a], body.R.transpose() * (ball.x - body.x), plane_);
  const Vec3 out = body.R * near.out, n = first ? Vec3(-out) : out;
  d.gap = near.distance - shapes[first ? c.a : c.b].radius;
  const Vec3 at = body.x + body.R * near.at + 0.5 * d.gap * out;
  given[k].at = at;
  const Vec3 apart = dt * (b.v + b.w.cross(at - b.x) - a.v - a.w.cross(at - a.x)), turned = dt * (b.w - a.w);
  JointAxes& axes = c.axes;
  if (plane_) {
    axes.n = n, axes.s = Vec3::UnitZ(), axes.t = Vec3(n[1], -n[0], 0);
    d.shear = {0.0, apart.dot(axes.t)}, d.twist = 0.0, d.bend = {turned[2], 0.0};
  } else {
    axes.follow(n, 0.5 * dt * (a.w + b.w).dot((axes.n + n).normalized()));
    d.shear = axes.tangent(apart), d.twist = turned.dot(n), d.bend = axes.tangent(turned);
  }
  d.normal = apart.dot(n), d.dt = dt, d.mass = c.mass;
}

// Contacts of the pairs after the lasting ones; those that were there go on.
void Assembly::take_pairs(const std::vector<Pair>& pairs) {
  struct Old {
    Pair pair;
    BlockContact contact;
    Joint joint;
    ContactForce given;
    double dashpot, broke;
  };
  const bool running = !forces.empty();
  std::vector<Old> old;
  for (std::size_t k = lasting_; k < contacts.size(); ++k)
    old.push_back({{contacts[k].a, contacts[k].b}, contacts[k], joints[k], given[k], dashpot_work[k], broke[k]});
  contacts.resize(lasting_), joints.resize(lasting_), outlines.resize(lasting_);
  if (running) given.resize(lasting_), dashpot_work.resize(lasting_), broke.resize(lasting_);
  while (!groups.empty() && groups.back().begin >= lasting_) groups.pop_back();
  if (!groups.empty()) groups.back().end = std::min(groups.back().end, lasting_);
  std::size_t at = 0;
  const auto let_go = [&](const Old& o) {
    gone_.slip -= o.joint.slid, gone_.dashpot += o.dashpot;
    gone_.released += o.joint.released() + o.joint.strain;
  };
  for (const Pair& p : pairs) {
    for (; at < old.size() && old[at].pair < p; ++at) let_go(old[at]);
    const bool ball = shapes[p.first].ball() && shapes[p.second].ball(),
               faces = !shapes[p.first].ball() && !shapes[p.second].ball();
    auto [c, site] = ball_contact(p.first, p.second);
    if (faces) {  // its area is what they will share
      c.on_a = &p > pairs.data() && *(&p - 1) == p ? 1.0 : 0.0;
      c.pa = c.pb = Vec3::Zero();
      site.radius = 0, site.gap = skin_;
      site.area = 0.01 * std::sqrt(std::min(bodies[c.a].volume, bodies[c.b].volume) * thickness_);
    }
    const bool free_a = (bodies[c.a].held & 7) != 7, free_b = (bodies[c.b].held & 7) != 7;
    const double ma = bodies[c.a].mass, mb = bodies[c.b].mass;
    c.mass = free_a && free_b ? ma * mb / (ma + mb) : free_a ? ma : free_b ? mb : 0.0;
    const auto kind = ball ? ContactKind::ball : faces ? ContactKind::overlap : ContactKind::beside;
    add_contact(c, site, *spec_->touch, kind, {}, Vec3::Zero());
    if (!running) continue;
    given.emplace_back(), dashpot_work.push_back(0), broke.push_back(0);
    if (at < old.size() && old[at].pair == p) {
      contacts.back() = old[at].contact, joints.back() = old[at].joint, given.back() = old[at].given;
      dashpot_work.back() = old[at].dashpot, broke.back() = old[at].broke;
      ++at;
    }
  }
  for (; at < old.size(); ++at) let_go(old[at]);
  if (running) connect();
  if (!kept_increments_.empty()) kept_increments_.resize(contacts.size()), predicted_.resize(contacts.size());
}

std::vector<std::int64_t> Assembly::found_pairs() const {
  std::vector<std::int64_t> out;
  for (std::size_t k = lasting_; k < contacts.size(); ++k)
    out.insert(out.end(), {std::int64_t{contacts[k].a}, std::int64_t{contacts[k].b}});
  return out;
}

void Assembly::set_found_pairs(std::span<const std::int64_t> pairs) {
  std::vector<Pair> list;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2)
    list.emplace_back(static_cast<std::uint32_t>(pairs[k]), static_cast<std::uint32_t>(pairs[k + 1]));
  if (spec_->touch) take_pairs(list);
}

void Assembly::check_contacts() {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks_; ++k)
    smallest = std::min(smallest, plane_ ? std::sqrt(bodies[k].volume / thickness_) : std::cbrt(bodies[k].volume));
  if (!moved(checked_at_, 0.01 * smallest)) return;
  remember(checked_at_);
  const double much = (spec_->touch ? 0.1 : 0.02) * smallest;  // pairs are looked for after a twentieth

  // Pairs that have contacts, and how deep these overlap; none that is bonded is looked at.
  std::map<Pair, double> known;
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const BlockContact& c = contacts[k];
      const double deep = g.law->is_bonded(joints[k]) || g.kind != ContactKind::facet || !shift.empty()
                              ? std::numeric_limits<double>::infinity()
                              : -joints[k].gap;
      double& most = known.try_emplace({std::min(c.a, c.b), std::max(c.a, c.b)}, 0.0).first->second;
      most = std::max(most, deep);
    }
  std::vector<Bounds> boxes(blocks_);
  std::vector<BlockShape> at(blocks_);
  for (std::size_t k = 0; k < blocks_; ++k) {
    at[k] = placed(k);
    boxes[k] = {Vec3::Constant(1e300), Vec3::Constant(-1e300)};
    const Vec3 r = Vec3::Constant(shapes[k].radius);
    for (const Vec3& x : at[k].corners)
      boxes[k].low = boxes[k].low.cwiseMin(x - r), boxes[k].high = boxes[k].high.cwiseMax(x + r);
  }
  each_near_pair(boxes, [&](std::uint32_t a, std::uint32_t b) {
    const auto found = known.find({a, b});
    const double deep = much + (found == known.end() ? 0.0 : found->second);
    if (std::isinf(deep) || overlap_depth(at[a], at[b], plane_) <= deep) return;
    const bool found_anew = plane_ || at[a].ball() || at[b].ball();
    throw SimulationError("the blocks " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " met at " +
                          place(motion[b].x) + ", time " + std::to_string(time) +
                          (found_anew
                               ? "; blocks that meet need 'touchname' of <Blocks>"
                               : " with faces that did not touch at the start; polyhedra do not find each other, "
                                 "balls and polygons do: end the run before"));
  });
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const Joint& j = joints[k];
      if (g.platen || g.kind != ContactKind::facet || j.Fn == 0 || g.law->is_bonded(j) || !shift.empty()) continue;
      const double size = plane_ ? j.area / thickness_ : std::sqrt(j.area);
      if (j.shear.norm() < 0.2 * size) continue;
      if (overlap_depth(at[contacts[k].a], at[contacts[k].b], plane_) >= -much) continue;
      throw SimulationError(
          "the blocks " + std::to_string(contacts[k].a + 1) + " and " + std::to_string(contacts[k].b + 1) +
          " slid past each other at " + place(given[k].at) + ", time " + std::to_string(time) +
          ", and their contact still presses: it does not shrink as its faces part. Contacts are found anew with "
          "'touchname' of <Blocks>, in plane models");
    }
}

}  // namespace tribo
