// SPDX-License-Identifier: MIT
#include "run/effort.hpp"

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "run/contact_probe.hpp"
#include "run/results.hpp"
#include "run/schedule.hpp"
#include "run/step_size.hpp"
#include "run/trial_output.hpp"

#include <chrono>
#include <cmath>

namespace tribo {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

template <int Dim>
class Effort {
 public:
  Effort(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, double dt)
      : model_(model), system_(system), stepper_(stepper), dt_(dt) {}

  Remarks remarks() {
    const double files = file_times(Schedule(model_.output.archive), model_.time.end);
    const double steps = std::ceil(model_.time.end / dt_), output = output_seconds();
    std::string time;
    try {
      const double free = seconds_per_step(2);
      time = format("estimated time: %.3g s on %s, of which output %.2g s",
                    steps * (free + added_by_contact(free)) + output, counted(threads(), "thread").c_str(), output);
    } catch (const SimulationError& error) {
      time = "estimated time: unknown";
      out_.advice.push_back(std::string("a trial of some steps failed: ") + error.what());
    }
    out_.lines.push_back(format("memory: about %.3g MB", 1e-6 * bytes()));
    const double row = model_.output.double_precision ? 260 : 160;  // bytes of a particle, about
    out_.lines.push_back(format("particle files: %.0f, up to %.3g MB in all", files,
                                files * 1e-6 * row * static_cast<double>(particle_count(system_))));
    if (files > 2000) out_.advice.push_back(format("%.0f particle files: a larger <ArchiveTime>?", files));
    out_.lines.push_back(time);
    return std::move(out_);
  }

 private:
  // With the copies of a set of files and a checkpoint that wait to be written, and of former ones. Of large models
  // only parts are copied.
  double bytes() const {
    double sum = 0, saved = 0;
    for (const auto& body : system_.bodies) {
      const auto column = static_cast<double>(body.particles.size() * sizeof(double));
      const auto columns = static_cast<double>(body.particles.columns().size());
      sum += column * (columns + 3), saved += column * columns;
    }
    const bool whole = saved <= static_cast<double>(OutputQueue::usual_most_copied);
    const double waiting = whole ? bytes_of_files_ + saved : static_cast<double>(OutputQueue::most_of_parts),
                 sets = file_times(Schedule(model_.output.archive), model_.time.end);
    sum += waiting + std::min(static_cast<double>(OutputQueue::usual_limit), std::max(0.0, sets - 1) * waiting);
    for (const auto& field : system_.fields) sum += static_cast<double>(field.nodes.size() * sizeof(Node));
    return sum;
  }

  // Mean over some steps, within the time of the run.
  double seconds_per_step(int warm) {
    static constexpr double enough = 0.2;  // seconds
    static constexpr int least = 5, most = 200;
    const auto at_end = [&] { return !(system_.time < model_.time.end - dt_); };
    for (int k = 0; k < warm && !at_end(); ++k) stepper_.advance(dt_);
    const auto begin = Clock::now();
    int trial = 0;
    while (trial == 0 || (!at_end() && (trial < least || (seconds_since(begin) < enough && trial < most))))
      stepper_.advance(dt_), ++trial;
    return seconds_since(begin) / trial;
  }

  // Seconds per step, as a mean over the run. Where faces press and slide, the iteration for the impulses takes
  // longer, and faces are found anew more often, than where they just touch. A trial that fails says nothing.
  double added_by_contact(double free) {
    static constexpr double pressing = 0.004;  // speed of the bodies [cells per step]
    static constexpr int warm = 10;            // steps until the faces press
    if (!model_.contact.active) return 0.0;
    try {
      const double share = bring_into_contact(model_, system_);
      if (share == 0) return 0.0;
      press_bodies(system_, pressing * system_.lattice.smallest_spacing() / dt_);
      return share * std::max(0.0, seconds_per_step(warm) - free);
    } catch (const SimulationError&) {
      return 0.0;
    }
  }

  // Without a folder for scratch files the time of output is left out.
  double output_seconds() {
    try {
      const TrialFolder scratch;
      OutputQueue queue;
      Results<Dim> results(model_, system_, stepper_, scratch.path, std::nullopt, Tracers<Dim>(model_, system_), queue);
      const double seconds = seconds_of_output(
          model_.output, model_.time.end, [&] { results.write_files(0), queue.drain(); },
          [&] { results.write_history(dt_), queue.drain(); });
      bytes_of_files_ = static_cast<double>(queue.most_bytes_of_step());
      return seconds;
    } catch (const FileError&) {
      return 0.0;
    }
  }

  const Model& model_;
  System<Dim>& system_;
  Stepper<Dim>& stepper_;
  double dt_, bytes_of_files_ = 0;
  Remarks out_;
};

}  // namespace

template <int Dim>
Remarks describe_effort(const Model& model, System<Dim>& system, Stepper<Dim>& stepper, double dt) {
  return Effort<Dim>(model, system, stepper, dt).remarks();
}

template Remarks describe_effort(const Model&, System<2>&, Stepper<2>&, double);
template Remarks describe_effort(const Model&, System<3>&, Stepper<3>&, double);

}  // namespace tribo
