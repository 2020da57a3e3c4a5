// SPDX-License-Identifier: MIT
#include "solver/transfer/transfer.hpp"

#include "solver/transfer/cpdi_transfer.hpp"
#include "solver/transfer/product_transfer.hpp"

#include <stdexcept>
#include <type_traits>

namespace tribo {

template <int Dim>
std::unique_ptr<Transfers<Dim>> make_transfers(const Scheme& scheme) {
  return with_kernel(scheme.kernel, [&](auto k) -> std::unique_ptr<Transfers<Dim>> {
    using K = decltype(k);
    if constexpr (std::is_same_v<K, CpdiCornerKernel>)
      return std::make_unique<CpdiTransfers<Dim>>(scheme.cpdi_limit);
    else
      return std::make_unique<ProductTransfers<Dim, K>>();
  });
}

template <int Dim>
std::unique_ptr<Transfers<Dim>> make_cell_transfers(const Scheme& scheme) {
  if (scheme.kernel == Kernel::linear) return std::make_unique<ProductTransfers<Dim, CellKernel<LinearKernel>>>();
  if (scheme.kernel == Kernel::cpdi) return std::make_unique<ProductTransfers<Dim, CellKernel<CubicKernel>>>();
  throw std::logic_error("means over cells are for shape functions that are linear within a cell");
}

template <int Dim>
GatherResult Transfers<Dim>::gather_and_scatter(Body<Dim>& body, const Target<Dim>& from, const Gather& what,
                                                const Target<Dim>& to, Scatter sums, bool axisymmetric) const {
  const GatherResult result = gather(body, from, what);
  if (result.valid) scatter(body, to, sums, what.move || what.from_start, axisymmetric);
  return result;
}

template class Transfers<2>;
template class Transfers<3>;
template std::unique_ptr<Transfers<2>> make_transfers<2>(const Scheme&);
template std::unique_ptr<Transfers<3>> make_transfers<3>(const Scheme&);
template std::unique_ptr<Transfers<2>> make_cell_transfers<2>(const Scheme&);
template std::unique_ptr<Transfers<3>> make_cell_transfers<3>(const Scheme&);

}  // namespace tribo
