// SPDX-License-Identifier: MIT
/// Files of the live page, embedded in the program.
#pragma once

#include <string_view>
#include <vector>

namespace tribo {

struct PageFile {
  std::string_view name, type, text;
};

/// All files of the page. vtk.js and the charts are comments if the program was built without them.
const std::vector<PageFile>& page_files();

}  // namespace tribo
