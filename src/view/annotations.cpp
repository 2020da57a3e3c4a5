// SPDX-License-Identifier: MIT
#include "view/annotations.hpp"

#include "view/chart.hpp"

#include <cmath>
#include <set>

namespace tribo {

void write_text(cairo_t* pen, const std::string& text, double x, double y, Anchor anchor, double size) {
  cairo_set_font_size(pen, size);
  cairo_text_extents_t extents;
  cairo_text_extents(pen, text.c_str(), &extents);
  const double shift = anchor == Anchor::left     ? 0
                       : anchor == Anchor::middle ? 0.5 * extents.x_advance
                                                  : extents.x_advance;
  cairo_move_to(pen, x - shift, y);
  cairo_show_text(pen, text.c_str());
}

namespace {

// Shortens what does not fit, between characters of UTF-8.
void write_within(cairo_t* pen, std::string text, double x, double y, double end) {
  cairo_set_font_size(pen, 12);
  const auto fits = [&](const std::string& t) {
    cairo_text_extents_t extents;
    cairo_text_extents(pen, t.c_str(), &extents);
    return x + extents.x_advance <= end;
  };
  if (fits(text)) return write_text(pen, text, x, y);
  const auto inside_character = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U; };
  while (!text.empty() && !fits(text + "\u2026")) {
    while (text.size() > 1 && inside_character()) text.pop_back();
    text.pop_back();
  }
  write_text(pen, text + "\u2026", x, y);
}

void line(cairo_t* pen, double x0, double y0, double x1, double y1) {
  cairo_move_to(pen, x0, y0);
  cairo_line_to(pen, x1, y1);
  cairo_stroke(pen);
}

}  // namespace

void draw_axes(cairo_t* pen, const Sheet& l, const Camera& camera, const std::string& unit) {
  cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
  cairo_set_line_width(pen, 1);
  cairo_rectangle(pen, l.left - 0.5, l.top - 0.5, l.width + 1, l.height + 1);
  cairo_stroke(pen);
  const double bottom = l.top + l.height;
  for (const double u : ticks(l.u0, l.u0 + l.width / l.scale, static_cast<int>(l.width / 90))) {
    line(pen, l.x(u), bottom, l.x(u), bottom + 4);
    write_text(pen, short_number(u), l.x(u), bottom + 17, Anchor::middle, 11);
  }
  for (const double v : ticks(l.v1 - l.height / l.scale, l.v1, static_cast<int>(l.height / 60))) {
    line(pen, l.left - 4, l.y(v), l.left, l.y(v));
    write_text(pen, short_number(v), l.left - 7, l.y(v) + 4, Anchor::right, 11);
  }
  const std::string in_unit = unit.empty() ? "" : " [" + unit + "]";
  write_text(pen, camera.right_name + in_unit, l.left + l.width, bottom + 34, Anchor::right);
  write_text(pen, camera.up_name + in_unit, 8, l.top - 9);  // above a number at the upper end of the axis
}

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
    write_text(pen, names[d], x0 + 34 * p[0] - 3, y0 - 34 * p[1] + 4);
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
  const int wanted = std::max(2, static_cast<int>(height / 50));
  std::vector<double> values = ticks(range[0], range[1], wanted);
  for (int more = 1; values.size() < 2 && more < 8; ++more)  // a single number is no scale
    values = ticks(range[0], range[1], wanted + more);
  for (const double value : values) {
    const double y = top + height * (1 - (value - range[0]) / (range[1] - range[0]));
    if (y < top - 1 || y > top + height + 1) continue;
    line(pen, x + width, y, x + width + 4, y);
    write_text(pen, short_number(value), x + width + 7, y + 4, Anchor::left, 11);
  }
  write_text(pen, unit.empty() ? name : name + " [" + unit + "]", l.picture_width - 8.0, l.top - above_names,
             Anchor::right, 13);
}

void draw_names(cairo_t* pen, const Sheet& l, const std::vector<double>& values, const std::string& name,
                const std::vector<std::string>& names) {
  std::set<int> things;
  for (const double v : values)
    if (!std::isnan(v)) things.insert(static_cast<int>(v));
  constexpr double row = 19;
  const auto rows = static_cast<std::size_t>(std::max(2.0, std::floor((l.picture_height - l.top) / row)));
  const std::size_t shown = things.size() <= rows ? things.size() : rows - 1;
  std::size_t drawn = 0;
  double y = l.top + 14;
  for (const int k : things) {
    if (drawn++ == shown) break;
    const Colour c = distinct(k - 1);
    cairo_set_source_rgb(pen, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
    cairo_rectangle(pen, l.left + l.width + 18, y - 10, 14, 12);
    cairo_fill(pen);
    cairo_set_source_rgb(pen, 0.2, 0.2, 0.2);
    const bool named = k >= 1 && static_cast<std::size_t>(k) <= names.size();
    write_within(pen, named ? names[static_cast<std::size_t>(k) - 1] : std::to_string(k), l.left + l.width + 38, y,
                 l.picture_width - 4.0);
    y += row;
  }
  if (shown < things.size())
    write_within(pen, "and " + std::to_string(things.size() - shown) + " more", l.left + l.width + 38, y,
                 l.picture_width - 4.0);
  write_text(pen, name, l.picture_width - 8.0, l.top - above_names, Anchor::right, 13);
}

}  // namespace tribo
