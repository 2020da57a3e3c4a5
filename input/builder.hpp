// SPDX-License-Identifier: MIT
/// Builds a Model from a checked tree of statements. Problems are collected. Values that could not be read are replaced
/// by defaults, so that the remaining input can still be checked.
#pragma once

#include "base/schema.hpp"
#include "contact/joint_law.hpp"
#include "geometry/point_sets.hpp"
#include "geometry/terrain.hpp"
#include "input/particle_columns.hpp"
#include "input/read.hpp"
#include "model/blocks.hpp"
#include "model/model.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tribo {

/// Whether an attribute of type flag, which has been checked, says yes.
inline bool yes(std::string_view flag) { return flag == "yes" || flag == "1" || flag == "true"; }

/// The model of a tree without problems, with those of its stages.
Model build_with_stages(const Statement& root, const std::filesystem::path& folder);

class Builder {
 public:
  /// `order`: positions of the materials among those of the tree, by their number; empty: to be found.
  Builder(const Statement& root, std::filesystem::path folder, std::vector<std::size_t> order = {})
      : root_(root), folder_(std::move(folder)), order_(std::move(order)) {}
  /// The model. Throws InputError with all problems found.
  Model build();
  /// Checks the materials only, for a file whose other parts are incomplete. Throws InputError.
  void check_materials();
  /// The law and path of <Drive>; apart from it only units and materials are read. Throws InputError.
  Drive build_drive();

 private:
  // build_header.cpp
  void header();
  void mpm_header();
  void unstable_with_linear_functions(const Statement& header);
  void time_control(const Statement& header);
  void check_steps(const Origin& origin, double step, const std::string& why);
  void check_wave_steps();
  void damping(const Statement& header);
  void strength_reduction(const Statement& header);
  void mesh();
  void axis(const Statement& grid, int axis, std::string_view element, std::string_view count);

  // build_tasks.cpp
  void tasks();
  void task(const Statement& schedule);
  void check_parameters(const Statement& schedule, const std::string& task);
  void parameter(const Statement& schedule, const char* wanted,
                 const std::function<void(const Statement&, double)>& set);
  void periodic_filter(const Statement& schedule);
  void adjust_step(const Statement& schedule);
  void property_ramp(const Statement& schedule);
  void reverse_load(const Statement& schedule);
  bool reversal_by_length(const Statement& schedule, LoadReversal& reversal);
  bool reversal_by_history(const Statement& schedule, LoadReversal& reversal);
  int material_of_parameter(const Statement& schedule, const Statement& p);
  int material_of_task(const Statement& schedule);
  void deletion(const Statement& schedule);
  bool has_source() const;
  void source(const Statement& schedule);
  void source_conditions(const SourceSpec& source, const Origin& origin);
  void load_control(const Statement& schedule);
  double factor_of_history(const HistoryQuantity& q, const Statement& value);
  void archive_task(const Statement& schedule);
  void archive_task_time(const Statement& p, bool interval);

  // build_output.cpp
  void archive(const Statement& header);
  void report_unknown_fields();
  void check_outputs(const Origin& origin, double time, double interval, double most, const char* what);
  void history(const Statement& header);
  void check_histories();
  void check_elastic_strain(const HistoryQuantity& q);
  void find_variable(HistoryQuantity& q);
  Vec3 history_point(const Attribute& at);

  // build_materials.cpp
  void number_materials();
  template <class Item>
  void refuse_properties(const Statement& s, const Item& law, std::vector<std::string>& elsewhere);
  void materials();
  void contact();
  void cracks();
  void crack_settings(const Statement& general);
  void crack_thickness(const Statement& s);
  void set_end(const Statement& s, const char* code, CrackSpec::End& end);

  // build_fracture.cpp
  void fracture();
  void fracture_property(const Statement& s, MaterialSpec& spec);
  Growth growth(const Statement& s);
  static std::string missing_toughness(const MaterialSpec& material);
  CrackSpec crack(const Statement& s, std::vector<std::shared_ptr<const JointLaw>>& tractions);
  std::shared_ptr<const JointLaw> traction_law(const Statement& s, const char* by_number, const char* by_name);
  void add_crack(const CrackSpec& all, const std::vector<std::shared_ptr<const JointLaw>>& tractions);
  void pair_laws();
  void separate(int material, const Statement& f);
  void separate_bodies();
  void shared_fields();
  void liquid_of(const MaterialSpec& law);
  const MaterialSpec* named_law(const Statement& s);
  std::shared_ptr<const ContactLaw> default_law(const Statement& s);
  void pair_law(const Statement& f, int self, int other);
  void must_suit_grid(const MaterialSpec& law, const Origin& origin);
  std::shared_ptr<const ContactLaw> law_by_number(const Statement& s);
  double expansion(const Statement& s);
  double thermal_property(const Statement& s, Dimension dimension);
  void check_cell(const MaterialSpec& spec, double size, const Origin& origin);
  void check_cells();
  void reference_temperature(const Statement& header);
  /// Contents of a file that is named at `origin`. A file that cannot be read is a problem at `origin`.
  /// Place of an element of the root, or of the root if there is none.
  Origin place_of(std::string_view element) const;
  std::optional<std::string> content_of(const std::filesystem::path& file, const Origin& origin);
  StressField stress_field(const Statement& s);
  std::shared_ptr<const ScatteredField> stress_points(const Statement& s);
  double taylor_quinney(const Statement& s);
  bool work_heating() const;
  void rigid_functions(const Statement& statement, MaterialSpec& spec, bool contact);
  void set_functions(MaterialSpec& spec, const std::array<const Statement*, 3>& functions,
                     const std::array<bool, 3>& directions);
  /// Index of the material that an element names by mat or matname. If there is none, a problem is reported and 0
  /// returned.
  int material(const Statement& s, std::string_view by_number = "mat", std::string_view by_name = "matname");

  // build_bodies.cpp
  void bodies();
  void body(const Statement& s, bool hole);
  void picture(const Statement& s);
  void point(const Statement& s);

  // build_particle_table.cpp
  void particle_table(const Statement& s);
  void table_columns(const ParticleColumns& columns, ParticleTable& table, const Statement& s);

  // build_bodies.cpp
  void modify(const Statement& s, Piece& piece);
  bool has_axes(int material) const;
  void must_be_solid(const Statement& s, int material);
  RegionPtr shape(const Statement& s);
  RegionPtr plain_shape(const Statement& s);
  RegionPtr line_shape(const Statement& s);
  // How the coordinates of a file are transformed.
  struct Placement {
    double scale = 1.0;
    Vec3 shift = Vec3::Zero();
  };
  Placement placement(const Statement& s);
  RegionPtr surface_shape(const Statement& s);
  RegionPtr terrain_shape(const Statement& s);
  HeightGrid read_heights(const Statement& s, const std::string& path);
  RegionPtr arc_shape(const Statement& s);

  // build_conditions.cpp
  void conditions();
  void selector(const Statement& s, bool grid);
  RegionPtr selected(const Statement& s);
  std::optional<MovingWall> moving_wall(const Statement& s, const std::string& dir);
  void node_condition(const Statement& s, const RegionPtr& where);
  DomainFace face_of(const Statement& s);
  void particle_condition(const Statement& s, const RegionPtr& where, bool net);
  Prescribed prescribed(const Statement& s, std::string_view value, Dimension dimension);
  void temperature_condition(const Statement& s, const RegionPtr& where);
  void heat_flux(const Statement& s, const RegionPtr& where);
  void heat();
  void check_capacities(const Statement* thermal);
  void gravity();

  // build_blocks.cpp
  bool in_grid() const { return root_.child("Mesh") != nullptr; }
  bool of_blocks() const { return root_.child("Blocks") != nullptr && !in_grid(); }
  void blocks();
  void only_of_blocks();
  void blocks_in_grid(const BlocksSpec& spec);
  int block_material(const Statement& s);
  /// Whether a <GlobalArchive> refers to blocks or platens in a model with a grid.
  bool archives_blocks(const Statement& s) const {
    return root_.child("Blocks") && (has(s, "platen") || has(s, "block"));
  }
  BlockGroup block_group(const Statement& s);
  SurfaceProperties block_surface(const Statement& s);

  // build_block_joints.cpp
  void block_joints(const Statement& s, BlocksSpec& spec);
  BlockJoint joint_criteria(const Statement& s, const BlocksSpec* spec);
  BlockJoint block_joint(const Statement& s, const BlocksSpec& spec);
  BlockLaws block_laws(const Statement& s, const BlocksSpec& spec);
  std::shared_ptr<const JointLaw> named_later_law(const Statement& s);
  std::vector<std::int32_t> block_groups(const Statement& s, const char* attribute, const BlocksSpec& spec);
  std::optional<std::array<double, 2>> angle_range(const Statement& s, const char* attribute, double largest);

  // build_blocks.cpp
  void nuclei(const Statement& s, BlockGroup& group);
  void random_nuclei(const Statement& s, BlockGroup& group);
  void lattice_nuclei(const Statement& s, const std::string& kind, PointLattice lattice, BlockGroup& group);
  void nuclei_of_file(const Attribute& file, BlockGroup& group);
  void check_nuclei(const BlockGroup& group);
  std::shared_ptr<const JointLaw> joint_of(const Statement& s);
  RegionPtr shapes_of(const Statement& s);
  RegionPtr of_named_blocks(const Statement& s);
  void name_blocks(const Statement& s, BlocksSpec& spec);
  std::optional<TimeFunction> time_function(const Statement& s, const char* attribute, Dimension dimension,
                                            double factor = 1.0);
  void block_histories(BlocksSpec& spec);

  // build_stages.cpp
  void stages();
  StageSpec stage(const Statement& s, int number);
  int law_named(const Statement& s);
  StageAction stage_action(const Statement& s);
  void stress_action(const Statement& s, StageAction& action);
  void reactions();
  void reaction(const Statement& s);

  // build_drive.cpp
  MaterialDrive material_drive(const Statement& s, const MaterialSpec& spec);
  ContactDrive contact_drive(const Statement& s, const MaterialSpec& spec);
  JointDrive joint_drive(const Statement& s, const MaterialSpec& spec);
  void only_of_joints(const Statement& drive);
  std::vector<PathRow> path(const Statement& s, const std::vector<PathColumn>& columns);
  std::vector<PathRow> test_path(const Statement& s, Mat3& initial);

  // values
  bool has(const Statement& s, std::string_view attribute) const { return s.attribute(attribute) != nullptr; }
  double number(const Statement& s, std::string_view attribute, Dimension dimension, double fallback = 0.0);
  double converted(const Statement& s, const std::string& text, const Origin& origin, Dimension dimension,
                   double fallback);
  double coordinate(const Statement& s, std::string_view attribute, int axis, double fallback = 0.0);
  double text_number(const Statement& s, Dimension dimension, double fallback = 0.0);
  std::string word(const Statement& s, std::string_view attribute, const std::string& fallback = {}) const;
  Expression function(const std::string& text, const Origin& origin, const std::string& keyword);
  Expression particle_function(const std::string& text, const Origin& origin,
                               const std::string& keyword);  ///< may depend on x0, y0, z0
  std::optional<Expression> function(const Statement& s, std::string_view attribute);
  /// Factor of the `units` attribute of an element; legacy files only.
  double unit_factor(const Statement& s, Dimension dimension);
  double tolerance(const Statement& s);
  void warn(const Origin& origin, const std::string& message);
  void must(bool condition, const Origin& origin, const std::string& message);
  /// Calls `make` and reports an exception as a problem at the statement.
  RegionPtr placed(const Statement& s, const std::function<RegionPtr()>& make);

  const Statement& root_;
  std::filesystem::path data_file(const std::string& name);
  std::filesystem::path folder_;
  std::vector<std::size_t> order_;
  Model model_;
  Problems problems_;
  std::vector<std::pair<std::string, Origin>> unknown_fields_;  ///< asked for in particle files
  std::optional<Origin> wants_tip_loads_;                       ///< place of an output request that needs crack tips
  std::vector<const Statement*> material_statements_;
  std::vector<SurfaceProperties> surfaces_;  ///< of blocks, in the order of BlocksSpec::groups
};

}  // namespace tribo
