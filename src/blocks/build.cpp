// SPDX-License-Identifier: MIT
/// Construction of blocks, contacts and masses from the description of an assembly.

#include "base/error.hpp"
#include "blocks/assembly.hpp"
#include "blocks/near_pairs.hpp"
#include "blocks/platen_law.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace tribo {
namespace {

/// The part of a face that belongs to a corner: the piece between the midpoints of its edges and the centre.
struct Share {
  Vec3 at;
  double area;
  std::vector<Vec3> outline;
};
std::vector<Share> shares(const BlockFacet& f, bool plane) {
  const auto& x = f.corners;
  const Vec3& c = f.geometry.centre;
  std::vector<Share> out;
  if (plane) {
    for (const Vec3& end : x) out.push_back({end, 0.5 * f.geometry.area, {c, end}});
    return out;
  }
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 next = 0.5 * (x[k] + x[(k + 1) % n]), last = 0.5 * (x[k] + x[(k + n - 1) % n]);
    const std::vector<Vec3> piece{x[k], next, c, last};
    out.push_back({x[k], face_geometry(piece, false, 1.0).area, piece});
  }
  return out;
}

BlockShape rotated(BlockShape shape, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  if (angle != 0)
    for (Vec3& x : shape.corners) x = R * x;
  return shape;
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

[[noreturn]] void fail(const Origin& origin, const std::string& message) { throw InputError(origin, message); }

}  // namespace

std::string place_text(const Vec3& x) {
  return "(" + short_number(x[0]) + ", " + short_number(x[1]) + (x[2] == 0 ? "" : ", " + short_number(x[2])) + ")";
}

std::size_t Assembly::add_body(const BlockShape& shape, const Vec3& reference, double density) {
  const MassProperties m = mass_properties(shape, plane_, thickness_);
  BlockBody body;
  body.volume = body.stress_weight = m.volume;
  body.mass = body.weight = density * m.volume;
  if (plane_ || shape.ball()) {
    body.inertia = Vec3::Constant(density * m.inertia(2, 2));
  } else {
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(m.inertia);
    body.inertia = density * principal.eigenvalues();
    body.axes = principal.eigenvectors();
    if (body.axes.determinant() < 0) body.axes.col(0) *= -1;
    body.sphere = body.inertia.maxCoeff() - body.inertia.minCoeff() <= 1e-12 * body.inertia.maxCoeff();
  }
  if (plane_) body.held = 4 | 8 | 16;
  body.reference = reference - m.centre, body.start = m.centre;
  BlockMotion at;
  at.x = m.centre;
  BlockShape own = shape;
  for (Vec3& x : own.corners) x -= m.centre;
  motion.push_back(at), orientation.push_back({1, 0, 0, 0}), bodies.push_back(body), shapes.push_back(std::move(own));
  return bodies.size() - 1;
}

void Assembly::add_contact(const BlockContact& c, const JointSite& site, const JointLaw& law, ContactKind kind,
                           std::vector<Vec3> outline, const Vec3& by) {
  for (Vec3& x : outline) x -= motion[c.a].x;
  const bool platen = c.b >= blocks_;
  if (groups.empty() || groups.back().law != &law || groups.back().kind != kind) {
    groups.push_back({&law, kind, contacts.size(), contacts.size(), platen});
  }
  ++groups.back().end;
  JointSite here = site;
  here.pressure = law.pore_pressure(motion[c.a].x + c.pa, time);
  contacts.push_back(c), joints.push_back(law.start(here)), outlines.push_back({std::move(outline)});
  if (!by.isZero(0.0) && shift.empty()) shift.resize(contacts.size() - 1, Vec3::Zero());
  if (!by.isZero(0.0) || !shift.empty()) shift.push_back(by);
}

void Assembly::add_facet(const BlockFacet& f, const JointLaw& law, bool corners) {
  const auto a = static_cast<std::size_t>(f.a), b = static_cast<std::size_t>(f.b);
  const Vec3& n = f.geometry.normal;
  const bool platen = b >= blocks_;
  const Vec3 ref_a = motion[a].x + bodies[a].reference, ref_b = motion[b].x + bodies[b].reference + f.shift;
  const auto add = [&](const Vec3& at, double area, std::vector<Vec3> outline) {
    BlockContact c;
    c.a = static_cast<std::uint32_t>(a), c.b = static_cast<std::uint32_t>(b);
    c.pa = at - motion[a].x, c.pb = at + f.gap * n - f.shift - motion[b].x;
    c.na = c.nb = n, c.on_a = f.owner == 0 ? 0.5 : f.owner == 1 ? 1.0 : 0.0;
    c.axes = JointAxes::of_normal(n);
    JointSite site;
    site.area = area, site.gap = f.gap, site.plane = plane_, site.thickness = thickness_;
    site.distance = platen ? n.dot(at - ref_a) : (ref_b - ref_a).norm();
    site.has_moments = !corners, site.part_of_face = corners;
    if (plane_) {
      site.moments = {std::pow(area / thickness_, 3) * thickness_ / 12, 0, 0};
    } else if (!corners) {
      std::vector<Tangent> flat;
      for (const Vec3& x : f.corners) flat.push_back(c.axes.tangent(x - at));
      const PolygonMoments m = polygon_moments(flat);
      site.moments = {m.I_s, m.I_t, m.I_st};
    }
    add_contact(c, site, law, ContactKind::facet, std::move(outline), f.shift);
  };
  if (!corners) return add(f.geometry.centre, f.geometry.area, f.corners);
  for (auto& s : shares(f, plane_)) add(s.at, s.area, std::move(s.outline));
}

Assembly::Assembly(const Tessellation& cells, std::span<const Vec3> nuclei, const std::shared_ptr<const JointLaw>& law,
                   bool plane, bool plane_stress, double thickness, int stress_iterations)
    : plane_(plane), plane_stress_(plane_stress), thickness_(thickness), iterations_(stress_iterations) {
  auto spec = std::make_shared<BlocksSpec>();
  spec->laws.initial = law, spec->stress_iterations = stress_iterations;
  spec_ = spec;
  for (std::size_t k = 0; k < cells.shapes.size(); ++k) add_body(cells.shapes[k], nuclei[k], 1.0);
  blocks_ = bodies.size();
  for (const BlockFacet& f : cells.facets)
    if (f.b != BlockFacet::none) add_facet(f, *law, false);
  finish(1.0);
}

Assembly::Assembly(std::shared_ptr<const BlocksSpec> spec, int dimension, bool plane_stress, const Vec3& gravity,
                   double max_step)
    : spec_(std::move(spec)),
      plane_(dimension == 2),
      plane_stress_(plane_stress),
      thickness_(spec_->thickness),
      damping_(spec_->local_damping),
      iterations_(spec_->stress_iterations),
      gravity_(gravity) {
  std::vector<BlockFacet> facets;
  std::vector<std::int64_t> group;
  double size = 0;
  for (std::size_t g = 0; g < spec_->groups.size(); ++g) {
    const BlockGroup& what = spec_->groups[g];
    try {
      const auto first = static_cast<std::int64_t>(bodies.size());
      if (what.shape == BlockGroup::Shape::voronoi) {
        Tessellation cells = voronoi(what.points, what.low, what.high, plane_, thickness_);
        for (std::size_t k = 0; k < cells.shapes.size(); ++k) add_body(cells.shapes[k], what.points[k], what.density);
        for (BlockFacet& f : cells.facets) {
          f.a += first;
          if (f.b != BlockFacet::none) f.b += first;
          facets.push_back(std::move(f));
        }
      } else {
        const BlockShape shape =
            what.shape == BlockGroup::Shape::ball
                ? ball_block(what.points.front(), what.radius)
                : rotated(what.shape == BlockGroup::Shape::polygon ? polygon_block(what.points)
                                                                   : brick_block(what.low, what.high, plane_),
                          what.angle);
        add_body(shape, mass_properties(shape, plane_, thickness_).centre, what.density);
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
          BlockFacet facet;
          facet.a = first, facet.corners = shape.face(f);
          facet.geometry = face_geometry(facet.corners, plane_, thickness_);
          facets.push_back(std::move(facet));
        }
      }
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      fail(what.origin, error.what());
    }
    group.resize(bodies.size(), static_cast<std::int64_t>(g));
    for (std::size_t k = 0; k < bodies.size(); ++k)
      if (bodies[k].group < 0) {
        bodies[k].group = static_cast<std::int32_t>(g);
        motion[k].v = what.velocity, motion[k].w = what.spin;
      }
  }
  blocks_ = bodies.size();
  if (blocks_ == 0) fail(spec_->origin, "<Blocks> has no block");
  for (const BlockShape& s : shapes)
    for (const Vec3& x : s.corners) size = std::max(size, x.norm() + s.radius);
  list_later_laws();
  join_faces(group, plane_, thickness_, 1e-6 * size, facets);
  if (!plane_)
    for (const BlockShape& s : shapes) edges_.push_back(edges_of(s));
  refuse_overlaps(1e-6 * size);

  std::vector<bool> used(spec_->joints.size(), false);
  std::vector<BlockFacet> free;
  std::vector<std::pair<std::size_t, const BlockFacet*>> by_joint;  // spec_->joints.size(): the common law
  for (const BlockFacet& f : facets) {
    if (f.b == BlockFacet::none) {
      free.push_back(f);
      continue;
    }
    const std::size_t k = spec_->rule(pairing(static_cast<std::uint32_t>(f.a), static_cast<std::uint32_t>(f.b),
                                              ContactKind::facet, f.geometry.centre, f.geometry.normal, false),
                                      plane_);
    if (k < used.size()) used[k] = true;
    if (!spec_->laws_of(k).initial)
      fail(spec_->origin, "blocks touch at " + place_text(f.geometry.centre) +
                              ", where no <Joint> fits and <Blocks> has no 'lawname' for the rest");
    by_joint.emplace_back(k, &f);
  }
  std::stable_sort(by_joint.begin(), by_joint.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [k, f] : by_joint) {
    const auto group_of = [&](std::int64_t body) { return bodies[static_cast<std::size_t>(body)].group; };
    add_facet(*f, *spec_->laws_of(k).initial_of({group_of(f->a), group_of(f->b)}),
              k < spec_->joints.size() ? spec_->joints[k].corners : spec_->corners);
  }
  join_balls(used);
  for (std::size_t k = 0; k < used.size(); ++k)
    if (!used[k] && !spec_->joints[k].later)
      fail(spec_->joints[k].origin,
           "no two blocks touch that fulfil this rule: the middles of common faces must lie in its shapes, and faces "
           "touch if they are at most " +
               short_number(1e-6 * size) + " apart");
  add_holds_and_loads();
  add_platens(free);
  add_pressures(free);
  permanent_ = contacts.size();
  if (!later_laws_.empty()) find_pairs(0.0);
  finish(max_step);
}

void Assembly::refuse_overlaps(double tolerance) const {
  each_near_pair(bounds(0.0), [&](std::uint32_t a, std::uint32_t b) {
    if (bodies[a].group == bodies[b].group) return;
    const double gap = gap_between(a, b, -tolerance);
    if (!(gap < -tolerance)) return;
    const auto& first = spec_->groups[static_cast<std::size_t>(bodies[a].group)];
    const auto& second = spec_->groups[static_cast<std::size_t>(bodies[b].group)];
    fail(second.origin, "this block" + (second.name.empty() ? "" : ", '" + second.name + "',") +
                            " overlaps the one at " + place_text(motion[a].x) +
                            (first.name.empty() ? "" : ", '" + first.name + "',") + " by " + short_number(-gap));
  });
}

void Assembly::add_holds_and_loads() {
  const auto chosen = [&](const auto& by, std::size_t k) {
    const auto& named = by.groups;
    return (named.empty() || std::find(named.begin(), named.end(), bodies[k].group) != named.end()) &&
           (!by.where || by.where->contains(motion[k].x));
  };
  const auto none = [&](const auto& by) {
    fail(by.origin, by.groups.empty() ? "no block has its centre in this shape"
                                      : "none of these blocks has its centre in this shape");
  };
  for (std::size_t h = 0; h < spec_->holds.size(); ++h) {
    const BlockHold& hold = spec_->holds[h];
    ScatterTerms prescribed;
    for (std::size_t d = 0; d < 3; ++d) {
      if (hold.velocity[d]) prescribed.of[d] = &*hold.velocity[d], prescribed.held |= 1 << d;
      if (hold.spin[d]) prescribed.of[d + 3] = &*hold.spin[d], prescribed.held |= 8 << d;
    }
    bool found = false;
    for (std::size_t k = 0; k < blocks_; ++k) {
      if (!chosen(hold, k)) continue;
      found = true;
      if (bodies[k].hold >= 0)
        fail(hold.origin, "the block at " + place_text(motion[k].x) + " is held already by another element");
      bodies[k].hold = static_cast<std::int32_t>(h), bodies[k].held |= prescribed.held;
      bodies[k].stress_weight = 0;  // the forces that hold it are not among those on its faces
    }
    if (!found) none(hold);
    prescribed_motions_.push_back(prescribed);
  }
  for (std::size_t l = 0; l < spec_->loads.size(); ++l) {
    const std::size_t before = loaded_.size();
    for (std::size_t k = 0; k < blocks_; ++k)
      if (chosen(spec_->loads[l], k))
        loaded_.emplace_back(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(l));
    if (loaded_.size() == before) none(spec_->loads[l]);
  }
  std::sort(loaded_.begin(), loaded_.end());
}

namespace {

std::vector<const BlockFacet*> selected(const std::vector<BlockFacet>& free, const Region& where,
                                        const Origin& origin) {
  std::vector<const BlockFacet*> out;
  for (const BlockFacet& f : free)
    if (where.contains(f.geometry.centre)) {
      if (f.covered)
        fail(origin, "the face around " + place_text(f.geometry.centre) +
                         " is covered in part by another block; cut its block so that the rest is a face of its own");
      out.push_back(&f);
    }
  if (out.empty()) fail(origin, "no free face of a block has its middle in this shape");
  return out;
}

}  // namespace

std::shared_ptr<const JointLaw> Assembly::law_of_platen(const BlocksSpec& spec, std::size_t platen) {
  return std::make_shared<PlatenLaw>(spec.laws.initial, spec.platens[platen].modulus, spec.platens[platen].rough);
}

JointSite Assembly::site_of(std::size_t contact) const {
  const BlockContact& c = contacts[contact];
  const Joint& j = joints[contact];
  JointSite site;
  site.area = j.area, site.gap = j.gap, site.plane = plane_, site.thickness = thickness_;
  if (c.b >= blocks_) {
    site.distance = c.na.dot(c.pa - bodies[c.a].reference);
  } else {
    const auto reference = [&](std::uint32_t k) { return Vec3(motion[k].x + motion[k].R * bodies[k].reference); };
    const Vec3 by = shift.empty() ? Vec3(Vec3::Zero()) : shift[contact];
    site.distance = (reference(c.b) + by - reference(c.a)).norm();
  }
  const auto joins_the_same = [&](std::size_t other) {
    return other < contacts.size() && contacts[other].a == c.a && contacts[other].b == c.b;
  };
  site.part_of_face = joins_the_same(contact - 1) || joins_the_same(contact + 1);
  return site;
}

void Assembly::add_platens(const std::vector<BlockFacet>& free) {
  for (const BlockPlaten& platen : spec_->platens) {
    const auto faces = selected(free, *platen.where, platen.origin);
    if (!(platen.modulus > 0) && !spec_->laws.initial)
      fail(platen.origin, "a platen needs 'E', or a 'law' of <Blocks> to be as stiff as");
    own_laws_.push_back(law_of_platen(*spec_, own_laws_.size()));
    BlockBody body;
    body.held = 63, body.hold = static_cast<std::int32_t>(prescribed_motions_.size());
    ScatterTerms prescribed;
    for (std::size_t d = 0; d < 3; ++d)
      if (platen.velocity[d]) prescribed.of[d] = &*platen.velocity[d];
    prescribed_motions_.push_back(prescribed);
    BlockMotion at;
    double area = 0;
    for (const BlockFacet* f : faces) at.x += f->geometry.area * f->geometry.centre, area += f->geometry.area;
    at.x /= area, body.start = at.x;
    motion.push_back(at), orientation.push_back({1, 0, 0, 0}), bodies.push_back(body), shapes.emplace_back();
    platen_area_.push_back(area);
    for (const BlockFacet* face : faces) {
      BlockFacet f = *face;
      f.b = static_cast<std::int64_t>(bodies.size()) - 1;
      add_facet(f, *own_laws_.back(), false);
    }
  }
}

void Assembly::add_pressures(const std::vector<BlockFacet>& free) {
  for (std::size_t p = 0; p < spec_->pressures.size(); ++p)
    for (const BlockFacet* f : selected(free, *spec_->pressures[p].where, spec_->pressures[p].origin)) {
      const auto k = static_cast<std::size_t>(f->a);
      pressed.push_back({static_cast<std::uint32_t>(k), f->geometry.centre - motion[k].x, f->geometry.normal,
                         f->geometry.area, static_cast<std::uint32_t>(p)});
    }
}

void Assembly::finish(double max_step) {
  connect();
  double nu = 0;
  for (const ContactGroup& g : groups) nu = std::max(nu, g.law->poisson());
  poisson_ = std::any_of(groups.begin(), groups.end(), [](const ContactGroup& g) { return g.law->poisson() != 0; });
  auto around = stiffness_around();
  if (!later_laws_.empty()) expect_neighbours(around);
  if (spec_->quasi_static) choose_masses(around, max_step, nu);
  set_step(around, max_step, nu);
  for (BlockContact& c : contacts) c.mass = mass_between(c.a, c.b);

  if (!reach_.empty()) store_marks(checked_at_);
  forces.assign(bodies.size(), {}), work.assign(bodies.size(), {}), stress.assign(bodies.size(), Mat3::Zero());
  contact_forces.assign(contacts.size(), {}), dashpot_work.assign(contacts.size(), 0.0);
  failure_mode.assign(contacts.size(), 0.0);
  prescribed_now_.assign(prescribed_motions_.size(), {});
  pressed_force_.assign(pressed.size(), {}), pressure_now_.assign(spec_->pressures.size(), 0.0);
  if (iterations_ > 0 && poisson_) kept_increments_.resize(contacts.size()), predicted_.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const BlockContact& c = contacts[k];
    const Vec3 by = shift.empty() ? Vec3(Vec3::Zero()) : shift[k];
    contact_forces[k].at = 0.5 * (motion[c.a].x + motion[c.a].R * c.pa + motion[c.b].x + motion[c.b].R * c.pb + by);
    set_force(k);
  }
  apply_pressures();
  for (std::size_t k = 0; k < bodies.size(); ++k) sum_forces(k, 0.0);
}

void Assembly::renew_forces() {
  for (std::size_t k = 0; k < contacts.size(); ++k) set_force(k);
  apply_pressures();
  for (std::size_t k = 0; k < bodies.size(); ++k) sum_forces(k, 0.0);
}

// Divides the groups into batches, and lists the contacts of every body in their order.
void Assembly::connect() {
  batches_.clear();
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t k = groups[g].begin; k < groups[g].end; k += batch_size)
      batches_.push_back({g, k, std::min(k + batch_size, groups[g].end)});
  batch_events_.assign(batches_.size(), {});
  first_.assign(bodies.size() + 1, 0);
  for (const BlockContact& c : contacts) ++first_[c.a + 1], ++first_[c.b + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  entries_.resize(2 * contacts.size());
  std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < contacts.size(); ++k)
    entries_[at[contacts[k].a]++] = 2 * k, entries_[at[contacts[k].b]++] = 2 * k + 1;
  first_pressed_.clear(), pressed_of_.resize(pressed.size());
  if (pressed.empty()) return;
  first_pressed_.assign(bodies.size() + 1, 0);
  for (const PressedFace& p : pressed) ++first_pressed_[p.body + 1];
  std::partial_sum(first_pressed_.begin(), first_pressed_.end(), first_pressed_.begin());
  std::vector<std::uint32_t> next(first_pressed_.begin(), first_pressed_.end() - 1);
  for (std::uint32_t k = 0; k < pressed.size(); ++k) pressed_of_[next[pressed[k].body]++] = k;
}

}  // namespace tribo
