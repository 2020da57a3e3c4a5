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
constexpr std::size_t deepest = 200;                // nested elements
constexpr std::size_t longest_name = 200, longest_value = 10'000, most_attributes = 500;

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
        end_tag();
      } else if (source_[at_] == '<') {
        start_tag();
      } else {
        character();
      }
    }
    if (!open_.empty()) fail(open_.back().origin, "<" + open_.back().name + "> is never closed");
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
      add_to_name(name, begin), blank();
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

  static bool blank_char(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

  void add_to_name(std::string& name, const Origin& begin) const {
    name += source_[at_];
    if (name.size() > longest_name)
      fail(begin, "this name is longer than " + std::to_string(longest_name) + " characters: '" + name + "'");
  }

  // An element must be closed by its own end tag.
  void end_tag() {
    const Origin begin = here();
    const auto end = source_.find('>', at_);
    if (end == std::string_view::npos) fail(begin, "an end tag is not closed");
    auto name = source_.substr(at_ + 2, end - at_ - 2);
    while (!name.empty() && blank_char(name.back())) name.remove_suffix(1);
    if (open_.empty()) fail(begin, "this end tag closes nothing");
    if (name != open_.back().name)
      fail(begin, "an element is not closed by its own end tag: </" + std::string(name.substr(0, 60)) + "> follows <" +
                      open_.back().name + "> at " + open_.back().origin.text());
    open_.pop_back();
    while (at_ <= end) expanded += advance();
  }

  void start_tag() {
    TagPlace place;
    place.tag = here();
    expanded += advance();
    Open element{{}, place.tag};
    std::map<std::string, Origin, std::less<>> given;
    std::string attribute;  // name of the attribute that is read
    std::size_t value = 0;  // characters of the value that is read
    char quote = 0;
    bool in_name = false, first = true, empty = false;
    const auto name_ends = [&] {
      if (!in_name) return;
      const auto [before, fresh] = given.emplace(attribute, place.attributes.back());
      if (!fresh)
        fail(place.attributes.back(),
             "attribute '" + attribute + "' is given twice; first at " + before->second.text());
      if (given.size() > most_attributes)
        fail(place.tag, "this tag has more than " + std::to_string(most_attributes) + " attributes");
      in_name = false;
    };
    while (at_ < source_.size()) {
      const char c = source_[at_];
      if (quote) {
        if (c == quote) quote = 0, value = 0;
        if (++value > longest_value)
          fail(place.tag, "an attribute of this tag is longer than " + std::to_string(longest_value) + " characters");
        in_value_ = true, character(), in_value_ = false;
        continue;
      }
      if (c == '<') fail(here(), "'<' inside a tag; the tag at " + place.tag.text() + " is not closed");
      if (c == '"' || c == '\'') {
        name_ends();
        quote = c, value = 0;
      } else if (blank_char(c) || c == '=' || c == '/' || c == '>') {
        name_ends();
        if (blank_char(c)) first = false;
      } else if (first) {
        add_to_name(element.name, place.tag);
      } else {
        if (!in_name) attribute.clear(), place.attributes.push_back(here());
        in_name = true;
        add_to_name(attribute, place.attributes.back());
      }
      if (c != '>') empty = c == '/';
      expanded += advance();
      if (c != '>') continue;
      if (!empty) open_.push_back(element);
      if (open_.size() > deepest) fail(place.tag, "elements are nested more than " + std::to_string(deepest) + " deep");
      place.text = text_begin();
      places.push_back(std::move(place));
      return;
    }
    fail(place.tag, "this tag is not closed");
  }

  // The first character of a text that is not a blank. The scanner itself stays where it is.
  Origin text_begin() {
    const auto at = at_;
    const auto line = line_, column = column_;
    const auto skip_blanks = [&] {
      while (at_ < source_.size() && blank_char(source_[at_])) advance();
    };
    skip_blanks();
    constexpr std::string_view cdata = "<![CDATA[";
    if (starts(cdata)) {
      for (std::size_t k = 0; k < cdata.size(); ++k) advance();
      skip_blanks();
    }
    const Origin out = here();
    at_ = at, line_ = line, column_ = column;
    return out;
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

  static bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  // Copies a comment that begins at `k` but for its last character. Returns the place of this character.
  std::size_t copy_comment(const std::string& value, std::size_t k) {
    const auto end = value.find("-->", k);
    const std::size_t last = end == std::string::npos ? value.size() - 1 : end + 2;
    expanded += value.substr(k, last - k), added_ += last - k;
    return last;
  }

  // Appends the value of an entity. Its elements have the place where the entity is used.
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
      if (value.compare(k, 4, "<!--") == 0) k = copy_comment(value, k);
      if (!in_value_ && value[k] == '<' && k + 1 < value.size() && begins_name(value[k + 1]))
        places.push_back({use, use, {}});
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
  bool in_value_ = false;  // of an attribute
  struct Open {
    std::string name;
    Origin origin;
  };
  std::vector<Open> open_;  // elements around the current place
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

  Statement convert(const tinyxml2::XMLElement& element) {
    static const TagPlace unknown;
    const TagPlace& place = next_ < places_.size() ? places_[next_] : unknown;
    ++next_;
    Statement s;
    s.name = element.Name();
    s.origin = place.tag;
    s.text_origin = place.text;
    std::size_t k = 0;
    for (const auto* a = element.FirstAttribute(); a; a = a->Next(), ++k) {
      const Origin at = k < place.attributes.size() ? place.attributes[k] : place.tag;
      s.attributes.push_back({a->Name(), trimmed(a->Value()), at});
    }
    std::string text;
    for (const auto* node = element.FirstChild(); node; node = node->NextSibling()) {
      if (const auto* child = node->ToElement()) s.children.push_back(convert(*child));
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
  return Converter(scanner.places).convert(*root);
}

}  // namespace tribo
