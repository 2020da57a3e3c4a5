// SPDX-License-Identifier: MIT
/// What the quantities of history.csv are computed from in models of blocks.
#pragma once

#include "blocks/assembly.hpp"
#include "model/block_quantities.hpp"

namespace tribo {

class AssemblyHistorySource final : public BlockHistorySource {
 public:
  /// `dt`: present step [time]. The others must outlive the source.
  AssemblyHistorySource(const Assembly& blocks, const BlockHistory& history, double dt)
      : blocks_(blocks), history_(history), dt_(dt) {}

  Vec3 platen_force() const override { return blocks_.platen_force(platen()); }
  Vec3 platen_displacement() const override { return blocks_.platen_displacement(platen()); }
  double platen_area() const override { return blocks_.platen_area(platen()); }

  double displacement(int axis) const override {
    return mean([&](std::size_t k) { return blocks_.motion[k].x[axis] - blocks_.bodies[k].start[axis]; });
  }
  double velocity(int axis) const override {
    return mean([&](std::size_t k) { return blocks_.motion[k].v[axis]; });
  }
  double rotation(int axis) const override {
    return mean([&](std::size_t k) { return blocks_.rotation(k)[axis]; });
  }
  double spin(int axis) const override {
    return mean([&](std::size_t k) { return blocks_.motion[k].w[axis]; });
  }
  double force(int axis) const override {
    return sum([&](std::size_t k) { return blocks_.contact_force(k)[axis]; }).total;
  }

  Mat3 mean_stress() const override { return blocks_.mean_stress(); }
  Mat3 mean_strain() const override { return blocks_.mean_strain(); }
  std::int64_t bonds() const override { return static_cast<std::int64_t>(blocks_.bonds()); }
  std::int64_t broken_in_tension() const override { return blocks_.broken[0]; }
  std::int64_t broken_in_shear() const override { return blocks_.broken[1]; }
  std::int64_t active_contacts() const override { return static_cast<std::int64_t>(blocks_.active()); }
  double unbalanced() const override { return blocks_.unbalanced(); }
  double kinetic_energy() const override { return blocks_.ledger().kinetic; }
  double strain_energy() const override { return blocks_.ledger().strain; }
  double slip_energy() const override { return blocks_.ledger().slip; }
  double dashpot_energy() const override { return blocks_.ledger().dashpot; }
  double released_energy() const override { return blocks_.ledger().released; }
  std::int64_t step() const override { return blocks_.step; }
  double step_size() const override { return dt_; }

 private:
  struct Sum {
    double total = 0, count = 0;
  };
  std::size_t platen() const { return static_cast<std::size_t>(history_.platen); }
  // Over the blocks of the group that the history refers to.
  template <class F>
  Sum sum(F&& value) const {
    Sum out;
    for (std::size_t k = 0; k < blocks_.block_count(); ++k)
      if (blocks_.bodies[k].group == history_.group) out.count += 1, out.total += value(k);
    return out;
  }
  template <class F>
  double mean(F&& value) const {
    const Sum s = sum(value);
    return s.count == 0 ? s.total : s.total / s.count;
  }

  const Assembly& blocks_;
  const BlockHistory& history_;
  double dt_;
};

}  // namespace tribo
