// SPDX-License-Identifier: MIT
#include "run/particle_fields.hpp"

#include "base/finite.hpp"
#include "base/parallel.hpp"
#include "run/result_units.hpp"
#include "solver/particle_splitting.hpp"
#include "solver/state/particle_domain.hpp"
#include "solver/transfer/material_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace tribo {
namespace {

// Fields are filled for this many particles at a time, as long as they are in the cache.
constexpr std::size_t part_size = 1024;

/// The columns of the particles of a body.
template <int Dim>
class BodyStates final : public ParticleStates {
 public:
  explicit BodyStates(Body<Dim>& body) : body_(body) {
    auto& p = body.particles;
    id = p.id.data(), material_number = body.material + 1;
    for (std::size_t d = 0; d < Dim; ++d) velocity[d] = p.v()[d], position[d] = p.x()[d], origin[d] = p[body.origin][d];
    mass = p.mass(), volume = p.volume(), density = body.law->density();
    for (std::size_t k = 0; k < Layout<Dim>::symmetric; ++k)
      stress[symmetric_place(Layout<Dim>::symmetric_at[k])] = p.stress()[k];
    has_deformation = p.has_deformation();
    for (std::size_t k = 0; k < Layout<Dim>::full && has_deformation; ++k) {
      const auto [r, c] = Layout<Dim>::full_at[k];
      deformation[static_cast<std::size_t>(3 * r + c)] = p.F()[k];
    }
    cell_crossings = column(body.crossings), temperature = column(body.temperature);
    heat_capacity = body.heat_capacity;
  }

  double stored_energy(std::size_t i) const override { return tribo::stored_energy(body_, i); }
  double dissipated_energy(std::size_t i) const override { return tribo::dissipated_energy(body_, i); }
  double contact_state(std::size_t i) const override {
    const auto* const contact = body_.contact_of(i);
    return !contact ? 0.0 : contact->slips ? 2.0 : 1.0;
  }
  Vec3 contact_traction(std::size_t i) const override {
    const auto* const contact = body_.contact_of(i);
    return contact ? in_space(contact->traction) : Vec3(Vec3::Zero());
  }
  Vec3 contact_normal(std::size_t i) const override {
    const auto* const contact = body_.contact_of(i);
    return contact ? in_space(contact->normal) : Vec3(Vec3::Zero());
  }

 private:
  static std::size_t symmetric_place(const std::array<int, 2>& component) {
    const auto& places = Layout<3>::symmetric_at;
    return static_cast<std::size_t>(std::find(places.begin(), places.end(), component) - places.begin());
  }
  ParticleColumn column(ScalarColumn c) const { return c ? ParticleColumn(body_.particles[c]) : ParticleColumn(); }
  static Vec3 in_space(const Vec<Dim>& v) {
    Vec3 out = Vec3::Zero();
    out.template head<Dim>() = v;
    return out;
  }

  Body<Dim>& body_;
};

bool has_what_it_needs(const Model& model, const ParticleField& field) {
  switch (field.needs) {
    case ParticleField::Needs::heat:
      return model.heat.kept;
    case ParticleField::Needs::contact:
      return model.contact.active;
    case ParticleField::Needs::nothing:
    case ParticleField::Needs::deformation:
      return true;
  }
  return true;
}

}  // namespace

template <int Dim>
Mat<Dim> limited(Mat<Dim> axes, const Vec<Dim>& cell) {
  constexpr double longest = 1.5;
  const Mat<Dim> to_cells = cell.cwiseInverse().asDiagonal();
  const auto edge = [&](int k) { return 2 * (to_cells * axes.col(k)).norm(); };
  std::array<bool, Dim> full{};
  for (int pass = 0; pass < Dim; ++pass) {
    double lost = 1;
    for (int k = 0; k < Dim; ++k)
      if (edge(k) > longest)
        lost *= edge(k) / longest, axes.col(k) *= longest / edge(k), full[static_cast<std::size_t>(k)] = true;
    const auto others = std::count(full.begin(), full.end(), false);
    if (lost == 1 || others == 0) break;
    for (int k = 0; k < Dim; ++k)
      if (!full[static_cast<std::size_t>(k)]) axes.col(k) *= std::pow(lost, 1.0 / static_cast<double>(others));
  }
  return axes;
}

// Whether reduced() and limited() would leave the axes as they are, as for most particles.
template <int Dim>
bool is_compact(const Mat<Dim>& axes, const Vec<Dim>& cell, bool limits) {
  constexpr double most = 0.56;  // a little less than the square of half the longest edge
  const Mat<Dim> scaled = cell.cwiseInverse().asDiagonal() * axes;
  const Mat<Dim> products = scaled.transpose() * scaled;
  for (int i = 0; i < Dim; ++i) {
    if (limits && !(products(i, i) < most)) return false;
    for (int j = 0; j < Dim; ++j)
      if (i != j && !(std::abs(products(i, j)) < 0.499 * products(j, j))) return false;
  }
  return true;
}

template <int Dim>
ParticleFields<Dim>::ParticleFields(const Model& model, std::vector<Body<Dim>*> bodies,
                                    std::span<const ParticleRange<Dim>> ranges, const std::vector<std::string>& names,
                                    Precision precision)
    : bodies_(std::move(bodies)),
      limits_(model.scheme.kernel != Kernel::cpdi),
      single_(precision == Precision::single) {
  for (const auto& range : ranges) count_ += range.count();
  add_positions();
  for (const auto& name : names) {
    const ParticleField* field = find_particle_field(name);
    if (!field) throw std::logic_error("no such field: " + name);
    add(model, *field);
  }
  add_domains();
  const auto units = units_of_results(model);
  for (OutputField& field : fields_)
    if (const auto unit = units.find(field.name); unit != units.end()) field.unit = unit->second;
  fill(ranges);
}

template <int Dim>
std::vector<ParticleRange<Dim>> ParticleFields<Dim>::whole(const std::vector<Body<Dim>*>& bodies) {
  std::vector<ParticleRange<Dim>> out;
  for (auto* const body : bodies) out.push_back({{nullptr, 0, body->particles.size()}, body});
  return out;
}

// All fields of some particles, then of the next ones, as long as they are in the cache.
template <int Dim>
void ParticleFields<Dim>::fill(std::span<const ParticleRange<Dim>> ranges) {
  std::vector<Part> parts;
  std::size_t at = 0;
  for (const auto& range : ranges)
    for (std::size_t i = range.begin; i < range.end; i += part_size) {
      const std::size_t end = std::min(range.end, i + part_size);
      parts.push_back({{{range.order, i, end}, range.body}, at});
      at += end - i;
    }
  std::vector<char> finite(parts.size());
  parallel_for(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t k) {
    const Part& part = parts[static_cast<std::size_t>(k)];
    for (const auto& fill : fills_) fill(part);
    const auto is_finite = [&](const auto& rows) {
      return all_finite({rows.numbers.get() + part.at * rows.width, part.count() * rows.width});
    };
    finite[static_cast<std::size_t>(k)] = std::all_of(doubles_.begin(), doubles_.end(), is_finite) &&
                                          std::all_of(floats_.begin(), floats_.end(), is_finite);
  });
  fills_.clear();
  if (std::count(finite.begin(), finite.end(), 0) > 0) check_rows(count_, positions_, fields_);
}

template <int Dim>
typename ParticleFields<Dim>::Target ParticleFields<Dim>::add_rows(const std::string& name, std::size_t width,
                                                                   bool single) {
  Target to{};
  if (single)
    to.floats = floats_.emplace_back(count_, width).numbers.get();
  else
    to.doubles = doubles_.emplace_back(count_, width).numbers.get();
  fields_.push_back({name, {}, nullptr, nullptr, {to.doubles, to.floats, static_cast<int>(width)}});
  return to;
}

template <int Dim>
void ParticleFields<Dim>::add_positions() {
  double* const to = doubles_.emplace_back(count_, 3).numbers.get();
  positions_ = {to, nullptr, 3};
  fills_.push_back([to](const Part& part) {
    const auto x = part.body->particles.x();
    double* at = to + 3 * part.at;
    for (std::size_t i = part.begin; i < part.end; ++i)
      for (std::size_t d = 0; d < 3; ++d) *at++ = d < Dim ? x[d < Dim ? d : 0][part.particle(i)] : 0.0;
  });
}

template <int Dim>
void ParticleFields<Dim>::add(const Model& model, const ParticleField& field) {
  if (!has_what_it_needs(model, field)) return;
  if (field.value.history)
    add_history();
  else if (field.value.integers)
    add_integers(field);
  else
    add_numbers(field);
}

template <int Dim>
void ParticleFields<Dim>::add_integers(const ParticleField& field) {
  std::int64_t* const a =
      integers_.emplace_back(std::make_unique_for_overwrite<std::int64_t[]>(count_)).get();  // NOLINT(*-avoid-c-arrays)
  fields_.push_back({std::string(field.name), {}, a});
  fills_.push_back([a, integers = field.value.integers](const Part& part) {
    integers(BodyStates<Dim>(*part.body), part, a + part.at);
  });
}

template <int Dim>
void ParticleFields<Dim>::add_numbers(const ParticleField& field) {
  static constexpr std::size_t most = 9;
  const std::size_t n = field.value.components;
  if (n > most) throw std::logic_error("a field has too many components");
  const Target to = add_rows(std::string(field.name), n, single_);
  fills_.push_back([to, n, numbers = field.value.numbers](const Part& part) {
    std::array<double, most * part_size> values;
    double* const doubles = to.doubles ? to.doubles + n * part.at : values.data();
    numbers(BodyStates<Dim>(*part.body), part, doubles);
    if (!to.doubles) std::copy_n(doubles, n * part.count(), to.floats + n * part.at);
  });
}

// Variables of the same name in several materials share a field, which is zero for all others.
template <int Dim>
void ParticleFields<Dim>::add_history() {
  std::map<std::string, Target> known;
  for (const auto* body : bodies_)
    for (const auto& variable : body->law->history())
      if (known.count(variable.name) == 0) known[variable.name] = add_rows(variable.name, 1, single_);
  fills_.push_back([known](const Part& part) {
    const auto& variables = part.body->law->history();
    for (const auto& [name, to] : known) {
      const std::string& wanted = name;
      const auto found =
          std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == wanted; });
      const double* from = found == variables.end()
                               ? nullptr
                               : part.body->history_columns[static_cast<std::size_t>(found - variables.begin())];
      for (std::size_t i = part.begin; i < part.end; ++i)
        to.set(part.at + i - part.begin, from ? from[part.particle(i)] : 0.0);
    }
  });
}

template <int Dim>
void ParticleFields<Dim>::add_domains() {
  static constexpr std::size_t width = Dim * Dim;
  const Target size = add_rows("size", 3, true), to = add_rows("domain", width, true);
  fills_.push_back([to, size, limits = limits_](const Part& part) {
    const DomainReader<Dim> domain(*part.body);
    const Vec<Dim> cell = part.body->cell.template head<Dim>();
    std::size_t at = width * part.at;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const auto particle = static_cast<std::uint32_t>(part.particle(i));
      Mat<Dim> axes = domain(particle).axes;
      // Domains of cut cells are oblique from the start; other edges would not lie in the surface.
      if (!is_compact<Dim>(domain.box(particle).axes, cell, limits)) {
        axes = reduced<Dim>({axes, Mat<Dim>::Identity()}, cell).current;
        if (limits) axes = limited<Dim>(axes, cell);
      }
      for (std::size_t k = 0; k < width; ++k)
        to.set(at++, axes(static_cast<Eigen::Index>(k % Dim), static_cast<Eigen::Index>(k / Dim)));
      for (std::size_t k = 0; k < 3; ++k)
        size.set(3 * (part.at + i - part.begin) + k,
                 k < Dim ? 2 * axes.col(static_cast<Eigen::Index>(k < Dim ? k : 0)).norm() : 0.0);
    }
  });
}

template Mat<2> limited(Mat<2>, const Vec<2>&);
template Mat<3> limited(Mat<3>, const Vec<3>&);
template class ParticleFields<2>;
template class ParticleFields<3>;

}  // namespace tribo
