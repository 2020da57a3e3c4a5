// SPDX-License-Identifier: MIT
/// Transversely isotropic elastic solid with the axial direction along y. See orthotropic.hpp.

#include "materials/orthotropic.hpp"

namespace tribo {

Catalogue<Material>::Item transverse_2() { return material_law<OrthotropicLaw<Transverse<1>>>(); }

}  // namespace tribo
