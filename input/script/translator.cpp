// SPDX-License-Identifier: MIT
#include "input/script/translator.hpp"

#include "base/text.hpp"
#include "input/script/commands.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace tribo::script {

// Functions that translate a command, by its name in lower case.
auto Translator::actions() -> const std::map<std::string, Action>& {
  using A = Translator;
  static const std::map<std::string, Action> all{{"version", &A::version},
                                                 {"title", &A::title},
                                                 {"name", &A::user},
                                                 {"comment", &A::comment},
                                                 {"header", &A::header},
                                                 {"analysis", &A::analysis},
                                                 {"element", &A::element_type},
                                                 {"consistentunits", &A::units},
                                                 {"mpmmethod", &A::method},
                                                 {"timestep", &A::time_step},
                                                 {"transfer", &A::transfer},
                                                 {"maximumtime", &A::plain},
                                                 {"cflfactor", &A::courant},
                                                 {"archivetime", &A::archive_time},
                                                 {"globalarchivetime", &A::plain},
                                                 {"archive", &A::archive},
                                                 {"archiveunique", &A::archive},
                                                 {"globalarchive", &A::global_archive},
                                                 {"toarchive", &A::to_archive},
                                                 {"ptsperelement", &A::points_per_element},
                                                 {"damping", &A::rate},
                                                 {"pdamping", &A::rate},
                                                 {"feedbackdamping", &A::feedback},
                                                 {"pfeedbackdamping", &A::feedback},
                                                 {"leavelimit", &A::plain},
                                                 {"extrapolaterigid", &A::extrapolate_rigid},
                                                 {"cpdircrit", &A::plain},
                                                 {"stressfreetemp", &A::plain},
                                                 {"processors", &A::processors},
                                                 {"multimaterialmpm", &A::multimaterial},
                                                 {"multimaterialmode", &A::old_multimaterial},
                                                 {"contactmm", &A::contact_law},
                                                 {"frictionmm", &A::old_friction},
                                                 {"imperfectinterfacemm", &A::old_friction},
                                                 {"friction", &A::old_friction},
                                                 {"imperfectinterface", &A::old_friction},
                                                 {"contactposition", &A::contact_position},
                                                 {"gridhoriz", &A::grid_cells},
                                                 {"gridvert", &A::grid_cells},
                                                 {"griddepth", &A::grid_cells},
                                                 {"gridedge", &A::grid_edge},
                                                 {"gridrect", &A::grid_box},
                                                 {"gridthickness", &A::grid_thickness},
                                                 {"gravity", &A::gravity},
                                                 {"conduction", &A::conduction},
                                                 {"customtask", &A::task},
                                                 {"parameter", &A::parameter},
                                                 {"xmldata", &A::xml_data},
                                                 {"entity", &A::entity},
                                                 {"material", &A::material},
                                                 {"region", &A::region},
                                                 {"hole", &A::hole},
                                                 {"bmpregion", &A::picture},
                                                 {"intensity", &A::intensity},
                                                 {"origin", &A::picture_origin},
                                                 {"transform", &A::transform},
                                                 {"rotate", &A::rotate},
                                                 {"vel0x", &A::initial_velocity},
                                                 {"vel0y", &A::initial_velocity},
                                                 {"vel0z", &A::initial_velocity},
                                                 {"initialstress", &A::initial_stress},
                                                 {"rect", &A::shape},
                                                 {"oval", &A::shape},
                                                 {"line", &A::shape},
                                                 {"arc", &A::shape},
                                                 {"box", &A::shape},
                                                 {"sphere", &A::shape},
                                                 {"cylinder", &A::shape},
                                                 {"torus", &A::shape},
                                                 {"surface", &A::shape_of_file},
                                                 {"terrain", &A::shape_of_file},
                                                 {"particletable", &A::particle_table},
                                                 {"polypt", &A::polygon_point},
                                                 {"gridbc", &A::conditions},
                                                 {"moveline", &A::old_selector},
                                                 {"movearc", &A::old_selector},
                                                 {"movebox", &A::old_selector},
                                                 {"loadline", &A::old_selector},
                                                 {"loadarc", &A::old_selector},
                                                 {"loadrect", &A::old_selector},
                                                 {"loadbox", &A::old_selector},
                                                 {"particlebc", &A::conditions},
                                                 {"velocity", &A::velocity},
                                                 {"temperature", &A::temperature},
                                                 {"load", &A::load},
                                                 {"loadtype", &A::load_type},
                                                 {"traction", &A::traction},
                                                 {"heatflux", &A::heat_flux},
                                                 {"boundaryid", &A::boundary_id},
                                                 {"newcrack", &A::new_crack},
                                                 {"growcrack", &A::grow_crack},
                                                 {"growcrackline", &A::grow_crack_line},
                                                 {"growcrackarc", &A::grow_crack_arc},
                                                 {"contactcracks", &A::contact_of_cracks},
                                                 {"contactpositioncracks", &A::contact_position},
                                                 {"crackinterface", &A::crack_interface},
                                                 {"cracktractionprop", &A::crack_traction},
                                                 {"crackthickness", &A::crack_thickness},
                                                 {"moveplane", &A::move_plane},
                                                 {"propagate", &A::propagate},
                                                 {"propagatelength", &A::propagate_length},
                                                 {"jcontour", &A::j_contour},
                                                 {"stage", &A::stage},
                                                 {"endstage", &A::end_stage},
                                                 {"when", &A::when},
                                                 {"excavate", &A::action},
                                                 {"stress", &A::action},
                                                 {"bond", &A::action},
                                                 {"unbond", &A::action},
                                                 {"endexcavate", &A::end_block},
                                                 {"endstress", &A::end_block},
                                                 {"endbond", &A::end_block},
                                                 {"endunbond", &A::end_block},
                                                 {"done", &A::end_block},
                                                 {"endregion", &A::end_block},
                                                 {"endhole", &A::end_block},
                                                 {"endgridbc", &A::end_block},
                                                 {"endparticlebc", &A::end_block},
                                                 {"endmoveline", &A::end_block},
                                                 {"endmovearc", &A::end_block},
                                                 {"endmovebox", &A::end_block},
                                                 {"endloadline", &A::end_block},
                                                 {"endloadarc", &A::end_block},
                                                 {"endloadrect", &A::end_block},
                                                 {"endloadbox", &A::end_block},
                                                 {"blocks", &A::blocks},
                                                 {"endblocks", &A::end_block}};
  return all;
}

namespace {

const CommandInfo* find_command(const std::string& word) {
  static const auto by_word = [] {
    std::unordered_map<std::string, const CommandInfo*> out;
    for (const CommandInfo& info : commands()) out.emplace(lower(info.name), &info);
    return out;
  }();
  const auto found = by_word.find(word);
  return found == by_word.end() ? nullptr : found->second;
}

}  // namespace

namespace {

bool opens_block(const std::string& word) {
  static const std::set<std::string> all{"material", "region",   "hole",    "bmpregion", "gridbc",  "particlebc",
                                         "moveline", "movearc",  "movebox", "loadline",  "loadarc", "loadrect",
                                         "loadbox",  "excavate", "stress",  "bond",      "unbond",  "blocks"};
  return all.count(word) > 0;
}

bool closes_block(const std::string& word) {
  static const std::set<std::string> all{"done",        "endregion",  "endhole",     "endgridbc",   "endparticlebc",
                                         "endmoveline", "endmovearc", "endmovebox",  "endloadline", "endloadarc",
                                         "endloadrect", "endloadbox", "endexcavate", "endstress",   "endbond",
                                         "endunbond",   "endblocks"};
  return all.count(word) > 0;
}

// The known command that an unknown word resembles, in lower case; empty if there is none.
std::string resembled(const std::string& word) {
  std::vector<std::string> names;
  for (const CommandInfo& info : commands()) names.emplace_back(info.name);
  return lower(similar_word(word, names));
}

}  // namespace

void Translator::take(const Command& c) {
  const std::string word = lower(c.node.word);
  if (in_lost_block_) {
    in_lost_block_ = !closes_block(word) && !opens_block(word);
    if (!opens_block(word)) return;
  }
  try {
    translate(c, word);
  } catch (const InputError&) {
    limit_damage(c, find_command(word) ? word : resembled(c.node.word));
    throw;
  }
}

// After an error in a command that begins or ends a block, prevents problems of the commands around it that are only
// its consequences: what belongs to a block that did not begin is skipped, and a block whose end has an error is
// closed.
void Translator::limit_damage(const Command& c, const std::string& meant) {
  if (opens_block(meant)) {
    const bool began = open_ != Open::nothing && opened_at_.line == c.origin().line;
    if (began) return;
    store_block();
    in_lost_block_ = true;
    lost_a_material_ |= meant == "material";
  } else if (closes_block(meant)) {
    store_block();
  } else if (meant == "analysis" && analysis_ == 0) {
    analysis_ = 10;
  }
}

void Translator::translate(const Command& c, const std::string& word) {
  if (word != "polypt") close_polygon();
  const CommandInfo* info = find_command(word);
  static const std::set<std::string> also_properties{"temperature", "pdamping",           "velocity", "load", "origin",
                                                     "rotate",      "imperfectinterface", "friction", "bond", "unbond"};
  const bool end_of_material = !info && c.size() == 0 && resembled(c.node.word) == "done";
  const auto action = actions().find(word);  // none for an unknown command, and for a line of Blocks
  const bool property_or_unknown = action == actions().end() || also_properties.count(word);
  if (open_ == Open::material && property_or_unknown && !end_of_material) return property(c);
  if (!info) return refused(c);
  const ElementSpec* line = open_ == Open::blocks ? find_element_of_blocks(word) : nullptr;
  if (line) return line_of_blocks(c, *line);
  if (action == actions().end())
    throw InputError(c.origin(), "'" + c.node.word + "' belongs into 'Blocks ... EndBlocks'");
  if (c.size() < info->least || c.size() > info->most)
    throw InputError(c.origin(), "'" + c.node.word + "' takes " + std::to_string(info->least) +
                                     (info->most > info->least ? " to " + std::to_string(info->most) : "") +
                                     " arguments, not " + std::to_string(c.size()) +
                                     (info->arguments.empty() ? "" : ": " + std::string(info->arguments)));
  (this->*action->second)(c);
}

// Reports commands of NairnFEAMPM that Tribo does not support, and unknown commands.
void Translator::refused(const Command& c) {
  const std::string word = lower(c.node.word);
  std::vector<std::string> known;
  for (const RefusedCommand& r : refused_commands()) {
    if (lower(r.name) != word) continue;
    const bool off = (word == "diffusion" || word == "poroelasticity") && c.size() > 0 && lower(c.text(0)) == "no";
    if (off) return;
    throw InputError(c.origin(), "Tribo does not read '" + c.node.word + "': " + std::string(r.reason));
  }
  for (const CommandInfo& info : commands()) known.emplace_back(info.name);
  for (const CommandInfo& info : language()) known.emplace_back(info.name);
  const bool comment = word.starts_with('#') || word.starts_with("//");
  throw InputError(c.origin(), "there is no command '" + c.node.word + "'" + did_you_mean(c.node.word, known) +
                                   (comment ? "; a comment begins with '!'" : ""));
}

void Translator::open(Open block, const Command& c) {
  if (open_ != Open::nothing)
    throw InputError(c.origin(), "'" + c.node.word + "' inside '" + opened_by_ + "' from " + opened_at_.text());
  open_ = block, opened_by_ = c.node.word, opened_at_ = c.origin();
}

void Translator::end_block(const Command& c) {
  const std::string word = lower(c.node.word);
  static const std::map<std::string, std::vector<Open>> closes{{"done", {Open::material}},
                                                               {"endregion", {Open::region, Open::picture}},
                                                               {"endhole", {Open::hole}},
                                                               {"endexcavate", {Open::action}},
                                                               {"endstress", {Open::action}},
                                                               {"endbond", {Open::action}},
                                                               {"endunbond", {Open::action}},
                                                               {"endgridbc", {Open::grid}},
                                                               {"endparticlebc", {Open::particles}},
                                                               {"endmoveline", {Open::grid}},
                                                               {"endmovearc", {Open::grid}},
                                                               {"endmovebox", {Open::grid}},
                                                               {"endloadline", {Open::particles}},
                                                               {"endloadarc", {Open::particles}},
                                                               {"endloadrect", {Open::particles}},
                                                               {"endloadbox", {Open::particles}},
                                                               {"endblocks", {Open::blocks}}};
  const auto& fitting = closes.at(word);
  if (std::find(fitting.begin(), fitting.end(), open_) == fitting.end())
    throw InputError(c.origin(), "'" + c.node.word + "' closes nothing" +
                                     (open_ == Open::nothing ? "" : "; '" + opened_by_ + "' is open"));
  store_block();
}

// Adds the open block to its section.
void Translator::store_block() {
  if (open_ == Open::region || open_ == Open::hole || open_ == Open::picture || open_ == Open::action)
    document_.section("MaterialPoints", opened_at_).children.push_back(std::move(block_));
  if (open_ == Open::blocks) store_blocks();
  if (open_ == Open::grid) document_.section("GridBCs", opened_at_).children.push_back(std::move(block_));
  if (open_ == Open::particles) document_.section("ParticleBCs", opened_at_).children.push_back(std::move(block_));
  block_ = {}, path_.clear();
  open_ = Open::nothing;
}

int Translator::dimension(const Command& c) const {
  if (analysis_ == 0) throw InputError(c.origin(), "'" + c.node.word + "' needs a preceding 'Analysis'");
  return analysis_ == 12 ? 3 : 2;
}

void Translator::surround(int analysis, const std::vector<std::string>& materials, bool consistent) {
  analysis_ = analysis, consistent_ = consistent;
  document_.surround(materials);
}

void Translator::conclude(Problems& problems) {
  close_polygon();
  if (open_ != Open::nothing) problems.add(opened_at_, "this '" + opened_by_ + "' is never closed");
  store_block();
  if (stage_) {
    problems.add(*stage_, "this 'Stage' is never closed by 'EndStage'");
    document_.end_stage();
  }
  Problems undefined;
  document_.resolve_references(undefined);
  if (!lost_a_material_) problems.add(undefined);
  if (!problems.empty())
    for (const Statement& m : document_.materials()) unknown_properties(m, problems);
}

std::vector<Statement> Translator::finish_sections(Problems& problems) {
  conclude(problems);
  return document_.finish_sections(!consistent_);
}

Statement Translator::finish(Problems& problems) {
  if (analysis_ == 0 && problems.empty()) problems.add(origin_, "the script has no 'Analysis'");
  conclude(problems);
  return document_.finish(!consistent_);
}

}  // namespace tribo::script
