// SPDX-License-Identifier: MIT
#include "view/page.hpp"

// `page_files.inc` is written by CMake: a line TRIBO_PAGE_FILE(number, name, type, path) for each file of the page.

// Each file between two labels of its own
#define TRIBO_PAGE_FILE(number, name, type, path)                                                                   \
  __asm__(".section .rodata\n.global tribo_page_" #number "_begin, tribo_page_" #number "_end\ntribo_page_" #number \
          "_begin:\n.incbin \"" path "\"\ntribo_page_" #number "_end:\n.byte 0\n.previous\n");                      \
  extern "C" const char tribo_page_##number##_begin, tribo_page_##number##_end;
// NOLINTNEXTLINE(hicpp-no-assembler)
#include "view/page_files.inc"
#undef TRIBO_PAGE_FILE

namespace tribo {

const std::vector<PageFile>& page_files() {
#define TRIBO_PAGE_FILE(number, name, type, path) \
  {name,                                          \
   type,                                          \
   {&tribo_page_##number##_begin,                 \
    static_cast<std::size_t>(&tribo_page_##number##_end - &tribo_page_##number##_begin)}},
  static const std::vector<PageFile> files{
#include "view/page_files.inc"
  };
#undef TRIBO_PAGE_FILE
  return files;
}

}  // namespace tribo
