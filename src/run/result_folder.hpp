// SPDX-License-Identifier: MIT
/// The folder of the results of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tribo {

/// `run_000012.vtp`
std::string numbered(std::int64_t number, const std::string& extension);

/// Throws FileError if the folder already holds the results of a run.
void refuse_used_folder(const std::filesystem::path& folder);

/// Throws FileError if the folder has no checkpoint to continue from.
void require_checkpoint(const std::filesystem::path& folder);

/// Removes the results of an earlier run and creates the folders of the new one: `parts`, such as "particles". Throws
/// FileError.
void prepare_folder(const std::filesystem::path& folder, const std::vector<const char*>& parts);

}  // namespace tribo
