// SPDX-License-Identifier: MIT
#include "python/lent_columns.hpp"

#include <algorithm>

namespace tribo::python {
namespace {

py::array view_of(const py::array& whole, bool writable) {
  py::array view(whole.dtype(), {whole.shape(0)}, {whole.strides(0)}, whole.data(), whole);
  if (!writable) view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace

py::array LentColumns::lend(AlignedVector<double>& column, std::size_t count, bool writable,
                            const std::shared_ptr<void>& owner) {
  for (const Lent& lent : lent_)
    if (lent.memory->column == &column) return view_of(lent.array, writable);
  auto memory = std::make_unique<Memory>();
  memory->column = &column, memory->owner = owner;
  Memory* const raw = memory.get();
  const py::capsule keeper(memory.release(), [](void* held) { delete static_cast<Memory*>(held); });
  const py::array array(py::dtype::of<double>(), {static_cast<py::ssize_t>(count)}, {}, column.data(), keeper);
  lent_.push_back({raw, array});
  return view_of(array, writable);
}

bool LentColumns::take_back() {
  bool moved = false;
  for (Lent& lent : lent_) {
    if (lent.array.ref_count() == 1) continue;  // no view of it is left
    Memory& memory = *lent.memory;
    memory.kept = std::move(*memory.column);
    *memory.column = memory.kept;
    memory.column = nullptr, memory.owner.reset();
    moved = true;
  }
  lent_.clear();
  return moved;
}

}  // namespace tribo::python
