// SPDX-License-Identifier: MIT
#include "model/quantities.hpp"

#include <algorithm>
#include <cctype>

namespace tribo {
namespace {

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

const QuantityInfo* find(const std::vector<QuantityInfo>& list, std::string_view name) {
  const auto entry = std::find_if(list.begin(), list.end(), [&](const QuantityInfo& q) { return same(q.name, name); });
  return entry == list.end() ? nullptr : &*entry;
}

}  // namespace

const std::vector<QuantityInfo>& global_quantities() {
  static const std::vector<QuantityInfo> list{
      {"velx", "velocity", "mass average of the velocity, x", Scope::particle},
      {"vely", "velocity", "mass average of the velocity, y", Scope::particle},
      {"velz", "velocity", "mass average of the velocity, z", Scope::particle},
      {"dispx", "length", "mass average of the displacement, x", Scope::particle},
      {"dispy", "length", "mass average of the displacement, y", Scope::particle},
      {"dispz", "length", "mass average of the displacement, z", Scope::particle},
      {"posx", "length", "centre of mass, x", Scope::particle},
      {"posy", "length", "centre of mass, y", Scope::particle},
      {"posz", "length", "centre of mass, z", Scope::particle},
      {"minx", "length", "lowest x of a particle", Scope::particle},
      {"miny", "length", "lowest y of a particle", Scope::particle},
      {"minz", "length", "lowest z of a particle", Scope::particle},
      {"maxx", "length", "highest x of a particle", Scope::particle},
      {"maxy", "length", "highest y of a particle", Scope::particle},
      {"maxz", "length", "highest z of a particle", Scope::particle},
      {"px", "mass velocity", "momentum, x", Scope::particle},
      {"py", "mass velocity", "momentum, y", Scope::particle},
      {"pz", "mass velocity", "momentum, z", Scope::particle},
      {"Lpx", "mass length velocity", "angular momentum about the origin, x", Scope::particle},
      {"Lpy", "mass length velocity", "angular momentum about the origin, y", Scope::particle},
      {"Lpz", "mass length velocity", "angular momentum about the origin, z", Scope::particle},
      {"sxx", "stress", "volume average of the stress, xx", Scope::particle},
      {"syy", "stress", "volume average of the stress, yy", Scope::particle},
      {"szz", "stress", "volume average of the stress, zz", Scope::particle},
      {"sxy", "stress", "volume average of the stress, xy", Scope::particle},
      {"sxz", "stress", "volume average of the stress, xz", Scope::particle},
      {"syz", "stress", "volume average of the stress, yz", Scope::particle},
      {"pressure", "stress", "minus a third of the trace of the average stress", Scope::particle},
      {"exx", "-", "volume average of the Biot strain V - 1, xx", Scope::particle},
      {"eyy", "-", "volume average of the Biot strain, yy", Scope::particle},
      {"ezz", "-", "volume average of the Biot strain, zz", Scope::particle},
      {"exy", "-", "volume average of the Biot strain, xy", Scope::particle},
      {"exz", "-", "volume average of the Biot strain, xz", Scope::particle},
      {"eyz", "-", "volume average of the Biot strain, yz", Scope::particle},
      {"Kinetic Energy", "energy", "kinetic energy of the particles", Scope::particle},
      {"Strain Energy", "energy", "elastically stored energy", Scope::particle},
      {"Plastic Energy", "energy", "energy dissipated by the material laws", Scope::particle},
      {"Potential Energy", "energy", "potential energy of constant gravity, zero at the start", Scope::run},
      {"External Work", "energy", "work of body forces, loads and tractions", Scope::run},
      {"Boundary Work", "energy", "work of prescribed velocities", Scope::run},
      {"Damping Energy", "energy", "energy dissipated by damping", Scope::run},
      {"mass", "mass", "mass of the particles", Scope::particle},
      {"volume", "length^3", "current volume", Scope::particle},
      {"particles", "-", "number of particles", Scope::material},
      {"reactionx", "force",
       "force of a rigid material, or of conditions or a symmetry plane with an id, on the other materials, x",
       Scope::material},
      {"reactiony", "force", "the same, y", Scope::material},
      {"reactionz", "force", "the same, z", Scope::material},
      {"contactx", "force", "contact force on a material, x; with='n': from that material only", Scope::material},
      {"contacty", "force", "contact force on a material, y", Scope::material},
      {"contactz", "force", "contact force on a material, z", Scope::material},
      {"Friction Work", "energy", "energy dissipated by friction", Scope::material},
      {"Impact Work", "energy", "energy dissipated by normal contact", Scope::material},
      {"Interface Energy", "energy", "energy stored in imperfect interfaces", Scope::material},
      {"Contact Area", "length^2", "area of the faces in contact", Scope::material},
      {"Temperature", "temperature", "mean temperature, weighted by heat capacity", Scope::particle},
      {"Heat Energy", "energy", "mass times heat capacity times temperature", Scope::particle},
      {"Internal Energy", "energy", "Strain Energy plus Heat Energy", Scope::particle},
      {"Heat Supplied", "energy", "heat supplied by prescribed temperatures and heat fluxes", Scope::run},
      {"Contact Heat", "energy", "heat from friction", Scope::run},
      {"Work Heat", "energy", "heat from the work dissipated by the material", Scope::particle},
      {"alpha", "1/time", "grid damping", Scope::run},
      {"palpha", "1/time", "particle damping", Scope::run},
      {"step number", "-", "number of steps done", Scope::run},
      {"time step", "time", "current time step", Scope::run},
  };
  return list;
}

const QuantityInfo* find_global_quantity(std::string_view name) {
  if (same(name, "temp")) return find(global_quantities(), "Temperature");
  // axisymmetric names of components: R is x, Z is y, T is z
  std::string plain(name);
  if (plain.size() == 4 && (plain[0] == 'e') && plain[3] == 'e') plain.pop_back();  // elastic strain
  const bool tensor = plain.size() == 3 && (plain[0] == 's' || plain[0] == 'e');
  for (std::size_t k = tensor ? 1 : plain.size() - 1; k < plain.size() && plain.size() > 1; ++k) {
    constexpr std::string_view axisymmetric = "RZT";
    if (const auto axis = axisymmetric.find(plain[k]); axis != std::string_view::npos) plain[k] = "xyz"[axis];
  }
  return find(global_quantities(), plain);
}

const std::vector<BlockQuantityInfo>& block_quantities() {
  using Of = BlockQuantityInfo::Of;
  static const std::vector<BlockQuantityInfo> list{
      {"forcex", "force", "force of the blocks on a platen, x", Of::platen},
      {"forcey", "force", "force of the blocks on a platen, y", Of::platen},
      {"forcez", "force", "force of the blocks on a platen, z", Of::platen},
      {"dispx", "length", "displacement of a platen, x", Of::platen},
      {"dispy", "length", "displacement of a platen, y", Of::platen},
      {"dispz", "length", "displacement of a platen, z", Of::platen},
      {"area", "length^2", "area of the faces attached to a platen", Of::platen},
      {"dispx", "length", "displacement of a block's centre, or the mean of its group, x", Of::block},
      {"dispy", "length", "the same, y", Of::block},
      {"dispz", "length", "the same, z", Of::block},
      {"velx", "velocity", "velocity of a block, or the mean of its group, x", Of::block},
      {"vely", "velocity", "the same, y", Of::block},
      {"velz", "velocity", "the same, z", Of::block},
      {"turnx", "rad", "rotation vector of a block, or the mean of its group, x", Of::block},
      {"turny", "rad", "the same, y", Of::block},
      {"turnz", "rad", "the same, z", Of::block},
      {"spinx", "1/time", "angular velocity of a block, or the mean of its group, x", Of::block},
      {"spiny", "1/time", "the same, y", Of::block},
      {"spinz", "1/time", "the same, z", Of::block},
      {"forcex", "force", "force on a block, or the sum of its group, without gravity and damping: the reaction, x",
       Of::block},
      {"forcey", "force", "the same, y", Of::block},
      {"forcez", "force", "the same, z", Of::block},
      {"sxx", "stress", "volume average of the stress of the blocks, xx", Of::run},
      {"syy", "stress", "the same, yy", Of::run},
      {"szz", "stress", "the same, zz", Of::run},
      {"sxy", "stress", "the same, xy", Of::run},
      {"sxz", "stress", "the same, xz", Of::run},
      {"syz", "stress", "the same, yz", Of::run},
      {"exx", "-", "strain of the least-squares fit to the displacements of all blocks, xx", Of::run},
      {"eyy", "-", "the same, yy", Of::run},
      {"ezz", "-", "the same, zz", Of::run},
      {"exy", "-", "the same, xy", Of::run},
      {"exz", "-", "the same, xz", Of::run},
      {"eyz", "-", "the same, yz", Of::run},
      {"bonds", "-", "number of intact bonds", Of::run},
      {"broken in tension", "-", "number of bonds broken in tension so far", Of::run},
      {"broken in shear", "-", "number of bonds broken in shear so far", Of::run},
      {"contacts", "-", "number of contacts that carry a force", Of::run},
      {"unbalanced", "-", "largest resultant force on a free block divided by the mean contact force", Of::run},
      {"Kinetic Energy", "energy", "", Of::run},
      {"Strain Energy", "energy", "energy stored in the contacts", Of::run},
      {"Step Number", "-", "", Of::run},
      {"Time Step", "time", "", Of::run}};
  return list;
}

const BlockQuantityInfo* find_block_quantity(std::string_view name, BlockQuantityInfo::Of of) {
  for (const auto& q : block_quantities())
    if (q.of == of && same(q.name, name)) return &q;
  return nullptr;
}

const std::vector<QuantityInfo>& particle_fields() {
  static const std::vector<QuantityInfo> list{
      {"id", "-", "number assigned at the start, never changed", Scope::particle},
      {"material", "-", "number of the material in the command file", Scope::particle},
      {"velocity", "velocity", "", Scope::particle},
      {"displacement", "length", "displacement since the start", Scope::particle},
      {"mass", "mass", "", Scope::particle},
      {"volume", "length^3", "current volume", Scope::particle},
      {"stress", "stress", "Cauchy stress, tension positive", Scope::particle},
      {"pressure", "stress", "minus a third of the trace of the stress", Scope::particle},
      {"von_mises", "stress", "sqrt(3 J2)", Scope::particle},
      {"strain", "-", "Biot strain V - 1 with F = V R, in the current configuration", Scope::particle},
      {"rotation", "rad", "rotation vector of R: axis times angle", Scope::particle},
      {"deformation_gradient", "-", "F", Scope::particle},
      {"strain_energy", "energy", "elastically stored energy", Scope::particle},
      {"plastic_energy", "energy", "energy dissipated by the material law", Scope::particle},
      {"work_energy", "energy", "stored and dissipated energy", Scope::particle},
      {"heat_energy", "energy", "mass times heat capacity times temperature", Scope::particle},
      {"cell_crossings", "-", "number of times the particle has moved to another grid cell", Scope::particle},
      {"volume_ratio", "-", "J = V / V0", Scope::particle},
      {"temperature", "temperature", "temperature, if any process changes it or depends on it", Scope::particle},
      {"contact_state", "-", "0 open, 1 stick, 2 slip", Scope::particle},
      {"contact_traction", "stress", "contact traction on the particle's face", Scope::particle},
      {"contact_normal", "-", "contact normal, outward from the particle's body", Scope::particle},
      {"history", "-", "all history variables of the material, by name", Scope::particle},
  };
  return list;
}

const QuantityInfo* find_particle_field(std::string_view name) {
  struct Alias {
    std::string_view dialect, name;
  };
  static constexpr Alias aliases[] = {
      {"strainenergy", "strain_energy"}, {"plasticenergy", "plastic_energy"},    {"workenergy", "work_energy"},
      {"heatenergy", "heat_energy"},     {"elementcrossings", "cell_crossings"}, {"rotstrain", "rotation"},
      {"plasticstrain", "history"}};
  for (const Alias& a : aliases)
    if (same(name, a.dialect)) return find(particle_fields(), a.name);
  // NairnMPM numbers the history variables of a material; Tribo writes all of them by name
  const bool numbered = name.size() > 7 && same(name.substr(0, 7), "history") &&
                        name.find_first_not_of("0123456789", 7) == std::string_view::npos;
  return find(particle_fields(), numbered ? name.substr(0, 7) : name);
}

}  // namespace tribo
