// SPDX-License-Identifier: MIT
/// The command file that a script's commands build, piece by piece.
#pragma once

#include "base/error.hpp"
#include "base/statement.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tribo::script {

/// Statements by section; finish() puts them together.
class Document {
 public:
  explicit Document(const Origin& origin) : origin_(origin) {}

  /// A section of the file (`MPMHeader`), made when first asked for.
  Statement& section(const std::string& name, const Origin& origin);
  /// A child of a section with this text; the place is that of the command.
  Statement& add(const std::string& section, const std::string& element, const Origin& origin,
                 const std::string& text = {});
  /// The only child of this name: made, or its text replaced.
  Statement& set(const std::string& section, const std::string& element, const Origin& origin,
                 const std::string& text = {});

  /// Starts a material; its number is its place in the order of definitions.
  Statement& material(const Origin& origin);
  std::vector<Statement>& materials() { return materials_; }
  const std::vector<Statement>& materials() const { return materials_; }
  /// Cracks, each a section of its own.
  std::vector<Statement>& cracks() { return cracks_; }
  /// Names the last material. Throws InputError if another one has this name.
  void name_material(const std::string& id, const Origin& origin);

  /// An attribute that names a material by its id, which may be defined later.
  static void refer(Statement& s, const std::string& attribute, const std::string& id, const Origin& origin);

  /// The same for the text of a statement.
  static void refer_text(Statement& s, const std::string& id, const Origin& origin);

  /// Adds a line to the description.
  void describe(const std::string& line) { description_ += line + "\n"; }

  /// Names of materials that an XML file around the script defines. With them, what refers to a material does so by
  /// name, as the file numbers them.
  void surround(const std::vector<std::string>& names);

  /// Complains about ids that were never defined.
  void check_references(Problems& problems) const;

  /// The sections alone, for a file that has the rest. Throws like finish().
  std::vector<Statement> finish_sections(bool legacy);

  /// The whole tree. Throws InputError for ids that were never defined.
  Statement finish(bool legacy);

 private:
  void resolve(Statement& s, Problems& problems) const;
  void resolve(Attribute& a, Problems& problems) const;
  std::string number_of(const std::string& id, const Origin& origin, Problems& problems) const;

  Origin origin_;
  std::map<std::string, Statement> sections_;
  std::vector<Statement> materials_, cracks_;
  std::map<std::string, std::size_t> ids_;  ///< -> number, from 1
  std::string description_;
  bool inside_ = false;          ///< of an XML file
  std::size_t surrounding_ = 0;  ///< materials of that file
};

inline void attribute(Statement& s, const std::string& name, const std::string& text, const Origin& origin) {
  s.attributes.push_back({name, text, origin});
}

}  // namespace tribo::script
