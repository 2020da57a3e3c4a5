// SPDX-License-Identifier: MIT
/// Interface between the solver and the material laws, and the adapter for laws written for one point.
///
/// A law is always three-dimensional; two-dimensional analyses are motions without out-of-plane shear.
/// The solver calls a law once per batch of points: one virtual call, arrays of components.
#pragma once

#include "base/catalogue.hpp"
#include "base/error.hpp"
#include "base/types.hpp"
#include "materials/plane_stress.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace tribo {

/// A state variable that a law stores per point, named for output and restart.
struct HistoryVariable {
  std::string name;
  Dimension dimension = Dimension::none;
  double initial = 0.0;
};

/// Upper limit of history variables per law. Pointers to their columns are passed in arrays of this size.
inline constexpr std::size_t most_history_variables = 64;

/// Reserved name of a history variable. Its initial value is the angle of the body's material axes about z [rad].
inline constexpr std::string_view material_angle = "material_angle";

/// A batch of consecutive points as views into the particle columns: one array per component, see Layout.
/// Stress is Cauchy stress, tension positive.
template <int Dim>
struct MaterialPoints {
  int count = 0;
  double dt = 0.0;            ///< time step                                                          [time]
  bool plane_stress = false;  ///< the law chooses L_zz so that sigma_zz = 0; it updates L[zz], F[zz] and volume
  std::array<double*, Layout<Dim>::full> L{};            ///< velocity gradient during the step    [1/time]
  std::array<double*, Layout<Dim>::full> F{};            ///< deformation gradient at t + dt       [-]; null if not kept
  std::array<double*, Layout<Dim>::symmetric> stress{};  ///< at t on entry, at t + dt on return   [stress]
  const double* mass = nullptr;                          ///< [mass]
  double* volume = nullptr;                              ///< current, at t + dt                   [length^3]
  std::span<double* const> history;                      ///< one array per HistoryVariable
  const double* temperature = nullptr;  ///< at t; null: the reference temperature applies           [temperature]
  double reference_temperature = 0.0;   ///< temperature for which the properties are given          [temperature]
  Vec3 cell = Vec3::Ones();             ///< edge lengths of the grid cells, for laws that localise  [length]
};

/// Interface of all material laws.
class Material {
 public:
  virtual ~Material() = default;

  /// Advances stress and history of every point by one step.
  virtual void update(const MaterialPoints<2>& points) const = 0;
  virtual void update(const MaterialPoints<3>& points) const = 0;

  /// Density in the reference state [mass/length^3].
  virtual double density() const = 0;
  /// Largest rho c^2 in the reference state [stress], for the first time step.
  virtual double wave_modulus() const = 0;
  /// Largest rho_0 c^2 of the batch in its present state [stress], for adaptive time steps; c is the spatial wave speed
  /// and rho_0 the reference density, so this is the spatial modulus times J. It is an upper bound. Laws that do not
  /// stiffen keep the default.
  virtual double wave_modulus(const MaterialPoints<2>&) const { return wave_modulus(); }
  virtual double wave_modulus(const MaterialPoints<3>&) const { return wave_modulus(); }
  /// Stored energy of the batch in its present state, summed over the points [energy].
  virtual double stored_energy(const MaterialPoints<2>&) const { return 0.0; }
  virtual double stored_energy(const MaterialPoints<3>&) const { return 0.0; }
  /// How a law without tension keeps the volume strain by which it has opened, and which closes before it is pressed.
  struct Opening {
    std::size_t column = 0;                     ///< index into history() of the opening, a logarithmic volume strain
    std::optional<std::size_t> plastic_volume;  ///< index of the plastic volume strain that contains the opening
    double bulk_modulus = 0.0;                  ///< pressure over the elastic volume strain [stress]; 0: not constant
  };
  /// None for laws without openings that close. The solver averages the openings of a body over cells.
  virtual std::optional<Opening> opening() const { return std::nullopt; }
  /// What a law has not, if its work is not all in stored_energy() and the dissipated energy: a phrase for the user, or
  /// nothing.
  virtual std::string unreported_energy() const { return {}; }
  /// Index into history() of the dissipated energy per initial volume, or -1 if the law does not dissipate.
  virtual int dissipation_index() const { return -1; }

  virtual const std::vector<HistoryVariable>& history() const = 0;
  /// Whether the law uses the deformation gradient F. If false, the solver need not store it.
  virtual bool needs_deformation() const { return true; }
  /// Whether the stress depends on the temperature.
  virtual bool feels_temperature() const { return false; }
  /// Cell size from which on the law cannot be used [length].
  virtual double largest_cell() const { return std::numeric_limits<double>::infinity(); }
  /// Whether the material is a liquid with a viscosity [stress time] as a function of the shear rate [1/time].
  virtual bool liquid() const { return false; }
  virtual double viscosity(double) const { return 0.0; }
  /// Upper bound of the viscosity, for the time step [stress time].
  virtual double largest_viscosity() const { return 0.0; }
  /// Whether the material is rigid: prescribed motion, no stress.
  virtual bool rigid() const { return false; }
  /// The same law with its strength divided by `factor`: cohesion, tangent of the friction angle, tensile strength,
  /// yield stress. The dilation angle is kept, but not above the friction angle. Null for laws without strength.
  virtual std::shared_ptr<const Material> weakened([[maybe_unused]] double factor) const { return nullptr; }
};

/// A law gave a stress that is not finite for a motion that is.
class StressError : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

/// Whether an initial stress is preserved by a step without motion. It is not if the law computes the stress from the
/// deformation gradient.
bool keeps_stress(const Material& law);

/// Moduli of an isotropic law in its reference state.
struct ElasticModuli {
  double G = 0.0;   ///< shear modulus [stress]
  double nu = 0.0;  ///< Poisson's ratio
  double E() const { return 2 * G * (1 + nu); }
};
/// Determined from the stresses of small strains; none for liquids, rigid and anisotropic laws.
std::optional<ElasticModuli> elastic_moduli(const Material& law);

/// Motion and environment of one material point in one step.
struct Motion {
  Mat3 F;                            ///< deformation gradient at t + dt [-]
  Mat3 L;                            ///< velocity gradient during the step [1/time]
  double dt;                         ///< time step [time]
  double temperature = 0.0;          ///< at t [temperature]
  double reference_temperature = 0;  ///< temperature for which the properties are given [temperature]
  Vec3 cell = Vec3::Ones();          ///< edge lengths of the grid cells [length]
};

struct NoState {};

/// Batch implementation for a law written for one point. `Law` is a plain struct with
/// - `static constexpr std::string_view name, summary; static constexpr int number;` (type number in NairnMPM, or 0)
/// - `static constexpr std::string_view example`: a <Material> element for the manual, in m, kg, s
/// - `static constexpr std::string_view needs`, optional: which of the optional parameters are needed together
/// - `static auto parameters()`: std::array<Parameter<Law>, N>
/// - `static std::vector<OwnProperty> own_properties()`, optional: words and lists that `prepare` reads itself
/// - `void prepare(const Statement&, Problems&)`: derived constants and checks, called once; optionally with a Units
///   argument between the two
/// - `double density; double wave_modulus() const;`
/// - `using State = ...`: NoState, or a struct of doubles with `static auto history()`, a tuple of StateVariable
/// - `Mat3 stress(const Motion&, const Mat3& old_stress, State&) const`
/// - `double energy_density(const Mat3& F, const Mat3& stress, const State&) const`: stored energy per current volume
/// - `void weaken(double factor)`, optional: see Material::weakened
/// - `Material::Opening opening() const`, optional: see Material::opening
/// - `bool feels_temperature() const; double largest_cell() const`, optional: see Material
///
/// Plane stress is solved by this class for every such law, see plane_stress.hpp.
template <class State>
struct StateVariable {
  std::string_view name;
  Dimension dimension;
  double State::*member;
};

template <class Law>
class PointwiseMaterial : public Material {
 public:
  explicit PointwiseMaterial(Law law) : law_(std::move(law)) {
    if constexpr (has_state) {
      const typename Law::State start = initial();
      std::apply(
          [&](const auto&... v) {
            (history_.push_back({std::string(v.name), v.dimension, start.*(v.member)}), ...);
          },
          Law::history());
      for (std::size_t k = 0; k < history_.size(); ++k)
        if (history_[k].name == "dissipation") dissipation_ = static_cast<int>(k);
    }
  }

  void update(const MaterialPoints<2>& points) const override { advance<2>(points); }
  void update(const MaterialPoints<3>& points) const override { advance<3>(points); }
  double density() const override { return law_.density; }
  double wave_modulus() const override { return law_.wave_modulus(); }
  double wave_modulus(const MaterialPoints<2>& points) const override { return stiffest<2>(points); }
  double wave_modulus(const MaterialPoints<3>& points) const override { return stiffest<3>(points); }
  double stored_energy(const MaterialPoints<2>& points) const override { return stored<2>(points); }
  double stored_energy(const MaterialPoints<3>& points) const override { return stored<3>(points); }
  int dissipation_index() const override { return dissipation_; }
  std::optional<Opening> opening() const override {
    if constexpr (requires { law_.opening(); }) return law_.opening();
    return std::nullopt;
  }
  const std::vector<HistoryVariable>& history() const override { return history_; }
  std::shared_ptr<const Material> weakened([[maybe_unused]] double factor) const override {
    if constexpr (requires(Law law) { law.weaken(factor); }) {
      Law law = law_;
      law.weaken(factor);
      return again(std::move(law));
    }
    return nullptr;
  }
  bool feels_temperature() const override {
    if constexpr (requires { law_.feels_temperature(); }) return law_.feels_temperature();
    return false;
  }
  double largest_cell() const override {
    if constexpr (requires { law_.largest_cell(); }) return law_.largest_cell();
    return Material::largest_cell();
  }
  const Law& law() const { return law_; }

 protected:
  using State = typename Law::State;
  static constexpr bool has_state = !std::is_same_v<State, NoState>;

  /// A material of the same kind with another law.
  virtual std::shared_ptr<const Material> again(Law law) const {
    return std::make_shared<PointwiseMaterial>(std::move(law));
  }

  State initial() const {
    if constexpr (requires { law_.initial_state(); })
      return law_.initial_state();
    else
      return State{};
  }

  template <int Dim>
  State load(const MaterialPoints<Dim>& points, int i) const {
    State state = initial();
    if constexpr (has_state) {
      std::size_t k = 0;
      std::apply([&](const auto&... v) { ((state.*(v.member) = points.history[k++][i]), ...); }, Law::history());
    }
    return state;
  }

  template <int Dim>
  void store([[maybe_unused]] const State& state, [[maybe_unused]] const MaterialPoints<Dim>& points,
             [[maybe_unused]] int i) const {
    if constexpr (has_state) {
      std::size_t k = 0;
      std::apply([&](const auto&... v) { ((points.history[k++][i] = state.*(v.member)), ...); }, Law::history());
    }
  }

 private:
  template <int Dim>
  void advance(const MaterialPoints<Dim>& points) const {
    for (int i = 0; i < points.count; ++i) {
      const double reference = points.reference_temperature;
      Motion motion{load_full<Dim>(points.F, i),
                    load_full<Dim>(points.L, i),
                    points.dt,
                    points.temperature ? points.temperature[i] : reference,
                    reference,
                    points.cell};
      const Mat3 old = load_symmetric<Dim>(points.stress, i);
      State state = load(points, i);
      Mat3 stress;
      if (Dim == 2 && points.plane_stress)
        stress = plane_stress(motion, old, state, points, i);
      else
        stress = law_.stress(motion, old, state);
      store_symmetric<Dim>(stress, points.stress, i);
      store(state, points, i);
    }
  }

  // Plane stress: finds the out-of-plane rate for which sigma_zz vanishes.
  template <int Dim>
  Mat3 plane_stress(Motion motion, const Mat3& old, State& state, const MaterialPoints<Dim>& points, int i) const {
    const State start = state;
    const double F_zz = motion.F(2, 2);
    Mat3 s;
    const auto trial = [&](double rate) {
      motion.L(2, 2) = rate;
      motion.F(2, 2) = F_zz * std::exp(rate * motion.dt);
      state = start;
      s = law_.stress(motion, old, state);
      return s(2, 2);
    };
    out_of_plane_rate(trial, law_.wave_modulus(), motion.dt);
    constexpr auto zz = static_cast<std::size_t>(Layout<Dim>::full - 1);
    points.L[zz][i] = motion.L(2, 2);
    points.F[zz][i] = motion.F(2, 2);
    points.volume[i] *= motion.F(2, 2) / F_zz;
    s(2, 2) = 0.0;
    return s;
  }

  template <int Dim>
  double stiffest(const MaterialPoints<Dim>& points) const {
    if constexpr (requires(const Mat3& m, const State& s) { law_.wave_modulus(m, m, s); }) {
      double most = 0.0;
      for (int i = 0; i < points.count; ++i) {
        const Mat3 F = load_full<Dim>(points.F, i);
        // the law gives the spatial modulus rho c^2, and rho_0 = rho J
        most = std::max(most,
                        law_.wave_modulus(F, load_symmetric<Dim>(points.stress, i), load(points, i)) * F.determinant());
      }
      return most;
    } else {
      return law_.wave_modulus();
    }
  }

  template <int Dim>
  double stored(const MaterialPoints<Dim>& points) const {
    double sum = 0.0;
    for (int i = 0; i < points.count; ++i)
      sum += points.volume[i] *
             law_.energy_density(load_full<Dim>(points.F, i), load_symmetric<Dim>(points.stress, i), load(points, i));
    return sum;
  }

  Law law_;
  std::vector<HistoryVariable> history_;
  int dissipation_ = -1;
};

/// Catalogue entry of a law with the batch implementation `Lifted`.
template <class Law, class Lifted = PointwiseMaterial<Law>>
Catalogue<Material>::Item material_law(const std::vector<std::string>& aliases = {}) {
  return catalogue_item<Material, Law, Lifted>(aliases);
}

/// All materials; generated from materials/CMakeLists.txt.
const Catalogue<Material>& materials();
/// The same list, to which a program may add laws of its own.
Catalogue<Material>& extensible_materials();

}  // namespace tribo
