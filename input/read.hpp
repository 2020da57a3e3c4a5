// SPDX-License-Identifier: MIT
/// Command files -> Model.
#pragma once

#include "drive/drive.hpp"
#include "input/settings.hpp"
#include "model/model.hpp"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

namespace tribo {

/// The statements of a command file, XML or scripted. What a script writes goes to `output`. Throws InputError,
/// also for settings of what the file does not have; FileError if the file cannot be read.
Statement read_statements(const std::filesystem::path& file, Settings settings = {}, std::FILE* output = stdout);

/// Reads and checks a command file. Throws InputError with every problem found, FileError if the file cannot be read.
Model read_model(const std::filesystem::path& file, const Settings& settings = {});

/// The same from text; `name` stands for the file in messages.
Model read_model_text(std::string_view text, const std::string& name);

/// What <Drive> asks for.
using Drive = std::variant<MaterialDrive, ContactDrive, JointDrive>;

/// Reads <Drive> of a command file, which needs no model beside it. Throws like read_model.
Drive read_drive(const std::filesystem::path& file, const Settings& settings = {});

/// A checked tree -> Model. Relative file names in it are relative to `folder`.
Model build_model(const Statement& root, const std::filesystem::path& folder);

}  // namespace tribo
