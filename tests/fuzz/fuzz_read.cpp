// SPDX-License-Identifier: MIT
/// Any bytes must give a model or an InputError. Build with the preset `fuzz`, run `fuzz_read CORPUS_FOLDER`; the
/// malformed files of the tests are a good start.

#include "input/read.hpp"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    tribo::read_model_text({reinterpret_cast<const char*>(data), size}, "fuzz.xml");
  } catch (const tribo::InputError&) {
  }
  return 0;
}
