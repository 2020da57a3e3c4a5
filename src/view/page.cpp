// SPDX-License-Identifier: MIT
#include "view/page.hpp"

// The files between two labels of their own each
// NOLINTNEXTLINE(hicpp-no-assembler)
__asm__(
    ".section .rodata\n"
    ".global tribo_page_begin, tribo_page_end, tribo_vtk_begin, tribo_vtk_end\n"
    "tribo_page_begin:\n.incbin \"" TRIBO_PAGE
    "\"\ntribo_page_end:\n"
    "tribo_vtk_begin:\n.incbin \"" TRIBO_VTK_JS
    "\"\ntribo_vtk_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" const char tribo_page_begin, tribo_page_end, tribo_vtk_begin, tribo_vtk_end;

namespace tribo {

std::string_view watch_page() {
  return {&tribo_page_begin, static_cast<std::size_t>(&tribo_page_end - &tribo_page_begin)};
}
std::string_view vtk_js() { return {&tribo_vtk_begin, static_cast<std::size_t>(&tribo_vtk_end - &tribo_vtk_begin)}; }

}  // namespace tribo
