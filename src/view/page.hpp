// SPDX-License-Identifier: MIT
/// Files of the page of `tribo watch`, embedded in the program.
#pragma once

#include <string_view>

namespace tribo {

std::string_view watch_page();
/// vtk.js, or a comment if the program was built without.
std::string_view vtk_js();

}  // namespace tribo
