// SPDX-License-Identifier: MIT
/// Joint laws along paths: what the driver itself does; the laws have tests of their own.

#include "input/read.hpp"
#include "output/number.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tribo;

namespace {

Table run(const std::string& content) {
  const ScratchFile file("drive.xml", "<JANFEAInput version='3'>" + content + "</JANFEAInput>");
  return std::visit([](const auto& what) { return drive(what); }, read_drive(file.path));
}
double at(const Table& table, std::size_t row, const std::string& name) {
  for (std::size_t k = 0; k < table.names.size(); ++k)
    if (table.names[k] == name) return table.rows[row][k];
  throw std::logic_error("no column " + name);
}
std::string problem(const std::string& content) {
  try {
    run(content);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

const std::string rock =
    "<Material Type='Mohr' Name='rock'><stiffness-normal>2e9</stiffness-normal><stiffness-shear>1e9</stiffness-shear>"
    "<friction>30</friction><friction-residual>30</friction-residual><dilation>10</dilation>"
    "<dilation-residual>10</dilation-residual><stress-normal>-1e6</stress-normal></Material>";

}  // namespace

TEST_CASE("increments of a path move a joint step by step", "[drive][joint]") {
  const Table out = run(
      "<Drive joint='rock' area='0.5'><Path>dt,steps,dn,dss,dst\n1,2,-1e-5,3e-5,\n1,1,,,-4e-5</Path></Drive>" + rock);
  REQUIRE(out.rows.size() == 4);
  CHECK(at(out, 0, "Fn") == Approx(-5e5));
  CHECK(at(out, 2, "Fn") == Approx(-5.2e5));
  CHECK(at(out, 3, "Fss") == Approx(-3e4));
  CHECK(at(out, 3, "Fst") == Approx(2e4));
  CHECK(at(out, 3, "gap") == Approx(-2e-5));
}

TEST_CASE("a prescribed force of a joint is attained in every step", "[drive][joint]") {
  const Table out = run(
      "<Drive joint='rock' area='0.5'><Path>dt,steps,dss,Fn\n1,100,1e-5,-7e5\n1,50,1e-5,-7e5</Path></Drive>" + rock);
  CHECK(at(out, 50, "Fn") == Approx(-6e5).epsilon(1e-9));
  CHECK(at(out, 150, "Fn") == Approx(-7e5).epsilon(1e-9));
  // what dilation presses in a step, shear feels in the next
  const double pressed = 1e9 * std::tan(std::numbers::pi / 18) * 1e-5;
  CHECK(at(out, 150, "Fss") == Approx(-(7e5 - pressed) * std::tan(std::numbers::pi / 6)).epsilon(1e-9));
  const Table shear = run("<Drive joint='rock' area='0.5'><Path>dt,steps,Fss,Fst\n1,10,-3e4,4e4</Path></Drive>" + rock);
  CHECK(at(shear, 10, "uss") == Approx(6e-5));
  CHECK(at(shear, 10, "ust") == Approx(-8e-5));
}

TEST_CASE("springs balance a joint, and a mass on it oscillates", "[drive][joint]") {
  const Table soft =
      run("<Drive joint='rock' area='0.5' spring-shear='5e8'><Path>dt,steps,dss\n1,10,1e-5</Path></Drive>" + rock);
  CHECK(at(soft, 10, "uss") == Approx(5e-5).epsilon(1e-9));  // half in the spring, half in the joint
  CHECK(at(soft, 10, "Sss") == Approx(2.5e4).epsilon(1e-9));
  // m = 1000 on k_s A = 5e8: a force of 1e4 causes an oscillation between 0 and 4e-5
  const double period = 2 * std::numbers::pi * std::sqrt(1000 / 5e8);
  const Table swing = run("<Drive joint='rock' area='0.5' block='1000'><Path>dt,steps,Pn,Pss\n" +
                          number_text(period / 2000) + ",1000,-5e5,1e4</Path></Drive>" + rock);
  CHECK(at(swing, 1000, "uss") == Approx(4e-5).epsilon(1e-3));
  CHECK(at(swing, 1000, "un") == Approx(0).margin(1e-12));
}

TEST_CASE("a joint follows the pore pressure of the path and of its function", "[drive][joint]") {
  const std::string wet =
      "<Material Type='Mohr' Name='rock'><stiffness-normal>2e9</stiffness-normal><stiffness-shear>1e9</stiffness-shear>"
      "<friction>30</friction><friction-residual>30</friction-residual><stress-normal>-1e6</stress-normal>";
  const double slope = std::tan(std::numbers::pi / 6);
  const Table path =
      run("<Drive joint='rock' area='0.5'><Path>dt,steps,dst,pressure\n1,100,-1e-5,\n1,4,-1e-5,4e5</Path></Drive>" +
          wet + "</Material>");
  CHECK(at(path, 100, "Fst") == Approx(5e5 * slope).epsilon(1e-9));
  CHECK(at(path, 102, "Fst") == Approx((5e5 - 0.5 * 2e5) * slope).epsilon(1e-9));
  CHECK(at(path, 104, "Fst") == Approx((5e5 - 0.5 * 4e5) * slope).epsilon(1e-9));
  CHECK(at(path, 104, "Fn") == Approx(-5e5));
  CHECK(at(path, 104, "stress_effective") == Approx(-6e5));
  const Table function = run("<Drive joint='rock' area='0.5'><Path>dt,steps,dst\n1,102,-1e-5</Path></Drive>" + wet +
                             "<pore-pressure-function>2e3*t</pore-pressure-function></Material>");
  CHECK(at(function, 102, "stress_effective") == Approx(-1e6 + 2e3 * 102));
  CHECK(at(function, 102, "Fst") == Approx(0.5 * (1e6 - 2e3 * 102) * slope).epsilon(1e-9));
}

TEST_CASE("problems of <Drive> for a joint are reported with their places", "[drive][joint]") {
  const auto tells = [](const std::string& content, const std::string& part) {
    INFO(content);
    CHECK_THAT(problem(content), Catch::Contains(part));
  };
  const std::string bond =
      "<Material Type='SpringNetwork' Name='bond'><compute-stiffness>emod 1e9</compute-stiffness></Material>";
  tells("<Drive joint='rack'><Path>dt,dn\n1,1</Path></Drive>" + rock, "did you mean 'rock'");
  tells("<Drive joint='rock' test='oedometer'/>" + rock, "does not belong to joint laws");
  tells("<Drive joint='rock' area='0'><Path>dt,dn\n1,1</Path></Drive>" + rock, "must be positive");
  tells("<Drive joint='bond'><Path>dt,dn\n1,1</Path></Drive>" + bond, "needs 'distance'");
  tells("<Drive joint='rock'><Path>dt,dn,Fn\n1,1,1</Path></Drive>" + rock, "dn and Fn");
  tells("<Drive joint='rock' block='1'><Path>dt,Fn\n1,1</Path></Drive>" + rock, "give the load Pn");
  tells("<Drive joint='rock' block='1'><Path>dt,dss\n1e-9,1</Path></Drive>" + rock, "'spring-shear'");
  tells("<Drive joint='rock'><Path>dt,Pn\n1,1</Path></Drive>" + rock, "Pn needs a 'block' or a spring");
  tells("<Drive joint='rock' block='1'><Path>dt,Pn\n1,1</Path></Drive>" + rock, "time step is too large");
  tells("<Drive joint='rock' vn='1'><Path>dt,dn\n1,1</Path></Drive>" + rock, "needs the mass 'block'");
  tells("<Drive joint='rock'><Path>dt,Fss\n1,1e9</Path></Drive>" + rock, "no motion balances the joint");
  tells(
      "<Drive material='steel' area='2' test='oedometer' strain='1'/><Material Type='LinearElastic' "
      "Name='steel'><rho>1</rho>"
      "<E>1</E><nu>0</nu></Material>",
      "'area' belongs to joint laws");
}
