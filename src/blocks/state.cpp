// SPDX-License-Identifier: MIT
/// Saving and restoring an assembly of blocks.

#include "blocks/assembly.hpp"

namespace tribo {

void archive(Archive& a, BlockMotion& motion) {
  auto& [x, v, w, R] = motion;
  a.version(1);
  a("x", x), a("v", v), a("w", w), a("R", R);
}

void archive(Archive& a, BlockForces& forces) {
  auto& [all, moment, outer, outer_moment, damping, damping_moment] = forces;
  a.version(1);
  a("all", all), a("moment", moment), a("outer", outer), a("outer_moment", outer_moment);
  a("damping", damping), a("damping_moment", damping_moment);
}

void archive(Archive& a, GridForce& grid_force) {
  auto& [force, moment, spread] = grid_force;
  a.version(1);
  a("force", force), a("moment", moment), a("spread", spread);
}

void archive(Archive& a, BlockWork& work) {
  auto& [outer, boundary, damped, stepping] = work;
  a.version(1);
  a("outer", outer), a("boundary", boundary), a("damped", damped), a("stepping", stepping);
}

// The axes, and what belongs to an overlap, carry something over from the last step. Points, normals and masses of
// faces are constant, those of other contacts are computed from the positions of the blocks. What a contact replaces
// matters within a step only.
void archive(Archive& a, BlockContact& contact) {
  auto& [body_a, body_b, pa, pb, na, nb, axes, mass, on_a, part, replaced, couple, face, set_back] = contact;
  a.version(2);
  a("axes", axes), a("couple", couple), a("face", face), a("set_back", set_back);
}

void archive(Archive& a, ContactForce& force) {
  auto& [at, elastic, all, moment] = force;
  a.version(1);
  a("at", at), a("elastic", elastic), a("all", all), a("moment", moment);
}

void archive(Archive& a, BlockLedger& ledger) {
  auto& [kinetic, strain, potential, slip, dashpot, damping, released, outer_work, boundary_work, stepping] = ledger;
  a.version(1);
  a("kinetic", kinetic), a("strain", strain), a("potential", potential);
  a("slip", slip), a("dashpot", dashpot), a("damping", damping), a("released", released);
  a("outer_work", outer_work), a("boundary_work", boundary_work), a("stepping", stepping);
}

// Refuses blocks, restored from a checkpoint, whose places are not possible.
static void check(const Assembly& blocks) {
  static constexpr double farthest = 1e100, tolerance = 1e-3;
  for (const BlockMotion& m : blocks.motion)
    if (!(m.x.norm() < farthest) || !((m.R.transpose() * m.R - Mat<3>::Identity()).cwiseAbs().maxCoeff() < tolerance))
      refuse_checkpoint("the place of a block");
  if (!blocks.is_finite()) refuse_checkpoint("the velocity of a block");
  for (const BlockContact& c : blocks.contacts) {
    if (c.set_back > 0 && c.face >= blocks.shapes[c.a].faces.size() + blocks.shapes[c.b].faces.size())
      refuse_checkpoint("a face of a block");
    if (!(c.set_back >= 0 && c.set_back < farthest && std::abs(c.couple) < farthest))
      refuse_checkpoint("the overlap of two blocks");
  }
  if (blocks.step < 0 || blocks.time < 0) refuse_checkpoint("its time or its number of steps is negative");
}

// The members from `spec` on that are not visited belong to the model, follow from the contacts, or serve within a
// step. Contacts that were found during the run exist again once their pairs of blocks are known.
void archive(Archive& a, Assembly& blocks) {
  auto& [motion, orientation, bodies, forces, work, shapes, contacts, joints, contact_forces, dashpot_work,
         failure_mode, shift, groups, outlines, pressed, grid_forces, stress, box_rate, time, step, broken, spec, plane,
         plane_stress, poisson, thickness, damping, critical_step, step_block, iterations, gravity, block_count,
         batches, batch_events, kept_increments, predicted, first, entries, first_pressed, pressed_of, pressed_force,
         pressure_now, loaded, motions, motions_now, own_laws, platen_area, events, balls, edges, later_laws, permanent,
         skin, reach, found_at, checked_at, removed, last_step, time_error] = blocks;
  a.version(2);
  std::vector<std::int64_t> pairs = blocks.found_pairs();
  a.resizable("found_pairs", pairs);
  if (a.reading()) blocks.set_found_pairs(pairs);
  a("motion", motion), a("orientation", orientation), a("forces", forces), a("work", work),
      a("grid_forces", grid_forces);
  a("stress", stress), a("pressed_force", pressed_force);
  a("joints", joints), a("dashpot_work", dashpot_work), a("failure_mode", failure_mode);
  a("contacts", contacts), a("contact_forces", contact_forces), a("shift", shift);
  a("found_at", found_at), a("checked_at", checked_at), a("removed", removed);
  a("time", time), a("time_error", time_error), a("last_step", last_step), a("step", step), a("broken", broken);
  if (a.reading()) check(blocks);
}

}  // namespace tribo
