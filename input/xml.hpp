// SPDX-License-Identifier: MIT
/// XML text -> statements. The only place that knows TinyXML-2 is xml.cpp.
#pragma once

#include "base/statement.hpp"
#include "input/settings.hpp"

#include <memory>
#include <string_view>

namespace tribo {

/// Entities of an internal DTD subset are expanded, those in the settings with the value there; the external subset is
/// ignored. Throws InputError with the place.
Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings);
inline Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name) {
  Settings none;
  return read_xml(text, file_name, none);
}

}  // namespace tribo
