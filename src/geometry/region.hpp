/// Shapes that bodies are cut from and that conditions select with.
#pragma once

#include "base/types.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

struct Bounds {
  Vec3 low, high;
};

/// A closed set of points. Two-dimensional shapes ignore z.
class Region {
 public:
  virtual ~Region() = default;
  /// True inside and on the surface.
  virtual bool contains(const Vec3& x) const = 0;
  virtual Bounds bounds() const = 0;
  /// Exact area (2D, per unit thickness) or volume, if known in closed form; for the pre-flight sheet.
  virtual std::optional<double> measure() const { return std::nullopt; }
};

using RegionPtr = std::shared_ptr<const Region>;

// Two dimensions
RegionPtr rectangle(double xmin, double xmax, double ymin, double ymax);
/// Ellipse in a box; optional sector from `start` to `end` counterclockwise [rad].
RegionPtr oval(double xmin, double xmax, double ymin, double ymax, double start = 0.0, double end = 0.0);
RegionPtr polygon(std::vector<Vec<2>> corners);
/// All points closer than `tolerance` to the segment.
RegionPtr line(const Vec3& a, const Vec3& b, double tolerance);
/// All points closer than `tolerance` to the edge of an ellipse, between two angles [rad].
RegionPtr arc(double xmin, double xmax, double ymin, double ymax, double start, double end, double tolerance);

// Three dimensions
RegionPtr box(const Vec3& low, const Vec3& high);
RegionPtr ellipsoid(const Vec3& low, const Vec3& high);
/// Elliptic cylinder in a box along axis 0, 1 or 2. `taper` in [-1, 1]: radius at the high end over that at the low end is
/// `taper` for taper >= 0; at the low end over the high end `-taper` for taper < 0; 1 or -1: a cylinder, 0: a cone.
RegionPtr cylinder(const Vec3& low, const Vec3& high, int axis, double taper = 1.0);
/// Part of a torus in a box: ring radius from the box, `tube` the tube's radius.
RegionPtr torus(const Vec3& low, const Vec3& high, int axis, double tube);
/// Surface of revolution: the shell of `thickness` inside an elliptic cylinder wall of the box.
RegionPtr shell(const Vec3& low, const Vec3& high, int axis, double radius, double thickness);
/// Closed triangulated surface. Throws InputError text via std::runtime_error if the surface has a gap.
RegionPtr polyhedron(std::vector<std::array<Vec3, 3>> triangles);
/// Closed surface from an STL file (ASCII or binary). Throws FileError, or std::runtime_error naming the open edge.
RegionPtr stl(const std::string& path, double scale = 1.0, const Vec3& shift = Vec3::Zero());

// Booleans
RegionPtr unite(std::vector<RegionPtr> parts);
RegionPtr intersect(RegionPtr a, RegionPtr b);
RegionPtr subtract(RegionPtr a, RegionPtr b);
/// Rotation about `centre` by `angle` [rad] around `axis`, then translation by `shift`.
RegionPtr move(RegionPtr part, const Vec3& axis, double angle, const Vec3& centre, const Vec3& shift);

/// Grey map of an image laid over a rectangle; PNG or BMP. Row 0 of the picture is at ymax.
class Image {
 public:
  /// Throws FileError if the file cannot be read or is no PNG/BMP.
  explicit Image(const std::string& path);
  int width() const { return width_; }
  int height() const { return height_; }
  /// 0 black ... 255 white; colours by luma.
  int grey(int column, int row) const { return grey_[static_cast<std::size_t>(row * width_ + column)]; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<unsigned char> grey_;
};

/// Points of the rectangle whose pixel has a grey value in [low, high].
RegionPtr image_region(std::shared_ptr<const Image> image, double xmin, double xmax, double ymin, double ymax, int low,
                       int high);

}  // namespace tribo
