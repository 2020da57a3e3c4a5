// SPDX-License-Identifier: MIT
/// Isotropic elastic constants as users give them: one pair of several.
#pragma once

#include "materials/elastic.hpp"

#include <limits>

namespace tribo {

/// The marker of a parameter that was not given.
inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();
inline bool given(double value) { return !std::isnan(value); }

/// What was given; the rest is `absent`.
struct ElasticConstants {
  double young_modulus = absent, poisson_ratio = absent;                ///< E, nu
  double bulk_modulus = absent, shear_modulus = absent, lame = absent;  ///< K, G, Lame
};

/// Lame constants from exactly one of the pairs E and nu, K and G or, if `allow_lame`, Lame and G. Anything else is a
/// problem at `statement` that names what was given and what is valid. Ranges of single values are the table's
/// business.
Elasticity elastic_constants(const Statement& statement, const ElasticConstants& constants, bool allow_lame,
                             Problems& problems);

}  // namespace tribo
