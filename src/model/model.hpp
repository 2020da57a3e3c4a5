// SPDX-License-Identifier: MIT
/// The model: everything a run needs to know, in consistent units. Readers write it, the engine reads it; they never
/// meet.
///
/// Angles are radians, vectors always have three components (unused ones 0), coordinates are absolute.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "base/units.hpp"
#include "geometry/region.hpp"
#include "geometry/scattered.hpp"
#include "model/blocks.hpp"
#include "model/shape_functions.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribo {

class Material;
class ContactLaw;
class JointLaw;
struct BlocksSpec;

enum class Analysis { plane_strain, plane_stress, axisymmetric, solid };
enum class UpdateOrder { usf, usl, usavg };
enum class Transfer { flip, pic, blend, xpic, fmpm, apic };

struct Scheme {
  UpdateOrder order = UpdateOrder::usavg;
  bool extrapolate_again = true;  ///< the "+" variants of USL and USAVG (MUSL): strain from re-extrapolated velocities
  Kernel kernel = Kernel::linear;
  Transfer transfer = Transfer::flip;
  double flip_fraction = 1.0;            ///< blend only: share of FLIP in the particle velocity
  int filter_order = 2;                  ///< XPIC(m), FMPM(k)
  int filter_every = 1;                  ///< XPIC/FMPM on every n-th step, FLIP between (PeriodicXPIC)
  double filter_period = 0.0;            ///< XPIC/FMPM after this much time; 0: use filter_every
  bool exponential_deformation = false;  ///< F <- exp(L dt) F instead of the motion of the particles, 1 + L dt
  bool b_bar = false;                    ///< volume changes and pressures are means of the neighbourhood
  double cpdi_limit = 1.0;  ///< largest reach of a CPDI corner from the centre, in cells; domains beyond are scaled
};

struct TimeControl {
  double end = 1.0;
  double max_step = 1.0;
  double courant = 0.5;
  double transport_courant = 0.5;  ///< share of the largest stable step of conduction
  bool adaptive = false;           ///< follow wave speed and particle speed during the run
  double velocity_courant = 0.5;   ///< adaptive: largest particle travel per step, in cells
  double max_increase = 1.1;       ///< adaptive: growth of the step per adjustment
};

/// How the normal between two bodies at a node is found.
enum class NormalMethod {
  margin,    ///< largest margin between the particle domains; exact for flat faces
  logistic,  ///< logistic regression of the particles
  linear,    ///< linear regression
  average,   ///< mean of the volume gradients
  steepest,  ///< the larger volume gradient
  largest,   ///< the volume gradient of the larger volume
  own,       ///< the deformable body's own volume gradient, of two the one defined first
  specified
};
/// How the gap between two bodies at a node is found.
enum class Separation { edges, positions, displacements };

/// Contact between materials.
struct ContactSpec {
  bool active = false;
  NormalMethod normals = NormalMethod::margin;
  Separation separation = Separation::edges;
  double position = 0.8;           ///< separation by positions: cells between touching bodies, or minus an exponent
  double rigid_bias = 1.0;         ///< weight of a rigid body's gradient
  Vec3 direction = Vec3::UnitX();  ///< specified normal
  bool at_faces = false;           ///< impulses act on faces, between nodes, not on single nodes
  std::shared_ptr<const ContactLaw> default_law;
  std::map<std::pair<int, int>, std::shared_ptr<const ContactLaw>> pair_laws;  ///< by materials, smaller number first
  /// A joint law given to a pair, and where.
  struct Joint {
    std::shared_ptr<const JointLaw> law;
    std::array<int, 2> materials{};  ///< of the bodies 1 and 2
    Origin origin;
  };
  std::map<std::pair<int, int>, Joint> joints;  ///< by materials, as above: where their faces touch at the start
  /// Where no joint acts.
  const ContactLaw* law(int a, int b) const {
    const auto found = pair_laws.find({std::min(a, b), std::max(a, b)});
    return (found == pair_laws.end() ? default_law : found->second).get();
  }
};

/// A crack as the user drew it: straight pieces in two dimensions, triangles in three.
struct CrackSpec {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> pieces;  ///< corners; in two dimensions the first two count
  std::shared_ptr<const ContactLaw> law;             ///< between its faces; null: they do not see each other
  std::shared_ptr<const JointLaw> joint;             ///< or this
  /// Of the first and last point: whether it is a tip (unset: if it lies in a body), or goes on to a free surface.
  enum class End { found, tip, none, exterior };
  std::array<End, 2> ends{};
  bool fixed = false;  ///< the bodies do not carry it along
  Origin origin;
};

/// Temperatures: where they come from, and what changes them.
struct HeatSpec {
  bool kept = false;  ///< particles have temperatures: something below changes them, or a law feels them
  bool conduction = false;
  bool work_heating = false;     ///< what laws dissipate becomes heat
  bool contact_heating = false;  ///< the work of sliding faces becomes heat
  double reference = 0.0;        ///< temperature at the start unless a body says otherwise
};

/// The regular grid as the user wrote it, without the padding layers the engine adds.
struct GridSpec {
  std::array<double, 3> low{}, high{};
  std::array<int, 3> cells{1, 1, 1};
  double thickness = 1.0;  ///< plane strain and plane stress
  /// Plane faces, [axis][0 low, 1 high]; must lie on grid lines.
  std::array<std::array<std::optional<double>, 2>, 3> symmetry;  ///< mirror: no normal velocity, even tangential
  std::array<std::array<std::optional<double>, 2>, 3> wall;      ///< boundary-modified shape functions end here
  std::array<bool, 3> periodic{};  ///< [axis] the grid's two edges are one: what leaves comes in on the other side
  Origin origin;
};

/// When and how the tips of cracks grow.
struct Growth {
  enum class When {
    never,
    hoop_stress,     ///< the stress intensity of the largest hoop stress reaches KIc
    energy_density,  ///< the least strain energy density around the tip reaches that of KIc
    empirical,       ///< (K1/KIc)^KIexp + (K2/KIIc)^KIIexp reaches one
    release_rate,    ///< the energy release rate reaches JIc
  };
  enum class Way { of_criterion, straight_on, normal_to_opening, hoop_of_opening, as_at_start };
  When when = When::never;
  Way way = Way::of_criterion;
};

/// Resistance to the growth of cracks.
struct Toughness {
  std::optional<double> KIc, KIIc;  ///< [stress length^1/2]
  std::optional<double> JIc;        ///< [energy/length^2]
  double KIexp = 2.0, KIIexp = 2.0;
};

/// What is computed at the tips of cracks.
struct FractureSpec {
  double size = 4.0;    ///< radius of the ring around a tip [cells]
  bool inertia = true;  ///< J counts accelerations within the ring
  double hop = 0.5;     ///< by which a tip grows [cells]
};

/// A law with its name: of a material, of contact or of joints.
struct MaterialSpec {
  std::string name;
  std::string type;  ///< catalogue name
  std::shared_ptr<const Material> law;
  std::optional<double> particle_damping;                   ///< [1/time]
  std::array<std::optional<Expression>, 3> rigid_velocity;  ///< rigid materials: prescribed components
  int rigid_directions = 0;                                 ///< type 11: bits x 1, y 2, z 4; 8: touched by contact
  int mirrored =
      0;  ///< type 11: beyond the face at the low (-1) or high (1) end of the bodies, velocities are mirrored
  bool touches() const { return (rigid_directions & 8) != 0; }
  Statement statement{};  ///< as written, for provenance and late errors
  Origin origin{};
  std::shared_ptr<ContactLaw> contact{};  ///< instead of `law`
  std::shared_ptr<JointLaw> joint{};      ///< instead of both
  double heat_capacity = 0.0;             ///< [energy/(mass temperature)]
  double conductivity = 0.0;              ///< [power/(length temperature)]
  double taylor_quinney = 1.0;            ///< share of the dissipated work that becomes heat
  int share_field_with = -1;              ///< material whose velocity field this one shares
  Toughness toughness{};
  Growth growth{};  ///< of cracks in it
};

/// A deformation of a body before the start: x -> x + shift(x), with F. Points are found in the undeformed shape.
struct InitialDeformation {
  std::array<std::optional<Expression>, 3> shift;
  std::array<std::array<std::optional<Expression>, 3>, 3> F;
};

/// One shape of a body, or a hole. First match wins: a particle site is used by the first piece that contains it.
struct Piece {
  RegionPtr region;
  int material = -1;  ///< index into Model::materials; -1: hole
  Vec3 velocity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> velocity_function;
  std::optional<double> temperature;
  std::optional<double> thickness;
  std::array<int, 3> points_per_axis{0, 0, 0};  ///< per cell; 0: the model's default
  std::optional<double> point_size;             ///< instead: edge length of a particle's domain
  std::optional<InitialDeformation> deformation;
  std::array<std::optional<Expression>, 6> stress;  ///< initial Cauchy stress xx yy zz xy yz xz, functions of position
  std::shared_ptr<const ScatteredField> stress_points;  ///< added: components in the same order, consistent units
  double stress_factor = 1.0;                           ///< consistent units of the stress functions
  std::optional<double> K0;  ///< adds the stress at rest under gravity: horizontal over vertical
  double angle = 0.0;        ///< material axes, rotation about z
  Origin origin;
};

/// A single particle placed by the user.
struct PointSpec {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  int material = 0;
  std::optional<double> mass;
  std::optional<Vec3> half_size;  ///< of its domain
  std::optional<double> temperature;
  double angle = 0.0;
  Origin origin;
};

enum class Style { constant = 1, linear = 2, sine = 3, cosine = 4, silent = 5, function = 6 };

/// A value that follows one of the dialect's styles in time.
/// constant: value from t >= time; linear: value (t - time); sine: value sin(time t); cosine: value cos(time t);
/// function: f(t - time, x, y, z).
struct Prescribed {
  Style style = Style::constant;
  double value = 0.0, time = 0.0;
  Expression function;
  double function_time = 1.0;   ///< consistent time of one unit of the function's t
  double function_scale = 1.0;  ///< consistent units of the function's value
  double at(double t, const Vec3& x, double dt = 0.0) const;
};

/// Velocity of grid nodes in a region.
struct NodeCondition {
  RegionPtr where;
  Vec3 direction = Vec3::UnitX();  ///< unit vector; axis-parallel unless skewed
  Prescribed velocity;
  int id = 0;  ///< for reaction histories, <= 0
  Origin origin;
};

/// Temperature of grid nodes in a region.
struct TemperatureCondition {
  RegionPtr where;
  Prescribed temperature;
  Origin origin;
};

/// Force on particles in a region, or traction or heat flux through their faces.
struct ParticleCondition {
  enum class Kind { force, traction, heat_flux } kind = Kind::force;
  RegionPtr where;
  int direction = 0;  ///< 0 x, 1 y, 2 z; traction also 10 normal, 11 shear
  int face = 0;  ///< traction, flux: dialect's face number (2D 1 bottom 2 right 3 top 4 left; 3D 1-4, 5 bottom, 6 top)
  bool net = false;  ///< force is divided among the particles found
  Prescribed value;
  Origin origin;
};

struct Damping {
  std::optional<Expression> grid, particle;        ///< [1/time]
  double function_time = 1.0;                      ///< consistent time of one unit of t
  std::optional<double> grid_gain, particle_gain;  ///< feedback damping: alpha' = gain (KE - target)
  std::optional<Expression> target_energy;
  double max_alpha = 0.0;  ///< 0: unlimited
};

/// Search for the factor by which all strengths may be divided before the model slips.
struct StrengthReduction {
  double low = 1.0, high = 2.0;  ///< where the search begins
  double tolerance = 0.01;       ///< width of the bracket at the end
  double growth = 0.05;          ///< it slips if the largest displacement grows by this share in the run's last quarter
};

struct BodyForce {
  Vec3 gravity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> function;      ///< acceleration f(x, y, z, t) of the nodes
  std::array<std::optional<Expression>, 3> on_particles;  ///< of the particles, which also know x0, y0, z0
  bool acts_on_particles() const { return on_particles[0] || on_particles[1] || on_particles[2]; }
  double function_time = 1.0;
};

/// One column of history.csv.
struct HistoryQuantity {
  std::string name;    ///< as requested, e.g. `velx`, `Kinetic Energy`
  std::string column;  ///< column head: `velx:Disk 1`
  int material = -1;   ///< -1: all
  int condition_id = 0;
  int other = -1;             ///< contact: only with this material; -1: with all
  std::optional<Vec3> point;  ///< of the particle that starts nearest to it
  Origin origin;
};

/// The id that stands for a symmetry plane in histories: -10 and -11 at the low and high end of x, -20 ..., -30 ...
constexpr int symmetry_plane_id(int axis, int side) { return -10 * (axis + 1) - side; }

struct OutputSpec {
  /// Output times: from `start` every `interval` until the next group's start.
  struct Group {
    double start = 0.0, interval = 0.0;
    int max_contact_steps = 0;
  };
  std::vector<Group> archive;
  double history_interval = 0.0;  ///< 0: as the archive
  std::vector<HistoryQuantity> history;
  std::vector<std::string> particle_fields;  ///< empty: the standard set
  std::vector<std::string> grid_fields;      ///< for the .vti files; empty: none are written
  double checkpoint_interval = 0.0;          ///< simulated time; 0: only when stopped

  bool has_field(std::string_view name) const {
    return std::find(particle_fields.begin(), particle_fields.end(), name) != particle_fields.end();
  }
  /// Whether a history is a mean strain.
  bool wants_strain() const;
  /// Whether a field or a history needs F.
  bool wants_deformation() const;
};

struct Model {
  std::string file;                             ///< the command file
  std::map<std::string, std::string> settings;  ///< variables of a script that were set from outside
  std::string title;
  Analysis analysis = Analysis::plane_strain;
  Units units;
  unsigned random_seed = 1;

  Scheme scheme;
  TimeControl time;
  GridSpec grid;
  int points_per_cell = 0;  ///< total; 0: the dialect's default (4 in 2D, 8 in 3D)
  std::vector<MaterialSpec> materials;
  std::vector<Piece> pieces;
  std::vector<PointSpec> points;
  std::vector<NodeCondition> node_conditions;
  std::vector<ParticleCondition> particle_conditions;
  std::vector<TemperatureCondition> temperature_conditions;
  BodyForce body_force;
  StrengthReduction strength_reduction;
  Damping damping;
  ContactSpec contact;
  std::vector<CrackSpec> cracks;
  std::shared_ptr<const BlocksSpec> blocks;  ///< rigid blocks, alone or beside a grid; else null
  std::optional<FractureSpec> fracture;
  HeatSpec heat;
  OutputSpec output;
  /// Particles that leave the grid: unset stops the run; otherwise this many may be pushed back before it stops.
  std::optional<long> leave_limit;
  /// Rigid blocks without grid and particles.
  bool only_blocks() const { return blocks && !blocks->in_grid; }
  std::vector<std::string> warnings;  ///< each `file:line:col: warning: ...`

  int dimension() const { return analysis == Analysis::solid ? 3 : 2; }
};

}  // namespace tribo
