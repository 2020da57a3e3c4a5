// SPDX-License-Identifier: MIT
/// Isotropic elastic constants, given as one of several pairs.
#pragma once

#include "materials/elastic.hpp"

#include <limits>
#include <string_view>

namespace tribo {

/// Value of a parameter that was not given.
inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();
inline bool given(double value) { return !std::isnan(value); }

/// The constants of the input; those not given are `absent`.
struct ElasticConstants {
  double young_modulus = absent, poisson_ratio = absent;                ///< E, nu
  double bulk_modulus = absent, shear_modulus = absent, lame = absent;  ///< K, G, Lame
};

/// What laws with `elastic_constants` need, for the manual.
inline constexpr std::string_view one_elastic_pair = "E and nu, or K and G";

/// Lame constants from exactly one of the pairs E and nu, K and G or, if `allow_lame`, Lame and G. Any other
/// combination is reported as a problem at `statement`, with the constants given and the valid pairs. The ranges of
/// single values are checked by the parameter table.
Elasticity elastic_constants(const Statement& statement, const ElasticConstants& constants, bool allow_lame,
                             Problems& problems);

}  // namespace tribo
