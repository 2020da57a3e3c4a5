// SPDX-License-Identifier: MIT
/// Columns of output files.
#pragma once

#include "base/types.hpp"
#include "output/vtk.hpp"

#include <array>
#include <string>
#include <vector>

namespace tribo {

/// Columns of points or cells, filled by appending. The column "position" holds the points and is not a field.
class Columns {
 public:
  void vector(const std::string& name, const auto& v) {
    auto& to = of(name, 3);
    for (std::size_t d = 0; d < 3; ++d)
      to.data[d].push_back(static_cast<Eigen::Index>(d) < v.size() ? v[static_cast<Eigen::Index>(d)] : 0.0);
  }
  void number(const std::string& name, double x) { of(name, 1).data[0].push_back(x); }
  void tensor(const std::string& name, const Mat3& m) {
    auto& to = of(name, 6);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [r, c] = Layout<3>::symmetric_at[k];
      to.data[k].push_back(m(r, c));
    }
  }
  void integer(const std::string& name, std::int64_t k) { of(name, 0).integers.push_back(k); }
  void text(const std::string& name, std::string words) { of(name, 0).texts.push_back(std::move(words)); }
  std::array<const double*, 3> positions() const {
    const Column* x = find("position");
    if (!x) return {};
    return {x->data[0].data(), x->data[1].data(), x->data[2].data()};
  }
  std::size_t size() const {
    const Column* x = find("position");
    return x ? x->data[0].size() : 0;
  }
  /// Memory that it holds, without the texts.
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Column& c : columns_) {
      sum += c.integers.size() * sizeof(std::int64_t);
      for (const auto& data : c.data) sum += data.size() * sizeof(double);
    }
    return sum;
  }
  std::vector<OutputField> fields() const {
    std::vector<OutputField> out;
    for (const Column& c : columns_) {
      if (c.name == "position") continue;
      OutputField field{c.name, {}, c.integers.empty() ? nullptr : c.integers.data()};
      if (!c.texts.empty()) field.texts = c.texts.data();
      for (const auto& data : c.data) field.components.push_back(data.data());
      out.push_back(std::move(field));
    }
    return out;
  }

 private:
  struct Column {
    std::string name;
    std::vector<std::vector<double>> data;
    std::vector<std::int64_t> integers;
    std::vector<std::string> texts = {};
  };
  const Column* find(const std::string& name) const {
    for (const Column& c : columns_)
      if (c.name == name) return &c;
    return nullptr;
  }
  Column& of(const std::string& name, std::size_t components) {
    for (Column& c : columns_)
      if (c.name == name) return c;
    columns_.push_back({name, std::vector<std::vector<double>>(components), {}, {}});
    return columns_.back();
  }
  std::vector<Column> columns_;
};

}  // namespace tribo
