#include "io/collada_text.h"

#include <algorithm>
#include <cmath>

#include "clearway/base/parse_number.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Node = pugi::xml_node;

constexpr std::uint64_t kMaxWhole = 0xffffffff;

class DoubledAttributes : public pugi::xml_tree_walker {
 public:
  explicit DoubledAttributes(ColladaText& text) : text_(text) {}

  bool for_each(Node& node) override {
    for (const pugi::xml_attribute attribute : node.attributes()) {
      if (node.attribute(attribute.name()) == attribute) continue;
      text_.Refuse(node, absl::StrCat("it has the attribute ", attribute.name(), " twice"));
    }
    return text_.error.ok();
  }

 private:
  ColladaText& text_;
};

}  // namespace

void ColladaText::Refuse(Node node, const std::string& why) {
  if (!error.ok()) return;
  std::string place = absl::StrCat("<", node.name(), ">");
  Node around = node;
  while (around.parent() && !around.attribute("id")) around = around.parent();
  if (around.attribute("id")) {
    absl::StrAppend(&place, around == node ? " " : absl::StrCat(" of <", around.name(), "> "),
                    Quoted(around.attribute("id").value()));
  }
  const auto end =
      bytes.begin() + std::clamp<std::ptrdiff_t>(node.offset_debug(), 0, std::ssize(bytes));
  error.Set(absl::StrCat("line ", 1 + std::count(bytes.begin(), end, '\n'), ": ", place), why);
}

void ColladaText::RefuseDoubledAttributes() {
  DoubledAttributes walker(*this);
  document.traverse(walker);
}

Node ColladaText::Only(Node node, const char* name) {
  const Node child = node.child(name);
  if (child.next_sibling(name)) Refuse(child.next_sibling(name), "another one stands before it");
  return child;
}

Node ColladaText::Referred(Node node, const char* attribute, const char* kind) {
  if (!node) return node;
  const std::string url = node.attribute(attribute).value();
  const auto found = by_id.find(kind + url);
  if (!url.starts_with('#') || found == by_id.end()) {
    Refuse(node,
           absl::StrCat(attribute, " is ", Quoted(url), ", which is no <", kind, "> of this file"));
    return Node();
  }
  return found->second;
}

std::string ColladaText::Text(Node node) {
  std::string text;
  for (const Node child : node.children()) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
      text += child.value();
    } else if (child.type() == pugi::node_element) {
      Refuse(child, "elements cannot stand among numbers");
    }
  }
  return text;
}

std::vector<double> ColladaText::Numbers(Node node, std::size_t count) {
  const std::string text = Text(node);
  std::string_view rest = text;
  std::vector<double> numbers;
  double number = 0;
  for (auto word = TakeWord(rest, " \t\r\n"); !word.empty(); word = TakeWord(rest, " \t\r\n")) {
    if (!ParseNumber(word, number) || !std::isfinite(number)) {
      Refuse(node, absl::StrCat(Quoted(word), " is not a finite number"));
      break;
    }
    numbers.push_back(number);
  }
  if (count != 0 && numbers.size() != count) {
    Refuse(node, absl::StrCat("it has ", numbers.size(), " numbers; it must have ", count));
    numbers.resize(count);
  }
  return numbers;
}

std::uint64_t ColladaText::Whole(Node node, const char* attribute) {
  if (node && !node.attribute(attribute)) Refuse(node, absl::StrCat("it has no ", attribute));
  return WholeOr(node, attribute, 0);
}

std::uint64_t ColladaText::WholeOr(Node node, const char* attribute, std::uint64_t otherwise) {
  std::uint64_t number = 0;
  const std::string word = node.attribute(attribute).value();
  if (!node.attribute(attribute)) return otherwise;
  if (ParseWhole(word, number) && number <= kMaxWhole) return number;
  Refuse(node, absl::StrCat(attribute, " is ", Quoted(word), "; it must be from 0 to ", kMaxWhole));
  return 0;
}

}  // namespace clearway
