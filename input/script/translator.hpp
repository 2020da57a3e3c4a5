// SPDX-License-Identifier: MIT
/// Translation of the commands of scripts to elements of command files.
#pragma once

#include "base/error.hpp"
#include "input/dialect.hpp"
#include "input/script/document.hpp"
#include "input/script/interpreter.hpp"

#include <array>
#include <functional>
#include <optional>

namespace tribo::script {

class Translator {
 public:
  explicit Translator(const Origin& origin) : document_(origin), origin_(origin) {}

  /// Translates a command. Throws InputError.
  void take(const Command& c);
  /// Refuses the assignment of a variable that is meant as a property of the material around it.
  void assigned(const std::string& name, const Node& n) const;
  /// First and last lines of XML in the script.
  const std::vector<std::array<int, 2>>& xml_lines() const { return xml_lines_; }
  /// States that some values in commands are not known, so that what they name may be missing.
  void lose_values() { values_lost_ = lost_a_material_ = true; }
  bool values_lost() const { return values_lost_; }
  /// For a script in an XML file: its analysis (10 to 13), its materials, and whether it has consistent units.
  void surround(int analysis, const std::vector<std::string>& materials, bool consistent);
  /// Possible mistakes that do not stop the program.
  const std::vector<Problem>& warnings() { return document_.problems().warnings(); }
  /// The complete command file. Adds a block that is still open and undefined materials to `problems`; if there are any
  /// problems, also unknown properties.
  Statement finish(Problems& problems);
  /// The elements that the script adds to the file that contains it. Problems as in finish().
  std::vector<Statement> finish_sections(Problems& problems);

 private:
  using Action = void (Translator::*)(const Command&);
  static const std::map<std::string, Action>& actions();

  // translate_header.cpp
  void version(const Command& c);
  void title(const Command& c);
  void user(const Command& c);
  void comment(const Command& c);
  void header(const Command& c);
  void analysis(const Command& c);
  void element_type(const Command& c);
  void must_be_cells(const Command& c, std::size_t k) const;
  void units(const Command& c);
  void method(const Command& c);
  void transfer(const Command& c);
  void time_step(const Command& c);
  void courant(const Command& c);
  void archive_time(const Command& c);
  void archive(const Command& c);
  void global_archive(const Command& c);
  void to_archive(const Command& c);
  void points_per_element(const Command& c);
  void plain(const Command& c);
  void extrapolate_rigid(const Command& c);
  void rate(const Command& c);
  void feedback(const Command& c);
  void processors(const Command& c);
  void multimaterial(const Command& c);
  void old_multimaterial(const Command& c);
  void contact_law(const Command& c);
  void old_friction(const Command& c);
  void contact_position(const Command& c);
  void grid_cells(const Command& c);
  void grid_edge(const Command& c);
  Statement& grid_axis(const Command& c, std::size_t axis);  ///< the element of an axis, added if it is missing
  void grid_box(const Command& c);
  void grid_thickness(const Command& c);
  void gravity(const Command& c);
  void conduction(const Command& c);
  void task(const Command& c);
  void parameter(const Command& c);
  void xml_data(const Command& c);
  void entity(const Command& c);
  void refused(const Command& c);

  // translate_bodies.cpp
  void material(const Command& c);
  void property(const Command& c);
  void region(const Command& c);
  void hole(const Command& c);
  void picture(const Command& c);
  void intensity(const Command& c);
  void picture_origin(const Command& c);
  void transform(const Command& c);
  void rotate(const Command& c);
  void initial_velocity(const Command& c);
  void initial_stress(const Command& c);
  void shape(const Command& c);
  void shape_of_file(const Command& c);
  void particle_table(const Command& c);
  void polygon_point(const Command& c);
  void conditions(const Command& c);
  void old_selector(const Command& c);
  void velocity(const Command& c);
  void temperature(const Command& c);
  void load(const Command& c);
  void without_effect(const Command& c, std::size_t k);
  void load_type(const Command& c);
  void traction(const Command& c);
  void heat_flux(const Command& c);
  void boundary_id(const Command& c);
  void end_block(const Command& c);

  // translate_blocks.cpp
  void blocks(const Command& c);
  void line_of_blocks(const Command& c, const ElementSpec& element);
  void must_follow_line(const Command& c, const std::string& child) const;
  void store_blocks();
  static void pairs(Statement& s, const ElementSpec& element, const Command& c, std::size_t first);

  // translate_stages.cpp
  void stage(const Command& c);
  void end_stage(const Command& c);
  void material_of_stage(const Command& c);
  void action(const Command& c);
  void when(const Command& c);

  // translate_cracks.cpp
  void new_crack(const Command& c);
  void grow_crack(const Command& c);
  void grow_crack_line(const Command& c);
  void grow_crack_arc(const Command& c);
  void contact_of_cracks(const Command& c);
  void crack_interface(const Command& c);
  void crack_traction(const Command& c);
  void crack_thickness(const Command& c);
  void move_plane(const Command& c);
  void propagate(const Command& c);
  void propagate_length(const Command& c);
  void j_contour(const Command& c);
  static void crack_end(Statement& s, const char* name, const Command& c, std::size_t k);
  Statement& crack_part(const Command& c, const char* element);
  Statement& crack_settings(const Command& c);
  Statement& crack_setting(const Command& c, const char* element);
  static void traction_of_part(Statement& s, const Command& c, std::size_t k);

  void translate(const Command& c, const std::string& word);
  void limit_damage(const Command& c, const std::string& meant);
  static void unknown_properties(const Statement& material, Problems& problems);
  int dimension(const Command& c) const;
  Statement& multimaterial_mode(const Command& c);
  static void add_to_section(Statement& section, const Statement& child);
  static Statement number_law(const Command& c);
  Statement& place(const Command& c, int cuts);
  void close_polygon() { polygon_ = nullptr; }
  void store_block();
  void conclude(Problems& problems);
  Statement& condition(const Command& c, const std::string& element);
  void style(Statement& s, const Command& c, std::size_t k, const char* value_name);
  static std::string direction(const Command& c, std::size_t k, bool traction);

  enum class Open { nothing, material, region, hole, picture, grid, particles, action, blocks };
  void open(Open block, const Command& c);

  Document document_;
  Origin origin_;
  int analysis_ = 0;
  bool consistent_ = false;
  double length_in_m_ = 1e-3, time_in_s_ = 1.0;
  bool in_lost_block_ = false;  ///< between a command that did not begin a block and the end of the block
  bool values_lost_ = false;
  bool lost_a_material_ = false;  ///< a material whose command has an error; references to it are not reported
  Open open_ = Open::nothing;
  std::optional<Origin> stage_;   ///< place of the stage that is open
  std::optional<Origin> blocks_;  ///< place of `Blocks`, of which there can be one
  std::string opened_by_;
  Origin opened_at_;
  Statement block_;                ///< the body, hole or selector being filled
  std::vector<std::size_t> path_;  ///< path to the last shape in it, for cut-outs
  Statement* polygon_ = nullptr;
  Statement* task_ = nullptr;
  std::string boundary_id_;
  std::string crack_x_, crack_y_;  ///< the last point of the last crack
  std::map<std::string, std::string> entities_;
  std::vector<std::array<int, 2>> xml_lines_;  ///< first and last lines of every XMLData
};

}  // namespace tribo::script
