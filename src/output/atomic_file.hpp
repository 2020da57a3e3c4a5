// SPDX-License-Identifier: MIT
/// Files that are replaced as a whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tribo {

/// Replaces `path` by `content`: written to a temporary file in the same folder, flushed to disk, then renamed. On
/// failure the old file is untouched and FileError names the path and the reason. A device or a pipe is written to.
void write_atomically(const std::filesystem::path& path, std::string_view content);
/// The same for content in several parts.
void write_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts);

/// The same for content that a library writes to a file itself: `write(temporary)` returns false on failure.
void write_atomically(const std::filesystem::path& path, const std::function<bool(const std::string&)>& write);
/// The same in two parts: the content is written now, and the function that is returned flushes it to the disk, which
/// takes time, and gives it its name.
std::function<void()> begin_atomically(const std::filesystem::path& path,
                                       const std::function<bool(const std::string&)>& write);

/// Writes over an existing file, within the space that it has on the disk: what remains possible on a full disk. False,
/// and nothing changes, if there is no such file or the content needs more space.
bool write_over(const std::filesystem::path& path, std::string_view content);

/// Flushes a file or the names in a folder to the disk, so that they survive a power cut. Does nothing if there is no
/// such file. Throws FileError.
void flush_to_disk(const std::filesystem::path& path);

/// The temporary file of `path`; a program that is killed may leave it.
std::filesystem::path temporary_of(const std::filesystem::path& path);

}  // namespace tribo
