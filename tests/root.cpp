// SPDX-License-Identifier: MIT
#include "root.hpp"

std::filesystem::path tribo::test::source_root() { return TRIBO_ROOT; }
