// SPDX-License-Identifier: MIT
#include "model/quantities.hpp"

#include "model/find_name.hpp"

namespace tribo {

const std::vector<QuantityInfo>& global_quantities() {
  using S = HistorySource;
  static const std::vector<QuantityInfo> list{
      {"velx", "velocity", "mass average of the velocity, x", Scope::particle,
       [](const S& s) { return s.velocity()[0]; }},
      {"vely", "velocity", "mass average of the velocity, y", Scope::particle,
       [](const S& s) { return s.velocity()[1]; }},
      {"velz", "velocity", "mass average of the velocity, z", Scope::particle,
       [](const S& s) { return s.velocity()[2]; }},
      {"dispx", "length", "mass average of the displacement, x", Scope::particle,
       [](const S& s) { return s.measures().displacement[0]; }},
      {"dispy", "length", "mass average of the displacement, y", Scope::particle,
       [](const S& s) { return s.measures().displacement[1]; }},
      {"dispz", "length", "mass average of the displacement, z", Scope::particle,
       [](const S& s) { return s.measures().displacement[2]; }},
      {"posx", "length", "centre of mass, x", Scope::particle, [](const S& s) { return s.measures().centre[0]; }},
      {"posy", "length", "centre of mass, y", Scope::particle, [](const S& s) { return s.measures().centre[1]; }},
      {"posz", "length", "centre of mass, z", Scope::particle, [](const S& s) { return s.measures().centre[2]; }},
      {"minx", "length", "lowest x of a particle", Scope::particle, [](const S& s) { return s.measures().low[0]; }},
      {"miny", "length", "lowest y of a particle", Scope::particle, [](const S& s) { return s.measures().low[1]; }},
      {"minz", "length", "lowest z of a particle", Scope::particle, [](const S& s) { return s.measures().low[2]; }},
      {"maxx", "length", "highest x of a particle", Scope::particle, [](const S& s) { return s.measures().high[0]; }},
      {"maxy", "length", "highest y of a particle", Scope::particle, [](const S& s) { return s.measures().high[1]; }},
      {"maxz", "length", "highest z of a particle", Scope::particle, [](const S& s) { return s.measures().high[2]; }},
      {"px", "mass velocity", "momentum, x", Scope::particle, [](const S& s) { return s.measures().momentum[0]; }},
      {"py", "mass velocity", "momentum, y", Scope::particle, [](const S& s) { return s.measures().momentum[1]; }},
      {"pz", "mass velocity", "momentum, z", Scope::particle, [](const S& s) { return s.measures().momentum[2]; }},
      {"Lpx", "mass length velocity", "angular momentum about the origin, x", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[0]; }},
      {"Lpy", "mass length velocity", "angular momentum about the origin, y", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[1]; }},
      {"Lpz", "mass length velocity", "angular momentum about the origin, z", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[2]; }},
      {"sxx", "stress", "volume average of the stress, xx", Scope::particle,
       [](const S& s) { return s.measures().stress(0, 0); }},
      {"syy", "stress", "volume average of the stress, yy", Scope::particle,
       [](const S& s) { return s.measures().stress(1, 1); }},
      {"szz", "stress", "volume average of the stress, zz", Scope::particle,
       [](const S& s) { return s.measures().stress(2, 2); }},
      {"sxy", "stress", "volume average of the stress, xy", Scope::particle,
       [](const S& s) { return s.measures().stress(0, 1); }},
      {"sxz", "stress", "volume average of the stress, xz", Scope::particle,
       [](const S& s) { return s.measures().stress(0, 2); }},
      {"syz", "stress", "volume average of the stress, yz", Scope::particle,
       [](const S& s) { return s.measures().stress(1, 2); }},
      {"pressure", "stress", "minus a third of the trace of the average stress", Scope::particle,
       [](const S& s) { return -s.measures().stress.trace() / 3.0; }},
      {"exx", "-", "volume average of the Biot strain V - 1, xx", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 0); }},
      {"eyy", "-", "volume average of the Biot strain, yy", Scope::particle,
       [](const S& s) { return s.measures().strain(1, 1); }},
      {"ezz", "-", "volume average of the Biot strain, zz", Scope::particle,
       [](const S& s) { return s.measures().strain(2, 2); }},
      {"exy", "-", "volume average of the Biot strain, xy", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 1); }},
      {"exz", "-", "volume average of the Biot strain, xz", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 2); }},
      {"eyz", "-", "volume average of the Biot strain, yz", Scope::particle,
       [](const S& s) { return s.measures().strain(1, 2); }},
      {"Kinetic Energy", "energy", "kinetic energy of the particles", Scope::particle,
       [](const S& s) { return s.measures().kinetic; }},
      {"Strain Energy", "energy", "elastically stored energy", Scope::particle,
       [](const S& s) { return s.measures().stored; }},
      {"Plastic Energy", "energy", "energy dissipated by the material laws", Scope::particle,
       [](const S& s) { return s.measures().dissipated; }},
      {"Potential Energy", "energy", "potential energy of constant gravity, zero at the start", Scope::run,
       [](const S& s) { return s.energies().potential; }},
      {"External Work", "energy", "work of body forces, loads and tractions", Scope::run,
       [](const S& s) { return s.energies().external_work; }},
      {"Boundary Work", "energy", "work of prescribed velocities", Scope::run,
       [](const S& s) { return s.energies().boundary_work; }},
      {"Damping Energy", "energy", "energy dissipated by damping", Scope::run,
       [](const S& s) { return s.energies().damping; }},
      {"Transfer Dissipation", "energy",
       "kinetic energy lost in the transfers between particles and nodes; negative: gained", Scope::run,
       [](const S& s) { return s.energies().transfer; }},
      {"mass", "mass", "mass of the particles", Scope::particle, [](const S& s) { return s.measures().mass; }},
      {"volume", "length^3", "current volume", Scope::particle, [](const S& s) { return s.measures().volume; }},
      {"particles", "-", "number of particles", Scope::material,
       [](const S& s) { return static_cast<double>(s.measures().particles); }},
      {"reactionx", "force",
       "force of a rigid material, or of conditions or a symmetry plane with an id, on the other materials, x",
       Scope::material, [](const S& s) { return s.reaction()[0]; }},
      {"reactiony", "force", "the same, y", Scope::material, [](const S& s) { return s.reaction()[1]; }},
      {"reactionz", "force", "the same, z", Scope::material, [](const S& s) { return s.reaction()[2]; }},
      {"contactx", "force", "contact force on a material, x; with='n': from that material only", Scope::material,
       [](const S& s) { return s.contact().force[0]; }},
      {"contacty", "force", "contact force on a material, y", Scope::material,
       [](const S& s) { return s.contact().force[1]; }},
      {"contactz", "force", "contact force on a material, z", Scope::material,
       [](const S& s) { return s.contact().force[2]; }},
      {"Friction Work", "energy", "energy dissipated by friction", Scope::material,
       [](const S& s) { return s.contact().friction; }},
      {"Impact Work", "energy", "energy dissipated by normal contact", Scope::material,
       [](const S& s) { return s.contact().impact; }},
      {"Interface Energy", "energy", "energy stored in imperfect interfaces", Scope::material,
       [](const S& s) { return s.contact().stored; }},
      {"Joint Strain Energy", "energy", "energy stored in joints and imperfect interfaces", Scope::run,
       [](const S& s) { return s.energies().joint_strain; }},
      {"Joint Slip Energy", "energy", "energy dissipated by friction in joints", Scope::run,
       [](const S& s) { return s.energies().joint_slip; }},
      {"Joint Dashpot Energy", "energy", "energy dissipated by the dashpots of joints", Scope::run,
       [](const S& s) { return s.energies().joint_dashpot; }},
      {"Joint Released Energy", "energy",
       "energy released in joints by brittle failure, dilation and changes of pressure", Scope::run,
       [](const S& s) { return s.energies().joint_released; }},
      {"Contact Area", "length^2", "area of the faces in contact", Scope::material,
       [](const S& s) { return s.contact().area; }},
      {"Temperature", "temperature", "mean temperature, weighted by heat capacity", Scope::particle,
       [](const S& s) { return s.measures().temperature; }},
      {"Heat Energy", "energy", "mass times heat capacity times temperature", Scope::particle,
       [](const S& s) { return s.measures().heat; }},
      {"Internal Energy", "energy", "Strain Energy plus Heat Energy", Scope::particle,
       [](const S& s) { return s.measures().stored + s.measures().heat; }},
      {"Heat Supplied", "energy", "heat supplied by prescribed temperatures and heat fluxes", Scope::run,
       [](const S& s) { return s.heat_supplied(); }},
      {"Contact Heat", "energy", "heat from friction", Scope::run, [](const S& s) { return s.contact_heat(); }},
      {"Work Heat", "energy", "heat from the work dissipated by the material", Scope::particle,
       [](const S& s) { return s.measures().work_heat; }},
      {"alpha", "1/time", "grid damping", Scope::run, [](const S& s) { return s.grid_damping(); }},
      {"palpha", "1/time", "particle damping", Scope::run, [](const S& s) { return s.particle_damping(); }},
      {"step number", "-", "number of steps done", Scope::run,
       [](const S& s) { return static_cast<double>(s.step()); }},
      {"time step", "time", "current time step", Scope::run, [](const S& s) { return s.step_size(); }},
  };
  return list;
}

const QuantityInfo* find_global_quantity(std::string_view name) {
  if (same_name(name, "temp")) return find_name(global_quantities(), "Temperature");
  // axisymmetric names of components: R is x, Z is y, T is z
  std::string plain(name);
  if (plain.size() == 4 && (plain[0] == 'e') && plain[3] == 'e') plain.pop_back();  // elastic strain
  const bool tensor = plain.size() == 3 && (plain[0] == 's' || plain[0] == 'e');
  for (std::size_t k = tensor ? 1 : plain.size() - 1; k < plain.size() && plain.size() > 1; ++k) {
    constexpr std::string_view axisymmetric = "RZT";
    if (const auto axis = axisymmetric.find(plain[k]); axis != std::string_view::npos) plain[k] = "xyz"[axis];
  }
  return find_name(global_quantities(), plain);
}

bool is_strain(const QuantityInfo& quantity) { return quantity.name.size() == 3 && quantity.name[0] == 'e'; }

}  // namespace tribo
