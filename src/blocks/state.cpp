// SPDX-License-Identifier: MIT
/// What of an assembly changes with time, for checkpoints.

#include "blocks/assembly.hpp"

namespace tribo {

void Assembly::each_column(const Column& f) {
  std::vector<double> column;
  const auto pass = [&](const char* name, auto&& each) {
    column.clear();
    each([&](double& v) { column.push_back(v); });
    f(name, column);
    std::size_t k = 0;
    each([&](double& v) { v = column[k++]; });
  };
  const auto vec = [](auto& g, auto& m) {
    for (double* v = m.data(); v != m.data() + m.size(); ++v) g(*v);
  };
  pass("blocks.motion", [&](auto&& g) {
    for (std::size_t k = 0; k < motion.size(); ++k) {
      vec(g, motion[k].x), vec(g, motion[k].v), vec(g, motion[k].w), vec(g, motion[k].R);
      for (double& q : turn[k]) g(q);
    }
  });
  pass("blocks.forces", [&](auto&& g) {
    for (auto& b : forces)
      for (Vec3* v : {&b.all, &b.moment, &b.outer, &b.outer_moment, &b.damping, &b.damping_moment}) vec(g, *v);
    for (auto& b : work) g(b.outer), g(b.boundary), g(b.damped), g(b.stepping);
    for (auto& b : pushes) vec(g, b.force), vec(g, b.moment), vec(g, b.spread);
    for (auto& s : stress) vec(g, s);
  });
  pass("contacts.joints", [&](auto&& g) {
    for (auto& j : joints) each_number(j, g);
    for (double& v : dashpot_work) g(v);
    for (double& v : broke) g(v);
  });
  pass("contacts.places", [&](auto&& g) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      for (Vec3* v : {&contacts[k].axes.n, &contacts[k].axes.s, &contacts[k].axes.t, &given[k].at, &given[k].elastic,
                      &given[k].all, &given[k].moment})
        vec(g, *v);
      if (!shift.empty()) vec(g, shift[k]);
    }
    for (auto& p : pressed_force_) vec(g, p.at), vec(g, p.all);
  });
  pass("blocks.found", [&](auto&& g) {
    for (auto* list : {&found_at_, &checked_at_})
      for (Vec3& x : *list) vec(g, x);
    for (double* v : {&gone_.slip, &gone_.dashpot, &gone_.released}) g(*v);
  });
  pass("blocks.counters", [&](auto&& g) {
    double steps = static_cast<double>(step), tension = static_cast<double>(broken[0]),
           shear = static_cast<double>(broken[1]);
    for (double* v : {&time, &time_rest_, &last_step_, &steps, &tension, &shear}) g(*v);
    step = static_cast<std::int64_t>(steps);
    broken = {static_cast<std::int64_t>(tension), static_cast<std::int64_t>(shear)};
  });
}

}  // namespace tribo
