// SPDX-License-Identifier: MIT
/// Models with stages for tests, and what their runs leave.
#pragma once

#include "input/read.hpp"
#include "run/block_run.hpp"
#include "run/grid_run.hpp"
#include "run/staged_run.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace tribo::test {

// A block of 4 x 4 on a floor, with a second material for later bodies.
inline std::string block_with(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  return R"(<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
  <MPMHeader>
    <MPMMethod>3</MPMMethod><GIMP/><Transfer type='APIC'/>
    <TimeStep>1</TimeStep><MaxTime>0.12</MaxTime><TimeFactor>0.4</TimeFactor><ArchiveTime>0.03</ArchiveTime>
    <GlobalArchiveTime>0.004</GlobalArchiveTime>
    <GlobalArchive type='syy' mat='1'/>)" +
         header + R"(
  </MPMHeader>
  <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='8'><Horiz nx='16'/><Vert ny='16' symmin='0'/></Grid></Mesh>
  <MaterialPoints><Body mat='1'><Rect xmin='2' xmax='6' ymin='0' ymax='4'/></Body></MaterialPoints>
  <Material Type='LinearElastic' Name='soil'><rho>1000</rho><E>1e6</E><nu>0.2</nu></Material>
  <Material Type='LinearElastic' Name='fill'><rho>500</rho><E>2e6</E><nu>0.2</nu></Material>
  <Gravity><BodyYForce>-10</BodyYForce></Gravity>)" +
         more + stages + "\n</JANFEAInput>";
}

inline Model staged_model(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  return read_model_text(block_with(stages, header, more), "stages.xml");
}

// The message of the reader about stages.
inline std::string message_of(const std::string& stages, const std::string& header = "", const std::string& more = "") {
  try {
    (void)staged_model(stages, header, more);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

// A run that has begun.
template <class Stepped>
std::unique_ptr<StagedRun<Stepped>> begun(const Model& model) {
  auto run = std::make_unique<StagedRun<Stepped>>(model);
  run->start();
  return run;
}

template <class Stepped>
void run_until(StagedRun<Stepped>& run, double time) {
  while (run.time() < time * (1 - 1e-12)) run.advance();
}

inline std::vector<std::string> differing(const Checkpoint& a, const Checkpoint& b) {
  std::vector<std::string> out;
  if (a.names() != b.names()) out.emplace_back("names of the entries");
  for (const auto& name : a.names())
    if (!b.has(name) || !a.same(b, name)) out.push_back(name);
  return out;
}

inline std::vector<double> column_of(const Checkpoint& state, const std::string& name) {
  return state.doubles("stepper.system.body0.particles." + name);
}

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream buffer;
  buffer << in.rdbuf();
  return buffer.str();
}

inline std::vector<std::vector<double>> rows_of(const std::filesystem::path& file) {
  std::vector<std::vector<double>> out;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    out.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) out.back().push_back(std::stod(field));
  }
  return out;
}

inline const std::string excavation =
    "<Stage at='0.03' name='dig'><Excavate><Rect xmin='2' xmax='6' ymin='2' ymax='4'/>"
    "</Excavate></Stage>";
inline const std::string refill =
    "<Stage at='0.06'><Body matname='fill'><Rect xmin='2' xmax='4' ymin='2.2' ymax='3.2'/></Body>"
    "<Material Name='soil'><E>5e5</E></Material></Stage>";
inline const std::string third =
    "<Stage at='0.09'><Gravity><BodyYForce>-5</BodyYForce></Gravity><Damping>10</Damping>"
    "<Stress xx='-50*x' add='yes'><Rect xmin='2' xmax='6' ymin='0' ymax='1'/></Stress>"
    "<ParticleBCs><BCShape><Rect xmin='2' xmax='6' ymin='1' ymax='2'/><net/><LoadBC dir='1' load='100'/></BCShape>"
    "</ParticleBCs></Stage>";

}  // namespace tribo::test
