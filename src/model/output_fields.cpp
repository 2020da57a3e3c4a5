// SPDX-License-Identifier: MIT
#include "model/output_fields.hpp"

#include "base/strain.hpp"
#include "model/find_name.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace tribo {
namespace {

// A particle of a body.
class P {
 public:
  P(const ParticleStates& of, std::size_t particle) : of_(of), i_(particle) {}
  std::int64_t id() const { return of_.id[i_]; }
  std::int64_t material_number() const { return of_.material_number; }
  Vec3 velocity() const { return vector(of_.velocity); }
  Vec3 displacement() const { return vector(of_.position) - vector(of_.origin); }
  double mass() const { return of_.mass[i_]; }
  double volume() const { return of_.volume[i_]; }
  double density() const { return of_.density; }
  Mat3 stress() const {
    const auto& s = of_.stress;
    Mat3 m;
    m << s[0][i_], s[3][i_], s[5][i_], s[3][i_], s[1][i_], s[4][i_], s[5][i_], s[4][i_], s[2][i_];
    return m;
  }
  Mat3 deformation_gradient() const {
    Mat3 F = Mat3::Identity();
    for (int k = 0; k < 9 && of_.has_deformation; ++k)
      F(k / 3, k % 3) = of_.deformation[static_cast<std::size_t>(k)][i_];
    return F;
  }
  double stored_energy() const { return of_.stored_energy(i_); }
  double dissipated_energy() const { return of_.dissipated_energy(i_); }
  double cell_crossings() const { return of_.cell_crossings[i_]; }
  double temperature() const { return of_.temperature[i_]; }
  double heat_capacity() const { return of_.heat_capacity; }
  double contact_state() const { return of_.contact_state(i_); }
  Vec3 contact_traction() const { return of_.contact_traction(i_); }
  Vec3 contact_normal() const { return of_.contact_normal(i_); }

 private:
  Vec3 vector(const std::array<ParticleColumn, 3>& c) const { return {c[0][i_], c[1][i_], c[2][i_]}; }

  const ParticleStates& of_;
  std::size_t i_;
};

double von_mises(const Mat3& s) {
  const Mat3 deviator = s - s.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5 * deviator.squaredNorm());
}

// In descending order: with tension positive, the most tensile one is the first.
Vec3 principal_values(const Mat3& s) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(s, Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

// The kinds of fields. `F` is a function of a particle without captures. A loop over the particles is part of each, so
// that the function is compiled into it.
template <class F>
ParticleFieldValue integer(F) {
  const auto integers = [](const ParticleStates& of, const ParticleOrder& order, std::int64_t* to) {
    for (std::size_t i = order.begin; i < order.end; ++i) *to++ = F{}(P(of, order.particle(i)));
  };
  return {0, nullptr, integers, false};
}

template <std::size_t Components, class F>
ParticleFieldValue numbers(F) {
  const auto values = [](const ParticleStates& of, const ParticleOrder& order, double* to) {
    for (std::size_t i = order.begin; i < order.end; ++i, to += Components) F{}(P(of, order.particle(i)), to);
  };
  return {Components, values, nullptr, false};
}

template <class F>
ParticleFieldValue scalar(F) {
  return numbers<1>([](const P& p, double* to) { to[0] = F{}(p); });
}

template <class F>
ParticleFieldValue vector(F) {
  return numbers<3>([](const P& p, double* to) {
    const Vec3 v = F{}(p);
    std::copy_n(v.data(), 3, to);
  });
}

// xx yy zz xy yz xz, the order of VTK
template <class F>
ParticleFieldValue symmetric(F) {
  return numbers<6>([](const P& p, double* to) {
    const Mat3 s = F{}(p);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [r, c] = Layout<3>::symmetric_at[k];
      to[k] = s(r, c);
    }
  });
}

// Row by row
template <class F>
ParticleFieldValue tensor(F) {
  return numbers<9>([](const P& p, double* to) {
    const Mat3 m = F{}(p);
    for (int k = 0; k < 9; ++k) to[k] = m(k / 3, k % 3);
  });
}

ParticleFieldValue history_variables() { return {0, nullptr, nullptr, true}; }

}  // namespace

const std::vector<ParticleField>& particle_fields() {
  using Standard = ParticleField::Standard;
  using Needs = ParticleField::Needs;
  static const std::vector<ParticleField> list{
      {"id", "-", "number assigned at the start, never changed", Standard::yes, Needs::nothing,
       integer([](const P& p) { return p.id(); })},
      {"material", "-", "number of the material in the command file", Standard::yes, Needs::nothing,
       integer([](const P& p) { return p.material_number(); })},
      {"velocity", "velocity", "", Standard::yes, Needs::nothing, vector([](const P& p) { return p.velocity(); })},
      {"displacement", "length", "displacement since the start", Standard::yes, Needs::nothing,
       vector([](const P& p) { return p.displacement(); })},
      {"mass", "mass", "", Standard::no, Needs::nothing, scalar([](const P& p) { return p.mass(); })},
      {"volume", "length^3", "current volume", Standard::no, Needs::nothing,
       scalar([](const P& p) { return p.volume(); })},
      {"stress", "stress", "Cauchy stress, tension positive", Standard::yes, Needs::nothing,
       symmetric([](const P& p) { return p.stress(); })},
      {"pressure", "stress", "minus a third of the trace of the stress", Standard::yes, Needs::nothing,
       scalar([](const P& p) { return -p.stress().trace() / 3.0; })},
      {"von_mises", "stress", "sqrt(3 J2)", Standard::yes, Needs::nothing,
       scalar([](const P& p) { return von_mises(p.stress()); })},
      {"principal_stress", "stress", "principal values of the Cauchy stress, the most tensile first", Standard::no,
       Needs::nothing, vector([](const P& p) { return principal_values(p.stress()); })},
      {"strain", "-", "Biot strain V - 1 with F = V R, in the current configuration", Standard::no, Needs::deformation,
       symmetric([](const P& p) { return biot_strain(p.deformation_gradient()); })},
      {"rotation", "rad", "rotation vector of R: axis times angle", Standard::no, Needs::deformation,
       vector([](const P& p) { return rotation_of(p.deformation_gradient()); })},
      {"deformation_gradient", "-", "F", Standard::no, Needs::deformation,
       tensor([](const P& p) { return p.deformation_gradient(); })},
      {"strain_energy", "energy", "elastically stored energy", Standard::no, Needs::nothing,
       scalar([](const P& p) { return p.stored_energy(); })},
      {"plastic_energy", "energy", "energy dissipated by the material law", Standard::no, Needs::nothing,
       scalar([](const P& p) { return p.dissipated_energy(); })},
      {"work_energy", "energy", "stored and dissipated energy", Standard::no, Needs::nothing,
       scalar([](const P& p) { return p.stored_energy() + p.dissipated_energy(); })},
      {"heat_energy", "energy", "mass times heat capacity times temperature", Standard::no, Needs::heat,
       scalar([](const P& p) { return p.temperature() * (p.mass() * p.heat_capacity()); })},
      {"cell_crossings", "-", "number of times the particle has moved to another grid cell", Standard::no,
       Needs::nothing, scalar([](const P& p) { return p.cell_crossings(); })},
      {"volume_ratio", "-", "J = V / V0", Standard::yes, Needs::nothing,
       scalar([](const P& p) { return p.volume() * p.density() / p.mass(); })},
      {"contact_state", "-", "0 open, 1 stick, 2 slip", Standard::yes, Needs::contact,
       scalar([](const P& p) { return p.contact_state(); })},
      {"contact_traction", "stress", "contact traction on the particle's face", Standard::yes, Needs::contact,
       vector([](const P& p) { return p.contact_traction(); })},
      {"contact_normal", "-", "contact normal, outward from the particle's body", Standard::yes, Needs::contact,
       vector([](const P& p) { return p.contact_normal(); })},
      {"temperature", "temperature", "temperature, if any process changes it or depends on it", Standard::yes,
       Needs::heat, scalar([](const P& p) { return p.temperature(); })},
      {"history", "-", "all history variables of the material, by name", Standard::yes, Needs::nothing,
       history_variables()},
  };
  return list;
}

const ParticleField* find_particle_field(std::string_view name) {
  struct Alias {
    std::string_view dialect, name;
  };
  static constexpr Alias aliases[] = {
      {"strainenergy", "strain_energy"}, {"plasticenergy", "plastic_energy"},    {"workenergy", "work_energy"},
      {"heatenergy", "heat_energy"},     {"elementcrossings", "cell_crossings"}, {"rotstrain", "rotation"},
      {"plasticstrain", "history"}};
  for (const Alias& a : aliases)
    if (same_name(name, a.dialect)) return find_name(particle_fields(), a.name);
  // NairnMPM numbers the history variables of a material; Tribo writes all of them by name
  const bool numbered = name.size() > 7 && same_name(name.substr(0, 7), "history") &&
                        name.find_first_not_of("0123456789", 7) == std::string_view::npos;
  return find_name(particle_fields(), numbered ? name.substr(0, 7) : name);
}

const std::vector<std::string>& standard_particle_fields() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& field : particle_fields())
      if (field.standard == ParticleField::Standard::yes) out.emplace_back(field.name);
    return out;
  }();
  return names;
}

const std::vector<GridField>& grid_fields() {
  using N = GridNodeState;
  static const std::vector<GridField> list{
      {"mass", "mass", "of all velocity fields at the node", 1, [](const N& n, double* to) { to[0] = n.mass; }},
      {"velocity", "velocity", "momentum over mass of all velocity fields at the node", 3,
       [](const N& n, double* to) { std::copy_n(n.velocity.data(), 3, to); }},
  };
  return list;
}

const GridField* find_grid_field(std::string_view name) {
  for (const auto& field : grid_fields())
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace tribo
