#include "io/ply_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"
#include "io/ply_header.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxVertices = 20'000'000;

bool Fits(const PlyProperty& property, double value) {
  if (property.may_be_nan) return true;
  if (!property.is_index) return std::isfinite(value);
  return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() &&
         value == std::floor(value);
}

double TakeNumber(const PlyProperty& property, std::string_view word, PlyReader& reader) {
  double value = 0;
  if (!ParseNumber(word, value) || !Fits(property, value)) {
    reader.Fail(
        absl::StrCat("property ", property.name, ": '", PlyExcerpt(word), "' is not ",
                     property.is_index ? "an integer from 0 to 4294967295" : "a finite number"));
  }
  return value;
}

// Of each of the file's properties, which of the wanted ones it is.
using Places = std::vector<std::optional<std::size_t>>;

Places PlacesOf(std::span<const PlyProperty> wanted, const PlyElement& vertex, PlyReader& reader) {
  Places places(vertex.properties.size());
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    if (const auto place = PlyPropertyNamed(wanted[w].name, vertex, reader)) places[*place] = w;
  }
  return places;
}

void TakeVertex(std::span<const PlyProperty> wanted, const PlyElement& vertex, const Places& places,
                PlyReader& reader, double* row) {
  std::size_t count = 0;
  for (std::string_view word = reader.NextWord(); !word.empty(); word = reader.NextWord()) {
    const auto place = count < places.size() ? places[count] : std::nullopt;
    if (place) {
      row[*place] = TakeNumber(wanted[*place], word, reader);
    } else if (count < places.size()) {
      TakeNumber({vertex.properties[count].name.c_str()}, word, reader);
    }
    ++count;
  }
  if (count != places.size()) {
    reader.Fail(absl::StrCat(count, " numbers; the header has ", places.size(), " properties"));
  }
}

// One row after the other, without gaps.
void TakeBinary(std::span<const PlyProperty> wanted, const Places& places, const PlyElement& vertex,
                bool big_endian, PlyReader& reader, std::vector<double>& values) {
  std::size_t row_bytes = 0;
  for (const PlyElement::Property& property : vertex.properties) row_bytes += property.scalar.bytes;
  const std::uint64_t count = vertex.count, bytes = count * row_bytes, left = reader.rest().size();
  reader.EndLines();
  if (left < bytes) {
    return reader.FailCutOff(
        absl::StrCat(left, " bytes are left for ", count, " vertices of ", row_bytes));
  }
  if (left > bytes) {
    return reader.Fail(
        absl::StrCat(left - bytes, " bytes follow the last of ", count, " vertices"));
  }
  values.resize(count * wanted.size());
  const char* at = reader.rest().data();
  for (std::uint64_t row = 0; row < count; ++row) {
    for (std::size_t p = 0; p < places.size(); at += vertex.properties[p++].scalar.bytes) {
      if (!places[p]) continue;
      const double value = PlyNumberAt(at, vertex.properties[p].scalar, big_endian);
      values[row * wanted.size() + *places[p]] = value;
      if (Fits(wanted[*places[p]], value)) continue;
      return reader.Fail(absl::StrCat("vertex ", row, ", property ", wanted[*places[p]].name, ": ",
                                      NumberText(value),
                                      " is not a finite number, or not an index"));
    }
  }
}

void TakeAscii(std::span<const PlyProperty> wanted, const Places& places, const PlyElement& vertex,
               PlyReader& reader, std::vector<double>& values) {
  const std::uint64_t count = vertex.count;
  // A line has its end at least; so a header that promises more takes no memory.
  if (count > reader.rest().size()) {
    return reader.FailCutOff(
        absl::StrCat(reader.rest().size(), " bytes are left for ", count, " vertices"));
  }
  values.resize(count * wanted.size());
  std::uint64_t row = 0;
  for (; row < count && reader.NextLine(); ++row) {
    TakeVertex(wanted, vertex, places, reader, values.data() + row * wanted.size());
  }
  if (row < count) {
    reader.FailCutOff(absl::StrCat("it has ", row, " of ", count, " vertices"));
  } else if (!reader.rest().empty()) {
    reader.Fail(
        absl::StrCat(reader.rest().size(), " bytes follow the last of ", count, " vertices"));
  }
}

}  // namespace

absl::StatusOr<std::vector<double>> ReadPlyVertices(const std::filesystem::path& path,
                                                    std::span<const PlyProperty> properties,
                                                    std::vector<std::string>* names) {
  const absl::StatusOr<std::string> text = ReadWholeFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  PlyReader reader(path.string(), *text);
  const PlyHeader header = TakePlyHeader(reader, PlyContent::kVertices);
  if (!reader.ok()) return reader.status();
  const PlyElement& vertex = header.elements.front();
  if (vertex.count > kMaxVertices) {
    reader.FailExhausted(absl::StrCat(vertex.count, " vertices; the limit is ", kMaxVertices));
  }
  const Places places = PlacesOf(properties, vertex, reader);
  if (!reader.ok()) return reader.status();
  std::vector<double> values;
  if (header.format == PlyFormat::kAscii) {
    TakeAscii(properties, places, vertex, reader, values);
  } else {
    const bool big_endian = header.format == PlyFormat::kBigEndian;
    TakeBinary(properties, places, vertex, big_endian, reader, values);
  }
  if (!reader.ok()) return reader.status();
  if (names != nullptr) {
    names->clear();
    for (const PlyElement::Property& property : vertex.properties) names->push_back(property.name);
  }
  return values;
}

}  // namespace clearway
