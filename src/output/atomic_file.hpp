// SPDX-License-Identifier: MIT
/// Files that are never half-written.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tribo {

/// Replaces `path` by `content`: written beside it, flushed to disk, then renamed. On failure the old file is untouched
/// and FileError says which path and why.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for content that a library writes to a file itself: `write(temporary)` returns false on failure.
void write_atomically(const std::filesystem::path& path, const std::function<bool(const std::string&)>& write);

}  // namespace tribo
