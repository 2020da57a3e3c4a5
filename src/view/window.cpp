// SPDX-License-Identifier: MIT
#include "view/window.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

using Corners = std::array<std::array<double, 3>, 2>;

Window projected(const Camera& eye, const Corners& box) {
  Window w{1e300, -1e300, 1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < 3; ++d) x[d] = box[static_cast<std::size_t>(corner >> d & 1)][d];
    const Vec3 p = eye.project(x);
    w.left = std::min(w.left, p[0]), w.right = std::max(w.right, p[0]);
    w.low = std::min(w.low, p[1]), w.high = std::max(w.high, p[1]);
  }
  return w;
}

std::string interval(const std::string& name, double low, double high) {
  return name + " from " + format("%.6g", low) + " to " + format("%.6g", high);
}

Window of_limits(const std::vector<double>& limits, const std::string& view, const Corners& box) {
  const Camera eye = camera(view);
  if (eye.right_name.empty())
    throw UsageError("--window gives limits along two axes, which the view '" + view +
                     "' does not have: use --zoom and --centre, or --view xy, xz or yz");
  const Window w{limits[0], limits[1], limits[2], limits[3]}, all = projected(eye, box);
  const auto must_be_in_order = [](const std::string& axis, double low, double high) {
    if (!(low < high))
      throw UsageError("--window: " + axis + " goes " + interval("", low, high).substr(1) +
                       "; the first value must be below the second");
  };
  must_be_in_order(eye.right_name, w.left, w.right), must_be_in_order(eye.up_name, w.low, w.high);
  if (w.left >= all.right || w.right <= all.left || w.low >= all.high || w.high <= all.low)
    throw UsageError("--window: nothing lies in it; the particles lie in " +
                     interval(eye.right_name, all.left, all.right) + ", " + interval(eye.up_name, all.low, all.high));
  return w;
}

Vec3 centre_of(const std::vector<double>& given, const Corners& box) {
  if (given.empty()) {
    const Corners b = box;
    return 0.5 * (Vec3::Map(b[0].data()) + Vec3::Map(b[1].data()));
  }
  const bool flat = box[1][2] <= box[0][2];
  if (given.size() != 3 && !(flat && given.size() == 2))
    throw UsageError(flat ? "--centre needs two numbers, x,y" : "--centre needs three numbers, x,y,z");
  Vec3 centre(given[0], given[1], given.size() == 3 ? given[2] : box[0][2]);
  for (std::size_t d = 0; d < 3; ++d)
    if (const double x = centre[static_cast<Eigen::Index>(d)]; !(x >= box[0][d] && x <= box[1][d]))
      throw UsageError(std::string("--centre: ") + "xyz"[d] + " = " + format("%.6g", x) +
                       " lies outside of the particles, " + interval(std::string(1, "xyz"[d]), box[0][d], box[1][d]));
  return centre;
}

}  // namespace

Window window_around(const Camera& eye, const Corners& box) {
  Window w = projected(eye, box);
  const double around = 0.02 * std::max(w.right - w.left, w.high - w.low);
  return {w.left - around, w.right + around, w.low - around, w.high + around};
}

Window chosen_window(const WindowOptions& options, const std::string& view, const Corners& box) {
  if (!options.limits.empty()) return of_limits(options.limits, view, box);
  if (!(options.zoom > 0) || !std::isfinite(options.zoom))
    throw UsageError(format("--zoom: the magnification must be above 0, not %g", options.zoom));
  const Camera eye = camera(view);
  const Window all = window_around(eye, box);
  const Vec3 at = centre_of(options.centre, box), middle = eye.project({at[0], at[1], at[2]});
  const double u = 0.5 * (all.right - all.left) / options.zoom, v = 0.5 * (all.high - all.low) / options.zoom;
  return {middle[0] - u, middle[0] + u, middle[1] - v, middle[1] + v};
}

}  // namespace tribo
