// SPDX-License-Identifier: MIT
/// Models whose summaries the tests look at.
#pragma once

#include "input/read.hpp"
#include "run/preflight.hpp"

#include <string>

namespace tribo::test {

/// The summary of a plane model of one block with parts of the command file replaced.
inline std::string one_block(const std::string& body = "<Rect xmin='4' xmax='8' ymin='2' ymax='6'/>",
                             const std::string& more = "", const std::string& grid = "<Horiz nx='20'/><Vert ny='10'/>",
                             const std::string& header = "", const std::string& others = "") {
  return preflight(read_model_text(R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime><GIMP/>)" +
                                       header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'>)" +
                                       grid + "</Grid></Mesh><MaterialPoints><Body matname='m'>" + body + "</Body>" +
                                       others + R"(</MaterialPoints>
 <Material Type='1' Name='m'><rho>1000</rho><E>1e6</E><nu>0</nu></Material>)" +
                                       more + "</JANFEAInput>",
                                   "deck.xml"),
                   1);
}

/// The summary of two blocks of 4 x 4 cells, the right one `gap` cells beside the left one.
inline std::string sheet(const std::string& gap, const std::string& header, const std::string& more = "",
                         const std::string& left_size = "4", const std::string& right_modulus = "1",
                         const std::string& left_law = "") {
  const std::string deck = R"(<JANFEAInput version='3'>
 <Header><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
 <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>0.25</ArchiveTime><GIMP/>)" +
                           header + R"(</MPMHeader>
 <Mesh><Grid xmin='0' xmax='20' ymin='0' ymax='10'><Horiz nx='20'/><Vert ny='10'/></Grid></Mesh>
 <MaterialPoints>
  <Body matname='left'><Rect xmin='4' xmax='8' ymin='2' ymax='2+'/></Body>
  <Body matname='right'><Deform dX=')" +
                           gap + R"('/><Rect xmin='8' xmax='12' ymin='2' ymax='6'/></Body>
 </MaterialPoints>
 <Material Type='1' Name='left'><rho>0.001</rho><E>1</E><nu>0</nu>)" +
                           left_law + R"(</Material>
 <Material Type='1' Name='right'><rho>0.001</rho><E>)" +
                           right_modulus + R"(</E><nu>0</nu></Material>)" + more + "</JANFEAInput>";
  std::string text = deck;
  text.replace(text.find("2+"), 2, std::to_string(2 + std::stoi(left_size)));
  return preflight(read_model_text(text, "deck.xml"), 1);
}
/// Contact without friction, for the header.
inline const std::string with_contact = "<MultiMaterialMode/>";

}  // namespace tribo::test
