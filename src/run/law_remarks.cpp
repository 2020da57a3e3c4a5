// SPDX-License-Identifier: MIT
#include "run/law_remarks.hpp"

#include "contact/contact_law.hpp"

#include <set>

namespace tribo {
namespace {

// Adds the laws that act in a stage of the run.
void add_laws(const Model& stage, std::set<const ContactLaw*>& used) {
  if (stage.contact.active) used.insert(stage.contact.default_law.get());
  for (const auto& [pair, law] : stage.contact.pair_laws) used.insert(law.get());
  for (const CrackSpec& crack : stage.cracks) used.insert(crack.law.get());
}

}  // namespace

std::vector<std::string> remarks_on_contact_laws(const Model& model) {
  std::set<const ContactLaw*> used;
  add_laws(model, used);
  for (const StageSpec& stage : model.stages) add_laws(*stage.model, used);
  std::vector<std::string> out;
  for (const MaterialSpec& law : model.materials)
    if (law.contact && !used.contains(law.contact.get()))
      out.push_back("the contact law '" + law.name + "' (" + law.origin.text() + ") is not used: <Friction lawname='" +
                    law.name +
                    "'/> in <MultiMaterialMode>, in a material or in "
                    "<Cracks>, ContactMM or ContactCracks in scripts, choose a law");
  const NormalMethod normals = model.contact.normals;
  if (model.contact.active && model.contact.at_faces.value_or(false) && normals != NormalMethod::margin &&
      normals != NormalMethod::specified)
    out.push_back(
        "the normals come from the particle positions around nodes, while the impulses act at the faces between them: "
        "friction in such models can be wrong by a third. Without 'Normals' they come from the faces");
  return out;
}

}  // namespace tribo
