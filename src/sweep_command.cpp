// SPDX-License-Identifier: MIT
/// `tribo sweep`: the same command file with all combinations of some variables, each run in a process of its own.

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "commands.hpp"
#include "input/read.hpp"
#include "output/atomic_file.hpp"
#include "run/result_folder.hpp"
#include "run/signals.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <thread>

namespace tribo {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

// A variable and its values, as `name=v1,v2`.
struct Variation {
  std::string name;
  Words values;
};

// One run of the sweep; the values are in the order of the variations.
struct Point {
  Words values;
  std::string name;
  fs::path folder;
  pid_t process = 0;
  int code = -1;  // exit code; -1: has not run
};

Variation variation_of(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("a sweep takes name=value,value,..., not '" + text + "'");
  Variation out{text.substr(0, equals), {}};
  std::istringstream rest(text.substr(equals + 1));
  for (std::string value; std::getline(rest, value, ',');) {
    if (value.empty()) throw UsageError("a value of '" + out.name + "' is missing in '" + text + "'");
    if (std::find(out.values.begin(), out.values.end(), value) != out.values.end())
      throw UsageError("the value " + value + " of '" + out.name + "' is given twice");
    out.values.push_back(value);
  }
  if (out.values.empty()) throw UsageError("'" + out.name + "' has no values; a sweep takes name=value,value,...");
  return out;
}

std::vector<Variation> variations_of(const Words& texts) {
  std::vector<Variation> out;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    out.push_back(variation_of(text));
    if (!names.insert(out.back().name).second)
      throw UsageError("the variable '" + out.back().name + "' is given twice");
  }
  return out;
}

// All combinations; the last variable changes fastest.
std::vector<Point> points_of(const std::vector<Variation>& variations, const fs::path& folder) {
  std::vector<Point> out(1);
  for (const Variation& v : variations) {
    std::vector<Point> more;
    for (const Point& point : out)
      for (const std::string& value : v.values) {
        Point next = point;
        next.values.push_back(value);
        next.name += (next.name.empty() ? "" : "_") + v.name + "=" + value;
        more.push_back(std::move(next));
      }
    out = std::move(more);
  }
  for (Point& point : out) {
    std::string name = point.name;
    std::replace(name.begin(), name.end(), '/', '%');
    point.folder = folder / name;
  }
  return out;
}

Words settings_of(const Point& point, const std::vector<Variation>& variations, const Words& common) {
  Words out = common;
  for (std::size_t k = 0; k < variations.size(); ++k) out.push_back(variations[k].name + "=" + point.values[k]);
  return out;
}

// Errors of the input, and folders that are in use, are told before the first run.
void check_points(const std::vector<Point>& points, const std::vector<Variation>& variations, const Arguments& a) {
  bool first = true;
  for (const Point& point : points) {
    std::map<std::string, std::string> values;
    for (const std::string& pair : settings_of(point, variations, a.settings)) {
      const auto equals = pair.find('=');
      if (equals == std::string::npos || equals == 0) throw UsageError("--set takes name=value, not '" + pair + "'");
      values[pair.substr(0, equals)] = pair.substr(equals + 1);
    }
    const Model model = read_model(a.file, Settings(values));
    for (const std::string& warning : model.warnings)
      if (first) std::fprintf(stderr, "%s\n", warning.c_str());
    first = false;
    if (!a.overwrite) refuse_used_folder(point.folder);
  }
}

void start(Point& point, const Words& settings, int threads, const Arguments& a) {
  Words words{"tribo", "run", "--quiet", "--output", point.folder.string(), "--threads", std::to_string(threads)};
  if (a.overwrite) words.emplace_back("--overwrite");
  for (const std::string& pair : settings) words.emplace_back("--set"), words.push_back(pair);
  words.emplace_back("--"), words.push_back(a.file.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&point.process, "/proc/self/exe", nullptr, nullptr, arguments.data(), environ);
  if (error != 0) throw FileError(std::string("cannot start another process: ") + std::strerror(error));
}

// Whether a point has ended since the last call. One that a stop killed before its run began has not run.
bool has_ended(Point& point) {
  int status = 0;
  if (point.process == 0 || waitpid(point.process, &status, WNOHANG) != point.process) return false;
  point.process = 0;
  if (WIFEXITED(status))
    point.code = WEXITSTATUS(status);
  else if (!SignalGuard::stop())
    point.code = numerical_error;
  return true;
}

const char* outcome(const Point& point) {
  return point.code == done            ? "finished"
         : point.code == stopped_early ? "stopped"
         : point.code < 0              ? "not run"
                                       : "failed";
}

// Runs the points, `jobs` at a time. A request to stop is passed on to those that run, and no further one is begun.
void run_points(std::vector<Point>& points, const std::vector<Variation>& variations, const Arguments& a) {
  const SignalGuard signals;
  const std::size_t jobs = static_cast<std::size_t>(std::max(1, a.jobs));
  const int threads = a.threads_each > 0 ? a.threads_each : std::max(1, a.thread_count / static_cast<int>(jobs));
  std::size_t next = 0, running = 0, ended = 0;
  bool told = false;
  while (running > 0 || (next < points.size() && !SignalGuard::stop())) {
    for (; running < jobs && next < points.size() && !SignalGuard::stop(); ++next, ++running)
      start(points[next], settings_of(points[next], variations, a.settings), threads, a);
    if (SignalGuard::stop() && !told) {
      told = true;
      for (const Point& point : points)
        if (point.process != 0) kill(point.process, SIGTERM);
    }
    for (Point& point : points) {
      if (!has_ended(point)) continue;
      --running, ++ended;
      if (!a.quiet) std::printf("%s: %s (%zu of %zu)\n", point.name.c_str(), outcome(point), ended, points.size());
      std::fflush(stdout);
    }
    if (running > 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// The first and the last complete line of the histories of a run; nothing if it has none.
using Ends = std::pair<std::string, std::string>;
Ends ends_of_history(const fs::path& file) {
  if (!fs::exists(file)) return {};
  std::istringstream text(read_file(file));
  std::string first, last;
  std::getline(text, first);
  for (std::string line; std::getline(text, line) && !text.eof();) last = line;
  return {first, last};
}

// The cells of a line; those with commas are quoted, and stay so.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

// The last values of the histories of a run by their names.
std::map<std::string, std::string> last_values(const Ends& ends, std::vector<std::string>& columns) {
  std::map<std::string, std::string> values;
  if (ends.first.empty()) return values;
  const auto names = cells_of(ends.first), last = cells_of(ends.second);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (std::find(columns.begin(), columns.end(), names[k]) == columns.end()) columns.push_back(names[k]);
    if (k < last.size()) values[names[k]] = last[k];
  }
  return values;
}

// Runs may have different histories: a column holds the values of those that have it.
std::string table_of(const std::vector<Point>& points, const std::vector<Variation>& variations) {
  std::vector<std::string> columns;
  std::vector<std::map<std::string, std::string>> last;
  for (const Point& point : points) {
    const bool has_results = point.code == done || point.code == stopped_early;
    last.push_back(last_values(has_results ? ends_of_history(point.folder / "history.csv") : Ends{}, columns));
  }
  std::string out;
  for (const Variation& v : variations) out += v.name + ",";
  out += "folder,outcome";
  for (const std::string& column : columns) out += "," + column;
  out += "\n";
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (const std::string& value : points[k].values) out += value + ",";
    out += points[k].folder.filename().string() + "," + outcome(points[k]);
    for (const std::string& column : columns) out += "," + last[k][column];
    out += "\n";
  }
  return out;
}

}  // namespace

int sweep_command(const Arguments& a) {
  const auto variations = variations_of(a.variations);
  const fs::path folder = a.output.empty() ? fs::path(a.file.stem().string() + ".sweep") : a.output;
  auto points = points_of(variations, folder);
  check_points(points, variations, a);
  run_points(points, variations, a);
  fs::create_directories(folder);
  write_atomically(folder / "sweep.csv", table_of(points, variations));
  if (!a.quiet) std::printf("the last values of the histories are in %s\n", (folder / "sweep.csv").c_str());
  const auto worst = [&](auto wanted) { return std::find_if(points.begin(), points.end(), wanted); };
  if (worst([](const Point& p) { return p.code == stopped_early || p.code < 0; }) != points.end()) return stopped_early;
  const auto failed = worst([](const Point& p) { return p.code != done; });
  return failed == points.end() ? done : failed->code;
}

}  // namespace tribo
