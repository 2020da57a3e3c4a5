// SPDX-License-Identifier: MIT
/// Numbers as colours.
#pragma once

#include <array>
#include <cstdint>

namespace tribo {

using Colour = std::array<std::uint8_t, 3>;

/// From dark blue to yellow, evenly for the eye: the map `viridis` (Smith & van der Walt, CC0). `part` from 0 to 1.
Colour viridis(double part);
/// A colour of its own for each of up to ten things; then they repeat (the set of Okabe & Ito and two greys).
Colour distinct(int k);

}  // namespace tribo
