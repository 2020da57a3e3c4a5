// SPDX-License-Identifier: MIT
/// Stages within a run.

#include "base/text.hpp"
#include "input/script/translator.hpp"

namespace tribo::script {

void Translator::stage(const Command& c) {
  if (stage_) throw InputError(c.origin(), "a stage within the stage from " + stage_->text());
  if (open_ != Open::nothing)
    throw InputError(c.origin(), "'" + c.node.word + "' inside '" + opened_by_ + "' from " + opened_at_.text());
  stage_ = c.origin();
  Statement s;
  s.name = "Stage", s.origin = s.text_origin = c.origin();
  attribute(s, "at", c.text(0), c.origin(0));
  if (c.given(1)) attribute(s, "name", c.text(1), c.origin(1));
  if (c.given(2)) attribute(s, "until", "ratio " + c.text(2), c.origin(2));
  document_.begin_stage(std::move(s));
}

void Translator::end_stage(const Command& c) {
  if (!stage_) throw InputError(c.origin(), "'" + c.node.word + "' closes nothing");
  if (open_ != Open::nothing)
    throw InputError(c.origin(), "'" + opened_by_ + "' from " + opened_at_.text() + " is open");
  stage_.reset();
  document_.end_stage();
}

// Only the properties that change are given.
void Translator::material_of_stage(const Command& c) {
  const Statement& before = document_.material_before(c.text(0), c.origin(0));
  open(Open::material, c);
  Statement& m = document_.material(c.origin());
  Document::refer(m, "mat", c.text(0), c.origin(0));
  if (const Attribute* type = before.attribute("Type")) attribute(m, "Type", type->text, c.origin());
}

void Translator::action(const Command& c) {
  if (!stage_) throw InputError(c.origin(), "'" + c.node.word + "' belongs into 'Stage ... EndStage'");
  open(Open::action, c);
  const std::string word = lower(c.node.word);
  block_ = Statement{};
  block_.name = word == "excavate" ? "Excavate" : word == "stress" ? "Stress" : word == "bond" ? "Bond" : "Unbond";
  block_.origin = block_.text_origin = c.origin();
  if (word == "excavate") {
    if (c.given(0)) Document::refer(block_, "mat", c.text(0), c.origin(0));
    return;
  }
  if (c.size() % 2 != 0) throw InputError(c.origin(), "'" + c.node.word + "' takes pairs of a word and its value");
  for (std::size_t k = 0; k + 1 < c.size(); k += 2) {
    const std::string criterion = lower(c.text(k));
    const bool law = criterion == "lawname", material = word == "stress" && criterion == "material";
    if (law || material)
      Document::refer(block_, law ? "law" : "mat", c.text(k + 1), c.origin(k + 1));
    else
      attribute(block_, criterion, c.text(k + 1), c.origin(k + 1));
  }
}

// bond_break,effect; ratio,value,effect; above or below,history,value,effect
void Translator::when(const Command& c) {
  const std::string kind = lower(c.text(0));
  const std::size_t arguments = kind == "bond_break" ? 2 : kind == "ratio" ? 3 : 4;
  if (kind != "bond_break" && kind != "ratio" && kind != "above" && kind != "below")
    throw InputError(c.origin(0), "'When' knows bond_break, ratio, above and below, not '" + c.text(0) + "'");
  if (c.size() != arguments)
    throw InputError(c.origin(), "'When " + kind + "' takes " + std::to_string(arguments) + " arguments: " +
                                     (arguments == 2   ? "bond_break, effect"
                                      : arguments == 3 ? "ratio, value, effect"
                                                       : kind + ", history, value, effect"));
  Statement& s = document_.add("MPMHeader", "When", c.origin());
  if (kind == "bond_break") attribute(s, "event", kind, c.origin(0));
  if (kind == "ratio") attribute(s, "ratio", c.text(1), c.origin(1));
  if (arguments == 4) attribute(s, "history", c.text(1), c.origin(1)), attribute(s, kind, c.text(2), c.origin(2));
  static const std::map<std::string, std::string> effects{
      {"stop", "Stop"}, {"frame", "Frame"}, {"checkpoint", "Checkpoint"}, {"nextstage", "NextStage"}};
  const auto effect = effects.find(lower(c.text(arguments - 1)));
  if (effect == effects.end())
    throw InputError(c.origin(arguments - 1),
                     "an effect is Stop, Frame, Checkpoint or NextStage, not '" + c.text(arguments - 1) + "'");
  Statement does;
  does.name = effect->second, does.origin = does.text_origin = c.origin(arguments - 1);
  s.children.push_back(does);
}

}  // namespace tribo::script
