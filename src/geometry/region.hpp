// SPDX-License-Identifier: MIT
/// Shapes that bodies are cut from and that conditions select with.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// An axis-parallel box; two-dimensional shapes reach from -infinity to infinity in z.
struct Bounds {
  Vec3 low, high;
};

/// A closed set of points. Two-dimensional shapes ignore z.
class Region {
 public:
  virtual ~Region() = default;
  /// True inside and on the surface, up to rounding (1e-12 of the shape's largest coordinate).
  virtual bool contains(const Vec3& x) const = 0;
  /// A box around the shape, as small as is easily found.
  virtual Bounds bounds() const = 0;
  /// Exact area (2D, per unit thickness) or volume, if known in closed form; for the pre-flight sheet.
  virtual std::optional<double> measure() const { return std::nullopt; }
};

using RegionPtr = std::shared_ptr<const Region>;

// The makers below throw std::runtime_error with one sentence if their numbers make no shape (an extent of zero is
// allowed: it selects nodes on a plane or a line); the reader adds the place. Swapped limits (xmax < xmin) are put in
// order, as the dialect does.

// Two dimensions
RegionPtr rectangle(double xmin, double xmax, double ymin, double ymax);
/// Ellipse in a box; optional sector between the polar angles `start` and `end` seen from the centre, counterclockwise
/// [rad]; the whole ellipse if they are equal or a full turn apart.
RegionPtr oval(double xmin, double xmax, double ymin, double ymax, double start = 0.0, double end = 0.0);
/// Even-odd rule; the last corner is joined to the first.
RegionPtr polygon(std::vector<Vec<2>> corners);
/// All points not farther than `tolerance` from the segment, in space (2D: both ends at z = 0).
RegionPtr line(const Vec3& a, const Vec3& b, double tolerance);
/// All points not farther than `tolerance` from the edge of an ellipse, between two polar angles as in `oval`.
RegionPtr arc(double xmin, double xmax, double ymin, double ymax, double start, double end, double tolerance);

// Three dimensions
RegionPtr box(const Vec3& low, const Vec3& high);
RegionPtr ellipsoid(const Vec3& low, const Vec3& high);
/// Elliptic cylinder in a box along axis 0, 1 or 2. `taper` in [-1, 1]: radius at the high end over that at the low end
/// is `taper` for taper >= 0; at the low end over the high end `-taper` for taper < 0; 1 or -1: a cylinder, 0: a cone.
RegionPtr cylinder(const Vec3& low, const Vec3& high, int axis, double taper = 1.0);
/// Ring about `axis`: the two other directions of the box bound the ellipse through the centres of the cross-section;
/// the box along `axis` is the height of the cross-section, an ellipse with half width `tube` (0: a circle).
RegionPtr torus(const Vec3& low, const Vec3& high, int axis, double tube = 0.0);
/// Tube about the middle line of the box along `axis`, as long as the box: `radius` of its middle surface, from
/// radius - thickness/2 to radius + thickness/2. The box does not cut it sideways.
RegionPtr shell(const Vec3& low, const Vec3& high, int axis, double radius, double thickness);
/// Closed triangulated surface; corners nearer than 1e-9 of the extent are one. Facets may be listed in any order and
/// orientation. Throws std::runtime_error naming the coordinates of an edge that does not belong to exactly two facets.
RegionPtr polyhedron(const std::vector<std::array<Vec3, 3>>& triangles);
/// Closed surface from an STL file (ASCII or binary): x -> scale x + shift. Corners nearer than 1e-6 of the extent are
/// one, for files in single precision. Throws FileError if the file cannot be
/// read, or std::runtime_error as `polyhedron`.
RegionPtr stl(const std::string& path, double scale = 1.0, const Vec3& shift = Vec3::Zero());
/// The facets of an STL file as written. Throws FileError.
std::vector<std::array<Vec3, 3>> read_stl(const std::string& path);

// Booleans
RegionPtr unite(std::vector<RegionPtr> parts);
RegionPtr intersect(RegionPtr a, RegionPtr b);
/// Points of `a` that are not in `b`, nor on its surface.
RegionPtr subtract(RegionPtr a, RegionPtr b);
/// Rotation about `centre` by `angle` [rad] around `axis` (right-handed), then translation by `shift`.
RegionPtr move(RegionPtr part, const Vec3& axis, double angle, const Vec3& centre, const Vec3& shift);

/// Grey map of an image laid over a rectangle; PNG or BMP. Row 0 of the picture is at ymax.
class Image {
 public:
  /// Throws FileError if the file cannot be read, is no PNG or BMP, or holds a kind of BMP that is not supported
  /// (supported: uncompressed with 8 bit and palette, 24 or 32 bit).
  explicit Image(const std::string& path);
  int width() const { return width_; }
  int height() const { return height_; }
  /// 0 black ... 255 white; colours by luma (ITU-R BT.601). Transparent pixels of a PNG are laid over white.
  int grey(int column, int row) const {
    return grey_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)];
  }

 private:
  int width_ = 0, height_ = 0;
  std::vector<unsigned char> grey_;
};

/// Points of the rectangle whose pixel has a grey value in [low, high].
RegionPtr image_region(std::shared_ptr<const Image> image, double xmin, double xmax, double ymin, double ymax, int low,
                       int high);

}  // namespace tribo
