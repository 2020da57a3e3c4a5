// SPDX-License-Identifier: MIT
#include "solver/transfer/transfer.hpp"

#include "solver/transfer/cpdi_transfer.hpp"
#include "solver/transfer/product_transfer.hpp"

#include <stdexcept>

namespace tribo {

template <int Dim>
std::unique_ptr<Transfers<Dim>> make_transfers(const Scheme& scheme) {
  switch (scheme.kernel) {
    case Kernel::linear:
      return std::make_unique<ProductTransfers<Dim, LinearKernel>>();
    case Kernel::gimp:
      return std::make_unique<ProductTransfers<Dim, GimpKernel>>();
    case Kernel::quadratic_spline:
      return std::make_unique<ProductTransfers<Dim, QuadraticKernel>>();
    case Kernel::cubic_spline:
      return std::make_unique<ProductTransfers<Dim, CubicKernel>>();
    case Kernel::cpdi:
      return std::make_unique<CpdiTransfers<Dim>>(scheme.cpdi_limit);
  }
  throw std::logic_error("no such kernel");
}

template <int Dim>
std::unique_ptr<Transfers<Dim>> make_cell_transfers(const Scheme& scheme) {
  if (scheme.kernel == Kernel::linear) return std::make_unique<ProductTransfers<Dim, CellKernel<LinearKernel>>>();
  if (scheme.kernel == Kernel::cpdi) return std::make_unique<ProductTransfers<Dim, CellKernel<CubicKernel>>>();
  throw std::logic_error("means over cells are for shape functions that are linear within a cell");
}

template std::unique_ptr<Transfers<2>> make_transfers<2>(const Scheme&);
template std::unique_ptr<Transfers<3>> make_transfers<3>(const Scheme&);
template std::unique_ptr<Transfers<2>> make_cell_transfers<2>(const Scheme&);
template std::unique_ptr<Transfers<3>> make_cell_transfers<3>(const Scheme&);

}  // namespace tribo
