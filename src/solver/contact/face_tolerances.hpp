// SPDX-License-Identifier: MIT
/// Lengths that the search for contact faces and the face cache share. All are relative to the cell size.
#pragma once

namespace tribo::face_tolerance {

/// Gaps are measured from the particles at most this far from the line through the node along the normal [cells].
inline constexpr double band = 0.75;
/// Bodies of which less than this is opposite each other meet in a corner or an edge, not in a face [cells].
inline constexpr double least_opposite = 0.05;
/// Curved faces get a gap correction of at most this; it is the sagitta within the band of a face with a radius of
/// about five cells [cells].
inline constexpr double max_gap_correction = 0.06;
/// Particles at most this far behind the foremost one may become the foremost one while a cached face is valid [cells].
inline constexpr double cached_depth = 0.05;
/// The largest travel for which any cached face is valid. Particles at most this far outside of the band may enter it
/// meanwhile [cells].
inline constexpr double max_valid_travel = 0.2;

}  // namespace tribo::face_tolerance
