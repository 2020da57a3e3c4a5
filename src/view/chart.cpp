// SPDX-License-Identifier: MIT
#include "view/chart.hpp"

#include "base/text.hpp"
#include "view/colours.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

constexpr double row_height = 18;
constexpr double width = 640, left = 74, right = 16, top = 34, plot_height = 220;
constexpr std::size_t most_points = 800;

struct Span {
  double low = 0.0, high = 1.0;
  double part(double v) const { return (v - low) / (high - low); }
};

Span span_of(const std::vector<Curve>& curves) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto& c : curves)
    for (const double v : c.values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return {};
  const double size = std::max(std::abs(low), std::abs(high)), margin = high - low > 1e-12 * size ? 0.04 * (high - low)
                                                                        : size > 0                ? 0.5 * size
                                                                                                  : 1.0;
  return {low - margin, high + margin};
}

std::string colour_name(int k) {
  const Colour c = distinct(k);
  return format("rgb(%d,%d,%d)", c[0], c[1], c[2]);
}

// Every n-th point, with the lowest and highest of those left out so that no peak is lost.
std::vector<std::size_t> thinned(const std::vector<double>& values) {
  std::vector<std::size_t> out;
  const std::size_t stride = 2 * (values.size() / most_points + 1);
  if (values.size() <= most_points) {
    for (std::size_t k = 0; k < values.size(); ++k) out.push_back(k);
    return out;
  }
  for (std::size_t k = 0; k < values.size(); k += stride) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k),
               last = values.begin() + static_cast<std::ptrdiff_t>(std::min(k + stride, values.size()));
    auto [low, high] = std::minmax_element(first, last);
    if (low > high) std::swap(low, high);
    out.push_back(static_cast<std::size_t>(low - values.begin()));
    if (high != low) out.push_back(static_cast<std::size_t>(high - values.begin()));
  }
  return out;
}

}  // namespace

std::vector<double> ticks(double low, double high, int wanted) {
  const double raw = (high - low) / std::max(1, wanted);
  if (!(raw > 0) || !std::isfinite(raw)) return {low};
  const double power = std::pow(10, std::floor(std::log10(raw))), mantissa = raw / power;
  const double step = power * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
  std::vector<double> out;
  const double first = std::ceil(low / step - 1e-9);
  if (!(std::abs(first) < 1e15)) return {low};  // differences are lost in round-off
  for (double k = first; k * step <= high + 1e-9 * step; ++k) out.push_back(k * step);
  return out;
}

std::string short_number(double x) { return format("%.4g", std::abs(x) < 1e-300 ? 0.0 : x); }

std::string chart(const std::string& title, const std::string& x_name, const std::vector<double>& x,
                  const std::vector<Curve>& curves) {
  const Span y = span_of(curves);
  Span across{x.empty() ? 0.0 : x.front(), x.empty() ? 1.0 : x.back()};
  if (!(across.high > across.low)) across.high = across.low + 1;
  const double plot_width = width - left - right, bottom = top + plot_height;
  const auto at_x = [&](double v) { return left + plot_width * across.part(v); };
  const auto at_y = [&](double v) { return bottom - plot_height * y.part(v); };
  const std::size_t rows = (curves.size() + 1) / 2;
  const double height = bottom + 48 + row_height * static_cast<double>(rows);

  std::string out = format("<svg viewBox='0 0 %g %g' role='img'>", width, height);
  out += format("<text x='%g' y='20' class='title'>", left) + escaped(title) + "</text>";
  for (const double v : ticks(y.low, y.high, 5)) {
    out += format("<line x1='%g' x2='%g' y1='%.1f' y2='%.1f' class='grid'/>", left, width - right, at_y(v), at_y(v));
    out += format("<text x='%g' y='%.1f' text-anchor='end'>%s</text>", left - 6, at_y(v) + 4, short_number(v).c_str());
  }
  for (const double v : ticks(across.low, across.high, 6)) {
    out += format("<line x1='%.1f' x2='%.1f' y1='%g' y2='%g' class='grid'/>", at_x(v), at_x(v), top, bottom);
    out +=
        format("<text x='%.1f' y='%g' text-anchor='middle'>%s</text>", at_x(v), bottom + 16, short_number(v).c_str());
  }
  out += format("<rect x='%g' y='%g' width='%g' height='%g' class='frame'/>", left, top, plot_width, plot_height);
  out += format("<text x='%g' y='%g' text-anchor='end'>", width - right, bottom + 34) + escaped(x_name) + "</text>";
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const std::string colour = colour_name(static_cast<int>(k));
    std::string path;
    bool pen = false;
    for (const std::size_t i : thinned(curves[k].values)) {
      const double v = curves[k].values[i];
      if (i < x.size() && std::isfinite(v)) path += format("%s%.1f %.1f", pen ? "L" : "M", at_x(x[i]), at_y(v));
      pen = std::isfinite(v);
    }
    out += "<path d='" + path + "' stroke='" + colour + "'/>";
    const std::size_t line = k / 2;
    const double name_x = left + static_cast<double>(k % 2) * 0.5 * plot_width,
                 name_y = bottom + 52 + row_height * static_cast<double>(line);
    out += format("<line x1='%g' x2='%g' y1='%g' y2='%g' style='stroke:%s;stroke-width:3'/>", name_x, name_x + 18,
                  name_y - 4, name_y - 4, colour.c_str());
    out += format("<text x='%g' y='%g'>", name_x + 24, name_y) + escaped(curves[k].name) + "</text>";
  }
  return out + "</svg>\n";
}

}  // namespace tribo
