// SPDX-License-Identifier: MIT
/// Places in a command file with entities that contain elements.

#include "input/xml.hpp"

#include <catch2/catch.hpp>

using namespace tribo;

TEST_CASE("elements after an entity with elements have their own places", "[input]") {
  const std::string text =
      "<!DOCTYPE A [\n"
      "<!ENTITY two '<B k=\"1\">7</B><!-- <no/> --><B/>'>\n"
      "<!ENTITY less 'x&lt;y'>\n"
      "]>\n"
      "<A>\n"
      " &two;\n"
      " <C at='&less;'/> <D>\n  5</D>\n"
      "</A>\n";
  const Statement a = read_xml(text, std::make_shared<const std::string>("deck.xml"));
  REQUIRE(a.children.size() == 4);
  CHECK(a.children[0].origin.text() == "deck.xml:6:2");  // where the entity is used
  CHECK(a.children[0].attributes[0].origin.text() == "deck.xml:6:2");
  CHECK(a.children[0].text == "7");
  CHECK(a.children[1].origin.text() == "deck.xml:6:2");
  CHECK(a.children[2].origin.text() == "deck.xml:7:2");
  CHECK(a.children[2].attributes[0].origin.text() == "deck.xml:7:5");
  CHECK(a.children[2].attributes[0].text == "x<y");
  CHECK(a.children[3].origin.text() == "deck.xml:7:19");
  CHECK(a.children[3].text_origin.text() == "deck.xml:8:3");
}
