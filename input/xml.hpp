/// XML text -> statements. The only place that knows TinyXML-2 is xml.cpp.
#pragma once

#include "base/statement.hpp"

#include <filesystem>
#include <memory>
#include <string_view>

namespace tribo {

/// Entities of an internal DTD subset are expanded, the external one is ignored. Throws InputError with the place.
Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name);

/// Throws FileError if the file cannot be read.
Statement read_xml_file(const std::filesystem::path& file);

}  // namespace tribo
