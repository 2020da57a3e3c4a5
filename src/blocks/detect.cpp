// SPDX-License-Identifier: MIT
/// Detection of new contacts, and the check that no blocks overlap without a contact.

#include "base/error.hpp"
#include "base/text.hpp"
#include "blocks/jumps.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/near_pairs.hpp"
#include "contact/joint_parts.hpp"

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

}  // namespace

// Distance of two blocks, negative: overlap; any value above `enough` if the distance is larger than that.
double Assembly::gap_between(std::uint32_t a, std::uint32_t b, double enough) const {
  if (shapes[a].ball() && shapes[b].ball())
    return (motion[b].x - motion[a].x).norm() - shapes[a].radius - shapes[b].radius;
  if (shapes[a].ball() || shapes[b].ball()) {
    const std::uint32_t ball = shapes[a].ball() ? a : b, body = shapes[a].ball() ? b : a;
    const BlockMotion& m = motion[body];
    return nearest_point(shapes[body], m.R.transpose() * (motion[ball].x - m.x), plane_).distance - shapes[ball].radius;
  }
  thread_local PlacedBlock first, second;
  place(a, first), place(b, second);
  return separation(first, second, plane_, enough).gap;
}

// Axes of a new contact: the normal of the touching face, and tangents along axes of the smaller block. These are the
// edges of a box, so that the intersection is cut along them.
JointAxes Assembly::axes_between(std::uint32_t a, std::uint32_t b) const {
  thread_local PlacedBlock first, second;
  place(a, first), place(b, second);
  JointAxes axes;
  axes.n = separation(first, second, plane_, 1e300).n;
  if (plane_) return JointAxes::of_normal(axes.n);
  const Mat3& R = motion[bodies[a].volume < bodies[b].volume ? a : b].R;
  Eigen::Index flattest = 0;
  (R.transpose() * axes.n).cwiseAbs().minCoeff(&flattest);
  axes.s = (R.col(flattest) - axes.n * axes.n.dot(R.col(flattest))).normalized();
  axes.t = axes.n.cross(axes.s);
  return axes;
}

std::vector<Bounds> Assembly::bounds(double margin) const {
  std::vector<Bounds> out(blocks_, {Vec3::Constant(1e300), Vec3::Constant(-1e300)});
  for (std::size_t k = 0; k < blocks_; ++k) {
    const Vec3 r = Vec3::Constant(shapes[k].radius + margin);
    for (const Vec3& corner : shapes[k].corners) {
      const Vec3 x = motion[k].x + motion[k].R * corner;
      out[k].low = out[k].low.cwiseMin(x - r), out[k].high = out[k].high.cwiseMax(x + r);
    }
  }
  return out;
}

// Points of a block whose displacements bound those of all its points.
std::array<Vec3, 3> Assembly::marks(std::size_t k) const {
  const BlockMotion& m = motion[k];
  return {m.x, Vec3(m.x + reach_[k] * m.R.col(0)), Vec3(m.x + reach_[k] * m.R.col(1))};
}

void Assembly::store_marks(std::vector<Vec3>& places) const {
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

// Balls that touch at the start, or are so near that their law acts between them, have a permanent contact.
void Assembly::join_balls(std::vector<bool>& used) {
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
  double reach = 1e-6 * smallest;
  for (std::size_t k = 0; k <= spec_->joints.size(); ++k)
    if (const auto& law = spec_->laws_of(k).initial) reach = std::max(reach, law->proximity());
  std::vector<std::tuple<std::size_t, std::uint32_t, std::uint32_t>> found;  // rule and balls
  each_near_pair(bounds(0.5 * reach), [&](std::uint32_t a, std::uint32_t b) {
    if (!shapes[a].ball() || !shapes[b].ball()) return;
    const auto [c, site] = ball_contact(a, b);
    const Vec3 place = motion[a].x + (shapes[a].radius + 0.5 * site.gap) * c.axes.n;
    const std::size_t rule = spec_->rule(pairing(a, b, ContactKind::ball, place, c.axes.n, false), plane_);
    const auto& law = spec_->laws_of(rule).initial;
    if (law && site.gap <= std::max(1e-6 * smallest, law->proximity())) found.emplace_back(rule, a, b);
  });
  std::sort(found.begin(), found.end());
  for (const auto& [rule, a, b] : found) {
    const auto [c, site] = ball_contact(a, b);
    if (rule < used.size()) used[rule] = true;
    const JointLaw& law = *spec_->laws_of(rule).initial_of({bodies[a].group, bodies[b].group});
    add_contact(c, site, law, ContactKind::ball, {}, Vec3::Zero());
  }
}

// Pairs of blocks whose faces, all without bond, slid or separated lose their permanent contacts if they have a law for
// new ones, which are then detected. The forces at the start of the present step still act.
std::map<Pair, FormerFaces> Assembly::release_moved_faces(double dt) {
  std::map<Pair, FormerFaces> before;
  std::set<Pair> leave, stay;
  const auto each_face = [&](auto&& f) {
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (std::size_t k = groups[i].begin; k < groups[i].end; ++k)
        if (groups[i].kind == ContactKind::facet && !groups[i].platen && joints[k].area > 0)
          f(i, k, joints[k], contacts[k], Pair{contacts[k].a, contacts[k].b});
  };
  each_face([&](std::size_t g, std::size_t, const Joint& j, const BlockContact& c, const Pair& pair) {
    const double
        size = plane_ ? j.area / thickness_ : std::sqrt(j.area),
        turned = (motion[c.a].R * c.na).cross(motion[c.b].R * c.nb).norm();  // then corners are in contact, not faces
    if (groups[g].law->is_bonded(j))
      stay.insert(pair);
    else if (j.shear.norm() >= 0.05 * size || j.gap >= 0.05 * size || turned >= 0.03)
      leave.insert(pair);
  });
  for (auto pair = leave.begin(); pair != leave.end();)
    pair = later_law(pair->first, pair->second) ? std::next(pair) : leave.erase(pair);
  if (leave.empty()) return before;
  each_face([&](std::size_t g, std::size_t k, Joint& j, const BlockContact&, const Pair& pair) {
    if (leave.count(pair) == 0 || stay.count(pair) > 0) return;
    JointIncrement d;
    increments({g, k, k + 1}, dt, &d);
    FormerFaces& faces = before[{std::min(pair.first, pair.second), std::max(pair.first, pair.second)}];
    if (j.Fn < 0) faces.force -= j.Fn, faces.energy += spring_energy(j.Fn, j.Fn, j.kn * j.area);
    j.work += half_work(j, d);
    dashpot_work[k] += 0.5 * (j.dashpot_normal * d.normal - j.dashpot_shear.dot(d.shear));
    j.area = j.Fn = j.Mt = j.strain = j.dashpot_normal = j.poisson_normal = 0;
    j.Fs = j.Mb = j.dashpot_shear = j.poisson_shear = {};
    j.away = true;
  });
  return before;
}

void Assembly::find_pairs(double dt) {
  const auto replaced = dt > 0 ? release_moved_faces(dt) : std::map<Pair, FormerFaces>{};
  std::set<Pair> lasting;
  for (std::size_t k = 0; k < permanent_; ++k)
    if (joints[k].area > 0)
      lasting.emplace(std::min(contacts[k].a, contacts[k].b), std::max(contacts[k].a, contacts[k].b));
  std::map<Pair, std::uint32_t> law_of;  // a pair that was found before keeps its law
  const std::vector<std::int64_t> before = found_pairs();
  for (std::size_t k = 0; k + 2 < before.size(); k += 3)
    law_of[{static_cast<std::uint32_t>(before[k + 1]), static_cast<std::uint32_t>(before[k + 2])}] =
        static_cast<std::uint32_t>(before[k]);
  std::vector<FoundPair> pairs;
  const double near = later_reach();
  each_near_pair(bounds(0.5 * near), [&](std::uint32_t a, std::uint32_t b) {
    if (lasting.count({a, b}) || (bodies[a].held == 63 && bodies[b].held == 63)) return;
    if (gap_between(a, b, near) > near) return;
    const bool faces = !shapes[a].ball() && !shapes[b].ball();
    const auto known = law_of.find({a, b});
    const auto law = known == law_of.end() ? later_law(a, b) : known->second;
    if (law) pairs.insert(pairs.end(), faces ? shared_parts(plane_) : 1, {*law, a, b});
  });
  std::sort(pairs.begin(), pairs.end());
  store_marks(found_at_);
  set_pairs(pairs, replaced);
}

// Distance up to which pairs of blocks have a contact.
double Assembly::later_reach() const {
  double out = skin_;
  for (const JointLaw* law : later_laws_) out = std::max(out, skin_ + law->proximity());
  return out;
}

// Replaces the contacts after the permanent ones by those of the pairs; contacts that existed keep their state.
void Assembly::set_pairs(const std::vector<FoundPair>& pairs, const std::map<Pair, FormerFaces>& replaced) {
  struct Old {
    FoundPair pair;
    BlockContact contact;
    Joint joint;
    ContactForce force;
    double dashpot, failure_mode;
  };
  const bool running = !forces.empty();
  const double near = later_reach();
  std::vector<Old> old;
  const std::vector<std::int64_t> before = found_pairs();
  const auto number = [&](std::size_t k) { return static_cast<std::uint32_t>(before[k]); };
  for (std::size_t k = permanent_, at = 0; k < contacts.size(); ++k, at += 3)
    old.push_back({{number(at), number(at + 1), number(at + 2)},
                   contacts[k],
                   joints[k],
                   contact_forces[k],
                   dashpot_work[k],
                   failure_mode[k]});
  contacts.resize(permanent_), joints.resize(permanent_), outlines.resize(permanent_);
  if (running) contact_forces.resize(permanent_), dashpot_work.resize(permanent_), failure_mode.resize(permanent_);
  while (!groups.empty() && groups.back().begin >= permanent_) groups.pop_back();
  if (!groups.empty()) groups.back().end = std::min(groups.back().end, permanent_);
  std::size_t at = 0;
  std::uint32_t part = 0;
  const auto let_go = [&](const Old& o) {
    removed_.slip -= o.joint.slid, removed_.dashpot += o.dashpot;
    removed_.released += o.joint.released() + o.joint.strain;
  };
  for (const FoundPair& p : pairs) {
    for (; at < old.size() && old[at].pair < p; ++at) let_go(old[at]);
    const bool ball = shapes[p.a].ball() && shapes[p.b].ball(), faces = !shapes[p.a].ball() && !shapes[p.b].ball();
    auto [c, site] = ball_contact(p.a, p.b);
    c.part = part = &p > pairs.data() && *(&p - 1) == p ? part + 1 : 0;
    if (faces) {  // its area is that of the intersection, found later
      c.pa = c.pb = Vec3::Zero();
      site.radius = 0, site.gap = near, site.part_of_face = true;
      const double volume = std::min(bodies[c.a].volume, bodies[c.b].volume);
      site.area = 0.01 * (plane_ ? std::sqrt(volume * thickness_) : std::pow(volume, 2.0 / 3));
      c.axes = axes_between(c.a, c.b);
    }
    c.mass = mass_between(c.a, c.b);
    const auto kind = ball ? ContactKind::ball : faces ? ContactKind::overlap : ContactKind::ball_on_face;
    if (const auto faces_before = replaced.find({p.a, p.b}); faces_before != replaced.end())
      c.replaced = faces_before->second;
    add_contact(c, site, *later_laws_[p.law], kind, {}, Vec3::Zero());
    if (!running) continue;
    contact_forces.emplace_back(), contact_forces.back().at = motion[c.a].x + motion[c.a].R * c.pa;
    dashpot_work.push_back(0), failure_mode.push_back(0);
    if (at < old.size() && old[at].pair == p) {
      contacts.back() = old[at].contact, joints.back() = old[at].joint, contact_forces.back() = old[at].force;
      dashpot_work.back() = old[at].dashpot, failure_mode.back() = old[at].failure_mode;
      ++at;
    }
  }
  for (; at < old.size(); ++at) let_go(old[at]);
  if (running) connect();
  if (!kept_increments_.empty()) kept_increments_.resize(contacts.size()), predicted_.resize(contacts.size());
}

std::vector<std::int64_t> Assembly::found_pairs() const {
  std::vector<std::int64_t> out;
  for (const ContactGroup& g : groups)
    for (std::size_t k = std::max(g.begin, permanent_); k < g.end; ++k) {
      const auto law = std::find(later_laws_.begin(), later_laws_.end(), g.law) - later_laws_.begin();
      out.insert(out.end(), {std::int64_t{law}, std::int64_t{contacts[k].a}, std::int64_t{contacts[k].b}});
    }
  return out;
}

void Assembly::set_found_pairs(std::span<const std::int64_t> pairs) {
  std::vector<FoundPair> list;
  const auto number = [&](std::size_t k, std::size_t count) {
    if (pairs[k] < 0 || pairs[k] >= static_cast<std::int64_t>(count))
      throw FileError("the checkpoint is damaged: it has a contact of a block or a law that does not exist");
    return static_cast<std::uint32_t>(pairs[k]);
  };
  if (pairs.size() % 3 != 0) throw FileError("the checkpoint is damaged: a contact of blocks is not complete");
  for (std::size_t k = 0; k < pairs.size(); k += 3)
    list.push_back({number(k, later_laws_.size()), number(k + 1, blocks_), number(k + 2, blocks_)});
  if (!later_laws_.empty()) set_pairs(list);
}

void Assembly::check_contacts() {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < blocks_; ++k)
    smallest = std::min(smallest, plane_ ? std::sqrt(bodies[k].volume / thickness_) : std::cbrt(bodies[k].volume));
  if (!moved(checked_at_, 0.01 * smallest)) return;
  store_marks(checked_at_);
  const double much = (later_laws_.empty() ? 0.02 : 0.1) * smallest;  // pairs are searched for after a twentieth

  // Pairs that have contacts, with the depth of their overlap; bonded ones are not checked.
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
  each_near_pair(bounds(0.0), [&](std::uint32_t a, std::uint32_t b) {
    const auto found = known.find({a, b});
    const double deep = much + (found == known.end() ? 0.0 : found->second);
    if (std::isinf(deep) || gap_between(a, b, -deep) >= -deep) return;
    throw SimulationError("the blocks " + std::to_string(a + 1) + " and " + std::to_string(b + 1) + " met at " +
                          place_text(motion[b].x) + ", time " + std::to_string(time) +
                          "; blocks that meet need a law for new contacts, 'touchname' of <Blocks>");
  });
  for (const ContactGroup& g : groups)
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const Joint& j = joints[k];
      if (g.platen || g.kind != ContactKind::facet || j.Fn == 0 || g.law->is_bonded(j) || !shift.empty()) continue;
      const double size = plane_ ? j.area / thickness_ : std::sqrt(j.area);
      if (j.shear.norm() < 0.2 * size) continue;
      if (gap_between(contacts[k].a, contacts[k].b, much) <= much) continue;
      throw SimulationError(
          "the blocks " + std::to_string(contacts[k].a + 1) + " and " + std::to_string(contacts[k].b + 1) +
          " slid past each other at " + place_text(contact_forces[k].at) + ", time " + std::to_string(time) +
          ", and their contact still presses: it does not shrink as its faces part. Contacts are found anew with "
          "'touchname' of <Blocks>");
    }
  refuse_deep_overlaps();
}

// Blocks that sink into each other have too small a stiffness for their load, and would fall through.
void Assembly::refuse_deep_overlaps() const {
  constexpr double most = 1.0 / 3;  // of the thinner block
  for (const ContactGroup& g : groups) {
    if (g.platen || g.kind == ContactKind::facet) continue;  // the gap of faces that slid is no depth
    for (std::size_t k = g.begin; k < g.end; ++k) {
      const auto [a, b] = std::pair(contacts[k].a, contacts[k].b);
      const double depth = -joints[k].gap;
      if (!(depth > 0) || g.law->is_bonded(joints[k])) continue;
      const double thin = std::min(thinnest(shapes[a], plane_), thinnest(shapes[b], plane_));
      if (!(depth > most * thin)) continue;
      throw SimulationError(
          format("the blocks %u and %u overlap by %.3g at ", a + 1, b + 1, depth) + place_text(contact_forces[k].at) +
          format(", time %.6g, more than a third of the thickness of the thinner one, %.3g: the normal "
                 "stiffness of their contact, %.3g per area, is too small for the forces on them",
                 time, thin, joints[k].kn));
    }
  }
}

}  // namespace tribo
