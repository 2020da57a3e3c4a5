// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "input/coverage.hpp"
#include "input/manual.hpp"
#include "input/read.hpp"
#include "input/script/script.hpp"
#include "input/script/write_xml.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "run/model_record.hpp"
#include "run/preflight.hpp"
#include "run/rank_plan.hpp"
#include "run/safety.hpp"
#include "run/signals.hpp"
#include "run/simulation.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <optional>
#include <sstream>

namespace tribo {
namespace {

std::filesystem::path default_folder(const std::filesystem::path& file) { return file.stem().string() + ".out"; }

// Messages of a run of a script name its commands.
std::function<std::string(const std::string&)> wording_of(const Model& model) {
  if (!is_script(model.source)) return {};
  return [](const std::string& text) { return in_words_of_scripts(text); };
}

void print_warnings(const Model& model) {
  for (const auto& warning : model.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
}

Settings settings_of(const Arguments& a) {
  std::map<std::string, std::string> values;
  for (const std::string& pair : a.settings) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) throw UsageError("--set takes name=value, not '" + pair + "'");
    values[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return values;
}

// The model of a run and what has changed in it since the run began.
struct ModelToResume {
  Model model;
  std::vector<std::string> changed;
};

// The command file is looked for from the folder of the run, which may have been moved with it, then where it was. If
// both exist, one that has not changed is taken. Without it the copy in the folder serves.
ModelToResume model_of(const std::filesystem::path& folder) {
  const ModelRecord record = read_model_record(folder);
  std::optional<ModelToResume> first;
  for (const auto& file : {(folder / record.relative).lexically_normal(), record.file}) {
    if (record.relative.empty() || !std::filesystem::is_regular_file(file)) continue;
    ModelToResume found{read_model(file, record.settings), {}};
    found.changed = changes(record, found.model);
    if (found.changed.empty()) return found;
    if (!first) first = std::move(found);
  }
  if (first) return *first;
  std::fprintf(stderr,
               "warning: there is no '%s' any more; the run continues with the copy of the model in its folder\n",
               record.file.c_str());
  return {read_model(copy_of_model(folder)), {}};
}

void refuse_changes(const ModelToResume& found, const std::filesystem::path& folder) {
  static constexpr std::size_t most = 40;
  std::string text = "'" + found.model.file + "' has changed since the run began:\n";
  for (std::size_t k = 0; k < std::min(most, found.changed.size()); ++k) text += "  " + found.changed[k] + "\n";
  if (found.changed.size() > most) text += "  and " + std::to_string(found.changed.size() - most) + " further lines\n";
  throw FileError(text + "'tribo resume --changed " + folder.string() +
                  "' continues with the changed file, with --accept-edits as a stage from now on; 'tribo run' starts "
                  "anew");
}

// Devices and pipes are written to, not replaced.
void keep_file(const std::filesystem::path& file, bool overwrite) {
  if (!overwrite && (std::filesystem::is_regular_file(file) || std::filesystem::is_directory(file)))
    throw FileError("'" + file.string() + "' already exists; --overwrite replaces it, --output names another file");
}

}  // namespace

int print(const std::string& text) {
  errno = 0;
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw FileError(std::string("cannot write to the standard output: ") + std::strerror(errno));
  return done;
}

Model model_of_file(const Arguments& a) {
  Model model = read_model(a.file, settings_of(a));
  print_warnings(model);
  return model;
}

int run_command(const Arguments& a) {
  if (a.only_check) return check_command(a);
  const Model model = model_of_file(a);
  RunOptions options;
  options.folder = a.output.empty() ? default_folder(a.file) : a.output;
  options.threads = a.thread_count, options.quiet = a.quiet, options.overwrite = a.overwrite,
  options.max_wall = a.max_wall, options.max_steps = a.max_steps;
  options.command_line = a.command_line;
  options.wording = wording_of(model);
  const auto outcome = tribo::run(model, options);
  if (!a.quiet)
    std::printf("open %s in ParaView; histories in %s\n",
                (options.folder / (model.only_blocks() ? "blocks.pvd" : "run.pvd")).c_str(),
                (options.folder / "history.csv").c_str());
  if (outcome == Outcome::stopped)
    std::fprintf(stderr, "stopped; continue with: tribo resume %s\n", options.folder.c_str());
  return outcome == Outcome::finished ? done : stopped_early;
}

int resume_command(const Arguments& a) {
  auto [model, changed] = model_of(a.folder);
  if (!changed.empty() && !a.changed && !a.accept_edits) refuse_changes({model, changed}, a.folder);
  RunOptions options;
  if (!changed.empty() && a.accept_edits) {
    const auto copy = copy_of_model(a.folder);
    options.former = std::make_shared<const Model>(read_model(copy));
    const Statement before = read_statements(copy), now = read_statements(model.file, Settings(model.settings), stderr);
    const auto same = [&](const char* section) {
      const Statement *x = before.child(section), *y = now.child(section);
      return (!x && !y) || (x && y && xml_text(*x) == xml_text(*y));
    };
    model.stage.kept = same("ParticleBCs") ? model.particle_conditions.size() : 0;
    model.stage.conditions = !same("GridBCs");
  }
  options.changed = !changed.empty(), options.changes = join(changed, "; ");
  options.folder = a.folder, options.threads = a.thread_count, options.quiet = a.quiet, options.max_wall = a.max_wall;
  options.max_steps = a.max_steps;
  options.resume = true, options.command_line = a.command_line;
  options.wording = wording_of(model);
  return tribo::run(model, options) == Outcome::finished ? done : stopped_early;
}

int check_command(const Arguments& a) {
  const Model model = read_model(a.file, settings_of(a));
  if (a.rank_count > 0) return print(plan_for_ranks(model, a.rank_count, a.thread_count));
  const std::string text = preflight(model, a.thread_count);
  return print(is_script(model.source) ? in_words_of_scripts(text) : text);
}

int drive_command(const Arguments& a) {
  const std::filesystem::path table = a.output.empty() ? a.file.stem().string() + ".csv" : a.output.string();
  keep_file(table, a.overwrite);
  const auto out = std::visit([](const auto& what) { return tribo::drive(what); }, read_drive(a.file, settings_of(a)));
  write_atomically(table, out.text());
  if (!a.quiet) std::printf("%s in %s\n", counted(out.rows.size(), "row").c_str(), table.c_str());
  return 0;
}

std::string verdict(const SafetyTrial& t) {
  if (!t.failure.empty()) return "slips: " + t.failure;
  std::ostringstream out;
  out.precision(3);
  out << (t.holds ? "holds" : "slips") << ", largest displacement " << t.at_end;
  return out.str();
}

int safety_command(const Arguments& a) {
  const Model model = model_of_file(a);
  RunOptions options;
  options.folder = a.output.empty() ? default_folder(a.file) : a.output;
  options.threads = a.thread_count, options.quiet = true, options.overwrite = a.overwrite,
  options.command_line = a.command_line;
  options.further_files = {"safety.csv"};
  check_folder(options);
  const SignalGuard signals;
  ResultFolder folder(options.folder);  // opened now, so that a failure is reported before the search
  options.opened = &folder;
  const auto found = find_safety(model, a.thread_count, [&](const SafetyTrial& t) {
    if (!a.quiet) std::printf("strengths over %-8.5g %s\n", t.factor, verdict(t).c_str());
    std::fflush(stdout);
  });
  std::string table = "factor,displacement_late,displacement_end,holds\n";
  for (const auto& t : found.trials)
    table += number_text(t.factor) + "," + number_text(t.late) + "," + number_text(t.at_end) + "," +
             (t.holds ? "1" : "0") + "\n";
  auto outcome = Outcome::finished;
  try {
    outcome = tribo::run(weakened(model, found.slips), options);
  } catch (const SimulationError& error) {  // a failing slope may leave the grid
    std::fprintf(stderr, "warning: the run that fails ended early: %s\n", error.what());
  }
  write_atomically(options.folder / "safety.csv", table);
  if (!a.quiet)
    std::printf("factor of safety %.5g: holds with strengths over %.5g, slips over %.5g (%s)\n",
                0.5 * (found.holds + found.slips), found.holds, found.slips, (options.folder / "run.pvd").c_str());
  if (const std::string doubt = doubt_about(found); !doubt.empty())
    std::fprintf(stderr, "warning: %s\n", doubt.c_str());
  return outcome == Outcome::finished ? done : stopped_early;
}

int convert_command(const Arguments& a) {
  const bool python = a.output.extension() == ".py";
  const std::string text = python ? read_as_python(a.file, settings_of(a), stderr)
                                  : xml_text(read_statements(a.file, settings_of(a), stderr));
  if (a.output.empty()) return print(text);
  keep_file(a.output, a.overwrite);
  write_atomically(a.output, text);
  return done;
}

int list_command(const Arguments& a) {
  const std::string text = !a.keyword.empty() ? manual_text(a.keyword) : a.names ? manual_names() : manual_list();
  return print(text);
}

int doc_command(const Arguments& a) {
  const std::string text = a.coverage ? coverage_markdown() : a.markdown ? manual_markdown() : manual_text(a.keyword);
  return print(text);
}

}  // namespace tribo
