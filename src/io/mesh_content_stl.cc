#include <cstdint>
#include <cstring>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"
#include "io/mesh_content.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

// An ASCII STL file, word by word.
class StlText {
 public:
  explicit StlText(std::string_view text) : lines_(text) {}

  absl::StatusOr<std::uint64_t> CountFacets() {
    while (NextWord()) {
      if (!Is("solid")) return Unexpected("solid");
      SkipLine();
      if (const auto status = CheckSolid(); !status.ok()) return status;
      SkipLine();
    }
    return facets_;
  }

 private:
  bool NextWord() {
    word_ = TakeWord(line_);
    while (word_.empty()) {
      if (!lines_.Next(line_)) return false;
      word_ = TakeWord(line_);
    }
    return true;
  }
  void SkipLine() { line_ = {}; }
  bool Is(std::string_view keyword) const {
    return absl::EqualsIgnoreCase(std::string(word_), std::string(keyword));
  }

  absl::Status CheckSolid() {
    while (NextWord() && !Is("endsolid")) {
      if (!Is("facet")) return Unexpected("facet or endsolid");
      if (const auto status = CheckFacet(); !status.ok()) return status;
      ++facets_;
    }
    return Is("endsolid") ? absl::OkStatus() : Unexpected("facet or endsolid");
  }

  absl::Status CheckFacet() {
    for (const char* const word :
         {"normal", "#", "#", "#", "outer",  "loop", "vertex", "#", "#",       "#",
          "vertex", "#", "#", "#", "vertex", "#",    "#",      "#", "endloop", "endfacet"}) {
      const bool number = *word == '#';
      double ignored = 0;
      if (!NextWord()) return Unexpected(number ? "a number" : word);
      if (number ? ParseNumber(word_, ignored) : Is(word)) continue;
      return Unexpected(number ? "a number" : word);
    }
    return absl::OkStatus();
  }

  absl::Status Unexpected(const std::string& expected) const {
    const std::string found = word_.empty() ? "the file is cut off" : "found " + Quoted(word_);
    return absl::InvalidArgumentError(absl::StrCat(
        "line ", lines_.number(), ": expected ", expected, " after ", facets_, " facets; ", found));
  }

  TextLines lines_;
  std::string_view line_, word_;
  std::uint64_t facets_ = 0;
};

constexpr std::size_t kStlHeaderBytes = 84, kStlFacetBytes = 50;

std::uint32_t StatedStlFacets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

// Keywords may be in upper case, and empty lines before the first; assimp takes neither.
absl::StatusOr<MeshContent> CheckText(std::string_view bytes) {
  const absl::StatusOr<std::uint64_t> facets = StlText(bytes).CountFacets();
  if (!facets.ok()) return facets.status();
  return MeshContent{.faces = *facets,
                     .parts = {},
                     .buffers = {},
                     .reduced = absl::AsciiStrToLower(absl::StripLeadingAsciiWhitespace(
                         absl::string_view(bytes.data(), bytes.size())))};
}

}  // namespace

bool IsWholeBinaryStl(std::string_view bytes) {
  return bytes.size() >= kStlHeaderBytes &&
         bytes.size() == kStlHeaderBytes + kStlFacetBytes * StatedStlFacets(bytes);
}

absl::StatusOr<MeshContent> CheckStlContent(std::string_view bytes) {
  if (IsWholeBinaryStl(bytes)) {
    return MeshContent{.faces = StatedStlFacets(bytes), .parts = {}, .buffers = {}, .reduced = {}};
  }
  const bool is_text = bytes.find('\0') == std::string_view::npos;
  const absl::string_view text =
      absl::StripLeadingAsciiWhitespace(absl::string_view(bytes.data(), bytes.size()));
  if (is_text && absl::StartsWithIgnoreCase(text, "solid")) return CheckText(bytes);
  if (bytes.size() < kStlHeaderBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("neither a text that begins with 'solid', nor a binary STL file: it has ",
                     bytes.size(), " bytes, and ", kStlHeaderBytes, " before its first facet"));
  }
  const std::uint64_t stated = StatedStlFacets(bytes);
  return absl::InvalidArgumentError(
      absl::StrCat("it states ", stated, " facets, ", kStlHeaderBytes + kStlFacetBytes * stated,
                   " bytes in all, and has ", bytes.size(), " bytes (",
                   (bytes.size() - kStlHeaderBytes) / kStlFacetBytes, " facets)"));
}

}  // namespace clearway
