#include "base/error.hpp"
#include "commands.hpp"
#include "output/atomic_file.hpp"
#include "view/picture.hpp"
#include "view/run_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tribo {
namespace {

// All files, or those nearest to the times asked for.
std::vector<CollectionEntry> chosen(const std::vector<CollectionEntry>& all, const std::vector<double>& times) {
  if (all.empty()) throw FileError("the run has written no particles yet");
  if (times.empty()) return all;
  std::vector<CollectionEntry> out;
  for (const double wanted : times) {
    const double t = std::clamp(wanted, all.front().time, all.back().time);
    out.push_back(*std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.time - t) < std::abs(b.time - t);
    }));
  }
  return out;
}

// One box and one range of colours for all pictures.
PictureOptions common_options(const std::vector<CollectionEntry>& frames, const Arguments& a) {
  PictureOptions options;
  options.field = a.field, options.view = a.view, options.width = a.width;
  std::optional<Range> range;
  const std::size_t stride = std::max<std::size_t>(1, frames.size() / 12);
  for (std::size_t k = 0; k < frames.size();
       k = k + 1 < frames.size() ? std::min(k + stride, frames.size() - 1) : k + 1) {
    const ParticleFrame frame = read_particles(frames[k].file);
    const auto box = box_of(frame);
    options.box = options.box ? joined(*options.box, box) : box;
    const Range one = range_of(shade_of(frame, a.field).values);
    range = range ? Range{std::min((*range)[0], one[0]), std::max((*range)[1], one[1])} : one;
  }
  options.range = a.range.size() == 2 ? Range{a.range[0], a.range[1]} : range;
  if (!((*options.range)[1] > (*options.range)[0]))
    throw UsageError("--range: the first value must be below the second");
  return options;
}

// Runs a program without a shell's expansions in our names.
bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

int render_command(const Arguments& a) {
  const RunFolder run(a.folder);
  const auto frames = chosen(run.frames(), a.times);
  const PictureOptions options = common_options(frames, a);
  const std::filesystem::path folder = a.output.empty() ? a.folder / "pictures" : a.output;
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (refused) throw FileError("cannot create '" + folder.string() + "': " + refused.message());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%05zu.png", k);
    write_atomically(folder / name, picture(read_particles(frames[k].file), options));
  }
  std::printf("%zu pictures in %s\n", frames.size(), folder.c_str());
  if (!a.times.empty()) return done;
  const std::string film = folder.string() + ".mp4";
  if (!succeeds("command -v ffmpeg"))
    std::printf("no film: ffmpeg is not installed\n");
  else if (succeeds("ffmpeg -y -framerate " + std::to_string(a.rate) + " -i " +
                    quoted(folder.string() + "/frame_%05d.png") + " -pix_fmt yuv420p " + quoted(film)))
    std::printf("film: %s\n", film.c_str());
  else
    throw FileError("ffmpeg could not make '" + film + "'");
  return done;
}

}  // namespace tribo
