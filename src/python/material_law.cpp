// SPDX-License-Identifier: MIT
/// Material laws that are written in Python. The solver asks for the stresses of up to 64 points at once.

#include "materials/material.hpp"

#include "base/error.hpp"
#include "python/own_law.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// What Python has returned as an array of this shape.
Numbers numbers_of(const py::object& given, const std::vector<py::ssize_t>& shape, const std::string& what) {
  const py::object fitted = py::module_::import("tribo._arrays").attr("fit")(given, py::cast(shape), what);
  return fitted.cast<Numbers>();
}

template <int Dim>
Numbers full(const std::array<double*, Layout<Dim>::full>& columns, int count) {
  Numbers out(std::vector<py::ssize_t>{count, 3, 3});
  for (int i = 0; i < count; ++i)
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out.mutable_data(i)) = load_full<Dim>(columns, i);
  return out;
}

template <int Dim>
Numbers symmetric(const std::array<double*, Layout<Dim>::symmetric>& columns, int count) {
  Numbers out(std::vector<py::ssize_t>{count, 3, 3});
  for (int i = 0; i < count; ++i)
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out.mutable_data(i)) = load_symmetric<Dim>(columns, i);
  return out;
}

Numbers row(const double* numbers, int count) { return Numbers(count, numbers); }

bool all_finite(const double* numbers, py::ssize_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

template <class Columns>
bool are_finite(const Columns& columns, int count) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](const double* column) { return column == nullptr || all_finite(column, count); });
}

// Whether motion and state are finite. If they are not, the law is not to blame, and the run finds the particle.
template <int Dim>
bool is_finite(const MaterialPoints<Dim>& p) {
  return are_finite(p.L, p.count) && are_finite(p.F, p.count) && are_finite(p.stress, p.count) &&
         are_finite(p.history, p.count) && all_finite(p.volume, p.count);
}

void must_be_finite(const Numbers& given, const std::string& what) {
  if (!all_finite(given.data(), given.size()))
    throw StressError(what + " returned values that are not finite, though motion and state were finite");
}

class PythonMaterial final : public Material {
 public:
  PythonMaterial(Held law, std::string name) : law_(std::move(law)), name_(std::move(name)) {
    density_ = (*law_).attr("rho").cast<double>();
    modulus_ = (*law_).attr("wave_modulus")().cast<double>();
    if (!(modulus_ > 0) || !std::isfinite(modulus_))
      throw py::value_error("wave_modulus() must return a positive number, the largest rho c^2");
    needs_deformation_ = (*law_).attr("needs_deformation").cast<bool>();
    has_energy_ = (*law_).attr("_has_energy").cast<bool>();
    for (const auto item : (*law_).attr("_state_rows")().cast<py::list>()) {
      const auto [variable, dimension, initial] = item.cast<std::tuple<std::string, std::string, double>>();
      if (variable == "dissipation") dissipation_ = static_cast<int>(history_.size());
      history_.push_back({variable, dimension_of(dimension), initial});
    }
  }

  void update(const MaterialPoints<2>& points) const override { advance(points); }
  void update(const MaterialPoints<3>& points) const override { advance(points); }
  double density() const override { return density_; }
  double wave_modulus() const override { return modulus_; }
  double wave_modulus(const MaterialPoints<2>&) const override { return modulus_; }
  double wave_modulus(const MaterialPoints<3>&) const override { return modulus_; }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored(points); }
  std::string unreported_energy() const override {
    if (dissipation_ >= 0) return has_energy_ ? "" : "no method energy(p)";
    return has_energy_ ? "no state 'dissipation' (in case it dissipates)"
                       : "no method energy(p) and no state 'dissipation'";
  }
  int dissipation_index() const override { return dissipation_; }
  const std::vector<HistoryVariable>& history() const override { return history_; }
  bool needs_deformation() const override { return needs_deformation_; }

 private:
  // The points as Python sees them: copies, of which the state is written back.
  template <int Dim>
  py::object seen(const MaterialPoints<Dim>& p) const {
    py::dict state;
    for (std::size_t k = 0; k < history_.size(); ++k) state[py::str(history_[k].name)] = row(p.history[k], p.count);
    const auto optional = [&](bool there, const auto& make) { return there ? py::object(make()) : py::none(); };
    return py::module_::import("tribo.laws")
        .attr("Points")(p.dt, optional(needs_deformation_ && p.F[0], [&] { return full<Dim>(p.F, p.count); }),
                        optional(p.L[0], [&] { return full<Dim>(p.L, p.count); }), symmetric<Dim>(p.stress, p.count),
                        row(p.volume, p.count), optional(p.temperature, [&] { return row(p.temperature, p.count); }),
                        state);
  }

  template <int Dim>
  void advance(const MaterialPoints<Dim>& p) const {
    if (p.plane_stress)
      throw SimulationError(
          "material laws written in Python work in plane strain, axisymmetric and three-dimensional models, not in "
          "plane stress");
    const py::gil_scoped_acquire interpreter;
    const py::object points = seen(p);
    const Numbers stress = numbers_of((*law_).attr("stress")(points), {p.count, 3, 3}, method("stress()"));
    const bool to_blame = is_finite(p);
    if (to_blame) must_be_finite(stress, method("stress()"));
    for (int i = 0; i < p.count; ++i) store_symmetric<Dim>(Eigen::Map<const Mat3>(stress.data(i)), p.stress, i);
    const auto state = points.attr("state").cast<py::dict>();
    for (std::size_t k = 0; k < history_.size(); ++k) {
      const std::string& variable = history_[k].name;
      const Numbers now = numbers_of(state[py::str(variable)], {p.count}, method("the state '" + variable + "'"));
      if (to_blame) must_be_finite(now, method("stress()") + ", in the state '" + variable + "',");
      std::copy(now.data(), now.data() + p.count, p.history[k]);
    }
  }

  template <int Dim>
  double stored(const MaterialPoints<Dim>& p) const {
    if (!has_energy_) return 0.0;
    const py::gil_scoped_acquire interpreter;
    const Numbers density = numbers_of((*law_).attr("energy")(seen(p)), {p.count}, method("energy()"));
    double sum = 0.0;
    for (int i = 0; i < p.count; ++i) sum += p.volume[i] * density.data()[i];
    return sum;
  }

  std::string method(const std::string& what) const { return what + " of '" + name_ + "'"; }

  Held law_;
  std::string name_;
  double density_ = 0.0, modulus_ = 0.0;
  bool needs_deformation_ = true, has_energy_ = false;
  std::vector<HistoryVariable> history_;
  int dissipation_ = -1;
};

}  // namespace

void add_material_laws(py::module_& module) {
  module.def("add_material", [](const std::string& name, const std::string& summary, const py::list& parameters,
                                const py::object& make) {
    extensible_materials().add(own_law<Material, PythonMaterial>(name, summary, parameters, make));
  });
}

}  // namespace tribo::python
