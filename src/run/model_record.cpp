// SPDX-License-Identifier: MIT
#include "run/model_record.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/provenance.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace tribo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;

constexpr const char* record_name = "tribo-model.json";

Lines lines_of(const std::string& text) {
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with('\r')) line.pop_back();
    out.push_back(line);
  }
  return out;
}

std::map<std::string, std::string> checksums(const Model& model) {
  std::map<std::string, std::string> out;
  for (const std::string& name : model.data_files) out[name] = file_checksum(fs::path(model.file).parent_path() / name);
  return out;
}

// Lines that are not in both lists, in order, from the longest common subsequence.
Lines difference(const Lines& a, const Lines& b) {
  constexpr std::size_t most_cells = 4000000;
  std::size_t begin = 0, end_a = a.size(), end_b = b.size();
  while (begin < end_a && begin < end_b && a[begin] == b[begin]) ++begin;
  while (end_a > begin && end_b > begin && a[end_a - 1] == b[end_b - 1]) --end_a, --end_b;
  const std::size_t rows = end_a - begin, columns = end_b - begin;
  std::vector<std::uint32_t> common;  // number of common lines from (i, j) on
  const bool small = (rows + 1) * (columns + 1) <= most_cells;
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& { return common[i * (columns + 1) + j]; };
  if (small) {
    common.assign((rows + 1) * (columns + 1), 0);
    for (std::size_t i = rows; i-- > 0;)
      for (std::size_t j = columns; j-- > 0;)
        at(i, j) = a[begin + i] == b[begin + j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
  }
  Lines out;
  std::size_t i = 0, j = 0;
  while (i < rows || j < columns) {
    if (i < rows && j < columns && a[begin + i] == b[begin + j]) {
      ++i, ++j;
    } else if (i < rows && (j == columns || !small || at(i + 1, j) >= at(i, j + 1))) {
      out.push_back(std::to_string(begin + i + 1) + ": - " + a[begin + i]), ++i;
    } else {
      out.push_back(std::to_string(begin + j + 1) + ": + " + b[begin + j]), ++j;
    }
  }
  return out;
}

// A name that is not UTF-8, which JSON could not hold, as a list of its bytes.
Json name_record(const std::string& name) {
  try {
    (void)Json(name).dump();
    return name;
  } catch (const Json::type_error&) {
    return std::vector<int>(name.begin(), name.end());
  }
}

std::string name_of(const Json& record) {
  if (record.is_string()) return record.get<std::string>();
  std::string out;
  for (const int byte : record.get<std::vector<int>>()) out += static_cast<char>(byte);
  return out;
}

}  // namespace

fs::path copy_of_model(const fs::path& folder) { return folder / "tribo-model.xml"; }

void write_model_record(const fs::path& folder, const Model& model) {
  const fs::path file = fs::absolute(model.file);
  std::error_code none;
  const fs::path relative = fs::relative(file, folder, none);
  Json record;
  record["file"] = name_record(file.string()), record["relative"] = name_record(relative.string());
  record["settings"] = model.settings, record["data"] = checksums(model);
  record["lines"] = lines_of(model.source);
  write_atomically(copy_of_model(folder), model.meaning);
  write_atomically(folder / record_name, record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

ModelRecord read_model_record(const fs::path& folder) {
  if (!fs::exists(folder / record_name))
    throw FileError("'" + folder.string() + "' is not the folder of a run of this version: it has no " + record_name);
  const Json record = Json::parse(read_file(folder / record_name), nullptr, false);
  const std::string meaning = read_file(copy_of_model(folder));
  try {
    return {name_of(record.at("file")),
            name_of(record.at("relative")),
            record.at("settings").get<std::map<std::string, std::string>>(),
            record.at("lines").get<Lines>(),
            meaning,
            record.at("data").get<std::map<std::string, std::string>>()};
  } catch (const Json::exception&) {
    throw FileError("'" + (folder / record_name).string() + "' is damaged");
  }
}

std::vector<std::string> changes(const ModelRecord& record, const Model& now) {
  Lines out;
  if (record.meaning != now.meaning) {
    out = difference(record.lines, lines_of(now.source));
    if (out.empty()) out = difference(lines_of(record.meaning), lines_of(now.meaning));
  }
  const auto data = checksums(now);
  for (const auto& [name, sum] : data)
    if (const auto old = record.data.find(name); old != record.data.end() && old->second != sum)
      out.push_back("the file '" + name + "' has other contents");
  return out;
}

}  // namespace tribo
