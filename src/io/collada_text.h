// A COLLADA file as a tree, with errors that name the place.
#pragma once

#include <cstdint>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/first_error.h"

namespace clearway {

// The text of a COLLADA file and its elements by what they are and their id ("geometry#box").
struct ColladaText {
  std::string_view bytes;
  pugi::xml_document document;
  std::map<std::string, pugi::xml_node> by_id;
  FirstError error;

  // "line 7: triangles of geometry 'box': <why>".
  void Refuse(pugi::xml_node node, const std::string& why);
  // XML forbids that an element has an attribute twice; pugixml takes the first.
  void RefuseDoubledAttributes();
  // The child of that name, of which there may be one; null if there is none.
  pugi::xml_node Only(pugi::xml_node node, const char* name);
  // What the attribute "#box" of the node refers to; without an error if it is null.
  pugi::xml_node Referred(pugi::xml_node node, const char* attribute, const char* kind);
  // All words of the node's text, and those as finite numbers, `count` of them if that is not 0.
  std::string Text(pugi::xml_node node);
  std::vector<double> Numbers(pugi::xml_node node, std::size_t count);
  // As a whole number below 2^32.
  std::uint64_t Whole(pugi::xml_node node, const char* attribute);
  std::uint64_t WholeOr(pugi::xml_node node, const char* attribute, std::uint64_t otherwise);
};

}  // namespace clearway
