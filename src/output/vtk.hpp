// SPDX-License-Identifier: MIT
/// Files for ParaView. VTK is used in vtk.cpp only. All numbers must be finite: otherwise the functions that write
/// throw SimulationError with the name of the field, and leave the file as it is.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tribo {

class OutputQueue;

/// Numbers as a file has them, `width` successive ones for each point. VTK reads them in place.
struct OutputRows {
  const double* doubles = nullptr;
  const float* floats = nullptr;  ///< instead of doubles
  int width = 1;
};

/// A field of particles or nodes: components as separate arrays. Vectors have 3 components (a null pointer stands for
/// zeros), symmetric tensors 6 in VTK's order XX YY ZZ XY YZ XZ.
struct OutputField {
  std::string name;
  std::vector<const double*> components;
  const std::int64_t* integers = nullptr;  ///< instead of components
  const std::string* texts = nullptr;      ///< instead of components; the functions that read skip such fields
  OutputRows rows = {};                    ///< instead of components
  std::string unit = {};                   ///< which ParaView shows beside the name; empty: none
};

/// Throws SimulationError if a number is not finite, as the functions that write do.
void check_numbers(std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const OutputField> fields);
/// The same for fields in rows.
void check_rows(std::size_t count, const OutputRows& position, std::span<const OutputField> fields);

/// Writes points as a .vtp with one vertex each, appended and compressed, with the field data TimeValue. Throws
/// FileError.
void write_particles(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                     std::span<const OutputField> fields, double time);
/// The same with the positions in rows of three doubles. `materials`: names by the number of the material, for the
/// field data `material names`; none: they are left out.
void write_particles(const std::filesystem::path& path, std::size_t count, const OutputRows& position,
                     std::span<const OutputField> fields, double time, std::span<const std::string> materials = {});

/// Particles that ParaView shows and hides together, in a file of their own.
struct OutputBlock {
  std::string name;        ///< which ParaView lists
  int number = 0;          ///< in the name of its file
  std::string group = {};  ///< name of the block that contains it and its neighbours of the same group; empty: none
  int part = 0;            ///< number within the group, in the name of the file after `number`
};
/// The file of a block beside `path`, STEM.vtm: `STEM_NUMBER.vtp`, or in a group `STEM_NUMBER_PART.vtp`.
std::filesystem::path file_of_block(const std::filesystem::path& path, const OutputBlock& block);
/// Writes `path`, STEM.vtm, which lists the files of the blocks with their names. Throws FileError.
void write_block_list(const std::filesystem::path& path, std::span<const OutputBlock> blocks);

/// Writes points joined by cells of `corners` points each, lines (2) or triangles (3), as a .vtp. Throws FileError.
void write_surface(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                   std::span<const std::uint32_t> cells, std::size_t corners, std::span<const OutputField> fields,
                   double time);

/// Writes lines (`corners` 2 at most everywhere) or polygons of any number of corners as a .vtp with fields of the
/// cells, not of the points: cell k has the corners cells[ends[k-1]] ... cells[ends[k] - 1]. Throws FileError.
void write_cells(const std::filesystem::path& path, std::size_t count, const std::array<const double*, 3>& position,
                 std::span<const std::uint32_t> cells, std::span<const std::size_t> ends,
                 std::span<const OutputField> fields, double time);

/// Writes nodal fields of a regular lattice as a .vti; x runs fastest. Throws FileError.
void write_grid(const std::filesystem::path& path, const std::array<double, 3>& origin,
                const std::array<double, 3>& spacing, const std::array<int, 3>& nodes,
                std::span<const OutputField> fields, double time);

/// Vectors from the centre of a particle's domain to the middles of its sides; in two dimensions the third is zero.
using HalfAxes = std::array<std::array<double, 3>, 3>;

/// Contents of a particle file.
struct ParticleFrame {
  struct Field {
    std::string name;
    int components = 1;
    bool integers = false;
    std::vector<double> values;  ///< components of a particle next to each other
  };
  double time = 0.0;
  std::vector<std::array<double, 3>> position;
  /// Half axes of the domains of the particles, of the array `domain`; empty if the file has none.
  std::vector<HalfAxes> domains;
  std::vector<Field> fields;

  /// The field of this name, or null.
  const Field* field(std::string_view name) const;
  std::size_t count() const { return position.size(); }
};

/// Contents of a file of cells: lines and polygons between points, with fields of the cells.
struct CellFrame {
  double time = 0.0;
  std::vector<std::array<double, 3>> position;
  std::vector<std::vector<std::uint32_t>> cells;  ///< corners
  std::vector<ParticleFrame::Field> fields;

  const ParticleFrame::Field* field(std::string_view name) const;
  std::size_t count() const { return cells.size(); }
};

/// Reads a .vtp file of write_particles, or all blocks of a .vtm file of write_particle_blocks, one after the other.
/// Throws FileError.
ParticleFrame read_particles(const std::filesystem::path& path);
/// Reads a .vtp file of write_cells. Throws FileError.
CellFrame read_cells(const std::filesystem::path& path);

/// A file of a collection and its time.
struct CollectionEntry {
  double time = 0.0;
  std::filesystem::path file;
  std::string name = {};  ///< of a part, if a time has several files
};
/// The entries of a .pvd file, with whole paths. Throws FileError.
std::vector<CollectionEntry> read_collection(const std::filesystem::path& path);

/// A block of a .vtm file.
struct BlockEntry {
  std::string name;  ///< as in the file, with the entities of XML
  std::filesystem::path file;
};
/// The blocks of a .vtm file, with whole paths. Throws FileError.
std::vector<BlockEntry> read_blocks(const std::filesystem::path& path);

/// The list of files and times that ParaView opens.
class Collection {
 public:
  explicit Collection(std::filesystem::path path) : path_(std::move(path)) {}
  /// Takes over the entries of an existing file up to a time. Throws FileError if the file is damaged.
  void resume(double time);
  /// Adds a file, relative to the collection, and rewrites the collection, by a job of the queue if there is one.
  void add(double time, const std::string& file, OutputQueue* queue = nullptr) { add(time, {{"", file}}, queue); }
  /// Adds several files of one time, which ParaView shows together, with their names.
  struct Part {
    std::string name, file;
  };
  void add(double time, const std::vector<Part>& parts, OutputQueue* queue = nullptr);
  std::size_t size() const { return count_; }

 private:
  void append(double time, const std::vector<Part>& parts);
  std::filesystem::path path_;
  std::string lines_;
  std::size_t count_ = 0;
};

}  // namespace tribo
