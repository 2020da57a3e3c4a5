// SPDX-License-Identifier: MIT
#include "materials/elastic_constants.hpp"

namespace tribo {

Elasticity elastic_constants(const Statement& statement, const ElasticConstants& c, bool allow_lame,
                             Problems& problems) {
  std::vector<std::string> names;
  const auto note = [&](double value, const char* name) {
    if (given(value)) names.emplace_back(name);
  };
  note(c.young_modulus, "E");
  note(c.poisson_ratio, "nu");
  note(c.bulk_modulus, "K");
  note(c.shear_modulus, "G");
  note(c.lame, "Lame");

  if (names.size() == 2) {
    if (given(c.young_modulus) && given(c.poisson_ratio)) return Elasticity::young(c.young_modulus, c.poisson_ratio);
    if (given(c.bulk_modulus) && given(c.shear_modulus)) return Elasticity::bulk_shear(c.bulk_modulus, c.shear_modulus);
    if (allow_lame && given(c.lame) && given(c.shear_modulus)) {
      const Elasticity elastic{c.lame, c.shear_modulus};
      if (!(elastic.bulk() > 0))
        problems.add(statement.child("Lame")->origin,
                     "<Lame> must exceed -2/3 of <G>, otherwise the bulk modulus is negative");
      return elastic;
    }
  }
  problems.add(statement.origin, std::string("the elastic constants must be one pair: E and nu, or K and G") +
                                     (allow_lame ? ", or Lame and G" : "") +
                                     "; given: " + (names.empty() ? std::string("none") : join(names, " and ")));
  return {};
}

}  // namespace tribo
