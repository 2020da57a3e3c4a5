#include "solver/contact.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace tribo {
namespace {

// Gaps are measured from the particles at most this far sideways [cells].
constexpr double band = 0.75;

constexpr int most_sweeps = 200;

}  // namespace

template <int Dim>
Contact<Dim>::Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers)
    : model_(model),
      system_(system),
      transfers_(transfers),
      field_count_(system.fields.size()),
      cloud_(system.lattice) {
  const std::size_t n = field_count_;
  active_ = model.contact.active && n > 1;
  if (!active_) return;
  const Transfer transfer = model.scheme.transfer;
  keeps_start_ = transfer == Transfer::flip || transfer == Transfer::blend || transfer == Transfer::xpic;
  h_ = system.lattice.spacing.maxCoeff();
  const Kernel kernel = model.scheme.kernel;
  reach_ = h_ * (kernel == Kernel::cubic_spline ? 3.0 : kernel == Kernel::quadratic_spline ? 2.5 : 2.0);

  laws_.assign(n * n, nullptr);
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& a : *list) {
      if (a.field < n) bodies_.push_back(&a);
      for (auto* others : {&system.bodies, &system.rigids})
        for (const auto& b : *others) {
          if (a.field >= n || b.field >= n || a.field == b.field) continue;
          const ContactLaw* law = model.contact.law(a.material, b.material);
          laws_[a.field * n + b.field] = law;
          remembers_ = remembers_ || law->remembers();
          interfaces_ = interfaces_ || law->interface();
        }
    }
  scratch_.resize(256);
  near_.assign(static_cast<std::size_t>(system.lattice.block_count()), 0);
  shared_at_.assign(near_.size(), -1);
}

template <int Dim>
void Contact<Dim>::locate() {
  if (!active_) return;
  for (const auto& s : shared_) shared_at_[static_cast<std::size_t>(s.block)] = -1;
  shared_.clear();
  std::map<std::int64_t, std::vector<std::pair<std::size_t, int>>> users;
  for (std::size_t f = 0; f < field_count_; ++f) {
    const auto& map = system_.fields[f].map;
    for (std::size_t slot = 0; slot < map.active().size(); ++slot)
      users[map.active()[slot]].emplace_back(f, static_cast<int>(slot));
  }
  for (auto& [block, slots] : users) {
    if (slots.size() < 2) continue;
    shared_at_[static_cast<std::size_t>(block)] = static_cast<int>(shared_.size());
    shared_.push_back({block, std::move(slots)});
  }
  record_.assign(shared_.size() * block_nodes<Dim>, -1);
  nodes_.clear();
}

template <int Dim>
void Contact<Dim>::find(std::vector<Conditions<Dim>>& conditions) {
  if (!active_) return;
  list_nodes(conditions);
  cloud_.begin(reach_);
  for (const auto& node : nodes_) cloud_.want(node.index);
  cloud_.collect(bodies_);
  scatter_volumes(conditions);
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    Scratch& scratch = scratch_[static_cast<std::size_t>(thread_index()) % scratch_.size()];
    scratch.near.clear();
    cloud_.each_near(node.index, [&](const CloudPoint<Dim>& p) { scratch.near.push_back(p); });
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) face(node, pairs_[p], scratch);
  });
}

// Nodes that carry two or more fields, not all rigid.
template <int Dim>
void Contact<Dim>::list_nodes(std::vector<Conditions<Dim>>& conditions) {
  std::fill(record_.begin(), record_.end(), -1);
  nodes_.clear(), members_.clear(), pairs_.clear();
  for (std::size_t s = 0; s < shared_.size(); ++s) {
    const SharedBlock& shared = shared_[s];
    for (int local = 0; local < block_nodes<Dim>; ++local) {
      int count = 0;
      for (const auto& [f, slot] : shared.slots) {
        const auto at = static_cast<std::int64_t>(slot) * block_nodes<Dim> + local;
        const double m = system_.fields[f].nodes[static_cast<std::size_t>(at)].mass;
        if (m > 0) ++count;
      }
      if (count < 2) continue;
      MeetingNode node{};
      node.index = system_.fields[shared.slots[0].first].map.node_at(
          static_cast<std::int64_t>(shared.slots[0].second) * block_nodes<Dim> + local);
      node.first_member = members_.size(), node.first_pair = pairs_.size();
      bool deformable = false;
      for (const auto& [f, slot] : shared.slots) {
        const auto at = static_cast<std::int64_t>(slot) * block_nodes<Dim> + local;
        const double m = system_.fields[f].nodes[static_cast<std::size_t>(at)].mass;
        if (!(m > 0)) continue;
        const bool rigid = system_.fields[f].rigid_contact;
        deformable = deformable || !rigid;
        members_.push_back({f, at, m, rigid ? 0.0 : 1.0 / m, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
      }
      node.end_member = members_.size();
      if (node.end_member - node.first_member < 2 || !deformable) {
        members_.resize(node.first_member);
        continue;
      }
      const Member& first = members_[node.first_member];
      node.mirrored = conditions[first.field].mirrored(node.index);
      node.share = conditions[first.field].share(first.at);
      for (std::size_t a = node.first_member; a < node.end_member; ++a)
        for (std::size_t b = a + 1; b < node.end_member; ++b) {
          if (members_[a].inverse_mass + members_[b].inverse_mass == 0.0) continue;
          Pair pair{a,           b,    law_of(members_[a].field, members_[b].field), {}, Vec3::Zero(), {}, Vec3::Zero(),
                    Touch::open, false};
          pair.meeting.mass = 1.0 / (members_[a].inverse_mass + members_[b].inverse_mass);
          pairs_.push_back(pair);
        }
      node.end_pair = pairs_.size();
      record_[s * block_nodes<Dim> + static_cast<std::size_t>(local)] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
  }
}

// Volume, and its gradient in place of the force, of the bodies near meeting nodes: sum_p V_p grad w_Ip is the
// integral of the shape function over the surface times the outward normal.
template <int Dim>
void Contact<Dim>::scatter_volumes(std::vector<Conditions<Dim>>& conditions) {
  std::fill(near_.begin(), near_.end(), 0);
  const auto& lattice = system_.lattice;
  for (const auto& node : nodes_) {
    // A stencil that reaches the node begins at most three nodes below it; one more for drift.
    Index<Dim> low, high;
    for (std::size_t d = 0; d < Dim; ++d) {
      low[d] = std::max(0, (node.index[d] - 5) / block_edge<Dim>);
      high[d] = std::min(lattice.blocks[d] - 1, (node.index[d] + 1) / block_edge<Dim>);
    }
    Index<Dim> b = low;
    for (int z = Dim == 3 ? low[Dim - 1] : 0; z <= (Dim == 3 ? high[Dim - 1] : 0); ++z)
      for (b[1] = low[1]; b[1] <= high[1]; ++b[1])
        for (b[0] = low[0]; b[0] <= high[0]; ++b[0]) {
          if constexpr (Dim == 3) b[2] = z;
          near_[static_cast<std::size_t>(lattice.block_index(b))] = 1;
        }
  }
  for (std::size_t f = 0; f < field_count_; ++f) {
    auto& field = system_.fields[f];
    field.volumes.resize(field.nodes.size());
    std::fill(field.volumes.begin(), field.volumes.end(), Node{});
  }
  for (auto* body : bodies_) {
    auto& field = system_.fields[body->field];
    transfers_.scatter(*body, field.map, field.volumes, Scatter::volume, false,
                       system_.analysis == Analysis::axisymmetric, &near_);
  }
  for (std::size_t f = 0; f < field_count_; ++f) conditions[f].fold(system_.fields[f].volumes);
}

template <int Dim>
Vec<Dim> Contact<Dim>::gradient_normal(const Member& a, const Member& b) const {
  const auto outward = [&](const Member& m) {
    const Node& node = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return Vec<Dim>(Eigen::Map<const Vec<Dim>>(node.acceleration));
  };
  const auto volume = [&](const Member& m) {
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
std::optional<Vec<Dim>> Contact<Dim>::chosen_normal(Scratch& s, const Member& a, const Member& b) const {
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
      if (s.a.count == 0 || s.b.count == 0) return std::nullopt;
      if (auto n = margin_normal<Dim>(s.a, s.b, unit(gradient).value_or(Vec<Dim>::Unit(0)), h_)) return n;
      if (auto n = regression_normal<Dim>(s.a, s.b, false, h_)) return n;
      return unit(gradient);
  }
  return std::nullopt;
}

template <int Dim>
void Contact<Dim>::face(const MeetingNode& node, Pair& pair, Scratch& s) {
  if (!pair.law->looks_at_faces()) return;
  const Member &a = members_[pair.a], &b = members_[pair.b];
  const Vec<Dim> centre = system_.lattice.position(node.index);
  s.a.clear(), s.b.clear();
  for (const auto& p : s.near) {
    if (p.field == a.field) s.a.add(p.x - centre, p.axes);
    if (p.field == b.field) s.b.add(p.x - centre, p.axes);
  }
  auto n = chosen_normal(s, a, b);
  pair.apart = !n;
  if (pair.apart) return;
  for (int d = 0; d < Dim; ++d)
    if (node.mirrored >> d & 1) (*n)[d] = 0.0;
  const double norm = n->norm();
  pair.apart = !(norm > 1e-6);
  if (pair.apart) return;
  *n /= norm;
  pair.meeting.normal.setZero();
  pair.meeting.normal.template head<Dim>() = *n;
  pair.meeting.gap = separation(node, pair, s, *n);

  const auto slope = [&](const Member& m) {
    const Node& v = system_.fields[m.field].volumes[static_cast<std::size_t>(m.at)];
    return std::abs(Eigen::Map<const Vec<Dim>>(v.acceleration).dot(*n));
  };
  // Faces that end elsewhere than their partners meet on the smaller; open interfaces belong to both.
  const double sa = slope(a), sb = slope(b);
  pair.meeting.area = pair.law->interface() ? 0.5 * (sa + sb) : std::min(sa, sb);
  if (pair.law->interface()) pair.meeting.opening = opening(node, pair, s, *n);
  if (pair.law->remembers()) recall(node, pair, s);
}

template <int Dim>
double Contact<Dim>::separation(const MeetingNode& node, const Pair& pair, Scratch& s, const Vec<Dim>& n) const {
  const ContactSpec& c = model_.contact;
  if (c.separation == Separation::edges) {
    if (s.a.count == 0 || s.b.count == 0) return std::numeric_limits<double>::infinity();
    return -face_position<Dim>(s.b, -n, band * h_) - face_position<Dim>(s.a, n, band * h_);
  }
  // Mean position (or displacement) of the particles at the node, along the normal
  const auto mean = [&](const Member& m) {
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
Vec3 Contact<Dim>::opening(const MeetingNode& node, const Pair& pair, const Scratch& s, const Vec<Dim>& n) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  Scratch copy = s;
  const double middle = 0.5 * (face_position<Dim>(copy.a, n, band * h_) - face_position<Dim>(copy.b, -n, band * h_));
  const Vec<Dim> at = centre + middle * n;
  const auto displacement = [&](std::size_t field) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    double total = 0.0;
    for (const auto& p : s.near) {
      if (p.field != field) continue;
      auto& body = *bodies_[p.body];
      const double w = weight(p.x - centre);
      if (!(w > 0)) continue;
      const auto origin = body.particles.vector(*body.origin);
      Vec<Dim> u = p.x;
      for (std::size_t d = 0; d < Dim; ++d) u[static_cast<Eigen::Index>(d)] -= origin[d][p.particle];
      if (body.particles.has_deformation()) {
        const Mat3 F = load_full<Dim>(body.particles.F(), static_cast<int>(p.particle));
        const Mat<Dim> inverse = F.template topLeftCorner<Dim, Dim>().inverse();
        u += (Mat<Dim>::Identity() - inverse) * (at - p.x);
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
void Contact<Dim>::recall(const MeetingNode& node, Pair& pair, const Scratch& s) const {
  const Vec<Dim> centre = system_.lattice.position(node.index);
  double total = 0.0, slip = 0.0, whole = 0.0, broken = 0.0;
  for (const auto& p : s.near) {
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

template <int Dim>
template <class F>
void Contact<Dim>::each_pair_near(const CloudPoint<Dim>& p, F&& f) const {
  Index<Dim> low, n;
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    low[d] =
        static_cast<int>(std::floor((p.x[axis] - system_.lattice.origin[axis]) / system_.lattice.spacing[axis])) - 1;
  }
  for (int k = 0; k < (Dim == 2 ? 16 : 64); ++k) {
    n[0] = low[0] + k % 4, n[1] = low[1] + k / 4 % 4;
    if constexpr (Dim == 3) n[2] = low[2] + k / 16;
    Index<Dim> block;
    std::size_t local = 0;
    bool inside = true;
    for (std::size_t d = Dim; d-- > 0;) {
      inside = inside && n[d] >= 0 && n[d] < system_.lattice.blocks[d] * block_edge<Dim>;
      block[d] = n[d] / block_edge<Dim>;
      local = local * block_edge<Dim> + static_cast<std::size_t>(n[d] % block_edge<Dim>);
    }
    if (!inside) continue;
    const int s = shared_at_[static_cast<std::size_t>(system_.lattice.block_index(block))];
    if (s < 0) continue;
    const int r = record_[static_cast<std::size_t>(s) * block_nodes<Dim> + local];
    if (r < 0) continue;
    const double w = weight(p.x - system_.lattice.position(n));
    if (!(w > 0)) continue;
    const MeetingNode& node = nodes_[static_cast<std::size_t>(r)];
    for (std::size_t q = node.first_pair; q < node.end_pair; ++q) {
      const Pair& pair = pairs_[q];
      if (pair.apart) continue;
      if (members_[pair.a].field == p.field) f(pair, w, 1.0);
      if (members_[pair.b].field == p.field) f(pair, w, -1.0);
    }
  }
}

template <int Dim>
void Contact<Dim>::remember() {
  const auto& points = cloud_.points();
  parallel_for(static_cast<std::ptrdiff_t>(points.size()), [&](std::ptrdiff_t k) {
    const CloudPoint<Dim>& p = points[static_cast<std::size_t>(k)];
    auto& body = *bodies_[p.body];
    if (!body.contact_memory) return;
    double touching = 0.0, sliding = 0.0, way = 0.0, whole = 0.0, broken = 0.0;
    each_pair_near(p, [&](const Pair& pair, double w, double) {
      if (!pair.law->remembers()) return;
      if (pair.answer.touch != Touch::open) touching += w;
      if (pair.answer.touch == Touch::slip) {
        const Vec3 v = pair.meeting.velocity - pair.impulse / pair.meeting.mass;
        sliding += w, way += w * pair.meeting.dt * (v - v.dot(pair.meeting.normal) * pair.meeting.normal).norm();
      }
      if (pair.answer.bond == Bond::whole) whole += w;
      if (pair.answer.bond == Bond::broken) broken += w;
    });
    double& slip = body.particles.column(*body.contact_memory)[p.particle];
    slip = sliding > 0.5 * touching ? slip + way / sliding : 0.0;
    if (whole + broken > 0) body.particles.column(*body.contact_memory + 1)[p.particle] = broken > whole ? -1.0 : 1.0;
  });
}

template <int Dim>
void Contact<Dim>::show() {
  for (auto* body : bodies_)
    if (body->contact_view)
      for (std::size_t k = 0; k < 1 + 2 * Dim; ++k)
        std::fill_n(body->particles.column(*body->contact_view + k), body->particles.size(), 0.0);
  for (const auto& p : cloud_.points()) {
    auto& body = *bodies_[p.body];
    if (!body.contact_view) continue;
    double slip = 0.0, stick = 0.0, total = 0.0;
    Vec<Dim> traction = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero();
    each_pair_near(p, [&](const Pair& pair, double w, double side) {
      if (pair.shown == Touch::open || pair.meeting.gap > 0.1 * h_) return;
      (pair.shown == Touch::slip ? slip : stick) += w;
      normal += side * w * pair.meeting.normal.template head<Dim>();
      if (!(pair.meeting.area > 0)) return;
      total += w * pair.meeting.area;
      traction += side * w / pair.meeting.dt * pair.booked.template head<Dim>();
    });
    if (slip + stick == 0.0) continue;
    body.particles.column(*body.contact_view)[p.particle] = slip > stick ? 2.0 : 1.0;
    if (total > 0) traction /= total;
    if (normal.norm() > 0) normal.normalize();
    for (std::size_t d = 0; d < Dim; ++d) {
      body.particles.column(*body.contact_view + 1 + d)[p.particle] = traction[static_cast<Eigen::Index>(d)];
      body.particles.column(*body.contact_view + 1 + Dim + d)[p.particle] = normal[static_cast<Eigen::Index>(d)];
    }
  }
}

// All pairs of a node together: projected Gauss-Seidel on their impulses, in a symmetric order. Two fields need one
// sweep. With frictionless laws it finds the impulses of least kinetic energy; equal and opposite by construction.
template <int Dim>
void Contact<Dim>::solve(MeetingNode& node, bool interfaces, bool warm) {
  const auto velocity = [&](const Member& m, std::size_t self) {
    Vec3 v = m.trial;
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      if (pairs_[p].a == self) v += m.inverse_mass * pairs_[p].impulse;
      if (pairs_[p].b == self) v -= m.inverse_mass * pairs_[p].impulse;
    }
    return v;
  };
  if (!warm)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) pairs_[p].impulse.setZero(), pairs_[p].answer = {};
  const std::size_t count = node.end_pair - node.first_pair;
  for (int sweep = 0; sweep < (count == 1 ? 1 : most_sweeps); ++sweep) {
    double change = 0.0, size = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      Pair& pair = pairs_[sweep % 2 == 0 ? node.first_pair + k : node.end_pair - 1 - k];
      if (pair.apart || (!interfaces && pair.law->interface())) continue;
      const Member &a = members_[pair.a], &b = members_[pair.b];
      Meeting& m = pair.meeting;
      m.velocity = velocity(b, pair.b) - velocity(a, pair.a) + pair.impulse / m.mass;
      m.start = b.start - a.start;
      pair.answer = pair.law->answer(m);
      change += (pair.answer.impulse - pair.impulse).squaredNorm();
      size +=
          pair.answer.impulse.squaredNorm() + pair.impulse.squaredNorm() + m.mass * m.mass * m.velocity.squaredNorm();
      pair.impulse = pair.answer.impulse;
    }
    if (change <= 1e-28 * size) break;
  }
}

template <int Dim>
void Contact<Dim>::meet(double dt, Pass pass) {
  if (!active_) return;
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      Member& m = members_[i];
      const Node& at = system_.fields[m.field].nodes[static_cast<std::size_t>(m.at)];
      m.trial = Eigen::Map<const Vec3>(at.velocity);
      m.start = m.trial;
      if (pass == Pass::update) m.start -= dt * Eigen::Map<const Vec3>(at.acceleration);
    }
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) pairs_[p].meeting.dt = dt;
    solve(node, pass == Pass::update, false);
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      for (const auto& [i, sign] : {std::pair{pairs_[p].a, 1.0}, std::pair{pairs_[p].b, -1.0}}) {
        Node& at = system_.fields[members_[i].field].nodes[static_cast<std::size_t>(members_[i].at)];
        const Vec3 change = sign * members_[i].inverse_mass * pairs_[p].impulse;
        Eigen::Map<Vec3>(at.velocity) += change;
        if (pass == Pass::update) Eigen::Map<Vec3>(at.acceleration) += change / dt;
      }
  });
}

template <int Dim>
void Contact<Dim>::part() {
  if (!active_) return;
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    const MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p)
      for (const auto& [i, sign] : {std::pair{pairs_[p].a, 1.0}, std::pair{pairs_[p].b, -1.0}}) {
        Node& at = system_.fields[members_[i].field].nodes[static_cast<std::size_t>(members_[i].at)];
        Eigen::Map<Vec3>(at.velocity) -= sign * members_[i].inverse_mass * pairs_[p].impulse;
      }
  });
}

template <int Dim>
void Contact<Dim>::refine(bool update) {
  if (!active_) return;
  parallel_for(static_cast<std::ptrdiff_t>(nodes_.size()), [&](std::ptrdiff_t k) {
    MeetingNode& node = nodes_[static_cast<std::size_t>(k)];
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      Member& m = members_[i];
      if (m.inverse_mass == 0.0) continue;
      m.trial += Eigen::Map<const Vec3>(system_.fields[m.field].filter[static_cast<std::size_t>(m.at)].velocity);
    }
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      Member& m = members_[i];
      for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
        if (pairs_[p].a == i) m.before -= m.inverse_mass * pairs_[p].impulse;
        if (pairs_[p].b == i) m.before += m.inverse_mass * pairs_[p].impulse;
      }
    }
    solve(node, update, true);
    for (std::size_t i = node.first_member; i < node.end_member; ++i) {
      Member& m = members_[i];
      for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
        if (pairs_[p].a == i) m.before += m.inverse_mass * pairs_[p].impulse;
        if (pairs_[p].b == i) m.before -= m.inverse_mass * pairs_[p].impulse;
      }
      if (m.inverse_mass > 0)
        Eigen::Map<Vec3>(system_.fields[m.field].filter[static_cast<std::size_t>(m.at)].velocity) += m.before;
      m.before.setZero();
    }
  });
}

template <int Dim>
void Contact<Dim>::book(double dt) {
  if (!active_) return;
  for (auto& [fields, entry] : ledger_) entry.force.setZero(), entry.stored = entry.area = 0.0;
  for (const auto& node : nodes_)
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      Pair& pair = pairs_[p];
      pair.booked = pair.impulse, pair.shown = pair.answer.touch;
      if (pair.answer.touch == Touch::open) continue;
      const Member &a = members_[pair.a], &b = members_[pair.b];
      auto& entry = ledger_[{a.field, b.field}];
      entry.force += node.share / dt * pair.impulse;
      entry.stored += node.share * pair.answer.stored;
      entry.area += node.share * pair.meeting.area;
      const auto end = [&](const Member& m, std::size_t self) {
        Vec3 v = m.trial;
        for (std::size_t q = node.first_pair; q < node.end_pair; ++q) {
          if (pairs_[q].a == self) v += m.inverse_mass * pairs_[q].impulse;
          if (pairs_[q].b == self) v -= m.inverse_mass * pairs_[q].impulse;
        }
        return v;
      };
      // Work of the pair on the grid, at the mean of the velocities of the step's ends
      const Vec3 mean = 0.5 * node.share * (b.start - a.start + end(b, pair.b) - end(a, pair.a));
      const double all = pair.impulse.dot(mean);
      const double normal = pair.impulse.dot(pair.meeting.normal) * mean.dot(pair.meeting.normal);
      if (pair.law->interface())
        entry.interface += all;
      else
        entry.impact += normal, entry.friction += all - normal;
      if (a.inverse_mass == 0.0) rigid_work -= node.share * pair.impulse.dot(a.trial);
      if (b.inverse_mass == 0.0) rigid_work += node.share * pair.impulse.dot(b.trial);
    }
  if (remembers_) remember();
}

template <int Dim>
PairLedger Contact<Dim>::total() const {
  PairLedger sum;
  for (const auto& [fields, entry] : ledger_) {
    sum.friction += entry.friction, sum.impact += entry.impact, sum.interface += entry.interface;
    sum.stored += entry.stored, sum.area += entry.area;
  }
  return sum;
}

template class Contact<2>;
template class Contact<3>;

}  // namespace tribo
