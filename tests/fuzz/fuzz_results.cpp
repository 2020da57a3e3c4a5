// SPDX-License-Identifier: MIT
/// Any bytes in a file of results must give its contents or a FileError. The first byte chooses the reader. Build with
/// the preset `fuzz`, run `fuzz_results CORPUS_FOLDER`; files of a run with a digit in front are a good start.

#include "base/error.hpp"
#include "output/checkpoint.hpp"
#include "view/run_folder.hpp"

#include <cstdint>
#include <fstream>

namespace {

void read(char kind, const std::filesystem::path& file) {
  switch (kind) {
    case '0':
      tribo::read_particles(file);
      break;
    case '1':
      tribo::read_cells(file);
      break;
    case '2':
      tribo::read_collection(file);
      break;
    case '3':
      tribo::read_table(file);
      break;
    default:
      tribo::Checkpoint{file};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file = std::filesystem::temp_directory_path() / "tribo_fuzz_results";
  if (size == 0) return 0;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    read(static_cast<char>(data[0]), file);
  } catch (const tribo::FileError&) {
  }
  return 0;
}
