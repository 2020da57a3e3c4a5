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
      {"velx", "velocity", "mass average of the velocity, x", true},
      {"vely", "velocity", "mass average of the velocity, y", true},
      {"velz", "velocity", "mass average of the velocity, z", true},
      {"dispx", "length", "mass average of the displacement, x", true},
      {"dispy", "length", "mass average of the displacement, y", true},
      {"dispz", "length", "mass average of the displacement, z", true},
      {"posx", "length", "centre of mass, x", true},
      {"posy", "length", "centre of mass, y", true},
      {"posz", "length", "centre of mass, z", true},
      {"minx", "length", "lowest x of a particle", true},
      {"miny", "length", "lowest y of a particle", true},
      {"minz", "length", "lowest z of a particle", true},
      {"maxx", "length", "highest x of a particle", true},
      {"maxy", "length", "highest y of a particle", true},
      {"maxz", "length", "highest z of a particle", true},
      {"px", "mass velocity", "momentum, x", true},
      {"py", "mass velocity", "momentum, y", true},
      {"pz", "mass velocity", "momentum, z", true},
      {"Lpx", "mass length velocity", "angular momentum about the origin, x", true},
      {"Lpy", "mass length velocity", "angular momentum about the origin, y", true},
      {"Lpz", "mass length velocity", "angular momentum about the origin, z", true},
      {"sxx", "stress", "volume average of the stress, xx", true},
      {"syy", "stress", "volume average of the stress, yy", true},
      {"szz", "stress", "volume average of the stress, zz", true},
      {"sxy", "stress", "volume average of the stress, xy", true},
      {"sxz", "stress", "volume average of the stress, xz", true},
      {"syz", "stress", "volume average of the stress, yz", true},
      {"pressure", "stress", "minus a third of the trace of the average stress", true},
      {"exx", "-", "volume average of the Biot strain V - 1, xx", true},
      {"eyy", "-", "volume average of the Biot strain, yy", true},
      {"ezz", "-", "volume average of the Biot strain, zz", true},
      {"exy", "-", "volume average of the Biot strain, xy", true},
      {"exz", "-", "volume average of the Biot strain, xz", true},
      {"eyz", "-", "volume average of the Biot strain, yz", true},
      {"Kinetic Energy", "energy", "of the particles", true},
      {"Strain Energy", "energy", "stored elastically", true},
      {"Plastic Energy", "energy", "dissipated by the material", true},
      {"Potential Energy", "energy", "of constant gravity, zero at the start", false},
      {"External Work", "energy", "of body forces, loads and tractions", false},
      {"Boundary Work", "energy", "of prescribed velocities", false},
      {"Damping Energy", "energy", "taken out by damping", false},
      {"mass", "mass", "of the particles", true},
      {"volume", "length^3", "present volume", true},
      {"particles", "-", "number of particles", true},
      {"reactionx", "force", "of a rigid material, or conditions or symmetry plane with an id, on the rest, x", true},
      {"reactiony", "force", "the same, y", true},
      {"reactionz", "force", "the same, z", true},
      {"contactx", "force", "contact force on a material, x; with='n': from that material only", true},
      {"contacty", "force", "contact force on a material, y", true},
      {"contactz", "force", "contact force on a material, z", true},
      {"Friction Work", "energy", "dissipated by sliding contact", true},
      {"Impact Work", "energy", "dissipated by normal contact", true},
      {"Interface Energy", "energy", "stored in imperfect interfaces", true},
      {"Contact Area", "length^2", "of the faces in contact", true},
      {"Temperature", "temperature", "mean, weighted by heat capacity", true},
      {"Heat Energy", "energy", "mass times heat capacity times temperature", true},
      {"Internal Energy", "energy", "Strain Energy plus Heat Energy", true},
      {"Heat Supplied", "energy", "by prescribed temperatures and heat fluxes", false},
      {"Contact Heat", "energy", "that sliding contact gave", false},
      {"Work Heat", "energy", "of the work that the material dissipated", true},
      {"alpha", "1/time", "grid damping", false},
      {"palpha", "1/time", "particle damping", false},
      {"step number", "-", "steps done", false},
      {"time step", "time", "present step", false},
  };
  return list;
}

const QuantityInfo* find_global_quantity(std::string_view name) {
  if (same(name, "temp")) return find(global_quantities(), "Temperature");
  // axisymmetric names: R is x, Z is y, T is z
  std::string plain(name);
  if (plain.size() == 4 && (plain[0] == 'e') && plain[3] == 'e') plain.pop_back();  // elastic strain
  const bool tensor = plain.size() == 3 && (plain[0] == 's' || plain[0] == 'e');
  for (std::size_t k = tensor ? 1 : plain.size() - 1; k < plain.size() && plain.size() > 1; ++k) {
    constexpr std::string_view axisymmetric = "RZT";
    if (const auto axis = axisymmetric.find(plain[k]); axis != std::string_view::npos) plain[k] = "xyz"[axis];
  }
  return find(global_quantities(), plain);
}

const std::vector<QuantityInfo>& particle_fields() {
  static const std::vector<QuantityInfo> list{
      {"id", "-", "number given at the start, kept for life", false},
      {"material", "-", "number of the material in the command file", false},
      {"velocity", "velocity", "", false},
      {"displacement", "length", "since the start", false},
      {"mass", "mass", "", false},
      {"volume", "length^3", "present volume", false},
      {"stress", "stress", "Cauchy stress, tension positive", false},
      {"pressure", "stress", "minus a third of the trace", false},
      {"von_mises", "stress", "sqrt(3 J2)", false},
      {"strain", "-", "Biot strain V - 1 with F = V R, in present axes", false},
      {"rotation", "rad", "axis of R times its angle", false},
      {"deformation_gradient", "-", "F", false},
      {"strain_energy", "energy", "stored elastically", false},
      {"plastic_energy", "energy", "dissipated by the material", false},
      {"work_energy", "energy", "stored and dissipated", false},
      {"heat_energy", "energy", "mass times heat capacity times temperature", false},
      {"cell_crossings", "-", "how often the particle went to another cell of the grid", false},
      {"volume_ratio", "-", "J = V / V0", false},
      {"temperature", "temperature", "if anything changes or feels it", false},
      {"contact_state", "-", "0 open, 1 stick, 2 slip", false},
      {"contact_traction", "stress", "of contact on the particle's face", false},
      {"contact_normal", "-", "of contact, out of the particle's body", false},
      {"history", "-", "all variables the material keeps, by name", false},
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
  // the dialect numbers the variables of a material, Tribo writes all by name
  const bool numbered = name.size() > 7 && same(name.substr(0, 7), "history") &&
                        name.find_first_not_of("0123456789", 7) == std::string_view::npos;
  return find(particle_fields(), numbered ? name.substr(0, 7) : name);
}

}  // namespace tribo
