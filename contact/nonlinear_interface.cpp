/// Imperfect interface with nonlinear traction laws: linear, or of Morse's shape with a peak after which it softens.
///
///   Morse   T(d) = 2 D_e a e^(-a d) (1 - e^(-a d)),  D_e = 8 peak^2/D, a = D/(4 peak)
///
/// has the slope D at zero and the largest traction `peak` at d = ln 2/a. The step takes the mean of the tractions at
/// its two ends (second order, energy T averaged along the way), by Newton's method. The tangential law acts on the
/// length of the tangential opening.

#include "contact/contact_law.hpp"
#include "contact/interface.hpp"

namespace tribo {
namespace {

struct NonlinearInterface final : ContactLaw {
  static constexpr std::string_view name = "NonlinearInterface";
  static constexpr std::string_view summary = "Imperfect interface, linear, bilinear or of Morse's shape.";
  static constexpr int number = 65;

  double open = -1, closed = -1, tangential = -1;
  double normal_shape = 0, tangential_shape = 0, normal_peak = 0, tangential_peak = 0;

  static auto parameters() {
    using L = NonlinearInterface;
    using P = Parameter<L>;
    constexpr auto D = Dimension::interface_stiffness;
    return std::array{
        P{"Dnt", &L::open, D, any_value, "normal stiffness at the start of opening", -1.0, false, "Dn"},
        P{"Dnc", &L::closed, D, any_value, "normal stiffness while closed (default: Dnt)", {}, true},
        P{"Dt", &L::tangential, D, any_value, "tangential stiffness at the start", -1.0},
        P{"normal_shape", &L::normal_shape, Dimension::none, within(0, 1), "0 linear, 1 Morse", 0.0},
        P{"tangential_shape", &L::tangential_shape, Dimension::none, within(0, 1), "0 linear, 1 Morse", 0.0},
        P{"Npeak", &L::normal_peak, Dimension::stress, positive, "largest normal traction (Morse)", {}, true},
        P{"Tpeak", &L::tangential_peak, Dimension::stress, positive, "largest tangential traction (Morse)", {}, true}};
  }
  void prepare(const Statement& s, Problems& problems) {
    if (!s.child("Dnc")) closed = open;
    const auto check = [&](double shape, double peak, const char* which, double D, const char* stiffness) {
      if (shape != 0 && shape != 1)
        problems.add(s.origin, std::string("<") + which + "_shape> must be 0 (linear) or 1 (Morse)");
      const std::string peak_name = which[0] == 'n' ? "<Npeak>" : "<Tpeak>";
      if (shape == 1 && !(peak > 0)) problems.add(s.origin, "Morse's shape needs " + peak_name);
      if (shape == 1 && !(D > 0))
        problems.add(s.origin, std::string("Morse's shape needs a positive <") + stiffness + ">");
      if (shape == 0 && peak > 0) problems.add(s.origin, peak_name + " has a meaning for Morse's shape only");
    };
    check(normal_shape, normal_peak, "normal", open, "Dnt");
    check(tangential_shape, tangential_peak, "tangential", tangential, "Dt");
  }

  /// Traction, its slope, and the energy per area up to an opening.
  struct Pull {
    double traction, slope, energy;
  };
  static Pull linear(double D, double d) { return {D * d, D, 0.5 * D * d * d}; }
  static Pull morse(double D, double peak, double d) {
    const double well = 8 * peak * peak / D, a = D / (4 * peak), e = std::exp(-a * d);
    return {2 * well * a * e * (1 - e), 2 * well * a * a * e * (2 * e - 1), well * (1 - e) * (1 - e)};
  }
  Pull normal_law(double d) const {
    if (d < 0) return linear(closed, d);
    return normal_shape == 1 ? morse(open, normal_peak, d) : linear(open, d);
  }
  Pull tangential_law(double d) const {
    return tangential_shape == 1 ? morse(tangential, tangential_peak, d) : linear(tangential, d);
  }

  // Impulse of one direction: J = A dt (T(d0) + T(d1))/2, d1 = d0 + dt (v0 + v_free - J/m)/2. Bracketed Newton; stiff
  // springs (see interface.hpp) weigh the end more.
  template <class F>
  static double impulse(const Meeting& m, const F& law, double d0, double v0, double v_free) {
    const Pull start = law(d0);
    const double phi = m.dt * std::sqrt(std::max(start.slope, 0.0) * m.area / m.mass);
    const double theta = phi <= 3 ? 0.5 : 1 - 1.5 / phi;
    const auto opening = [&](double J) { return d0 + m.dt * ((1 - theta) * v0 + theta * (v_free - J / m.mass)); };
    const auto residual = [&](double J) {
      return J - m.area * m.dt * ((1 - theta) * start.traction + theta * law(opening(J)).traction);
    };
    // Between no impulse and the one that returns to zero opening the residual changes its sign.
    double J = m.area * m.dt * start.traction;
    const double back = m.mass * (v_free + (d0 / m.dt + (1 - theta) * v0) / theta);
    double low = std::min({0.0, back, J}), high = std::max({0.0, back, J});
    if (residual(low) * residual(high) > 0) return J / (1 + 0.25 * phi * phi);
    const bool rising = residual(high) > 0;
    for (int k = 0; k < 100 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); ++k) {
      const double r = residual(J);
      if (r == 0) break;
      ((r > 0) == rising ? high : low) = J;
      const double slope = 1 + m.area * m.dt * theta * law(opening(J)).slope * m.dt * theta / m.mass;
      const double next = J - r / slope;
      if (std::abs(next - J) <= 1e-15 * std::abs(J)) break;
      J = next > low && next < high ? next : 0.5 * (low + high);
    }
    return J;
  }

  Answer answer(const Meeting& m) const override {
    Answer out{Vec3::Zero(), Touch::stick, m.bond, 0.0};
    const double d0 = m.opening.dot(m.normal), v0 = m.start.dot(m.normal), v = m.velocity.dot(m.normal);
    double J =
        open < 0 && closed < 0 ? m.mass * v
        : open < 0 || closed < 0
            ? impulse(
                  m,
                  [&](double d) {
                    return open < 0 && d >= 0 ? Pull{0, 0, 0} : closed < 0 && d < 0 ? Pull{0, 0, 0} : normal_law(d);
                  },
                  d0, v0, v)
            : impulse(
                  m, [&](double d) { return normal_law(d); }, d0, v0, v);
    // A perfect side is a stop that the motion of the other side cannot pass.
    if (closed < 0 && open >= 0) J = std::min(J, m.mass * (v + std::max(d0, 0.0) / m.dt));
    if (open < 0 && closed >= 0) J = std::max(J, m.mass * (v + std::min(d0, 0.0) / m.dt));
    const double d1 = opening_after(m.mass, d0, v0, v, J, m.dt);
    if ((d1 >= 0 && open >= 0) || (d1 < 0 && closed >= 0)) out.stored += m.area * normal_law(d1).energy;
    out.impulse = J * m.normal;

    const auto along = [&](const Vec3& x) { return Vec3(x - x.dot(m.normal) * m.normal); };
    const Vec3 d = along(m.opening), w0 = along(m.start), w = along(m.velocity);
    if (tangential < 0) {
      out.impulse += m.mass * w;
      return out;
    }
    // Isotropic: along the opening that the step would reach halfway, and elastic across it.
    const Vec3 ahead = d + 0.25 * m.dt * (w0 + w);
    const double length = ahead.norm();
    if (!(length > 0)) return out;
    const Vec3 t = ahead / length;
    const double T = impulse(
        m,
        [&](double x) {
          return x < 0 ? Pull{-tangential_law(-x).traction, tangential_law(-x).slope, 0.0} : tangential_law(x);
        },
        d.dot(t), w0.dot(t), w.dot(t));
    out.impulse += T * t;
    const double t1 = std::abs(opening_after(m.mass, d.dot(t), w0.dot(t), w.dot(t), T, m.dt));
    out.stored += m.area * tangential_law(t1).energy;
    return out;
  }
  bool interface() const override { return true; }
  bool uses_area() const override { return true; }
};

}  // namespace

Catalogue<ContactLaw>::Item nonlinear_interface() { return contact_law<NonlinearInterface>(); }

}  // namespace tribo
