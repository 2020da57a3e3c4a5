// SPDX-License-Identifier: MIT
#include "drive/drive.hpp"
#include "input/read.hpp"
#include "tests/scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace tribo;

namespace {

std::string deck(const std::string& content) { return "<JANFEAInput version='3'>" + content + "</JANFEAInput>"; }

Drive read(const std::string& content) { return read_drive(ScratchFile("drive.xml", deck(content)).path); }

Table run(const std::string& content) {
  return std::visit([](const auto& what) { return drive(what); }, read(content));
}

std::string problem(const std::string& content) {
  try {
    run(content);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

double at(const Table& table, std::size_t row, const std::string& name) {
  for (std::size_t k = 0; k < table.names.size(); ++k)
    if (table.names[k] == name) return table.rows.at(row).at(k);
  throw std::runtime_error("no column " + name);
}
double last(const Table& table, const std::string& name) { return at(table, table.rows.size() - 1, name); }

const std::string soil =
    "<Material Type='MohrCoulomb' Name='soil'><rho>2000</rho><E>1e7</E><nu>0.3</nu><cohesion>5e3</cohesion>"
    "<friction>35</friction><dilation>5</dilation></Material>";
const std::string steel = "<Material Type='LinearElastic' Name='steel'><rho>1</rho><E>200</E><nu>0.25</nu></Material>";
const std::string rubber = "<Material Type='NeoHookean' Name='rubber'><rho>1</rho><E>3</E><nu>0.3</nu></Material>";
const std::string rubbing = "<Material Type='CoulombFriction' Name='rub'><coeff>0.3</coeff></Material>";

}  // namespace

TEST_CASE("a path is a table with columns in any order", "[drive]") {
  Problems problems;
  const auto rows =
      read_path("\n b, dt ,steps # comment\n1.5,0.1,3\n ,2,\n", Origin{}, {{"a"}, {"b", 10.0}}, 2.0, problems);
  REQUIRE(problems.empty());
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].dt == 0.2);
  CHECK(rows[0].steps == 3);
  CHECK(std::isnan(rows[0].value[0]));
  CHECK(rows[0].value[1] == 15.0);
  CHECK(rows[1].steps == 1);
  CHECK(std::isnan(rows[1].value[1]));
}

TEST_CASE("mixed control reaches prescribed stresses to 1e-10", "[drive]") {
  // Hooke's law in uniaxial stress: sigma = E eps, lateral strain -nu eps; the rate is that of the logarithmic strain.
  const Table bar = run("<Drive material='steel' test='uniaxial_stress' strain='1e-3' steps='7'/>" + steel);
  REQUIRE(bar.rows.size() == 8);
  CHECK(last(bar, "sxx") == Approx(0.2).epsilon(1e-10));
  CHECK(std::abs(last(bar, "syy")) < 1e-10 * 0.2);
  CHECK(last(bar, "eyy") == Approx(-0.25e-3).epsilon(1e-9));
  // all six components at once, and what strain Hooke's law gives for them
  const Table all =
      run("<Drive "
          "material='steel'><Path>dt,steps,sxx,syy,szz,sxy,syz,sxz\n0.5,4,0.3,-0.1,0.2,0.05,-0.02,0.01</Path></Drive>" +
          steel);
  const double E = 200, nu = 0.25, G = 80, sum = 0.4;
  CHECK(last(all, "exx") == Approx((0.3 * (1 + nu) - nu * sum) / E).epsilon(1e-9));
  CHECK(last(all, "eyy") == Approx((-0.1 * (1 + nu) - nu * sum) / E).epsilon(1e-9));
  CHECK(last(all, "exz") == Approx(0.01 / (2 * G)).epsilon(1e-9));
}

TEST_CASE("a prescribed shear stress determines the rate that is not prescribed", "[drive]") {
  const std::string path = "<Path>dt,steps,Lyx,sxy\n0.1,10,0,0.08</Path>";
  const Table simple = run("<Drive material='steel'>" + path + "</Drive>" + steel);
  CHECK(last(simple, "exy") == Approx(0.5e-3).epsilon(1e-6));
  CHECK_THAT(problem("<Drive material='steel'><Path>dt,Lxy,Lyx,sxy\n1,0,0,1</Path></Drive>" + steel),
             Catch::Contains("sxy and Lxy and Lyx"));
}

TEST_CASE("strength in triaxial compression and extension", "[drive]") {
  const double N = std::pow(std::tan(M_PI / 4 + 35 * M_PI / 360), 2), p = 1e5, cohesive = 2 * 5e3 * std::sqrt(N);
  const std::string end = "' strain='0.06' steps='300' pressure='1e5'/>" + soil;
  CHECK(last(run("<Drive material='soil' test='triaxial_compression" + end), "sxx") ==
        Approx(-(N * p + cohesive)).epsilon(1e-9));
  CHECK(last(run("<Drive material='soil' test='triaxial_extension" + end), "sxx") ==
        Approx(-(p - cohesive) / N).epsilon(1e-9));
}

TEST_CASE("laws that follow the deformation are driven with its exponential", "[drive]") {
  const Table shear = run("<Drive material='rubber' test='simple_shear' strain='0.8' steps='13'/>" + rubber);
  CHECK(last(shear, "sxy") == Approx(0.8 * 3 / 2.6).epsilon(1e-12));
  const Table volume = run("<Drive material='rubber' test='isotropic' strain='0.3' rate='2'/>" + rubber);
  CHECK(last(volume, "J") == Approx(std::exp(-0.3)).epsilon(1e-12));
  CHECK(last(volume, "time") == Approx(0.15));
  CHECK_THAT(
      problem("<Drive material='rubber' test='oedometer' strain='0.1'><InitialStress xx='-1'/></Drive>" + rubber),
      Catch::Contains("does not keep an initial stress"));
}

TEST_CASE("dissipated work heats the material, and heating reduces its strength", "[drive]") {
  const std::string hot =
      "<MPMHeader><StressFreeTemp>300</StressFreeTemp></MPMHeader><Thermal><EnergyCoupling/></Thermal>"
      "<Material Type='IsoPlasticity' "
      "Name='metal'><rho>8</rho><K>1e5</K><G>4e4</G><Cv>0.5</Cv><TaylorQuinney>0.9</TaylorQuinney>"
      "<Hardening>JohnsonCook</Hardening><Ajc>100</Ajc><Tmjc>1300</Tmjc></Material>";
  const Table out = run("<Drive material='metal' test='isotropic' strain='0.01'/>" + hot);
  CHECK(last(out, "temperature") == 300);  // nothing flows
  const Table shear = run("<Drive material='metal' test='simple_shear' strain='2' steps='20000'/>" + hot);
  const double work = last(shear, "dissipation"),
               left = std::exp(-0.9 * 100 * last(shear, "plastic_strain") / (4 * 1000));
  CHECK(last(shear, "temperature") == Approx(300 + 0.9 * work / 4));
  CHECK(last(shear, "temperature") == Approx(1300 - 1000 * left).epsilon(1e-5));
  const Table warm = run("<Drive material='metal' test='simple_shear' strain='0.1' temp='800'/>" + hot);
  CHECK(at(warm, 100, "sxy") == Approx(50 / std::sqrt(3.0)).epsilon(0.02));
}

TEST_CASE("a stress beyond the strength is refused with the row's place", "[drive]") {
  const std::string message =
      problem("<Drive material='soil'><Path>\ndt,steps,sxx,syy,szz\n1,5,-1e6,0,0</Path></Drive>" + soil);
  CHECK_THAT(message, Catch::Contains("no rate leads to the prescribed stress"));
  CHECK_THAT(message, Catch::Contains(":3:1"));
}

TEST_CASE("faces slide with the friction of their law for any mass", "[drive]") {
  for (const auto* mass : {"1e-3", "1", "1e5"}) {
    const Table out = run(std::string("<Drive contact='rub' mass='") + mass +
                          "'><Path>dt,steps,N,vt1,vt2\n0.1,5,100,0.3,-0.4\n0.1,1,50,-2,0</Path></Drive>" + rubbing);
    INFO(mass);
    CHECK(at(out, 5, "N") == Approx(100).epsilon(1e-9));
    CHECK(at(out, 5, "St1") == Approx(18).epsilon(1e-9));
    CHECK(at(out, 5, "St2") == Approx(-24).epsilon(1e-9));
    CHECK(at(out, 5, "dissipated") == Approx(30 * 0.5 * 0.5).epsilon(1e-9));
    CHECK(at(out, 6, "St1") == Approx(-15).epsilon(1e-9));
    CHECK(at(out, 6, "slip") == Approx(0.45).epsilon(1e-9));
  }
}

TEST_CASE("faces stick below their friction and cannot carry more", "[drive]") {
  const Table out = run("<Drive contact='rub'><Path>dt,N,St1\n0.1,100,29\n0.1,100,-29</Path></Drive>" + rubbing);
  CHECK(last(out, "St1") == Approx(-29).epsilon(1e-9));
  CHECK(last(out, "touch") == 1);
  CHECK(std::abs(last(out, "vt1")) < 1e-9);
  CHECK_THAT(problem("<Drive contact='rub'><Path>dt,N,St1\n0.1,100,31</Path></Drive>" + rubbing),
             Catch::Contains("no motion leads to"));
}

TEST_CASE("an interface follows its stiffnesses", "[drive]") {
  const Table out =
      run("<Drive contact='glue' mass='1e6'><Path>dt,steps,vn,vt1\n1e-3,100,0.5,0.2\n1e-3,200,-0.5,0.2</Path></Drive>"
          "<Material Type='LinearInterface' Name='glue'><Dnt>100</Dnt><Dnc>400</Dnc><Dt>50</Dt></Material>");
  CHECK(at(out, 100, "N") == Approx(-100 * at(out, 100, "dn")).epsilon(1e-9));
  CHECK(at(out, 100, "St1") == Approx(50 * at(out, 100, "dt1")).epsilon(1e-9));
  CHECK(last(out, "N") == Approx(-400 * last(out, "dn")).epsilon(1e-9));
  CHECK(last(out, "dn") == Approx(-0.05));
}

TEST_CASE("problems of <Drive> are reported with their places", "[drive]") {
  const auto tells = [](const std::string& content, const std::string& part) {
    INFO(content);
    CHECK_THAT(problem(content), Catch::Contains(part));
  };
  tells(steel, "no <Drive>");
  tells("<Drive/>" + steel, "one of the attributes 'material', 'contact' and 'joint'");
  tells("<Drive material='stel' test='oedometer' strain='1'/>" + steel, "did you mean 'steel'");
  tells("<Drive material='rub' test='oedometer' strain='1'/>" + rubbing + steel, "no material named 'rub'");
  tells("<Drive material='steel'/>" + steel, "needs <Path>");
  tells("<Drive material='steel' test='oedometer'/>" + steel, "needs 'strain'");
  tells("<Drive material='steel' test='oedometer' strain='1' pressure='3'/>" + steel, "confining 'pressure'");
  tells("<Drive material='steel' rate='2'><Path>dt,Lxx\n1,1</Path></Drive>" + steel, "belongs to a standard test");
  tells("<Drive material='steel'><Path>dt,Lxw\n1,1</Path></Drive>" + steel, "did you mean 'Lxx'");
  tells("<Drive material='steel'><Path>Lxx\n1</Path></Drive>" + steel, "needs the column 'dt'");
  tells("<Drive material='steel'><Path>dt,Lxx\n0,1</Path></Drive>" + steel, "must be positive");
  tells("<Drive material='steel'><Path>dt,Lxx\n1,1,2</Path></Drive>" + steel, "3 cells");
  tells("<Drive material='steel'><Path>dt,Lxx\n1,x</Path></Drive>" + steel, "'x' is no number");
  tells("<Drive material='steel'><Path>dt,Lxx,sxx\n1,1,1</Path></Drive>" + steel, "sxx and Lxx");
  tells("<Drive material='steel'><Path file='nowhere.csv'/></Drive>" + steel, "cannot read the file");
  tells("<Drive material='steel' test='oedometer' strain='1' temp='3'/>" + steel, "does not depend on temperature");
  tells("<Drive material='steel' test='oedometer' strain='1'/><Thermal><EnergyCoupling/></Thermal>" + steel, "<Cv>");
  tells("<Drive contact='rub' test='oedometer'/>" + rubbing, "belongs to materials");
  tells("<Drive contact='rub'><Path>dt,N,vn\n1,1,1</Path></Drive>" + rubbing, "vn and N");
}

TEST_CASE("a table that has something that is not a number is not written", "[drive]") {
  const double nan = std::nan("");
  CHECK(Table{{"time", "sxx"}, {{0, 1}, {1, 2}}}.text() == "time,sxx\n0,1\n1,2\n");
  CHECK_THROWS_AS((Table{{"time", "sxx"}, {{0, 1}, {0.5, nan}}}.text()), SimulationError);
  CHECK_THROWS_WITH((Table{{"time", "sxx"}, {{0, 1}, {0.5, HUGE_VAL}}}.text()),
                    Catch::Contains("'sxx'") && Catch::Contains("row 2") && Catch::Contains("time 0.5"));
}
