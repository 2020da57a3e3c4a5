/// The program: arguments in, exit code out. The only place that catches.

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "input/dialect.hpp"
#include "input/read.hpp"
#include "output/atomic_file.hpp"
#include "output/number.hpp"
#include "output/provenance.hpp"
#include "run/safety.hpp"
#include "run/simulation.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>

namespace {

constexpr int usage_error = 2, input_error = 3, numerical_error = 4, file_error = 5, stopped = 6;

std::filesystem::path default_folder(const std::filesystem::path& file) { return file.stem().string() + ".out"; }

void print_warnings(const tribo::Model& model) {
  for (const auto& warning : model.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
}

std::string joined(int argc, char** argv) {
  std::string out;
  for (int k = 0; k < argc; ++k) out += (k ? " " : "") + std::string(argv[k]);
  return out;
}

struct Arguments {
  std::filesystem::path file, output, folder;
  int threads = tribo::threads();
  bool quiet = false, overwrite = false;
  double max_wall = 0.0;
  std::string keyword;
};

int run(const Arguments& a, const std::string& command) {
  const tribo::Model model = tribo::read_model(a.file);
  print_warnings(model);
  tribo::RunOptions options;
  options.folder = a.output.empty() ? default_folder(a.file) : a.output;
  options.threads = a.threads, options.quiet = a.quiet, options.overwrite = a.overwrite, options.max_wall = a.max_wall;
  options.command_line = command;
  const auto outcome = tribo::run(model, options);
  if (!a.quiet)
    std::printf("open %s in ParaView; histories in %s\n", (options.folder / "run.pvd").c_str(),
                (options.folder / "history.csv").c_str());
  if (outcome == tribo::Outcome::stopped)
    std::fprintf(stderr, "stopped; continue with: tribo resume %s\n", options.folder.c_str());
  return outcome == tribo::Outcome::finished ? 0 : stopped;
}

int resume(const Arguments& a, const std::string& command) {
  std::ifstream record(a.folder / "model.path");
  std::string file;
  if (!std::getline(record, file))
    throw tribo::FileError("'" + a.folder.string() + "' is not the folder of a run: it has no model.path");
  const tribo::Model model = tribo::read_model(file);
  tribo::RunOptions options;
  options.folder = a.folder, options.threads = a.threads, options.quiet = a.quiet, options.max_wall = a.max_wall;
  options.resume = true, options.command_line = command;
  return tribo::run(model, options) == tribo::Outcome::finished ? 0 : stopped;
}

int check(const Arguments& a) {
  const tribo::Model model = tribo::read_model(a.file);
  std::printf("%s", tribo::preflight(model, a.threads).c_str());
  return 0;
}

int drive(const Arguments& a) {
  const std::filesystem::path table = a.output.empty() ? a.file.stem().string() + ".csv" : a.output.string();
  if (!a.overwrite && std::filesystem::exists(table))
    throw tribo::FileError("'" + table.string() +
                           "' is there already; --overwrite replaces it, --output names another");
  const auto out = std::visit([](const auto& what) { return tribo::drive(what); }, tribo::read_drive(a.file));
  tribo::write_atomically(table, out.text());
  if (!a.quiet) std::printf("%zu rows in %s\n", out.rows.size(), table.c_str());
  return 0;
}

int safety(const Arguments& a, const std::string& command) {
  const tribo::Model model = tribo::read_model(a.file);
  print_warnings(model);
  tribo::RunOptions options;
  options.folder = a.output.empty() ? default_folder(a.file) : a.output;
  options.threads = a.threads, options.quiet = true, options.overwrite = a.overwrite, options.command_line = command;
  tribo::refuse_used_folder(options);
  std::error_code refused;  // now, not after the search
  std::filesystem::create_directories(options.folder, refused);
  if (refused) throw tribo::FileError("cannot create '" + options.folder.string() + "': " + refused.message());
  const auto found = tribo::find_safety(model, a.threads, [&](const tribo::SafetyTrial& t) {
    if (!a.quiet)
      std::printf("strengths over %-8.5g %s\n", t.factor,
                  t.holds             ? "hold"
                  : t.failure.empty() ? "slips"
                                      : ("slips: " + t.failure).c_str());
    std::fflush(stdout);
  });
  std::string table = "factor,displacement_late,displacement_end,holds\n";
  for (const auto& t : found.trials)
    table += tribo::number_text(t.factor) + "," + tribo::number_text(t.late) + "," + tribo::number_text(t.at_end) +
             "," + (t.holds ? "1" : "0") + "\n";
  auto outcome = tribo::Outcome::finished;
  try {
    outcome = tribo::run(tribo::weakened(model, found.slips), options);
  } catch (const tribo::SimulationError& error) {  // a body that slips may well leave the grid
    std::fprintf(stderr, "warning: the run that slips ended early: %s\n", error.what());
  }
  tribo::write_atomically(options.folder / "safety.csv", table);
  if (!a.quiet)
    std::printf("factor of safety %.5g: holds with strengths over %.5g, slips over %.5g (%s)\n",
                0.5 * (found.holds + found.slips), found.holds, found.slips, (options.folder / "run.pvd").c_str());
  return outcome == tribo::Outcome::finished ? 0 : stopped;
}

int guarded(const std::function<int()>& action) {
  try {
    return action();
  } catch (const tribo::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return input_error;
  } catch (const tribo::SimulationError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return numerical_error;
  } catch (const tribo::FileError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return file_error;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "error: not enough memory; use larger cells or fewer particles ('tribo check FILE' estimates it)\n");
    return file_error;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
    return numerical_error;
  }
}

}  // namespace

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): what escapes ends the program, as it should
  CLI::App app{"Tribo: material point method with contact"};
  app.set_version_flag("--version", tribo::version_text());
  app.require_subcommand(1);
  Arguments a;

  auto* run_command = app.add_subcommand("run", "run a command file");
  run_command->add_option("FILE", a.file, "command file (XML)")->required();
  run_command->add_option("--output", a.output, "folder for the results (default: NAME.out here)");
  run_command->add_flag("--overwrite", a.overwrite, "replace the results of an earlier run");
  auto* resume_command = app.add_subcommand("resume", "continue a stopped run");
  resume_command->add_option("DIR", a.folder, "folder of the run")->required();
  auto* check_command = app.add_subcommand("check", "read and build, print the pre-flight sheet, run nothing");
  check_command->add_option("FILE", a.file, "command file (XML)")->required();
  auto* drive_command = app.add_subcommand("drive", "drive one law along the path of <Drive>, print a table");
  drive_command->add_option("FILE", a.file, "command file (XML)")->required();
  drive_command->add_option("--output", a.output, "the table (default: NAME.csv here)");
  drive_command->add_flag("--overwrite", a.overwrite, "replace an earlier table");
  drive_command->add_flag("--quiet", a.quiet, "say nothing");
  auto* safety_command = app.add_subcommand("safety", "find the factor of safety by reduction of all strengths");
  safety_command->add_option("FILE", a.file, "command file (XML)")->required();
  safety_command->add_option("--output", a.output, "folder for the results (default: NAME.out here)");
  safety_command->add_flag("--overwrite", a.overwrite, "replace earlier results");
  safety_command->add_flag("--quiet", a.quiet, "say nothing");
  auto* schema_command = app.add_subcommand("schema", "print the XML schema of command files");
  auto* list_command = app.add_subcommand("list", "print all keywords and materials, or one of them");
  list_command->add_option("NAME", a.keyword, "an element or a material");
  for (auto* command : {run_command, resume_command, check_command, safety_command})
    command->add_option("--threads", a.threads, "threads (default: OMP_NUM_THREADS, else all)")
        ->check(CLI::PositiveNumber);
  for (auto* command : {run_command, resume_command}) {
    command->add_flag("--quiet", a.quiet, "no progress");
    command->add_option("--max-wall", a.max_wall, "stop with a checkpoint after this many seconds")
        ->check(CLI::NonNegativeNumber);
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  const std::string command = joined(argc, argv);
  return guarded([&] {
    if (*run_command) return run(a, command);
    if (*resume_command) return resume(a, command);
    if (*check_command) return check(a);
    if (*drive_command) return drive(a);
    if (*safety_command) return safety(a, command);
    if (*schema_command) return std::printf("%s", tribo::schema().c_str()) < 0 ? file_error : 0;
    if (*list_command) {
      const auto text = tribo::list_keywords(a.keyword);
      if (text.empty())
        throw tribo::InputError(tribo::Origin{}, "there is no element or material named '" + a.keyword + "'");
      return std::printf("%s", text.c_str()) < 0 ? file_error : 0;
    }
    return usage_error;
  });
}
