// SPDX-License-Identifier: MIT
/// The state at one time as the live page draws it.
#pragma once

#include "view/drawn.hpp"

#include <string>

namespace tribo {

/// What a picture of the page shows.
struct FrameRequest {
  std::string field;   ///< empty: the default field
  std::string arrows;  ///< name of a field of vectors, or `contact forces`; empty: none
  Wanted wanted;
  std::size_t most_arrows = 300;
};

/// The name of the arrows that are the forces at contacts of blocks, and the tractions of particles in contact.
extern const std::string contact_arrows;

/// A line of JSON and then numbers of four bytes each. Its entry `parts` tells the name, the kind (`f`: floats, `u`:
/// unsigned integers) and the length of each part of the numbers, in order. `shown`: what drawn() chooses for the
/// request. Throws UsageError for unknown fields.
std::string frame_answer(const KnownScene& known, const Legend& legend, const FrameRequest& request,
                         const Drawn& shown);

}  // namespace tribo
