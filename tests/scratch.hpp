// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace tribo {

/// A temporary folder used by this test only, removed at its end.
struct ScratchFolder {
  std::filesystem::path path;

  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tribo-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make the folder " + name);
    path = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

/// A file `name` with the bytes `content`, in a scratch folder of its own.
struct ScratchFile {
  ScratchFolder folder;
  std::string path;

  ScratchFile(const std::string& name, const std::string& content) : path((folder.path / name).string()) {
    std::ofstream(path, std::ios::binary) << content;
  }
};

}  // namespace tribo
