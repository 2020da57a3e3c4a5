// SPDX-License-Identifier: MIT
#include "model/block_quantities.hpp"

#include "model/find_name.hpp"

namespace tribo {

const std::vector<BlockQuantityInfo>& block_quantities() {
  using Of = BlockQuantityInfo::Of;
  using S = BlockHistorySource;
  static const std::vector<BlockQuantityInfo> list{
      {"forcex", "force", "force of the blocks on a platen, x", Of::platen,
       [](const S& s) { return s.platen_force()[0]; }},
      {"forcey", "force", "force of the blocks on a platen, y", Of::platen,
       [](const S& s) { return s.platen_force()[1]; }},
      {"forcez", "force", "force of the blocks on a platen, z", Of::platen,
       [](const S& s) { return s.platen_force()[2]; }},
      {"dispx", "length", "displacement of a platen, x", Of::platen,
       [](const S& s) { return s.platen_displacement()[0]; }},
      {"dispy", "length", "displacement of a platen, y", Of::platen,
       [](const S& s) { return s.platen_displacement()[1]; }},
      {"dispz", "length", "displacement of a platen, z", Of::platen,
       [](const S& s) { return s.platen_displacement()[2]; }},
      {"area", "length^2", "area of the faces attached to a platen", Of::platen,
       [](const S& s) { return s.platen_area(); }},
      {"dispx", "length", "displacement of a block's centre, or the mean of its group, x", Of::block,
       [](const S& s) { return s.displacement(0); }},
      {"dispy", "length", "the same, y", Of::block, [](const S& s) { return s.displacement(1); }},
      {"dispz", "length", "the same, z", Of::block, [](const S& s) { return s.displacement(2); }},
      {"velx", "velocity", "velocity of a block, or the mean of its group, x", Of::block,
       [](const S& s) { return s.velocity(0); }},
      {"vely", "velocity", "the same, y", Of::block, [](const S& s) { return s.velocity(1); }},
      {"velz", "velocity", "the same, z", Of::block, [](const S& s) { return s.velocity(2); }},
      {"turnx", "rad", "rotation vector of a block, or the mean of its group, x", Of::block,
       [](const S& s) { return s.rotation(0); }},
      {"turny", "rad", "the same, y", Of::block, [](const S& s) { return s.rotation(1); }},
      {"turnz", "rad", "the same, z", Of::block, [](const S& s) { return s.rotation(2); }},
      {"spinx", "1/time", "angular velocity of a block, or the mean of its group, x", Of::block,
       [](const S& s) { return s.spin(0); }},
      {"spiny", "1/time", "the same, y", Of::block, [](const S& s) { return s.spin(1); }},
      {"spinz", "1/time", "the same, z", Of::block, [](const S& s) { return s.spin(2); }},
      {"forcex", "force", "force on a block, or the sum of its group, without gravity and damping: the reaction, x",
       Of::block, [](const S& s) { return s.force(0); }},
      {"forcey", "force", "the same, y", Of::block, [](const S& s) { return s.force(1); }},
      {"forcez", "force", "the same, z", Of::block, [](const S& s) { return s.force(2); }},
      {"sxx", "stress", "volume average of the stress of the blocks, xx", Of::run,
       [](const S& s) { return s.mean_stress()(0, 0); }},
      {"syy", "stress", "the same, yy", Of::run, [](const S& s) { return s.mean_stress()(1, 1); }},
      {"szz", "stress", "the same, zz", Of::run, [](const S& s) { return s.mean_stress()(2, 2); }},
      {"sxy", "stress", "the same, xy", Of::run, [](const S& s) { return s.mean_stress()(0, 1); }},
      {"sxz", "stress", "the same, xz", Of::run, [](const S& s) { return s.mean_stress()(0, 2); }},
      {"syz", "stress", "the same, yz", Of::run, [](const S& s) { return s.mean_stress()(1, 2); }},
      {"exx", "-", "strain of the least-squares fit to the displacements of all blocks, xx", Of::run,
       [](const S& s) { return s.mean_strain()(0, 0); }},
      {"eyy", "-", "the same, yy", Of::run, [](const S& s) { return s.mean_strain()(1, 1); }},
      {"ezz", "-", "the same, zz", Of::run, [](const S& s) { return s.mean_strain()(2, 2); }},
      {"exy", "-", "the same, xy", Of::run, [](const S& s) { return s.mean_strain()(0, 1); }},
      {"exz", "-", "the same, xz", Of::run, [](const S& s) { return s.mean_strain()(0, 2); }},
      {"eyz", "-", "the same, yz", Of::run, [](const S& s) { return s.mean_strain()(1, 2); }},
      {"bonds", "-", "number of intact bonds", Of::run, [](const S& s) { return static_cast<double>(s.bonds()); }},
      {"broken in tension", "-", "number of bonds broken in tension so far", Of::run,
       [](const S& s) { return static_cast<double>(s.broken_in_tension()); }},
      {"broken in shear", "-", "number of bonds broken in shear so far", Of::run,
       [](const S& s) { return static_cast<double>(s.broken_in_shear()); }},
      {"contacts", "-", "number of contacts that carry a force", Of::run,
       [](const S& s) { return static_cast<double>(s.active_contacts()); }},
      {"unbalanced", "-",
       "largest resultant force on a free block divided by the mean contact force; 1 if no contact carries a force",
       Of::run, [](const S& s) { return s.unbalanced(); }},
      {"Kinetic Energy", "energy", "", Of::run, [](const S& s) { return s.kinetic_energy(); }},
      {"Strain Energy", "energy", "energy stored in the contacts", Of::run,
       [](const S& s) { return s.strain_energy(); }},
      {"Slip Energy", "energy", "energy dissipated by friction in the contacts", Of::run,
       [](const S& s) { return s.slip_energy(); }},
      {"Dashpot Energy", "energy", "energy dissipated by the dashpots of the contacts", Of::run,
       [](const S& s) { return s.dashpot_energy(); }},
      {"Released Energy", "energy", "energy released by brittle failure, dilation and changes of pressure", Of::run,
       [](const S& s) { return s.released_energy(); }},
      {"Step Number", "-", "", Of::run, [](const S& s) { return static_cast<double>(s.step()); }},
      {"Time Step", "time", "", Of::run, [](const S& s) { return s.step_size(); }},
  };
  return list;
}

const BlockQuantityInfo* find_block_quantity(std::string_view name, BlockQuantityInfo::Of of) {
  for (const auto& q : block_quantities())
    if (q.of == of && same_name(q.name, name)) return &q;
  return nullptr;
}

}  // namespace tribo
