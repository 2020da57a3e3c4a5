// SPDX-License-Identifier: MIT
/// Shapes of bodies, and regions of conditions.
#pragma once

#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

/// An axis-parallel box. Two-dimensional shapes extend from -infinity to infinity in z.
struct Bounds {
  Vec3 low, high;
};

/// A closed set of points. Two-dimensional shapes ignore z.
class Region {
 public:
  virtual ~Region() = default;
  /// Whether x is inside or on the surface, up to round-off (1e-12 of the largest coordinate of the shape).
  virtual bool contains(const Vec3& x) const = 0;
  /// A bounding box, not necessarily the smallest one.
  virtual Bounds bounds() const = 0;
  /// Exact area (2D, per unit thickness) or volume, if a closed form is implemented; used by `tribo check`.
  virtual std::optional<double> measure() const { return std::nullopt; }
  /// Whether a part of the surface is curved, or approximates a curved one by many facets. Not known for pictures:
  /// false.
  virtual bool curved() const { return false; }
};

using RegionPtr = std::shared_ptr<const Region>;

// The functions below throw std::runtime_error if the arguments do not define a shape; the reader adds the place in the
// input. An extent of zero is allowed: it selects nodes on a plane or a line. Swapped limits (xmax < xmin) are
// exchanged, as in NairnMPM.

// Two dimensions
RegionPtr rectangle(double xmin, double xmax, double ymin, double ymax);
/// Ellipse in a box, or the sector of it between the polar angles `start` and `end` [rad], measured counterclockwise at
/// the centre. The whole ellipse if the angles are equal or differ by a full turn.
RegionPtr oval(double xmin, double xmax, double ymin, double ymax, double start = 0.0, double end = 0.0);
/// Polygon by the even-odd rule; the last corner is connected to the first.
RegionPtr polygon(std::vector<Vec<2>> corners);
/// What edges enclose by the even-odd rule; they may form several closed lines. `area`: what measure() returns. Throws
/// std::runtime_error with the coordinates of a corner that an odd number of edges has.
RegionPtr outline(std::vector<std::array<Vec<2>, 2>> edges, std::optional<double> area = std::nullopt);
/// The outline of a part of a plane mesh of Gmsh, see gmsh_outline(), transformed by x -> scale x + shift. Throws
/// FileError if the file cannot be read, and std::runtime_error as `outline`.
RegionPtr outline_body(const std::string& path, const std::string& group = {}, double scale = 1.0,
                       const Vec3& shift = Vec3::Zero());
/// All points within `tolerance` of the segment (2D: both ends at z = 0).
RegionPtr line(const Vec3& a, const Vec3& b, double tolerance);
/// All points within `tolerance` of the edge of an ellipse between two polar angles, as in `oval`.
RegionPtr arc(double xmin, double xmax, double ymin, double ymax, double start, double end, double tolerance);

// Three dimensions
RegionPtr box(const Vec3& low, const Vec3& high);
RegionPtr ellipsoid(const Vec3& low, const Vec3& high);
/// Elliptic cylinder in a box along axis 0, 1 or 2. `taper` in [-1, 1] is the ratio of the end radii: for taper >= 0
/// the radius at the high end divided by that at the low end, for taper < 0 minus the inverse ratio. 1 or -1: a
/// cylinder, 0: a cone.
RegionPtr cylinder(const Vec3& low, const Vec3& high, int axis, double taper = 1.0);
/// Torus about `axis`. The box in the two other directions bounds the ellipse through the centres of the cross-section.
/// The box along `axis` is the height of the elliptic cross-section, whose half width is `tube` (0: a circle).
RegionPtr torus(const Vec3& low, const Vec3& high, int axis, double tube = 0.0);
/// Tube about the centre line of the box along `axis`, with the length of the box. Its wall extends from
/// radius - thickness/2 to radius + thickness/2 and is not limited by the lateral sides of the box.
RegionPtr shell(const Vec3& low, const Vec3& high, int axis, double radius, double thickness);
/// Body with a closed triangulated surface. Corners closer than 1e-9 of the extent are merged. The facets may have any
/// order and orientation. Throws std::runtime_error with the coordinates of an edge that does not belong to two facets.
RegionPtr polyhedron(const std::vector<std::array<Vec3, 3>>& triangles);
/// Body with the closed surface of a file, see read_surface(), transformed by x -> scale x + shift. Corners closer than
/// 1e-6 of the extent are merged, since files are in single precision. Throws FileError if the file cannot be read, and
/// std::runtime_error as `polyhedron`. `group`: part of a mesh of Gmsh, see gmsh_surface(); empty: all of it.
RegionPtr surface_body(const std::string& path, double scale = 1.0, const Vec3& shift = Vec3::Zero(),
                       const std::string& group = {});
/// The facets of a file whose name ends with .stl (ASCII or binary), .obj, .ply or .msh; polygons as triangles. Throws
/// FileError, also if there is a `group` and the file is no mesh of Gmsh.
std::vector<std::array<Vec3, 3>> read_surface(const std::string& path, const std::string& group = {});
/// The facets of an STL file as written. Throws FileError.
std::vector<std::array<Vec3, 3>> read_stl(const std::string& path);

// Booleans
RegionPtr unite(std::vector<RegionPtr> parts);
RegionPtr intersect(RegionPtr a, RegionPtr b);
/// Points of `a` that are neither in `b` nor on its surface.
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
