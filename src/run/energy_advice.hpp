// SPDX-License-Identifier: MIT
/// What to change in a model whose energy balance is off.
#pragma once

#include "model/scheme.hpp"

#include <string>

namespace tribo {

struct Model;

/// What usually avoids that energy comes from nowhere, without what the scheme already has.
std::string cure_of_gain(const Scheme& scheme);

/// What usually avoids most of the energy that the balance lacks, or where it is; empty if nothing is known. USL- loses
/// energy at nodes with little mass, to a smaller extent USAVG- does. In equilibrium, and with XPIC and FMPM, updates
/// with a second extrapolation lose more. With USF the ledger does not see the dissipation of a transfer. `loss`: how
/// the text names it.
std::string cure_of_loss(const Model& model, const std::string& loss = "this loss");

/// What usually reduces the energy by which the balance exceeds the energy supplied: with the stress of the end of a
/// step the error of the time integration is of first order in the step.
std::string cure_of_excess(const Scheme& scheme);

}  // namespace tribo
