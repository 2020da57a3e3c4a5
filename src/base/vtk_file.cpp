// SPDX-License-Identifier: MIT
#include "base/vtk_file.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/schema.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace tribo {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string_view without_blanks_around(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// The six bits of a character of base 64; 64 for '=' and -1 for any other character.
int bits_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return c == '=' ? 64 : -1;
}

/// The bytes of an array from its begin on: as they are, or in base 64, of which each part may end with '='.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// The next bytes; fewer if there are no more.
  std::string take(std::size_t count) {
    if (!base64_) {
      const std::string out(text_.substr(0, count));
      text_.remove_prefix(out.size());
      return out;
    }
    while (ready_.size() < count && decode_group()) {
    }
    std::string out = ready_.substr(0, count);
    ready_.erase(0, out.size());
    return out;
  }
  /// An upper bound of the bytes that are left.
  std::size_t left() const { return base64_ ? ready_.size() + text_.size() / 4 * 3 + 3 : text_.size(); }

 private:
  bool decode_group() {
    std::array<int, 4> group{};
    std::size_t at = 0;
    for (int& bits : group) {
      while (at < text_.size() && is_blank(text_[at])) ++at;
      bits = at < text_.size() ? bits_of(text_[at++]) : -1;
      if (bits < 0) return false;
    }
    if (group[0] == 64 || group[1] == 64) return false;
    text_.remove_prefix(at);
    const int padding = (group[2] == 64) + (group[3] == 64);
    const unsigned all = static_cast<unsigned>(group[0]) << 18U | static_cast<unsigned>(group[1]) << 12U |
                         (static_cast<unsigned>(group[2]) & 63U) << 6U | (static_cast<unsigned>(group[3]) & 63U);
    for (int k = 0; k < 3 - padding; ++k)
      ready_ += static_cast<char>(all >> (16U - 8U * static_cast<unsigned>(k)) & 255U);
    return true;
  }

  std::string_view text_;
  bool base64_;
  std::string ready_;
};

// Numbers of the head of data, of `size` bytes each.
std::size_t number_at(std::string_view bytes, std::size_t index, std::size_t size) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + index * size, size);
  return static_cast<std::size_t>(value);
}

}  // namespace

VtkFile::VtkFile(const std::filesystem::path& path) : name_(printable(path.string())), text_(read_file(path)) {
  const std::string_view text = text_;
  const auto appended = text.find("<AppendedData"), begin = text.find('_', text.find('>', appended));
  if (appended != std::string_view::npos) {
    if (begin == std::string_view::npos) fail("its data are missing");
    appended_ = text.substr(begin + 1);
    const std::string encoding = word(words_of_tag(text.substr(appended, begin - appended)), "encoding");
    appended_as_text_ = encoding == "base64";
    if (!appended_as_text_ && encoding != "raw") fail("its data are encoded as '" + printable(encoding) + "'");
  }
  read_tags(text.substr(0, appended));
  if (kind_.empty()) fail("it is not an XML file of VTK");
}

void VtkFile::fail(const std::string& why) const { throw FileError("the file '" + name_ + "' is damaged: " + why); }

const VtkFile::DataArray* VtkFile::find(std::string_view section, std::string_view name) const {
  for (const DataArray& a : arrays_)
    if (a.section == section && word(a.words, "Name") == name) return &a;
  return nullptr;
}

const VtkFile::DataArray* VtkFile::first(std::string_view section) const {
  for (const DataArray& a : arrays_)
    if (a.section == section) return &a;
  return nullptr;
}

int VtkFile::components(const DataArray& array) const {
  const auto n = whole(array.words, "NumberOfComponents", 1);
  if (n < 1 || n > 64) fail("an array has " + std::to_string(n) + " components");
  return static_cast<int>(n);
}

std::string VtkFile::word(const Words& words, std::string_view name) {
  const auto found = words.find(name);
  return found == words.end() ? std::string() : found->second;
}

std::vector<double> VtkFile::numbers(const DataArray& array, std::size_t count) const {
  if (count > std::size_t{1} << 40) fail("it claims " + std::to_string(count) + " numbers");
  if (word(array.words, "format") == "ascii") return written_numbers(array, count);
  const std::string type = word(array.words, "type");
  if (type == "Float64") return as<double>(array, count);
  if (type == "Float32") return as<float>(array, count);
  if (type == "Int64") return as<std::int64_t>(array, count);
  if (type == "UInt64") return as<std::uint64_t>(array, count);
  if (type == "Int32") return as<std::int32_t>(array, count);
  if (type == "UInt32") return as<std::uint32_t>(array, count);
  if (type == "Int16") return as<std::int16_t>(array, count);
  if (type == "UInt16") return as<std::uint16_t>(array, count);
  if (type == "Int8") return as<std::int8_t>(array, count);
  if (type == "UInt8") return as<std::uint8_t>(array, count);
  fail("an array has the unknown type '" + printable(type) + "'");
}

// The attributes of the first element
void VtkFile::read_head(const Words& all) {
  kind_ = word(all, "type");
  const std::string header = word(all, "header_type"), compressor = word(all, "compressor"),
                    order = word(all, "byte_order");
  if (!header.empty() && header != "UInt32" && header != "UInt64")
    fail("the numbers before its data are '" + printable(header) + "'");
  header_ = header == "UInt64" ? 8 : 4;
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor")
    fail("its data are compressed by '" + printable(compressor) + "', not by zlib");
  if (order != "LittleEndian") fail("its bytes are not in the order LittleEndian");
}

// Tags of the head; an array belongs to the section around it.
void VtkFile::read_tags(std::string_view head) {
  std::string section;
  bool open = false;  // inside of an array, where its own keys may follow its data
  for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at + 1)) {
    const auto end = head.find('>', at);
    if (end == std::string_view::npos) fail("its head is cut off");
    const std::string_view tag = head.substr(at + 1, end - at - 1);
    if (open) {
      open = tag.substr(0, 10) != "/DataArray";
      continue;
    }
    const std::string name(tag.substr(0, tag.find_first_of(" \t\r\n/")));
    if (name.empty() || name[0] == '?' || name[0] == '!') continue;
    if (name == "VTKFile") {
      read_head(words_of_tag(tag));
    } else if (name == "Piece") {
      if (!piece_.empty()) fail("it has several pieces");
      piece_ = words_of_tag(tag);
    } else if (name == "Array" || name == "InformationKey") {
      // texts, and the unit of an array
    } else if (name == "DataArray") {
      arrays_.push_back({section, words_of_tag(tag)});
      open = tag.back() != '/';
      if (open) arrays_.back().content = without_blanks_around(head.substr(end + 1, head.find('<', end) - end - 1));
    } else {
      section = name;
    }
  }
}

// name="value" pairs
VtkFile::Words VtkFile::words_of_tag(std::string_view tag) const {
  Words out;
  for (auto equals = tag.find("=\""); equals != std::string_view::npos;) {
    const auto end = tag.find('"', equals + 2);
    if (end == std::string_view::npos) fail("its head is cut off");
    auto name = tag.substr(0, equals);
    name = name.substr(name.find_last_of(" \t\r\n") + 1);
    out[std::string(name)] = std::string(tag.substr(equals + 2, end - equals - 2));
    tag = tag.substr(end + 1);
    equals = tag.find("=\"");
  }
  return out;
}

std::size_t VtkFile::whole(const Words& words, std::string_view name, std::size_t fallback) const {
  const auto found = words.find(name);
  if (found == words.end()) return fallback;
  const auto value = to_number(found->second);
  if (!value || !(*value >= 0) || *value > 1e15 || *value != std::trunc(*value))
    fail("'" + std::string(name) + "' is '" + printable(found->second) + "'");
  return static_cast<std::size_t>(*value);
}

// Uncompressed: number of bytes, bytes. Compressed: number of blocks, size of a block, size of the last one if it is
// smaller, compressed sizes, blocks.
std::string VtkFile::bytes(const DataArray& array, std::size_t wanted) const {
  const std::string format = word(array.words, "format"),
                    name = "the array '" + printable(word(array.words, "Name")) + "'";
  std::string_view from = array.content;
  if (format == "appended") {
    const std::size_t offset = whole(array.words, "offset", 0);
    if (offset > appended_.size()) fail(name + " is cut off");
    from = appended_.substr(offset);
  } else if (format != "binary") {
    fail(name + " has the unknown format '" + printable(format) + "'");
  }
  ByteStream stream(from, format == "binary" || appended_as_text_);
  const auto take = [&](std::size_t count) {
    std::string out = count > stream.left() ? std::string() : stream.take(count);
    if (out.size() != count) fail(name + " is cut off");
    return out;
  };
  if (!compressed_) {
    if (wanted == 0 && stream.left() < header_) return {};
    if (number_at(take(header_), 0, header_) != wanted) fail(name + " has another size than the file says");
    return take(wanted);
  }

  const std::size_t blocks = number_at(take(header_), 0, header_);
  if (blocks == 0 && wanted == 0) return {};
  const std::string sizes = take(2 * header_);
  const std::size_t size = number_at(sizes, 0, header_), partial = number_at(sizes, 1, header_);
  if (blocks == 0 || blocks > stream.left() / header_ || size == 0 || size > wanted + (std::size_t{1} << 24) ||
      blocks - 1 > wanted / size || partial >= size || (blocks - 1) * size + (partial > 0 ? partial : size) != wanted)
    fail(name + " has another size than the file says");
  // zlib cannot make data smaller than by a factor of about a thousand.
  if (wanted / 1100 > stream.left()) fail(name + " is cut off");
  const std::string packed_sizes = take(blocks * header_);
  std::string out(wanted, '\0');
  std::size_t to = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t plain = k + 1 == blocks && partial > 0 ? partial : size;
    const std::string packed = take(number_at(packed_sizes, k, header_));
    auto unpacked = static_cast<uLongf>(plain);
    if (::uncompress(reinterpret_cast<Bytef*>(out.data() + to), &unpacked,
                     reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size())) != Z_OK ||
        unpacked != plain)
      fail(name + " cannot be unpacked");
    to += plain;
  }
  return out;
}

std::vector<double> VtkFile::written_numbers(const DataArray& array, std::size_t count) const {
  const std::string name = "the array '" + printable(word(array.words, "Name")) + "'";
  if (count > array.content.size()) fail(name + " is cut off");
  std::vector<double> out;
  out.reserve(count);
  for (std::string_view rest = array.content; !rest.empty();) {
    const auto end = std::find_if(rest.begin(), rest.end(), is_blank);
    const std::string_view text = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    const auto value = to_number(text);
    if (!value) fail(name + " contains '" + printable(std::string(text)) + "'");
    if (out.size() == count) fail(name + " has another size than the file says");
    out.push_back(*value);
    rest.remove_prefix(text.size());
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  }
  if (out.size() != count) fail(name + " has another size than the file says");
  return out;
}

template <class T>
std::vector<double> VtkFile::as(const DataArray& array, std::size_t count) const {
  const std::string raw = bytes(array, count * sizeof(T));
  std::vector<double> out(count);
  for (std::size_t k = 0; k < count; ++k) {
    T value;
    std::memcpy(&value, raw.data() + k * sizeof(T), sizeof(T));
    out[k] = static_cast<double>(value);
  }
  return out;
}

}  // namespace tribo
