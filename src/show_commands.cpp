// SPDX-License-Identifier: MIT
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "output/atomic_file.hpp"
#include "run/model_view.hpp"
#include "run/signals.hpp"
#include "run/trial_output.hpp"
#include "view/picture.hpp"
#include "view/report.hpp"
#include "view/watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace tribo {
namespace {

/// A file of results and its number in the run.
struct Frame {
  std::size_t number;
  CollectionEntry entry;
};

// All files, or those nearest to the given times.
std::vector<Frame> chosen(const std::vector<CollectionEntry>& all, const std::vector<double>& times) {
  if (all.empty()) throw FileError("the run has written no particles yet");
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < all.size(); ++k) frames.push_back({k, all[k]});
  if (times.empty()) return frames;
  std::vector<Frame> out;
  for (const double wanted : times) {
    const double t = std::clamp(wanted, all.front().time, all.back().time);
    const Frame& nearest = *std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.entry.time - t) < std::abs(b.entry.time - t);
    });
    const auto same = [&](const Frame& f) { return f.number == nearest.number; };
    if (std::none_of(out.begin(), out.end(), same)) out.push_back(nearest);
  }
  return out;
}

// The same bounding box and colour range for all pictures.
PictureOptions common_options(const RunFolder& run, const std::vector<Frame>& frames, const Arguments& a) {
  PictureOptions options;
  const Legend legend = run.legend();
  options.field = a.field.empty() ? default_field(run.scene(frames.back().entry)) : a.field;
  options.unit = legend.unit_of(options.field), options.time_unit = legend.time, options.length_unit = legend.length;
  options.materials = legend.materials;
  options.view = a.view, options.width = a.width;
  std::optional<Range> range;
  const std::size_t stride = std::max<std::size_t>(1, frames.size() / 12);
  for (std::size_t k = 0; k < frames.size();
       k = k + 1 < frames.size() ? std::min(k + stride, frames.size() - 1) : k + 1) {
    const Scene scene = run.scene(frames[k].entry);
    const auto box = box_of(scene);
    options.box = options.box ? joined(*options.box, box) : box;
    extend(range, shade_of(scene, options.field).values);
  }
  if (!a.window.empty() || a.zoom) {
    const std::string view = a.view.empty() ? usual_view(*options.box) : a.view;
    options.window = chosen_window({a.window, a.zoom.value_or(1.0), a.centre}, view, *options.box);
  }
  options.range = a.range.size() == 2 ? Range{a.range[0], a.range[1]} : widened(range);
  if (!((*options.range)[1] > (*options.range)[0]))
    throw UsageError("--range: the first value must be below the second");
  return options;
}

// Whether a shell command succeeds. Names must be quoted with quoted().
bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string drawn(const RunFolder& run, const CollectionEntry& entry, const PictureOptions& options) {
  return with_memory_for("the picture of '" + printable(entry.file.string()) + "'",
                         [&] { return picture(run.scene(entry), options); });
}

// Pictures of earlier calls may be replaced, nothing else.
void must_be_rendered(const std::filesystem::path& file) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file)) && !is_rendered(file))
    throw FileError("'" + printable(file.string()) +
                    "' was not made by 'tribo render': nothing was changed; move it, or choose another folder with "
                    "--output");
}

void make_film(const std::filesystem::path& pictures, std::size_t count, int rate, const std::filesystem::path& film) {
  write_atomically(film, [&](const std::string& temporary) {
    return succeeds("ffmpeg -y -framerate " + std::to_string(rate) + " -i " + quoted(pictures.string()) +
                    " -frames:v " + std::to_string(count) + " -pix_fmt yuv420p " + quoted(temporary)) &&
           (std::ofstream(temporary, std::ios::binary | std::ios::app) << film_mark()).flush();
  });
}

}  // namespace

int render_command(const Arguments& a) {
  const RunFolder run(a.folder);
  const auto frames = chosen(run.frames(), a.times);
  const PictureOptions options = common_options(run, frames, a);
  const std::filesystem::path folder = a.output.empty() ? a.folder / "pictures" : a.output;
  const auto place = [&](const Frame& frame) {
    char name[32];
    std::snprintf(name, sizeof name, "_%05zu.png", frame.number);
    return folder / (options.field + name);
  };
  const auto film = a.times.empty() && succeeds("command -v ffmpeg") ? std::optional(folder / (options.field + ".mp4"))
                                                                     : std::nullopt;
  for (const auto& frame : frames) must_be_rendered(place(frame));
  if (film) must_be_rendered(*film);
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (refused) throw FileError("cannot create '" + folder.string() + "': " + refused.message());
  // Pictures of different fields do not replace each other.
  for (const auto& frame : frames) write_atomically(place(frame), marked_as_rendered(drawn(run, frame.entry, options)));
  std::printf("%s in %s\n", counted(frames.size(), "picture").c_str(), folder.c_str());
  if (!a.times.empty()) return done;
  if (!film) return print("no film: ffmpeg is not installed\n");
  make_film(folder / (options.field + "_%05d.png"), frames.size(), a.rate, *film);
  return print("film: " + film->string() + "\n");
}

int report_command(const Arguments& a) {
  const RunFolder run(a.folder);
  const auto all = run.frames();
  if (all.empty()) throw FileError("the run has written no particles yet");
  std::vector<double> times = a.times;
  if (times.empty())
    for (const double part : {0.0, 1.0 / 3, 2.0 / 3, 1.0})
      times.push_back(all.front().time + part * (all.back().time - all.front().time));
  const auto frames = chosen(all, times);
  const PictureOptions options = common_options(run, frames, a);
  std::vector<ReportPicture> pictures;
  for (const auto& frame : frames) pictures.push_back({frame.entry.time, drawn(run, frame.entry, options)});
  const std::filesystem::path file = a.output.empty() ? a.folder / "report.html" : a.output;
  if (std::filesystem::exists(std::filesystem::symlink_status(file)) && !is_report(file))
    throw FileError("'" + file.string() + "' is not a report of Tribo; --output names another file");
  write_atomically(file, report(run, pictures));
  std::printf("%s\n", file.c_str());
  return done;
}

namespace {

// `word`, the address and `hint` are printed once the page is there.
WatchOptions page_options(const Arguments& a, const std::string& word, const std::string& hint) {
  WatchOptions options;
  options.port = a.port;
  options.ready = [=](const std::string& address) { print(word + " " + address + " " + hint + "\n"); };
  return options;
}

}  // namespace

int watch_command(const Arguments& a) {
  watch(RunFolder(a.folder), page_options(a, "watch", "(Ctrl-C ends it, not the run)"));
  return done;
}

int view_command(const Arguments& a) {
  const Model model = model_of_file(a);
  const SignalGuard signals;  // so that the folder is removed
  const TrialFolder folder;
  write_model_view(model, folder.path, a.command_line, a.thread_count);
  heed_stop();
  watch(RunFolder(folder.path), page_options(a, "view", "(Ctrl-C ends it)"));
  return done;
}

}  // namespace tribo
