#include "io/collada_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "absl/strings/str_join.h"
#include "clearway/base/parse_number.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Node = pugi::xml_node;

bool IsElement(Node node) { return node.type() == pugi::node_element; }

class GeometryReader {
 public:
  GeometryReader(ColladaText& text, Node mesh) : text_(text), mesh_(mesh) {}

  ColladaFaces Read() {
    ReadVertices();
    used_.resize(faces_.coordinates.size() / 3);
    for (const Node child : mesh_.children()) {
      const std::string_view name = child.name();
      if (!IsElement(child) || name == "source" || name == "vertices" || name == "extra") continue;
      ReadPrimitives(child);
    }
    if (const auto unused = std::ranges::count(used_, false); unused > 0 && text_.error.ok()) {
      text_.Refuse(mesh_, absl::StrCat(unused, " of ", used_.size(),
                                       " vertices belong to no face, the first of them vertex ",
                                       std::ranges::find(used_, false) - used_.begin(),
                                       ": a part seems to be missing (if not, remove them)"));
    }
    return std::move(faces_);
  }

 private:
  void ReadVertices() {
    const Node vertices = text_.Only(mesh_, "vertices");
    const auto is_position = [](Node input) {
      return std::string_view(input.attribute("semantic").value()) == "POSITION";
    };
    const auto inputs = vertices.children("input");
    const auto input = std::ranges::find_if(inputs, is_position);
    if (std::ranges::count_if(inputs, is_position) != 1) {
      return text_.Refuse(mesh_, "its <vertices> must have one input POSITION");
    }
    const Node source = text_.Referred(*input, "source", "source");
    const Node accessor = text_.Only(text_.Only(source, "technique_common"), "accessor");
    if (!accessor) return text_.Refuse(source, "it has no accessor");
    const Node array = text_.Referred(accessor, "source", "float_array");
    const std::vector<double> numbers = text_.Numbers(array, 0);
    if (text_.Whole(array, "count") != numbers.size()) {
      text_.Refuse(array, absl::StrCat("it states ", text_.Whole(array, "count"),
                                       " numbers and has ", numbers.size()));
    }
    const std::uint64_t count = text_.Whole(accessor, "count");
    const std::uint64_t stride = text_.WholeOr(accessor, "stride", 1);
    const std::uint64_t offset = text_.WholeOr(accessor, "offset", 0);
    const std::array<std::uint64_t, 3> places = PlacesOfXyz(accessor, stride);
    if (offset + count * stride > numbers.size()) {
      text_.Refuse(accessor, absl::StrCat("it states ", count, " vertices of ", stride,
                                          " numbers, and there are ", numbers.size()));
    }
    if (!text_.error.ok()) return;
    for (std::uint64_t i = 0; i < count; ++i) {
      for (const std::uint64_t place : places) {
        faces_.coordinates.push_back(numbers[offset + i * stride + place]);
      }
    }
  }

  // Where in a vertex its coordinates are: a param without a name is a number to be skipped.
  std::array<std::uint64_t, 3> PlacesOfXyz(Node accessor, std::uint64_t stride) {
    std::vector<std::string> names;
    std::vector<std::uint64_t> places;
    std::uint64_t place = 0;
    for (const Node param : accessor.children("param")) {
      const std::string name = param.attribute("name").value();
      if (!name.empty()) {
        names.push_back(name);
        places.push_back(place);
      }
      ++place;
    }
    if (names == std::vector<std::string>{"X", "Y", "Z"} && places.back() < stride) {
      return {places[0], places[1], places[2]};
    }
    text_.Refuse(accessor, absl::StrCat("its params are ", Quoted(absl::StrJoin(names, " ")),
                                        " of ", place, " and its stride is ", stride,
                                        "; they must be X, Y and Z, within the stride"));
    return {};
  }

  // How many numbers a corner has, and which of them is the vertex.
  struct Layout {
    std::uint64_t stride = 1, vertex = 0;
  };

  Layout LayoutOf(Node primitives) {
    Layout layout;
    int vertex_inputs = 0;
    for (const Node input : primitives.children("input")) {
      const std::uint64_t offset = text_.Whole(input, "offset");
      layout.stride = std::max(layout.stride, offset + 1);
      if (std::string_view(input.attribute("semantic").value()) != "VERTEX") continue;
      ++vertex_inputs;
      layout.vertex = offset;
      if (text_.Referred(input, "source", "vertices") != mesh_.child("vertices")) {
        text_.Refuse(input, "its source must be the vertices of the same geometry");
      }
    }
    if (vertex_inputs != 1) text_.Refuse(primitives, "it must have one input VERTEX");
    return layout;
  }

  // The vertices of a <p>, which is emptied of all other numbers.
  std::vector<std::uint32_t> Corners(Node p, Layout layout) {
    const std::string words = text_.Text(p);
    std::string_view rest = words;
    std::vector<std::uint32_t> corners;
    std::uint64_t number = 0;
    for (auto word = TakeWord(rest, " \t\r\n"); !word.empty() && text_.error.ok();
         word = TakeWord(rest, " \t\r\n"), ++number) {
      std::uint32_t index = 0;
      if (!ParseWhole(word, index)) {
        text_.Refuse(p, absl::StrCat(Quoted(word), " is not a whole number from 0 on"));
      }
      if (number % layout.stride != layout.vertex || !text_.error.ok()) continue;
      if (index >= used_.size()) {
        text_.Refuse(
            p, absl::StrCat("it names vertex ", index, " of ", used_.size(), " (the first is 0)"));
        break;
      }
      used_[index] = true;
      corners.push_back(index);
    }
    if (number % layout.stride != 0) {
      text_.Refuse(p,
                   absl::StrCat("it has ", number, " numbers, and a corner has ", layout.stride));
    }
    return corners;
  }

  void ReadPrimitives(Node primitives) {
    const std::string_view kind = primitives.name();
    constexpr std::string_view kKinds[] = {"triangles", "polylist", "polygons",  "trifans",
                                           "tristrips", "lines",    "linestrips"};
    if (std::ranges::find(kKinds, kind) == std::end(kKinds)) {
      return text_.Refuse(primitives, "it is not read: export triangles");
    }
    for (const Node child : primitives.children()) {
      const std::string_view name = child.name();
      if (!IsElement(child) || name == "input" || name == "p" || name == "extra") continue;
      if (name == "vcount" && kind == "polylist") continue;
      return text_.Refuse(child, "it is not read here: export triangles");
    }
    const std::uint64_t count = text_.Whole(primitives, "count");
    const Layout layout = LayoutOf(primitives);
    std::uint64_t lists = 0;
    const std::size_t before = faces_.sizes.size();
    for (const Node p : primitives.children("p")) {
      if (!text_.error.ok()) return;
      AddFaces(primitives, p, Corners(p, layout));
      ++lists;
    }
    // SketchUp states wrong numbers of lines.
    if (kind == "lines" || kind == "linestrips") return;
    const bool one_list = kind == "triangles" || kind == "polylist";
    const std::uint64_t found = one_list ? faces_.sizes.size() - before : lists;
    if (found != count || (one_list && lists > 1)) {
      text_.Refuse(primitives, absl::StrCat("it states ", count, one_list ? " faces" : " lists",
                                            " and has ", found, " in ", lists, " <p>"));
    }
  }

  void AddFaces(Node primitives, Node p, const std::vector<std::uint32_t>& corners) {
    const std::string_view kind = primitives.name();
    if (kind == "lines" || kind == "linestrips") return;
    if (kind == "polylist") return AddPolygons(primitives, p, corners);
    if (corners.size() < 3 && !(kind == "triangles" && corners.empty())) {
      return text_.Refuse(p, absl::StrCat("a face of ", corners.size(), " vertices"));
    }
    if (kind == "polygons") return AddFace(corners.begin(), corners.end());
    if (kind == "triangles" && corners.size() % 3 != 0) {
      return text_.Refuse(p, absl::StrCat(corners.size(), " corners, not a multiple of three"));
    }
    const std::size_t step = kind == "triangles" ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      std::array<std::uint32_t, 3> face = {corners[kind == "trifans" ? 0 : i], corners[i + 1],
                                           corners[i + 2]};
      if (kind == "tristrips" && i % 2 == 1) std::swap(face[0], face[1]);
      AddFace(face.begin(), face.end());
    }
  }

  void AddPolygons(Node primitives, Node p, const std::vector<std::uint32_t>& corners) {
    std::size_t next = 0;
    for (const double size : text_.Numbers(text_.Only(primitives, "vcount"), 0)) {
      if (!(size >= 3) || size != std::floor(size) ||
          size > static_cast<double>(corners.size() - next)) {
        return text_.Refuse(p, absl::StrCat("a face of ", size, " vertices at corner ", next,
                                            " of ", corners.size()));
      }
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(next);
      AddFace(first, first + static_cast<std::ptrdiff_t>(size));
      next += static_cast<std::size_t>(size);
    }
    if (next == corners.size()) return;
    text_.Refuse(p, absl::StrCat("it has ", corners.size(), " corners; vcount states ", next));
  }

  template <class It>
  void AddFace(It begin, It end) {
    faces_.sizes.push_back(static_cast<std::uint32_t>(end - begin));
    faces_.corners.insert(faces_.corners.end(), begin, end);
  }

  ColladaText& text_;
  const Node mesh_;
  ColladaFaces faces_;
  std::vector<bool> used_;
};

}  // namespace

ColladaFaces ReadColladaGeometry(ColladaText& text, Node geometry) {
  const Node mesh = geometry.child("mesh");
  for (const Node child : geometry.children()) {
    const std::string_view name = child.name();
    if (!IsElement(child) || child == mesh || name == "extra" || name == "asset") continue;
    text.Refuse(child, "it is not read: export one mesh of triangles");
  }
  if (!mesh) text.Refuse(geometry, "it has no mesh");
  if (!text.error.ok()) return {};
  return GeometryReader(text, mesh).Read();
}

}  // namespace clearway
