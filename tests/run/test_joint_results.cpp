// SPDX-License-Identifier: MIT
/// Joints in the files of results, in the grid and between blocks.

#include "input/read.hpp"
#include "output/vtk.hpp"
#include "run/simulation.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <numeric>
#include <sstream>

using namespace tribo;

namespace {

// Two cracks with different laws through a block whose upper part moves up and aside.
const char* const cracked = R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><TimeStep>1e-3</TimeStep><MaxTime>0.02</MaxTime><ArchiveTime>0.01</ArchiveTime><GlobalArchiveTime>1e-3</GlobalArchiveTime><GIMP/>
  <GlobalArchive type='Joint Strain Energy'/><GlobalArchive type='Joint Slip Energy'/><GlobalArchive type='Joint Dashpot Energy'/>
  <GlobalArchive type='Joint Released Energy'/></MPMHeader>
 <Mesh><Grid xmin='0' xmax='10' ymin='0' ymax='12'><Horiz nx='10'/><Vert ny='12'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='m'><Rect xmin='2' xmax='8' ymin='2' ymax='7'/></Body>
  <Body matname='m' vx='0.2' vy='0.1'><Rect xmin='2' xmax='8' ymin='7' ymax='10'/></Body>
 </MaterialPoints>
 <CrackList lawname='rock'><Line xmin='2' ymin='7' xmax='8' ymax='7'/></CrackList>
 <CrackList lawname='bond'><Line xmin='2' ymin='3.5' xmax='8' ymax='3.5'/></CrackList>
 <Material Type='1' Name='m'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>
 <Material Type='Mohr' Name='rock'><stiffness-normal>1e6</stiffness-normal><stiffness-shear>1e6</stiffness-shear><tension>500</tension><cohesion>600</cohesion>
  <dashpot-ratio-normal>0.1</dashpot-ratio-normal><pore-pressure>7</pore-pressure></Material>
 <Material Type='SpringNetwork' Name='bond'><kn>1e6</kn><ks>5e5</ks><sn_ten>1e9</sn_ten><sn_coh>1e9</sn_coh><bond/></Material>
</JANFEAInput>)";

const char* const blocks = R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><TimeStep>1e-4</TimeStep><MaxTime>0.02</MaxTime><ArchiveTime>0.02</ArchiveTime><GlobalArchiveTime>1e-3</GlobalArchiveTime>
  <GlobalArchive type='Strain Energy'/><GlobalArchive type='Slip Energy'/><GlobalArchive type='Dashpot Energy'/><GlobalArchive type='Released Energy'/></MPMHeader>
 <Blocks lawname='bond'>
  <BoxBlock xmin='0' xmax='1' ymin='0' ymax='1' rho='1000'/>
  <BoxBlock xmin='0' xmax='1' ymin='1' ymax='2' rho='1000' vx='1' vy='-0.1'/>
 </Blocks>
 <Material Type='SpringNetwork' Name='bond'><kn>1e8</kn><ks>1e8</ks><sn_ten>1e5</sn_ten><sn_coh>1e5</sn_coh><sn_fa>30</sn_fa><dp_nratio>0.1</dp_nratio><bond/></Material>
</JANFEAInput>)";

/// The last row of a table by its heads.
std::map<std::string, double> last_row(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string heads, line, row, head, value;
  std::getline(in, heads);
  while (std::getline(in, line)) row = line;
  std::istringstream names(heads), values(row);
  std::map<std::string, double> out;
  while (std::getline(names, head, ',') && std::getline(values, value, ',')) out[head] = std::stod(value);
  return out;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void run_quietly(const char* text, const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder, options.quiet = true;
  REQUIRE(run(read_model_text(text, "joints.xml"), options) == Outcome::finished);
}

template <class Frame>
double sum_of(const Frame& frame, const char* name) {
  const auto* field = frame.field(name);
  INFO(name);
  REQUIRE(field);
  return std::accumulate(field->values.begin(), field->values.end(), 0.0);
}

const char* const own_of_bonds[] = {"elongation", "sn_shear", "sn_sigma", "sn_esigma", "sn_tau",
                                    "sn_slip",    "sn_slipb", "sn_slipt", "sn_radius", "kratio"};

}  // namespace

TEST_CASE("files of joints have the quantities of all laws and the energies of the histories", "[joints][results]") {
  const ScratchFolder folder;
  run_quietly(cracked, folder.path);
  const auto files = read_collection(folder.path / "joints.pvd");
  const ParticleFrame frame = read_particles(files.back().file);
  const auto* surface = frame.field("joint");
  REQUIRE(surface);
  for (const char* name : own_of_bonds) {
    const auto* field = frame.field(name);
    INFO(name);
    REQUIRE(field);
    for (std::size_t k = 0; k < frame.count(); ++k)
      if (surface->values[k] == 1) CHECK(field->values[k] == 0);  // of the other law
  }
  const auto *effective = frame.field("stress_effective"), *normal = frame.field("normal_stress"),
             *ratio = frame.field("kratio"), *dashpots = frame.field("dashpot_force");
  REQUIRE((effective && normal && dashpots && frame.field("sn_pois_force")));
  CHECK(dashpots->components == 3);
  for (std::size_t k = 0; k < frame.count(); ++k) {
    if (surface->values[k] == 1) CHECK(effective->values[k] == Approx(normal->values[k] + 7));
    if (surface->values[k] == 2) CHECK(ratio->values[k] == 2);
  }
  const auto row = last_row(folder.path / "history.csv");
  for (const auto& [field, history] : {std::pair{"strain_energy", "Joint Strain Energy"},
                                       {"slip_energy", "Joint Slip Energy"},
                                       {"dashpot_energy", "Joint Dashpot Energy"},
                                       {"released_energy", "Joint Released Energy"}}) {
    INFO(field);
    CHECK(row.at(history) == Approx(sum_of(frame, field)).epsilon(1e-12));
    CHECK(std::abs(row.at(history)) > 0);
  }
  CHECK(text_of(files.back().file).find("Name=\"state_text\"") != std::string::npos);
  const std::string events = text_of(folder.path / "events.csv");
  CHECK(events.starts_with("time,joint,point,x,y,z,event,mode,strength,energy,force,shear,twist,bend\n"));
  CHECK(events.find("bond_break") != std::string::npos);
}

TEST_CASE("files of contacts between blocks have the same quantities", "[blocks][results]") {
  const ScratchFolder folder;
  run_quietly(blocks, folder.path);
  const auto files = read_collection(folder.path / "contacts.pvd");
  const CellFrame frame = read_cells(files.back().file);
  for (const char* name : own_of_bonds) CHECK(frame.field(name));
  const auto row = last_row(folder.path / "history.csv");
  for (const auto& [field, history] : {std::pair{"strain_energy", "Strain Energy"},
                                       {"slip_energy", "Slip Energy"},
                                       {"dashpot_energy", "Dashpot Energy"},
                                       {"released_energy", "Released Energy"}}) {
    INFO(field);
    CHECK(row.at(history) == Approx(sum_of(frame, field)).epsilon(1e-12));
  }
  CHECK(row.at("Slip Energy") > 0);
  CHECK(row.at("Dashpot Energy") > 0);
  CHECK(text_of(files.back().file).find("Name=\"state_text\"") != std::string::npos);
  const std::string events = text_of(folder.path / "events.csv");
  CHECK(events.starts_with("time,contact,block1,block2,x,y,z,event,mode,strength,energy,force,shear,twist,bend\n"));
  CHECK(events.find(",bond_break,2,") != std::string::npos);
}
