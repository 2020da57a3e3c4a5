// SPDX-License-Identifier: MIT
/// Nonlinear imperfect interface: each direction has a linear traction law, or one with a peak and softening.
///
///   linear     T(d) = D d
///   Morse      T(d) = 2 D_e a e^(-a d) (1 - e^(-a d)),  D_e = 8 peak^2/D, a = D/(4 peak)
///   bilinear   T(d) = D d up to the peak, then linearly down to zero at the opening `break`
///
/// The Morse law has the slope D at d = 0 and its peak at d = ln 2/a. All laws are elastic: the traction depends on the
/// present opening only, also after softening. The tangential law acts along the tangential opening.

#include "contact/interface.hpp"

namespace tribo {
namespace {

struct NonlinearInterface final : InterfaceLaw {
  static constexpr std::string_view name = "NonlinearInterface";
  static constexpr std::string_view summary =
      "Imperfect interface whose traction is a linear or bilinear function of the opening, or has Morse's shape.";
  static constexpr int number = 65;
  static constexpr std::string_view needs =
      "if normal_shape is 1 or 2, positive Dnt and Npeak, and if it is 2 also Nbreak; if tangential_shape is 1 or 2, "
      "positive Dt and Tpeak, and if it is 2 also Tbreak";
  static constexpr std::string_view example = R"(
<Material Type='NonlinearInterface' Name='interface'>
  <Dnt>1e9</Dnt>
  <Dnc>1e10</Dnc>
  <Dt>5e8</Dt>
  <normal_shape>2</normal_shape>
  <Npeak>1e5</Npeak>
  <Nbreak>1e-3</Nbreak>
</Material>)";

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
        P{"Dnt", &L::open, D, any_value,
          "normal stiffness at the start of opening; negative: the interface cannot open", -1.0, false, "Dn"},
        P{"Dnc", &L::closed, D, any_value, "normal stiffness of the closed interface (default: Dnt)", {}, true},
        P{"Dt", &L::tangential, D, any_value,
          "tangential stiffness at the start of slip; negative: the interface cannot slip", -1.0},
        P{"normal_shape", &L::normal_kind, Dimension::none, within(0, 2),
          "shape of the normal traction over the opening: 0 linear, 1 Morse, 2 bilinear", 0.0},
        P{"tangential_shape", &L::tangential_kind, Dimension::none, within(0, 2),
          "shape of the tangential traction over the slip: 0 linear, 1 Morse, 2 bilinear", 0.0},
        P{"Npeak", &L::normal_peak, Dimension::stress, positive, "largest normal traction", {}, true},
        P{"Tpeak", &L::tangential_peak, Dimension::stress, positive, "largest tangential traction", {}, true},
        P{"Nbreak",
          &L::normal_break,
          Dimension::length,
          positive,
          "bilinear shape: opening at which the normal traction has vanished",
          {},
          true},
        P{"Tbreak",
          &L::tangential_break,
          Dimension::length,
          positive,
          "bilinear shape: slip at which the tangential traction has vanished",
          {},
          true}};
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

  /// Traction at an opening and the energy per area.
  struct Pull {
    double traction = 0, energy = 0;
  };
  static Pull linear(double D, double d) {
    const double T = std::max(D, 0.0) * d;
    return {T, 0.5 * T * d};
  }
  static Pull morse(double D, double peak, double d) {
    const double well = 8 * peak * peak / D, a = D / (4 * peak), e = std::exp(-a * d);
    return {2 * well * a * e * (1 - e), well * (1 - e) * (1 - e)};
  }
  static Pull bilinear(double D, double peak, double last, double d) {
    const double first = peak / D, down = -peak / (last - first);
    if (d <= first) return linear(D, d);
    if (d >= last) return {0, 0.5 * peak * last};
    const double T = peak + down * (d - first);
    return {T, 0.5 * peak * first + 0.5 * (peak + T) * (d - first)};
  }
  static Pull pull(double D, const Shape& shape, double d) {
    return shape.kind == 1   ? morse(D, shape.peak, d)
           : shape.kind == 2 ? bilinear(D, shape.peak, shape.last, d)
                             : linear(D, d);
  }
  Pull normal_law(double d) const { return d < 0 ? linear(closed, d) : pull(open, normal_shape(), d); }
  Pull tangential_law(double d) const { return pull(tangential, tangential_shape(), d); }

  bool bonds_normal() const override { return open < 0 && closed < 0; }
  bool bonds_tangential() const override { return tangential < 0; }
  // A direction with a peak stays elastic, however stiff it is before the peak.
  std::shared_ptr<const InterfaceLaw> limited(double largest) const override {
    auto law = std::make_shared<NonlinearInterface>(*this);
    if (normal_kind == 0)
      limit_normal(law->open, law->closed, largest);
    else if (closed < 0 || closed > largest)
      law->closed = largest;
    if (tangential_kind == 0 && tangential > largest) law->tangential = -1;
    return law;
  }
  Traction traction(double normal, double shear) const override {
    const Pull n = bonds_normal() ? Pull{} : normal_law(normal),
               s = bonds_tangential() ? Pull{} : tangential_law(shear);
    return {n.traction, s.traction, n.energy + s.energy};
  }
};

}  // namespace

Catalogue<ContactLaw>::Item nonlinear_interface() { return contact_law<NonlinearInterface>(); }

}  // namespace tribo
