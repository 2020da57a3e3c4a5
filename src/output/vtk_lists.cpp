// SPDX-License-Identifier: MIT
/// Lists of files: the times of a run (.pvd) and the blocks of one time (.vtm). They are short texts, written and read
/// without VTK.

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/schema.hpp"
#include "base/text.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "output/output_queue.hpp"
#include "output/vtk.hpp"

#include <algorithm>
#include <optional>

namespace tribo {
namespace {

constexpr const char* list_head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"";

// A list of files with one <DataSet .../> per line.
class FileList {
 public:
  explicit FileList(const std::filesystem::path& path) : path_(path), text_(read_file(path)) {
    if (text_.find("</VTKFile>") == std::string::npos) fail("its end is missing");
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw FileError("the file '" + printable(path_.string()) + "' is damaged: " + why);
  }
  // Moves to the next entry; false if there is none.
  bool next() {
    while (begin_ < text_.size()) {
      const auto end = std::min(text_.find('\n', begin_), text_.size());
      line_ = text_.substr(begin_, end - begin_);
      begin_ = end + 1;
      if (line_.find("<DataSet") != std::string::npos) return true;
    }
    return false;
  }
  std::string value(const std::string& name) const {
    const auto at = line_.find(" " + name + "=\""), from = at + name.size() + 3;
    const auto stop = at == std::string::npos ? at : line_.find('"', from);
    if (stop == std::string::npos) fail(printable(line_));
    return line_.substr(from, stop - from);
  }
  bool has(const std::string& name) const { return line_.find(" " + name + "=\"") != std::string::npos; }
  double time() const {
    const auto time = to_number(value("timestep"));
    if (!time) fail("a time is no number: " + printable(line_));
    return *time;
  }
  std::filesystem::path file() const {
    const std::filesystem::path name = value("file");
    if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end())
      fail("a file lies outside the folder: " + printable(line_));
    return path_.parent_path() / name;
  }
  std::string line() const { return printable(line_); }

 private:
  std::filesystem::path path_;
  std::string text_, line_;
  std::size_t begin_ = 0;
};

}  // namespace

std::vector<CollectionEntry> read_collection(const std::filesystem::path& path) {
  std::vector<CollectionEntry> entries;
  for (FileList list(path); list.next();) {
    const double time = list.time();
    if (!entries.empty() && time < entries.back().time) list.fail("its times go back: " + list.line());
    entries.push_back({time, list.file(), list.has("name") ? list.value("name") : ""});
  }
  return entries;
}

std::vector<BlockEntry> read_blocks(const std::filesystem::path& path) {
  std::vector<BlockEntry> entries;
  for (FileList list(path); list.next();) {
    entries.push_back({list.value("name"), list.file()});
    if (entries.back().file.extension() != ".vtp") list.fail("a block is no file of particles: " + list.line());
  }
  return entries;
}

std::filesystem::path file_of_block(const std::filesystem::path& path, const OutputBlock& block) {
  return path.parent_path() / (path.stem().string() + "_" + std::to_string(block.number) +
                               (block.group.empty() ? "" : "_" + std::to_string(block.part)) + ".vtp");
}

void write_block_list(const std::filesystem::path& path, std::span<const OutputBlock> blocks) {
  std::string lines, group;
  std::size_t outer = 0, inner = 0;
  const auto close_group = [&] {
    if (!group.empty()) lines += "</Block>\n";
  };
  for (const OutputBlock& block : blocks) {
    if (block.group != group) {
      close_group();
      group = block.group, inner = 0;
      if (!group.empty())
        lines += "<Block index=\"" + std::to_string(outer++) + "\" name=\"" + escaped(group) + "\">\n";
    }
    lines += "<DataSet index=\"" + std::to_string(group.empty() ? outer++ : inner++) + "\" name=\"" +
             escaped(block.name) + "\" file=\"" + file_of_block(path, block).filename().string() + "\"/>\n";
  }
  close_group();
  write_atomically(path, list_head +
                             std::string("vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                                         "<vtkMultiBlockDataSet>\n") +
                             lines + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
}

void Collection::resume(double time) {
  lines_.clear(), count_ = 0;
  const auto entries = read_collection(path_);
  for (std::size_t k = 0; k < entries.size() && entries[k].time <= time;) {
    const double at = entries[k].time;
    std::vector<Part> parts;
    for (; k < entries.size() && entries[k].time == at; ++k)
      parts.push_back({entries[k].name, std::filesystem::relative(entries[k].file, path_.parent_path()).string()});
    append(at, parts);
  }
}

void Collection::append(double time, const std::vector<Part>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::string name = parts[k].name.empty() ? "" : " name=\"" + parts[k].name + "\"";
    lines_ += "<DataSet timestep=\"" + number_text(time) + "\" part=\"" + std::to_string(k) + "\"" + name + " file=\"" +
              parts[k].file + "\"/>\n";
  }
  ++count_;
}

void Collection::add(double time, const std::vector<Part>& parts, OutputQueue* queue) {
  append(time, parts);
  const std::string text = list_head +
                           std::string("Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n") +
                           lines_ + "</Collection>\n</VTKFile>\n";
  if (!queue) return write_atomically(path_, text);
  queue->add_version(path_.string(), text.size(), [path = path_, text] { write_atomically(path, text); });
}

}  // namespace tribo
