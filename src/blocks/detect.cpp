/// Contacts that come about: balls that meet, and the check that no other blocks do.

#include "base/error.hpp"
#include "blocks/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

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

bool Assembly::moved(std::span<const Vec3> since, double distance) const {
  for (std::size_t k = 0; k < since.size(); ++k)
    if ((motion[k].x - since[k]).squaredNorm() > distance * distance) return true;
  return false;
}

std::pair<BlockContact, JointSite> Assembly::ball_contact(std::uint32_t a, std::uint32_t b) const {
  const double ra = shapes[a].radius, rb = shapes[b].radius, r = std::min(ra, rb);
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
  for (std::uint32_t k = 0; k < blocks_; ++k)
    if (shapes[k].ball()) balls_.push_back(k), smallest = std::min(smallest, shapes[k].radius);
  skin_ = 0.2 * smallest;
  found_at_.resize(balls_.empty() ? 0 : blocks_);
  if (!spec_->law) return;
  for (std::size_t i = 0; i < balls_.size(); ++i)
    for (std::size_t j = i + 1; j < balls_.size(); ++j) {
      const auto [c, site] = ball_contact(balls_[i], balls_[j]);
      if (site.gap <= 1e-6 * smallest) add_contact(c, site, *spec_->law, ContactKind::ball, {}, Vec3::Zero());
    }
}

void Assembly::find_balls() {
  std::set<Pair> lasting;
  for (std::size_t k = 0; k < lasting_; ++k) lasting.emplace(contacts[k].a, contacts[k].b);
  std::vector<Bounds> boxes;
  for (const auto k : balls_) {
    const Vec3 r = Vec3::Constant(shapes[k].radius + 0.5 * skin_);
    boxes.push_back({motion[k].x - r, motion[k].x + r});
  }
  std::vector<Pair> pairs;
  each_near_pair(boxes, [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t a = balls_[i], b = balls_[j];
    const double gap = (motion[b].x - motion[a].x).norm() - shapes[a].radius - shapes[b].radius;
    if (gap < skin_ && !lasting.count({a, b})) pairs.emplace_back(a, b);
  });
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t k = 0; k < found_at_.size(); ++k) found_at_[k] = motion[k].x;
  take_balls(pairs);
}

// Contacts of the pairs after the lasting ones; those that were there go on.
void Assembly::take_balls(const std::vector<Pair>& pairs) {
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
    auto [c, site] = ball_contact(p.first, p.second);
    const bool free_a = (bodies[c.a].held & 7) != 7, free_b = (bodies[c.b].held & 7) != 7;
    const double ma = bodies[c.a].mass, mb = bodies[c.b].mass;
    c.mass = free_a && free_b ? ma * mb / (ma + mb) : free_a ? ma : free_b ? mb : 0.0;
    add_contact(c, site, *spec_->touch, ContactKind::ball, {}, Vec3::Zero());
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

std::vector<std::int64_t> Assembly::ball_pairs() const {
  std::vector<std::int64_t> out;
  for (std::size_t k = lasting_; k < contacts.size(); ++k)
    out.insert(out.end(), {std::int64_t{contacts[k].a}, std::int64_t{contacts[k].b}});
  return out;
}

void Assembly::set_ball_pairs(std::span<const std::int64_t> pairs) {
  std::vector<Pair> list;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2)
    list.emplace_back(static_cast<std::uint32_t>(pairs[k]), static_cast<std::uint32_t>(pairs[k + 1]));
  if (spec_->touch) take_balls(list);
}

void Assembly::check_contacts() {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks_; ++k)
    smallest = std::min(smallest, plane_ ? std::sqrt(bodies[k].volume / thickness_) : std::cbrt(bodies[k].volume));
  if (!moved(checked_at_, 0.01 * smallest)) return;
  for (std::size_t k = 0; k < checked_at_.size(); ++k) checked_at_[k] = motion[k].x;
  const double much = 0.02 * smallest;

  // Pairs that have contacts, and how deep these overlap; none that is bonded is looked at.
  std::map<Pair, double> known;
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const BlockContact& c = contacts[k];
      const double deep = g.law->is_bonded(joints[k]) || g.kind == ContactKind::ball || !shift.empty()
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
    const bool balls = at[a].ball() && at[b].ball();
    throw SimulationError(
        "the blocks " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " met at " + place(motion[b].x) +
        ", time " + std::to_string(time) +
        (balls ? "; balls that meet need 'touchname' of <Blocks>"
               : " with faces that did not touch at the start; finding such contacts is built for balls "
                 "only: end the run before"));
  });
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const Joint& j = joints[k];
      if (g.platen || g.kind != ContactKind::facet || j.Fn == 0 || g.law->is_bonded(j) || !shift.empty()) continue;
      const double size = plane_ ? j.area / thickness_ : std::sqrt(j.area);
      if (j.shear.norm() < 0.2 * size) continue;
      if (overlap_depth(at[contacts[k].a], at[contacts[k].b], plane_) >= -much) continue;
      throw SimulationError("the blocks " + std::to_string(contacts[k].a + 1) + " and " +
                            std::to_string(contacts[k].b + 1) + " slid past each other at " + place(given[k].at) +
                            ", time " + std::to_string(time) +
                            ", and their contact still presses: contacts of faces do not shrink as faces part, and "
                            "finding contacts anew is built for balls only");
    }
}

}  // namespace tribo
