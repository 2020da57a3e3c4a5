/// Small things that are done to text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribo {

/// In lower case, ASCII only.
std::string lower(std::string_view text);

/// What stands between blanks.
std::vector<std::string> words_of(std::string_view text);

/// For XML and HTML: & < > as entities, and `quote`, if the text stands between such.
std::string escaped(std::string_view text, char quote = '"');

}  // namespace tribo
