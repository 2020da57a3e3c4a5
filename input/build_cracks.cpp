// SPDX-License-Identifier: MIT
/// Cracks: their lines or surfaces, and the laws between their faces.

#include "base/text.hpp"
#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double most_pieces = 1e5;  // of a crack: segments or triangles

/// Builds the geometry of a crack from its parts.
class CrackShape {
 public:
  CrackShape(CrackSpec& crack, double cell) : crack_(crack), cell_(cell) {}

  void to(const Vec3& x) {
    if (!crack_.points.empty() && (x - crack_.points.back()).norm() <= 1e-9 * cell_) return;
    crack_.points.push_back(x);
    const auto last = static_cast<std::uint32_t>(crack_.points.size()) - 1;
    if (last > 0) crack_.pieces.push_back({last - 1, last, 0});
  }

  /// Adds triangles between (n+1) x (m+1) points x(i/n, j/m).
  template <class F>
  void sheet(int n, int m, F&& x) {
    const auto first = static_cast<std::uint32_t>(crack_.points.size());
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= n; ++i) crack_.points.push_back(x(static_cast<double>(i) / n, static_cast<double>(j) / m));
    const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i) {
        crack_.pieces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        crack_.pieces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }

  /// Adds a disc of triangles between concentric rings; the k-th ring has 6 k points.
  void disc(const Vec3& centre, const Vec3& normal, double radius) {
    const Vec3 n = normal.normalized(), a = n.unitOrthogonal(), b = n.cross(a);
    const int rings = static_cast<int>(pieces(radius));
    std::vector<std::uint32_t> inner{static_cast<std::uint32_t>(crack_.points.size())};
    crack_.points.push_back(centre);
    for (int k = 1; k <= rings; ++k) {
      std::vector<std::uint32_t> outer;
      for (int i = 0; i < 6 * k; ++i) {
        const double angle = 2 * pi * i / (6 * k);
        outer.push_back(static_cast<std::uint32_t>(crack_.points.size()));
        crack_.points.push_back(centre + radius * k / rings * (std::cos(angle) * a + std::sin(angle) * b));
      }
      for (int sector = 0; sector < 6; ++sector)
        for (int i = 0; i < k; ++i) {
          const auto out = [&](int m) { return outer[static_cast<std::size_t>((sector * k + m) % (6 * k))]; };
          const auto in = [&](int m) {
            return k == 1 ? inner[0] : inner[static_cast<std::size_t>((sector * (k - 1) + m) % (6 * (k - 1)))];
          };
          crack_.pieces.push_back({in(i), out(i), out(i + 1)});
          if (i + 1 < k) crack_.pieces.push_back({in(i), out(i + 1), in(i + 1)});
        }
      inner = outer;
    }
  }

  /// Default number of segments of a length: two per cell.
  double pieces(double length) const { return std::max(1.0, std::ceil(2 * length / cell_ - 1e-9)); }

 private:
  CrackSpec& crack_;
  double cell_;
};

}  // namespace

// The joint law that an element names; null if it names none.
std::shared_ptr<const JointLaw> Builder::traction_law(const Statement& s, const char* by_number, const char* by_name) {
  const Attribute* number = s.attribute(by_number);
  if (!s.attribute(by_name) && (!number || number->text == "0")) return nullptr;
  const auto k = static_cast<std::size_t>(material(s, by_number, by_name));
  if (k >= model_.materials.size()) return nullptr;
  const MaterialSpec& law = model_.materials[k];
  must(tribo::joint_laws().find(law.type) != nullptr, s.origin,
       "'" + law.name + "' at " + law.origin.text() + " is no traction law; valid types: " +
           join({"TriangularTraction", "CubicTraction", "TrilinearTraction", "CoupledTraction", "MixedModeTraction",
                 "ExponentialTraction", "LinearTraction", "PressureTraction", "Mohr", "SpringNetwork"}));
  must_suit_grid(law, s.origin);
  return law.joint;
}

CrackSpec Builder::crack(const Statement& s, std::vector<std::shared_ptr<const JointLaw>>& tractions) {
  CrackSpec out;
  out.origin = s.origin;
  double cell = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d)
    cell = std::min(cell, (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[d]);
  CrackShape shape(out, cell);
  const bool solid = model_.dimension() == 3;
  bool refused = false;  // a part of it
  std::shared_ptr<const JointLaw> of_first_point;
  for (const auto& part : s.children) {
    if (part.name == "Thickness") continue;
    const bool surface = part.name == "Quad" || part.name == "Disc";
    if (surface != solid) {
      problems_.add(part.origin, "<" + part.name + "> belongs to cracks in " + (surface ? "three" : "two") +
                                     " dimensions" +
                                     (solid ? "; use <Quad> or <Disc>" : "; use <pt>, <Line> or <Circle>"));
      continue;
    }
    const double unit = unit_factor(part, Dimension::length);
    const auto at = [&](const char* x, const char* y, const char* z = nullptr) {
      return Vec3(number(part, x, Dimension::length), number(part, y, Dimension::length),
                  z ? number(part, z, Dimension::length) : 0.0);
    };
    const double resolution = number(part, "resolution", Dimension::none);
    // The size of a crack is known before memory is spent on it.
    const auto fits = [&](double count) {
      const double all = static_cast<double>(out.pieces.size()) + count;
      const bool good = all <= most_pieces;
      must(good, part.origin,
           format("this crack would have %.3g %s; at most %.0e are possible: use larger cells%s", all,
                  solid ? "triangles" : "segments", most_pieces, resolution > 0 ? " or a lower 'resolution'" : ""));
      return good;
    };
    must(!has(part, "resolution") || resolution >= 1, part.origin,
         "'resolution' must be a number of segments, at least 1");
    const bool begins = out.points.empty();
    if (part.name == "pt") {
      set_end(part, "tip", out.ends[begins ? 0 : 1]);
      shape.to(at("x", "y"));
    } else if (part.name == "Line" || part.name == "Circle") {
      const Vec3 a(coordinate(part, "xmin", 0), coordinate(part, "ymin", 1), 0),
          b(coordinate(part, "xmax", 0), coordinate(part, "ymax", 1), 0);
      const double from = number(part, "start_angle", Dimension::angle),
                   to = number(part, "end_angle", Dimension::angle, 360.0);
      const Vec3 middle = 0.5 * (a + b), half = 0.5 * (b - a);
      const bool line = part.name == "Line";
      const double length = line ? (b - a).norm() : std::abs(to - from) * half.cwiseAbs().maxCoeff();
      must(length > 0, part.origin, "<" + part.name + "> has no length");
      const double count = std::max(1.0, resolution > 0 ? resolution : shape.pieces(length));
      const double most = std::max(500.0, 25 * shape.pieces(length));
      must(
          resolution <= most, part.origin,
          format("'resolution' %.6g makes segments much shorter than a cell, which cost time without use; at most %.0f",
                 resolution, most));
      if (resolution > most || !fits(count)) {
        refused = true;
        continue;
      }
      const int n = static_cast<int>(count);
      if (begins) set_end(part, "start_tip", out.ends[0]);
      set_end(part, "end_tip", out.ends[1]);
      for (int k = 0; k <= n; ++k) {
        const double t = static_cast<double>(k) / n, angle = from + t * (to - from);
        shape.to(line ? Vec3(a + t * (b - a))
                      : Vec3(middle + Vec3(half[0] * std::cos(angle), half[1] * std::sin(angle), 0)));
      }
    } else if (part.name == "Quad") {
      const Vec3 corner = at("x1", "y1", "z1"), u = at("x2", "y2", "z2") - corner, v = at("x3", "y3", "z3") - corner;
      must(u.cross(v).norm() > 0, part.origin, "the corners of <Quad> are collinear");
      const double n = shape.pieces(u.norm()), m = shape.pieces(v.norm());
      if (fits(2 * n * m))
        shape.sheet(static_cast<int>(n), static_cast<int>(m),
                    [&](double i, double j) { return Vec3(corner + i * u + j * v); });
    } else {
      const Vec3 normal(number(part, "nx", Dimension::none), number(part, "ny", Dimension::none),
                        number(part, "nz", Dimension::none, has(part, "nx") || has(part, "ny") ? 0.0 : 1.0));
      const double radius = number(part, "radius", Dimension::length);
      must(radius > 0 && normal.norm() > 0, part.origin, "<Disc> needs a positive 'radius' and a normal");
      if (radius > 0 && normal.norm() > 0 && fits(6 * std::pow(shape.pieces(radius), 2)))
        shape.disc(at("x", "y", "z"), normal, radius);
    }
    static_cast<void>(unit);
    if (solid) continue;
    auto traction = traction_law(part, "mat", "matname");
    if (!traction) traction = of_first_point;
    of_first_point = out.pieces.empty() ? traction : nullptr;
    tractions.resize(out.pieces.size(), traction);
  }
  must(refused || !out.pieces.empty(), s.origin,
       solid ? "this crack has no surface" : "a crack needs at least two points");
  for (const Vec3& x : out.points)
    for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d)
      if (const double v = x[static_cast<Eigen::Index>(d)]; v < model_.grid.low[d] || v > model_.grid.high[d]) {
        problems_.add(s.origin, "this crack leaves the grid; enlarge <Grid> or end the crack within it");
        return out;
      }
  return out;
}

// Type of an end from its code: number of the material around the tip, -1 no tip, -2 outside the body.
void Builder::set_end(const Statement& s, const char* code, CrackSpec::End& end) {
  end = CrackSpec::End::found;
  if (!has(s, code)) return;
  const auto tip = static_cast<int>(number(s, code, Dimension::none));
  const auto count = static_cast<int>(material_statements_.size());
  must(tip == -2 || tip == -1 || (tip >= 1 && tip <= count), s.origin,
       "'" + std::string(code) +
           "' must be the number of the material around the tip, -1 (no tip) or -2 (outside the body)");
  end = tip == -2 ? CrackSpec::End::exterior : tip == -1 ? CrackSpec::End::none : CrackSpec::End::tip;
}

// Settings that say what Tribo does anyway, and others without effect.
void Builder::crack_settings(const Statement& general) {
  const bool none = model_.cracks.empty(),
             laws = std::all_of(general.children.begin(), general.children.end(),
                                [](const Statement&s) { return s.name == "Friction" || s.name == "ContactPosition"; });
  if (none && laws)  // written with every model by the desktop program
    problems_.warn(general.origin, "<Cracks> without a <CrackList> has no effect");
  must(!none || laws, general.origin, "<Cracks> without a <CrackList> has no effect");
  if (const Statement* position = general.child("ContactPosition"); position && !none)
    problems_.warn(position->origin,
                   "<ContactPosition> has no effect on cracks: gaps follow from the displacements of their faces");
  if (const Statement* thickness = general.child("Thickness")) crack_thickness(*thickness);
  if (const Statement* plane = general.child("MovePlane")) {
    must(word(*plane, "type", "avg") == "avg", plane->origin,
         "a crack that moves with the centre of mass (cm) is not implemented; it moves with the mean of its two faces "
         "(avg)");
    must(word(*plane, "prevent", "no") == "no", plane->origin,
         "a check of the line of a crack that prevents its faces from crossing is not implemented; their contact does");
  }
}

void Builder::crack_thickness(const Statement& s) {
  const double thickness = text_number(s, Dimension::length);
  must(std::abs(thickness - model_.grid.thickness) <= 1e-9 * model_.grid.thickness, s.origin,
       "a crack is as thick as the grid, " + format("%.6g", model_.grid.thickness) +
           "; another thickness is not implemented");
}

// Parts with different laws are cracks of their own with common ends.
void Builder::add_crack(const CrackSpec& all, const std::vector<std::shared_ptr<const JointLaw>>& tractions) {
  if (std::all_of(tractions.begin(), tractions.end(), [&](const auto& t) { return t == tractions.front(); })) {
    model_.cracks.push_back(all);
    if (!tractions.empty() && tractions.front())
      model_.cracks.back().joint = tractions.front(), model_.cracks.back().law = nullptr;
    return;
  }
  for (std::size_t first = 0, end = 0; first < tractions.size(); first = end) {
    while (end < tractions.size() && tractions[end] == tractions[first]) ++end;
    CrackSpec part = all;
    part.points.assign(all.points.begin() + static_cast<std::ptrdiff_t>(first),
                       all.points.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    part.pieces.assign(all.pieces.begin(), all.pieces.begin() + static_cast<std::ptrdiff_t>(end - first));
    if (first > 0) part.ends[0] = CrackSpec::End::none;
    if (end < tractions.size()) part.ends[1] = CrackSpec::End::none;
    if (tractions[first]) part.joint = tractions[first], part.law = nullptr;
    model_.cracks.push_back(std::move(part));
  }
}

void Builder::cracks() {
  const Statement* general = root_.child("MPMHeader")->child("Cracks");
  struct Laws {
    std::shared_ptr<const ContactLaw> contact;
    std::shared_ptr<const JointLaw> joint;
  };
  const auto named = [&](const Statement& s) -> Laws {
    const MaterialSpec* law = named_law(s);
    if (!law) return {};
    must_suit_grid(*law, s.origin);
    return {law->contact, law->joint};
  };
  Laws fallback;
  if (const Statement* f = general ? general->child("Friction") : nullptr)
    fallback = has(*f, "law") || has(*f, "lawname") ? named(*f) : Laws{law_by_number(*f), nullptr};
  else
    fallback.contact = tribo::contact_laws().find("CoulombFriction")->make(Statement{}, {}, model_.units, problems_);
  for (const auto& s : root_.children) {
    if (s.name != "CrackList") continue;
    std::vector<std::shared_ptr<const JointLaw>> tractions;
    CrackSpec spec = crack(s, tractions);
    if (const Statement* thickness = s.child("Thickness")) crack_thickness(*thickness);
    Laws laws = fallback;
    if (has(s, "law") || has(s, "lawname")) {
      laws = named(s);
    } else if (const Attribute* friction = s.attribute("friction")) {
      Statement number = s;
      number.text = friction->text, number.text_origin = friction->origin;
      laws = {law_by_number(number), nullptr};
    }
    spec.law = laws.contact, spec.joint = laws.joint;
    spec.fixed = word(s, "type") == "fixed";
    // Faces that ignore each other have no law at all.
    if (spec.law && !spec.law->uses_face() && !spec.law->interface()) spec.law = nullptr;
    must(!spec.law || spec.law->liquid() == 0, s.origin,
         "LiquidContact needs a liquid on one side and cannot act between the faces of a crack");
    if (const auto rest = traction_law(s, "Tprop", "Tpropname"))
      for (auto& traction : tractions)
        if (!traction) traction = rest;
    const bool bonded =
        !tractions.empty() && std::all_of(tractions.begin(), tractions.end(), [](auto& t) { return !!t; });
    if (bonded && (has(s, "law") || has(s, "lawname") || has(s, "friction")))
      problems_.warn(s.origin,
                     "all parts of this crack have a traction law, so that its contact law has no effect: "
                     "closed faces press on each other with the stiffness <kClosed>, without friction");
    add_crack(spec, tractions);
  }
  must(model_.cracks.empty() || !model_.scheme.b_bar, model_.cracks.empty() ? Origin{} : model_.cracks.front().origin,
       "cracks with <BBar> are not implemented: its averages over cells would cross the crack");
  if (general) crack_settings(*general);
}

}  // namespace tribo
