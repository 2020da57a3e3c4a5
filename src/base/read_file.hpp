// SPDX-License-Identifier: MIT
/// Reading of whole files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tribo {

/// The bytes of a regular file of at most `most` bytes. Throws FileError that names the file and says why it cannot be
/// read: it is missing, a folder, a pipe or device, too large, or may not be read.
std::string read_file(const std::filesystem::path& file, std::uintmax_t most = std::uintmax_t{4} << 30);

/// A name for messages: at most 200 bytes, with '?' for bytes that are not UTF-8 and for control characters.
std::string printable(const std::string& name);
/// The same for a text of up to `longest` bytes. `lines`: it may have several lines.
std::string printable(const std::string& text, std::size_t longest, bool lines);

/// Bytes of memory that are free for this process; infinity if unknown.
double available_memory();

}  // namespace tribo
