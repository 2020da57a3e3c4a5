// SPDX-License-Identifier: MIT
#include "input/read.hpp"
#include "input/script/evaluate.hpp"
#include "input/script/program.hpp"
#include "input/script/script.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tribo;
using namespace tribo::script;
using Catch::Contains;

namespace {

const script::Variables some{
    {"#a", 2.0}, {"#b", 3.0}, {"#name$", std::string("left ball")}, {"#list[2]", 7.0}, {"#i", 1.0}};

script::Piece piece(const std::string& text) { return {text, {std::make_shared<const std::string>("s"), 1, 1}}; }
double number(const std::string& text) { return std::get<double>(evaluate(piece(text), some)); }
std::string words(const std::string& text) { return printed(evaluate(piece(text), some)); }

// Runs a script. Throws InputError with the problems of its commands.
Script checked_script(const std::string& text, const std::string& name = "s") {
  Settings none;
  Script script = read_script(text, std::make_shared<const std::string>(name), none);
  script.problems.raise();
  return script;
}

// What a script writes, in a frame that makes it a whole file.
std::string output(const std::string& script) {
  static const std::string frame =
      "Analysis \"Plane Strain MPM\"\nArchiveTime 1\nMaximumTime 1\nGridHoriz 4\nGridVert 4\nGridRect 0,4,0,4\n"
      "Material \"m\",\"rubber\",\"Isotropic\"\nrho 1\nE 1\nnu .3\nDone\nRegion \"m\",0,0,1\nRect 1,2,1,2\nEndRegion\n";
  return checked_script(script + "\n" + frame).output;
}

// All that is wrong with a script.
std::string complaint(const std::string& script) {
  try {
    output(script);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("numbers of scripts", "[script]") {
  CHECK(number("1+2*3") == 7);
  CHECK(number("-2^2") == -4);
  CHECK(number("2^3^2") == 64);
  CHECK(number("2^-1") == 0.5);
  CHECK(number("7%4") == 3);
  CHECK(number("(#a+#b)*2") == 10);
  CHECK(number("#list[#i+1]") == 7);
  CHECK(number("sqrt(16)+SIN(0)") == 4);
  CHECK(number("cos(pi)") == -1);
  CHECK(number(".5e1") == 5);
  CHECK(number("round(2.345\\1)") == Approx(2.3));
  CHECK(number("length(\"four\")") == 4);
}

TEST_CASE("texts of scripts", "[script]") {
  CHECK(words("\"a\"&#a&\"b\"") == "a2b");
  CHECK(words("#a/#b") == "0.66666667");
  CHECK(words("(1000*#a)&\"*t\"") == "2000*t");
  CHECK(words("word(2\\#name$)") == "ball");
  CHECK(words("round(3.14159\" \"2)") == "3.14");
  CHECK(words("round(3.14159\\3)") == "3.142");
  CHECK(words("round(#a*1.3)") == "3");
  CHECK(words("chars(1\\4\\#name$)") == "left");
  CHECK(words("replace(\"l\"\\\"L\"\\#name$)") == "Left baLL");
  CHECK(words("upperCase(firstWord(#name$))") == "LEFT");
  CHECK(words("titleCase(#name$)") == "Left Ball");
  CHECK(words("removeFirstWord(#name$)&tab&lastWord(#name$)") == "ball\tball");
  CHECK(words("offset(\"b\"\\1\\#name$)") == "6");
  CHECK(argument(piece("velocity"), some) == "velocity");
  CHECK(argument(piece("3*t*x"), some) == "3*t*x");
  CHECK(argument(piece("0.1234567890123"), some) == "0.1234567890123");
  CHECK(argument(piece("#a/#b"), some) == "0.666666666666667");
}

TEST_CASE("conditions of scripts", "[script]") {
  CHECK(condition(piece("#a=2 && #b>2"), some));
  CHECK(condition(piece("#a=1 || #b>=3"), some));
  CHECK_FALSE(condition(piece("#a!=2"), some));
  CHECK(condition(piece("#name$=\"LEFT Ball\""), some));
  CHECK(condition(piece("#name$ is \"LEFT Ball\""), some));
  CHECK_FALSE(condition(piece("#name$==\"LEFT Ball\""), some));
  CHECK(condition(piece("#a"), some));
  CHECK(condition(piece("#a=1 && #b=3 || #a=2"), some));  // && first
}

TEST_CASE("conditions, loops and subroutines", "[script]") {
  CHECK(output("if 1=2\nWrite 1\nelse if 2=2\nWrite 2\nelse\nWrite 3\nendif") == "2");
  CHECK(output("Repeat #i,1,10,3\nWrite #i,\" \"\nEndRepeat") == "1 4 7 10 ");
  CHECK(output("Repeat #i,3,1,-1\nWrite #i\nEndRepeat") == "321");
  CHECK(output("Repeat #x,0,1,.1\nWrite \"x\"\nEndRepeat") == "xxxxxxxxxxx");
  CHECK(output("#n=0\nRepeat\n#n+=1\nif #n=2\ncontinue\nendif\nif #n>4\nbreak\nendif\nWrite #n\nEndRepeat") == "134");
  CHECK(output("Repeat #i,1,3\nRepeat #j,1,3\nif #j=2\nbreakAll\nendif\nWrite #i&#j\nEndRepeat\nEndRepeat") == "11");
  CHECK(
      output("Sub add,#x,#y\n#sum=#x+#y\nif #sum>5\nreturn\nendif\nWrite #sum\nEndSub\nGoSub add,1,2\nGosub add 3,4") ==
      "3");
  CHECK(output("ifDef #q\nWrite 1\nendif\n#q=1\nifDef #q\nWrite 2\nendif\nifNDef #r\nWrite 3\nendif") == "23");
  CHECK(output("#a[1]=5\n#a[2]=#a[1]*2\n#a[2]^=2\nWrite #a[2]\n#t$=\"x\"\n#t$&=\"y\"\nWrite #t$") == "100xy");
  CHECK(output("Lines #l,1,9,\"a\"&return&\"b\"\nWords #w,0,1,\"c d e\"\nWrite #l[2],#w[1]") == "bd");
  CHECK(output("Write \"! no comment\" ! a comment\nif 1!=2\nWrite \".\"\nendif") == "! no comment.");
}

TEST_CASE("all problems of a script are reported together with their places", "[script]") {
  CHECK_THAT(complaint("#a=1\n#b=#aa+1\n#c=#bb"),
             Contains("s:2:4: error: there is no variable '#aa' (did you mean '#a'?)") && Contains("s:3:4:"));
  CHECK_THAT(complaint("if 1=1\nWrite 1"), Contains("s:1:1: error: this 'if' is never closed by 'endif'"));
  CHECK_THAT(complaint("endif"), Contains("s:1:1: error: 'endif' without"));
  CHECK_THAT(complaint("Repeat #i,2,3\nfrobnicate\nEndRepeat"),
             Contains("s:2:1: error: there is no command 'frobnicate'") && Contains("with #i = 2"));
  CHECK_THAT(complaint("Sub s,#x\n#y=#x+#z\nEndSub\nGoSub s,1"),
             Contains("s:2:7: error: there is no variable '#z'") && Contains("called from s:4:1"));
  CHECK_THAT(complaint("Stop \"too \",\"slow\""), Contains("s:1:1: error: too slow"));
  CHECK_THAT(complaint("GrowCrack 1,2"), Contains("s:1:1: error: 'GrowCrack' belongs to a crack"));
  CHECK_THAT(complaint("Propagate \"max enery release\""),
             Contains("s:1:11: error: 'max enery release' is not known here (did you mean 'max energy release'?)"));
  CHECK_THAT(complaint("GridHorizz 3"), Contains("did you mean 'GridHoriz'"));
  CHECK_THAT(complaint("Repeat\nEndRepeat"), Contains("does not end"));
  CHECK_THAT(complaint("#a=(1"), Contains("s:1:6: error: ')' is missing"));
  CHECK_THAT(complaint("#a=\"x"), Contains("never closed"));
  CHECK_THAT(complaint("GlobalArchive material,\"m\",with,\"m\",type,contacty"),
             Contains("the first argument of 'GlobalArchive' is a quantity"));
  CHECK_THAT(complaint("GlobalArchive velx,\"ma\""), Contains("there is no material 'ma' (did you mean 'm'?)"));
  CHECK_THAT(complaint("Gosub nothing"), Contains("there is no subroutine 'nothing'"));
}

TEST_CASE("wrong names of materials and properties are reported besides wrong commands", "[script]") {
  const std::string materials = "Material \"gum\",\"Gum\",\"NeoHookean\"\nrhoo 1\nE 1\nDone\nAnalysis \"3D MPM\"\n";
  const std::string text = complaint(materials + "GridHorizz 3\nRegion \"gun\",0,0,0\nEndRegion");
  CHECK_THAT(text, Contains("s:2:1: error: <rhoo> is not a property of this material (did you mean 'rho'?)"));
  CHECK_THAT(text, Contains("s:6:1: error: there is no command 'GridHorizz'"));
  CHECK_THAT(text, Contains("s:7:8: error: there is no material 'gun' (did you mean 'gum'?)"));
  CHECK_THAT(text, Contains("error: 'Analysis' is given twice; first at s:5:"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
  CHECK_THAT(complaint("Material \"gum\",\"Gum\",\"Isotropic\"\nalpha 1\ndelIc 1\nDone\nGridHorizz 3"),
             Contains("'delIc': it belongs to a criterion for the growth of cracks that is not implemented") &&
                 !Contains("alpha"));
  // what was not reached may be what is missing
  CHECK_THAT(complaint("GlobalArchive velx,\"gum\"\nStop"), !Contains("there is no material"));
  // its properties and regions are right
  CHECK_THAT(complaint("Material \"gum\"\nGlobalArchive velx,\"gum\""), !Contains("there is no material"));
}

TEST_CASE("numbers that go into the model are finite", "[script]") {
  CHECK_THAT(complaint("Damping 1/0"), Contains("s:1:9: error: '1/0' is not a finite number"));
  CHECK_THAT(complaint("#a=-1\nDamping sqrt(#a)"), Contains("has no finite value"));
  CHECK(output("#a=1/0\nif #a>1e300\nWrite \"big\"\nendif") == "big");  // while it only compares, it may be infinite
}

TEST_CASE("the command line sets the first value of a variable", "[script]") {
  const auto file = std::make_shared<const std::string>("s");
  const std::string rest =
      "\nAnalysis \"Plane Strain MPM\"\nArchiveTime 1\nMaximumTime 1\nGridHoriz 4\nGridVert 4\nGridRect 0,4,0,4\n";
  Settings settings({{"border", "5"}, {"#name$", "two words"}, {"cell", "3"}});
  const auto script = read_script("#border=3\n#border+=2\n#name$=\"one\"\nWrite #border,#name$" + rest, file, settings);
  CHECK(script.output == "7two words");
  CHECK(settings.used("border"));
  CHECK_FALSE(settings.used("cell"));
  // A formula of numbers counts as its value, unless the variable is a text
  Settings formulas({{"cell", "10/4"}, {"date$", "1-2"}, {"name", "disc"}, {"wrong", "3/"}});
  const auto with_formulas = read_script(
      "#cell=1\n#date$=\"x\"\n#name=\"y\"\n#wrong=1\nWrite 2*#cell,#date$,#name,#wrong" + rest, file, formulas);
  CHECK(with_formulas.output == "51-2disc3/");
}

TEST_CASE("<Commands> adds to the sections of its file", "[script]") {
  const std::string text = R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
 <Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='8'><Horiz nx='8'/><Vert ny='8'/></Grid></Mesh>
 <Material Type='1' Name='left'><rho>1</rho><E>1</E><nu>.3</nu></Material>
 <MaterialPoints><Body matname='left'><Rect xmin='0' xmax='1' ymin='0' ymax='1'/></Body></MaterialPoints>
 <Commands><![CDATA[
  Material "r","right","Isotropic"
   rho 2
   E 1
   nu .3
  Done
  Repeat #i,1,3
   Region "r",#i,0,1
    Rect 2*#i,2*#i+1,4,5
   EndRegion
  EndRepeat
  GlobalArchive velx,"left"
  GlobalArchive velx,"r"
  GlobalArchive sxx,4.5,1/4
 ]]></Commands>
</JANFEAInput>)";
  const Model model = read_model_text(text, "deck.xml");
  REQUIRE(model.materials.size() == 2);
  REQUIRE(model.pieces.size() == 4);
  CHECK(model.pieces[0].material == 0);
  CHECK(model.pieces[3].material == 1);
  CHECK(model.pieces[3].velocity[0] == 3);
  CHECK(model.pieces[3].origin.line == 15);
  CHECK(model.output.history.at(0).column == "velx:left");
  CHECK(model.output.history.at(1).column == "velx:right");
  CHECK(model.output.history.at(2).column == "sxx:4.5,0.25");
  CHECK(model.output.history.at(2).point.value() == Vec3(4.5, 0.25, 0));

  std::string wrong = text;
  wrong.replace(wrong.find("Repeat #i,1,3"), 13, "Repeat #i,1,#n");
  CHECK_THAT(
      [&] {
        try {
          read_model_text(wrong, "deck.xml");
        } catch (const InputError& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      Contains("deck.xml:13:15: error: there is no variable '#n'"));
}

TEST_CASE("walls, planes of symmetry and periodic edges of scripts", "[script]") {
  const auto grid = [](const std::string& edges) {
    const std::string script =
        "Analysis \"Plane Strain MPM\"\nArchiveTime 1\nMaximumTime 1\n" + edges +
        "\nGridHoriz 4\nGridVert 4\nGridRect 0,4,0,4\nMaterial \"m\",\"rubber\",\"Isotropic\"\nrho 1\nE 1\nnu .3\n"
        "Done\nRegion \"m\",0,0,1\nRect 1,2,1,2\nEndRegion\n";
    return read_model_text(script, "deck.fmcmd").grid;
  };
  const auto walls = grid("GridEdge ymin,wall,1\nGridEdge xmax,symmetry,3\nGridEdge ymax,Wall,4");
  CHECK(walls.wall[1][0] == 1.0);
  CHECK(walls.wall[1][1] == 4.0);
  CHECK(walls.symmetry[0][1] == 3.0);
  CHECK(!walls.symmetry[0][0]);
  CHECK(!walls.periodic[0]);
  CHECK(grid("GridEdge X,periodic").periodic[0]);
  CHECK(grid("GridEdge ymin,wall,0\nGridEdge ymin,wall,1").wall[1][0] == 1.0);  // the last one counts

  CHECK_THAT(complaint("GridEdge low,wall,0"), Contains("the edge cannot be 'low'"));
  CHECK_THAT(complaint("GridEdge x,wall,0"), Contains("write xmin or xmax in place of x"));
  CHECK_THAT(complaint("GridEdge xmin,periodic"), Contains("write x in place of xmin"));
  CHECK_THAT(complaint("GridEdge xmin,wal,0"), Contains("did you mean 'wall'"));
  CHECK_THAT(complaint("GridEdge xmin,wall"), Contains("the coordinate of the wall is missing"));
  CHECK_THAT(complaint("GridEdge x,periodic,0"), Contains("a periodic axis has no coordinate"));
}

TEST_CASE("joint laws in scripts: keywords with hyphens, tables and methods", "[script]") {
  const Script script = checked_script(
      "Analysis \"3D MPM\"\nMaterial \"r\",\"Rock\",\"Mohr\"\nstiffness-normal 2e9\nslip-table 1,0,0.4,5e-4\nDone\n"
      "Material \"b\",\"Bond\",\"SpringNetwork\"\ncompute-stiffness emod,5e10\nbond\nDone\n",
      "joint.fmcmd");
  std::vector<const Statement*> materials;
  for (const auto& s : script.root.children)
    if (s.name == "Material") materials.push_back(&s);
  REQUIRE(materials.size() == 2);
  CHECK(materials[0]->child("stiffness-normal")->text == "2e9");
  CHECK(materials[0]->child("slip-table")->text == "1,0,0.4,5e-4");
  CHECK(materials[1]->child("compute-stiffness")->text == "emod,5e10");
  CHECK(materials[1]->child("bond")->text.empty());
}

TEST_CASE("the initial stress and XML of a body in a script", "[script]") {
  const auto body_with = [](const std::string& lines) {
    const std::string script =
        "Analysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\nMaximumTime 1\nGridHoriz 4\nGridVert 4\n"
        "GridRect 0,4,0,4\nMaterial \"m\",\"soil\",\"MohrCoulomb\"\nrho 1\nE 1\nnu .3\ncohesion 1\nfriction 0\nDone\n"
        "Region \"m\",0,0,1\n" +
        lines + "Rect 1,2,1,2\nEndRegion\n";
    const Statement root = checked_script(script).root;
    return *root.child("MaterialPoints")->child("Body");
  };
  const Statement by_command = body_with("InitialStress K0,0.5,yy,-1e4\n");
  const Statement by_xml = body_with("XMLData\n<InitialStress K0='0.5' yy='-1e4'/>\nEndXMLData\n");
  for (const Statement* body : {&by_command, &by_xml}) {
    REQUIRE(body->children.size() == 2);
    const Statement& stress = body->children[0];
    CHECK(stress.name == "InitialStress");
    CHECK(stress.attribute("K0")->text == "0.5");
    CHECK(stress.attribute("yy")->text == "-1e4");
    CHECK(body->children[1].name == "Rect");
  }
  CHECK_THROWS_WITH(body_with("InitialStress K0,0.5,yy\n"), Contains("pairs"));
  CHECK_THAT(complaint("InitialStress K0,0.5"), Contains("belongs into 'Region ... EndRegion'"));
  CHECK_THAT(complaint("GridBC\nXMLData\n<DisBC dir='1'/>\nEndXMLData"), Contains("needs a shape before it"));
}

TEST_CASE("a script names the liquid of LiquidContact by its id or number", "[script]") {
  const auto liquid = [](const std::string& id, const std::string& named) {
    const std::string script =
        "Analysis \"Plane Strain MPM\"\nConsistentUnits m,kg,s\nMaximumTime 1\nGridHoriz 4\nGridVert 4\n"
        "GridRect 0,4,0,4\nMaterial \"m\",\"rubber\",\"Isotropic\"\nrho 1\nE 1\nnu .3\nDone\n"
        "Material \"film\",\"Film\",\"LiquidContact\"\ncoeff 3\nLiquidPhase " +
        named + "\nDone\nMaterial \"" + id +
        "\",\"Oil\",\"TaitLiquid\"\nrho 1\nK 1\nviscosity 1\nDone\nRegion \"m\",0,0,1\nRect 1,2,1,2\nEndRegion\n";
    const Statement root = checked_script(script).root;
    for (const Statement& s : root.children)
      if (s.name == "Material" && s.child("LiquidPhase")) return s.child("LiquidPhase")->text;
    return std::string();
  };
  CHECK(liquid("oil", "\"oil\"") == "3");
  CHECK(liquid("oil", "oil") == "3");
  CHECK(liquid("oil", "3") == "3");
  CHECK(liquid("7", "7") == "3");  // an id that looks like a number
  CHECK_THROWS_WITH(liquid("oil", "\"oik\""), Contains("there is no material 'oik'") && Contains("oil"));
}
