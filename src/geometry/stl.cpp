// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "base/text.hpp"
#include "geometry/file.hpp"
#include "geometry/file_words.hpp"
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

Triangles read_ascii(const Bytes& bytes) {
  Triangles out;
  FileWords words(bytes);
  for (auto solid = words.next(); !solid.empty(); solid = words.next()) {  // a file may contain several solids
    if (!FileWords::same(solid, "solid")) words.fail("'solid' is expected, not " + FileWords::shown(solid));
    words.skip_line();
    for (;;) {
      const auto word = words.next();
      if (FileWords::same(word, "endsolid")) break;
      if (!FileWords::same(word, "facet"))
        words.fail("'facet' or 'endsolid' is expected, not " + FileWords::shown(word));
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
  if (first != std::string_view::npos && FileWords::same(text.substr(first, 5), "solid")) return read_ascii(bytes);
  if (bytes.size() >= head)
    bytes.fail("this is not an STL file, or it is truncated: a binary file of " + counted(bytes.word(80), "facet") +
               " has " + std::to_string(head + record * std::size_t{bytes.word(80)}) + " bytes, not " +
               std::to_string(bytes.size()));
  bytes.fail("this is not an STL file: it neither begins with 'solid' nor has the 84 bytes of a binary head");
}

}  // namespace tribo
