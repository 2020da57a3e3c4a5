#include "input/script/translator.hpp"

#include "input/script/text_functions.hpp"

#include <algorithm>

namespace tribo::script {

// A command in lower case, what does it, and how many arguments it takes.
auto Translator::table() -> const std::map<std::string, Entry>& {
  using A = Translator;
  static const std::map<std::string, Entry> all{{"title", {&A::title, 1, 1}},
                                                {"name", {&A::user, 1, 1}},
                                                {"comment", {&A::comment, 1, 99}},
                                                {"header", {&A::header, 0, 0}},
                                                {"analysis", {&A::analysis, 1, 2}},
                                                {"consistentunits", {&A::units, 0, 3}},
                                                {"mpmmethod", {&A::method, 1, 2}},
                                                {"timestep", {&A::time_step, 1, 3}},
                                                {"maximumtime", {&A::plain, 1, 1}},
                                                {"cflfactor", {&A::courant, 1, 2}},
                                                {"archivetime", {&A::archive_time, 1, 3}},
                                                {"globalarchivetime", {&A::plain, 1, 1}},
                                                {"archive", {&A::archive, 1, 1}},
                                                {"archiveunique", {&A::archive, 1, 1}},
                                                {"globalarchive", {&A::global_archive, 1, 4}},
                                                {"toarchive", {&A::to_archive, 1, 99}},
                                                {"ptsperelement", {&A::points_per_element, 1, 1}},
                                                {"damping", {&A::plain, 1, 1}},
                                                {"pdamping", {&A::plain, 1, 1}},
                                                {"feedbackdamping", {&A::feedback, 1, 3}},
                                                {"pfeedbackdamping", {&A::feedback, 1, 3}},
                                                {"leavelimit", {&A::plain, 1, 1}},
                                                {"deletelimit", {&A::plain, 1, 1}},
                                                {"extrapolaterigid", {&A::plain, 0, 1}},
                                                {"exacttractions", {&A::plain, 0, 1}},
                                                {"cpdircrit", {&A::plain, 1, 1}},
                                                {"stressfreetemp", {&A::plain, 1, 1}},
                                                {"processors", {&A::processors, 1, 1}},
                                                {"multimaterialmpm", {&A::multimaterial, 0, 4}},
                                                {"multimaterialmode", {&A::old_multimaterial, 0, 5}},
                                                {"contactmm", {&A::contact_law, 1, 1}},
                                                {"frictionmm", {&A::old_friction, 1, 1}},
                                                {"imperfectinterfacemm", {&A::old_friction, 2, 3}},
                                                {"contactposition", {&A::contact_position, 1, 1}},
                                                {"gridhoriz", {&A::grid_cells, 1, 4}},
                                                {"gridvert", {&A::grid_cells, 1, 4}},
                                                {"griddepth", {&A::grid_cells, 1, 4}},
                                                {"gridrect", {&A::grid_box, 4, 6}},
                                                {"gridthickness", {&A::grid_thickness, 1, 1}},
                                                {"gravity", {&A::gravity, 0, 3}},
                                                {"conduction", {&A::conduction, 1, 2}},
                                                {"customtask", {&A::task, 1, 1}},
                                                {"parameter", {&A::parameter, 1, 2}},
                                                {"xmldata", {&A::xml_data, 0, 2}},
                                                {"entity", {&A::entity, 2, 2}},
                                                {"material", {&A::material, 3, 3}},
                                                {"region", {&A::region, 3, 40}},
                                                {"hole", {&A::hole, 0, 0}},
                                                {"bmpregion", {&A::picture, 2, 4}},
                                                {"intensity", {&A::intensity, 3, 10}},
                                                {"origin", {&A::picture_origin, 2, 2}},
                                                {"transform", {&A::transform, 5, 9}},
                                                {"rotate", {&A::rotate, 2, 6}},
                                                {"vel0x", {&A::initial_velocity, 1, 1}},
                                                {"vel0y", {&A::initial_velocity, 1, 1}},
                                                {"vel0z", {&A::initial_velocity, 1, 1}},
                                                {"rect", {&A::shape, 4, 6}},
                                                {"oval", {&A::shape, 4, 6}},
                                                {"line", {&A::shape, 4, 7}},
                                                {"arc", {&A::shape, 6, 7}},
                                                {"box", {&A::shape, 6, 6}},
                                                {"sphere", {&A::shape, 6, 6}},
                                                {"cylinder", {&A::shape, 7, 8}},
                                                {"torus", {&A::shape, 7, 8}},
                                                {"polypt", {&A::polygon_point, 0, 2}},
                                                {"gridbc", {&A::conditions, 0, 0}},
                                                {"particlebc", {&A::conditions, 0, 0}},
                                                {"velocity", {&A::velocity, 3, 6}},
                                                {"temperature", {&A::temperature, 2, 3}},
                                                {"load", {&A::load, 3, 4}},
                                                {"loadtype", {&A::load_type, 1, 1}},
                                                {"traction", {&A::traction, 4, 5}},
                                                {"heatflux", {&A::heat_flux, 4, 5}},
                                                {"boundaryid", {&A::boundary_id, 0, 1}},
                                                {"done", {&A::end_block, 0, 0}},
                                                {"endregion", {&A::end_block, 0, 0}},
                                                {"endhole", {&A::end_block, 0, 0}},
                                                {"endgridbc", {&A::end_block, 0, 0}},
                                                {"endparticlebc", {&A::end_block, 0, 0}}};
  return all;
}

void Translator::take(const Command& c) {
  const std::string word = lower(c.node.word);
  if (word != "polypt") close_polygon();
  const auto found = table().find(word);
  static const std::set<std::string> also_properties{"temperature", "pdamping", "velocity", "load", "origin", "rotate"};
  if (open_ == Open::material && (found == table().end() || also_properties.count(word))) return property(c);
  if (found == table().end()) return refused(c);
  const Entry& entry = found->second;
  if (c.size() < entry.least || c.size() > entry.most)
    throw InputError(c.origin(), "'" + c.node.word + "' takes " + std::to_string(entry.least) +
                                     (entry.most > entry.least ? " to " + std::to_string(entry.most) : "") +
                                     " arguments, not " + std::to_string(c.size()));
  (this->*entry.action)(c);
}

// What the language knows and Tribo does not do, and what nobody knows.
void Translator::refused(const Command& c) {
  struct Refused {
    const char* commands;
    const char* why;
  };
  static constexpr Refused all[] = {
      {"newcrack growcrack growcrackline growcrackarc crackthickness cracktractionprop propagate altpropagate "
       "propagatelength jcontour moveplane contactcracks contactpositioncracks crackinterface",
       "cracks are not built"},
      {"friction imperfectinterface",
       "it sets the contact of cracks, which are not built; for materials use ContactMM"},
      {"diffusion concentration concentrationflux", "diffusion is not built"},
      {"poroelasticity porepressure porepressureflux", "pore pressure is not built"},
      {"damage phasefield", "damage that is given at the start is not built"},
      {"angularmom0", "angular momentum that is given at the start is not built; use vel0X, vel0Y, vel0Z"},
      {"shell", "its meaning is not documented well enough; use a Cylinder with a Cut Cylinder"},
      {"fill", "particle reservoirs are not built"},
      {"tartanaoi tartanborder", "grids with unequal cells are not built"},
      {"moveline movearc movebox endmoveline endmovearc endmovebox", "it is obsolete; use GridBC ... EndGridBC"},
      {"loadline loadarc loadbox loadrect endloadline endloadarc endloadbox endloadrect",
       "it is obsolete; use ParticleBC ... EndParticleBC"},
      {"element keypoint path paths area fixline selectbc resequence",
       "it belongs to finite element analysis, which Tribo does not do"},
      {"script open createlist createdictionary userinput", "it controls the windows of another program"}};
  const std::string word = lower(c.node.word);
  std::vector<std::string> known;
  for (const Refused& r : all) {
    const std::string commands = std::string(" ") + r.commands + " ";
    if (commands.find(" " + word + " ") != std::string::npos)
      throw InputError(c.origin(), "Tribo does not read '" + c.node.word + "': " + r.why);
  }
  for (const auto& [name, entry] : table()) known.push_back(name);
  throw InputError(c.origin(), "there is no command '" + c.node.word + "'" + did_you_mean(word, known));
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
                                                               {"endgridbc", {Open::grid}},
                                                               {"endparticlebc", {Open::particles}}};
  const auto& fitting = closes.at(word);
  if (std::find(fitting.begin(), fitting.end(), open_) == fitting.end())
    throw InputError(c.origin(), "'" + c.node.word + "' closes nothing" +
                                     (open_ == Open::nothing ? "" : "; '" + opened_by_ + "' is open"));
  if (open_ == Open::region || open_ == Open::hole || open_ == Open::picture)
    document_.section("MaterialPoints", opened_at_).children.push_back(std::move(block_));
  if (open_ == Open::grid) document_.section("GridBCs", opened_at_).children.push_back(std::move(block_));
  if (open_ == Open::particles) document_.section("ParticleBCs", opened_at_).children.push_back(std::move(block_));
  block_ = {}, path_.clear();
  open_ = Open::nothing;
}

int Translator::dimension(const Command& c) const {
  if (analysis_ == 0)
    throw InputError(c.origin(), "'" + c.node.word + "' needs to know the 'Analysis', which must come before");
  return analysis_ == 12 ? 3 : 2;
}

void Translator::surround(int analysis, const std::vector<std::string>& materials, bool consistent) {
  analysis_ = analysis, consistent_ = consistent;
  document_.surround(materials);
}

std::vector<Statement> Translator::finish_sections() {
  close_polygon();
  if (open_ != Open::nothing) throw InputError(opened_at_, "this '" + opened_by_ + "' is never closed");
  return document_.finish_sections(!consistent_);
}

Statement Translator::finish() {
  close_polygon();
  if (open_ != Open::nothing) throw InputError(opened_at_, "this '" + opened_by_ + "' is never closed");
  if (analysis_ == 0) throw InputError(origin_, "the script has no 'Analysis'");
  return document_.finish(!consistent_);
}

}  // namespace tribo::script
