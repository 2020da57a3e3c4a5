// SPDX-License-Identifier: MIT
#include "model/shape_functions.hpp"

#include "base/text.hpp"

#include <sstream>

namespace tribo {
namespace {

struct Entry {
  Kernel kernel;
  const char* words;
};

#define TRIBO_ENTRY(name, type, words) {Kernel::name, words},
constexpr Entry entries[] = {TRIBO_SHAPE_FUNCTIONS(TRIBO_ENTRY)};
#undef TRIBO_ENTRY

}  // namespace

std::vector<std::string> words_of(Kernel kernel) {
  std::vector<std::string> out;
  for (const Entry& entry : entries)
    if (entry.kernel == kernel) {
      std::istringstream words(entry.words);
      for (std::string word; words >> word;) out.push_back(word);
    }
  return out;
}

std::optional<Kernel> kernel_of(const std::string& word) {
  for (const Entry& entry : entries)
    for (const std::string& known : words_of(entry.kernel))
      if (lower(known) == lower(word)) return entry.kernel;
  return std::nullopt;
}

const std::string& all_kernel_words() {
  static const std::string all = [] {
    std::string out;
    for (const Entry& entry : entries) out += (out.empty() ? "" : " ") + std::string(entry.words);
    return out;
  }();
  return all;
}

}  // namespace tribo
