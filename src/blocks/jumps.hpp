// SPDX-License-Identifier: MIT
/// Steps in which one block could pass through another one unseen.
#pragma once

namespace tribo {

class Assembly;
struct BlockShape;

/// The smallest extent of a block normal to one of its faces [length]; of a ball its diameter.
double thinnest(const BlockShape& shape, bool plane);

/// Throws SimulationError if two blocks on each other's way have moved in a step of dt by more than a quarter of the
/// thinner one's thickness relative to each other: contacts are found from the positions after a step. Displacements
/// below `harmless` are not looked at.
void refuse_jumps(const Assembly& blocks, double dt, double harmless);

}  // namespace tribo
