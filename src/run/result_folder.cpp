// SPDX-License-Identifier: MIT
#include "run/result_folder.hpp"

#include "base/error.hpp"

#include <cstdio>

namespace tribo {

std::string numbered(std::int64_t number, const std::string& extension) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "run_%06lld", static_cast<long long>(number));
  return digits + extension;
}

void refuse_used_folder(const std::filesystem::path& folder) {
  for (const char* file : {"run.pvd", "blocks.pvd", "provenance.json"})
    if (std::filesystem::exists(folder / file))
      throw FileError("'" + folder.string() +
                      "' already holds a run; pass --overwrite to replace it, --output DIR for another folder, or use "
                      "'tribo resume'");
}

void require_checkpoint(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "checkpoint.bin"))
    throw FileError("'" + folder.string() + "' has no checkpoint.bin to resume from");
}

void prepare_folder(const std::filesystem::path& folder, const std::vector<const char*>& parts) {
  std::error_code error;
  for (const char* part : {"particles", "grid", "cracks", "joints", "blocks", "contacts"})
    std::filesystem::remove_all(folder / part, error);
  for (const char* file :
       {"run.pvd", "grid.pvd", "cracks.pvd", "joints.pvd", "blocks.pvd", "contacts.pvd", "events.csv", "tips.csv",
        "block_events.csv", "block_energy.csv", "history.csv", "energy.csv", "checkpoint.bin", "provenance.json"})
    std::filesystem::remove(folder / file, error);
  for (const char* part : parts) {
    std::filesystem::create_directories(folder / part, error);
    if (error) throw FileError("cannot create '" + (folder / part).string() + "': " + error.message());
  }
}

}  // namespace tribo
