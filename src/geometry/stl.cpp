// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "geometry/file.hpp"
#include "geometry/region.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace tribo {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

// Format: 80 bytes of text, the number of facets, then 50 bytes per facet: normal, three corners, two attribute bytes.
constexpr std::size_t head = 84, record = 50;

Triangles read_binary(const Bytes& bytes, std::size_t count) {
  Triangles out(count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t i = 0; i < 3; ++i) {
        const float x = std::bit_cast<float>(bytes.word(head + record * k + 12 + 12 * corner + 4 * i));
        if (!std::isfinite(x))
          bytes.fail("facet " + std::to_string(k + 1) + " has a coordinate that is not a finite number");
        out[k][corner][static_cast<Eigen::Index>(i)] = static_cast<double>(x);
      }
  return out;
}

// Words of an ASCII file, with their lines.
class Words {
 public:
  explicit Words(const Bytes& bytes) : bytes_(bytes), text_(bytes.text()) {}

  std::string_view next() {
    while (at_ < text_.size() && blank(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t start = at_;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  void expect(std::string_view wanted) {
    const auto word = next();
    if (!same(word, wanted)) fail("'" + std::string(wanted) + "' is expected, not " + shown(word));
  }
  double number() {
    const auto word = next();
    const auto value = to_number(word);
    if (!value) fail("a number is expected, not " + shown(word));
    return *value;
  }
  static bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if ((a[i] | 32) != (b[i] | 32)) return false;
    return true;
  }
  [[noreturn]] void fail(const std::string& message) const {
    bytes_.fail("line " + std::to_string(line_) + ": " + message);
  }
  static std::string shown(std::string_view word) {
    return word.empty() ? "the end of the file" : "'" + std::string(word.substr(0, 40)) + "'";
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  const Bytes& bytes_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

Triangles read_ascii(const Bytes& bytes) {
  Triangles out;
  Words words(bytes);
  for (auto solid = words.next(); !solid.empty(); solid = words.next()) {  // a file may contain several solids
    if (!Words::same(solid, "solid")) words.fail("'solid' is expected, not " + Words::shown(solid));
    words.skip_line();
    for (;;) {
      const auto word = words.next();
      if (Words::same(word, "endsolid")) break;
      if (!Words::same(word, "facet")) words.fail("'facet' or 'endsolid' is expected, not " + Words::shown(word));
      words.expect("normal");
      for (int i = 0; i < 3; ++i) words.next();  // the normal is computed from the corners; some files contain nan
      words.expect("outer");
      words.expect("loop");
      auto& triangle = out.emplace_back();
      for (auto& corner : triangle) {
        words.expect("vertex");
        for (int i = 0; i < 3; ++i) corner[i] = words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
    }
    words.skip_line();
  }
  return out;
}

}  // namespace

std::vector<std::array<Vec3, 3>> read_stl(const std::string& path) {
  const Bytes bytes(path);
  // Binary files may also begin with "solid"; they are recognised by their length.
  if (bytes.size() >= head && (bytes.size() - head) % record == 0 && bytes.word(80) == (bytes.size() - head) / record)
    return read_binary(bytes, bytes.word(80));
  const auto text = bytes.text();
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && Words::same(text.substr(first, 5), "solid")) return read_ascii(bytes);
  if (bytes.size() >= head)
    bytes.fail("this is not an STL file, or it is truncated: a binary file of " + counted(bytes.word(80), "facet") +
               " has " + std::to_string(head + record * std::size_t{bytes.word(80)}) + " bytes, not " +
               std::to_string(bytes.size()));
  bytes.fail("this is not an STL file: it neither begins with 'solid' nor has the 84 bytes of a binary head");
}

}  // namespace tribo
