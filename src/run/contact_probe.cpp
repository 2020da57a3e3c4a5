// SPDX-License-Identifier: MIT
#include "run/contact_probe.hpp"

#include "blocks/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace tribo {
namespace {

template <int Dim>
class ContactProbe {
 public:
  ContactProbe(const Model& model, System<Dim>& system) : model_(model), system_(system) {
    for (auto* list : {&system.bodies, &system.rigids})
      for (auto& body : *list)
        if (body.field != Body<Dim>::no_field) bodies_.push_back(&body);
    for (const auto* body : bodies_) occupy(*body, 1);
  }

  bool any_neighbours() const {
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto* body) { return has_neighbour(*body); });
  }

  double bring() {
    double in_contact = 0.0;
    int counted = 0;
    for (auto* body : bodies_)
      if (const double time = has_neighbour(*body) ? 0.0 : bring(*body); time < model_.time.end) {
        in_contact += 1 - time / model_.time.end;
        ++counted;
      }
    if (counted == 0) return 0.0;
    system_.sorted = false;
    return in_contact / counted;
  }

 private:
  std::int64_t cell_of(const Vec<Dim>& x) const {
    std::int64_t key = 0;
    for (int d = 0; d < Dim; ++d) {
      const double cell = std::floor((x[d] - system_.lattice.origin[d]) / system_.lattice.spacing[d]);
      key = key * (std::int64_t{1} << 20) + static_cast<std::int64_t>(cell);
    }
    return key;
  }

  void occupy(const Body<Dim>& body, int change) {
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      cells_[cell_of(body.particles.position(i))][body.field] += change;
  }

  // Some of the particles of a large body stand for all.
  static std::size_t stride(const Body<Dim>& body) { return 1 + body.particles.size() / 20000; }

  bool meets(const Body<Dim>& body, const Vec<Dim>& shift) const {
    for (std::size_t i = 0; i < body.particles.size(); i += stride(body)) {
      const auto found = cells_.find(cell_of(body.particles.position(i) + shift));
      if (found == cells_.end()) continue;
      for (const auto& [field, count] : found->second)
        if (field != body.field && count > 0) return true;
    }
    return false;
  }

  // Whether a body is within a cell of another one.
  bool has_neighbour(const Body<Dim>& body) const {
    Index<Dim> low, high;
    low.fill(-1), high.fill(1);
    bool found = false;
    each_in_box<Dim>(low, high, [&](const Index<Dim>& n) {
      Vec<Dim> shift;
      for (int d = 0; d < Dim; ++d) shift[d] = n[static_cast<std::size_t>(d)] * system_.lattice.spacing[d];
      found = found || meets(body, shift);
    });
    return found;
  }

  bool stays_inside(const Body<Dim>& body, const Vec<Dim>& shift) const {
    for (std::size_t i = 0; i < body.particles.size(); i += stride(body)) {
      const Vec<Dim> x = body.particles.position(i) + shift;
      if (!(x.array() >= system_.lattice.low.array()).all() || !(x.array() <= system_.lattice.high.array()).all())
        return false;
    }
    return true;
  }

  Vec<Dim> velocity_of(const Body<Dim>& body) const {
    if (body.block >= 0) return system_.blocks->motion[static_cast<std::size_t>(body.block)].v.template head<Dim>();
    Vec<Dim> mean = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < body.particles.size(); ++i) mean += body.particles.velocity(i);
    return mean / std::max<double>(1, static_cast<double>(body.particles.size()));
  }

  // Time at which the body meets another one; infinite if it does not. It is moved there.
  double bring(Body<Dim>& body) {
    const Vec<Dim> v = velocity_of(body);
    const bool falls = body.block >= 0 ? (system_.blocks->bodies[static_cast<std::size_t>(body.block)].held & 7) == 0
                                       : !body.law->rigid();
    const Vec<Dim> g = falls ? Vec<Dim>(model_.body_force.gravity.template head<Dim>()) : Vec<Dim>(Vec<Dim>::Zero());
    const double never = std::numeric_limits<double>::infinity();
    if (v.isZero() && g.isZero()) return never;
    const double h = system_.lattice.smallest_spacing();
    double time = 0.0;
    for (Vec<Dim> shift = Vec<Dim>::Zero(); time < model_.time.end;) {
      // the next half cell along the path
      const double speed = (v + time * g).norm(), a = g.norm();
      time += std::min(a > 0 ? std::sqrt(h / a) : never, speed > 0 ? 0.5 * h / speed : never);
      const Vec<Dim> next = time * v + 0.5 * time * time * g;
      if (!stays_inside(body, next)) return never;
      if (meets(body, next)) {
        place(body, shift, v + time * g);
        return time;
      }
      shift = next;
    }
    return never;
  }

  void place(Body<Dim>& body, const Vec<Dim>& shift, const Vec<Dim>& velocity) {
    occupy(body, -1);
    const auto x = body.particles.x(), v = body.particles.v();
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d][i] += shift[static_cast<Eigen::Index>(d)];
        v[d][i] = velocity[static_cast<Eigen::Index>(d)];
      }
    if (body.block >= 0) {
      BlockMotion& motion = system_.blocks->motion[static_cast<std::size_t>(body.block)];
      motion.x.template head<Dim>() += shift, motion.v.template head<Dim>() = velocity;
    }
    occupy(body, 1);
  }

  const Model& model_;
  System<Dim>& system_;
  std::vector<Body<Dim>*> bodies_;
  std::unordered_map<std::int64_t, std::unordered_map<std::size_t, int>> cells_;  // particles by cell and field
};

}  // namespace

template <int Dim>
bool has_neighbours(const Model& model, System<Dim>& system) {
  return ContactProbe<Dim>(model, system).any_neighbours();
}

template <int Dim>
double bring_into_contact(const Model& model, System<Dim>& system) {
  return ContactProbe<Dim>(model, system).bring();
}

template <int Dim>
void press_bodies(System<Dim>& system, double speed) {
  const auto middle_of = [](const Body<Dim>& body) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < body.particles.size(); ++i) sum += body.particles.position(i);
    return Vec<Dim>(sum / std::max<double>(1, static_cast<double>(body.particles.size())));
  };
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (const auto* list : {&system.bodies, &system.rigids})
    for (const auto& body : *list)
      middle += middle_of(body) / static_cast<double>(system.bodies.size() + system.rigids.size());
  for (auto& body : system.bodies) {
    const Vec<Dim> way = middle - middle_of(body);
    if (!(way.norm() > 0)) continue;
    const auto v = body.particles.v();
    for (std::size_t d = 0; d < Dim; ++d)
      for (std::size_t i = 0; i < body.particles.size(); ++i)
        v[d][i] += speed * way[static_cast<Eigen::Index>(d)] / way.norm();
  }
}

template bool has_neighbours<2>(const Model&, System<2>&);
template bool has_neighbours<3>(const Model&, System<3>&);
template double bring_into_contact<2>(const Model&, System<2>&);
template double bring_into_contact<3>(const Model&, System<3>&);
template void press_bodies<2>(System<2>&, double);
template void press_bodies<3>(System<3>&, double);

}  // namespace tribo
