#include "io/pcd_header.h"

#include <algorithm>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "clearway/base/parse_number.h"
#include "io/cloud_points.h"

namespace clearway {
namespace {

using Words = std::vector<std::string>;

constexpr std::uint64_t kMaxRowNumbers = 65'536;

// The lines of a header, by their first word.
struct Lines {
  std::map<std::string, Words> entries;
  std::map<std::string, int> numbers;  // of lines
  std::size_t end = 0;                 // byte behind DATA's
  int count = 0;
};

class Parser {
 public:
  explicit Parser(const std::string& name) : name_(name) {}

  absl::StatusOr<PcdHeader> Parse(std::string_view bytes) {
    if (auto status = Split(bytes); !status.ok()) return status;
    PcdHeader header;
    header.begin = lines_.end;
    header.lines = lines_.count;
    for (const absl::Status& status :
         {ReadFields(header), ReadPoints(header), ReadViewpoint(header), ReadData(header)}) {
      if (!status.ok()) return status;
    }
    return header;
  }

 private:
  absl::Status At(int line, const std::string& why) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ", line ", line, ": ", why));
  }
  absl::Status Fail(const std::string& key, const std::string& why) const {
    const auto line = lines_.numbers.find(key);
    if (line != lines_.numbers.end()) return At(line->second, absl::StrCat(key, ": ", why));
    return absl::InvalidArgumentError(absl::StrCat(name_, ": the header has no ", key));
  }
  bool Has(const std::string& key) const { return lines_.entries.contains(key); }
  const Words& Of(const std::string& key) const { return lines_.entries.at(key); }

  absl::Status Split(std::string_view bytes) {
    constexpr std::string_view kKeys[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                          "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    constexpr std::size_t kLongestLine = 1 << 20;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (bytes.starts_with(kByteOrderMark)) lines_.end = kByteOrderMark.size();
    while (!Has("DATA")) {
      const std::string_view rest = bytes.substr(lines_.end);
      const std::size_t length = rest.substr(0, kLongestLine).find('\n');
      ++lines_.count;
      if (length == std::string_view::npos) {
        return At(lines_.count, rest.empty()
                                    ? "the header ends without DATA; not a PCD file, or cut off"
                                    : "the line does not end; not a PCD file, or cut off");
      }
      lines_.end += length + 1;
      const std::string line(rest.substr(0, length));
      Words words = absl::StrSplit(line, absl::ByAnyChar(" \t\r"), absl::SkipEmpty());
      if (words.empty() || words[0].starts_with('#')) continue;
      std::string key = words[0] == "COLUMNS" ? "FIELDS" : words[0];  // as PCL did before 0.6
      if (std::ranges::find(kKeys, key) == std::end(kKeys)) {
        return At(lines_.count, absl::StrCat("'", key.substr(0, 40),
                                             "' is no entry of a PCD header; not a PCD file?"));
      }
      if (Has(key)) return At(lines_.count, absl::StrCat("a second ", key));
      words.erase(words.begin());
      lines_.numbers[key] = lines_.count;
      lines_.entries[key] = std::move(words);
    }
    return absl::OkStatus();
  }

  // As many whole numbers as there are fields.
  absl::StatusOr<std::vector<std::uint64_t>> Numbers(const std::string& key,
                                                     std::size_t count) const {
    if (!Has(key)) return Fail(key, "");
    const Words& words = Of(key);
    if (words.size() != count) {
      return Fail(key, absl::StrCat(words.size(), " values, expected ", count));
    }
    std::vector<std::uint64_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!ParseWhole(words[i], numbers[i])) {
        return Fail(key, absl::StrCat("'", words[i], "' is not a whole number"));
      }
    }
    return numbers;
  }

  absl::Status ReadFields(PcdHeader& header) const {
    if (!Has("FIELDS")) return Fail("FIELDS", "");
    const Words& names = Of("FIELDS");
    const auto sizes = Numbers("SIZE", names.size());
    if (!sizes.ok()) return sizes.status();
    auto counts =
        Has("COUNT") ? Numbers("COUNT", names.size()) : std::vector<std::uint64_t>(names.size(), 1);
    if (!counts.ok()) return counts.status();
    if (!Has("TYPE") || Of("TYPE").size() != names.size()) {
      return Fail("TYPE", absl::StrCat("expected ", names.size(), " values"));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& type = Of("TYPE")[i];
      const std::uint64_t size = (*sizes)[i], count = (*counts)[i];
      if (type != "F" && type != "I" && type != "U") {
        return Fail("TYPE", absl::StrCat("'", type, "' is not F, I or U"));
      }
      const bool known =
          type == "F" ? size == 4 || size == 8 : size == 1 || size == 2 || size == 4 || size == 8;
      if (!known) return Fail("SIZE", absl::StrCat(size, " bytes of type ", type));
      if (count < 1 || count > kMaxRowNumbers || header.row_words + count > kMaxRowNumbers) {
        return Fail("COUNT",
                    absl::StrCat("more than ", kMaxRowNumbers, " numbers a point, or none"));
      }
      header.fields.push_back({names[i], size, type[0], count, header.row_bytes, header.row_words});
      header.row_bytes += size * count;
      header.row_words += count;
    }
    return absl::OkStatus();
  }

  absl::Status ReadPoints(PcdHeader& header) const {
    const auto width = Numbers("WIDTH", 1), height = Numbers("HEIGHT", 1);
    if (!width.ok()) return width.status();
    if (!height.ok()) return height.status();
    const std::uint64_t w = width->front(), h = height->front();
    if (h != 0 && w > kMaxCloudPoints / h) {
      return absl::ResourceExhaustedError(absl::StrCat(name_, ": WIDTH ", w, " times HEIGHT ", h,
                                                       " points; the limit is ", kMaxCloudPoints));
    }
    header.points = w * h;
    if (!Has("POINTS")) return absl::OkStatus();
    const auto points = Numbers("POINTS", 1);
    if (!points.ok()) return points.status();
    if (points->front() == header.points) return absl::OkStatus();
    return Fail("POINTS", absl::StrCat(points->front(), ", but WIDTH ", w, " times HEIGHT ", h,
                                       " is ", header.points));
  }

  absl::Status ReadViewpoint(PcdHeader& header) const {
    if (!Has("VIEWPOINT")) return absl::OkStatus();
    const Words& words = Of("VIEWPOINT");
    if (words.size() != 7) {
      return Fail("VIEWPOINT", absl::StrCat(words.size(), " values, expected 7"));
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      double value = 0;
      if (!ParseNumber(words[i], value)) {
        return Fail("VIEWPOINT", absl::StrCat("'", words[i], "' is not a number"));
      }
      header.has_viewpoint |= value != (i == 3 ? 1 : 0);  // x y z, then a quaternion w x y z
    }
    return absl::OkStatus();
  }

  absl::Status ReadData(PcdHeader& header) const {
    const std::string kind = absl::StrJoin(Of("DATA"), " ");
    if (kind == "ascii") {
      header.data = PcdData::kAscii;
    } else if (kind == "binary") {
      header.data = PcdData::kBinary;
    } else if (kind == "binary_compressed") {
      header.data = PcdData::kCompressed;
    } else {
      return Fail("DATA", absl::StrCat("'", kind.substr(0, 40),
                                       "' is not ascii, binary or binary_compressed"));
    }
    return absl::OkStatus();
  }

  const std::string& name_;
  Lines lines_;
};

}  // namespace

const PcdField* PcdHeader::Find(const std::string& name) const {
  const auto found = std::ranges::find(fields, name, &PcdField::name);
  return found == fields.end() ? nullptr : &*found;
}

absl::StatusOr<PcdHeader> ParsePcdHeader(const std::string& name, std::string_view bytes) {
  return Parser(name).Parse(bytes);
}

}  // namespace clearway
