// SPDX-License-Identifier: MIT
/// The folder of the results of a run.
#pragma once

#include "base/error.hpp"
#include "run/folder_lock.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// `run_000012.vtp`
std::string numbered(std::int64_t number, const std::string& extension);

/// What a run writes into its folder.
struct ResultNames {
  std::vector<std::string> files;
  std::vector<std::string> frames;  ///< folders of files with numbers, such as "particles"

  void add(const ResultNames& other);
};

/// A folder that a run writes into. The file `tribo-run.json` lists what runs have made there; nothing else is ever
/// removed or replaced. The folder is locked against other runs.
class ResultFolder {
 public:
  /// Opens the folder, which is created if it does not exist. Throws FileError, also if another run uses the folder.
  explicit ResultFolder(std::filesystem::path path);
  /// Removes an empty folder that was created for a run that did not start.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Makes room for a new run that will write `names`, and lists them as made by it. Throws FileError, and changes
  /// nothing, if the folder holds a run that may not be replaced, or at one of these places something that no run has
  /// made. With `overwrite` what earlier runs have made is removed, and nothing else.
  void start(ResultNames names, bool overwrite);
  /// Throws FileError if the folder holds no run with a checkpoint.
  void require_checkpoint();

  const std::filesystem::path& path() const { return path_; }

 private:
  void remove_results(const ResultNames& made) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  // outermost first; empty once a run has started
  std::optional<FolderLock> lock_;
};

/// The folder already holds the results of a run. The text names options of the program.
class UsedFolderError : public FileError {
 public:
  explicit UsedFolderError(const std::filesystem::path& folder);
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

/// Throws UsedFolderError if the folder already holds the results of a run.
void refuse_used_folder(const std::filesystem::path& folder);

}  // namespace tribo
