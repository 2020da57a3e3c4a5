// SPDX-License-Identifier: MIT
#include "output/provenance.hpp"

#include "base/error.hpp"
#include "output/atomic_file.hpp"

#include <libdeflate.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace tribo {
namespace {

std::string now() {
  const std::time_t t = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&t, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

std::string file_checksum(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint32_t crc = 0;
  for (std::array<char, 65536> piece{}; file;) {
    file.read(piece.data(), piece.size());
    crc = libdeflate_crc32(crc, piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  std::ostringstream out;
  out << "crc32:" << std::hex << crc;
  return out.str();
}

std::string version_text() {
  return std::string("tribo ") + TRIBO_VERSION + " (" + TRIBO_COMMIT + ", " + TRIBO_COMPILER + TRIBO_MARCH + ")";
}

Provenance::Provenance(std::filesystem::path path, std::string command_line, const std::filesystem::path& input,
                       int threads, std::map<std::string, std::string> facts)
    : path_(std::move(path)),
      command_line_(std::move(command_line)),
      input_(input.string()),
      input_checksum_(file_checksum(input)),
      started_(now()),
      threads_(threads),
      facts_(std::move(facts)) {}

void Provenance::write(const std::string& status, const std::string& reason, double time, long step) const {
  nlohmann::ordered_json record;
  record["program"] = version_text();
  record["command"] = command_line_;
  record["input"] = input_;
  record["input_checksum"] = input_checksum_;
  record["processor"] = processor();
  record["threads"] = threads_;
  record["started"] = started_;
  record["written"] = now();
  record["status"] = status;
  if (!reason.empty()) record["reason"] = reason;
  record["time"] = time;
  record["step"] = step;
  record["end_time"] = progress_.end_time;
  record["time_step"] = progress_.step;
  record["seconds"] = progress_.seconds;
  if (status == "running") record["seconds_left"] = progress_.seconds_left, record["process"] = ::getpid();
  for (const auto& [part, seconds] : progress_.seconds_of) record["seconds_of"][part] = seconds;
  if (!progress_.seconds_of.empty()) record["seconds_writing"] = progress_.seconds_writing;
  if (!remarks_.empty()) record["to_look_at"] = remarks_;
  if (!figures_.empty()) record["figures"] = figures_;
  for (const auto& [name, value] : facts_) record["model"][name] = value;
  for (const auto& [name, unit] : legend_.units) record["unit_of"][name] = unit;
  if (!legend_.materials.empty()) record["materials"] = legend_.materials;
  if (!legend_.rigid_materials.empty()) record["rigid_materials"] = legend_.rigid_materials;
  for (const auto& body : legend_.bodies)
    record["bodies"].push_back({{"name", body.name}, {"first", body.first}, {"last", body.last}});
  if (!legend_.block_groups.empty()) record["block_groups"] = legend_.block_groups;
  const std::string text = record.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  try {
    write_atomically(path_, text);
  } catch (const FileError&) {
    if (!write_over(path_, text)) throw;
  }
}

}  // namespace tribo
