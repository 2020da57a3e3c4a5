// SPDX-License-Identifier: MIT
/// Rigid blocks in scripts.
#include "input/read.hpp"
#include "input/script/commands.hpp"
#include "input/script/script.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tribo;
using Catch::Contains;

namespace {

// A script with these lines around and inside Blocks.
std::string script_of_blocks(const std::string& inside, const std::string& after = "",
                             const std::string& head = "Blocks lawname,\"dry\",damping,0.2") {
  return "Analysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\nTimeStep 1e-3,0.1\nArchiveTime 0.1\n"
         "Material \"dry\",\"Dry joint\",\"SpringNetwork\"\nkn 1e8\nks 1e8\nfric 0.5\nDone\n" +
         head + "\n" + inside + "EndBlocks\n" + after;
}

const std::string two_boxes =
    "BoxBlock name,\"base\",xmin,0,xmax,1,ymin,0,ymax,1,rho,2000\n"
    "BoxBlock name,\"top\",xmin,0,xmax,1,ymin,1,ymax,2,rho,2000\n";

Statement root_of_blocks(const std::string& text) {
  Settings none;
  Script script = read_script(text, std::make_shared<const std::string>("b"), none);
  script.problems.raise();
  return script.root;
}

// All that is wrong with a script when a model is made of it.
std::string complaint_of_blocks(const std::string& text) {
  try {
    read_model_text(text, "b");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string attribute_of(const Statement& s, const std::string& name) {
  const Attribute* a = s.attribute(name);
  return a ? a->text : "";
}

}  // namespace

TEST_CASE("Blocks of a script are elements of the table of keywords", "[script]") {
  const Statement root =
      root_of_blocks(script_of_blocks("Repeat #k,0,2\n  boxblock XMIN,#k,xmax,#k+1,ymin,0,ymax,1,rho,2000\nEndRepeat\n"
                                      "PolygonBlock rho,2000\n  PolyPt 0,2\n  PolyPt 1,2\n  PolyPt 0,3\n"
                                      "Joint lawname,\"dry\",blocks,\"a b\",with,any\n"
                                      "  Rect 0,1,0,1\n  Cut Oval 0.2,0.4,0.2,0.4\n  Cut Rect 0.6,0.8,0,1\n"
                                      "Load Fy,-10*t\n  PolyPt 0,0\n  PolyPt 1,0\n  PolyPt 0,1\n",
                                      "", "Blocks lawname,\"dry\",touchname,\"dry\""));
  const Statement* blocks = root.child("Blocks");
  REQUIRE(blocks);
  CHECK_FALSE(root.child("Mesh"));
  CHECK(attribute_of(*blocks, "law") == "1");                // by its number, as in all XML of scripts
  CHECK(attribute_of(*blocks, "touchname") == "Dry joint");  // which has a name only
  REQUIRE(blocks->children.size() == 6);
  CHECK(blocks->children[2].name == "BoxBlock");
  CHECK(attribute_of(blocks->children[2], "xmin") == "2");
  CHECK(attribute_of(blocks->children[2], "xmax") == "3");
  CHECK(blocks->children[3].children.size() == 3);
  const Statement& joint = blocks->children[4];
  CHECK(attribute_of(joint, "with") == "any");
  REQUIRE(joint.children.size() == 1);
  CHECK(joint.children[0].children.size() == 2);
  const Statement& load = blocks->children[5];
  CHECK(attribute_of(load, "Fy") == "-10*t");
  REQUIRE(load.children.size() == 1);
  CHECK(load.children[0].name == "Polygon");
}

TEST_CASE("a model of blocks and its histories from a script", "[script]") {
  const Model model = read_model_text(
      script_of_blocks(two_boxes + "Hold vx,0,vy,0,spinz,0\n  Rect 0,1,0,1\n",
                       "GlobalArchive dispy,block,\"top\"\nGlobalArchive \"kinetic energy\"\nGravity 0,-9.81\n"),
      "b");
  CHECK(model.only_blocks());
  const Statement root = root_of_blocks(
      script_of_blocks(two_boxes,
                       "GlobalArchive contactx,material,\"dry\",with,\"dry\"\nGlobalArchive dispy,Block,\"top\"\n"
                       "GlobalArchive velx,1,2\nGlobalArchive velx,material,-3\n"));
  const auto& histories = root.child("MPMHeader")->children;
  const auto at = histories.size() - 4;
  CHECK(attribute_of(histories[at], "material") == "1");
  CHECK(attribute_of(histories[at], "with") == "1");
  CHECK(attribute_of(histories[at + 1], "block") == "top");
  CHECK(attribute_of(histories[at + 2], "pt") == "1,2");
  CHECK(attribute_of(histories[at + 3], "material") == "-3");
}

TEST_CASE("nuclei of Voronoi cells in a script have three coordinates in space", "[script]") {
  const Statement root = root_of_blocks(
      "Analysis \"3D MPM\"\nBlocks\nVoronoi xmin,0,xmax,1,ymin,0,ymax,1,zmin,0,zmax,1,rho,1\nPolyPt 0.2,0.3,0.4\n"
      "XMLData\n  <Platen name='p'/>\nEndXMLData\nBox 0,1,0,1,0,1\nEndBlocks\n");
  const auto& lines = root.child("Blocks")->children;
  REQUIRE(lines.size() == 2);
  CHECK(attribute_of(lines[0].children.at(0), "z") == "0.4");
  CHECK(lines[1].children.at(0).name == "Box");
}

TEST_CASE("problems of blocks in a script", "[script]") {
  const auto wrong = [](const std::string& inside) { return complaint_of_blocks(script_of_blocks(inside)); };
  CHECK_THAT(wrong("BoxBlok xmin,0\n"), Contains("b:11:1") && Contains("did you mean 'BoxBlock'?"));
  CHECK_THAT(
      wrong(two_boxes + "Hold vx,0,spinn,0\n  Rect 0,1,0,1\n"),
      Contains("b:13:11") && Contains("'Hold' has no attribute 'spinn' (did you mean 'spinx'?); valid: blocks, vx"));
  CHECK_THAT(wrong(two_boxes + "Hold vx\n"), Contains("b:13:6") && Contains("the value of 'vx' is missing"));
  CHECK_THAT(wrong(two_boxes + "Hold vx,0,VX,1\n"), Contains("'VX' is given twice"));
  CHECK_THAT(wrong(two_boxes + "Ball x,0,y,3,radius,1\n"),
             Contains("b:13:1") && Contains("'Ball' needs the attribute 'rho'"));
  CHECK_THAT(wrong(two_boxes + "Ball x,0,y,3,radius,big,rho,1\n"), Contains("b:13:21"));
  CHECK_THAT(wrong("Rect 0,1,0,1\n"),
             Contains("belongs to a line before it: Joint or Platen or Pressure or Hold or Load"));
  CHECK_THAT(wrong(two_boxes + "PolyPt 0,1\n"), Contains("'PolyPt' inside 'Blocks' belongs to a line before it"));
  CHECK_THAT(wrong(two_boxes + "Hold vx,0\n  Rect 0,1,0,1\nHold vy,0\n  Cut Rect 0,1,0,1\n"),
             Contains("'Cut' needs a shape to cut from before it"));
  CHECK_THAT(wrong(two_boxes + "Joint lawname,\"dri\"\n"),
             Contains("there is no material 'dri' (did you mean 'dry'?)"));
  CHECK_THAT(wrong(two_boxes + "Region \"dry\",0,0\n"), Contains("'Region' inside 'Blocks'"));
  // a problem in a loop has its variables, and an error in a line does not give its shapes to the line before
  const std::string in_loop = wrong(two_boxes + "Repeat #k,1,2\nHold wx,#k\nRect 0,1,0,1\nEndRepeat\n");
  CHECK_THAT(in_loop, Contains("with #k = 1") && !Contains("belongs to a line"));
}

TEST_CASE("Blocks out of place in a script", "[script]") {
  const std::string good = script_of_blocks(two_boxes);
  CHECK(complaint_of_blocks(good).empty());
  CHECK_THAT(complaint_of_blocks(good.substr(0, good.size() - std::string("EndBlocks\n").size())),
             Contains("b:10:1") && Contains("this 'Blocks' is never closed"));
  CHECK_THAT(complaint_of_blocks(good + "EndBlocks\n"), Contains("'EndBlocks' closes nothing"));
  CHECK_THAT(complaint_of_blocks(good + "Blocks\nEndBlocks\n"), Contains("'Blocks' is given twice; first at b:10"));
  CHECK_THAT(complaint_of_blocks(good + "Platen name,\"p\"\n"),
             Contains("'Platen' belongs into 'Blocks ... EndBlocks'"));
  CHECK_THAT(complaint_of_blocks(script_of_blocks(two_boxes, "", "Blocks lawnam,\"dry\"")),
             Contains("'Blocks' has no attribute 'lawnam' (did you mean 'lawname'?)"));
  CHECK_THAT(complaint_of_blocks(good + "GlobalArchive dispy,blok,\"top\"\n"),
             Contains("'GlobalArchive' has no attribute 'blok' (did you mean 'block'?)"));
}

TEST_CASE("Blocks in a stage of a script", "[script]") {
  const std::string platens = two_boxes + "Platen name,\"top\",vy,-1e-3\n  Line 0,1,2,2,1e-6\n";
  const auto with_stage = [&](const std::string& inside) {
    return script_of_blocks(platens, "Stage 0.05,\"later\"\nBlocks damping,0.7\n" + inside + "EndBlocks\nEndStage\n");
  };
  const std::string text = with_stage("Platen name,\"top\",vy,0\n");
  const Statement root = root_of_blocks(text);
  const Statement* stage = root.child("Stage");
  REQUIRE(stage);
  REQUIRE(stage->children.size() == 2);
  CHECK(attribute_of(stage->children[0], "damping") == "0.7");
  CHECK(attribute_of(stage->children[1], "vy") == "0");
  CHECK(complaint_of_blocks(text).empty());
  CHECK_THAT(complaint_of_blocks(with_stage("Hold vx,0\n")), Contains("'Hold' cannot change in a stage"));
  CHECK_THAT(complaint_of_blocks(with_stage("Platen name,\"top\",vy,0\n  Line 0,1,2,2,1e-6\n")),
             Contains("a platen keeps the faces that it has"));
  CHECK_THAT(complaint_of_blocks(with_stage("Platen name,\"top\",rough,yes\n")),
             Contains("'Platen' has no attribute 'rough'"));
}

TEST_CASE("Blocks in the commands of an XML file", "[script]") {
  const std::string file =
      "<JANFEAInput version='3'><Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' "
      "time='s'/></Header>"
      "<MPMHeader><TimeStep>1e-3</TimeStep><MaxTime>0.1</MaxTime><ArchiveTime>0.1</ArchiveTime></MPMHeader>"
      "<Material Type='SpringNetwork' Name='dry'><kn>1e8</kn><ks>1e8</ks></Material>"
      "<Commands><![CDATA[\nBlocks lawname,\"dry\",touchname,\"none\"\n" +
      two_boxes + "EndBlocks\n]]></Commands></JANFEAInput>";
  const Statement root = read_statements_text(file, "b");
  CHECK(attribute_of(*root.child("Blocks"), "lawname") == "dry");
  CHECK(attribute_of(*root.child("Blocks"), "touchname") == "none");
  CHECK(read_model_text(file, "b").only_blocks());
}

TEST_CASE("XMLData may add blocks to those of the script", "[script]") {
  const Statement root = root_of_blocks(
      script_of_blocks(two_boxes, "XMLData Blocks\n  <Ball x='0' y='3' radius='1' rho='1'/>\nEndXMLData\n"));
  CHECK(root.child("Blocks")->children.size() == 3);
  const Statement whole = root_of_blocks(
      "Analysis \"Plane Strain MPM\"\nXMLData\n<Blocks damping='0.5'><Ball x='0' y='3' radius='1' "
      "rho='1'/></Blocks>\nEndXMLData\n");
  CHECK(attribute_of(*whole.child("Blocks"), "damping") == "0.5");
}

TEST_CASE("every element inside <Blocks> is a command", "[script]") {
  for (const char* name :
       {"Voronoi", "BoxBlock", "PolygonBlock", "Ball", "Joint", "Platen", "Pressure", "Hold", "Load"}) {
    const auto& all = script::commands();
    const auto same = std::count_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    CHECK(same == 1);
    CHECK(script::find_element_of_blocks(name));
  }
  CHECK_FALSE(script::find_element_of_blocks("Rect"));
}
