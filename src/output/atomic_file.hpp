// SPDX-License-Identifier: MIT
/// Files that are replaced as a whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tribo {

/// Replaces `path` by `content`: written to a temporary file in the same folder, flushed to disk, then renamed. On
/// failure the old file is untouched and FileError names the path and the reason.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for content that a library writes to a file itself: `write(temporary)` returns false on failure.
void write_atomically(const std::filesystem::path& path, const std::function<bool(const std::string&)>& write);

}  // namespace tribo
