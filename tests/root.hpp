// SPDX-License-Identifier: MIT
/// Where the sources are.
#pragma once

#include <filesystem>

namespace tribo::test {

/// The folder of the sources of Tribo. Only root.cpp is compiled with its name, so that a compiler cache can give the
/// objects of all other tests to another clone.
std::filesystem::path source_root();

}  // namespace tribo::test
