// SPDX-License-Identifier: MIT
#include "input/xml.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

namespace tribo {
namespace {

constexpr std::size_t largest_expansion = 1 << 20;  // limit of the characters added by entities
constexpr int deepest = 100;

/// Places of a start tag, its attributes and its text in the source, in document order.
struct TagPlace {
  Origin tag, text;
  std::vector<Origin> attributes;
};

/// Scans the source once: records places, collects entities, and produces the text that TinyXML-2 parses.
class Scanner {
 public:
  Scanner(std::string_view source, std::shared_ptr<const std::string> file, Settings& settings)
      : source_(source), file_(std::move(file)), settings_(settings) {}

  void run() {
    while (at_ < source_.size()) {
      if (starts("<!--")) {
        copy_until("-->", "a comment is not closed");
      } else if (starts("<![CDATA[")) {
        copy_until("]]>", "a CDATA section is not closed");
      } else if (starts("<?")) {
        copy_until("?>", "a processing instruction is not closed");
      } else if (starts("<!DOCTYPE")) {
        doctype();
      } else if (starts("</")) {
        copy_until(">", "an end tag is not closed");
      } else if (source_[at_] == '<') {
        start_tag();
      } else {
        character();
      }
    }
  }

  std::string expanded;
  std::vector<TagPlace> places;

 private:
  bool starts(std::string_view word) const { return source_.substr(at_, word.size()) == word; }
  Origin here() const { return {file_, line_, column_}; }
  [[noreturn]] void fail(const Origin& origin, const std::string& message) const { throw InputError(origin, message); }

  char advance() {
    const char c = source_[at_++];
    if (c == '\0') fail(here(), "the file holds a NUL byte; it is not text");
    if (c == '\n')
      ++line_, column_ = 1;
    else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U)
      ++column_;
    return c;
  }

  void copy_until(std::string_view end, const std::string& message) {
    const Origin begin = here();
    while (at_ < source_.size() && !starts(end)) expanded += advance();
    if (at_ >= source_.size()) fail(begin, message);
    for (std::size_t k = 0; k < end.size(); ++k) expanded += advance();
  }

  // Replaced by blanks for the parser, which does not support internal subsets.
  void doctype() {
    const Origin begin = here();
    int brackets = 0;
    while (at_ < source_.size()) {
      if (starts("<!--")) {
        while (at_ < source_.size() && !starts("-->")) blank();
      } else if (starts("<!ENTITY")) {
        entity();
      } else if (source_[at_] == '"' || source_[at_] == '\'') {
        const char quote = source_[at_];
        blank();
        while (at_ < source_.size() && source_[at_] != quote) blank();
        if (at_ < source_.size()) blank();
      } else {
        const char c = source_[at_];
        blank();
        if (c == '[') ++brackets;
        if (c == ']') --brackets;
        if (c == '>' && brackets <= 0) return;
      }
    }
    fail(begin, "<!DOCTYPE is not closed");
  }
  void blank() { expanded += advance() == '\n' ? '\n' : ' '; }

  void entity() {
    const Origin begin = here();
    for (int k = 0; k < 8; ++k) blank();
    const auto skip_blanks = [&] {
      while (at_ < source_.size() && std::isspace(static_cast<unsigned char>(source_[at_]))) blank();
    };
    skip_blanks();
    std::string name;
    while (at_ < source_.size() && !std::isspace(static_cast<unsigned char>(source_[at_])) && source_[at_] != '>')
      name += source_[at_], blank();
    skip_blanks();
    if (at_ >= source_.size() || (source_[at_] != '"' && source_[at_] != '\''))
      fail(begin, "<!ENTITY needs a name and a quoted value");
    const char quote = source_[at_];
    blank();
    std::string value;
    while (at_ < source_.size() && source_[at_] != quote) value += source_[at_], blank();
    if (at_ >= source_.size()) fail(begin, "the value of entity '" + name + "' is not closed");
    blank();
    skip_blanks();
    if (at_ >= source_.size() || source_[at_] != '>') fail(begin, "<!ENTITY " + name + " is not closed");
    blank();
    const std::string* set = settings_.find(name);
    entities_.emplace(name, set ? *set : value);  // the first definition applies
  }

  void start_tag() {
    TagPlace place;
    place.tag = here();
    expanded += advance();
    char quote = 0;
    bool in_name = false, first = true;
    while (at_ < source_.size()) {
      const char c = source_[at_];
      if (quote) {
        if (c == quote) quote = 0;
        character();
        continue;
      }
      if (c == '<') fail(here(), "'<' inside a tag; the tag at " + place.tag.text() + " is not closed");
      const bool blank_here = std::isspace(static_cast<unsigned char>(c));
      if (c == '"' || c == '\'')
        quote = c, in_name = false;
      else if (blank_here || c == '=' || c == '/') {
        in_name = false;
        if (blank_here) first = false;
      } else if (c != '>' && !in_name && !first) {
        in_name = true;
        place.attributes.push_back(here());
      }
      expanded += advance();
      if (c == '>') {
        // The text begins at the first character that is not a blank
        auto look = *this;
        const auto skip_blanks = [&] {
          while (look.at_ < look.source_.size() && std::isspace(static_cast<unsigned char>(look.source_[look.at_])))
            look.advance();
        };
        skip_blanks();
        constexpr std::string_view cdata = "<![CDATA[";
        if (look.starts(cdata)) {
          for (std::size_t k = 0; k < cdata.size(); ++k) look.advance();
          skip_blanks();
        }
        place.text = look.here();
        places.push_back(std::move(place));
        return;
      }
    }
    fail(place.tag, "this tag is not closed");
  }

  void character() {
    if (source_[at_] != '&') {
      expanded += advance();
      return;
    }
    const Origin begin = here();
    const auto end = source_.find(';', at_);
    if (end == std::string_view::npos || end - at_ > 100)
      fail(begin, "'&' begins an entity such as &amp; but no ';' follows");
    const std::string name(source_.substr(at_ + 1, end - at_ - 1));
    while (at_ <= end) advance();
    expand(name, begin, 0);
  }

  void expand(const std::string& name, const Origin& use, int depth) {
    static constexpr std::array<std::string_view, 5> standard{"amp", "lt", "gt", "quot", "apos"};
    if ((!name.empty() && name[0] == '#') || std::find(standard.begin(), standard.end(), name) != standard.end()) {
      expanded += "&" + name + ";";
      return;
    }
    const auto found = entities_.find(name);
    if (found == entities_.end()) {
      std::vector<std::string> known;
      for (const auto& [n, v] : entities_) known.push_back(n);
      fail(use, "the entity '&" + name + ";' is not defined" + did_you_mean(name, known));
    }
    if (depth > 20) fail(use, "the entity '&" + name + ";' refers to itself");
    const std::string& value = found->second;
    for (std::size_t k = 0; k < value.size(); ++k) {
      if (++added_ > largest_expansion) fail(use, "entities expand to more than a million characters");
      const auto end = value[k] == '&' ? value.find(';', k) : std::string::npos;
      if (end == std::string::npos) {
        expanded += value[k];
        continue;
      }
      expand(value.substr(k + 1, end - k - 1), use, depth + 1);
      k = end;
    }
  }

  std::string_view source_;
  std::shared_ptr<const std::string> file_;
  Settings& settings_;
  std::size_t at_ = 0, added_ = 0;
  int line_ = 1, column_ = 1;
  std::map<std::string, std::string> entities_;
};

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\r\n");
  return from == std::string::npos ? std::string() : text.substr(from, text.find_last_not_of(" \t\r\n") - from + 1);
}

/// Traverses the elements of the parser and the places of the scanner in the same order.
class Converter {
 public:
  explicit Converter(const std::vector<TagPlace>& places) : places_(places) {}

  Statement convert(const tinyxml2::XMLElement& element, int depth) {
    static const TagPlace unknown;
    const TagPlace& place = next_ < places_.size() ? places_[next_] : unknown;
    ++next_;
    Statement s;
    s.name = element.Name();
    s.origin = place.tag;
    s.text_origin = place.text;
    if (depth > deepest)
      throw InputError(s.origin, "elements are nested more than " + std::to_string(deepest) + " deep");
    std::size_t k = 0;
    for (const auto* a = element.FirstAttribute(); a; a = a->Next(), ++k) {
      const Origin at = k < place.attributes.size() ? place.attributes[k] : place.tag;
      if (const auto* same = s.attribute(a->Name()))
        throw InputError(at,
                         "attribute '" + std::string(a->Name()) + "' is given twice; first at " + same->origin.text());
      s.attributes.push_back({a->Name(), trimmed(a->Value()), at});
    }
    std::string text;
    for (const auto* node = element.FirstChild(); node; node = node->NextSibling()) {
      if (const auto* child = node->ToElement()) s.children.push_back(convert(*child, depth + 1));
      if (const auto* t = node->ToText()) text += t->Value();
    }
    s.text = trimmed(text);
    return s;
  }

 private:
  const std::vector<TagPlace>& places_;
  std::size_t next_ = 0;
};

std::string plain(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed by its own end tag";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not of the form name=\"value\"";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "an element is malformed";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text or a tag is not closed";
    case tinyxml2::XML_ERROR_PARSING:
      return "a tag is malformed; is there a bare '<' in a text or a formula? Write &lt; instead";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file holds no element";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    default:
      return document.ErrorName();
  }
}

}  // namespace

Statement read_xml(std::string_view text, const std::shared_ptr<const std::string>& file_name, Settings& settings) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Scanner scanner(text, file_name, settings);
  scanner.run();
  tinyxml2::XMLDocument document;
  document.Parse(scanner.expanded.c_str(), scanner.expanded.size());
  if (document.Error()) {
    const int line = std::max(1, document.ErrorLineNum());
    // The parser reports the line only; the first tag on it gives the column
    int column = 1;
    for (const auto& place : scanner.places)
      if (place.tag.line == line) {
        column = place.tag.column;
        break;
      }
    throw InputError({file_name, line, column}, "not well-formed XML: " + plain(document));
  }
  const auto* root = document.RootElement();
  if (!root) throw InputError({file_name, 1, 1}, "the file holds no element");
  return Converter(scanner.places).convert(*root, 0);
}

}  // namespace tribo
