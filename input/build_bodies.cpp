// SPDX-License-Identifier: MIT
/// <MaterialPoints>: bodies, holes, images and single particles; also the shapes used by conditions.

#include "base/text.hpp"
#include "input/builder.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;
constexpr std::size_t most_corners = 20'000;  // of a polygon: each is looked at for every particle

bool is_shape(std::string_view name) {
  for (const auto shape :
       {"Rect", "Oval", "Polygon", "Line", "Arc", "Box", "Sphere", "Cylinder", "Torus", "STL", "Surface", "Terrain"})
    if (name == shape) return true;
  return false;
}

bool is_gmsh_file(const std::string& name) { return lower(std::filesystem::path(name).extension().string()) == ".msh"; }

int axis_of(const std::string& text) { return text == "1" || text == "x" ? 0 : text == "2" || text == "y" ? 1 : 2; }

}  // namespace

// A shape minus its nested shapes, which are cut out; shapes nested in a cut-out are added again.
RegionPtr Builder::shape(const Statement& s) {
  const bool surface = s.name == "STL" || s.name == "Surface";
  const bool three = s.name == "Box" || s.name == "Sphere" || s.name == "Cylinder" || s.name == "Torus" ||
                     s.name == "Terrain" || (surface && !is_gmsh_file(word(s, "file")));
  must(!three || model_.dimension() == 3, s.origin,
       "<" + s.name + "> is a three-dimensional shape, and the model is two-dimensional" +
           (surface ? "; in two dimensions the file is a plane mesh of Gmsh, which ends with .msh" : ""));
  const bool flat = s.name == "Rect" || s.name == "Oval" || s.name == "Polygon" || s.name == "Arc";
  must(!flat || model_.dimension() == 2, s.origin,
       "<" + s.name + "> is a two-dimensional shape, and the model is three-dimensional");
  RegionPtr region = placed(s, [&] { return plain_shape(s); });
  for (const auto& child : s.children)
    if (is_shape(child.name)) region = subtract(region, shape(child));
  return region;
}

RegionPtr Builder::plain_shape(const Statement& s) {
  const auto x = [&](const char* name) { return coordinate(s, name, 0); };
  const auto y = [&](const char* name) { return coordinate(s, name, 1); };
  const auto z = [&](const char* name) { return coordinate(s, name, 2); };
  if (s.name == "Rect" || s.name == "LdRect") return rectangle(x("xmin"), x("xmax"), y("ymin"), y("ymax"));
  if (s.name == "Oval") {
    const auto* arc = s.child("arc");
    const double start = arc ? number(*arc, "start", Dimension::angle) : 0.0,
                 end = arc ? number(*arc, "end", Dimension::angle) : 0.0;
    return oval(x("xmin"), x("xmax"), y("ymin"), y("ymax"), start, end);
  }
  if (s.name == "Polygon") {
    std::vector<Vec<2>> corners;
    for (const auto& pt : s.children)
      if (pt.name == "pt") corners.emplace_back(coordinate(pt, "x", 0), coordinate(pt, "y", 1));
    if (corners.size() > most_corners)
      throw std::runtime_error("it has " + std::to_string(corners.size()) + " corners; at most " +
                               std::to_string(most_corners) + " are possible");
    if (corners.size() < 3) throw std::runtime_error("a polygon needs at least three <pt>");
    return polygon(std::move(corners));
  }
  if (s.name == "Line" || s.name == "BCLine") return line_shape(s);
  if (s.name == "Arc" || s.name == "BCArc") return arc_shape(s);
  if (s.name == "STL" || s.name == "Surface") return surface_shape(s);
  if (s.name == "Terrain") return terrain_shape(s);
  const Vec3 low(x("xmin"), y("ymin"), z("zmin")), high(x("xmax"), y("ymax"), z("zmax"));
  if (s.name == "Sphere") return ellipsoid(low, high);
  if (s.name == "Torus") return torus(low, high, axis_of(word(s, "axis")), number(s, "radius", Dimension::length));
  if (s.name == "Cylinder" || (s.name == "BCBox" && has(s, "axis"))) {
    const double taper = number(s, "radius", Dimension::none, 1.0);
    if (!(taper >= -1 && taper <= 1)) throw std::runtime_error("the attribute radius must be in [-1, 1]");
    return cylinder(low, high, axis_of(word(s, "axis")), taper);
  }
  return box(low, high);
}

namespace {

// Calls f(), which reads a file; its errors become those of the statement.
template <class F>
auto from_file(F&& f) {
  try {
    return f();
  } catch (const FileError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

Builder::Placement Builder::placement(const Statement& s) {
  return {number(s, "scale", Dimension::none, 1.0),
          {number(s, "x", Dimension::length), number(s, "y", Dimension::length), number(s, "z", Dimension::length)}};
}

RegionPtr Builder::surface_shape(const Statement& s) {
  const Placement place = placement(s);
  const std::string path = data_file(word(s, "file")).string(), group = word(s, "group");
  return from_file([&] {
    return model_.dimension() == 2 && is_gmsh_file(path) ? outline_body(path, group, place.scale, place.shift)
                                                         : surface_body(path, place.scale, place.shift, group);
  });
}

RegionPtr Builder::terrain_shape(const Statement& s) {
  must(has(s, "zmin") != has(s, "below"), s.origin,
       "<Terrain> needs either 'zmin', the height of its bottom, or 'below', "
       "the file of its lower surface");
  const Placement place = placement(s);
  const auto heights = [&](const char* attribute) {
    const std::string path = data_file(word(s, attribute)).string();
    HeightGrid grid = from_file([&] { return read_heights(s, path); });
    grid.transform(place.scale, place.shift);
    return grid;
  };
  HeightGrid upper = heights("file");
  if (has(s, "below")) return terrain(std::move(upper), heights("below"));
  return terrain(std::move(upper), coordinate(s, "zmin", 2));
}

// A picture has neither extent nor heights of its own.
HeightGrid Builder::read_heights(const Statement& s, const std::string& path) {
  const std::string ending = lower(std::filesystem::path(path).extension().string());
  if (ending != ".png" && ending != ".bmp") return read_height_grid(path);
  for (const char* needed : {"width", "depth", "high"})
    must(has(s, needed), s.origin, std::string("a picture of heights needs the attribute '") + needed + "'");
  return height_grid(Image(path), number(s, "width", Dimension::length), number(s, "depth", Dimension::length),
                     number(s, "low", Dimension::length), number(s, "high", Dimension::length));
}

RegionPtr Builder::line_shape(const Statement& s) {
  const auto end = [&](const char* a, const char* b, int axis) {
    must(has(s, a) || has(s, b) || axis == 2, s.origin, "<" + s.name + "> needs the attribute '" + a + "'");
    return coordinate(s, has(s, a) ? a : b, axis);
  };
  return line({end("x1", "xmin", 0), end("y1", "ymin", 1), end("z1", "zmin", 2)},
              {end("x2", "xmax", 0), end("y2", "ymax", 1), end("z2", "zmax", 2)}, tolerance(s));
}

RegionPtr Builder::arc_shape(const Statement& s) {
  const double start = number(s, "start", Dimension::angle),
               end = has(s, "end") ? number(s, "end", Dimension::angle) : 360 * degrees;
  const auto edge = [&](const char* one, const char* other, int axis) {
    must(has(s, one) || has(s, other), s.origin, "<" + s.name + "> needs the attribute '" + one + "'");
    return coordinate(s, has(s, one) ? one : other, axis);
  };
  const double x1 = edge("xmin", "x1", 0), x2 = edge("xmax", "x2", 0), y1 = edge("ymin", "y1", 1),
               y2 = edge("ymax", "y2", 1);
  return arc(std::min(x1, x2), std::max(x1, x2), std::min(y1, y2), std::max(y1, y2), start, end, tolerance(s));
}

void Builder::bodies() {
  const Statement& points = *root_.child("MaterialPoints");
  for (const auto& s : points.children) {
    if (s.name == "Body") body(s, false);
    if (s.name == "Hole") body(s, true);
    if (s.name == "BMP") picture(s);
    if (s.name == "PointList")
      for (const auto& mp : s.children) point(mp);
    if (s.name == "ParticleTable") particle_table(s);
  }
  must(!model_.pieces.empty() || !model_.points.empty() || points.child("ParticleTable") || has_source(), points.origin,
       "<MaterialPoints> holds no particle; give a <Body> with a shape");
}

void Builder::body(const Statement& s, bool hole) {
  Piece piece;
  if (!hole) {
    piece.material = material(s);
    must_be_solid(s, piece.material);
    piece.velocity = Vec3(number(s, "vx", Dimension::velocity), number(s, "vy", Dimension::velocity),
                          number(s, "vz", Dimension::velocity));
    if (has(s, "temp")) piece.temperature = number(s, "temp", Dimension::temperature);
    if (has(s, "thick")) piece.thickness = number(s, "thick", Dimension::length);
    must(!piece.thickness || *piece.thickness > 0, s.origin, "the thickness must be positive");
    piece.angle = number(s, "angle", Dimension::angle);
    if (has(s, "size")) piece.point_size = number(s, "size", Dimension::length);
    must(!piece.point_size || *piece.point_size > 0, s.origin, "the particle size must be positive");
  }
  bool any = false;
  for (const auto& child : s.children) {
    if (!is_shape(child.name)) {
      modify(child, piece);
      continue;
    }
    any = true;
    Piece filled = piece;
    filled.region = shape(child);
    filled.origin = child.origin;
    model_.pieces.push_back(std::move(filled));
  }
  must(any, s.origin, "<" + s.name + "> has no shape");
}

// Whether the law of a material has axes; a rotation of the others has no effect.
bool Builder::has_axes(int material) const {
  if (material < 0 || material >= static_cast<int>(model_.materials.size())) return false;
  const auto& law = model_.materials[static_cast<std::size_t>(material)].law;
  return law && std::any_of(law->history().begin(), law->history().end(),
                            [](const HistoryVariable& h) { return h.name == material_angle; });
}

// Elements between the shapes act on the shapes that follow.
void Builder::modify(const Statement& s, Piece& piece) {
  if (s.name == "vel0X") piece.velocity_function[0] = function(s.text, s.text_origin, "<" + s.name + ">");
  if (s.name == "vel0Y") piece.velocity_function[1] = function(s.text, s.text_origin, "<" + s.name + ">");
  if (s.name == "vel0Z") piece.velocity_function[2] = function(s.text, s.text_origin, "<" + s.name + ">");
  if (s.name == "RotateZ") piece.angle += function(s.text, s.text_origin, "<" + s.name + ">")(Variables{}) * degrees;
  if (s.name == "RotateX" || s.name == "RotateY")
    must(!has_axes(piece.material), s.origin,
         "<" + s.name + "> rotates material axes out of the plane, which is not implemented");
  if (s.name == "Unrotate") piece.angle = 0.0;
  if (s.name == "Undeform") piece.deformation.reset();
  if (s.name == "MatlPtsPerElement") {
    const double n = text_number(s, Dimension::none);
    const double root = model_.dimension() == 2 ? std::sqrt(n) : std::cbrt(n);
    must(root >= 1 && root < 5.001 && std::abs(root - std::round(root)) < 1e-9, s.origin,
         "particles per cell must be a square (2D) or a cube (3D), at most 5 per axis");
    const int per_axis = static_cast<int>(std::round(root));
    piece.points_per_axis = {per_axis, per_axis, model_.dimension() == 3 ? per_axis : 1};
  }
  if (s.name == "Deform") {
    InitialDeformation d;
    constexpr std::array shifts{"dX", "dY", "dZ"};
    for (std::size_t i = 0; i < 3; ++i) {
      d.shift[i] = function(s, shifts[i]);
      for (std::size_t j = 0; j < 3; ++j) d.F[i][j] = function(s, "F" + std::to_string(i + 1) + std::to_string(j + 1));
    }
    piece.deformation = d;
  }
  if (s.name == "InitialStress") {
    piece.stress = stress_field(s);
    if (has(s, "K0")) {
      piece.K0 = number(s, "K0", Dimension::none);
      must(*piece.K0 >= 0, s.attribute("K0")->origin, "K0, horizontal over vertical stress, must not be negative");
    }
  }
}

void Builder::picture(const Statement& s) {
  std::shared_ptr<const Image> image;
  try {
    image = std::make_shared<const Image>(data_file(word(s, "name")).string());
  } catch (const FileError& error) {
    problems_.add(s.attribute("name")->origin, error.what());
    return;
  }
  const double width = number(s, "width", Dimension::length, image->width()),
               height = number(s, "height", Dimension::length, image->height());
  const auto* origin = s.child("Origin");
  const double x = origin ? number(*origin, "x", Dimension::length) : 0.0,
               y = origin ? number(*origin, "y", Dimension::length) : 0.0;
  must(width > 0 && height > 0, s.origin, "width and height of the picture must be positive");
  if (!(width > 0 && height > 0)) return;
  for (const auto& range : s.children) {
    if (range.name != "Intensity") continue;
    Piece piece;
    piece.material = material(range);
    piece.velocity = Vec3(number(range, "vx", Dimension::velocity), number(range, "vy", Dimension::velocity),
                          number(range, "vz", Dimension::velocity));
    if (has(range, "thick")) piece.thickness = number(range, "thick", Dimension::length);
    piece.angle = number(range, "angle", Dimension::angle);
    const int low = static_cast<int>(number(range, "imin", Dimension::none)),
              high = static_cast<int>(number(range, "imax", Dimension::none));
    must(low >= 0 && low <= high && high <= 255, range.origin,
         "imin and imax must be grey values 0 ... 255, imin <= imax");
    piece.region = placed(range, [&] { return image_region(image, x, x + width, y, y + height, low, high); });
    piece.origin = range.origin;
    model_.pieces.push_back(std::move(piece));
  }
}

void Builder::point(const Statement& s) {
  PointSpec p;
  p.origin = s.origin;
  p.material = material(s);
  must_be_solid(s, p.material);
  p.angle = number(s, "angle", Dimension::angle);
  const auto* at = s.child("pt");
  if (!at) {
    problems_.add(s.origin, "<mp> needs <pt x= y=>");
    return;
  }
  p.position =
      Vec3(coordinate(*at, "x", 0), coordinate(*at, "y", 1), model_.dimension() == 3 ? coordinate(*at, "z", 2) : 0.0);
  if (const auto* v = s.child("vel"))
    p.velocity = Vec3(number(*v, "x", Dimension::velocity), number(*v, "y", Dimension::velocity),
                      number(*v, "z", Dimension::velocity));
  if (const auto* m = s.child("mass")) {
    p.mass = number(*m, "m", Dimension::mass);
    must(*p.mass > 0, m->origin, "the mass must be positive");
  }
  if (has(s, "temp")) p.temperature = number(s, "temp", Dimension::temperature);
  if (has(s, "thick")) {
    p.thickness = number(s, "thick", Dimension::length);
    must(*p.thickness > 0, s.origin, "the thickness of a particle must be positive");
    must(model_.dimension() == 2 && model_.analysis != Analysis::axisymmetric, s.origin,
         "'thick' belongs to particles of plane models; in others the size of the domain gives the volume");
  }
  if (has(s, "lpx") || has(s, "lpy") || has(s, "lpz")) {
    Vec3 half = Vec3::Zero();
    constexpr std::array names{"lpx", "lpy", "lpz"};
    for (int d = 0; d < model_.dimension(); ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double h = (model_.grid.high[k] - model_.grid.low[k]) / model_.grid.cells[k];
      half[d] = number(s, names[k], Dimension::none, 0.5) * 0.5 * h;
      must(half[d] > 0, s.origin, "the size of a particle must be positive");
    }
    p.half_size = half;
  }
  model_.points.push_back(p);
}

}  // namespace tribo
