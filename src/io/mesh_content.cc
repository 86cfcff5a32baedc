#include "io/mesh_content.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Words = std::vector<std::string_view>;

// How many of the words, from the first given, are numbers.
std::size_t NumbersFrom(const Words& words, std::size_t first) {
  std::size_t count = 0;
  double ignored = 0;
  while (first + count < words.size() && ParseNumber(words[first + count], ignored)) ++count;
  return count;
}

// The vertices of an OBJ file that something is made of.
class ObjReferences {
 public:
  void AddVertex() { used_.push_back(false); }

  // "3/1/2", "-1//4" and so on: the number before the first slash counts from 1, or backwards.
  absl::Status Add(std::string_view word, const MeshLines& lines) {
    std::int64_t index = 0;
    const auto count = static_cast<std::int64_t>(used_.size());
    if (!ParseWhole(word.substr(0, word.find('/')), index) || index == 0) {
      return lines.Error(absl::StrCat(Quoted(word), " is not the number of a vertex"));
    }
    if (index > count || index < -count) {
      return lines.Error(absl::StrCat("vertex ", index, " is named; there are ", count, " so far"));
    }
    used_[static_cast<std::size_t>(index > 0 ? index - 1 : index + count)] = true;
    return absl::OkStatus();
  }

  absl::Status CheckAllUsed() const {
    const auto unused = std::ranges::count(used_, false);
    if (unused == 0) return absl::OkStatus();
    return absl::InvalidArgumentError(absl::StrCat(
        unused, " of ", used_.size(), " vertices belong to no face, the first of them vertex ",
        1 + (std::ranges::find(used_, false) - used_.begin()),
        ": the file seems cut off (if not, remove them)"));
  }

 private:
  std::vector<bool> used_;
};

// What says nothing about the shape, as far as assimp reads it.
bool IsObjRemark(std::string_view word) {
  constexpr std::string_view kRemarks[] = {
      "vt",    "vn",       "vp",       "g",          "o",        "s",
      "mg",    "usemtl",   "mtllib",   "usemap",     "maplib",   "lod",
      "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
  return std::ranges::find(kRemarks, word) != std::end(kRemarks);
}

absl::Status CheckObjLine(const Words& words, const MeshLines& lines, ObjReferences& vertices,
                          std::uint64_t& faces) {
  if (words[0] == "v") {
    if (NumbersFrom(words, 1) < 3) return lines.Error("expected three numbers after v");
    vertices.AddVertex();
    return absl::OkStatus();
  }
  if (words[0] != "f" && words[0] != "l" && words[0] != "p") {
    if (IsObjRemark(words[0])) return absl::OkStatus();
    return lines.Error(absl::StrCat(Quoted(words[0]), " is not read of OBJ files"));
  }
  if (words[0] == "f" && words.size() < 4) {
    return lines.Error(absl::StrCat("a face of ", words.size() - 1, " vertices"));
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (const auto status = vertices.Add(words[i], lines); !status.ok()) return status;
  }
  if (words[0] == "f") ++faces;
  return absl::OkStatus();
}

struct OffCounts {
  std::uint64_t vertices = 0, faces = 0;
  std::size_t numbers = 3;  // of a vertex
};

absl::StatusOr<OffCounts> TakeOffHeader(MeshLines& lines) {
  Words words;
  if (!lines.Next(words)) return absl::InvalidArgumentError("the file is empty");
  OffCounts counts;
  if (words[0].ends_with("OFF")) {
    if (words.size() == 2 && words[1] == "BINARY") {
      return lines.Error("OFF files that are binary are not read");
    }
    if (words[0].ends_with("4OFF")) counts.numbers = 4;
    words.erase(words.begin());
    if (words.empty() && !lines.Next(words)) return lines.Error("no counts: the file is cut off");
  }
  std::uint64_t edges = 0;
  if (words.size() < 3 || !ParseWhole(words[0], counts.vertices) ||
      !ParseWhole(words[1], counts.faces) || !ParseWhole(words[2], edges)) {
    return lines.Error("expected OFF, then the numbers of vertices, faces and edges");
  }
  return counts;
}

absl::Status CheckOffFace(const Words& words, const MeshLines& lines, std::uint64_t vertices) {
  std::uint64_t corners = 0, index = 0;
  if (!ParseWhole(words[0], corners) || corners == 0 || corners >= words.size()) {
    return lines.Error(
        absl::StrCat("a face of ", Quoted(words[0]), " vertices names ", words.size() - 1));
  }
  for (std::uint64_t i = 1; i <= corners; ++i) {
    if (ParseWhole(words[i], index) && index < vertices) continue;
    return lines.Error(absl::StrCat("a face names vertex ", Quoted(words[i]), " of ", vertices,
                                    " (the first is 0)"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<MeshContent> CheckObjContent(std::string_view bytes) {
  if (auto status = CheckLastLine("the file", bytes, LastLine::kEnds); !status.ok()) return status;
  MeshLines lines(bytes);
  ObjReferences vertices;
  std::uint64_t faces = 0;
  std::string reduced;  // assimp knows comments at the beginning of a line only
  for (Words words; lines.Next(words);) {
    const auto status = CheckObjLine(words, lines, vertices, faces);
    if (!status.ok()) return status;
    if (words.size() < 2) continue;
    for (const std::string_view word : words) reduced.append(word).append(1, ' ');
    reduced.back() = '\n';
  }
  if (auto status = vertices.CheckAllUsed(); faces > 0 && !status.ok()) return status;
  return MeshContent{.faces = faces, .parts = {}, .buffers = {}, .reduced = std::move(reduced)};
}

absl::StatusOr<FaceCount> CheckOffContent(std::string_view bytes) {
  if (auto status = CheckLastLine("the file", bytes, LastLine::kEnds); !status.ok()) return status;
  MeshLines lines(bytes);
  const auto counts = TakeOffHeader(lines);
  if (!counts.ok()) return counts.status();
  Words words;
  std::size_t each = 0;
  for (std::uint64_t i = 0; i < counts->vertices; ++i) {
    if (!lines.Next(words)) {
      return lines.Error(absl::StrCat("it states ", counts->vertices, " vertices and has ", i));
    }
    const std::size_t numbers = NumbersFrom(words, 0);
    if (i == 0) each = words.size();
    if (numbers < counts->numbers || words.size() != each) {
      return lines.Error(absl::StrCat("vertex ", i, " of ", counts->vertices, " has ", numbers,
                                      " numbers in ", words.size(), " words, the first has ",
                                      each));
    }
  }
  FaceCount faces = 0;
  for (std::uint64_t i = 0; i < counts->faces; ++i) {
    if (!lines.Next(words)) {
      return lines.Error(absl::StrCat("it states ", counts->faces, " faces and has ", i));
    }
    const auto status = CheckOffFace(words, lines, counts->vertices);
    if (!status.ok()) return status;
    if (words[0] != "1" && words[0] != "2") ++*faces;
  }
  if (!lines.Next(words)) return faces;
  return lines.Error(absl::StrCat("more than the stated ", counts->vertices, " vertices and ",
                                  counts->faces, " faces"));
}

absl::StatusOr<MeshContent> CheckMeshContent(const std::string& extension, std::string_view bytes) {
  if (extension == ".stl") return CheckStlContent(bytes);
  if (extension == ".obj") return CheckObjContent(bytes);
  if (extension == ".dae") return CheckDaeContent(bytes);
  if (extension == ".gltf") return CheckGltfContent(bytes);
  if (extension == ".glb") return CheckGlbContent(bytes);
  if (extension != ".off") {
    return absl::InvalidArgumentError(absl::StrCat(extension, " files are not checked"));
  }
  const auto faces = CheckOffContent(bytes);
  if (!faces.ok()) return faces.status();
  return MeshContent{.faces = *faces, .parts = {}, .buffers = {}, .reduced = {}};
}

}  // namespace clearway
