// SPDX-License-Identifier: MIT
/// <Stage>: what changes within a run. The model of a stage is built from the statements with its changes.

#include "contact/contact_law.hpp"
#include "contact/joint_law.hpp"
#include "input/builder.hpp"
#include "input/stage_edits.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <typeinfo>

namespace tribo {
namespace {

std::vector<const Statement*> stages_of(const Statement& root) {
  std::vector<const Statement*> out;
  for (const Statement& s : root.children)
    if (s.name == "Stage") out.push_back(&s);
  return out;
}

bool has_loads(const Model& m) { return !m.particle_conditions.empty() || m.body_force.acts_on_particles(); }

bool any_memory(const ContactSpec& c) {
  return (c.default_law && c.default_law->has_memory()) ||
         std::any_of(c.pair_laws.begin(), c.pair_laws.end(), [](const auto& p) { return p.second->has_memory(); });
}

bool same_type(const JointLaw& a, const JointLaw& b) { return typeid(a) == typeid(b); }

/// Compares the model of a stage with the one before. All models must keep the same quantities of particles and joints.
class Comparison {
 public:
  Comparison(const Model& before, const Model& now, const Statement& stage, Problems& problems)
      : before_(before), now_(now), stage_(stage), problems_(problems) {}

  void run() {
    for (std::size_t k = 0; k < now_.materials.size(); ++k) material(before_.materials[k], now_.materials[k]);
    must(before_.heat.kept == now_.heat.kept && before_.heat.expansion == now_.heat.expansion,
         "particles cannot begin or cease to have a temperature in a stage");
    contact();
  }

 private:
  void must(bool holds, const std::string& message) {
    if (!holds) problems_.add(stage_.origin, message);
  }

  void material(const MaterialSpec& before, const MaterialSpec& now) {
    if (!before.law || !now.law) return;
    const auto names = [](const Material& law) {
      std::vector<std::string> out;
      for (const auto& h : law.history()) out.push_back(h.name);
      return out;
    };
    const bool same = names(*before.law) == names(*now.law) &&
                      before.law->needs_deformation() == now.law->needs_deformation() &&
                      before.law->density() == now.law->density() &&
                      before.law->dissipation_index() == now.law->dissipation_index() &&
                      before.sets_velocity == now.sets_velocity && before.mirrored == now.mirrored;
    must(same, "with these properties '" + now.name + "' keeps other quantities than before, which a stage cannot add");
  }

  void contact() {
    const ContactSpec &a = before_.contact, &b = now_.contact;
    for (const auto& [pair, joint] : b.joints) {
      const auto old = a.joints.find(pair);
      must(old != a.joints.end() && old->second.materials == joint.materials && same_type(*old->second.law, *joint.law),
           "joints between '" + name(pair.first) + "' and '" + name(pair.second) +
               "' begin with the run; a stage can change the properties of their law, not its type");
    }
    for (const auto& [pair, joint] : a.joints)
      must(b.joints.contains(pair),
           "joints between '" + name(pair.first) + "' and '" + name(pair.second) + "' cannot be removed by a stage");
    if (!b.active) return;
    const auto count = static_cast<int>(now_.materials.size());
    for (int i = 0; i < count; ++i)
      for (int j = i; j < count; ++j) pair(i, j);
    for (std::size_t k = 0; k < now_.materials.size(); ++k) {
      const auto &before = before_.materials[k], &now = now_.materials[k];
      must(!now.contact || !now.contact->interface() || text(before) == text(now),
           "imperfect interfaces such as '" + now.name + "' cannot change in a stage");
    }
  }

  void pair(int i, int j) {
    const ContactLaw *a = before_.contact.law(i, j), *b = now_.contact.law(i, j);
    const auto interface = [](const ContactLaw* law) { return law && law->interface() != nullptr; };
    must(interface(a) == interface(b), "the law of '" + name(i) + "' and '" + name(j) +
                                           "' cannot become or cease to be an imperfect interface in a stage");
  }

  std::string name(int k) const { return now_.materials[static_cast<std::size_t>(k)].name; }
  static std::string text(const MaterialSpec& m) {
    std::string out;
    for (const Statement& s : m.statement.children) out += s.name + "=" + s.text + ";";
    return out;
  }

  const Model &before_, &now_;
  const Statement& stage_;
  Problems& problems_;
};

// The model of a stage, built from the changed tree.
std::shared_ptr<Model> model_of_stage(const Statement& tree, const Statement& stage,
                                      const std::filesystem::path& folder, const std::vector<std::size_t>& order,
                                      const Model& first, const Model& former) {
  auto out = std::make_shared<Model>(Builder(tree, folder, order).build());
  Problems problems;
  Comparison(former, *out, stage, problems).run();
  problems.raise();
  out->placements = first.placements;
  out->stage = first.stage;
  out->stage.number = former.stage.number + 1;
  const Statement* loads = stage.child("ParticleBCs");
  out->stage.kept = !loads ? out->particle_conditions.size()
                    : yes(loads->attribute("add") ? loads->attribute("add")->text : "no")
                        ? former.particle_conditions.size()
                        : 0;
  out->stage.conditions = stage.child("GridBCs") != nullptr;
  return out;
}

template <class T>
void add_new(std::vector<T>& to, const std::vector<T>& from) {
  for (const T& x : from)
    if (std::find(to.begin(), to.end(), x) == to.end()) to.push_back(x);
}

}  // namespace

void Builder::reactions() {
  for (const Statement& s : root_.children)
    if (s.name == "When") reaction(s);
  static constexpr std::size_t most = 60;  // bits of a number
  must(model_.reactions.size() <= most, root_.origin, "at most " + std::to_string(most) + " reactions");
}

void Builder::reaction(const Statement& s) {
  using What = Reaction::What;
  Reaction r;
  r.origin = s.origin;
  const int conditions = has(s, "event") + has(s, "history") + has(s, "ratio");
  must(conditions == 1, s.origin, "<When> needs one of 'event', 'history' and 'ratio'");
  if (has(s, "event")) {
    r.what = What::bond_break, r.text = "a bond broke";
    must(
        std::any_of(model_.materials.begin(), model_.materials.end(), [](const auto& m) { return m.joint != nullptr; }),
        s.origin, "without a joint law no bond can break");
  } else if (has(s, "ratio")) {
    r.what = What::ratio, r.value = this->number(s, "ratio", Dimension::none);
    r.text = "the ratio of unbalanced forces fell below " + word(s, "ratio");
    must(r.value > 0, s.origin, "'ratio' must be positive");
  } else if (const Attribute* name = s.attribute("history")) {
    must(has(s, "above") != has(s, "below"), s.origin, "'history' needs either 'above' or 'below'");
    r.what = has(s, "above") ? What::above : What::below;
    r.value = this->number(s, has(s, "above") ? "above" : "below", Dimension::none);
    r.text =
        "'" + name->text + "' was " + (has(s, "above") ? "above " + word(s, "above") : "below " + word(s, "below"));
    std::vector<std::string> columns;
    for (const auto& q : model_.output.history) columns.push_back(q.column);
    if (model_.blocks)
      for (const auto& q : model_.blocks->histories) columns.push_back(q.column);
    const auto found = std::find(columns.begin(), columns.end(), name->text);
    must(found != columns.end(), name->origin,
         "history.csv has no column '" + name->text + "'" + did_you_mean(name->text, columns) +
             (columns.empty() ? "; <GlobalArchive> adds one" : "; columns: " + join(columns)));
    r.history = static_cast<std::size_t>(found - columns.begin());
  }
  must(!s.children.empty(), s.origin, "<When> does nothing: it needs <Stop/>, <Frame/>, <Checkpoint/> or <NextStage/>");
  for (const Statement& child : s.children) {
    using Effect = Reaction::Effect;
    r.effect = child.name == "Stop"         ? Effect::stop
               : child.name == "Frame"      ? Effect::frame
               : child.name == "Checkpoint" ? Effect::checkpoint
                                            : Effect::next_stage;
    model_.reactions.push_back(r);
  }
}

void Builder::stages() {
  reactions();
  const auto all = stages_of(root_);
  model_.stage.count = static_cast<int>(all.size());
  double last = 0.0;
  for (const Statement* s : all) {
    StageSpec spec = stage(*s, static_cast<int>(model_.stages.size()) + 1);
    const Origin& at = s->attribute("at") ? s->attribute("at")->origin : s->origin;
    must(spec.at > 0, at, "a stage begins after the start of the run; what holds from the start belongs outside of it");
    must(spec.at < model_.time.end, at, "this stage would begin when the run has ended");
    must(model_.stages.empty() || spec.at > last, at, "stages must be in the order of their times");
    last = spec.at;
    model_.stages.push_back(std::move(spec));
  }
  if (!all.empty()) model_.time.until = model_.stages.front().at;
}

StageSpec Builder::stage(const Statement& s, int number) {
  StageSpec spec;
  spec.at = this->number(s, "at", Dimension::time);
  spec.name = word(s, "name"), spec.origin = s.origin;
  spec.changes = phrases_of(s, root_, material_order(root_));
  must(!s.children.empty(), s.origin, "this stage changes nothing");
  // Bodies are read as those of the start are, into a list of their own.
  std::vector<Piece> present = std::exchange(model_.pieces, {});
  for (const Statement& child : s.children) {
    const bool places = child.name == "Body" || child.name == "Hole" || child.name == "BMP";
    const bool of_particles = child.name == "Excavate" || child.name == "Stress";
    const bool acts = of_particles || child.name == "Bond" || child.name == "Unbond";
    must(!(places || of_particles) || !of_blocks(), child.origin,
         "<" + child.name + "> needs a grid and particles; rigid blocks are neither placed nor removed by a stage");
    if (of_blocks() && (places || of_particles)) continue;
    if (child.name == "BMP")
      picture(child);
    else if (places)
      body(child, child.name == "Hole");
    if (acts) spec.actions.push_back(stage_action(child));
  }
  if (!model_.pieces.empty()) model_.placements.push_back({number, std::exchange(model_.pieces, {})});
  model_.pieces = std::move(present);
  return spec;
}

StageAction Builder::stage_action(const Statement& s) {
  StageAction action;
  using Kind = StageAction::Kind;
  static const std::map<std::string, Kind> kinds{
      {"Excavate", Kind::excavate}, {"Stress", Kind::stress}, {"Bond", Kind::bond}, {"Unbond", Kind::unbond}};
  action.kind = kinds.at(s.name);
  action.origin = s.origin;
  if (has(s, "mat") || has(s, "matname")) action.material = material(s);
  std::vector<RegionPtr> shapes;
  for (const Statement& child : s.children) shapes.push_back(shape(child));
  const bool of_joints = action.kind == Kind::bond || action.kind == Kind::unbond;
  if (action.kind == Kind::stress) stress_action(s, action);
  if (of_joints) {
    action.joints = joint_criteria(s, model_.blocks.get());
    action.joints->later = true;
    if (has(s, "lawname") || has(s, "law")) action.law = law_named(s);
  }
  const bool chooses = of_joints && !s.attributes.empty();
  must(!shapes.empty() || chooses, s.origin,
       "<" + s.name + "> has no shape" + (of_joints ? " and no other criterion" : ""));
  RegionPtr where;
  if (!shapes.empty()) where = shapes.size() == 1 ? shapes.front() : unite(std::move(shapes));
  if (of_joints)
    action.joints->where = where;
  else
    action.where = where ? where : rectangle(0, 0, 0, 0);
  return action;
}

void Builder::stress_action(const Statement& s, StageAction& action) {
  action.stress = stress_field(s);
  action.adds = yes(word(s, "add"));
  must(action.stress.given() || has(s, "file"), s.origin, "<Stress> needs a component, such as yy, or a 'file'");
  const std::size_t material = static_cast<std::size_t>(std::max(action.material, 0));
  if (action.material < 0 || material >= model_.materials.size()) return;
  const MaterialSpec& spec = model_.materials[material];
  must(spec.law && keeps_stress(*spec.law), s.origin,
       "'" + spec.name + "' keeps no given stress: its stress is a function of the deformation");
}

// The joint law that 'lawname' or 'law' names; -1 after an error.
int Builder::law_named(const Statement& s) {
  const MaterialSpec* found = named_law(s);
  if (!found) return -1;
  must(found->joint != nullptr, s.origin, "'" + found->name + "' is no joint law");
  return static_cast<int>(found - model_.materials.data());
}

Model build_with_stages(const Statement& root, const std::filesystem::path& folder) {
  Model first = Builder(root, folder).build();
  const auto stages = stages_of(root);
  if (stages.empty()) return first;
  const auto order = material_order(root);
  Statement tree = root;
  std::erase_if(tree.children, [](const Statement& s) { return s.name == "Stage"; });
  std::vector<std::shared_ptr<Model>> models;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    Problems problems;
    apply_stage(tree, *stages[k], order, problems);
    problems.raise();
    models.push_back(model_of_stage(tree, *stages[k], folder, order, first, k == 0 ? first : *models.back()));
    models.back()->time.until = k + 1 < stages.size() ? first.stages[k + 1].at : 0.0;
    add_new(first.warnings, models.back()->warnings), add_new(first.data_files, models.back()->data_files);
  }
  first.stage.loads = has_loads(first);
  bool damps = first.damps_particles(), prescribes = !first.node_conditions.empty();
  first.contact.keeps_memory = any_memory(first.contact);
  for (const auto& m : models) {
    first.stage.loads |= has_loads(*m);
    damps |= m->damps_particles(), prescribes |= !m->node_conditions.empty();
    first.contact.keeps_memory |= any_memory(m->contact);
  }
  first.stage.damps_prescribed = damps && prescribes;
  for (std::size_t k = 0; k < models.size(); ++k) {
    models[k]->stage.damps_prescribed = first.stage.damps_prescribed;
    models[k]->stage.loads = first.stage.loads, models[k]->contact.keeps_memory = first.contact.keeps_memory;
    first.stages[k].model = std::move(models[k]);
  }
  return first;
}

}  // namespace tribo
