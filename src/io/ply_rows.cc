#include "io/ply_rows.h"

#include <algorithm>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"

namespace clearway {
namespace {

std::string RowName(const PlyElement& element, std::uint64_t i) {
  return absl::StrCat(PlyExcerpt(element.name), " ", i);
}

}  // namespace

void PlyRows::CheckEnd() {
  if (!reader_.ok()) return;
  std::string_view rest = reader_.rest();
  if (format_ == PlyFormat::kAscii) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n\v\f"), rest.size()));
  }
  if (rest.empty()) return;
  reader_.Fail(absl::StrCat(rest.size(), " bytes follow what the header states"));
}

std::uint64_t PlyRows::MaxRows(const PlyElement& element) const {
  std::size_t bytes = 0;
  for (const PlyElement::Property& property : element.properties) {
    // In ascii, a digit and what separates it from the next; a binary list may be empty.
    bytes += format_ == PlyFormat::kAscii ? 2 : property.count.value_or(property.scalar).bytes;
  }
  return reader_.rest().size() / std::max<std::size_t>(bytes, 1);
}

bool PlyRows::Begin(const PlyElement& element, std::uint64_t i) {
  if (!reader_.ok()) return false;
  if (format_ != PlyFormat::kAscii || reader_.NextLine()) return true;
  return FailCutOff(element, i);
}

bool PlyRows::TakeCount(const PlyElement& element, std::uint64_t i, PlyScalar scalar,
                        double& count) {
  if (!Take(scalar, count)) return FailShort(element, i);
  if (count >= 0 && count == std::floor(count)) return true;
  reader_.Fail(absl::StrCat(RowName(element, i), " has a list of ", NumberText(count)));
  return false;
}

bool PlyRows::Take(PlyScalar scalar, double& number) {
  if (format_ == PlyFormat::kAscii) return ParseNumber(reader_.NextWord(), number);
  if (reader_.rest().size() < scalar.bytes) return false;
  number = PlyNumberAt(reader_.rest().data(), scalar, format_ == PlyFormat::kBigEndian);
  reader_.Skip(scalar.bytes);
  return true;
}

bool PlyRows::End(const PlyElement& element, std::uint64_t i) {
  if (format_ == PlyFormat::kAscii && !reader_.NextWord().empty()) {
    reader_.Fail(absl::StrCat(RowName(element, i), " has more numbers than the header states"));
  }
  return reader_.ok();
}

bool PlyRows::FailCutOff(const PlyElement& element, std::uint64_t i) {
  reader_.FailWhole(absl::StrCat("the header states ", element.count, " of element ",
                                 PlyExcerpt(element.name), ", and the file has ", i,
                                 ": it is cut off"));
  return false;
}

// In a binary file nothing follows; in a text it may be one line.
bool PlyRows::FailShort(const PlyElement& element, std::uint64_t i) {
  if (format_ != PlyFormat::kAscii) return FailCutOff(element, i);
  reader_.Fail(absl::StrCat(RowName(element, i), " of ", element.count,
                            " has fewer numbers than the header states"));
  return false;
}

}  // namespace clearway
