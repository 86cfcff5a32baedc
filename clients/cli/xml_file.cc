#include "cli/xml_file.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "cli/json_file.h"
#include "cli/values.h"

namespace clearway::cli {

struct XmlText {
  std::string file, text;
  pugi::xml_document document;

  absl::Status Error(std::ptrdiff_t offset, const std::string& what) const {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
    return absl::InvalidArgumentError(
        absl::StrCat(file, ": line ", 1 + std::count(text.begin(), end, '\n'), ": ", what));
  }
};

absl::StatusOr<XmlElement> XmlElement::Load(const std::filesystem::path& file, const char* root) {
  auto text = ReadTextFile(file, "XML file");
  if (!text.ok()) return text.status();
  const auto xml = std::make_shared<XmlText>();
  xml->file = file.string();
  xml->text = *std::move(text);
  const auto parsed = xml->document.load_buffer(xml->text.data(), xml->text.size());
  if (!parsed) return xml->Error(parsed.offset, parsed.description());
  const pugi::xml_node outermost = xml->document.document_element();
  if (std::string(outermost.name()) != root) {
    return xml->Error(outermost.offset_debug(),
                      absl::StrCat("expected the element ", root, ", not ", outermost.name()));
  }
  return XmlElement(xml, outermost);
}

absl::Status XmlElement::Error(const std::string& what) const {
  std::string path;
  pugi::xml_node node = node_;
  for (; node.parent().type() == pugi::node_element && !node.attribute("id");
       node = node.parent()) {
    path = absl::StrCat(node.name(), path.empty() ? "" : "/", path);
  }
  std::string around = node.name();
  if (const auto id = node.attribute("id")) absl::StrAppend(&around, " ", id.value());
  return text_->Error(node_.offset_debug(),
                      absl::StrCat(around, ": ", path, path.empty() ? "" : ": ", what));
}

std::vector<XmlElement> XmlElement::Children() const {
  std::vector<XmlElement> children;
  for (const pugi::xml_node node : node_.children()) {
    if (node.type() == pugi::node_element) children.push_back(XmlElement(text_, node));
  }
  return children;
}

std::vector<XmlElement> XmlElement::Children(const char* name) const {
  std::vector<XmlElement> children = Children();
  std::erase_if(children, [&](const XmlElement& child) { return child.name() != name; });
  return children;
}

absl::StatusOr<XmlElement> XmlElement::Child(const char* name) const {
  if (!Has(name)) return Error(absl::StrCat(name, ": missing"));
  return XmlElement(text_, node_.child(name));
}

absl::StatusOr<double> XmlElement::Number() const {
  const auto number = ParseFinite(node_.child_value());
  if (number.ok()) return number;
  return Error(absl::StrCat("expected a number, not \"", node_.child_value(), "\""));
}

absl::StatusOr<double> XmlElement::Number(const char* child) const {
  const auto element = Child(child);
  if (!element.ok()) return element.status();
  return element->Number();
}

absl::StatusOr<double> XmlElement::NumberOr(const char* child, double otherwise) const {
  if (!Has(child)) return otherwise;
  return Number(child);
}

absl::StatusOr<double> XmlElement::NumberAttribute(const char* name) const {
  const auto number = ParseFinite(Attribute(name));
  if (number.ok()) return number;
  return Error(absl::StrCat(name, ": expected a number, not \"", Attribute(name), "\""));
}

}  // namespace clearway::cli
