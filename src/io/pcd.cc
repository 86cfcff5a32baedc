#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"
#include "io/cloud_points.h"
#include "io/lzf.h"
#include "io/pcd_header.h"
#include "io/text_lines.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are little endian");

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;

// One number of each point, in bytes that outlive it.
struct Column {
  const char* begin = nullptr;
  std::uint64_t stride = 0;
  char type = 'F';
  std::uint64_t size = 4;

  template <class T>
  double As(std::uint64_t row) const {
    T value;
    std::memcpy(&value, begin + row * stride, sizeof value);
    return static_cast<double>(value);
  }
  double At(std::uint64_t row) const {
    if (type == 'F') return size == 4 ? As<float>(row) : As<double>(row);
    if (type == 'I') {
      return size == 1   ? As<std::int8_t>(row)
             : size == 2 ? As<std::int16_t>(row)
             : size == 4 ? As<std::int32_t>(row)
                         : As<std::int64_t>(row);
    }
    return size == 1   ? As<std::uint8_t>(row)
           : size == 2 ? As<std::uint16_t>(row)
           : size == 4 ? As<std::uint32_t>(row)
                       : As<std::uint64_t>(row);
  }
};

// x, y, z and, if asked for, the label.
using Wanted = std::vector<const PcdField*>;

absl::StatusOr<Wanted> FindWanted(const std::string& name, const PcdHeader& header,
                                  const std::string& label_field) {
  std::vector<std::string> names = {"x", "y", "z"};
  if (!label_field.empty()) names.push_back(label_field);
  Wanted wanted;
  for (const std::string& wanted_name : names) {
    const PcdField* const field = header.Find(wanted_name);
    if (field == nullptr) {
      return absl::InvalidArgumentError(
          absl::StrCat(name, ": no field ", wanted_name, "; it has ",
                       absl::StrJoin(header.fields, " ",
                                     [](std::string* out, const PcdField& f) { *out += f.name; })));
    }
    if (std::ranges::count(header.fields, wanted_name, &PcdField::name) > 1) {
      return absl::InvalidArgumentError(
          absl::StrCat(name, ": field ", wanted_name, " occurs twice"));
    }
    if (field->count != 1 || (wanted.size() < 3 && field->type != 'F')) {
      return absl::InvalidArgumentError(
          absl::StrCat(name, ": field ", wanted_name, " has ", field->count, " numbers of type ",
                       std::string(1, field->type), field->size, "; expected one",
                       wanted.size() < 3 ? ", F4 or F8" : ""));
    }
    wanted.push_back(field);
  }
  return wanted;
}

// Collects the points; the first bad label is kept.
class Builder {
 public:
  Builder(const std::string& name, std::uint64_t points) : name_(name) {
    cloud_.points_S.reserve(points);
    cloud_.labels.reserve(points);
  }

  void Add(const std::array<double, 4>& values, bool labelled) {
    const std::size_t i = cloud_.points_S.size();
    cloud_.points_S.push_back(Eigen::Vector3d(values[0], values[1], values[2]).cast<float>());
    cloud_.labels.push_back(labelled ? labels_.LabelOf(values[3], name_, i) : kStaticLabel);
  }
  absl::StatusOr<CloudPoints> Result() && {
    if (!labels_.status().ok()) return labels_.status();
    return std::move(cloud_);
  }

 private:
  const std::string& name_;
  LabelReader labels_;
  CloudPoints cloud_;
};

absl::StatusOr<CloudPoints> FromColumns(const std::string& name, std::uint64_t points,
                                        const std::vector<Column>& columns) {
  Builder builder(name, points);
  std::array<double, 4> values{};
  for (std::uint64_t row = 0; row < points; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) values[i] = columns[i].At(row);
    builder.Add(values, columns.size() > 3);
  }
  return std::move(builder).Result();
}

absl::Status WrongSize(const std::string& name, std::size_t bytes, const PcdHeader& header) {
  const std::uint64_t expected = header.points * header.row_bytes;
  return absl::InvalidArgumentError(absl::StrCat(name, ", byte ", header.begin, ": ", bytes,
                                                 " bytes for ", header.points, " points of ",
                                                 header.row_bytes, " bytes, which need ", expected,
                                                 bytes < expected ? "; the file is cut off" : ""));
}

// Writers that map pages, as PCL's once did, leave zeros behind the points, up to the page's end.
bool IsPadding(std::string_view bytes) {
  constexpr std::size_t kLargestPage = 65'536;
  return bytes.size() < kLargestPage && bytes.find_first_not_of('\0') == std::string_view::npos;
}

absl::StatusOr<CloudPoints> ReadBinary(const std::string& name, std::string_view bytes,
                                       const PcdHeader& header, const Wanted& wanted) {
  const std::uint64_t expected = header.points * header.row_bytes;
  if (bytes.size() < expected || !IsPadding(bytes.substr(expected))) {
    return WrongSize(name, bytes.size(), header);
  }
  std::vector<Column> columns;
  for (const PcdField* field : wanted) {
    columns.push_back(
        {bytes.data() + field->first_byte, header.row_bytes, field->type, field->size});
  }
  return FromColumns(name, header.points, columns);
}

// Two sizes of 32 bits, then each field of all points after the other.
absl::StatusOr<CloudPoints> ReadCompressed(const std::string& name, std::string_view bytes,
                                           const PcdHeader& header, const Wanted& wanted) {
  if (header.points == 0) return CloudPoints();
  std::uint32_t sizes[2];
  if (bytes.size() < sizeof sizes) return WrongSize(name, bytes.size(), header);
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  bytes.remove_prefix(sizeof sizes);
  if (sizes[1] != header.points * header.row_bytes) return WrongSize(name, sizes[1], header);
  if (sizes[0] > bytes.size() || !IsPadding(bytes.substr(sizes[0]))) {
    return absl::InvalidArgumentError(absl::StrCat(name, ", byte ", header.begin, ": ",
                                                   bytes.size(), " compressed bytes instead of ",
                                                   sizes[0], "; the file is cut off or damaged"));
  }
  const auto unpacked = UnpackLzf(bytes.substr(0, sizes[0]), sizes[1]);
  if (!unpacked) {
    return absl::InvalidArgumentError(absl::StrCat(name, ", byte ", header.begin,
                                                   ": the compressed points are damaged (no LZF)"));
  }
  std::vector<Column> columns;
  for (const PcdField* field : wanted) {
    columns.push_back({unpacked->data() + header.points * field->first_byte, field->size,
                       field->type, field->size});
  }
  return FromColumns(name, header.points, columns);
}

absl::StatusOr<CloudPoints> ReadAscii(const std::string& name, std::string_view text,
                                      const PcdHeader& header, const Wanted& wanted) {
  Builder builder(name, std::min<std::uint64_t>(header.points, text.size() / 2));
  std::array<double, 4> values{};
  std::uint64_t rows = 0;
  for (int line_number = header.lines + 1; !text.empty(); ++line_number) {
    const auto fail = [&](const std::string& why) {
      return absl::InvalidArgumentError(absl::StrCat(name, ", line ", line_number, ": ", why));
    };
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return fail("the line does not end; the file is cut off");
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    std::uint64_t words = 0;
    for (std::string_view word = TakeWord(line); !word.empty(); word = TakeWord(line), ++words) {
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i]->first_word != words) continue;
        if (ParseNumber(word, values[i])) continue;
        return fail(absl::StrCat("field ", wanted[i]->name, ": '", std::string(word.substr(0, 40)),
                                 "' is not a number"));
      }
    }
    if (words == 0) continue;
    if (words != header.row_words) {
      return fail(absl::StrCat(words, " numbers; the header has ", header.row_words));
    }
    if (++rows > header.points) {
      return fail(absl::StrCat("more than the ", header.points, " points of the header"));
    }
    builder.Add(values, wanted.size() > 3);
  }
  if (rows < header.points) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": ", rows, " points instead of ",
                                                   header.points, "; the file is cut off"));
  }
  return std::move(builder).Result();
}

}  // namespace

ObjectId LabelReader::LabelOf(double value, const std::string& where, std::size_t i) {
  // Of fields of 32 and of 16 bits.
  constexpr double kUnsignedMinusOne = std::numeric_limits<std::uint32_t>::max();
  constexpr double kShortMinusOne = std::numeric_limits<std::uint16_t>::max();
  constexpr double kMost = std::numeric_limits<ObjectId>::max();
  const bool is_minus_one = value == kUnsignedMinusOne || value == kShortMinusOne;
  if (std::isnan(value) || value < 0 || is_minus_one) return kIgnoreLabel;
  if (value <= kMost && value == std::floor(value)) return static_cast<ObjectId>(value);
  if (status_.ok()) {
    status_ = absl::InvalidArgumentError(
        absl::StrCat(where, ", point ", i, ": label ", NumberText(value),
                     " is not a whole number of at most ", std::numeric_limits<ObjectId>::max()));
  }
  return kIgnoreLabel;
}

absl::StatusOr<CloudPoints> ReadPcd(const std::filesystem::path& path,
                                    const std::string& label_field) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxBytes);
  if (!bytes.ok()) return bytes.status();
  const std::string name = path.string();
  const auto header = ParsePcdHeader(name, *bytes);
  if (!header.ok()) return header.status();
  const auto wanted = FindWanted(name, *header, label_field);
  if (!wanted.ok()) return wanted.status();
  const std::string_view data = std::string_view(*bytes).substr(header->begin);
  auto cloud = header->data == PcdData::kAscii    ? ReadAscii(name, data, *header, *wanted)
               : header->data == PcdData::kBinary ? ReadBinary(name, data, *header, *wanted)
                                                  : ReadCompressed(name, data, *header, *wanted);
  if (!cloud.ok()) return cloud;
  for (const PcdField& field : header->fields) cloud->fields.push_back(field.name);
  cloud->has_viewpoint = header->has_viewpoint;
  return cloud;
}

}  // namespace clearway
