// SPDX-License-Identifier: MIT
/// Files of named arrays, from which a run continues to the bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tribo {

class CheckpointWriter {
 public:
  /// Keeps copies of the entries, until they are saved.
  CheckpointWriter() = default;
  /// Numbers must be finite: throws SimulationError with the name if one is not.
  void put(const std::string& name, std::span<const double> values);
  void put(const std::string& name, std::span<const std::int64_t> values);
  void put(const std::string& name, const std::string& text);
  void put(const std::string& name, double value) { put(name, std::span<const double>(&value, 1)); }
  void put(const std::string& name, std::int64_t value) { put(name, std::span<const std::int64_t>(&value, 1)); }
  /// Throws FileError.
  void save(const std::filesystem::path& path) const;
  /// Bytes of the file.
  std::size_t size() const;
  /// The same bytes as those of the file.
  std::vector<std::byte> bytes() const;

 private:
  friend class Checkpoint;
  friend std::function<void()> begin_checkpoint(const std::filesystem::path& path,
                                                const std::function<void(CheckpointWriter&)>& put_all);
  struct Entry {
    std::string name;
    char kind;
    std::string bytes;
  };
  /// Writes the entries to a file at once, and keeps none.
  explicit CheckpointWriter(std::ostream& file) : file_(&file) {}
  void entry(const std::string& name, char kind, const void* data, std::size_t bytes);
  template <class F>
  void as_file(F&& f) const;
  std::vector<Entry> entries_;
  std::ostream* file_ = nullptr;
};

/// Writes a checkpoint while `put_all` puts its entries, without a copy of them. Throws FileError.
void write_checkpoint(const std::filesystem::path& path, const std::function<void(CheckpointWriter&)>& put_all);
/// The same, but the checkpoint is flushed to the disk and gets its name by the function that is returned.
std::function<void()> begin_checkpoint(const std::filesystem::path& path,
                                       const std::function<void(CheckpointWriter&)>& put_all);

class Checkpoint {
 public:
  /// Reads and checks everything. Throws FileError with the reason: not a checkpoint, another version, cut off, or the
  /// name of the damaged entry.
  explicit Checkpoint(const std::filesystem::path& path);
  /// What has been put into a writer, without a file.
  explicit Checkpoint(const CheckpointWriter& writer);
  /// From the bytes of a file.
  explicit Checkpoint(std::span<const std::byte> file);
  bool has(const std::string& name) const { return entries_.count(name) > 0; }
  std::vector<std::string> names() const;
  /// True if an entry has the same kind and the same bytes in another checkpoint; both must have it.
  bool same(const Checkpoint& other, const std::string& name) const;
  /// Throw FileError if there is no such entry of this kind.
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::string text(const std::string& name) const;
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  /// Bytes of all entries: no list in it can be longer.
  std::size_t bytes() const;

 private:
  struct Entry {
    char kind;
    std::string bytes;
  };
  void read(std::string_view all, std::size_t at);
  const Entry& entry(const std::string& name, char kind) const;
  template <class T>
  std::vector<T> numbers(const std::string& name, char kind) const;
  std::string path_;
  std::map<std::string, Entry> entries_;
};

}  // namespace tribo
