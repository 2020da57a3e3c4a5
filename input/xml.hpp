// SPDX-License-Identifier: MIT
/// Parsing of XML text to statements. xml.cpp is the only file that uses TinyXML-2.
#pragma once

#include "base/statement.hpp"
#include "input/settings.hpp"

#include <memory>
#include <string_view>

namespace tribo {

/// Entities of an internal DTD subset are expanded; a value in the settings replaces that of the file. The external
/// subset is ignored. Throws InputError with the place.
Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings);
inline Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name) {
  Settings none;
  return read_xml(text, file_name, none);
}

}  // namespace tribo
