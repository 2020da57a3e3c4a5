// SPDX-License-Identifier: MIT
#include "solver/diagnose.hpp"

#include "base/bytes.hpp"
#include "base/ranks.hpp"

namespace tribo {

namespace {

// What is wrong with the first bad particle of this process; empty if it has none.
template <int Dim>
std::string bad_particle(const System<Dim>& system, const std::string& when) {
  for (const auto* bodies : {&system.bodies, &system.rigids})
    for (const auto& body : *bodies)
      for (std::size_t i = 0; i < body.particles.size(); ++i) {
        const Vec<Dim> x = body.particles.position(i), v = body.particles.velocity(i);
        const bool finite = x.allFinite() && v.allFinite();
        const bool inside = finite && (x.array() >= system.lattice.low.array()).all() &&
                            (x.array() <= system.lattice.high.array()).all();
        const double volume = body.particles.volume()[i];
        const bool crushed = finite && volume <= 0;
        if (inside && volume > 0) continue;
        std::string at;
        for (int d = 0; d < Dim; ++d) at += (d ? ", " : "") + std::to_string(x[d]);
        const std::string particle =
            "particle " + std::to_string(body.particles.id[i]) + " of '" + body.name + "' at (" + at + ")";
        if (finite && volume > 0 && bodies == &system.rigids)
          return particle + " left the grid" + when +
                 ": a rigid body must stay inside. Enlarge <Grid>, or end its motion earlier.";
        if (finite && volume > 0)
          return particle + " left the grid" + when +
                 ": it moves too far, or the run became unstable. Enlarge <Grid>, check the conditions that should "
                 "hold it, or return such particles with <LeaveLimit>.";
        return particle +
               (crushed ? " was compressed to no volume" : " has a velocity or strain that is not a number") + when +
               ": usually the step is too large for the present stiffness, or the material too soft for its load. Try "
               "a "
               "smaller <TimeFactor>, adaptive steps (custom task AdjustTimeStep), or more particles per cell, and "
               "check "
               "the units of stiffness, density and loads ('tribo check').";
      }
  return {};
}

// The first text of all ranks that is not empty.
std::string first_of_ranks(const std::string& mine) {
  ByteWriter own;
  own.list(std::vector<char>(mine.begin(), mine.end()));
  std::vector<std::byte> chosen = own.data;
  for (const auto& of_rank : ranks().gather(std::move(own.data)))
    if (ByteReader(of_rank).value<std::size_t>() > 0) {
      chosen = of_rank;
      break;
    }
  ranks().broadcast(chosen);
  const auto text = ByteReader(chosen).list<char>();
  return {text.begin(), text.end()};
}

}  // namespace

template <int Dim>
void stop_at_bad_particle(const System<Dim>& system) {
  const auto when = " in step " + std::to_string(system.step + 1) + " at time " + std::to_string(system.time);
  const std::string particle = first_of_ranks(bad_particle(system, when));
  throw CommonError(particle.empty() ? "a value on the grid is not a number" + when + "; try a smaller <TimeFactor>"
                                     : particle);
}

template void stop_at_bad_particle(const System<2>&);
template void stop_at_bad_particle(const System<3>&);

}  // namespace tribo
