// SPDX-License-Identifier: MIT
#include "view/picture.hpp"

#include "base/error.hpp"
#include "view/annotations.hpp"
#include "view/chart.hpp"
#include "view/outer_domains.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

namespace tribo {
namespace {

using Box = std::array<std::array<double, 3>, 2>;

struct Destroy {
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Pen = std::unique_ptr<cairo_t, Destroy>;

constexpr double least_width = 170;
constexpr double margin_left = 64, margin_right = 118, margin_top = 44, margin_bottom = 44;

Sheet lay_out(const Window& w, int width, bool axes) {
  const double u0 = w.left, u1 = w.right, v0 = w.low, v1 = w.high;
  Sheet l{};
  l.left = axes ? margin_left : 16, l.top = margin_top;
  const double room = width - l.left - margin_right;
  l.scale = std::min(room / (u1 - u0), 1.2 * room / (v1 - v0));
  l.left += std::max(0.0, 0.5 * (least_width - (u1 - u0) * l.scale));  // space for the text above
  l.width = (u1 - u0) * l.scale, l.height = std::max((v1 - v0) * l.scale, 60.0);
  const double spare = l.height / l.scale - (v1 - v0);
  l.u0 = u0, l.v1 = v1 + 0.5 * spare;
  l.picture_width =
      static_cast<int>(std::lround(std::max(l.left + l.width, l.left + 0.5 * (l.width + least_width)) + margin_right));
  l.picture_height = static_cast<int>(std::lround(l.top + l.height + (axes ? margin_bottom : 16)));
  // even numbers, as video encoders require
  l.picture_width += l.picture_width % 2, l.picture_height += l.picture_height % 2;
  return l;
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

template <class Frame>
std::optional<Box> box_in(const Frame& frame) {
  if (frame.position.empty()) return std::nullopt;
  Box box{frame.position[0], frame.position[0]};
  for (const auto& x : frame.position)
    for (std::size_t d = 0; d < 3; ++d) box[0][d] = std::min(box[0][d], x[d]), box[1][d] = std::max(box[1][d], x[d]);
  return box;
}

// The corners of the boxes around the domains.
std::optional<Box> box_in_domains(const ParticleFrame& frame) {
  auto box = box_in(frame);
  for (std::size_t i = 0; i < frame.domains.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      double reach = 0;
      for (const auto& axis : frame.domains[i]) reach += std::abs(axis[d]);
      (*box)[0][d] = std::min((*box)[0][d], frame.position[i][d] - reach);
      (*box)[1][d] = std::max((*box)[1][d], frame.position[i][d] + reach);
    }
  return box;
}

}  // namespace

Box box_of(const ParticleFrame& frame) {
  if (const auto box = box_in_domains(frame)) return *box;
  throw FileError("the file holds no particles");
}

Box box_of(const Scene& scene) {
  const auto blocks = box_in(scene.blocks), particles = box_in_domains(scene.particles);
  if (!blocks) return box_of(scene.particles);
  return particles ? joined(*particles, *blocks) : *blocks;
}

Box joined(const Box& a, const Box& b) {
  Box out = a;
  for (std::size_t d = 0; d < 3; ++d) out[0][d] = std::min(a[0][d], b[0][d]), out[1][d] = std::max(a[1][d], b[1][d]);
  return out;
}

std::string usual_view(const Box& box) { return box[1][2] - box[0][2] <= 0 ? "xy" : "iso"; }

namespace {

constexpr double slit_share = 0.4;      // half the width of a slit that is filled, over the size of domains
constexpr double hairline_share = 0.6;  // width of a gap between two bodies that is filled, over the size of domains

// The numbers of the bodies of particles, or of their materials; empty if the file has neither.
std::vector<double> bodies_of(const ParticleFrame& frame) {
  for (const char* name : {"body", "material"})
    if (const auto* field = frame.field(name)) return field->values;
  return {};
}

// The domains of particles in the plane as parallelograms.
void draw_flat_domains(Canvas& canvas, const ParticleFrame& frame, const std::vector<std::size_t>& particles,
                       const Camera& eye, const std::function<Colour(std::size_t)>& colour) {
  const std::vector<double> bodies = bodies_of(frame);
  for (const std::size_t i : particles) {
    if (!bodies.empty()) canvas.set_body(static_cast<std::int32_t>(bodies[i]));
    const Vec3 x = eye.project(frame.position[i]), a = eye.project(frame.domains[i][0]),
               b = eye.project(frame.domains[i][1]);
    canvas.polygon({x - a - b, x + a - b, x + a + b, x - a + b}, colour(i), false, false);
  }
}

// The domains of particles in space as the sides of parallelepipeds that face the eye; those at the surface of bodies
// cut by their neighbours. What extends them only fills gaps between them, and is therefore drawn a little behind.
void draw_solid_domains(Canvas& canvas, const ParticleFrame& frame, const Camera& eye, double width,
                        const std::function<Colour(std::size_t)>& colour) {
  constexpr double extension = 0.5, behind = 0.03;
  const OuterDomains outer(frame);
  const auto draw = [&](const Polyhedron& polyhedron, const Colour& fill, double shift) {
    for (std::vector<Vec3> face : polyhedron) {
      for (Vec3& x : face) x = eye.project({x[0], x[1], x[2]}) - Vec3(0, 0, shift);
      canvas.polygon(face, fill, true, false);
    }
  };
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (outer.is_outer(i)) {
      draw(outer.domain(i, 0.0), colour(i), 0.0), draw(outer.domain(i, extension), colour(i), behind * width);
      continue;
    }
    const Vec3 x = eye.project(frame.position[i]);
    std::array<Vec3, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) axes[k] = eye.project(frame.domains[i][k]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = axes[(k + 1) % 3], &b = axes[(k + 2) % 3], normal = a.cross(b);
      const Vec3 centre = normal.dot(axes[k]) * normal[2] > 0 ? Vec3(x + axes[k]) : Vec3(x - axes[k]);
      canvas.polygon({centre - a - b, centre + a - b, centre + a + b, centre - a + b}, colour(i), true, false);
    }
  }
}

// The median width of the domains [length].
double width_of(const std::vector<HalfAxes>& domains) {
  std::vector<double> widths;
  for (const HalfAxes& axes : domains) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = Vec3::Map(axes[static_cast<std::size_t>(k)].data());
    const bool plane = m.col(2).isZero();
    if (plane) m(2, 2) = 1;
    widths.push_back(2 * std::pow(std::abs(m.determinant()), plane ? 0.5 : 1.0 / 3));
  }
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return widths.empty() ? 0.0 : *middle;
}

// Particles in the plane whose domains are stretched to more than twice their width. `length`: the median of their
// lengths.
std::vector<std::size_t> stretched(const std::vector<HalfAxes>& domains, double& length) {
  std::vector<std::size_t> out;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < domains.size(); ++i) {
    Eigen::Matrix2d m;
    for (int k = 0; k < 2; ++k) m.col(k) = Vec3::Map(domains[i][static_cast<std::size_t>(k)].data()).head<2>();
    const Eigen::Vector2d axes = m.jacobiSvd().singularValues();
    if (axes[0] > 2 * axes[1]) out.push_back(i), lengths.push_back(2 * axes[0]);
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  length = lengths.empty() ? 0.0 : *middle;
  return out;
}

// Polygons of blocks, and strokes along the edges of facets whose bond broke.
void draw_blocks(Canvas& canvas, const Scene& scene, const Camera& eye, bool space, double size,
                 const std::function<Colour(std::size_t)>& colour) {
  const auto corners = [&](const CellFrame& frame, std::size_t c) {
    std::vector<Vec3> out;
    for (const auto k : frame.cells[c]) out.push_back(eye.project(frame.position[k]));
    return out;
  };
  for (std::size_t c = 0; c < scene.blocks.count(); ++c)
    canvas.polygon(corners(scene.blocks, c), colour(c), space, true);
  const auto* broke = scene.contacts.field("broke");
  constexpr Colour torn{214, 39, 40}, sheared{31, 90, 200};
  for (std::size_t c = 0; broke && c < scene.contacts.count(); ++c) {
    if (broke->values[c] == 0) continue;
    const auto x = corners(scene.contacts, c);
    for (std::size_t k = 0; k < (x.size() == 2 ? 1 : x.size()); ++k)
      canvas.stroke(x[k], x[(k + 1) % x.size()], 2.2, broke->values[c] == 1 ? torn : sheared, 0.01 * size);
  }
}

}  // namespace

std::string picture(const ParticleFrame& frame, const PictureOptions& options) {
  Scene scene;
  scene.time = frame.time, scene.particles = frame;
  return picture(scene, options);
}

std::string picture(const Scene& scene, const PictureOptions& options) {
  const ParticleFrame& frame = scene.particles;
  const Shade shade = shade_of(scene, options.field.empty() ? default_field(scene) : options.field);
  const Box particles = box_of(scene);
  const bool flat = particles[1][2] - particles[0][2] <= 0;
  const Camera eye = camera(options.view.empty() ? usual_view(particles) : options.view);
  const bool axes = !eye.right_name.empty();
  const bool domains = !frame.domains.empty();
  const double spacing = domains ? width_of(frame.domains) : spacing_of(frame.position);
  // Domains leave narrow slits where the deformation varies, and where rotations are not kept.
  const double slit = (domains ? slit_share : 0.45) * spacing;
  // Around domains there is twice the width of a slit, so that nothing is filled at the edge of the picture.
  double length = 0.0;
  const std::vector<std::size_t> long_domains = flat ? stretched(frame.domains, length) : std::vector<std::size_t>();
  const double radius = domains ? (flat ? std::max(2 * slit, slit_share * length) : 0.0)
                        : flat  ? 0.54 * spacing
                                : 0.62 * spacing;
  Box box = options.box.value_or(particles);
  for (std::size_t d = 0; d < 3; ++d)
    if (d < 2 || !flat) box[0][d] -= radius, box[1][d] += radius;
  const Sheet l = lay_out(options.window.value_or(window_around(eye, box)), options.width, axes);
  const Range range = options.range.value_or(range_of(shade.values));

  // Slits are also closed where they leave the picture.
  Canvas canvas(l, options.window && flat ? std::max(2 * slit, 2 * slit_share * length) : 0.0);
  const auto colour = [&](std::size_t i) {
    const double v = shade.values[i];
    if (std::isnan(v)) return Colour{186, 184, 178};  // stone
    return shade.integers ? distinct(static_cast<int>(v) - 1) : viridis((v - range[0]) / (range[1] - range[0]));
  };
  if (!long_domains.empty()) {
    // Where matter flows, neighbours are so far apart, and so are the slits between their domains.
    draw_flat_domains(canvas, frame, long_domains, eye, colour);
    canvas.close_gaps(slit_share * length, hairline_share * spacing);
  }
  if (domains && !flat) {
    draw_solid_domains(canvas, frame, eye, spacing, colour);
  } else if (domains) {
    std::vector<std::size_t> all(frame.count());
    std::iota(all.begin(), all.end(), std::size_t{0});
    draw_flat_domains(canvas, frame, all, eye, colour);
  } else {
    for (std::size_t i = 0; i < frame.count(); ++i)
      canvas.particle(eye.project(frame.position[i]), radius, colour(i), !flat);
  }
  if (flat && frame.count() > 0) canvas.close_gaps(slit, hairline_share * spacing);
  const double size = std::max(particles[1][0] - particles[0][0], particles[1][1] - particles[0][1]);
  draw_blocks(canvas, scene, eye, !flat, size, [&](std::size_t c) { return colour(frame.count() + c); });
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, l.picture_width, l.picture_height));
  const Pen pen(cairo_create(surface.get()));
  cairo_set_source_rgb(pen.get(), 1, 1, 1);
  cairo_paint(pen.get());
  canvas.copy_to(surface.get());
  cairo_select_font_face(pen.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  if (axes)
    draw_axes(pen.get(), l, eye, options.length_unit);
  else
    draw_directions(pen.get(), l, eye);
  if (shade.integers)
    draw_names(pen.get(), l, shade.values, shade.name,
               shade.name == "material" ? options.materials : std::vector<std::string>());
  else
    draw_scale(pen.get(), l, range, shade.name, options.unit);
  cairo_set_source_rgb(pen.get(), 0.2, 0.2, 0.2);
  write_text(pen.get(), "time " + short_number(scene.time) + (options.time_unit.empty() ? "" : " " + options.time_unit),
             l.left - std::max(0.0, 0.5 * (least_width - l.width)), l.top - above_names, Anchor::left, 13);
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS)
    throw FileError("the picture could not be drawn");
  return png;
}

}  // namespace tribo
