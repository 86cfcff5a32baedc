#include "io/ply_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"
#include "io/ply_scalar.h"
#include "io/text_lines.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxVertices = 20'000'000;

// What of a bad line is worth showing.
std::string Excerpt(std::string_view text) {
  return std::string(text.substr(0, 40)) + (text.size() <= 40 ? "" : "...");
}

// A file while it is read, line by line; the first error is kept.
class Reader {
 public:
  Reader(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

  const absl::Status& status() const { return status_; }
  std::size_t left() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }

  // False at the end, or if the line does not end.
  bool NextLine() {
    const std::size_t end = rest_.find('\n');
    if (!status_.ok() || end == std::string_view::npos) return false;
    line_ = rest_.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    rest_.remove_prefix(end + 1);
    ++line_number_;
    return true;
  }

  // Of the line, which is used up.
  std::vector<std::string_view> TakeWords() {
    std::vector<std::string_view> words;
    for (std::string_view word = TakeWord(line_); !word.empty(); word = TakeWord(line_)) {
      words.push_back(word);
    }
    return words;
  }
  std::string_view NextWord() { return TakeWord(line_); }

  void Fail(const std::string& why) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(name_, ", line ", line_number_, ": ", why));
  }
  void FailEmpty() { status_ = absl::InvalidArgumentError(name_ + ": the file is empty"); }
  void FailCutOff(const std::string& why) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(name_, ": ", why, "; the file is cut off"));
  }
  void FailExhausted(const std::string& why) {
    if (!status_.ok()) return;
    status_ = absl::ResourceExhaustedError(absl::StrCat(name_, ": ", why));
  }

 private:
  std::string name_;
  std::string_view rest_, line_;
  int line_number_ = 0;
  absl::Status status_;
};

enum class Format { kAscii, kLittleEndian, kBigEndian };

struct Header {
  std::optional<Format> format;
  std::optional<std::uint64_t> vertices;
  std::vector<std::string> properties;
  std::vector<PlyScalar> scalars;  // of the properties
};

void TakeFormat(const std::vector<std::string_view>& words, Reader& reader, Header& header) {
  if (header.format) return reader.Fail("a second format");
  constexpr std::pair<std::string_view, Format> kFormats[] = {
      {"ascii", Format::kAscii},
      {"binary_little_endian", Format::kLittleEndian},
      {"binary_big_endian", Format::kBigEndian}};
  for (const auto& [name, format] : kFormats) {
    if (words.size() == 3 && words[1] == name && words[2] == "1.0") header.format = format;
  }
  if (header.format) return;
  reader.Fail(absl::StrCat("format ", words.size() > 1 ? Excerpt(words[1]) : "",
                           "; ascii, binary_little_endian and binary_big_endian 1.0 are read"));
}

void TakeElement(const std::vector<std::string_view>& words, Reader& reader, Header& header) {
  std::uint64_t count = 0;
  if (words.size() != 3 || words[1] != "vertex" || header.vertices) {
    return reader.Fail(absl::StrCat("expected one element, vertex, not '",
                                    words.size() > 1 ? Excerpt(words[1]) : "", "'"));
  }
  if (!ParseWhole(words[2], count)) {
    return reader.Fail(absl::StrCat("'", Excerpt(words[2]), "' is not a number of vertices"));
  }
  if (count > kMaxVertices) {
    reader.FailExhausted(absl::StrCat(count, " vertices; the limit is ", kMaxVertices));
  }
  header.vertices = count;
}

void TakeProperty(const std::vector<std::string_view>& words, Reader& reader, Header& header) {
  if (!header.vertices) return reader.Fail("a property of no element");
  const auto scalar = words.size() == 3 ? PlyScalarNamed(words[1]) : std::nullopt;
  if (!scalar) {
    return reader.Fail(absl::StrCat("expected a property that is one number, not '",
                                    words.size() > 1 ? Excerpt(words[1]) : "", "'"));
  }
  header.properties.emplace_back(words[2]);
  header.scalars.push_back(*scalar);
}

// Up to end_header.
Header TakeHeader(Reader& reader) {
  Header header;
  if (reader.left() == 0) {
    reader.FailEmpty();
  } else if (!reader.NextLine()) {
    reader.FailCutOff("its first line does not end");
  } else if (reader.TakeWords() != std::vector<std::string_view>{"ply"}) {
    reader.Fail("no PLY file: it does not begin with 'ply'");
  }
  while (reader.NextLine()) {
    const auto words = reader.TakeWords();
    const std::string_view key = words.empty() ? std::string_view() : words[0];
    if (key == "end_header") {
      if (!header.format) reader.Fail("no line 'format ascii 1.0', or of another format");
      if (!header.vertices) reader.Fail("no element vertex");
      return header;
    }
    if (key == "comment" || key == "obj_info") continue;
    if (key == "format") {
      TakeFormat(words, reader, header);
    } else if (key == "element") {
      TakeElement(words, reader, header);
    } else if (key == "property") {
      TakeProperty(words, reader, header);
    } else {
      reader.Fail(absl::StrCat("'", Excerpt(key), "' in the header"));
    }
  }
  reader.FailCutOff("the header does not end");
  return header;
}

bool Fits(const PlyProperty& property, double value) {
  if (property.may_be_nan) return true;
  if (!property.is_index) return std::isfinite(value);
  return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() &&
         value == std::floor(value);
}

double TakeNumber(const PlyProperty& property, std::string_view word, Reader& reader) {
  double value = 0;
  if (!ParseNumber(word, value) || !Fits(property, value)) {
    reader.Fail(
        absl::StrCat("property ", property.name, ": '", Excerpt(word), "' is not ",
                     property.is_index ? "an integer from 0 to 4294967295" : "a finite number"));
  }
  return value;
}

// Of each of the file's properties, which of the wanted ones it is.
using Places = std::vector<std::optional<std::size_t>>;

Places PlacesOf(std::span<const PlyProperty> wanted, const Header& header, Reader& reader) {
  Places places(header.properties.size());
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    const auto found = std::ranges::find(header.properties, wanted[w].name);
    if (found == header.properties.end()) {
      reader.Fail(absl::StrCat("the header ends without a property ", wanted[w].name, "; it has ",
                               absl::StrJoin(header.properties, " ")));
    } else if (std::ranges::count(header.properties, wanted[w].name) > 1) {
      reader.Fail(absl::StrCat("the header has property ", wanted[w].name, " twice"));
    } else {
      places[static_cast<std::size_t>(found - header.properties.begin())] = w;
    }
  }
  return places;
}

void TakeVertex(std::span<const PlyProperty> wanted, const Header& header, const Places& places,
                Reader& reader, double* row) {
  std::size_t count = 0;
  for (std::string_view word = reader.NextWord(); !word.empty(); word = reader.NextWord()) {
    const auto place = count < places.size() ? places[count] : std::nullopt;
    if (place) {
      row[*place] = TakeNumber(wanted[*place], word, reader);
    } else if (count < places.size()) {
      TakeNumber({header.properties[count].c_str()}, word, reader);
    }
    ++count;
  }
  if (count != places.size()) {
    reader.Fail(absl::StrCat(count, " numbers; the header has ", places.size(), " properties"));
  }
}

// One row after the other, without gaps.
void TakeBinary(std::span<const PlyProperty> wanted, const Places& places, const Header& header,
                Reader& reader, std::vector<double>& values) {
  std::size_t row_bytes = 0;
  for (const PlyScalar& scalar : header.scalars) row_bytes += scalar.bytes;
  const std::uint64_t count = *header.vertices, bytes = count * row_bytes;
  if (reader.left() < bytes) {
    return reader.FailCutOff(
        absl::StrCat(reader.left(), " bytes are left for ", count, " vertices of ", row_bytes));
  }
  if (reader.left() > bytes) {
    return reader.Fail(
        absl::StrCat(reader.left() - bytes, " bytes follow the last of ", count, " vertices"));
  }
  const bool big_endian = header.format == Format::kBigEndian;
  values.resize(count * wanted.size());
  const char* at = reader.rest().data();
  for (std::uint64_t row = 0; row < count; ++row) {
    for (std::size_t p = 0; p < places.size(); at += header.scalars[p++].bytes) {
      if (!places[p]) continue;
      const double value = PlyNumberAt(at, header.scalars[p], big_endian);
      values[row * wanted.size() + *places[p]] = value;
      if (Fits(wanted[*places[p]], value)) continue;
      return reader.Fail(absl::StrCat("vertex ", row, ", property ", wanted[*places[p]].name, ": ",
                                      NumberText(value),
                                      " is not a finite number, or not an index"));
    }
  }
}

void TakeAscii(std::span<const PlyProperty> wanted, const Places& places, const Header& header,
               Reader& reader, std::vector<double>& values) {
  const std::uint64_t count = *header.vertices;
  // A line has its end at least; so a header that promises more takes no memory.
  if (count > reader.left()) {
    return reader.FailCutOff(
        absl::StrCat(reader.left(), " bytes are left for ", count, " vertices"));
  }
  values.resize(count * wanted.size());
  std::uint64_t row = 0;
  for (; row < count && reader.NextLine(); ++row) {
    TakeVertex(wanted, header, places, reader, values.data() + row * wanted.size());
  }
  if (row < count) {
    reader.FailCutOff(absl::StrCat("it has ", row, " of ", count, " vertices"));
  } else if (reader.left() > 0) {
    reader.Fail(absl::StrCat(reader.left(), " bytes follow the last of ", count, " vertices"));
  }
}

}  // namespace

absl::StatusOr<std::vector<double>> ReadPlyVertices(const std::filesystem::path& path,
                                                    std::span<const PlyProperty> properties,
                                                    std::vector<std::string>* names) {
  const absl::StatusOr<std::string> text = ReadWholeFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  Reader reader(path.string(), *text);
  const Header header = TakeHeader(reader);
  const Places places = PlacesOf(properties, header, reader);
  if (!reader.status().ok()) return reader.status();
  std::vector<double> values;
  if (header.format == Format::kAscii) {
    TakeAscii(properties, places, header, reader, values);
  } else {
    TakeBinary(properties, places, header, reader, values);
  }
  if (names != nullptr) *names = header.properties;
  if (!reader.status().ok()) return reader.status();
  return values;
}

}  // namespace clearway
