// SPDX-License-Identifier: MIT
#include "output/vtk_xml.hpp"

#include "output/packing.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tribo {
namespace {

constexpr std::size_t block_size = std::size_t{256} << 10;

void put_word(std::string& to, std::size_t at, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::memcpy(to.data() + at, &word, sizeof word);
}

}  // namespace

std::string attribute(std::string_view name, std::string_view value) {
  std::string out = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out + '"';
}

VtkXml::VtkXml(std::string_view kind) : kind_(kind) {
  head_ = "<VTKFile type=\"" + kind_ +
          "\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
          "compressor=\"vtkZLibDataCompressor\">\n";
}

void VtkXml::tag(std::string_view name, std::string_view attributes) {
  last_ = data_.size();
  head_ += '<';
  head_ += name;
  head_ += ' ';
  head_ += attributes;
  head_ += " format=\"appended\" offset=\"" + std::to_string(last_) + "\"/>\n";
}

void VtkXml::add_array(std::string_view attributes, std::size_t rows, std::size_t row_bytes, const Fill& fill) {
  tag("DataArray", attributes);
  append_rows(rows, row_bytes, fill);
}

void VtkXml::add_texts(std::string_view attributes, std::string_view texts) {
  tag("Array", attributes);
  append_rows(texts.size(), 1,
              [&](std::size_t first, std::span<char> to) { std::memcpy(to.data(), texts.data() + first, to.size()); });
}

void VtkXml::add_packed(std::string_view attributes, std::string_view packed) {
  tag("DataArray", attributes);
  data_ += packed;
}

// Number of blocks, their size, the size of the last one if it is smaller, the packed sizes, the packed blocks.
void VtkXml::append_rows(std::size_t rows, std::size_t row_bytes, const Fill& fill) {
  static thread_local Packer packer;
  static thread_local std::vector<char> block(block_size);
  constexpr std::size_t word = sizeof(std::uint32_t);
  const std::size_t rows_of_block = block_size / row_bytes, blocks = (rows + rows_of_block - 1) / rows_of_block;
  const std::size_t head = data_.size(), rest = rows % rows_of_block;
  data_.resize(head + (3 + blocks) * word);
  put_word(data_, head, blocks);
  put_word(data_, head + word, blocks == 0 ? 0 : rows_of_block * row_bytes);
  put_word(data_, head + 2 * word, rest * row_bytes);
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t first = k * rows_of_block, count = std::min(rows_of_block, rows - first);
    const std::span<char> part(block.data(), count * row_bytes);
    fill(first, part);
    put_word(data_, head + (3 + k) * word, packer.append(data_, {part.data(), part.size()}));
  }
}

std::string VtkXml::finish() {
  head_ += "</" + kind_ + ">\n<AppendedData encoding=\"raw\">\n_";
  std::string out;
  out.reserve(head_.size() + data_.size() + 64);
  out += head_;
  out += data_;
  out += "\n</AppendedData>\n</VTKFile>\n";
  return out;
}

}  // namespace tribo
