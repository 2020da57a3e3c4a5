// SPDX-License-Identifier: MIT
/// The program: parses the arguments, calls the command and converts exceptions to exit codes.

#include "base/error.hpp"
#include "base/ranks.hpp"
#include "base/read_file.hpp"
#include "commands.hpp"
#include "completion.hpp"
#include "input/dialect.hpp"
#include "man_page.hpp"
#include "output/provenance.hpp"
#include "run/distributed_run.hpp"
#include "run/signals.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>

#include <sys/prctl.h>
#include <unistd.h>

#ifdef TRIBO_MPI
#include "mpi/mpi.hpp"
#endif

namespace {

using namespace tribo;

std::string joined(int argc, char** argv) {
  std::string out;
  for (int k = 0; k < argc; ++k) out += (k ? " " : "") + std::string(argv[k]);
  return out;
}

// Whether this is one of several processes that a launcher of MPI has started.
bool started_by_mpi() {
  const auto several = [](const char* name) {
    const char* value = std::getenv(name);
    return value && std::atoi(value) > 1;
  };
  const bool by_slurm = std::getenv("PMIX_RANK") && several("SLURM_STEP_NUM_TASKS");
  return several("OMPI_COMM_WORLD_SIZE") || several("PMI_SIZE") || by_slurm;
}

// If the command is missing or unknown, prints what is valid.
bool misses_a_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "%s", app.help().c_str());
    return true;
  }
  const std::string word = argv[1];
  std::vector<std::string> known;
  for (const auto* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (word.starts_with("-") || std::find(known.begin(), known.end(), word) != known.end()) return false;
  const std::string meant =
      std::filesystem::exists(word) ? " (to run this file: tribo run " + word + ")" : tribo::did_you_mean(word, known);
  std::fprintf(stderr, "there is no command '%s'%s; valid: %s\n", word.c_str(), meant.c_str(),
               tribo::join(known).c_str());
  return true;
}

// How a command has ended: the exit code, and what is to be told.
struct Ending {
  int code = done;
  std::string text;
};

Ending guarded(const std::function<int()>& action) {
  try {
    return {action(), {}};
  } catch (const UsageError& error) {
    return {usage_error, std::string("error: ") + error.what()};
  } catch (const InputError& error) {
    return {input_error, error.what()};
  } catch (const SimulationError& error) {
    return {numerical_error, std::string("error: ") + error.what()};
  } catch (const FileError& error) {
    return {file_error, std::string("error: ") + error.what()};
  } catch (const StopRequest&) {
    return {stopped_early, "stopped; nothing was written"};
  } catch (const std::filesystem::filesystem_error& error) {
    return {file_error, "error: '" + printable(error.path1().string()) + "': " + error.code().message()};
  } catch (const std::bad_alloc&) {
    return {file_error,
            "error: not enough memory; use larger cells or fewer particles ('tribo check FILE' estimates it)"};
  } catch (const std::exception& error) {
    return {numerical_error, std::string("internal error: ") + error.what()};
  }
}

int end(const Ending& ending) {
  if (!ending.text.empty()) std::fprintf(stderr, "%s\n", ending.text.c_str());
  return ending.code;
}

#ifdef TRIBO_MPI
// The same in one of several processes. Rank 0 speaks for all, unless another one has failed alone.
int end_with_others(const std::function<int()>& action) {
  const MpiSession session;
  const int own_errors = dup(STDERR_FILENO);
  if (ranks().rank() > 0)
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) return file_error;
  const Ending ending = guarded(action);
  if (failed_alone() && ranks().rank() > 0) {
    dup2(own_errors, STDERR_FILENO);
    std::fprintf(stderr, "process %d: ", ranks().rank());
  }
  close(own_errors);
  const int code = end(ending);
  if (failed_alone()) MpiSession::abort(code);
  return code;
}
#endif

// The commands and their options.
class CommandLine {
 public:
  CommandLine() {
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);

    auto* run = reads_file("run", "run a command file", run_command);
    writes_folder(run), has_threads(run), may_be_quiet(run), has_wall(run);
    run->add_flag("-a", a.only_check, "stop before the analysis; the same as 'tribo check'");
    run->add_flag_callback(
        "-v", [] {}, "accepted without effect: files are always checked");
    run->add_flag_callback(
        "-w", [] {}, "accepted without effect: results are always written below the current folder");
    auto* resume = add("resume", "continue a stopped run", resume_command);
    resume->add_option("DIR", a.folder, "folder of the run")->required();
    resume->add_flag("--changed", a.changed, "continue with a command file that has changed since");
    resume->add_flag(
        "--accept-edits", a.accept_edits,
        "the same, and what has changed is a stage from now on: with a time step, energies and loads of its "
        "own");
    has_threads(resume), may_be_quiet(resume), has_wall(resume);
    auto* check = reads_file(
        "check", "read the file, build the model and print a summary with checks, without running it", check_command);
    has_threads(check);
    check
        ->add_option("--ranks", a.rank_count,
                     "print how so many processes with --threads threads each would share the model instead")
        ->check(CLI::Range(1, 1'000'000));
    auto* drive = reads_file("drive", "drive one law along the path of <Drive> and write a table", drive_command);
    writes_file(drive, "file of the table (default: NAME.csv in the current folder)"), may_be_quiet(drive);
    auto* sweep =
        reads_file("sweep", "run a file for all combinations of some variables and write a table", sweep_command);
    sweep->add_option("VARIABLES", a.variations, "NAME=VALUE,VALUE,... for each variable of a script or XML entity")
        ->required();
    sweep->add_option("-o,--output", a.output,
                      "folder for the results, one folder per run, and for the table sweep.csv (default: NAME.sweep in "
                      "the current folder)");
    sweep->add_flag("--overwrite", a.overwrite, "replace earlier results");
    sweep->add_option("-j,--jobs", a.jobs, "runs at the same time, each in a process of its own (default 1)")
        ->check(CLI::PositiveNumber);
    sweep->add_option("--threads", a.threads_each, "threads of each run (default: the cores are shared among the runs)")
        ->check(CLI::PositiveNumber);
    may_be_quiet(sweep);
    auto* safety = reads_file("safety", "find the factor of safety by strength reduction", safety_command);
    writes_folder(safety), has_threads(safety), may_be_quiet(safety);
    writes_file(reads_file("convert", "write a command file as XML, or a script as a Python program", convert_command),
                "output file; NAME.py: a Python program, otherwise XML (default: XML to the standard output)");
    auto* render = add("render", "draw the particles of a run, as pictures and a film", render_command);
    render->add_option("DIR", a.folder, "folder of the run")->required();
    render->add_option("-o,--output", a.output,
                       "folder of the pictures FIELD_NUMBER.png and of the film FIELD.mp4 (default: DIR/pictures)");
    shows_field(render);
    auto* window = render->add_option("--window", a.window,
                                      "LEFT,RIGHT,LOW,HIGH: what the pictures show, along the two axes of the view");
    window->expected(4)->delimiter(',');
    auto* zoom = render->add_option("--zoom", a.zoom, "magnify by this factor, around the middle or --centre");
    zoom->excludes(window);
    render->add_option("--centre", a.centre, "X,Y or X,Y,Z: the point in the middle of a magnified picture")
        ->expected(2, 3)
        ->delimiter(',')
        ->needs(zoom);
    render->add_option("--rate", a.rate, "pictures per second of the film (default 20)")->check(CLI::PositiveNumber);
    auto* report = add("report", "write an HTML report of a run: pictures, histories, energies, times", report_command);
    report->add_option("DIR", a.folder, "folder of the run")->required();
    report->add_option("-o,--output", a.output, "output file (default: DIR/report.html)");
    shows_field(report);
    auto* watch = add("watch", "show a run on a web page, also while it goes on", watch_command);
    watch->add_option("DIR", a.folder, "folder of the run")->required();
    has_port(watch);
    auto* view = reads_file("view", "show a model before its run on a web page; writes no files", view_command);
    has_port(view), has_threads(view);
    add("schema", "print the XML schema of command files", [](const Arguments&) { return print(schema()); });
    auto* list =
        add("list", "list all elements, materials, laws, commands and quantities, or describe one", list_command);
    list->add_option("NAME", a.keyword, "name to describe");
    list->add_flag("--names", a.names, "print the names only");
    auto* doc = add("doc", "describe an element, material, law, command or quantity, or all",
                    [this](const Arguments&) { return describe(); });
    doc->add_option("NAME", a.keyword, "name to describe");
    doc->add_flag("--markdown", a.markdown, "print all as Markdown");
    doc->add_flag("--coverage", a.coverage, "print what is known of the dialect of NairnMPM, as Markdown");
    add("completion", "print a completion script for bash or zsh",
        [this](const Arguments&) { return print(completion(app, a.keyword)); })
        ->add_option("SHELL", a.keyword, "bash or zsh")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh"}));
    add("man", "print the manual page, for 'man -l -'",
        [this](const Arguments&) { return print(man_page(app, version_text())); });
  }

  CLI::App app{"Tribo: material point method with contact"};
  Arguments a;
  std::function<int(const Arguments&)> action;

 private:
  // A name of the command files, otherwise a command of the program.
  int describe() const {
    try {
      return doc_command(a);
    } catch (const UsageError&) {
      for (const auto* command : app.get_subcommands({}))
        if (command->get_name() == a.keyword) return print(command->help("tribo"));
      throw;
    }
  }

  template <class Action>
  CLI::App* add(const std::string& name, const std::string& meaning, Action act) {
    auto* command = app.add_subcommand(name, meaning);
    command->callback([this, act] { action = act; });
    return command;
  }
  template <class Action>
  CLI::App* reads_file(const std::string& name, const std::string& meaning, Action act) {
    auto* command = add(name, meaning, act);
    command->add_option("FILE", a.file, "command file, XML or scripted")->required();
    command->add_option("--set", a.settings, "NAME=VALUE: sets a variable of a script or an XML entity")
        ->allow_extra_args(false);
    return command;
  }
  void writes_folder(CLI::App* command) {
    command->add_option("-o,--output", a.output, "folder for the results (default: NAME.out in the current folder)");
    command->add_flag("--overwrite", a.overwrite, "replace earlier results");
  }
  void writes_file(CLI::App* command, const std::string& meaning) {
    command->add_option("-o,--output", a.output, meaning);
    command->add_flag("--overwrite", a.overwrite, "replace an earlier file");
  }
  void has_threads(CLI::App* command) {
    command
        ->add_option("--threads,--np", a.thread_count,
                     "number of threads (default: OMP_NUM_THREADS, otherwise all cores)")
        ->check(CLI::PositiveNumber);
  }
  void shows_field(CLI::App* command) {
    command->add_option(
        "--field", a.field,
        "colour by: von_mises (default if the run has it), velocity, velocity.x, stress.xy, material ...");
    command->add_option("--time", a.times, "draw only the files nearest to these times");
    command->add_option("--range", a.range, "lowest and highest value of the colour scale")->expected(2);
    command->add_option("--view", a.view, "xy, xz, yz, iso (y up) or iso-z");
    command->add_option("--width", a.width, "width of a picture in pixels (default 900)")->check(CLI::Range(200, 8000));
  }
  void has_port(CLI::App* command) {
    command->add_option("--port", a.port, "port of the local web server (default: any free port)")
        ->check(CLI::Range(1, 65535));
  }
  void may_be_quiet(CLI::App* command) { command->add_flag("--quiet", a.quiet, "print no progress and no summary"); }
  void has_wall(CLI::App* command) {
    command->add_option("--max-wall", a.max_wall, "stop with a checkpoint after this many seconds")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--max-steps", a.max_steps, "stop with a checkpoint after this many steps")
        ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  }
};

}  // namespace

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): what escapes ends the program, as it should
  prctl(PR_SET_NAME, "tribo");     // which restarts have changed to that of a link or file, see waiting.cpp and cpu.cpp
  CommandLine line;
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0 || !misses_a_command(line.app, argc, argv))
      return line.app.exit(error) == 0 ? done : usage_error;
    return usage_error;
  }
  line.a.command_line = joined(argc, argv);
  const auto action = [&] { return line.action(line.a); };
  const bool runs = line.app.got_subcommand("run") || line.app.got_subcommand("resume");
  if (runs && started_by_mpi()) {
#ifdef TRIBO_MPI
    return end_with_others(action);
#else
    return end({usage_error,
                "error: this program was built without MPI, so that several processes would each do the whole run; "
                "build it with -DTRIBO_MPI=ON"});
#endif
  }
  return end(guarded(action));
}
