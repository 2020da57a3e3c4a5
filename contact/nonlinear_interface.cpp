// SPDX-License-Identifier: MIT
/// Nonlinear imperfect interface: each direction has a linear traction law, or one with a peak and softening.
///
///   linear     T(d) = D d
///   Morse      T(d) = 2 D_e a e^(-a d) (1 - e^(-a d)),  D_e = 8 peak^2/D, a = D/(4 peak)
///   bilinear   T(d) = D d up to the peak, then linearly down to zero at the opening `break`
///
/// The Morse law has the slope D at d = 0 and its peak at d = ln 2/a. All laws are elastic: the traction depends on the
/// present opening only, also after softening. The traction of a step is that of the opening at its start (leapfrog,
/// second order), or implicit if the stiffness is large for the step, see interface.hpp. The tangential law acts along
/// the tangential opening.

#include "contact/contact_law.hpp"
#include "contact/interface.hpp"

namespace tribo {
namespace {

struct NonlinearInterface final : ContactLaw {
  static constexpr std::string_view name = "NonlinearInterface";
  static constexpr std::string_view summary = "Imperfect interface, linear, bilinear or of Morse's shape.";
  static constexpr int number = 65;

  double open = -1, closed = -1, tangential = -1;
  /// The traction law of one direction, besides its initial stiffness.
  struct Shape {
    double kind = 0, peak = 0, last = 0;  ///< kind: 0 linear, 1 Morse, 2 bilinear; last: `break`
  };
  double normal_kind = 0, tangential_kind = 0, normal_peak = 0, tangential_peak = 0, normal_break = 0,
         tangential_break = 0;
  double stiffness() const override { return std::max({open, closed, tangential, 0.0}); }
  Shape normal_shape() const { return {normal_kind, normal_peak, normal_break}; }
  Shape tangential_shape() const { return {tangential_kind, tangential_peak, tangential_break}; }

  static auto parameters() {
    using L = NonlinearInterface;
    using P = Parameter<L>;
    constexpr auto D = Dimension::interface_stiffness;
    return std::array{
        P{"Dnt", &L::open, D, any_value, "normal stiffness at the start of opening", -1.0, false, "Dn"},
        P{"Dnc", &L::closed, D, any_value, "normal stiffness while closed (default: Dnt)", {}, true},
        P{"Dt", &L::tangential, D, any_value, "tangential stiffness at the start", -1.0},
        P{"normal_shape", &L::normal_kind, Dimension::none, within(0, 2), "0 linear, 1 Morse, 2 bilinear", 0.0},
        P{"tangential_shape", &L::tangential_kind, Dimension::none, within(0, 2), "0 linear, 1 Morse, 2 bilinear", 0.0},
        P{"Npeak", &L::normal_peak, Dimension::stress, positive, "largest normal traction", {}, true},
        P{"Tpeak", &L::tangential_peak, Dimension::stress, positive, "largest tangential traction", {}, true},
        P{"Nbreak", &L::normal_break, Dimension::length, positive, "opening without traction (bilinear)", {}, true},
        P{"Tbreak", &L::tangential_break, Dimension::length, positive, "slip without traction (bilinear)", {}, true}};
  }
  void prepare(const Statement& s, Problems& problems) {
    if (!s.child("Dnc")) closed = open;
    check(normal_shape(), open, 'N', s, problems);
    check(tangential_shape(), tangential, 'T', s, problems);
  }
  static void check(const Shape& shape, double D, char which, const Statement& s, Problems& problems) {
    const std::string N(1, which), direction = which == 'N' ? "normal_shape" : "tangential_shape";
    const auto must = [&](bool condition, const std::string& message) {
      if (!condition) problems.add(s.origin, message);
    };
    must(shape.kind == 0 || shape.kind == 1 || shape.kind == 2,
         "<" + direction + "> must be 0 (linear), 1 (Morse) or 2 (bilinear)");
    const std::string shape_name = shape.kind == 1 ? "Morse's shape" : "the bilinear shape";
    if (shape.kind == 0) {
      must(!(shape.peak > 0), "<" + N + "peak> has a meaning for Morse's and the bilinear shape only");
    } else {
      must(shape.peak > 0, shape_name + " needs <" + N + "peak>");
      must(D > 0, shape_name + " needs a positive <" + std::string(which == 'N' ? "Dnt" : "Dt") + ">");
    }
    if (shape.kind == 2)
      must(shape.last > shape.peak / D, shape_name + " needs <" + N + "break> beyond the opening at the peak");
    else
      must(!(shape.last > 0), "<" + N + "break> has a meaning for the bilinear shape only");
  }

  /// Traction at an opening, its derivative, and the energy per area.
  struct Pull {
    double traction, slope, energy;
  };
  static Pull linear(double D, double d) { return {D * d, D, 0.5 * D * d * d}; }
  static Pull morse(double D, double peak, double d) {
    const double well = 8 * peak * peak / D, a = D / (4 * peak), e = std::exp(-a * d);
    return {2 * well * a * e * (1 - e), 2 * well * a * a * e * (2 * e - 1), well * (1 - e) * (1 - e)};
  }
  static Pull bilinear(double D, double peak, double last, double d) {
    const double first = peak / D, down = -peak / (last - first);
    if (d <= first) return linear(D, d);
    if (d >= last) return {0, 0, 0.5 * peak * last};
    const double T = peak + down * (d - first);
    return {T, down, 0.5 * peak * first + 0.5 * (peak + T) * (d - first)};
  }
  static Pull pull(double D, const Shape& shape, double d) {
    return shape.kind == 1   ? morse(D, shape.peak, d)
           : shape.kind == 2 ? bilinear(D, shape.peak, shape.last, d)
                             : linear(D, d);
  }
  Pull normal_law(double d) const { return d < 0 ? linear(closed, d) : pull(open, normal_shape(), d); }
  Pull tangential_law(double d) const { return pull(tangential, tangential_shape(), d); }

  // Impulse of one direction: J = A dt T(d0 + beta dt v1) with v1 = v_free - J/m. It is explicit (beta = 0) unless the
  // spring is stiff for the step; then the equation is solved by Newton's method safeguarded by bisection.
  template <class F>
  static double impulse(const ContactState& m, const F& law, double d0, double v_free) {
    const Pull start = law(d0);
    const double beta = implicit_weight(m.dt * std::sqrt(std::max(start.slope, 0.0) * m.area / m.mass));
    const double strength = m.area * m.dt;
    double J = strength * start.traction;
    if (beta == 0.0) return J;
    const auto opening = [&](double impulse) { return d0 + beta * m.dt * (v_free - impulse / m.mass); };
    const auto residual = [&](double impulse) { return impulse - strength * law(opening(impulse)).traction; };
    // The residual changes its sign between a zero impulse and the impulse that leads to zero opening.
    const double back = m.mass * (v_free + d0 / (beta * m.dt));
    double low = std::min(0.0, back), high = std::max(0.0, back);
    const bool rising = residual(high) > 0;
    J = std::clamp(J, low, high);
    for (int k = 0; k < 100; ++k) {
      const double r = residual(J);
      if (r == 0) break;
      ((r > 0) == rising ? high : low) = J;
      const double slope = 1 + strength * law(opening(J)).slope * beta * m.dt / m.mass, newton = J - r / slope;
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (std::abs(next - J) <= 1e-15 * (std::abs(low) + std::abs(high))) break;
      J = next;
    }
    return J;
  }

  ContactResponse response(const ContactState& m) const override {
    ContactResponse out{Vec3::Zero(), ContactStatus::stick, m.bond, 0.0};
    const double d0 = m.opening.dot(m.normal), v = m.velocity.dot(m.normal);
    double J = m.mass * v;
    if (open >= 0 || closed >= 0) {
      const auto springs = [&](double d) { return (d >= 0 ? open : closed) < 0 ? Pull{0, 0, 0} : normal_law(d); };
      J = impulse(m, springs, d0, v);
      // If one side is perfectly bonded, the motion stops at zero opening.
      if (closed < 0) J = std::min(J, m.mass * (v + std::max(d0, 0.0) / m.dt));
      if (open < 0) J = std::max(J, m.mass * (v + std::min(d0, 0.0) / m.dt));
      out.stored += m.area * springs(d0 + m.dt * (v - J / m.mass)).energy;
    }
    out.impulse = J * m.normal;

    const auto along = [&](const Vec3& x) { return Vec3(x - x.dot(m.normal) * m.normal); };
    const Vec3 d = along(m.opening), w = along(m.velocity);
    if (tangential < 0) {
      out.impulse += m.mass * w;
      return out;
    }
    const double length = d.norm();
    if (!(length > 0)) return out;
    const Vec3 t = d / length;
    const auto law = [&](double x) {
      const Pull pull = tangential_law(std::abs(x));
      return Pull{x < 0 ? -pull.traction : pull.traction, pull.slope, pull.energy};
    };
    const double T = impulse(m, law, length, w.dot(t));
    out.impulse += T * t;
    out.stored += m.area * law((d + m.dt * (w - T / m.mass * t)).norm()).energy;
    return out;
  }
  bool is_interface() const override { return true; }
  bool uses_area() const override { return true; }
};

}  // namespace

Catalogue<ContactLaw>::Item nonlinear_interface() { return contact_law<NonlinearInterface>(); }

}  // namespace tribo
