/// Command files -> Model.
#pragma once

#include "drive/drive.hpp"
#include "model/model.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

namespace tribo {

/// Reads and checks a command file. Throws InputError with every problem found, FileError if the file cannot be read.
Model read_model(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Model read_model_text(std::string_view text, const std::string& name);

/// What <Drive> asks for.
using Drive = std::variant<MaterialDrive, ContactDrive>;

/// Reads <Drive> of a command file, which needs no model beside it. Throws like read_model.
Drive read_drive(const std::filesystem::path& file);

/// A checked tree -> Model. Relative file names in it are relative to `folder`.
Model build_model(const Statement& root, const std::filesystem::path& folder);

}  // namespace tribo
