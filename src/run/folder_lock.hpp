// SPDX-License-Identifier: MIT
/// A lock that keeps two runs out of one folder.
#pragma once

#include <filesystem>

namespace tribo {

/// Holds a lock on the file `tribo-run.lock` of a folder. The kernel releases it when the process ends, however it
/// ends, so a lock that nobody holds cannot remain. Where the file system has no locks there is a warning.
class FolderLock {
 public:
  static constexpr const char* file_name = "tribo-run.lock";

  /// Throws FileError if another process holds the lock, with its number and machine, or if the folder is read-only.
  explicit FolderLock(const std::filesystem::path& folder);
  /// Removes the file only if it did not exist before and was not kept.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Leaves the file in the folder.
  void keep() { created_ = false; }

 private:
  void sign() const;

  std::filesystem::path path_;
  int file_ = -1;
  bool created_ = false;
};

}  // namespace tribo
