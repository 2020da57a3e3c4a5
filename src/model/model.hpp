// SPDX-License-Identifier: MIT
/// The model: complete description of a run in consistent units. The readers in input/ fill it, the solver uses it.
///
/// Angles are in radians. Vectors always have three components; those without a meaning are 0. Coordinates are global.
#pragma once

#include "base/expression.hpp"
#include "base/statement.hpp"
#include "base/units.hpp"
#include "geometry/region.hpp"
#include "geometry/scattered.hpp"
#include "model/blocks.hpp"
#include "model/prescribed.hpp"
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
  bool extrapolate_again = true;  ///< MUSL ("+" variants of USL and USAVG): strains from re-extrapolated velocities
  Kernel kernel = Kernel::linear;
  Transfer transfer = Transfer::flip;
  double flip_fraction = 1.0;            ///< blend only: fraction of FLIP in the velocity update
  int filter_order = 2;                  ///< XPIC(m), FMPM(k)
  int filter_every = 1;                  ///< XPIC/FMPM in every n-th step, FLIP in the others (PeriodicXPIC)
  double filter_period = 0.0;            ///< simulated time between steps with XPIC/FMPM; 0: use filter_every
  bool exponential_deformation = false;  ///< true: F <- exp(L dt) F (second order); false: F <- (1 + L dt) F
  bool b_bar = false;                    ///< B-bar: volumetric strain and pressure are averaged around each particle
  double cpdi_limit = 1.0;  ///< largest distance of a CPDI corner from the centre in cells; larger domains are scaled
};

struct TimeControl {
  double end = 1.0;
  double until = 0.0;  ///< the next stage begins at this time, at the latest; 0: there is none until the end
  double max_step = 1.0;
  double courant = 0.5;
  double transport_courant = 0.5;  ///< fraction of the largest stable time step of conduction
  bool adaptive = false;           ///< the time step follows wave speed and particle speed during the run
  double velocity_courant = 0.5;   ///< adaptive: largest particle travel per step, in cells
  double max_increase = 1.1;       ///< adaptive: largest growth factor of the time step per adjustment
  /// Time on which a step must land: the begin of the next stage, or the end of the run.
  double next_end() const { return until > 0 ? until : end; }
};

/// Method for the contact normal between two bodies at a node.
enum class NormalMethod {
  margin,    ///< plane with the largest margin between the particle domains; exact for flat faces
  logistic,  ///< logistic regression of the particle positions
  linear,    ///< linear regression of the particle positions
  average,   ///< mean of both volume gradients
  steepest,  ///< the volume gradient of larger magnitude
  largest,   ///< the volume gradient of the body with the larger volume at the node
  own,       ///< the volume gradient of the deformable body; of two deformable bodies, the one defined first
  specified
};
/// Method for the gap between two bodies at a node.
enum class Separation { edges, positions, displacements };

/// Contact between materials.
struct ContactSpec {
  bool active = false;
  NormalMethod normals = NormalMethod::margin;
  Separation separation = Separation::edges;
  double position = 0.8;    ///< Separation::positions: distance in cells at which bodies touch, or minus an exponent
  double rigid_bias = 1.0;  ///< weight of the volume gradient of a rigid body
  Vec3 direction = Vec3::UnitX();  ///< specified normal
  /// Impulses: whether the contact conditions hold at faces, between nodes; unset: see choose_impulses().
  std::optional<bool> at_faces;
  std::shared_ptr<const ContactLaw> default_law;
  std::map<std::pair<int, int>, std::shared_ptr<const ContactLaw>>
      pair_laws;  ///< by pair of materials, smaller index first
  /// A joint law that is assigned to a pair of materials.
  struct Joint {
    std::shared_ptr<const JointLaw> law;
    std::array<int, 2> materials{};  ///< materials of body 1 and body 2
    Origin origin;
  };
  /// Joint laws by pair of materials, smaller index first. They act where the faces touch at the start.
  std::map<std::pair<int, int>, Joint> joints;
  bool keeps_memory = false;  ///< a law of some stage of the run has a memory, so particles have columns for it
  /// The contact law of a pair, which acts where there is no joint.
  const ContactLaw* law(int a, int b) const {
    const auto found = pair_laws.find({std::min(a, b), std::max(a, b)});
    return (found == pair_laws.end() ? default_law : found->second).get();
  }
};

/// A crack of the input: straight segments in two dimensions, triangles in three.
struct CrackSpec {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> pieces;  ///< indices of corners; only the first two in two dimensions
  std::shared_ptr<const ContactLaw> law;             ///< between the faces; null: no interaction
  std::shared_ptr<const JointLaw> joint;             ///< used instead of `law` if not null
  /// Type of an end of the line. found: it is a tip if it lies in a body; none: no tip; exterior: it continues to a
  /// free surface.
  enum class End { found, tip, none, exterior };
  std::array<End, 2> ends{};  ///< first and last point
  bool fixed = false;         ///< the crack does not move with the bodies
  Origin origin;
};

/// Heat: sources of temperature changes.
/// Change of the temperature of all particles from `start` to `start + duration`, besides all other changes.
struct TemperatureRamp {
  double start = 0.0, duration = 0.0;  ///< [time]; a duration of 0: in one step
  double change = 0.0;                 ///< [temperature]
  bool sigmoidal = false;              ///< with a smooth start and end
  double lifetimes = 0.0;              ///< > 0: share 1 - exp(-(lifetimes x)^stretch) of the change, x from 0 to 1
  double stretch = 1.0;
  std::optional<Expression> share;  ///< of the change, as a function of position and time
  double function_time = 1.0;       ///< consistent time of one unit of the functions' argument t
  /// Fraction of the change that is done at a time.
  double done(double time) const;
};

struct HeatSpec {
  bool kept = false;  ///< particles have temperatures, because one of the options below or a law needs them
  bool conduction = false;
  bool work_heating = false;     ///< the work dissipated by material laws becomes heat
  bool contact_heating = false;  ///< the work of friction becomes heat
  double reference = 0.0;        ///< initial temperature of bodies without one of their own
  bool expansion = false;        ///< a material expands with its temperature
  std::vector<TemperatureRamp> ramps;
};

/// The regular grid of the input, without the padding layers that the solver adds.
struct GridSpec {
  std::array<double, 3> low{}, high{};
  std::array<int, 3> cells{1, 1, 1};
  double thickness = 1.0;  ///< plane strain and plane stress
  /// Plane boundaries [axis][0: low end, 1: high end]; they must lie on grid lines.
  std::array<std::array<std::optional<double>, 2>, 3> symmetry;  ///< no normal velocity, even tangential velocity
  std::array<std::array<std::optional<double>, 2>, 3> wall;      ///< walls with boundary-modified shape functions
  std::array<bool, 3> periodic{};                                ///< [axis] the low and high end are identified
  Origin origin;
};

/// Criterion and direction of crack growth.
struct Growth {
  enum class When {
    never,
    hoop_stress,     ///< maximum hoop stress: its stress intensity reaches KIc
    energy_density,  ///< minimum strain energy density around the tip reaches the value that belongs to KIc
    empirical,       ///< (K1/KIc)^KIexp + (K2/KIIc)^KIIexp reaches one
    release_rate,    ///< the energy release rate reaches JIc
  };
  /// Direction of growth: that of the criterion, along the crack, normal to the opening displacement, of maximum hoop
  /// stress derived from the opening displacement, or the initial direction of the crack.
  enum class Way { of_criterion, straight_on, normal_to_opening, hoop_of_opening, as_at_start };
  When when = When::never;
  Way way = Way::of_criterion;
};

/// Fracture toughness of a material.
struct Toughness {
  std::optional<double> KIc, KIIc;  ///< [stress length^1/2]
  std::optional<double> JIc;        ///< [energy/length^2]
  double KIexp = 2.0, KIIexp = 2.0;
};

/// Quantities computed at crack tips.
struct FractureSpec {
  double size = 4.0;    ///< radius of the contour of the J integral [cells]
  bool inertia = true;  ///< J includes the inertia term within the contour
  double hop = 0.5;     ///< length by which a tip grows at once [cells]
};

/// Axis or relative direction of a load on particles.
enum class LoadDirection {
  x = 0,
  y = 1,
  z = 2,
  normal,     ///< outward normal of the face; tractions only
  tangential  ///< normal rotated by 90 degrees about z, counterclockwise; tractions in two dimensions only
};

/// Face of a particle's domain, numbered as in command files.
enum class DomainFace { low_y = 1, high_x = 2, high_y = 3, low_x = 4, low_z = 5, high_z = 6 };

/// A named law of the input: a material law, a contact law or a joint law.
struct MaterialSpec {
  std::string name;
  std::string type;  ///< name in the catalogue
  std::shared_ptr<const Material> law;
  std::optional<double> particle_damping;                   ///< [1/time]
  std::array<std::optional<Expression>, 3> rigid_velocity;  ///< rigid materials: prescribed velocity components
  std::array<bool, 3> sets_velocity{};  ///< Rigid: the components of the grid velocity that it prescribes
  bool rigid_contact = false;           ///< rigid material that interacts by contact laws
  int mirrored = 0;  ///< Rigid: velocities are mirrored beyond the face at the low (-1) or high (1) end of its bodies
  bool touches() const { return rigid_contact; }
  Statement statement{};  ///< the input, for provenance and for errors that are found later
  Origin origin{};
  std::shared_ptr<ContactLaw> contact{};  ///< not null: this is a contact law, `law` is null
  std::shared_ptr<JointLaw> joint{};      ///< not null: this is a joint law, `law` and `contact` are null
  double heat_capacity = 0.0;             ///< [energy/(mass temperature)]
  double conductivity = 0.0;              ///< [power/(length temperature)]
  double taylor_quinney = 1.0;            ///< fraction of the dissipated work that becomes heat
  double expansion = 0.0;                 ///< coefficient of linear thermal expansion [1/temperature]
  int share_field_with = -1;              ///< index of the material whose velocity field is shared; -1: none
  Toughness toughness{};
  Growth growth{};  ///< of cracks in this material
};

/// Initial deformation of a body: x -> x + shift(x), with deformation gradient F. Particles are placed in the
/// undeformed shape.
struct InitialDeformation {
  std::array<std::optional<Expression>, 3> shift;
  std::array<std::array<std::optional<Expression>, 3>, 3> F;
};

/// A shape of a body, or a hole. A particle site belongs to the first piece that contains it.
struct Piece {
  RegionPtr region;
  int material = -1;  ///< index into Model::materials; -1: hole
  Vec3 velocity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> velocity_function;
  std::optional<double> temperature;
  std::optional<double> thickness;
  std::array<int, 3> points_per_axis{0, 0, 0};  ///< particles per cell; 0: default of the model
  std::optional<double> point_size;             ///< edge length of a particle domain, instead of points_per_axis
  std::optional<InitialDeformation> deformation;
  std::array<std::optional<Expression>, 6> stress;  ///< initial Cauchy stress xx yy zz xy yz xz, functions of position
  std::shared_ptr<const ScatteredField> stress_points;  ///< stress to be added, same components, consistent units
  double stress_factor = 1.0;                           ///< factor of the stress functions to consistent units
  std::optional<double> K0;  ///< adds the geostatic stress under gravity with this ratio of horizontal to vertical
  double angle = 0.0;        ///< rotation of the material axes about z
  Origin origin;
};

/// A single particle of the input.
struct PointSpec {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  int material = 0;
  std::optional<double> mass;
  std::optional<Vec3> half_size;  ///< half edge lengths of its domain
  std::optional<double> temperature;
  double angle = 0.0;
  Origin origin;
};

/// A wall normal to an axis that moves through the grid. It starts in a plane of nodes and prescribes the velocity
/// along its normal on the nodes near its present place: v + g (x - s), with v the velocity of the wall, s its place
/// and g the velocity gradient at the wall.
struct MovingWall {
  int side = 1;        ///< 1: the material lies at smaller coordinates; -1: at larger ones
  double depth = 0.0;  ///< nodes within this distance on the side of the material are governed, too [cells]
  Expression displacement, gradient;
  bool mirror = false;                            ///< the gradient is that of the velocities of the last two free nodes
  double function_time = 1.0;                     ///< consistent time of one unit of t in the functions
  double length_unit = 1.0, gradient_unit = 1.0;  ///< factors of the values of the functions to consistent units
};

/// Prescribed velocity of grid nodes in a region.
struct NodeCondition {
  RegionPtr where;                 ///< of the nodes, or for a wall of the nodes where it starts
  Vec3 direction = Vec3::UnitX();  ///< unit vector of the prescribed component
  Prescribed velocity;
  std::optional<MovingWall> wall;
  int id = 0;  ///< identifies the condition in reaction histories, <= 0
  Origin origin;
};

/// Prescribed temperature of grid nodes in a region.
struct TemperatureCondition {
  RegionPtr where;
  Prescribed temperature;
  Origin origin;
};

/// Force on particles in a region, or traction or heat flux on a face of their domains. A positive normal traction is
/// tensile; a positive heat flux heats the particles.
struct ParticleCondition {
  enum class Kind { force, traction, heat_flux } kind = Kind::force;
  RegionPtr where;
  LoadDirection direction = LoadDirection::x;
  DomainFace face = DomainFace::low_y;  ///< traction and heat flux
  bool net = false;                     ///< the force is a total, divided among the particles found
  Prescribed value;
  Origin origin;
};

struct Damping {
  std::optional<Expression> grid, particle;        ///< [1/time]
  double function_time = 1.0;                      ///< consistent time of one unit of the functions' argument t
  std::optional<double> grid_gain, particle_gain;  ///< feedback damping: alpha' = gain (KE - target)
  std::optional<Expression> target_energy;
  double max_alpha = 0.0;  ///< 0: unlimited
};

/// Splitting of stretched particles and merging of crushed ones.
struct SplittingSpec {
  double longest = 1.0;  ///< length of a particle's domain above which it splits [cells]
  int generations = 6;   ///< how often a particle and its halves may split
  bool merge = true;     ///< neighbours that are small again merge
};

/// Removal of particles of a material during a run.
struct DeletionSpec {
  int material = 0;
  double opening = 0.0;  ///< of the crack in a failed particle, from which on it is removed       [length]
  double time = -1.0;    ///< all particles of the material are removed at this time; negative: never
};

/// An inlet through which particles of a material enter the grid. Their velocity is prescribed on the nodes around it.
struct SourceSpec {
  int material = 0;
  Vec3 centre = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();   ///< of the flow, a unit vector; in space along an axis
  double width = 0.0, depth = 0.0;  ///< of the inlet, across the flow                            [length]
  std::array<int, 2> count{1, 1};   ///< particles along width and depth
  double size = 0.0;                ///< edge of the particles                                    [length]
  Expression rate;                  ///< volume per time, as a function of t
  double function_time = 1.0;       ///< consistent time of one unit of t in `rate`
  /// Speed of the flow.
  double speed(double time) const {
    Variables at;
    at.t = time / function_time;
    return rate(at) / (width * depth);
  }
};

/// Strength reduction method: search for the factor of safety by which all strengths are divided at failure.
struct StrengthReduction {
  double low = 1.0, high = 2.0;  ///< initial bracket
  double tolerance = 0.01;       ///< width of the final bracket
  double growth = 0.05;          ///< failure: relative growth of the largest displacement in the run's last quarter
  std::optional<double> displacement;  ///< failure: largest displacement [length]
};

/// What loads, tractions and the motion of rigid materials do when a history passes a value.
struct LoadReversal {
  std::size_t history = 0;  ///< index into OutputSpec::history
  double value = 0.0;       ///< in the unit of the history
  enum class Style {
    reverse,  ///< they go back the way they came, and the run ends when they are back
    hold,     ///< they stay as they are, rigid materials stop
    stop      ///< the run ends
  } style = Style::reverse;
};

/// Feedback that moves a rigid material so that its force on the rest follows a function of time.
struct LoadControl {
  int material = -1;           ///< the rigid material
  int axis = 0;                ///< direction of motion and load
  Expression load;             ///< wanted force, in the units of the input, as a function of t
  double load_unit = 1.0;      ///< force of a value 1 of `load`                            [force]
  double function_time = 1.0;  ///< time of one unit of t in `load`                         [time]
  double start = 0.0;          ///< velocity until the stiffness is known                   [velocity]
  double fastest = 0.0;        ///< largest speed                                           [velocity]
  double Kp = 0.0;             ///< gain of the error                                       [1/time]
  double Ki = 0.0;             ///< gain of its integral                                    [1/time^2]
  double Kd = 0.0;             ///< gain of its rate
  double smooth = 0.9;         ///< share of the last value in the smoothed ones, per step
};

struct Model;

/// What a stage does to the present state when it begins.
struct StageAction {
  enum class Kind {
    excavate,  ///< removes particles
    bond,      ///< bonds joints that touch
    unbond     ///< breaks the bonds of joints
  } kind = Kind::excavate;
  RegionPtr where;    ///< excavate: the shape
  int material = -1;  ///< excavate: only particles of this material; -1: of all
  /// bond, unbond: criteria of the joints: shape, groups of blocks, orientation and kind of contact.
  std::optional<BlockJoint> joints;
  int law = -1;  ///< bond, unbond: only joints that follow this material, or a law derived from it; -1: all
  Origin origin;
};

/// Particles that a stage places.
struct Placement {
  int stage = 0;  ///< from 1
  std::vector<Piece> pieces;
};

/// An event at which a stage begins before its time, a file is written or the run stops.
struct Reaction {
  enum class What { bond_break, above, below, ratio } what = What::bond_break;
  enum class Effect { stop, frame, checkpoint, next_stage } effect = Effect::stop;
  std::size_t history = 0;  ///< above, below: index into the columns of history.csv without the time
  double value = 0.0;       ///< above, below: in the unit of the history; ratio: of unbalanced to applied forces
  std::string text;         ///< the condition in words
  Origin origin;
};

/// A stage of a run: from its time on the run continues with another model, after actions on the present state.
struct StageSpec {
  double at = 0.0;  ///< latest time of its begin
  std::string name;
  std::shared_ptr<const Model> model;
  std::vector<StageAction> actions;
  std::vector<std::string> changes;  ///< a phrase for each, for `tribo check` and stages.csv
  Origin origin;
};

/// What the models of a run with stages have in common, and the place of a model among them.
struct StagePlace {
  int number = 0;           ///< 0: the model at the start
  int count = 0;            ///< number of stages after the first model
  bool loads = false;       ///< a model of the run has forces, tractions or heat fluxes on particles
  std::size_t kept = 0;     ///< number of particle conditions at the begin of the list that were there before
  bool conditions = false;  ///< conditions on nodes are other ones than before
};

struct BodyForce {
  Vec3 gravity = Vec3::Zero();
  std::array<std::optional<Expression>, 3> function;      ///< acceleration f(x, y, z, t) of grid nodes
  std::array<std::optional<Expression>, 3> on_particles;  ///< acceleration of particles, also depends on x0, y0, z0
  bool acts_on_particles() const { return on_particles[0] || on_particles[1] || on_particles[2]; }
  double function_time = 1.0;
};

/// One column of history.csv.
struct HistoryQuantity {
  std::string name;           ///< as in the input, e.g. `velx`, `Kinetic Energy`
  std::string column;         ///< column head, e.g. `velx:Disk 1`
  int material = -1;          ///< -1: all materials
  int condition_id = 0;       ///< reactions: id of a node condition, 0: none
  int other = -1;             ///< contact: only contact with this material; -1: with all
  int variable = -1;          ///< histories of a history variable: its index in the law
  std::optional<Vec3> point;  ///< value of the particle whose initial position is nearest to this point
  Origin origin;
};

/// Id of a symmetry plane in reaction histories: -10 and -11 at the low and high end of x, -20 and -21 of y, ...
constexpr int symmetry_plane_id(int axis, int side) { return -10 * (axis + 1) - side; }

struct OutputSpec {
  /// Output times: `start`, then every `interval` until the start of the next group.
  struct Group {
    double start = 0.0, interval = 0.0;
    int max_contact_steps = 0;
  };
  std::vector<Group> archive;
  double history_interval = 0.0;  ///< 0: as for the particle files
  std::vector<HistoryQuantity> history;
  std::vector<std::string> particle_fields;  ///< empty: the standard set
  std::vector<std::string> grid_fields;      ///< for the .vti files; empty: none are written
  double checkpoint_interval = 0.0;          ///< simulated time; 0: only when the run is stopped

  bool has_field(std::string_view name) const {
    return std::find(particle_fields.begin(), particle_fields.end(), name) != particle_fields.end();
  }
  /// Whether a history is an average strain.
  bool wants_strain() const;
  /// Whether a history is an elastic or plastic share of a strain.
  bool wants_elastic_strain() const;
  /// Whether a field or a history needs the deformation gradient.
  bool wants_deformation() const;
};

struct Model {
  std::string file;                             ///< the command file
  std::string source;                           ///< its text
  std::string meaning;                          ///< the statements that it means, as a command file in XML
  std::vector<std::string> data_files;          ///< further files that it reads, from the folder of the command file
  std::map<std::string, std::string> settings;  ///< variables of a script that were set on the command line
  std::string title;
  Analysis analysis = Analysis::plane_strain;
  Units units;
  unsigned random_seed = 1;

  Scheme scheme;
  TimeControl time;
  GridSpec grid;
  int points_per_cell = 0;       ///< particles per cell; 0: the default, 4 in two dimensions and 8 in three
  bool whole_particles = false;  ///< the surfaces of shapes do not cut the cells of particles
  std::optional<SplittingSpec> splitting;
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
  std::shared_ptr<const BlocksSpec> blocks;  ///< rigid blocks, with or without a grid; null: none
  std::optional<FractureSpec> fracture;
  HeatSpec heat;
  OutputSpec output;
  std::optional<LoadReversal> reversal;
  std::optional<LoadControl> load_control;
  StagePlace stage;
  std::vector<StageSpec> stages;      ///< of the model at the start, in the order of time
  std::vector<Placement> placements;  ///< particles placed by stages; the same in all models of a run
  std::vector<Reaction> reactions;    ///< in force until the next stage
  /// Number of particles that may be put back into the grid after leaving it before the run stops; unset: the first
  /// particle that leaves stops the run.
  std::optional<long> leave_limit;
  bool delete_leaving = false;  ///< particles that leave are removed, up to this number
  std::vector<DeletionSpec> deletions;
  std::vector<SourceSpec> sources;
  /// Whether particles may come or go during the run.
  bool particles_change() const { return stage.count > 0 || delete_leaving || !deletions.empty() || !sources.empty(); }
  /// Whether the model consists of rigid blocks only, without grid and particles.
  bool only_blocks() const { return blocks && !blocks->in_grid; }
  std::vector<std::string> warnings;  ///< each `file:line:col: warning: ...`

  int dimension() const { return analysis == Analysis::solid ? 3 : 2; }
};

}  // namespace tribo
