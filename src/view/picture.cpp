// SPDX-License-Identifier: MIT
#include "view/picture.hpp"

#include "base/error.hpp"
#include "view/canvas.hpp"
#include "view/chart.hpp"
#include "view/colours.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

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
constexpr double margin_left = 64, margin_right = 118, margin_top = 36, margin_bottom = 44;

Sheet lay_out(const Camera& camera, const Box& box, int width, bool axes) {
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < 3; ++d) x[d] = box[static_cast<std::size_t>(corner >> d & 1)][d];
    const Vec3 p = camera.project(x);
    u0 = std::min(u0, p[0]), u1 = std::max(u1, p[0]), v0 = std::min(v0, p[1]), v1 = std::max(v1, p[1]);
  }
  const double around = 0.02 * std::max(u1 - u0, v1 - v0);
  u0 -= around, u1 += around, v0 -= around, v1 += around;
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

enum class Anchor { left, middle, right };

void write(cairo_t* pen, const std::string& text, double x, double y, Anchor anchor = Anchor::left, double size = 12) {
  cairo_set_font_size(pen, size);
  cairo_text_extents_t extents;
  cairo_text_extents(pen, text.c_str(), &extents);
  const double shift = anchor == Anchor::left     ? 0
                       : anchor == Anchor::middle ? 0.5 * extents.x_advance
                                                  : extents.x_advance;
  cairo_move_to(pen, x - shift, y);
  cairo_show_text(pen, text.c_str());
}

// Shortens what does not fit, between characters of UTF-8.
void write_within(cairo_t* pen, std::string text, double x, double y, double end) {
  cairo_set_font_size(pen, 12);
  const auto fits = [&](const std::string& t) {
    cairo_text_extents_t extents;
    cairo_text_extents(pen, t.c_str(), &extents);
    return x + extents.x_advance <= end;
  };
  if (fits(text)) return write(pen, text, x, y);
  const auto inside_character = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U; };
  while (!text.empty() && !fits(text + "\u2026")) {
    while (text.size() > 1 && inside_character()) text.pop_back();
    text.pop_back();
  }
  write(pen, text + "\u2026", x, y);
}

void line(cairo_t* pen, double x0, double y0, double x1, double y1) {
  cairo_move_to(pen, x0, y0);
  cairo_line_to(pen, x1, y1);
  cairo_stroke(pen);
}

void draw_axes(cairo_t* pen, const Sheet& l, const Camera& camera, const std::string& unit) {
  cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
  cairo_set_line_width(pen, 1);
  cairo_rectangle(pen, l.left - 0.5, l.top - 0.5, l.width + 1, l.height + 1);
  cairo_stroke(pen);
  const double bottom = l.top + l.height;
  for (const double u : ticks(l.u0, l.u0 + l.width / l.scale, static_cast<int>(l.width / 90))) {
    line(pen, l.x(u), bottom, l.x(u), bottom + 4);
    write(pen, short_number(u), l.x(u), bottom + 17, Anchor::middle, 11);
  }
  for (const double v : ticks(l.v1 - l.height / l.scale, l.v1, static_cast<int>(l.height / 60))) {
    line(pen, l.left - 4, l.y(v), l.left, l.y(v));
    write(pen, short_number(v), l.left - 7, l.y(v) + 4, Anchor::right, 11);
  }
  const std::string in_unit = unit.empty() ? "" : " [" + unit + "]";
  write(pen, camera.right_name + in_unit, l.left + l.width, bottom + 34, Anchor::right);
  write(pen, camera.up_name + in_unit, 8, l.top - 2);
}

// A cross of the three directions where there are no axes.
void draw_directions(cairo_t* pen, const Sheet& l, const Camera& camera) {
  cairo_set_line_width(pen, 1.5);
  const double x0 = l.left + 30, y0 = l.top + l.height - 22;
  constexpr std::array names{"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d) {
    std::array<double, 3> axis{};
    axis[d] = 1;
    const Vec3 p = camera.project(axis);
    cairo_set_source_rgb(pen, 0.2, 0.2, 0.2);
    line(pen, x0, y0, x0 + 26 * p[0], y0 - 26 * p[1]);
    write(pen, names[d], x0 + 34 * p[0] - 3, y0 - 34 * p[1] + 4);
  }
}

void draw_scale(cairo_t* pen, const Sheet& l, const Range& range, const std::string& name, const std::string& unit) {
  const double x = l.left + l.width + 18, width = 16, height = std::min(l.height, 420.0),
               top = l.top + 0.5 * (l.height - height);
  for (int k = 0; k < static_cast<int>(height); ++k) {
    const Colour c = viridis(1 - (k + 0.5) / height);
    cairo_set_source_rgb(pen, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
    cairo_rectangle(pen, x, top + k, width, 1.5);
    cairo_fill(pen);
  }
  cairo_set_source_rgb(pen, 0.2, 0.2, 0.2);
  cairo_set_line_width(pen, 1);
  cairo_rectangle(pen, x - 0.5, top - 0.5, width + 1, height + 1);
  cairo_stroke(pen);
  for (const double value : ticks(range[0], range[1], std::max(2, static_cast<int>(height / 50)))) {
    const double y = top + height * (1 - (value - range[0]) / (range[1] - range[0]));
    if (y < top - 1 || y > top + height + 1) continue;
    line(pen, x + width, y, x + width + 4, y);
    write(pen, short_number(value), x + width + 7, y + 4, Anchor::left, 11);
  }
  write(pen, unit.empty() ? name : name + " [" + unit + "]", l.picture_width - 8.0, l.top - 14, Anchor::right, 13);
}

void draw_names(cairo_t* pen, const Sheet& l, const std::vector<double>& values, const std::string& name,
                const std::vector<std::string>& names) {
  const std::set<int> things = [&] {
    std::set<int> all;
    for (const double v : values)
      if (all.size() < 12 && !std::isnan(v)) all.insert(static_cast<int>(v));
    return all;
  }();
  double y = l.top + 14;
  for (const int k : things) {
    const Colour c = distinct(k - 1);
    cairo_set_source_rgb(pen, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
    cairo_rectangle(pen, l.left + l.width + 18, y - 10, 14, 12);
    cairo_fill(pen);
    cairo_set_source_rgb(pen, 0.2, 0.2, 0.2);
    const bool named = k >= 1 && static_cast<std::size_t>(k) <= names.size();
    write_within(pen, named ? names[static_cast<std::size_t>(k) - 1] : std::to_string(k), l.left + l.width + 38, y,
                 l.picture_width - 4.0);
    y += 19;
  }
  write(pen, name, l.picture_width - 8.0, l.top - 14, Anchor::right, 13);
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

namespace {

template <class Frame>
Shade shade_in(const Frame& frame, const std::string& wanted) {
  const auto dot = wanted.find('.');
  const std::string name = wanted.substr(0, dot);
  const auto* field = frame.field(name);
  if (!field) {
    std::vector<std::string> names;
    for (const auto& f : frame.fields) names.push_back(f.name);
    throw UsageError("the run has no field '" + name + "'" + did_you_mean(name, names) + "; it has: " + join(names));
  }
  const auto count = static_cast<std::size_t>(field->components);
  int component = -1;
  if (dot != std::string::npos) {
    const std::vector<std::string> names =
        count == 3   ? std::vector<std::string>{"x", "y", "z"}
        : count == 6 ? std::vector<std::string>{"xx", "yy", "zz", "xy", "yz", "xz"}
        : count == 9 ? std::vector<std::string>{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}
                     : std::vector<std::string>{};
    const auto found = std::find(names.begin(), names.end(), wanted.substr(dot + 1));
    if (found == names.end())
      throw UsageError("'" + name + "' has no component '" + wanted.substr(dot + 1) + "'" +
                       (names.empty() ? "" : "; it has: " + join(names)));
    component = static_cast<int>(found - names.begin());
  } else if (count > 3) {
    throw UsageError("'" + name + "' is a tensor; add the component, for example '" + name + ".xx'");
  }
  Shade shade{wanted, {}, field->integers && count == 1};
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const double* v = field->values.data() + i * count;
    if (component >= 0)
      shade.values.push_back(v[component]);
    else if (count == 1)
      shade.values.push_back(v[0]);
    else
      shade.values.push_back(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  }
  return shade;
}

}  // namespace

Shade shade_of(const ParticleFrame& frame, const std::string& wanted) { return shade_in(frame, wanted); }

Shade shade_of(const Scene& scene, const std::string& wanted) {
  const std::string name = wanted.substr(0, wanted.find('.'));
  const bool of_particles = scene.particles.field(name) != nullptr, of_blocks = scene.blocks.field(name) != nullptr;
  const std::vector<double> no_particles(scene.particles.count(), std::nan("")),
      no_blocks(scene.blocks.count(), std::nan(""));
  const bool ask_particles = of_particles || (!of_blocks && scene.particles.count() > 0);
  Shade shade = ask_particles ? shade_in(scene.particles, wanted) : shade_in(scene.blocks, wanted);
  if (of_particles) {
    const auto more = of_blocks ? shade_in(scene.blocks, wanted).values : no_blocks;
    shade.values.insert(shade.values.end(), more.begin(), more.end());
  } else {
    shade.values.insert(shade.values.begin(), no_particles.begin(), no_particles.end());
  }
  return shade;
}

std::string default_field(const Scene& scene) {
  for (const char* name : {"von_mises", "velocity", "displacement", "pressure"})
    if (scene.particles.field(name) || scene.blocks.field(name)) return name;
  const std::vector<ParticleFrame::Field>* both[] = {&scene.particles.fields, &scene.blocks.fields};
  // A scale before categories, and the first component of a tensor at the worst.
  for (const bool integers : {false, true})
    for (const auto* fields : both)
      for (const auto& f : *fields)
        if (f.integers == integers && f.components <= 3) return f.name;
  for (const auto* fields : both)
    for (const auto& f : *fields)
      if (f.components == 6 || f.components == 9) return f.name + ".xx";
  throw UsageError("the run has no field that could be drawn");
}

void extend(std::optional<Range>& range, const std::vector<double>& values) {
  std::vector<double> sorted;
  for (const double v : values)
    if (std::isfinite(v)) sorted.push_back(v);
  if (sorted.empty()) return;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double part) {
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
  };
  const double low = at(0.005), high = at(0.995);
  range = range ? Range{std::min((*range)[0], low), std::max((*range)[1], high)} : Range{low, high};
}

Range widened(const std::optional<Range>& spread) {
  Range range = spread.value_or(Range{0, 1});
  // Differences below the digits of the ticks are noise.
  if (!(range[1] - range[0] > 1e-6 * std::max(std::abs(range[0]), std::abs(range[1])))) {
    const double middle = 0.5 * (range[0] + range[1]), half = middle == 0 ? 1.0 : 0.5 * std::abs(middle);
    range = {middle - half, middle + half};
  }
  return range;
}

Range range_of(const std::vector<double>& values) {
  std::optional<Range> range;
  extend(range, values);
  return widened(range);
}

namespace {

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

namespace {

// The domains of the particles as parallelograms, or as the sides of parallelepipeds that face the eye.
void draw_domains(Canvas& canvas, const ParticleFrame& frame, const Camera& eye, bool flat,
                  const std::function<Colour(std::size_t)>& colour) {
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Vec3 x = eye.project(frame.position[i]);
    std::array<Vec3, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) axes[k] = eye.project(frame.domains[i][k]);
    const auto side = [&](const Vec3& centre, const Vec3& a, const Vec3& b) {
      canvas.polygon({centre - a - b, centre + a - b, centre + a + b, centre - a + b}, colour(i), !flat, false);
    };
    if (flat) {
      side(x, axes[0], axes[1]);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = axes[(k + 1) % 3], &b = axes[(k + 2) % 3], normal = a.cross(b);
      side(normal.dot(axes[k]) * normal[2] > 0 ? Vec3(x + axes[k]) : Vec3(x - axes[k]), a, b);
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
  const std::string view = !options.view.empty() ? options.view : flat ? "xy" : "iso";
  const Camera eye = camera(view);
  const bool axes = !eye.right_name.empty();
  const bool domains = !frame.domains.empty();
  const double spacing = domains ? width_of(frame.domains) : spacing_of(frame.position);
  // Domains leave narrow slits where the deformation varies, and where rotations are not kept.
  const double slit = (domains ? 0.4 : 0.45) * spacing;
  // Around domains there is twice the width of a slit, so that nothing is filled at the edge of the picture.
  const double radius = domains ? (flat ? 2 * slit : 0.0) : flat ? 0.54 * spacing : 0.62 * spacing;
  Box box = options.box.value_or(particles);
  for (std::size_t d = 0; d < 3; ++d)
    if (d < 2 || !flat) box[0][d] -= radius, box[1][d] += radius;
  const Sheet l = lay_out(eye, box, options.width, axes);
  const Range range = options.range.value_or(range_of(shade.values));

  Canvas canvas(l);
  const auto colour = [&](std::size_t i) {
    const double v = shade.values[i];
    if (std::isnan(v)) return Colour{186, 184, 178};  // stone
    return shade.integers ? distinct(static_cast<int>(v) - 1) : viridis((v - range[0]) / (range[1] - range[0]));
  };
  if (domains)
    draw_domains(canvas, frame, eye, flat, colour);
  else
    for (std::size_t i = 0; i < frame.count(); ++i)
      canvas.particle(eye.project(frame.position[i]), radius, colour(i), !flat);
  if (flat && frame.count() > 0) canvas.close_gaps(slit);
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
  write(pen.get(), "time " + short_number(scene.time) + (options.time_unit.empty() ? "" : " " + options.time_unit),
        l.left - std::max(0.0, 0.5 * (least_width - l.width)), l.top - 14, Anchor::left, 13);
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &png) != CAIRO_STATUS_SUCCESS)
    throw FileError("the picture could not be drawn");
  return png;
}

}  // namespace tribo
