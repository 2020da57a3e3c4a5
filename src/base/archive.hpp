// SPDX-License-Identifier: MIT
/// Saving and restoring the state of objects by name.
///
/// A class takes part with one function next to it that serves both directions, so that the two cannot differ:
///
///   void archive(Archive& a, EnergyLedger& ledger) {
///     auto& [external_work, damping_work, rigid_work, impulse] = ledger;
///     a.version(1);
///     a("external_work", external_work), a("damping_work", damping_work);
///     a("rigid_work", rigid_work), a("impulse", impulse);
///   }
///
/// The structured binding names all members: a member that is added later does not compile until somebody decides
/// whether it is part of the state. The version rises whenever entries change their names, number or meaning.
#pragma once

#include "base/error.hpp"
#include "base/text.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tribo {

/// How many doubles a type consists of, if it is nothing but doubles in a row; else 0.
template <class T>
struct DoublesIn : std::integral_constant<std::size_t, 0> {};
template <>
struct DoublesIn<double> : std::integral_constant<std::size_t, 1> {};
template <int Rows, int Columns, int Options>
struct DoublesIn<Eigen::Matrix<double, Rows, Columns, Options>>
    : std::integral_constant<std::size_t, Rows <= 0 || Columns <= 0 ? 0 : std::size_t(Rows) * std::size_t(Columns)> {};
template <class T, std::size_t Count>
struct DoublesIn<std::array<T, Count>> : std::integral_constant<std::size_t, Count * DoublesIn<T>::value> {};

/// Throws the FileError of a checkpoint with numbers that are not possible, although its check sums may be right.
[[noreturn]] inline void refuse_checkpoint(const std::string& why) {
  throw FileError("the checkpoint is damaged or belongs to another command file: " + why);
}

class Archive {
 public:
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// True if the state is restored, false if it is saved.
  bool reading() const { return reading_; }
  /// States the version of the object that is visited. Throws FileError if another version was saved.
  virtual void version(int number) = 0;

  /// Visits a value, or an object by its function `archive`. Throws FileError with the name of the entry if it is
  /// missing or has another size. A container must have the size that it had when it was saved. Of a list of pointers,
  /// the objects that they point to are visited.
  template <class T>
  void operator()(std::string_view name, T& value) {
    if constexpr (DoublesIn<T>::value > 0) {
      doubles(name, {reinterpret_cast<double*>(&value), DoublesIn<T>::value});
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      auto number = static_cast<std::int64_t>(value);
      integers(name, {&number, 1});
      value = narrowed<T>(name, number);
    } else {
      enter(name);
      archive(*this, value);
      leave();
    }
  }
  template <std::size_t Count>
  void operator()(std::string_view name, std::array<std::int64_t, Count>& numbers) {
    integers(name, numbers);
  }
  template <class T, class Allocator>
  void operator()(std::string_view name, std::vector<T, Allocator>& list) {
    if constexpr (DoublesIn<T>::value > 0) {
      doubles(name, {reinterpret_cast<double*>(list.data()), list.size() * DoublesIn<T>::value});
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      integers(name, list);
    } else if constexpr (std::is_integral_v<T>) {
      std::vector<std::int64_t> numbers(list.begin(), list.end());
      integers(name, numbers);
      std::transform(numbers.begin(), numbers.end(), list.begin(),
                     [&](std::int64_t number) { return narrowed<T>(name, number); });
    } else {
      columns(name, list);
    }
  }
  /// A list whose size is part of the state.
  template <class T, class Allocator>
  void resizable(std::string_view name, std::vector<T, Allocator>& list) {
    std::size_t size = list.size();
    (*this)(std::string(name) + ".size", size);
    list.resize(size);
    (*this)(name, list);
  }
  /// Objects with entries of their own, by number.
  template <class List>
  void each(std::string_view name, List& list) {
    std::size_t number = 0;
    for (auto& object : list) (*this)(std::string(name) + std::to_string(number++), object);
  }
  /// A map with pairs of numbers as keys.
  template <class T>
  void map(std::string_view name, std::map<std::pair<std::size_t, std::size_t>, T>& of) {
    std::vector<std::int64_t> keys;
    std::vector<T> values;
    for (const auto& [key, value] : of) {
      keys.insert(keys.end(), {static_cast<std::int64_t>(key.first), static_cast<std::int64_t>(key.second)});
      values.push_back(value);
    }
    resizable(std::string(name) + ".keys", keys);
    values.resize(keys.size() / 2);
    (*this)(name, values);
    of.clear();
    for (std::size_t k = 0; k < values.size(); ++k)
      of[{static_cast<std::size_t>(keys[2 * k]), static_cast<std::size_t>(keys[2 * k + 1])}] = values[k];
  }

  /// Numbers in a row under one name; `values` are saved, or replaced by those that were saved.
  virtual void doubles(std::string_view name, std::span<double> values) = 0;
  virtual void integers(std::string_view name, std::span<std::int64_t> values) = 0;
  /// The names of all entries until leave() begin with `name` and a point.
  virtual void enter(std::string_view name) = 0;
  virtual void leave() = 0;
  /// The name of an entry with everything before it, for messages.
  virtual std::string full_name(std::string_view name) const = 0;

 protected:
  explicit Archive(bool reading) : reading_(reading) {}

 private:
  template <class List>
  void columns(std::string_view name, List& list);
  /// A saved number as the type that it was saved from.
  template <class T>
  T narrowed(std::string_view name, std::int64_t number) const {
    const T value = static_cast<T>(number);
    if (static_cast<std::int64_t>(value) != number)
      refuse_checkpoint("'" + full_name(name) + "' is " + std::to_string(number));
    return value;
  }

  bool reading_;
};

/// An archive that keeps the prefix of the names.
class NamedArchive : public Archive {
 public:
  void version(int number) override {
    std::int64_t saved = number;
    integers("version", {&saved, 1});
    if (saved != number)
      throw FileError("'" + full_name("version") + "' is " + std::to_string(saved) + ", this program reads " +
                      std::to_string(number));
  }
  void enter(std::string_view name) override {
    lengths_.push_back(prefix_.size());
    prefix_.append(name).append(".");
  }
  void leave() override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  std::string full_name(std::string_view name) const override { return prefix_ + std::string(name); }

 protected:
  using Archive::Archive;

 private:
  std::string prefix_;
  std::vector<std::size_t> lengths_;
};

/// Lets the objects of a list share their entries: one entry per member, which holds this member of all objects. Names
/// are looked at in the first object only; all others must visit the same members.
class ColumnArchive : public Archive {
 public:
  /// Entries go to `to` under `name`.
  ColumnArchive(Archive& to, std::string_view name, std::size_t rows)
      : Archive(to.reading()), to_(to), name_(name), rows_(rows) {}

  template <class T>
  void row(T& object) {
    next_ = 0;
    archive(static_cast<Archive&>(*this), object);
    ++row_;
  }
  /// Writes the columns after the last object.
  void finish() {
    if (reading()) return;
    to_.enter(name_);
    for (Column& c : columns_) c.integer ? to_.integers(c.name, c.integers) : to_.doubles(c.name, c.doubles);
    to_.leave();
  }

  void version(int number) override {
    if (row_ > 0) return;
    to_.enter(name_ + (prefix_.empty() ? "" : "." + prefix_.substr(0, prefix_.size() - 1)));
    to_.version(number);
    to_.leave();
  }
  void doubles(std::string_view name, std::span<double> values) override { visit(name, values, false); }
  void integers(std::string_view name, std::span<std::int64_t> values) override { visit(name, values, true); }
  void enter(std::string_view name) override {
    if (row_ > 0) return;
    lengths_.push_back(prefix_.size());
    prefix_.append(name).append(".");
  }
  void leave() override {
    if (row_ > 0) return;
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  std::string full_name(std::string_view name) const override {
    return to_.full_name(name_ + "." + prefix_ + std::string(name));
  }

 private:
  struct Column {
    std::string name;
    bool integer;
    std::vector<double> doubles;
    std::vector<std::int64_t> integers;
    template <class T>
    std::vector<T>& values() {
      if constexpr (std::is_same_v<T, double>)
        return doubles;
      else
        return integers;
    }
  };
  template <class T>
  void visit(std::string_view name, std::span<T> values, bool integer) {
    if (row_ == 0) {
      Column& added = columns_.emplace_back(Column{prefix_ + std::string(name), integer, {}, {}});
      auto& all = added.template values<T>();
      all.resize(values.size() * rows_);
      if (reading()) {
        to_.enter(name_);
        if constexpr (std::is_same_v<T, double>)
          to_.doubles(added.name, all);
        else
          to_.integers(added.name, all);
        to_.leave();
      }
    }
    auto& all = columns_[next_++].template values<T>();
    T* at = all.data() + row_ * values.size();
    if (reading())
      std::copy_n(at, values.size(), values.data());
    else
      std::copy_n(values.data(), values.size(), at);
  }

  Archive& to_;
  std::string name_, prefix_;
  std::vector<std::size_t> lengths_;
  std::size_t rows_, row_ = 0, next_ = 0;
  std::vector<Column> columns_;
};

template <class List>
void Archive::columns(std::string_view name, List& list) {
  std::size_t size = list.size();
  (*this)(std::string(name) + ".count", size);
  if (size != list.size())
    throw FileError("'" + full_name(name) + "' has " + counted(size, "object") + ", not " +
                    std::to_string(list.size()) + "; the checkpoint belongs to another command file");
  ColumnArchive rows(*this, name, list.size());
  for (auto& object : list)
    if constexpr (std::is_pointer_v<typename List::value_type>)
      rows.row(*object);
    else
      rows.row(object);
  rows.finish();
}

}  // namespace tribo
