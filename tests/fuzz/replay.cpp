// SPDX-License-Identifier: MIT
/// Reads every file of a folder of stored inputs, one sub-folder for each reader, without libFuzzer:
/// `tribo_replay CORPUS`. It ends with an error if there is no file, and is ended by the first input that is read
/// wrongly.

#include "base/read_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::size_t count = 0;
  for (const auto& folder : std::filesystem::directory_iterator(argv[1])) {
    std::string program = argv[0], reader = folder.path().filename();
    std::vector<char*> words{program.data(), reader.data(), nullptr};
    int size = 2;
    char** first = words.data();
    LLVMFuzzerInitialize(&size, &first);
    std::vector<std::filesystem::path> files;
    for (const auto& file : std::filesystem::directory_iterator(folder)) files.push_back(file.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      std::fprintf(stderr, "%s\n", file.c_str());
      const std::string data = tribo::read_file(file);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(data.data()), data.size());
    }
    count += files.size();
  }
  std::printf("%zu inputs were read\n", count);
  return count > 0 ? 0 : 1;
}
