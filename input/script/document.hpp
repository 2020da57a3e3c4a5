// SPDX-License-Identifier: MIT
/// The command file that is built by the commands of a script.
#pragma once

#include "base/error.hpp"
#include "base/statement.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tribo::script {

/// Statements by section; finish() combines them.
class Document {
 public:
  explicit Document(const Origin& origin) : origin_(origin) {}

  /// A section of the file (e.g. `MPMHeader`), created at first use.
  Statement& section(const std::string& name, const Origin& origin);
  /// Adds a child with this text to a section; its place is that of the command.
  Statement& add(const std::string& section, const std::string& element, const Origin& origin,
                 const std::string& text = {});
  /// Sets the only child of this name: creates it or replaces its text.
  Statement& set(const std::string& section, const std::string& element, const Origin& origin,
                 const std::string& text = {});

  /// The only child of this name, or null.
  const Statement* find(const std::string& section, const std::string& element) const;
  /// Possible mistakes that do not stop the program.
  Problems& problems() { return problems_; }

  /// Starts a material. Materials are numbered in the order of definition.
  Statement& material(const Origin& origin);
  std::vector<Statement>& materials() { return materials_; }
  const std::vector<Statement>& materials() const { return materials_; }
  /// Adds a crack; each crack is a section of its own.
  std::vector<Statement>& cracks() { return cracks_; }
  /// From now on sections and materials are those of a stage, until end_stage().
  void begin_stage(Statement stage);
  /// Throws InputError if the stage has something that cannot change.
  void end_stage();
  /// Adds a stage that is complete.
  void add_stage(Statement stage) { stages_.push_back(std::move(stage)); }
  /// The material of the file that a material of a stage changes. Throws InputError if there is none.
  const Statement& material_before(const std::string& id, const Origin& origin) const;
  /// Names the last material. Throws InputError if another one has this name.
  void name_material(const std::string& id, const Origin& origin);

  /// An attribute that names a material by its id, which may be defined later.
  static void refer(Statement& s, const std::string& attribute, const std::string& id, const Origin& origin);

  /// A text that names a material by its id, which may be defined later.
  static void refer_text(Statement& s, const std::string& id, const Origin& origin);

  /// Sets the version of the format. Throws InputError if it is given already, or by the XML file that contains the
  /// script.
  void set_version(const std::string& text, const Origin& origin);

  /// Adds a line to the description.
  void describe(const std::string& line) { description_ += line + "\n"; }

  /// Names of the materials of the XML file that contains the script. References to materials are then made by name,
  /// since the file determines their numbers.
  void surround(const std::vector<std::string>& names);

  /// Replaces the ids of materials by numbers or names. Reports ids that were never defined.
  void resolve_references(Problems& problems);

  /// The sections only, to be added to an XML file, after resolve_references().
  std::vector<Statement> finish_sections(bool legacy);

  /// The complete file, after resolve_references().
  Statement finish(bool legacy);

 private:
  void resolve(Statement& s, Problems& problems) const;
  void resolve(Attribute& a, Problems& problems) const;
  std::string number_of(const std::string& id, const Origin& origin, Problems& problems) const;
  std::string name_of(const std::string& id) const;  ///< the name of the material of a known id
  bool named_by_parameter(Statement& s) const;
  static std::string hint_of_reaction(const Statement& s);

  Origin origin_;
  std::map<std::string, Statement> sections_;
  std::vector<Statement> materials_, cracks_, stages_;
  std::optional<Statement> stage_;  ///< the open one
  std::map<std::string, Statement> sections_before_;
  std::vector<Statement> materials_before_;  ///< while a stage is open: what lies outside of it
  std::map<std::string, std::size_t> ids_;   ///< number of each id, from 1
  std::string description_;
  std::optional<Attribute> version_;
  Problems problems_;            ///< warnings only
  bool inside_ = false;          ///< the script is part of an XML file
  std::size_t surrounding_ = 0;  ///< number of materials of that file
};

inline void attribute(Statement& s, const std::string& name, const std::string& text, const Origin& origin) {
  s.attributes.push_back({name, text, origin});
}

}  // namespace tribo::script
