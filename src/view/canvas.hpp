// SPDX-License-Identifier: MIT
/// Pixels of a picture before text is added, with a depth buffer.
#pragma once

#include "base/types.hpp"
#include "view/colours.hpp"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tribo {

/// Layout of the picture in pixels.
struct Sheet {
  double left, top, width, height;  // of the particles
  double scale;                     // pixels per length
  double u0, v1;                    // projected coordinates of the upper left corner
  int picture_width, picture_height;

  double x(double u) const { return left + (u - u0) * scale; }
  double y(double v) const { return top + (v1 - v) * scale; }
};

/// Particles as squares (flat) or balls (space) on a canvas with four times as many pixels as the picture.
class Canvas {
 public:
  /// `beyond`: width of what is drawn around the picture and not shown [length]; at most the width of the picture.
  Canvas(const Sheet& layout, double beyond = 0.0)
      : layout_(layout), rim_(static_cast<int>(std::ceil(std::min(beyond * layout.scale, layout.width)))) {
    layout_.u0 -= rim_ / layout_.scale, layout_.v1 += rim_ / layout_.scale;
    width_ = fine * (static_cast<int>(std::ceil(layout.width)) + 2 * rim_),
    height_ = fine * (static_cast<int>(std::ceil(layout.height)) + 2 * rim_);
    depth_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1e30F);
    colour_.assign(depth_.size(), Colour{255, 255, 255});
    body_.assign(depth_.size(), 0);
  }

  /// What is drawn from now on belongs to the body of this number.
  void set_body(std::int32_t number) { drawn_body_ = number; }

  void particle(const Vec3& at, double radius, const Colour& colour, bool ball) {
    const double s = fine * layout_.scale, r = std::max(radius * s, 0.75 * fine);
    const double u = (at[0] - layout_.u0) * s, v = (layout_.v1 - at[1]) * s;
    const int x0 = std::max(0, static_cast<int>(std::floor(u - r))), x1 = std::min(width_, static_cast<int>(u + r) + 1);
    const int y0 = std::max(0, static_cast<int>(std::floor(v - r))),
              y1 = std::min(height_, static_cast<int>(v + r) + 1);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const double a = (x + 0.5 - u) / r, b = (y + 0.5 - v) / r, square = a * a + b * b;
        const std::size_t pixel = index(x, y);
        if (!ball) {
          if (std::abs(a) <= 1 && std::abs(b) <= 1)
            colour_[pixel] = colour, depth_[pixel] = 0, body_[pixel] = drawn_body_;
          continue;
        }
        if (square > 1) continue;
        const double height = std::sqrt(1 - square);
        const auto depth = static_cast<float>(at[2] + radius * height);
        if (depth <= depth_[pixel]) continue;
        depth_[pixel] = depth;
        // light from the upper left, behind the eye
        const double light = 0.45 + 0.55 * std::max(0.0, -0.35 * a - 0.5 * b + 0.79 * height);
        for (std::size_t c = 0; c < 3; ++c)
          colour_[pixel][c] = static_cast<std::uint8_t>(std::min(255.0, light * colour[c] + 8));
      }
  }

  /// A convex polygon, with darker edges or without; in space lighter where it faces the light.
  void polygon(const std::vector<Vec3>& corners, const Colour& fill, bool space, bool edges) {
    Vec3 n = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      n += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    if (!(std::abs(n[2]) > 1e-12 * n.norm())) return;  // seen from the side
    n.normalize();
    if (n[2] < 0) n = -n;
    const double light = space ? 0.45 + 0.55 * std::max(0.0, n.dot(Vec3(-0.35, 0.5, 0.79))) : 1.0;
    const auto shaded = [&](double part) {
      Colour c;
      for (std::size_t k = 0; k < 3; ++k) c[k] = static_cast<std::uint8_t>(std::min(255.0, part * light * fill[k]));
      return c;
    };
    const Colour inside = shaded(1.0), edge = shaded(0.45);
    std::vector<Vec3> at;
    for (const Vec3& x : corners) at.push_back(on_canvas(x));
    const auto [low, high] = around(at, 0.0);
    for (int y = low[1]; y < high[1]; ++y)
      for (int x = low[0]; x < high[0]; ++x) {
        const Eigen::Vector2d p(x + 0.5, y + 0.5);
        int left = 0, right = 0;
        double nearest = 1e30;
        for (std::size_t k = 0; k < at.size(); ++k) {
          const Eigen::Vector2d a = at[k].head<2>(), along = at[(k + 1) % at.size()].head<2>() - a;
          const double distance = (along[0] * (p[1] - a[1]) - along[1] * (p[0] - a[0])) / std::max(along.norm(), 1e-9);
          (distance >= 0 ? left : right)++;
          nearest = std::min(nearest, std::abs(distance));
        }
        if (left > 0 && right > 0) continue;
        const double s = fine * layout_.scale;
        const auto depth =
            static_cast<float>(corners[0][2] - (n[0] * (p[0] - at[0][0]) - n[1] * (p[1] - at[0][1])) / (s * n[2]));
        if (depth < depth_[index(x, y)]) continue;
        depth_[index(x, y)] = depth, colour_[index(x, y)] = edges && nearest < 0.6 * fine ? edge : inside;
        body_[index(x, y)] = drawn_body_;
      }
  }

  /// A stroke `width` pixels wide, on top of what lies no more than `lift` in front of it.
  void stroke(const Vec3& from, const Vec3& to, double width, const Colour& colour, double lift) {
    const Vec3 a = on_canvas(from), b = on_canvas(to);
    const double reach = 0.5 * fine * width;
    const Eigen::Vector2d along = (b - a).head<2>();
    const auto [low, high] = around({a, b}, reach);
    for (int y = low[1]; y < high[1]; ++y)
      for (int x = low[0]; x < high[0]; ++x) {
        const Eigen::Vector2d p = Eigen::Vector2d(x + 0.5, y + 0.5) - a.head<2>();
        const double t = std::clamp(p.dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
        if ((p - t * along).norm() > reach) continue;
        const auto depth = static_cast<float>(a[2] + t * (b[2] - a[2]) + lift);
        if (depth < depth_[index(x, y)]) continue;
        depth_[index(x, y)] = depth, colour_[index(x, y)] = colour;
      }
  }

  /// Fills gaps up to twice a length wide between particles with the colour of the nearest: where bodies stretch,
  /// squares no longer touch. Edges stay where they are, as what was added there is taken away again. Gaps between two
  /// bodies are filled up to the width `hairline`.
  void close_gaps(double length, double hairline) {
    const double pixels = fine * layout_.scale, reach = length * pixels;
    if (reach < 1) return;
    const auto nearest = offsets_to([&](std::size_t pixel) { return is_drawn(pixel); });
    std::vector<bool> wide(colour_.size());
    for (std::size_t k = 0; k < wide.size(); ++k) wide[k] = nearest[k].length() <= reach;
    const auto outside = offsets_to([&](std::size_t pixel) { return !wide[pixel]; });
    std::vector<std::pair<std::size_t, std::size_t>> filled;  // pixel, and the one whose colour it gets
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const auto k = index(x, y);
        if (is_drawn(k) || !wide[k] || outside[k].length() <= reach) continue;
        if (parts_bodies(x, y, nearest[k], 2 * reach, hairline * pixels)) continue;
        filled.emplace_back(k, index(x + nearest[k].x, y + nearest[k].y));
      }
    for (const auto& [to, from] : filled) colour_[to] = colour_[from];
  }

  void copy_to(cairo_surface_t* surface) const {
    cairo_surface_flush(surface);
    unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < height_ / fine - 2 * rim_; ++y)
      for (int x = 0; x < width_ / fine - 2 * rim_; ++x) {
        const int to_x = static_cast<int>(layout_.left) + x, to_y = static_cast<int>(layout_.top) + y;
        if (to_x >= layout_.picture_width || to_y >= layout_.picture_height) continue;
        std::array<int, 3> sum{};
        for (int j = 0; j < fine; ++j)
          for (int i = 0; i < fine; ++i) {
            const Colour& c = colour_[index(fine * (x + rim_) + i, fine * (y + rim_) + j)];
            for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
          }
        auto* pixel = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(to_y) * stride) + to_x;
        const auto mean = [&](std::size_t k) { return static_cast<std::uint32_t>(sum[k] / (fine * fine)); };
        *pixel = 0xFF000000U | mean(0) << 16U | mean(1) << 8U | mean(2);
      }
    cairo_surface_mark_dirty(surface);
  }

 private:
  static constexpr int fine = 2;

  struct Offset {
    int x = 1 << 14, y = 1 << 14;
    double length() const { return std::hypot(x, y); }
    long square() const { return static_cast<long>(x) * x + static_cast<long>(y) * y; }
  };
  bool is_drawn(std::size_t pixel) const { return depth_[pixel] > -1e29F; }
  // Whether a pixel lies in a gap between two bodies that is wider than a hairline: what lies opposite of the nearest
  // pixel of a body, within a distance, belongs to another body.
  bool parts_bodies(int x, int y, const Offset& nearest, double within, double hairline) const {
    const double distance = nearest.length();
    const auto body = body_[index(x + nearest.x, y + nearest.y)];
    for (double beyond = 1; distance + beyond <= within; ++beyond) {
      const int u = x - static_cast<int>(std::lround(nearest.x * beyond / distance)),
                v = y - static_cast<int>(std::lround(nearest.y * beyond / distance));
      if (u < 0 || u >= width_ || v < 0 || v >= height_) return false;
      if (is_drawn(index(u, v))) return body_[index(u, v)] != body && distance + beyond > hairline;
    }
    return false;
  }
  // Pixels from the upper left corner, and the depth as it is.
  Vec3 on_canvas(const Vec3& x) const {
    const double s = fine * layout_.scale;
    return {(x[0] - layout_.u0) * s, (layout_.v1 - x[1]) * s, x[2]};
  }
  // Range of pixels that points can cover.
  std::array<std::array<int, 2>, 2> around(const std::vector<Vec3>& at, double reach) const {
    Vec3 low = at[0], high = at[0];
    for (const Vec3& x : at) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const auto inside = [](double v, int size) { return static_cast<int>(std::clamp(v, 0.0, double(size))); };
    return {{{inside(low[0] - reach, width_), inside(low[1] - reach, height_)},
             {inside(high[0] + reach + 1, width_), inside(high[1] + reach + 1, height_)}}};
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // From every pixel to the nearest that `is`, by two sweeps (Danielsson, Comput. Graph. Image Process. 14 (1980)
  // 227-248).
  template <class Is>
  std::vector<Offset> offsets_to(Is&& is) const {
    std::vector<Offset> offsets(colour_.size());
    for (std::size_t k = 0; k < offsets.size(); ++k)
      if (is(k)) offsets[k] = {0, 0};
    const auto look = [&](int x, int y, int dx, int dy) {
      if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) return;
      const Offset& there = offsets[index(x + dx, y + dy)];
      const Offset candidate{there.x + dx, there.y + dy};
      Offset& here = offsets[index(x, y)];
      if (candidate.square() < here.square()) here = candidate;
    };
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x)
        for (const auto& [dx, dy] : {std::pair(-1, 0), {0, -1}, {-1, -1}, {1, -1}}) look(x, y, dx, dy);
      for (int x = width_; x-- > 0;) look(x, y, 1, 0);
    }
    for (int y = height_; y-- > 0;) {
      for (int x = width_; x-- > 0;)
        for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {-1, 1}}) look(x, y, dx, dy);
      for (int x = 0; x < width_; ++x) look(x, y, -1, 0);
    }
    return offsets;
  }

  Sheet layout_;  // of the canvas
  int rim_;       // pixels of the picture around it
  int width_ = 0, height_ = 0;
  std::vector<float> depth_;
  std::vector<Colour> colour_;
  std::vector<std::int32_t> body_;
  std::int32_t drawn_body_ = 0;
};

}  // namespace tribo
