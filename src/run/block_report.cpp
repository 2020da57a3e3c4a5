// SPDX-License-Identifier: MIT
/// The pre-flight report of a model of blocks.

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "run/block_run.hpp"
#include "run/pore_pressure.hpp"
#include "run/stage_report.hpp"
#include "run/trial_output.hpp"
#include "run/unit_remarks.hpp"

#include <chrono>
#include <map>

namespace tribo {
namespace {

// Mean over some steps, within the time of the run.
double seconds_per_step(Assembly& blocks, const BlockSteps& steps) {
  static constexpr double enough = 0.3;  // seconds
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  std::int64_t trial = 0;
  while (trial == 0 || (seconds() < enough && trial < steps.count)) blocks.advance(steps.size), ++trial;
  return seconds() / static_cast<double>(trial);
}

// What limits the time step, with the block if it is much smaller than the others.
std::string stiff_block(const Model& model, const Assembly& blocks) {
  static constexpr double small = 0.1;
  const std::string text = "the stiffness of the contacts";
  if (blocks.block_count() < 2) return text;
  double volume = 0.0;
  for (std::size_t k = 0; k < blocks.block_count(); ++k) volume += blocks.bodies[k].volume;
  const BlockBody& body = blocks.bodies[blocks.step_block()];
  if (body.volume > small * volume / static_cast<double>(blocks.block_count()) || body.group < 0) return text;
  const std::string& name = model.blocks->groups[static_cast<std::size_t>(body.group)].name;
  return text + format(
                    " of block %zu (%svolume %.3g), which is much smaller than the mean of %.3g: larger blocks take "
                    "larger steps",
                    blocks.step_block() + 1, name.empty() ? "" : ("'" + name + "', ").c_str(), body.volume,
                    volume / static_cast<double>(blocks.block_count()));
}

// A law of the input by its name; laws derived from it say how.
std::string words_of_law(const Model& model, const ContactGroup& group) {
  if (group.platen) return "a platen";
  const auto name = [&](const JointLaw* law) {
    for (const auto& m : model.materials)
      if (m.joint.get() == law) return "'" + m.name + "'";
    return std::string();
  };
  if (const std::string given = name(group.law); !given.empty()) return given;
  for (std::size_t k = 0; k <= model.blocks->joints.size(); ++k) {
    const BlockLaws& laws = model.blocks->laws_of(k);
    const std::string base = name(laws.initial.get());
    if (laws.later.get() == group.law) return base + " without bonds";
    for (const auto& [groups, both] : laws.by_groups)
      for (const auto& law : both)
        if (law.get() == group.law) {
          const auto block = [&](std::int32_t g) { return model.blocks->groups[static_cast<std::size_t>(g)].name; };
          return base +
                 format(" with the surfaces of '%s' and '%s'", block(groups[0]).c_str(), block(groups[1]).c_str());
        }
  }
  return "a law of its own";
}

// Without a folder for scratch files the time of output is left out.
double output_seconds(const Model& model, Assembly& blocks, double dt) {
  try {
    const TrialFolder scratch;
    OutputQueue queue;
    BlockResults results(model, blocks, scratch.path, std::nullopt, queue);
    return seconds_of_output(
        model.output, model.time.end, [&] { results.write_files(0), queue.drain(); },
        [&] { results.write_history(dt), queue.drain(); });
  } catch (const FileError&) {
    return 0.0;
  }
}

// What may be wrong with gravity, and with what holds and moves the blocks.
std::vector<std::string> advice_on(const Model& model) {
  std::vector<std::string> out = remarks_on_gravity(model);
  const BlocksSpec& blocks = *model.blocks;
  if (!blocks.holds.empty() || !blocks.platens.empty() || !model.stages.empty()) return out;
  const bool starts = std::any_of(blocks.groups.begin(), blocks.groups.end(),
                                  [](const BlockGroup& g) { return !g.velocity.isZero() || !g.spin.isZero(); });
  if (!model.body_force.gravity.isZero())
    out.emplace_back("gravity acts, but no block is held (<Hold>, <Platen>): all of them fall freely");
  else if (blocks.loads.empty() && blocks.pressures.empty() && !starts)
    out.emplace_back(
        "nothing moves the blocks: there is no gravity, load, pressure, platen, prescribed motion or "
        "velocity");
  return out;
}

}  // namespace

std::string describe_blocks(const Model& model, int wanted_threads) {
  Assembly blocks = assemble(model);
  set_threads(sensible_block_threads(wanted_threads, blocks.contacts.size()));
  std::string out;
  const auto line = [&](const std::string& text) { out += text + "\n"; };
  line(line_of_units(model));
  line("gravity: " + words_of_gravity(model));
  double volume = 0, smallest = 1e300, largest = 0;
  for (std::size_t k = 0; k < blocks.block_count(); ++k) {
    const double v = blocks.bodies[k].volume;
    volume += v, smallest = std::min(smallest, v), largest = std::max(largest, v);
  }
  line(format("blocks: %zu, volume %.6g, single %.3g ... %.3g", blocks.block_count(), volume, smallest, largest));
  for (const ContactGroup& g : blocks.groups) {
    double stiffest = 0;
    for (std::size_t k = g.begin; k < g.end; ++k) stiffest = std::max(stiffest, blocks.joints[k].kn);
    line(format("contacts of %s: %zu, normal stiffness up to %.4g", words_of_law(model, g).c_str(), g.end - g.begin,
                stiffest));
  }
  line(format("bonds: %zu", blocks.bonds()));
  for (std::size_t p = 0; p < model.blocks->platens.size(); ++p)
    line(format("platen '%s': area %.6g", model.blocks->platens[p].name.c_str(), blocks.platen_area(p)));
  if (const std::string torn = torn_by_pressure(blocks); !torn.empty()) line(torn);
  const BlockSteps steps = steps_of(model, blocks);
  line(format("time step: %.6g %s, set by %s", steps.size, model.units.name(Dimension::time).c_str(),
              model.blocks->quasi_static                     ? "<TimeStep>, to which masses are fitted"
              : blocks.critical_step() < model.time.max_step ? stiff_block(model, blocks).c_str()
                                                             : "<TimeStep>"));
  line(format("steps: %lld to time %.6g", static_cast<long long>(steps.count), model.time.next_end()));
  for (const std::string& text : describe_stages(model, {})) line(text);
  for (const StageSpec& stage : model.stages) (void)assemble(*stage.model);
  line(format("memory: about %.3g MB", 1e-6 * blocks.bytes()));
  line(format("files of blocks and contacts: %.0f each", file_times(Schedule(model.output.archive), model.time.end)));
  const double output = output_seconds(model, blocks, steps.size);
  out += format("estimated time: %.3g s on %s, of which output %.2g s\n",
                seconds_per_step(blocks, steps) * model.time.end / steps.size + output,
                counted(threads(), "thread").c_str(), output);
  for (const auto& warning : model.warnings) line(warning);
  const std::vector<std::string> advice = advice_on(model);
  if (!advice.empty()) line("\nto look at:");
  for (const std::string& text : advice) line("- " + text);
  return out;
}

}  // namespace tribo
