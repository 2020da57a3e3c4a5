// SPDX-License-Identifier: MIT
/// Files of cracks and joints.

#include "output/number.hpp"
#include "run/joint_columns.hpp"
#include "run/result_folder.hpp"
#include "run/results.hpp"

#include <algorithm>

namespace tribo {
// All cracks in one file: points halfway between the faces.
template <int Dim>
void Results<Dim>::write_cracks(std::int64_t number) {
  Columns out;
  std::vector<std::uint32_t> cells;
  for (std::size_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    const auto first = static_cast<std::uint32_t>(out.size());
    for (std::size_t p = 0; p < crack.main_pieces; ++p)
      for (const auto point : crack.pieces[p]) cells.push_back(first + point);
    const auto normals = crack.normals();
    for (std::size_t k = 0; k < crack.main_points; ++k) {
      const Vec<Dim> apart = crack.opening(k);
      out.vector("position", crack.x[k]);
      out.integer("crack", static_cast<std::int64_t>(c) + 1);
      out.vector("opening", apart);
      out.number("gap", crack.gap[k]);
      out.number("slip", (apart - apart.dot(normals[k]) * normals[k]).norm());
      out.number("state", crack.status[k]);
      out.vector("traction", crack.traction[k]);
      if (!model_.fracture) continue;
      const auto tip =
          std::find_if(crack.tips.begin(), crack.tips.end(), [&](const CrackTip& t) { return t.point == k; });
      const bool is_tip = tip != crack.tips.end();
      out.number("J", is_tip ? tip->J : 0.0);
      out.number("K1", is_tip ? tip->K[0] : 0.0);
      out.number("K2", is_tip ? tip->K[1] : 0.0);
    }
  }
  const std::string file = "cracks/" + numbered(number, ".vtp");
  check_numbers(out.size(), out.positions(), out.fields());
  const auto all = std::make_shared<const Columns>(std::move(out));
  queue_.add(all->bytes(), [all, cells, path = folder_ / file, time = system_.time] {
    tribo::write_surface(path, all->size(), all->positions(), cells, Dim, all->fields(), time);
  });
  cracks_.add(system_.time, file, &queue_);
}

// All joints in one file. Tractions act on body 1, the lower face of a crack.
template <int Dim>
void Results<Dim>::write_joints(std::int64_t number) {
  Columns out;
  std::vector<const JointLaw*> laws;
  for (const auto& surface : system_.joints) laws.push_back(surface.law);
  const JointColumns columns(laws);
  for (std::size_t s = 0; s < system_.joints.size(); ++s) {
    const JointSurface<Dim>& surface = system_.joints[s];
    for (std::size_t k = 0; k < surface.joints.size(); ++k) {
      const Joint& j = surface.joints[k];
      out.vector("position", surface.x[k]);
      out.integer("joint", static_cast<std::int64_t>(s) + 1);
      out.integer("point", static_cast<std::int64_t>(k) + 1);
      out.integer("state", j.state);
      out.vector("normal", surface.axes[k].n);
      out.number("area", j.area);
      const double area = j.area > 0 ? j.area : std::numeric_limits<double>::infinity();  // no traction without area
      out.number("opening", j.opening);
      out.vector("shear", surface.axes[k].vector(j.shear));
      out.number("slip", j.slip);
      out.number("normal_stress", j.Fn / area);
      out.number("shear_stress", j.Fs.norm() / area);
      out.vector("traction", Vec3(-surface.force(k) / area));
      out.number("stored_energy", j.strain / area);
      out.number("lost_energy", (j.released() - j.slid - j.damped) / area);
      columns.add(out, *surface.law, j, surface.axes[k], -j.damped);
    }
  }
  const std::string file = "joints/" + numbered(number, ".vtp");
  check_numbers(out.size(), out.positions(), out.fields());
  const auto all = std::make_shared<const Columns>(std::move(out));
  queue_.add(all->bytes(), [all, path = folder_ / file, time = system_.time] {
    tribo::write_particles(path, all->size(), all->positions(), all->fields(), time);
  });
  joints_.add(system_.time, file, &queue_);
}

// Lengths are those of the drawn pieces.
template <int Dim>
void Results<Dim>::write_tips() {
  if (!tips_) return;
  for (std::size_t c = 0; c < system_.cracks.size(); ++c) {
    const Crack<Dim>& crack = system_.cracks[c];
    double length = 0.0;
    for (std::size_t p = 0; p < crack.main_pieces; ++p) length += Crack<Dim>::area(crack.corners(p)).norm();
    for (const CrackTip& tip : crack.tips) {
      const auto& x = crack.x[tip.point];
      std::vector<std::string> row;
      for (const double value : {c + 1.0, tip.end + 1.0, x[0], x[1], length, tip.J, tip.K[0], tip.K[1], tip.released})
        row.push_back(number_text(value));
      if (!tip.has_K) row[6].clear(), row[7].clear();
      tips_->add(system_.time, row);
    }
  }
}

template <int Dim>
void Results<Dim>::write_events() {
  if (blocks) blocks->write_events();
  for (const PlacedEvent& e : stepper_.joints().take_events()) {
    const auto text = [](double x) { return number_text(x); };
    std::vector<std::string> row{std::to_string(e.surface + 1), std::to_string(e.event.contact + 1), text(e.x[0]),
                                 text(e.x[1]), text(e.x[2])};
    for (auto& value : joint_event_texts(e.event)) row.push_back(std::move(value));
    events_->add(e.time, row);
    breaks += e.event.kind == JointEvent::Kind::bond_break;
  }
}

template void Results<2>::write_cracks(std::int64_t);
template void Results<3>::write_cracks(std::int64_t);
template void Results<2>::write_joints(std::int64_t);
template void Results<3>::write_joints(std::int64_t);
template void Results<2>::write_tips();
template void Results<3>::write_tips();
template void Results<2>::write_events();
template void Results<3>::write_events();

}  // namespace tribo
