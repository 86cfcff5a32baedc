#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"
#include "io/mesh_content.h"
#include "io/mesh_lines.h"
#include "io/ply_scalar.h"

namespace clearway {
namespace {

struct Property {
  std::optional<PlyScalar> count;  // of a list's length
  PlyScalar scalar;
  bool is_corners = false;  // a face's list of vertices
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { kAscii, kLittleEndian, kBigEndian };

struct Header {
  std::optional<Format> format;
  std::vector<Element> elements;
};

absl::Status AtLine(int line, const std::string& why) {
  return absl::InvalidArgumentError(absl::StrCat("line ", line, ": ", why));
}

std::vector<std::string_view> WordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = TakeWord(line); !word.empty(); word = TakeWord(line)) words.push_back(word);
  return words;
}

// False for a line that is not of a header.
bool TakeProperty(const std::vector<std::string_view>& words, Header& header) {
  if (header.elements.empty() || (words.size() != 3 && words.size() != 5)) return false;
  Property property;
  if (words.size() == 5) {
    property.count = PlyScalarNamed(words[2]);
    if (words[1] != "list" || !property.count) return false;
  }
  const auto scalar = PlyScalarNamed(words[words.size() - 2]);
  if (!scalar) return false;
  property.scalar = *scalar;
  property.is_corners =
      property.count && (words.back() == "vertex_index" || words.back() == "vertex_indices");
  header.elements.back().properties.push_back(property);
  return true;
}

bool TakeHeaderLine(const std::vector<std::string_view>& words, Header& header) {
  if (words.empty()) return false;
  if (words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "property") return TakeProperty(words, header);
  if (words.size() != 3) return false;
  if (words[0] == "format" && words[2] == "1.0" && !header.format) {
    if (words[1] == "ascii") header.format = Format::kAscii;
    if (words[1] == "binary_little_endian") header.format = Format::kLittleEndian;
    if (words[1] == "binary_big_endian") header.format = Format::kBigEndian;
    return header.format.has_value();
  }
  if (words[0] != "element") return false;
  header.elements.push_back({std::string(words[1]), 0, {}});
  return ParseWhole(words[2], header.elements.back().count);
}

absl::StatusOr<Header> TakeHeader(TextLines& lines) {
  Header header;
  std::string_view line;
  if (!lines.Next(line) || Trimmed(line) != "ply") {
    return absl::InvalidArgumentError("it does not begin with 'ply'");
  }
  while (lines.Next(line)) {
    const auto words = WordsOf(line);
    if (words.size() == 1 && words[0] == "end_header") {
      if (header.format) return header;
      return AtLine(lines.number(), "the header has no format");
    }
    if (TakeHeaderLine(words, header)) continue;
    return AtLine(lines.number(),
                  absl::StrCat(Quoted(Trimmed(line)), " in the header is not understood"));
  }
  return AtLine(lines.number(), "the header does not end: the file is cut off");
}

// Yields the numbers of one element after the other.
class Numbers {
 public:
  Numbers(Format format, TextLines lines) : format_(format), lines_(lines), rest_(lines.rest()) {}

  // False if there is no further one.
  bool BeginElement() {
    if (format_ != Format::kAscii) return true;
    return lines_.Next(line_);
  }
  // False if there is none.
  bool Next(PlyScalar scalar, double& number) {
    if (format_ == Format::kAscii) return ParseNumber(TakeWord(line_), number);
    if (rest_.size() < scalar.bytes) return false;
    number = PlyNumberAt(rest_.data(), scalar, format_ == Format::kBigEndian);
    rest_.remove_prefix(scalar.bytes);
    return true;
  }
  // Whether the element has no more than was read of it.
  bool EndElement() { return format_ != Format::kAscii || Trimmed(line_).empty(); }
  // What follows the last element.
  std::size_t Rest() const {
    return format_ == Format::kAscii ? Trimmed(lines_.rest()).size() : rest_.size();
  }
  // "line 12: " in a text.
  std::string Where() const {
    return format_ == Format::kAscii ? absl::StrCat("line ", lines_.number(), ": ") : "";
  }

 private:
  Format format_;
  TextLines lines_;
  std::string_view line_, rest_;
};

class Content {
 public:
  Content(const Header& header, TextLines lines)
      : header_(header), numbers_(*header.format, lines) {
    for (const Element& element : header.elements) {
      if (element.name == "vertex") vertices_ = element.count;
    }
  }

  absl::StatusOr<FaceCount> Check() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) {
        if (const auto status = CheckElement(element, i); !status.ok()) return status;
      }
    }
    if (numbers_.Rest() > 0) {
      return Error(absl::StrCat(numbers_.Rest(), " bytes follow what the header states"));
    }
    return FaceCount(faces_);
  }

 private:
  absl::Status Error(const std::string& why) const {
    return absl::InvalidArgumentError(numbers_.Where() + why);
  }
  absl::Status CutOff(const Element& element, std::uint64_t i) const {
    return Error(absl::StrCat("the header states ", element.count, " of element ", element.name,
                              ", and the file has ", i, ": it is cut off"));
  }

  absl::Status CheckElement(const Element& element, std::uint64_t i) {
    if (!numbers_.BeginElement()) return CutOff(element, i);
    for (const Property& property : element.properties) {
      if (property.is_corners && element.name != "face") {
        return Error(absl::StrCat("element ", element.name,
                                  " lists vertices; only element face is read: export triangles"));
      }
      double number = 0, count = 1;
      if (property.count && !numbers_.Next(*property.count, count)) return Short(element, i);
      if (count < (property.is_corners ? 3 : 0) || count != std::floor(count)) {
        return Error(absl::StrCat(element.name, " ", i, " has a list of ", NumberText(count)));
      }
      for (double k = 0; k < count; ++k) {
        if (!numbers_.Next(property.scalar, number)) return Short(element, i);
        if (!property.is_corners || (number >= 0 && number < static_cast<double>(vertices_)))
          continue;
        return Error(absl::StrCat("face ", i, " names vertex ", NumberText(number), " of ",
                                  vertices_, " (the first is 0)"));
      }
      if (property.is_corners) ++faces_;
    }
    if (numbers_.EndElement()) return absl::OkStatus();
    return Error(absl::StrCat(element.name, " ", i, " has more numbers than the header states"));
  }

  // In a binary file nothing follows; in a text it may be one line.
  absl::Status Short(const Element& element, std::uint64_t i) const {
    if (*header_.format != Format::kAscii) return CutOff(element, i);
    return Error(absl::StrCat(element.name, " ", i, " of ", element.count,
                              " has fewer numbers than the header states"));
  }

  const Header& header_;
  Numbers numbers_;
  std::uint64_t vertices_ = 0, faces_ = 0;
};

}  // namespace

absl::StatusOr<FaceCount> CheckPlyContent(std::string_view bytes) {
  TextLines lines(bytes);
  const auto header = TakeHeader(lines);
  if (!header.ok()) return header.status();
  if (header->format == Format::kAscii) {
    if (auto status = CheckLastLine("the file", bytes, LastLine::kEnds); !status.ok()) {
      return status;
    }
  }
  return Content(*header, lines).Check();
}

}  // namespace clearway
