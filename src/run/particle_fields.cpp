// SPDX-License-Identifier: MIT
#include "run/particle_fields.hpp"

#include "base/strain.hpp"
#include "solver/transfer/material_points.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

namespace tribo {
namespace {

template <int Dim>
Mat3 stress_of(Body<Dim>& body, std::size_t i) {
  return load_symmetric<Dim>(body.particles.stress(), static_cast<int>(i));
}

template <int Dim>
Mat3 deformation_of(Body<Dim>& body, std::size_t i) {
  return body.particles.has_deformation() ? load_full<Dim>(body.particles.F(), static_cast<int>(i))
                                          : Mat3(Mat3::Identity());
}

double von_mises(const Mat3& s) {
  const Mat3 deviator = s - s.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5 * deviator.squaredNorm());
}

// xx yy zz xy yz xz, as VTK wants it
std::array<double, 6> components(const Mat3& s) {
  std::array<double, 6> out{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [r, c] = Layout<3>::symmetric_at[k];
    out[k] = s(r, c);
  }
  return out;
}

}  // namespace

template <int Dim>
ParticleFields<Dim>::ParticleFields(const Model& model, std::vector<Body<Dim>*> bodies,
                                    const std::vector<std::string>& names)
    : model_(model), bodies_(std::move(bodies)) {
  for (const auto* body : bodies_) count_ += body->particles.size();
  for (std::size_t d = 0; d < 3; ++d) {
    auto& a = array();
    positions_[d] = a.data();
    if (d < Dim) each([&](Body<Dim>& body, std::size_t i, std::size_t at) { a[at] = body.particles.x()[d][i]; });
  }
  for (const auto& name : names) add(name);
}

template <int Dim>
const std::vector<std::string>& ParticleFields<Dim>::standard() {
  static const std::vector<std::string> fields{
      "id",           "material",      "velocity",         "displacement",   "stress",      "pressure", "von_mises",
      "volume_ratio", "contact_state", "contact_traction", "contact_normal", "temperature", "history"};
  return fields;
}

// f(body, index in it, index among all)
template <int Dim>
template <class F>
void ParticleFields<Dim>::each(F&& f) {
  std::size_t at = 0;
  for (auto* body : bodies_)
    for (std::size_t i = 0; i < body->particles.size(); ++i) f(*body, i, at++);
}

template <int Dim>
template <class F>
void ParticleFields<Dim>::scalar(const std::string& name, F&& value) {
  auto& a = array();
  each([&](Body<Dim>& body, std::size_t i, std::size_t at) { a[at] = value(body, i); });
  fields_.push_back({name, {a.data()}, nullptr});
}

template <int Dim>
template <class F>
void ParticleFields<Dim>::integer(const std::string& name, F&& value) {
  auto& a = integers_.emplace_back(count_, 0);
  each([&](Body<Dim>& body, std::size_t i, std::size_t at) { a[at] = value(body, i); });
  fields_.push_back({name, {}, a.data()});
}

template <int Dim>
template <std::size_t Count, class F>
void ParticleFields<Dim>::several(const std::string& name, F&& values) {
  OutputField field{name, {}, nullptr};
  std::array<std::vector<double>*, Count> a{};
  for (auto& c : a) c = &array(), field.components.push_back(c->data());
  each([&](Body<Dim>& body, std::size_t i, std::size_t at) {
    const auto value = values(body, i);
    for (std::size_t k = 0; k < Count; ++k) (*a[k])[at] = value[k];
  });
  fields_.push_back(field);
}

template <int Dim>
template <class F>
void ParticleFields<Dim>::vector(const std::string& name, F&& value) {
  several<3>(name, [&](Body<Dim>& body, std::size_t i) {
    std::array<double, 3> out{};
    for (std::size_t d = 0; d < Dim; ++d) out[d] = value(body, i, d);
    return out;
  });
}

template <int Dim>
void ParticleFields<Dim>::add(const std::string& name) {
  using B = Body<Dim>&;
  if (name == "id") {
    integer(name, [](B body, std::size_t i) { return body.particles.id[i]; });
  } else if (name == "material") {
    integer(name, [](B body, std::size_t) { return body.material + 1; });
  } else if (name == "velocity") {
    vector(name, [](B body, std::size_t i, std::size_t d) { return body.particles.v()[d][i]; });
  } else if (name == "displacement") {
    vector(name, [](B body, std::size_t i, std::size_t d) {
      return body.particles.x()[d][i] - body.particles[body.origin][d][i];
    });
  } else if (name == "mass") {
    scalar(name, [](B body, std::size_t i) { return body.particles.mass()[i]; });
  } else if (name == "volume") {
    scalar(name, [](B body, std::size_t i) { return body.particles.volume()[i]; });
  } else if (name == "volume_ratio") {
    scalar(name, [](B body, std::size_t i) {
      return body.particles.volume()[i] * body.law->density() / body.particles.mass()[i];
    });
  } else if (name == "pressure") {
    scalar(name, [](B body, std::size_t i) { return -stress_of(body, i).trace() / 3.0; });
  } else if (name == "von_mises") {
    scalar(name, [](B body, std::size_t i) { return von_mises(stress_of(body, i)); });
  } else if (name == "stress") {
    several<6>(name, [](B body, std::size_t i) { return components(stress_of(body, i)); });
  } else if (name == "strain") {
    several<6>(name, [](B body, std::size_t i) { return components(biot_strain(deformation_of(body, i))); });
  } else if (name == "rotation") {
    several<3>(name, [](B body, std::size_t i) {
      const Vec3 turn = rotation_of(deformation_of(body, i));
      return std::array{turn[0], turn[1], turn[2]};
    });
  } else if (name == "deformation_gradient") {
    several<9>(name, [](B body, std::size_t i) {
      const Mat3 F = deformation_of(body, i);
      std::array<double, 9> out{};
      for (std::size_t k = 0; k < 9; ++k) out[k] = F(static_cast<int>(k) / 3, static_cast<int>(k) % 3);
      return out;
    });
  } else if (name == "strain_energy") {
    scalar(name, [](B body, std::size_t i) { return stored_energy(body, i); });
  } else if (name == "plastic_energy") {
    scalar(name, [](B body, std::size_t i) { return dissipated_energy(body, i); });
  } else if (name == "work_energy") {
    scalar(name, [](B body, std::size_t i) { return stored_energy(body, i) + dissipated_energy(body, i); });
  } else if (name == "cell_crossings") {
    scalar(name, [&](B body, std::size_t i) { return body.crossings ? body.particles[body.crossings][i] : 0.0; });
  } else if (name == "temperature" || name == "heat_energy") {
    if (!model_.heat.kept) return;
    const bool energy = name == "heat_energy";
    scalar(name, [&](B body, std::size_t i) {
      if (!body.temperature) return 0.0;
      return body.particles[body.temperature][i] * (energy ? body.particles.mass()[i] * body.heat_capacity : 1.0);
    });
  } else if (name == "contact_state") {
    if (model_.contact.active)
      scalar(name, [&](B body, std::size_t i) { return body.particles[body.contact_state][i]; });
  } else if (name == "contact_traction" || name == "contact_normal") {
    const bool normal = name == "contact_normal";
    if (model_.contact.active)
      vector(name, [&](B body, std::size_t i, std::size_t d) {
        return body.particles[normal ? body.contact_normal : body.contact_traction][d][i];
      });
  } else if (name == "history") {
    add_history();
  } else {
    throw std::logic_error("no such field: " + name);
  }
}

// Variables of the same name in several materials share a field.
template <int Dim>
void ParticleFields<Dim>::add_history() {
  std::map<std::string, std::vector<double>*> known;
  std::size_t offset = 0;
  for (auto* body : bodies_) {
    const auto& variables = body->law->history();
    for (std::size_t k = 0; k < variables.size(); ++k) {
      auto& a = known[variables[k].name];
      if (!a) a = &array(), fields_.push_back({variables[k].name, {a->data()}, nullptr});
      std::copy_n(body->history_columns[k], body->particles.size(), a->begin() + static_cast<std::ptrdiff_t>(offset));
    }
    offset += body->particles.size();
  }
}

template class ParticleFields<2>;
template class ParticleFields<3>;

}  // namespace tribo
