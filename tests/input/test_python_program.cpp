// SPDX-License-Identifier: MIT
/// Scripts as Python programs. What they build is compared with the scripts in tests/python/test_gallery.py.
#include "input/read.hpp"
#include "input/script/python_text.hpp"
#include "input/script/script.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::script;
using Catch::Contains;

namespace {

std::string program_of(const std::string& commands) {
  return script_as_python("Analysis \"Plane Strain MPM\"\n" + commands, "folder/model.fmcmd", {});
}

}  // namespace

TEST_CASE("values and names of Python", "[script]") {
  CHECK(python_value("1e-3") == "1e-3");
  CHECK(python_value(".5") == ".5");
  CHECK(python_value("007") == "\"007\"");
  CHECK(python_value("0.5*t") == "\"0.5*t\"");
  CHECK(python_value("a \"b\" \\c") == "\"a \\\"b\\\" \\\\c\"");
  CHECK(python_value("one\ntwo") == "tribo.Expression(\"\\\"one\\\"&return&\\\"two\\\"\")");
  CHECK(python_value("") == "tribo.Expression(\"\")");
  CHECK(python_lines("a \"b\"") == "\"\"\"a \"b\\\"\"\"\"");
  CHECK(is_python_name("dp_mode"));
  for (const char* name : {"", "yield", "compute-stiffness", "2a", "with"}) CHECK_FALSE(is_python_name(name));
}

TEST_CASE("methods of tribo.Model for commands", "[script]") {
  CHECK(python_method("GridEdge") == "grid_edge");
  CHECK(python_method("MPMMethod") == "mpm_method");
  CHECK(python_method("CFLFactor") == "cfl_factor");
  CHECK(python_method("vel0X") == "vel0_x");
  CHECK(python_method("ContactMM") == "contact_mm");
  CHECK(python_method("XMLData") == "xml_data");
}

TEST_CASE("a long call has several lines", "[script]") {
  const std::vector<std::string> many(30, "\"argument\"");
  const std::string text = python_call("with m.stage", many, ":", 4);
  CHECK_THAT(text, Catch::StartsWith("    with m.stage(\"argument\", ") && Catch::EndsWith("):"));
  CHECK_THAT(text, Contains(",\n                 \"argument\""));
  CHECK(python_call("f", {}, "", 0) == "f()");
}

TEST_CASE("a script as a Python program", "[script]") {
  const std::string text = program_of(
      "Title \"A title\"\nConsistentUnits m,kg,s\n#n=2\nRepeat #k,1,#n\nGridBC\nRect 0,#k,0,1\nVelocity "
      "x,function,0.1*t\n"
      "EndGridBC\nEndRepeat\nMaterial \"s\",\"Steel\",\"LinearElastic\"\nrho 7800\nE 2e11\nnu 0.3\nDone\n"
      "Region \"s\",1,0,0.5\nRect 0,1,0,1\nCut Oval 0.2,0.4,0.2,0.4\nEndRegion\n");
  CHECK_THAT(
      text,
      Contains("m = tribo.Model(\"plane strain\", title=\"A title\", units=(\"m\", \"kg\", \"s\"), name=\"model\")"));
  CHECK_THAT(text,
             Contains("with m.grid_bc():\n    m.rect(0, 2, 0, 1)\n    m.velocity(\"x\", \"function\", \"0.1*t\")\n"));
  CHECK_THAT(text, Contains("m.material(\"s\", \"LinearElastic\", called=\"Steel\", rho=7800, E=2e11, nu=0.3)"));
  CHECK_THAT(
      text,
      Contains(
          "m.body(\"s\", tribo.rect(0, 1, 0, 1) - tribo.oval(0.2, 0.4, 0.2, 0.4), velocity=(1, 0), thickness=0.5)"));
  CHECK_THAT(text, Contains("if __name__ == \"__main__\":\n    m.run()\n"));
  CHECK_THAT(text, Contains("The model of model.fmcmd"));
}

TEST_CASE("problems of a script are found before it becomes a Python program", "[script]") {
  CHECK_THROWS_WITH(program_of("Regoin 1\n"), Contains("model.fmcmd:2:1"));
  CHECK_THROWS_WITH(program_of("Region \"s\",0,0\nEndRegion\n"), Contains("there is no material 's'"));
}
