// SPDX-License-Identifier: MIT
/// Reading of command files.
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

/// The statements of a command file, XML or script. `output` receives the text that a script writes. Throws InputError,
/// also for settings of variables that the file does not have; FileError if the file cannot be read.
Statement read_statements(const std::filesystem::path& file, Settings settings = {}, std::FILE* output = stdout);

/// Reads and checks a command file. Throws InputError with every problem found, FileError if the file cannot be read.
Model read_model(const std::filesystem::path& file, const Settings& settings = {});

/// Reads a command file from a text; `name` is used as file name in messages, and files that it names are relative to
/// the current folder.
Model read_model_text(std::string_view text, const std::string& name, const Settings& settings = {});
/// The statements of a text, as of a file.
Statement read_statements_text(std::string_view text, const std::string& name, Settings settings = {},
                               std::FILE* output = stdout);

/// The model of a script as a Python program. Throws as read_statements, also for an XML file.
std::string read_as_python(const std::filesystem::path& file, const Settings& settings = {},
                           std::FILE* output = stdout);

/// The contents of <Drive>.
using Drive = std::variant<MaterialDrive, ContactDrive, JointDrive>;

/// Reads <Drive> of a command file, which need not contain a model. Throws as read_model.
Drive read_drive(const std::filesystem::path& file, const Settings& settings = {});
/// The same from a text; files that it names are relative to the current folder.
Drive read_drive_text(std::string_view text, const std::string& name, const Settings& settings = {});

/// The model of a checked tree. Relative file names in it are relative to `folder`.
Model build_model(const Statement& root, const std::filesystem::path& folder);

}  // namespace tribo
