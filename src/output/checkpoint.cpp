// SPDX-License-Identifier: MIT
#include "output/checkpoint.hpp"

#include "base/error.hpp"
#include "base/finite.hpp"
#include "base/read_file.hpp"
#include "output/atomic_file.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <fstream>
#include <string_view>
#include <vector>

namespace tribo {
namespace {

// Layout: magic, then per entry: kind, name length, byte count, name, bytes, CRC-32 of name and bytes; the end has kind
// 0.
constexpr std::string_view magic = "Tribo checkpoint 2\n";

std::uint32_t checksum(std::string_view name, std::string_view bytes) {
  const std::uint32_t of_name = libdeflate_crc32(0, name.data(), name.size());
  if (bytes.empty()) return of_name;  // their pointer may be null, for which libdeflate returns another number
  return libdeflate_crc32(of_name, bytes.data(), bytes.size());
}

template <class T>
void append(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// What comes before the bytes of an entry.
std::string head_of(char kind, const std::string& name, std::size_t bytes) {
  std::string out;
  append(out, kind);
  append(out, static_cast<std::uint64_t>(name.size()));
  append(out, static_cast<std::uint64_t>(bytes));
  return out + name;
}

}  // namespace

void CheckpointWriter::entry(const std::string& name, char kind, const void* data, std::size_t bytes) {
  const std::string_view content(static_cast<const char*>(data), bytes);
  if (!file_) {
    entries_.push_back({name, kind, std::string(content)});
    return;
  }
  std::string end;
  append(end, checksum(name, content));
  *file_ << head_of(kind, name, bytes) << content << end;
}

void CheckpointWriter::put(const std::string& name, std::span<const double> values) {
  if (!all_finite(values))
    throw SimulationError("'" + name + "' of the state is not a number; no checkpoint is written");
  entry(name, 'd', values.data(), values.size_bytes());
}
void CheckpointWriter::put(const std::string& name, std::span<const std::int64_t> values) {
  entry(name, 'i', values.data(), values.size_bytes());
}
void CheckpointWriter::put(const std::string& name, const std::string& text) {
  entry(name, 't', text.data(), text.size());
}

std::size_t CheckpointWriter::size() const {
  std::size_t sum = magic.size() + 1;
  for (const Entry& e : entries_)
    sum += 1 + 2 * sizeof(std::uint64_t) + e.name.size() + e.bytes.size() + sizeof(std::uint32_t);
  return sum;
}

// Calls f(parts of the file).
template <class F>
void CheckpointWriter::as_file(F&& f) const {
  std::string head(magic);
  std::deque<std::string> heads;  // what comes before the bytes of an entry, with the check sum of the former one
  std::vector<std::string_view> parts;
  for (const Entry& e : entries_) {
    head += head_of(e.kind, e.name, e.bytes.size());
    parts.emplace_back(heads.emplace_back(std::move(head)));
    parts.emplace_back(e.bytes);
    head.clear();
    append(head, checksum(e.name, e.bytes));
  }
  head += '\0';
  parts.emplace_back(head);
  f(parts);
}

void CheckpointWriter::save(const std::filesystem::path& path) const {
  as_file([&](const auto& parts) { write_atomically(path, parts); });
}

std::vector<std::byte> CheckpointWriter::bytes() const {
  std::vector<std::byte> out;
  as_file([&](const auto& parts) {
    for (const std::string_view part : parts) {
      const auto bytes = std::as_bytes(std::span(part));
      out.insert(out.end(), bytes.begin(), bytes.end());
    }
  });
  return out;
}

void write_checkpoint(const std::filesystem::path& path, const std::function<void(CheckpointWriter&)>& put_all) {
  begin_checkpoint(path, put_all)();
}

std::function<void()> begin_checkpoint(const std::filesystem::path& path,
                                       const std::function<void(CheckpointWriter&)>& put_all) {
  return begin_atomically(path, [&](const std::string& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file << magic;
    CheckpointWriter to(file);
    put_all(to);
    file << '\0';
    file.close();
    return file.good();
  });
}

Checkpoint::Checkpoint(const std::filesystem::path& path) : path_(path.string()) {
  const std::string all = read_file(path, std::uintmax_t{1} << 40);
  if (all.compare(0, magic.size(), magic) != 0)
    throw FileError("'" + path_ + "' is not a checkpoint of this version of Tribo");
  read(all, magic.size());
}

Checkpoint::Checkpoint(std::span<const std::byte> file) : path_("in memory") {
  read({reinterpret_cast<const char*>(file.data()), file.size()}, magic.size());
}

Checkpoint::Checkpoint(const CheckpointWriter& writer) : path_("in memory") {
  for (const auto& e : writer.entries_) entries_[e.name] = {e.kind, e.bytes};
}

void Checkpoint::read(std::string_view all, std::size_t at) {
  const auto take = [&](void* to, std::size_t n) {
    if (all.size() - at < n) throw FileError("checkpoint '" + path_ + "' is cut off");
    std::memcpy(to, all.data() + at, n);
    at += n;
  };
  while (true) {
    char kind = 0;
    take(&kind, 1);
    if (kind == 0) return;
    std::uint64_t name_size = 0, size = 0;
    take(&name_size, sizeof name_size), take(&size, sizeof size);
    if (name_size > all.size() - at || size > all.size() - at - name_size)
      throw FileError("checkpoint '" + path_ + "' is cut off");
    std::string name(name_size, '\0');
    take(name.data(), name_size);
    Entry entry{kind, std::string(size, '\0')};
    take(entry.bytes.data(), size);
    std::uint32_t crc = 0;
    take(&crc, sizeof crc);
    if (crc != checksum(name, entry.bytes))
      throw FileError("checkpoint '" + path_ + "': entry '" + name + "' is damaged");
    entries_[name] = std::move(entry);
  }
}

std::vector<std::string> Checkpoint::names() const {
  std::vector<std::string> out;
  for (const auto& [name, entry] : entries_) out.push_back(name);
  return out;
}

bool Checkpoint::same(const Checkpoint& other, const std::string& name) const {
  const Entry &a = entries_.at(name), &b = other.entries_.at(name);
  return a.kind == b.kind && a.bytes == b.bytes;
}

const Checkpoint::Entry& Checkpoint::entry(const std::string& name, char kind) const {
  const auto found = entries_.find(name);
  if (found == entries_.end() || found->second.kind != kind)
    throw FileError("checkpoint '" + path_ + "' has no entry '" + name + "'; it belongs to another command file");
  return found->second;
}

template <class T>
std::vector<T> Checkpoint::numbers(const std::string& name, char kind) const {
  const auto& bytes = entry(name, kind).bytes;
  if (bytes.size() % sizeof(T) != 0)
    throw FileError("checkpoint '" + path_ + "': entry '" + printable(name) + "' is no list of numbers");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::vector<double> Checkpoint::doubles(const std::string& name) const { return numbers<double>(name, 'd'); }
std::vector<std::int64_t> Checkpoint::integers(const std::string& name) const {
  return numbers<std::int64_t>(name, 'i');
}

double Checkpoint::number(const std::string& name) const {
  const auto values = doubles(name);
  if (values.size() != 1) throw FileError("checkpoint '" + path_ + "': entry '" + printable(name) + "' is no number");
  return values.front();
}
std::int64_t Checkpoint::integer(const std::string& name) const {
  const auto values = integers(name);
  if (values.size() != 1) throw FileError("checkpoint '" + path_ + "': entry '" + printable(name) + "' is no number");
  return values.front();
}

std::size_t Checkpoint::bytes() const {
  std::size_t sum = 0;
  for (const auto& [name, entry] : entries_) sum += name.size() + entry.bytes.size();
  return sum;
}

std::string Checkpoint::text(const std::string& name) const { return entry(name, 't').bytes; }

}  // namespace tribo
