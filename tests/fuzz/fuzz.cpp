// SPDX-License-Identifier: MIT
/// Any bytes must be read or refused with an error of the program, and what is read must be right in form. One program
/// for all readers: `tribo_fuzz READER [options of libFuzzer] CORPUS_FOLDER`; `tribo_fuzz_states` also restores
/// states and takes steps with them. `scripts/fuzz` runs it for each of them.

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "input/read.hpp"
#include "output/checkpoint.hpp"
#include "particles/fill.hpp"
#include "run/model_record.hpp"
#include "run/result_folder.hpp"
#include "view/run_folder.hpp"
#ifdef TRIBO_FUZZ_STATES
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#endif

#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>

namespace {

using namespace tribo;
namespace fs = std::filesystem;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "wrong: %s\n", what);
  std::abort();
}

/// A folder of its own in memory.
const fs::path& scratch() {
  static const fs::path folder = [] {
    std::string name = fs::exists("/dev/shm") ? "/dev/shm/tribo-fuzz-XXXXXX" : "/tmp/tribo-fuzz-XXXXXX";
    require(mkdtemp(name.data()) != nullptr, "no temporary folder");
    std::atexit([] {
      std::error_code ignored;
      fs::remove_all(scratch(), ignored);
    });
    return fs::path(name);
  }();
  return folder;
}

fs::path write(const std::string& name, std::string_view content) {
  const fs::path file = scratch() / name;
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return file;
}

// Command files

void command_file(std::string_view data) {
  const Model model = read_model_text(data, "fuzz.xml");
  require(std::isfinite(model.time.end) && model.time.end > 0, "the end time");
  require(model.only_blocks() || model.grid.cells[0] > 0, "the number of cells");
}

constexpr const char* flat =
    "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>"
    "<MPMHeader><GIMP type='uGIMP'/><MaxTime>2e-2</MaxTime><ArchiveTime>1e-2</ArchiveTime></MPMHeader><Mesh><Grid "
    "xmin='0' xmax='10' ymin='0' ymax='4'><Horiz nx='20'/><Vert ny='8'/></Grid></Mesh><MaterialPoints>";
constexpr const char* solid =
    "<JANFEAInput version='3'><Header><Analysis>12</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>"
    "<MPMHeader><GIMP type='uGIMP'/><MaxTime>2e-2</MaxTime><ArchiveTime>1e-2</ArchiveTime></MPMHeader><Mesh><Grid "
    "xmin='0' xmax='10' ymin='0' ymax='4' zmin='0' zmax='4'><Horiz nx='20'/><Vert ny='8'/><Depth nz='8'/></Grid></Mesh>"
    "<MaterialPoints>";
constexpr const char* rubber =
    "</MaterialPoints><Material Type='1' Name='rubber'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material></JANFEAInput>";

// A file with data that a command file names.
Model with_file(const char* head, const char* body, const char* name, std::string_view data) {
  write(name, data);
  return read_model(write("case.xml", std::string(head) + body + rubber));
}

void data_file(const char* body, const char* name, std::string_view data) {
  const Model model = with_file(flat, body, name, data);
  for (const Seed& seed : place_points(model)) {
    require(seed.x.allFinite(), "the place of a particle");
    require(seed.material >= 0 && seed.material < static_cast<int>(model.materials.size()), "the material");
  }
}

void tables(std::string_view data) {
  data_file(
      "<Body matname='rubber'><InitialStress file='table.csv'/><Rect xmin='2' xmax='5' ymin='1' ymax='3'/></Body>",
      "table.csv", data);
}
void images(std::string_view data) {
  data_file(
      "<BMP name='picture' width='4' height='3'><Origin x='2' y='0.5'/><Intensity matname='rubber' imin='0' "
      "imax='100'/></BMP>",
      "picture", data);
}
void particle_tables(std::string_view data) {
  data_file("<ParticleTable matname='rubber' file='particles.csv'/>", "particles.csv", data);
}
void particle_files(std::string_view data) {
  data_file("<ParticleTable matname='rubber' file='particles.vtp'/>", "particles.vtp", data);
}
void particle_legacy_files(std::string_view data) {
  data_file("<ParticleTable matname='rubber' file='particles.vtk'/>", "particles.vtk", data);
}

// A body whose shape is in a file. Filling the body would take most of the time.
void shape_file(const char* head, const char* body, const char* name, std::string_view data) {
  const Model model = with_file(head, body, name, data);
  const auto box = model.pieces.at(0).region->bounds();
  for (double part = 0.05; part < 1; part += 0.1)
    model.pieces[0].region->contains(box.low + Vec3(part, 0.5, 1 - part).cwiseProduct(box.high - box.low));
}
void surfaces(std::string_view data) {
  shape_file(solid, "<Body matname='rubber'><STL file='surface.stl'/></Body>", "surface.stl", data);
}
void plane_meshes(std::string_view data) {
  shape_file(flat, "<Body matname='rubber'><Surface file='mesh.msh' group='plate'/></Body>", "mesh.msh", data);
}
void solid_meshes(std::string_view data) {
  shape_file(solid, "<Body matname='rubber'><Surface file='mesh.msh' group='high'/></Body>", "mesh.msh", data);
}

// Results

void check_fields(const std::vector<ParticleFrame::Field>& fields, std::size_t count) {
  for (const auto& f : fields)
    require(f.values.size() == count * static_cast<std::size_t>(f.components), "the size of a field");
}

void particles(std::string_view data) {
  const ParticleFrame frame = read_particles(write("a.vtp", data));
  require(std::isfinite(frame.time), "the time");
  require(frame.domains.empty() || frame.domains.size() == frame.count(), "the domains");
  check_fields(frame.fields, frame.count());
}
void cells(std::string_view data) {
  const CellFrame frame = read_cells(write("a.vtp", data));
  check_fields(frame.fields, frame.count());
  for (const auto& cell : frame.cells)
    for (const auto corner : cell) require(corner < frame.position.size(), "a corner");
}
void collections(std::string_view data) {
  double last = -INFINITY;
  for (const auto& entry : read_collection(write("run.pvd", data))) {
    require(std::isfinite(entry.time) && entry.time >= last, "the times");
    last = entry.time;
    const auto inside = entry.file.lexically_normal().lexically_relative(scratch());
    require(!inside.empty() && *inside.begin() != "..", "a file outside of the folder");
  }
}
void histories(std::string_view data) {
  const ResultTable table = read_table(write("history.csv", data));
  require(table.names.size() == table.columns.size(), "the columns");
  for (const auto& column : table.columns) require(column.size() == table.rows(), "the rows");
}
void records(std::string_view data) {
  write("run.pvd", "<VTKFile></VTKFile>");
  write("provenance.json", data);
  RunFolder(scratch()).legend();
}
void models(std::string_view data) {
  write("tribo-model.xml", "");
  write("tribo-model.json", data);
  read_model_record(scratch());
}

// The list of what a run has made: nothing outside of the folder is ever removed.
void lists(std::string_view data) {
  const fs::path outside = write("outside", "mine"), folder = scratch() / "out";
  fs::remove_all(folder);
  fs::create_directories(folder / "particles");
  write("out/tribo-run.json", data), write("out/particles/mine", ""), write("out/history.csv", "");
  try {
    ResultFolder(folder).start({{"history.csv"}, {"particles"}}, true);
  } catch (const FileError&) {
    require(fs::exists(folder / "history.csv"), "a refused run has removed a file");
  }
  require(read_file(outside) == "mine", "a file outside of the folder has changed");
  require(fs::exists(folder / "particles/mine"), "a file that no run has made was removed");
}

// A checkpoint with right check sums, whatever its numbers are.
std::string with_checksums(std::string data) {
  auto at = data.find('\n') + 1;
  const auto word = [&](std::size_t from) {
    std::uint64_t value = 0;
    std::memcpy(&value, data.data() + from, sizeof value);
    return value;
  };
  while (at > 0 && at + 17 <= data.size() && data[at] != 0) {
    const std::uint64_t name = word(at + 1), size = word(at + 9), begin = at + 17;
    if (name > data.size() || size > data.size() || begin + name + size + 4 > data.size()) break;
    const auto crc = static_cast<std::uint32_t>(
        ::crc32(0, reinterpret_cast<const Bytef*>(data.data() + begin), static_cast<uInt>(name + size)));
    std::memcpy(data.data() + begin + name + size, &crc, sizeof crc);
    at = begin + name + size + 4;
  }
  return data;
}

// As it is, and with right check sums: damaged sums are refused before anything else is read.
void checkpoints(std::string_view data) {
  try {
    Checkpoint{write("checkpoint.bin", data)};
  } catch (const FileError&) {
  }
  Checkpoint{write("checkpoint.bin", with_checksums(std::string(data)))};
}

#ifdef TRIBO_FUZZ_STATES
std::string model_file;  // of the states

void states(std::string_view data) {
  static constexpr int steps = 3;
  static const Model model = read_model(model_file);
  const Checkpoint checkpoint(write("checkpoint.bin", with_checksums(std::string(data))));
  std::unique_ptr<SteppedModel> run;
  if (model.only_blocks())
    run = std::make_unique<BlockRun>(model);
  else if (model.dimension() == 2)
    run = std::make_unique<GridRun<2>>(model);
  else
    run = std::make_unique<GridRun<3>>(model);
  run->restore(checkpoint);
  for (int k = 0; k < steps; ++k) run->advance();
}
#endif

using Reader = void (*)(std::string_view);
const std::map<std::string, Reader> readers{
#ifdef TRIBO_FUZZ_STATES
    {"states", states},
#endif
    {"xml", command_file},
    {"scripts", command_file},
    {"blocks", command_file},
    {"cracks", command_file},
    {"tables", tables},
    {"images", images},
    {"surfaces", surfaces},
    {"particles", particles},
    {"cells", cells},
    {"collections", collections},
    {"histories", histories},
    {"records", records},
    {"models", models},
    {"lists", lists},
    {"checkpoints", checkpoints},
    {"plane_meshes", plane_meshes},
    {"solid_meshes", solid_meshes},
    {"particle_tables", particle_tables},
    {"particle_files", particle_files},
    {"particle_legacy_files", particle_legacy_files}};
Reader reader = nullptr;

}  // namespace

// The first argument is the reader; of states, the command file follows.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const auto take = [&](const char* what) {
    if (*argc < 2) {
      std::fprintf(stderr, "%s is missing; readers:", what);
      for (const auto& [name, ignored] : readers) std::fprintf(stderr, " %s", name.c_str());
      std::fprintf(stderr, "\n");
      std::exit(2);
    }
    const std::string out = (*argv)[1];
    for (int k = 1; k + 1 < *argc; ++k) (*argv)[k] = (*argv)[k + 1];
    --*argc;
    return out;
  };
  const auto found = readers.find(take("the reader"));
  if (found == readers.end()) std::exit(2);
  reader = found->second;
#ifdef TRIBO_FUZZ_STATES
  if (found->first == "states") model_file = take("the command file");
#endif
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    reader({reinterpret_cast<const char*>(data), size});
  } catch (const InputError&) {
  } catch (const FileError&) {
  } catch (const SimulationError&) {
  }
  return 0;
}
