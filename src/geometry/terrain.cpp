// SPDX-License-Identifier: MIT
/// Heights on a regular grid, and the body below them.
#include "geometry/terrain.hpp"

#include "base/error.hpp"
#include "base/schema.hpp"
#include "geometry/file.hpp"
#include "geometry/interval.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

namespace tribo {
namespace {

// The words of the head of an ESRI ASCII grid.
struct GridHead {
  std::map<std::string, double> values;

  std::optional<double> find(const std::string& word) const {
    const auto found = values.find(word);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  }
  double need(const Bytes& bytes, const std::string& word) const {
    const auto value = find(word);
    if (!value) bytes.fail("the head of the grid lacks '" + word + "'");
    return *value;
  }
};

bool is_number_word(const std::string& word) { return to_number(word).has_value(); }

int grid_size(const Bytes& bytes, const GridHead& head, const std::string& word) {
  static constexpr double most = 100'000;
  const double value = head.need(bytes, word);
  if (!(value >= 2 && value <= most && value == std::floor(value)))
    bytes.fail("'" + word + "' must be a whole number from 2 to 100000");
  return static_cast<int>(value);
}

// The place of the first height along an axis: cells with a corner there, or heights at their centres.
double first_place(const Bytes& bytes, const GridHead& head, const std::string& axis, double cell) {
  if (const auto centre = head.find(axis + "llcenter")) return *centre;
  if (const auto corner = head.find(axis + "llcorner")) return *corner + 0.5 * cell;
  bytes.fail("the head of the grid lacks '" + axis + "llcorner' or '" + axis + "llcenter'");
}

}  // namespace

HeightGrid read_height_grid(const std::string& path) {
  const Bytes bytes(path);
  std::istringstream words{std::string(bytes.text())};
  GridHead head;
  std::string word;
  bool more = static_cast<bool>(words >> word);
  for (; more && !is_number_word(word); more = static_cast<bool>(words >> word)) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string value;
    words >> value;
    const auto number = to_number(value);
    if (head.values.size() > 16 || !number)
      bytes.fail("this is not an ESRI ASCII grid: '" + word.substr(0, 40) + "' is not followed by a number");
    head.values[word] = *number;
  }
  HeightGrid grid;
  grid.columns = grid_size(bytes, head, "ncols"), grid.rows = grid_size(bytes, head, "nrows");
  const double cell = head.need(bytes, "cellsize");
  if (!(cell > 0)) bytes.fail("'cellsize' must be positive");
  grid.spacing = {cell, cell};
  grid.first = {first_place(bytes, head, "x", cell), first_place(bytes, head, "y", cell)};
  const auto missing = head.find("nodata_value");
  grid.heights.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), 0.0);
  // Rows begin in the north.
  for (int row = grid.rows; row-- > 0;)
    for (int column = 0; column < grid.columns; ++column, more = static_cast<bool>(words >> word)) {
      const auto height = more ? to_number(word) : std::nullopt;
      if (!height)
        bytes.fail("the height of row " + std::to_string(grid.rows - row) + ", column " + std::to_string(column + 1) +
                   (more ? " is no number: '" + word.substr(0, 40) + "'" : " is missing"));
      grid.at(column, row) = missing && *height == *missing ? std::nan("") : *height;
    }
  if (more) bytes.fail("there are more heights than ncols times nrows");
  return grid;
}

HeightGrid height_grid(const Image& image, double width, double depth, double low, double high) {
  if (!(width > 0 && depth > 0)) throw std::runtime_error("a picture of heights needs a width and a depth");
  if (image.width() < 2 || image.height() < 2)
    throw std::runtime_error("a picture of heights needs two pixels each way");
  HeightGrid grid;
  grid.columns = image.width(), grid.rows = image.height();
  grid.spacing = {width / (grid.columns - 1), depth / (grid.rows - 1)};
  grid.heights.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.at(column, row) = low + (high - low) * image.grey(column, grid.rows - 1 - row) / 255.0;
  return grid;
}

namespace {

// Between a lower and an upper surface; both are continuous, bilinear between four heights.
class Terrain final : public Region {
 public:
  Terrain(HeightGrid upper, std::optional<HeightGrid> lower, double bottom)
      : upper_(std::move(upper)), lower_(std::move(lower)), bottom_(bottom) {
    double most = -infinity;
    for (const double height : upper_.heights)
      if (std::isfinite(height)) most = std::max(most, height);
    if (!(most > -infinity)) throw std::runtime_error("the terrain has no heights");
    double least = bottom_;
    if (lower_) {
      least = infinity;
      for (const double height : lower_->heights)
        if (std::isfinite(height)) least = std::min(least, height);
    }
    if (!(least < most)) throw std::runtime_error("the bottom is above all heights of the terrain");
    bounds_ = {Vec3(upper_.first[0], upper_.first[1], least), Vec3(upper_.last(0), upper_.last(1), most)};
    slack_ = rounding * std::max(bounds_.low.cwiseAbs().maxCoeff(), bounds_.high.cwiseAbs().maxCoeff());
  }

  bool contains(const Vec3& x) const override {
    const auto top = upper_.height(x[0], x[1]);
    if (!top || x[2] > *top + slack_) return false;
    if (!lower_) return x[2] >= bottom_ - slack_;
    const auto base = lower_->height(x[0], x[1]);
    return base && x[2] >= *base - slack_;
  }
  Bounds bounds() const override { return bounds_; }
  // The volume below bilinear pieces is that of the means of their corners.
  std::optional<double> measure() const override {
    if (lower_) return std::nullopt;
    double sum = 0.0;
    for (int row = 0; row + 1 < upper_.rows; ++row)
      for (int column = 0; column + 1 < upper_.columns; ++column) {
        double mean = 0.0;
        for (int corner = 0; corner < 4; ++corner) {
          const double height = upper_.at(column + (corner & 1), row + (corner >> 1));
          if (height < bottom_) return std::nullopt;
          mean += 0.25 * height;
        }
        if (std::isfinite(mean)) sum += mean - bottom_;
      }
    return sum * upper_.spacing[0] * upper_.spacing[1];
  }

 private:
  HeightGrid upper_;
  std::optional<HeightGrid> lower_;
  double bottom_, slack_ = 0.0;
  Bounds bounds_;
};

}  // namespace

std::optional<double> HeightGrid::height(double x, double y) const {
  const double places[2] = {(x - first[0]) / spacing[0], (y - first[1]) / spacing[1]};
  const int counts[2] = {columns, rows};
  int low[2];
  double part[2];
  for (int d = 0; d < 2; ++d) {
    static constexpr double slack = 1e-9;  // of a piece
    if (!(places[d] >= -slack && places[d] <= counts[d] - 1 + slack)) return std::nullopt;
    low[d] = std::clamp(static_cast<int>(std::floor(places[d])), 0, counts[d] - 2);
    part[d] = std::clamp(places[d] - low[d], 0.0, 1.0);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1, up = corner >> 1;
    const double weight = (right != 0 ? part[0] : 1 - part[0]) * (up != 0 ? part[1] : 1 - part[1]);
    sum += weight * at(low[0] + right, low[1] + up);
  }
  return std::isfinite(sum) ? std::optional(sum) : std::nullopt;
}

void HeightGrid::transform(double scale, const Vec3& shift) {
  for (std::size_t d = 0; d < 2; ++d)
    first[d] = scale * first[d] + shift[static_cast<Eigen::Index>(d)], spacing[d] *= scale;
  for (double& height : heights) height = scale * height + shift[2];
}

RegionPtr terrain(HeightGrid upper, double bottom) {
  require_finite("the bottom of the terrain", bottom);
  return std::make_shared<Terrain>(std::move(upper), std::nullopt, bottom);
}

RegionPtr terrain(HeightGrid upper, HeightGrid lower) {
  return std::make_shared<Terrain>(std::move(upper), std::move(lower), 0.0);
}

}  // namespace tribo
