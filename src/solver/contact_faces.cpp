/// How two fields face each other at a node: normal, gap, area, opening, and what their particles remember.

#include "solver/contact.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Gaps are measured from the particles at most this far sideways [cells].
constexpr double band = 0.75;
// Particles this far behind the foremost may become it before the faces are found again [cells].
constexpr double kept_depth = 0.05;
// Particles this far behind the foremost are tried first; in most places the others lie behind them [cells].
constexpr double front_depth = 0.4;

}  // namespace

template <int Dim>
Vec<Dim> Contact<Dim>::gradient_normal(const ContactMember& a, const ContactMember& b) const {
  const auto outward = [&](const ContactMember& m) {
    const Node& node = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(node.acceleration));
  };
  const auto volume = [&](const ContactMember& m) {
    return system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)].mass;
  };
  const Vec<Dim> ga = outward(a), gb = outward(b);
  const double bias = model_.contact.rigid_bias;
  const double wa = a.inverse_mass == 0.0 ? bias : 1.0, wb = b.inverse_mass == 0.0 ? bias : 1.0;
  switch (model_.contact.normals) {
    case NormalMethod::steepest:
      return wa * ga.norm() >= wb * gb.norm() ? ga : Vec<Dim>(-gb);
    case NormalMethod::largest:
      return wa * volume(a) >= wb * volume(b) ? ga : Vec<Dim>(-gb);
    case NormalMethod::own:
      return a.inverse_mass > 0 ? ga : Vec<Dim>(-gb);
    default:
      return wa * ga - wb * gb;
  }
}

template <int Dim>
void Contact<Dim>::fill_sides(const MeetingNode& node, Scratch& s, const ContactMember& a,
                              const ContactMember& b) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  s.a.clear(), s.b.clear();
  for (std::size_t k = 0; k < s.near.size(); ++k) {
    const CloudPoint<Dim>& p = *s.near[k];
    if (p.field == a.field) s.a.add(p.x - centre, p.axes, k);
    if (p.field == b.field) s.b.add(p.x - centre, p.axes, k);
  }
}

// From the centre of a's particles near the node to that of b's: close to the normal of flat faces.
template <int Dim>
Vec<Dim> Contact<Dim>::between_centres(const Scratch& s, const ContactMember& a, const ContactMember& b) const {
  Vec<Dim> sum_a = Vec<Dim>::Zero(), sum_b = Vec<Dim>::Zero();
  double count_a = 0.0, count_b = 0.0;
  for (const auto* p : s.near) {
    if (p->field == a.field) sum_a += p->x, count_a += 1.0;
    if (p->field == b.field) sum_b += p->x, count_b += 1.0;
  }
  return count_a > 0 && count_b > 0 ? Vec<Dim>(sum_b / count_b - sum_a / count_a) : Vec<Dim>(Vec<Dim>::Zero());
}

// The normal of largest margin found from the foremost particles alone, which leaves the sides with them; nothing
// unless it is sure that all particles would give the same, and the same gap.
template <int Dim>
std::optional<Vec<Dim>> Contact<Dim>::margin_of_front(const MeetingNode& node, Scratch& s, const ContactMember& a,
                                                      const ContactMember& b, const Vec<Dim>& guess) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const auto reach_of = [&](const CloudPoint<Dim>& p, const Vec<Dim>& n) {
    double reach = (p.x - centre).dot(n);
    for (int k = 0; k < Dim; ++k) reach += std::abs(p.axes.col(k).dot(n));
    return reach;
  };
  s.reach.resize(s.near.size());
  double most_a = -std::numeric_limits<double>::infinity(), most_b = most_a;
  for (std::size_t k = 0; k < s.near.size(); ++k) {
    const CloudPoint<Dim>& p = *s.near[k];
    if (p.field == a.field) most_a = std::max(most_a, s.reach[k] = reach_of(p, guess));
    if (p.field == b.field) most_b = std::max(most_b, s.reach[k] = reach_of(p, -guess));
  }
  s.a.clear(), s.b.clear();
  for (std::size_t k = 0; k < s.near.size(); ++k) {
    const CloudPoint<Dim>& p = *s.near[k];
    if (p.field == a.field && s.reach[k] >= most_a - front_depth * h_) s.a.add(p.x - centre, p.axes, k);
    if (p.field == b.field && s.reach[k] >= most_b - front_depth * h_) s.b.add(p.x - centre, p.axes, k);
  }
  if (s.a.count == 0 || s.b.count == 0) return std::nullopt;
  const auto n = margin_normal<Dim>(s.a, s.b, guess, h_);
  if (!n) return std::nullopt;
  // Whoever was left out must lie behind all that counts: the support of the margin, and the faces of gaps.
  const auto behind = [&](Side<Dim>& side, const Vec<Dim>& out) {
    if (side.band_limit(out, band * h_) > band * band * h_ * h_) return -std::numeric_limits<double>::infinity();
    side.measure(out, 0.0);
    const double support = *std::max_element(side.reach.begin(), side.reach.end());
    return std::min(support, face_position<Dim>(side, out, band * h_) - kept_depth * h_);
  };
  const double limit_a = behind(s.a, *n), limit_b = behind(s.b, -*n);
  for (std::size_t k = 0; k < s.near.size(); ++k) {
    const CloudPoint<Dim>& p = *s.near[k];
    if (p.field == a.field && s.reach[k] < most_a - front_depth * h_ && reach_of(p, *n) > limit_a) return std::nullopt;
    if (p.field == b.field && s.reach[k] < most_b - front_depth * h_ && reach_of(p, -*n) > limit_b) return std::nullopt;
  }
  if (!wide_faces<Dim>(s.a, s.b, *n, h_)) return std::nullopt;
  return n;
}

template <int Dim>
std::optional<Vec<Dim>> Contact<Dim>::chosen_normal(const MeetingNode& node, Scratch& s, const ContactMember& a,
                                                    const ContactMember& b) const {
  const auto unit = [](const Vec<Dim>& v) -> std::optional<Vec<Dim>> {
    const double norm = v.norm();
    if (!(norm > 0)) return std::nullopt;
    return Vec<Dim>(v / norm);
  };
  const Vec<Dim> gradient = gradient_normal(a, b);
  // The faces of a rigid body are known: its geometry replaces the gradients.
  NormalMethod method = model_.contact.normals;
  const bool by_gradient = method == NormalMethod::steepest || method == NormalMethod::largest ||
                           method == NormalMethod::average || method == NormalMethod::own;
  if (by_gradient && (a.inverse_mass == 0.0 || b.inverse_mass == 0.0)) method = NormalMethod::margin;
  if (method == NormalMethod::margin) {
    const Vec<Dim> guess = unit(between_centres(s, a, b)).value_or(Vec<Dim>::Unit(0));
    if (auto n = margin_of_front(node, s, a, b, guess)) return n;
    fill_sides(node, s, a, b);
    if (s.a.count == 0 || s.b.count == 0) return std::nullopt;
    if (auto n = margin_normal<Dim>(s.a, s.b, guess, h_)) return facing_normal<Dim>(s.a, s.b, *n, h_);
    if (auto n = regression_normal<Dim>(s.a, s.b, false, h_)) return n;
    return unit(gradient);
  }
  fill_sides(node, s, a, b);
  switch (method) {
    case NormalMethod::specified: {
      // from the deformable into the rigid, else from the lower to the higher field
      const double sign = a.inverse_mass == 0.0 ? -1.0 : 1.0;
      return unit(sign * model_.contact.direction.template head<Dim>());
    }
    case NormalMethod::steepest:
    case NormalMethod::largest:
    case NormalMethod::average:
    case NormalMethod::own:
      return unit(gradient);
    case NormalMethod::linear:
    case NormalMethod::logistic:
      if (s.a.count == 0 || s.b.count == 0) return unit(gradient);
      if (auto n = regression_normal<Dim>(s.a, s.b, method == NormalMethod::logistic, h_)) return n;
      return unit(gradient);
    case NormalMethod::margin:
      break;
  }
  return std::nullopt;
}

template <int Dim>
void Contact<Dim>::face(const MeetingNode& node, ContactPair& pair, Faces& kept, Scratch& s) {
  kept.node = node.number, kept.a = members_[pair.a].field, kept.b = members_[pair.b].field;
  kept.count = {};
  kept.apart = false;
  if (!pair.law->looks_at_faces()) return;
  const ContactMember &a = members_[pair.a], &b = members_[pair.b];
  auto n = chosen_normal(node, s, a, b);
  pair.apart = kept.apart = !n;
  if (pair.apart) return;
  for (int d = 0; d < Dim; ++d)
    if (node.mirrored >> d & 1) (*n)[d] = 0.0;
  const double norm = n->norm();
  pair.apart = kept.apart = !(norm > 1e-6);
  if (pair.apart) return;
  *n /= norm;
  pair.meeting.normal.setZero();
  pair.meeting.normal.template head<Dim>() = *n;
  pair.meeting.gap = separation(node, pair, s, *n);

  const auto slope = [&](const ContactMember& m) {
    const Node& v = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return std::abs(Eigen::Map<const Vec<Dim>>(v.acceleration).dot(*n));
  };
  // Faces that end elsewhere than their partners meet on the smaller; open interfaces belong to both.
  const double sa = slope(a), sb = slope(b);
  pair.meeting.area = pair.law->interface() ? 0.5 * (sa + sb) : std::min(sa, sb);
  if (model_.contact.at_faces || model_.heat.contact_heating) {
    const double of_a = face_position<Dim>(s.a, *n, band * h_), of_b = -face_position<Dim>(s.b, -*n, band * h_);
    pair.face = a.inverse_mass == 0.0 ? of_a : b.inverse_mass == 0.0 ? of_b : 0.5 * (of_a + of_b);
  }
  kept.normal = pair.meeting.normal, kept.area = pair.meeting.area, kept.face = pair.face;
  if (keeps_faces_) {
    // Whatever may become the outermost particle before the faces are found again
    for (std::size_t side = 0; side < 2; ++side) {
      Side<Dim>& of = side == 0 ? s.a : s.b;
      each_at_face(of, side == 0 ? *n : Vec<Dim>(-*n), band * h_, kept_depth * h_, [&](std::size_t i) {
        const std::size_t k = kept.count[side]++;
        if (k >= Faces::most) return;
        const CloudPoint<Dim>& p = *s.near[of.which[i]];
        kept.corners[side][k] = {p.body, p.particle};
      });
    }
  }
  if (pair.law->interface()) pair.meeting.opening = opening(node, pair, s, *n);
  if (pair.law->remembers()) recall(node, pair, s);
}

template <int Dim>
double Contact<Dim>::separation(const MeetingNode& node, const ContactPair& pair, Scratch& s, const Vec<Dim>& n) const {
  const ContactSpec& c = model_.contact;
  if (c.separation == Separation::edges) {
    if (s.a.count == 0 || s.b.count == 0) return std::numeric_limits<double>::infinity();
    return -face_position<Dim>(s.b, -n, band * h_) - face_position<Dim>(s.a, n, band * h_);
  }
  // Mean position (or displacement) of the particles at the node, along the normal
  const auto mean = [&](const ContactMember& m) {
    const Node& v = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(v.velocity) / v.mass);
  };
  const Vec<Dim> xa = mean(members_[pair.a]), xb = mean(members_[pair.b]);
  if (c.separation == Separation::displacements) return (xb - xa).dot(n);
  const double across = n.cwiseProduct(system_.lattice.spacing).norm();
  if (c.position > 0) return (xb - xa).dot(n) - c.position * across;
  const Vec<Dim> centre = system_.lattice.position(node.index);
  const auto distance = [&](const Vec<Dim>& x) {
    const double e = (x - centre).dot(n) / (1.25 * across), q = -c.position;
    return e > 0 ? 2 * std::pow(e, q) - 1 : 1 - 2 * std::pow(-e, q);
  };
  return across * (distance(xb) - distance(xa));
}

template <int Dim>
double Contact<Dim>::weight(const Vec<Dim>& distance) const {
  double w = 1.0;
  for (int d = 0; d < Dim; ++d) w *= std::max(0.0, 1.0 - std::abs(distance[d]) / (1.5 * system_.lattice.spacing[d]));
  return w;
}

// Jump of the displacement at the interface: each side's mean, carried to the interface by its own deformation, so
// that strain between the particles and the interface does not count.
template <int Dim>
Vec3 Contact<Dim>::opening(const MeetingNode& node, const ContactPair& pair, const Scratch& s,
                           const Vec<Dim>& n) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  Scratch copy = s;
  const double middle = 0.5 * (face_position<Dim>(copy.a, n, band * h_) - face_position<Dim>(copy.b, -n, band * h_));
  const Vec<Dim> at = centre + middle * n;
  const auto displacement = [&](std::size_t field) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    double total = 0.0;
    for (const auto* near : s.near) {
      const auto& p = *near;
      if (p.field != field) continue;
      auto& body = *bodies_[p.body];
      const double w = weight(p.x - centre);
      if (!(w > 0)) continue;
      const auto origin = body.particles.vector(*body.origin);
      Vec<Dim> u = p.x;
      for (std::size_t d = 0; d < Dim; ++d) u[static_cast<Eigen::Index>(d)] -= origin[d][p.particle];
      if (body.particles.has_deformation()) {
        const Mat3 F = load_full<Dim>(body.particles.F(), static_cast<int>(p.particle));
        Mat<Dim> since_start = F.template topLeftCorner<Dim, Dim>();
        if (body.first_inverse) {
          Mat<Dim> first;
          for (std::size_t k = 0; k < Dim * Dim; ++k)
            first(static_cast<int>(k) / Dim, static_cast<int>(k) % Dim) =
                body.particles.column(*body.first_inverse + k)[p.particle];
          since_start *= first;
        }
        u += (Mat<Dim>::Identity() - since_start.inverse()) * (at - p.x);
      }
      sum += w * u, total += w;
    }
    return Vec<Dim>(total > 0 ? Vec<Dim>(sum / total) : sum);
  };
  Vec3 jump = Vec3::Zero();
  jump.template head<Dim>() = displacement(members_[pair.b].field) - displacement(members_[pair.a].field);
  return jump;
}

// What the particles near the node remember.
template <int Dim>
void Contact<Dim>::recall(const MeetingNode& node, ContactPair& pair, const Scratch& s) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  double total = 0.0, slip = 0.0, whole = 0.0, broken = 0.0;
  for (const auto* near : s.near) {
    const auto& p = *near;
    if (p.field != members_[pair.a].field && p.field != members_[pair.b].field) continue;
    auto& body = *bodies_[p.body];
    if (!body.contact_memory) continue;
    const double w = weight(p.x - centre);
    const double bond = body.particles.column(*body.contact_memory + 1)[p.particle];
    total += w, slip += w * body.particles.column(*body.contact_memory)[p.particle];
    whole += bond > 0 ? w : 0.0, broken += bond < 0 ? w : 0.0;
  }
  pair.meeting.slip = total > 0 ? slip / total : 0.0;
  pair.meeting.cell = h_;
  pair.meeting.bond = whole == 0 && broken == 0 ? Bond::none : broken > whole ? Bond::broken : Bond::whole;
  // Faces that touch at the very start are joined.
  if (system_.step == 0 && std::abs(pair.meeting.gap) < 1e-6 * h_ && pair.meeting.bond == Bond::none)
    pair.meeting.bond = Bond::whole;
}

template void Contact<2>::face(const MeetingNode&, ContactPair&, Faces&, Scratch&);
template void Contact<3>::face(const MeetingNode&, ContactPair&, Faces&, Scratch&);
template double Contact<2>::weight(const Vec<2>&) const;
template double Contact<3>::weight(const Vec<3>&) const;

}  // namespace tribo
