// SPDX-License-Identifier: MIT
/// Transversely isotropic elastic solid with the axial direction along z. See orthotropic.hpp.

#include "materials/orthotropic.hpp"

namespace tribo {

Catalogue<Material>::Item transverse_1() { return material_law<OrthotropicLaw<Transverse<2>>>({"Transverse"}); }

}  // namespace tribo
