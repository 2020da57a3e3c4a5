// SPDX-License-Identifier: MIT
#include "solver/joints/joint_build.hpp"

#include "solver/joints/common_faces.hpp"
#include "solver/joints/interface_faces.hpp"

#include <numbers>

namespace tribo {
namespace {

template <int Dim>
Body<Dim>& body_of(const Model& model, System<Dim>& system, int material, const Origin& origin) {
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& body : *list)
      if (body.material == material && body.field != Body<Dim>::no_field) return body;
  throw InputError(origin, "a joint law needs bodies of both materials; there is none of '" +
                               model.materials[static_cast<std::size_t>(material)].name + "'");
}

}  // namespace

template <int Dim>
void add_joint(const std::vector<CommonFacePiece<Dim>>& pieces, std::size_t first, std::size_t end, double thickness,
               JointSurface<Dim>& surface) {
  double area = 0.0;
  Vec<Dim> x = Vec<Dim>::Zero(), n = x;
  for (std::size_t k = first; k < end; ++k)
    area += pieces[k].area, x += pieces[k].area * pieces[k].x, n += pieces[k].area * pieces[k].n;
  Vec3 normal = Vec3::Zero();
  normal.template head<Dim>() = n.normalized();
  const JointAxes axes = JointAxes::of_normal(normal);
  JointSite site;
  site.area = area, site.plane = Dim == 2, site.thickness = thickness, site.number = surface.joints.size();
  Vec3 at = Vec3::Zero();
  at.template head<Dim>() = x / area;
  site.pressure = surface.law->pore_pressure(at, 0.0);
  const auto number = static_cast<std::uint32_t>(surface.joints.size());
  surface.x.push_back(x / area), surface.axes.push_back(axes), surface.joints.push_back(surface.law->start(site));
  for (std::size_t k = first; k < end; ++k) {
    Vec3 offset = Vec3::Zero();
    offset.template head<Dim>() = pieces[k].x - surface.x.back();
    const Tangent along = axes.tangent(offset);
    JointSample<Dim> sample;
    sample.joint[0] = number, sample.area_fraction[0] = pieces[k].area / area;
    sample.local = Vec3(offset.dot(axes.n), along.s, along.t);
    surface.samples.push_back(sample);
  }
}

template <int Dim>
void add_interfaces(const Model& model, System<Dim>& system) {
  for (const auto& [pair, joint] : model.contact.joints) {
    const auto& [first, second] = joint.materials;
    Body<Dim>&one = body_of(model, system, first, joint.origin), &two = body_of(model, system, second, joint.origin);
    const std::string both = "'" + one.name + "' and '" + two.name + "'";
    if (one.field == two.field)
      throw InputError(joint.origin, both + " share one velocity field; nothing acts between them");
    if (one.law->rigid() && two.law->rigid())
      throw InputError(joint.origin, both + " are rigid; a joint needs a body on one side that can move");
    auto pieces = common_face_pieces(model, system, one, two, std::numbers::pi / 6);
    smooth_steps(system.lattice, pieces);
    if (pieces.empty())
      throw InputError(joint.origin, both +
                                         " have no common face at the start, and a joint law acts only on faces in "
                                         "contact then: let the bodies end on "
                                         "the same line, without a gap or an overlap, or "
                                         "take a contact law");
    JointSurface<Dim> surface;
    surface.law = joint.law.get();
    surface.field = {one.field, two.field}, surface.material = {first, second};
    std::size_t points = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k)
      points += k == 0 || pieces[k].side_number != pieces[k - 1].side_number;
    if (const std::size_t given = joint.law->user_areas().size(); given > 1 && given != points)
      throw InputError(joint.origin, "<user_area> of the joint law has " + std::to_string(given) +
                                         " areas, but the common face of " + both + " has " + std::to_string(points) +
                                         " points");
    for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
      while (end < pieces.size() && pieces[end].side_number == pieces[begin].side_number) ++end;
      add_joint(pieces, begin, end, model.grid.thickness, surface);
    }
    surface.mass.fill(std::vector<double>(surface.samples.size(), 0.0));
    system.joints.push_back(std::move(surface));
  }
  add_imperfect_interfaces(model, system);
}

template void add_joint(const std::vector<CommonFacePiece<2>>&, std::size_t, std::size_t, double, JointSurface<2>&);
template void add_joint(const std::vector<CommonFacePiece<3>>&, std::size_t, std::size_t, double, JointSurface<3>&);
template void add_interfaces(const Model&, System<2>&);
template void add_interfaces(const Model&, System<3>&);

}  // namespace tribo
