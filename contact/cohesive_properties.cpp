// SPDX-License-Identifier: MIT
#include "contact/cohesive_properties.hpp"

#include "base/text.hpp"

#include <cmath>

namespace tribo {
namespace {

constexpr double default_first = 0.225926299;  // of a triangle; its peak and slope are then close to those of the cubic

/// Share of the area of the rectangle beyond the peak that lies under an exponential curve, times two: 1 for a line.
double fullness(double alpha) { return 2 * (1 / alpha - 1 / std::expm1(alpha)); }

/// Solves for the unknown ones of peak, toughness, critical, slope and first, with
///   peak = slope first critical,   toughness = 1/2 peak critical (first + (1 - first) f)
struct Triangle {
  double peak, toughness, critical, slope, first, f;

  bool has_shape() const { return first > 0 || slope > 0; }
  /// From two of peak, toughness and critical, and one of slope and first.
  void from_two() {
    const double area = 2 * toughness;
    if (first > 0) {
      const double c = first + (1 - first) * f;
      if (peak < 0) peak = area / (critical * c);
      if (critical < 0) critical = area / (peak * c);
    } else if (critical < 0) {
      const double elastic = peak / slope;
      critical = elastic + (area / peak - elastic) / f;
      first = elastic / critical;
    } else if (peak > 0) {
      first = peak / (slope * critical);
    } else {  // slope critical^2 first (first + (1 - first) f) = area
      const double b = area / (slope * critical * critical), g = 1 - f;
      first = 2 * b / (f + std::sqrt(f * f + 4 * g * b));
      peak = slope * first * critical;
    }
  }
  /// From one of peak, toughness and critical, with slope and first.
  void from_one() {
    const double c = first + (1 - first) * f;
    if (peak > 0)
      critical = peak / (slope * first);
    else if (critical < 0)
      critical = std::sqrt(2 * toughness / (slope * first * c));
    peak = slope * first * critical;
  }
};

bool same(double given, double found) { return given < 0 || std::abs(given - found) <= 1e-3 * std::abs(found); }

/// The values of a curve that was found; reports those given that differ.
bool agrees(const ModeProperties& given, const TractionCurve& curve, const ModeProblems& problems) {
  std::string wrong;
  const auto compare = [&](const char* stem, double value, double found) {
    if (!same(value, found))
      wrong +=
          (wrong.empty() ? "" : ", ") + problems.name(stem) + format(" (%.3g times the other value)", found / value);
  };
  compare("sigma", given.peak, curve.peak()), compare("J", given.toughness, curve.toughness());
  compare("del", given.critical, curve.critical()), compare("k", given.slope, curve.slope());
  compare("delpk", given.first, curve.elastic_limit() / curve.critical());
  if (!wrong.empty())
    problems.add("its properties contradict each other; what the others give differs from " + wrong +
                 ". Leave out one property");
  return wrong.empty();
}

using MakeTriangle = SharedCurve (*)(const Triangle&, double alpha);

SharedCurve triangle_from(const ModeProperties& given, double f, const ModeProblems& problems, MakeTriangle make) {
  Triangle t{given.peak, given.toughness, given.critical, given.slope, given.first, f};
  const int of_three = (t.peak > 0) + (t.toughness > 0) + (t.critical > 0);
  const bool is_line = f == 1;
  const auto name = [&](const char* stem) { return problems.name(stem); };
  const std::string three = name("sigma") + ", " + name("J") + " and " + name("del"),
                    two = name("k") + " and " + name("delpk");
  if (of_three == 0 || (of_three == 1 && !(t.slope > 0 && t.first > 0)) ||
      (of_three == 2 && !t.has_shape() && !is_line)) {
    problems.add("give two of " + three + ", and one of " + two +
                 (is_line ? " (without these, the peak is at 0.226 of the critical displacement)" : ""));
    return nullptr;
  }
  if (of_three == 1) {
    t.from_one();
  } else {
    if (of_three == 3 && !t.has_shape() && !is_line) t.first = (2 * t.toughness / (t.peak * t.critical) - f) / (1 - f);
    if (!t.has_shape()) t.first = default_first;
    if (of_three == 3) t.toughness = -1;  // compared below
    t.from_two();
  }
  if (!(t.first > 0 && t.first <= 1 + 1e-12 && t.peak > 0 && t.critical > 0 && std::isfinite(t.critical))) {
    problems.add(
        "its properties contradict each other: no curve of this shape has them. The peak must lie between 0 "
        "and " +
        name("del") +
        (is_line ? ", so that " + name("k") + " is at least " + name("sigma") + "^2/(2 " + name("J") + ")" : ""));
    return nullptr;
  }
  t.first = std::min(t.first, 1.0);
  const SharedCurve curve = make(t, given.alpha);
  return agrees(given, *curve, problems) ? curve : nullptr;
}

}  // namespace

void ModeProblems::add(const std::string& message) const {
  problems_.add(material_.origin, std::string(mode_ == 0 ? "opening (mode I): " : "sliding (mode II): ") + message);
}

std::string ModeProblems::name(const std::string& stem) const {
  const std::string mode = mode_ == 0 ? "I" : "II";
  const std::string tail = stem == "J" || stem == "del" ? "c" : stem == "k" ? "e" : "";
  const bool numbered = stem.back() == '2';
  return "<" + (numbered ? stem.substr(0, stem.size() - 1) + mode + "2" : stem + mode + tail) + ">";
}

SharedCurve triangular_from(const ModeProperties& given, const ModeProblems& problems) {
  return triangle_from(given, 1.0, problems, [](const Triangle& t, double) {
    const double d1 = t.first * t.critical;
    return piecewise_curve(d1, t.peak, d1, t.peak, t.critical);
  });
}

SharedCurve exponential_from(const ModeProperties& given, const ModeProblems& problems) {
  if (!(given.alpha > 0)) {
    problems.add("give " + problems.name("alpha"));
    return nullptr;
  }
  return triangle_from(given, fullness(given.alpha), problems, [](const Triangle& t, double alpha) {
    return exponential_curve(t.first * t.critical, t.peak, t.critical, alpha);
  });
}

SharedCurve cubic_from(const ModeProperties& given, const ModeProblems& problems) {
  double peak = given.peak, critical = given.critical;
  constexpr double share = 9.0 / 16;  // toughness divided by peak and critical displacement
  if (peak < 0 && given.toughness > 0) peak = given.toughness / (share * critical);
  if (critical < 0 && given.toughness > 0) critical = given.toughness / (share * peak);
  if (!(peak > 0 && critical > 0)) {
    problems.add("give two of " + problems.name("sigma") + ", " + problems.name("J") + " and " + problems.name("del"));
    return nullptr;
  }
  const SharedCurve curve = cubic_curve(peak, critical);
  return agrees(given, *curve, problems) ? curve : nullptr;
}

namespace {

/// Seven numbers of a trilinear curve, two of which follow from the other five:
///   2 toughness = T1 d2 + T2 (critical - d1),   slope = T1/d1
struct Trilinear {
  double T1, T2, first, second, critical, toughness, slope;

  // with the slope, and T1 or its place
  void from_slope() {
    const double area = 2 * toughness;
    if (T1 >= 0) {
      const double d1 = T1 / slope;
      if (critical < 0)
        critical = (area + T2 * d1) / (T1 * second + T2);
      else if (T2 < 0)
        T2 = (area - T1 * second * critical) / (critical - d1);
      else if (second < 0)
        second = (area - T2 * (critical - d1)) / (T1 * critical);
      first = d1 / critical;
    } else {
      const double a = slope * first * second, b = T2 * (1 - first);
      if (critical < 0) critical = a > 0 ? (-b + std::sqrt(b * b + 4 * a * area)) / (2 * a) : area / b;
      T1 = slope * first * critical;
      if (T2 < 0)
        T2 = (area / critical - T1 * second) / (1 - first);
      else if (second < 0)
        second = (area / critical - T2 * (1 - first)) / T1;
    }
  }
  // without it
  void from_corners() {
    const double area = 2 * toughness;
    if (critical < 0)
      critical = area / (T1 * second + T2 * (1 - first));
    else if (T1 < 0)
      T1 = (area / critical - T2 * (1 - first)) / second;
    else if (T2 < 0)
      T2 = (area / critical - T1 * second) / (1 - first);
    else if (first < 0)
      first = 1 - (area / critical - T1 * second) / T2;
    else if (second < 0)
      second = (area / critical - T2 * (1 - first)) / T1;
  }
};

}  // namespace

SharedCurve trilinear_from(const ModeProperties& given, const ModeProblems& problems) {
  Trilinear t{given.peak, given.peak2, given.first, given.second, given.critical, given.toughness, given.slope};
  const auto name = [&](const char* stem) { return problems.name(stem); };
  const bool has_slope = t.slope > 0;
  int count = has_slope;
  for (const double x : {t.T1, t.T2, t.first, t.second, t.critical, t.toughness}) count += x >= 0;
  if (count != 5 || (has_slope && (t.T1 >= 0) == (t.first >= 0))) {
    problems.add("give five of " + name("sigma") + ", " + name("delpk") + ", " + name("sigma2") + ", " +
                 name("delpk2") + ", " + name("del") + ", " + name("J") + " and " + name("k") + "; with " + name("k") +
                 " exactly one of " + name("sigma") + " and " + name("delpk") + format(" (%d are given)", count));
    return nullptr;
  }
  if (has_slope)
    t.from_slope();
  else
    t.from_corners();
  constexpr double slack = 1e-12;
  const bool order = t.first > 0 && t.first <= t.second + slack && t.second <= 1 + slack;
  if (!(order && t.critical > 0 && std::isfinite(t.critical) && t.T1 > 0 && t.T2 >= -slack * t.T1)) {
    problems.add("its properties contradict each other: the corners must be in order, 0 < " + name("delpk") +
                 " <= " + name("delpk2") + " <= 1, and their tractions not negative");
    return nullptr;
  }
  if (t.T2 * t.first > t.T1 * t.second * (1 + slack)) {
    problems.add(
        "the second corner lies above the line through 0 and the first one, so that the zone would become "
        "stiffer; lower " +
        name("sigma2"));
    return nullptr;
  }
  const double second = std::min(std::max(t.second, t.first), 1.0);
  return piecewise_curve(t.first * t.critical, t.T1, second * t.critical, std::max(t.T2, 0.0), t.critical);
}

}  // namespace tribo
