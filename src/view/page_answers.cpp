// SPDX-License-Identifier: MIT
#include "view/page_answers.hpp"

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "view/picture.hpp"
#include "view/report.hpp"

#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace tribo {
namespace {

using Json = nlohmann::json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// The process that writes the run, if it is a running process of this user; else 0.
pid_t process_of(const Json& record) {
  if (!record.is_object()) return 0;
  const auto status = record.find("status"), process = record.find("process");
  if (status == record.end() || *status != "running" || process == record.end() || !process->is_number_integer())
    return 0;
  const auto pid = process->get<pid_t>();
  if (pid <= 1) return 0;
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", none);
  return program.filename().string().rfind("tribo", 0) == 0 ? pid : 0;
}

// Columns of a table but the first, which is the time, with at most so many rows.
Json columns_of(const ResultTable& table, const Legend& legend) {
  static constexpr std::size_t most_rows = 5000;
  Json out{{"times", Json::array()}, {"columns", Json::array()}};
  const std::size_t rows = table.rows(), stride = rows / most_rows + 1;
  const auto some = [&](const std::vector<double>& all) {
    std::vector<double> kept;
    for (std::size_t k = 0; k < rows; ++k)
      if (k % stride == 0 || k + 1 == rows) kept.push_back(all[k]);
    return kept;
  };
  if (rows == 0) return out;
  out["times"] = some(table.columns[0]);
  for (std::size_t k = 1; k < table.names.size(); ++k)
    out["columns"].push_back(
        {{"name", table.names[k]}, {"unit", legend.unit_of(table.names[k])}, {"values", some(table.columns[k])}});
  return out;
}

// The unit of energies is that of the kinetic energy, and so on.
std::string unit_in_ledger(const Legend& legend, const std::string& name) {
  if (name.starts_with("momentum") || name.starts_with("impulse")) return legend.unit_of("momentum_x");
  return legend.unit_of("kinetic");
}

}  // namespace

std::string PageAnswers::state() const {
  Json state = Json::parse(run_.provenance(), nullptr, false);
  if (!state.is_object()) state = Json::object();
  if (state.contains("status") && state["status"] == "running" && process_of(state) == 0) state["status"] = "lost";
  state["folder"] = run_.path().string();
  state["times"] = Json::array();
  for (const auto& frame : run_.frames()) state["times"].push_back(frame.time);
  return text_of(state);
}

std::string PageAnswers::frame(std::size_t k, const FrameRequest& request) {
  const auto known = cache_.scene(k);
  return frame_answer(*known, run_.legend(), request, *drawn_of(known, request.wanted));
}

std::shared_ptr<const Drawn> PageAnswers::drawn_of(const std::shared_ptr<const KnownScene>& known,
                                                   const Wanted& wanted) {
  const std::scoped_lock lock(mutex_);
  if (last_.scene != known || !(last_.wanted == wanted)) {
    last_.drawn = std::make_shared<const Drawn>(drawn(*known, wanted));
    last_.scene = known, last_.wanted = wanted;
  }
  return last_.drawn;
}

std::string PageAnswers::image(std::size_t k, const std::string& field) {
  const auto known = cache_.scene(k);
  const Legend legend = run_.legend();
  PictureOptions options;
  options.field = field.empty() ? default_field(known->scene) : field;
  options.unit = legend.unit_of(options.field), options.time_unit = legend.time, options.length_unit = legend.length;
  options.materials = legend.materials;
  return picture(known->scene, options);
}

std::string PageAnswers::range(const std::string& field) const {
  static constexpr std::size_t most_files = 12, most_particles = 12000000;
  const auto frames = run_.frames();
  std::size_t files = std::min(most_files, frames.size());
  std::optional<Range> range;
  std::optional<std::array<std::array<double, 3>, 2>> box;
  for (std::size_t k = 0; k < files; ++k) {
    const Scene scene = run_.scene(frames[files > 1 ? k * (frames.size() - 1) / (files - 1) : 0]);
    if (scene.particles.count() + scene.blocks.count() == 0) continue;
    // Of large models only the first file and a later one are read, so that the answer does not take long.
    if (k == 0)
      files = std::clamp(most_particles / (scene.particles.count() + 1), std::min<std::size_t>(2, files), files);
    extend(range, shade_of(scene, field).values);
    box = box ? joined(*box, box_of(scene)) : box_of(scene);
  }
  if (!box) throw FileError("the files hold no particles and no blocks");
  return text_of({{"range", widened(range)}, {"box", *box}});
}

std::string PageAnswers::tables() const {
  const Legend legend = run_.legend();
  const auto table = [&](const char* name, auto read) {
    return std::filesystem::exists(run_.path() / name) ? columns_of(read(), legend) : columns_of({}, legend);
  };
  Json energy = table("energy.csv", [&] { return run_.energy(); });
  for (auto& column : energy["columns"]) column["unit"] = unit_in_ledger(legend, column["name"].get<std::string>());
  return text_of({{"time_unit", legend.time},
                  {"history", table("history.csv", [&] { return run_.history(); })},
                  {"energy", std::move(energy)}});
}

std::string PageAnswers::layers() const {
  const auto file = run_.path() / "layers.json";
  return std::filesystem::exists(file) ? read_file(file) : "[]";
}

std::string PageAnswers::particle(std::size_t k, std::size_t index) {
  const auto known = cache_.scene(k);
  return text_of({{"picked", values_of(known->scene, run_.legend(), particle_at(known->scene, index))}});
}

std::string PageAnswers::block(std::size_t k, double number, const std::array<double, 3>& point) {
  const auto known = cache_.scene(k);
  const Legend legend = run_.legend();
  Json out{{"picked", values_of(known->scene, legend, {Picked::Kind::block, {number, 0.0}})}};
  if (const auto contact = contact_near(known->scene, point))
    out["contact"] = values_of(known->scene, legend, *contact);
  return text_of(out);
}

std::string PageAnswers::values(std::size_t k, const Picked& what) {
  return text_of(values_of(cache_.scene(k)->scene, run_.legend(), what));
}

std::string PageAnswers::charts() const { return report_charts(run_); }

std::string PageAnswers::history(const Picked& what) const { return text_of(history_of(run_, what)); }

bool PageAnswers::tell(int signal) const {
  const pid_t pid = process_of(Json::parse(run_.provenance(), nullptr, false));
  return pid > 0 && ::kill(pid, signal) == 0;
}

}  // namespace tribo
