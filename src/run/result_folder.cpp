// SPDX-License-Identifier: MIT
#include "run/result_folder.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"
#include "output/provenance.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace tribo {
namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = "tribo-run.json";

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Versions without a list of their own replaced all of these without a question.
const ResultNames names_of_old_runs{{"run.pvd", "grid.pvd", "cracks.pvd", "joints.pvd", "blocks.pvd", "contacts.pvd",
                                     "events.csv", "tips.csv", "block_events.csv", "block_energy.csv", "history.csv",
                                     "energy.csv", "safety.csv", "checkpoint.bin", "provenance.json", "model.path"},
                                    {"particles", "grid", "cracks", "joints", "blocks", "contacts"}};

nlohmann::json read_json(const fs::path& file) {
  try {
    return nlohmann::json::parse(read_file(file), nullptr, false);
  } catch (const FileError&) {  // missing, or a pipe, which would wait
    return nlohmann::json::value_t::discarded;
  }
}

// Names of files in the folder itself only, whatever the list says.
std::vector<std::string> plain_names(const nlohmann::json& list, const fs::path& file) {
  std::vector<std::string> out;
  for (const auto& entry : list) {
    const std::string name = entry.is_string() ? entry.get<std::string>() : "";
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
      throw FileError("'" + file.string() + "' is damaged; choose another folder with --output");
    out.push_back(name);
  }
  return out;
}

// What runs have made in the folder; nothing if it is not that of a run.
std::optional<ResultNames> made_by_runs(const fs::path& folder) {
  const fs::path file = folder / list_name;
  if (fs::exists(file)) {
    const auto record = read_json(file);
    if (!record.is_object() || !record.contains("files") || !record.contains("frames"))
      throw FileError("'" + file.string() + "' is damaged; choose another folder with --output");
    return ResultNames{plain_names(record["files"], file), plain_names(record["frames"], file)};
  }
  const auto record = read_json(folder / "provenance.json");
  if (record.is_object() && record.contains("status") && record.value("program", "").starts_with("tribo "))
    return names_of_old_runs;
  return std::nullopt;
}

// A file with a number, or one that a killed run has not completed.
bool is_frame(std::string name) {
  if (name.starts_with('.')) {
    const auto at = name.find(".writing.");
    if (at == std::string::npos) return false;
    name = name.substr(1, at - 1) + name.substr(at + 8);
  }
  const auto dot = name.find('.');
  if (!name.starts_with("run_") || dot == std::string::npos || dot < 10) return false;
  std::string digits = name.substr(4, dot - 4);
  const std::string extension = name.substr(dot);
  // run_000012_3.vtp and run_000012_3_1.vtp are blocks of run_000012.vtm.
  for (int level = 0; level < 2; ++level)
    if (const auto block = digits.find('_'); block != std::string::npos && block >= 6 && block + 1 < digits.size())
      digits.erase(block, 1);
  return std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }) &&
         (extension == ".vtp" || extension == ".vti" || extension == ".vtm");
}

// Removes a file or a link, but no folder.
void remove_file(const fs::path& file) {
  std::error_code error;
  const auto type = fs::symlink_status(file, error).type();
  if (type == fs::file_type::not_found || type == fs::file_type::directory) return;
  fs::remove(file, error);
  if (error) throw FileError("cannot remove '" + file.string() + "': " + error.message());
}

// What occupies a place that a run will write to, and was not made by a run.
std::vector<std::string> in_the_way(const fs::path& folder, const ResultNames& wanted, const ResultNames& made) {
  std::vector<std::string> out;
  const auto look = [&](const std::vector<std::string>& names, const std::vector<std::string>& of, bool as_folder) {
    for (const std::string& name : names) {
      const auto type = fs::symlink_status(folder / name).type();
      if (type == fs::file_type::not_found) continue;
      if (!contains(of, name) || (type == fs::file_type::directory) != as_folder ||
          (as_folder && type == fs::file_type::symlink))
        out.push_back("'" + name + "'");
    }
  };
  look(wanted.files, made.files, false), look(wanted.frames, made.frames, true);
  return out;
}

[[noreturn]] void fail_to_create(const fs::path& path, const std::error_code& error) {
  throw FileError("cannot create '" + path.string() + "': " + error.message());
}

}  // namespace

std::string numbered(std::int64_t number, const std::string& extension) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "run_%06lld", static_cast<long long>(number));
  return digits + extension;
}

void ResultNames::add(const ResultNames& other) {
  for (const auto& [to, from] : {std::pair(&files, &other.files), std::pair(&frames, &other.frames)})
    for (const std::string& name : *from)
      if (!contains(*to, name)) to->push_back(name);
}

void refuse_used_folder(const fs::path& folder) {
  if (made_by_runs(folder)) throw UsedFolderError(folder);
}

UsedFolderError::UsedFolderError(const fs::path& folder)
    : FileError("'" + folder.string() +
                "' already holds a run; pass --overwrite to replace it, --output DIR for another folder, or use "
                "'tribo resume'"),
      folder_(folder.string()) {}

ResultFolder::ResultFolder(fs::path path) : path_(std::move(path)) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path p = path_; !p.empty() && !fs::exists(fs::symlink_status(p, error)); p = p.parent_path())
    if (p.has_filename()) missing.push_back(p);
  const auto undo = [&] {
    for (auto p = created_.rbegin(); p != created_.rend(); ++p) fs::remove(*p, error);
  };
  for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
    fs::create_directory(*p, error);
    if (error) {
      const auto reason = error;
      undo();
      fail_to_create(path_, reason);
    }
    created_.push_back(*p);
  }
  if (!fs::is_directory(path_, error))
    throw FileError("'" + path_.string() + "' is not a folder; choose another one with --output");
  try {
    lock_.emplace(path_);
  } catch (...) {
    undo();
    throw;
  }
}

ResultFolder::~ResultFolder() {
  lock_.reset();
  std::error_code ignored;
  for (auto p = created_.rbegin(); p != created_.rend(); ++p) fs::remove(*p, ignored);
}

void ResultFolder::start(ResultNames names, bool overwrite) {
  if (!overwrite) refuse_used_folder(path_);
  names.add({{list_name, FolderLock::file_name}, {}});
  ResultNames made = made_by_runs(path_).value_or(ResultNames{});
  made.files.emplace_back(FolderLock::file_name);  // otherwise it could not be locked
  const auto foreign = in_the_way(path_, names, made);
  if (!foreign.empty())
    throw FileError("'" + path_.string() + "' holds " + join(foreign) +
                    ", not made by a run, where this run would write: nothing was changed; move what is in the way, or "
                    "choose another folder with --output");
  remove_results(made);
  for (const std::string& part : made.frames)  // what else they hold is not of a run, but the folders are
    if (fs::is_directory(fs::symlink_status(path_ / part))) names.add({{}, {part}});
  nlohmann::ordered_json record;
  record["program"] = version_text();
  record["meaning"] =
      "made by runs of Tribo: these files, and the files run_NUMBER in these folders; --overwrite removes nothing else";
  record["files"] = names.files, record["frames"] = names.frames;
  write_atomically(path_ / list_name, record.dump(2) + "\n");
  lock_->keep(), created_.clear();
  remove_file(path_ / "provenance.json");
  for (const std::string& part : names.frames) {
    std::error_code error;
    fs::create_directory(path_ / part, error);
    if (error) fail_to_create(path_ / part, error);
  }
}

// The list is replaced by that of the new run later: if this is killed, the folder can still be replaced.
void ResultFolder::remove_results(const ResultNames& made) const {
  std::error_code error;
  for (const std::string& part : made.frames) {
    const fs::path folder = path_ / part;
    if (!fs::is_directory(fs::symlink_status(folder, error))) continue;
    std::vector<fs::path> frames;
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_frame(entry.path().filename().string())) frames.push_back(entry.path());
    for (const fs::path& frame : frames) remove_file(frame);
    fs::remove(folder, error);  // fails if something else is in it
  }
  for (const std::string& name : made.files) {
    if (name == list_name || name == FolderLock::file_name || name == "provenance.json") continue;
    remove_file(path_ / name), remove_file(temporary_of(path_ / name));
  }
}

void ResultFolder::require_checkpoint() {
  created_.clear();
  if (!fs::exists(path_ / "checkpoint.bin"))
    throw FileError("'" + path_.string() + "' has no checkpoint.bin to resume from");
  lock_->keep();
}

}  // namespace tribo
