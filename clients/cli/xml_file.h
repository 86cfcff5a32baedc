// Reads an XML file element by element; errors name the file, the line and the element.
#pragma once

#include <filesystem>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway::cli {

struct XmlText;

// One element of a file. It keeps the file's text.
class XmlElement {
 public:
  // INVALID_ARGUMENT if the file is no XML or its outermost element has another name.
  static absl::StatusOr<XmlElement> Load(const std::filesystem::path& file, const char* root);

  std::string name() const { return node_.name(); }
  std::string Attribute(const char* name) const { return node_.attribute(name).value(); }
  std::string Text() const { return node_.child_value(); }
  bool Has(const char* child) const { return !node_.child(child).empty(); }

  // "<file>: line 7: obstacle 12: shape/rectangle: <what>", counted from the last element around it
  // that has an id.
  absl::Status Error(const std::string& what) const;

  std::vector<XmlElement> Children() const;
  std::vector<XmlElement> Children(const char* name) const;
  // INVALID_ARGUMENT if there is none of that name.
  absl::StatusOr<XmlElement> Child(const char* name) const;
  // What the element, or the child of that name, or that attribute says: a finite number.
  absl::StatusOr<double> Number() const;
  absl::StatusOr<double> Number(const char* child) const;
  absl::StatusOr<double> NumberOr(const char* child, double otherwise) const;
  absl::StatusOr<double> NumberAttribute(const char* name) const;

 private:
  XmlElement(std::shared_ptr<const XmlText> text, pugi::xml_node node)
      : text_(std::move(text)), node_(node) {}

  std::shared_ptr<const XmlText> text_;
  pugi::xml_node node_;
};

}  // namespace clearway::cli
