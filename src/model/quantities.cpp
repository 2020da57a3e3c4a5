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
      {"minx", "length", "lowest x of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().low[0]; }},
      {"miny", "length", "lowest y of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().low[1]; }},
      {"minz", "length", "lowest z of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().low[2]; }},
      {"maxx", "length", "highest x of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().high[0]; }},
      {"maxy", "length", "highest y of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().high[1]; }},
      {"maxz", "length", "highest z of the centre of a particle", Scope::particle,
       [](const S& s) { return s.measures().high[2]; }},
      {"px", "mass velocity", "momentum, x", Scope::particle, [](const S& s) { return s.measures().momentum[0]; }},
      {"py", "mass velocity", "momentum, y", Scope::particle, [](const S& s) { return s.measures().momentum[1]; }},
      {"pz", "mass velocity", "momentum, z", Scope::particle, [](const S& s) { return s.measures().momentum[2]; }},
      {"Lpx", "mass length velocity", "angular momentum about the origin, x", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[0]; }},
      {"Lpy", "mass length velocity", "angular momentum about the origin, y", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[1]; }},
      {"Lpz", "mass length velocity", "angular momentum about the origin, z", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[2]; }},
      {"Lx", "mass length velocity", "the same as Lpx", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[0]; }},
      {"Ly", "mass length velocity", "the same as Lpy", Scope::particle,
       [](const S& s) { return s.measures().angular_momentum[1]; }},
      {"Lz", "mass length velocity", "the same as Lpz", Scope::particle,
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
      {"exxe", "-", "volume average of the elastic strain, xx", Scope::particle,
       [](const S& s) { return s.measures().elastic(0, 0); }},
      {"eyye", "-", "the same, yy", Scope::particle, [](const S& s) { return s.measures().elastic(1, 1); }},
      {"ezze", "-", "the same, zz", Scope::particle, [](const S& s) { return s.measures().elastic(2, 2); }},
      {"exye", "-", "the same, xy", Scope::particle, [](const S& s) { return s.measures().elastic(0, 1); }},
      {"exze", "-", "the same, xz", Scope::particle, [](const S& s) { return s.measures().elastic(0, 2); }},
      {"eyze", "-", "the same, yz", Scope::particle, [](const S& s) { return s.measures().elastic(1, 2); }},
      {"exxp", "-", "total minus elastic strain: the plastic strain, xx", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 0) - s.measures().elastic(0, 0); }},
      {"eyyp", "-", "the same, yy", Scope::particle,
       [](const S& s) { return s.measures().strain(1, 1) - s.measures().elastic(1, 1); }},
      {"ezzp", "-", "the same, zz", Scope::particle,
       [](const S& s) { return s.measures().strain(2, 2) - s.measures().elastic(2, 2); }},
      {"exyp", "-", "the same, xy", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 1) - s.measures().elastic(0, 1); }},
      {"exzp", "-", "the same, xz", Scope::particle,
       [](const S& s) { return s.measures().strain(0, 2) - s.measures().elastic(0, 2); }},
      {"eyzp", "-", "the same, yz", Scope::particle,
       [](const S& s) { return s.measures().strain(1, 2) - s.measures().elastic(1, 2); }},
      {"Fxx", "-", "volume average of the deformation gradient, xx", Scope::particle,
       [](const S& s) { return s.measures().deformation(0, 0); }},
      {"Fxy", "-", "the same, xy", Scope::particle, [](const S& s) { return s.measures().deformation(0, 1); }},
      {"Fxz", "-", "the same, xz", Scope::particle, [](const S& s) { return s.measures().deformation(0, 2); }},
      {"Fyx", "-", "the same, yx", Scope::particle, [](const S& s) { return s.measures().deformation(1, 0); }},
      {"Fyy", "-", "the same, yy", Scope::particle, [](const S& s) { return s.measures().deformation(1, 1); }},
      {"Fyz", "-", "the same, yz", Scope::particle, [](const S& s) { return s.measures().deformation(1, 2); }},
      {"Fzx", "-", "the same, zx", Scope::particle, [](const S& s) { return s.measures().deformation(2, 0); }},
      {"Fzy", "-", "the same, zy", Scope::particle, [](const S& s) { return s.measures().deformation(2, 1); }},
      {"Fzz", "-", "the same, zz", Scope::particle, [](const S& s) { return s.measures().deformation(2, 2); }},
      {"Kinetic Energy", "energy", "kinetic energy of the particles", Scope::particle,
       [](const S& s) { return s.measures().kinetic; }},
      {"Strain Energy", "energy", "elastically stored energy", Scope::particle,
       [](const S& s) { return s.measures().stored; }},
      {"Grid Kinetic Energy", "energy", "kinetic energy of the nodes at the end of the last step", Scope::run,
       [](const S& s) { return s.energies().grid_kinetic; }},
      {"Energy", "energy", "Kinetic Energy plus Strain Energy plus Plastic Energy", Scope::particle,
       [](const S& s) { return s.measures().kinetic + s.measures().stored + s.measures().dissipated; }},
      {"Plastic Energy", "energy", "energy dissipated by the material laws", Scope::particle,
       [](const S& s) { return s.measures().dissipated; }},
      {"Work Energy", "energy", "Strain Energy plus Plastic Energy", Scope::particle,
       [](const S& s) { return s.measures().stored + s.measures().dissipated; }},
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
       "force of a material of type Rigid (of RigidContact: contactx), or of conditions or a symmetry plane with an "
       "id, on "
       "the other materials, x",
       Scope::material, [](const S& s) { return s.reaction()[0]; }},
      {"reactiony", "force", "the same as reactionx, y", Scope::material, [](const S& s) { return s.reaction()[1]; }},
      {"reactionz", "force", "the same as reactionx, z", Scope::material, [](const S& s) { return s.reaction()[2]; }},
      {"contactx", "force",
       "contact force on a material, x, mean since the last row; with='n': from that material only", Scope::material,
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
      {"Decohesion", "energy", "energy dissipated by cohesive zones (traction laws)", Scope::run,
       [](const S& s) { return s.energies().decohesion; }},
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
      {"Expansion Work", "energy", "work of the stress on thermal expansion", Scope::particle,
       [](const S& s) { return s.measures().expansion; }},
      {"history", "-",
       "followed by a blank and the number or name of a history variable of a material or a particle: its volume "
       "average",
       Scope::particle, [](const S& s) { return s.measures().variable; }},
      {"alpha", "1/time", "grid damping", Scope::run, [](const S& s) { return s.grid_damping(); }},
      {"palpha", "1/time", "particle damping", Scope::run, [](const S& s) { return s.particle_damping(); }},
      {"step number", "-", "number of steps done", Scope::run,
       [](const S& s) { return static_cast<double>(s.step()); }},
      {"time step", "time", "current time step", Scope::run, [](const S& s) { return s.step_size(); }},
      {"CPU time", "-", "time of all processors in seconds so far", Scope::run,
       [](const S& s) { return s.processor_time(); }},
      {"Elapsed time", "-", "time of the clock in seconds since the first row", Scope::run,
       [](const S& s) { return s.elapsed_time(); }},
  };
  return list;
}

namespace {

// The first letter of the components of a tensor: stress, strain, deformation gradient.
bool is_component(std::string_view name) {
  return name.size() == 3 && (name[0] == 's' || name[0] == 'e' || name[0] == 'F');
}

}  // namespace

const QuantityInfo* find_global_quantity(std::string_view name) {
  if (same_name(name, "temp")) return find_name(global_quantities(), "Temperature");
  if (!history_variable_of(name).empty()) return find_name(global_quantities(), "history");
  // axisymmetric names of components: R is x, Z is y, T is z
  std::string plain(name), share;
  if (plain.size() == 4 && plain[0] == 'e' && (plain[3] == 'e' || plain[3] == 'p'))  // elastic or plastic strain
    share = plain.substr(3), plain.pop_back();
  for (std::size_t k = is_component(plain) ? 1 : plain.size() - 1; k < plain.size() && plain.size() > 1; ++k) {
    constexpr std::string_view axisymmetric = "RZT";
    if (const auto axis = axisymmetric.find(plain[k]); axis != std::string_view::npos) plain[k] = "xyz"[axis];
  }
  return find_name(global_quantities(), plain + share);
}

std::string_view history_variable_of(std::string_view name) {
  constexpr std::string_view word = "history ";
  return name.size() > word.size() && same_name(name.substr(0, word.size()), word) ? name.substr(word.size())
                                                                                   : std::string_view();
}

bool is_elastic_strain(const QuantityInfo& quantity) {
  return quantity.name.size() == 4 && quantity.name[0] == 'e' && (quantity.name[3] == 'e' || quantity.name[3] == 'p');
}

bool is_strain(const QuantityInfo& quantity) {
  return (quantity.name.size() == 3 && quantity.name[0] == 'e') || is_elastic_strain(quantity);
}

bool is_deformation(const QuantityInfo& quantity) {
  return is_strain(quantity) || (is_component(quantity.name) && quantity.name[0] == 'F');
}

}  // namespace tribo
