#include "io/octomap_header.h"

#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";
constexpr std::size_t kMaxLine = 4096;

bool StartsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

template <class T>
bool ParseWhole(std::string_view text, T& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

// Reads the lines up to "data".
class HeaderParser {
 public:
  HeaderParser(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {}

  absl::StatusOr<OctomapHeader> Parse() {
    absl::StatusOr<std::string_view> line = NextLine();
    if (!line.ok()) return line.status();
    // The binary magic is not a prefix of the other, nor the other way round.
    if (StartsWith(*line, kBinaryMagic)) {
      header_.format = OctomapFormat::kBinary;
    } else if (StartsWith(*line, kFullMagic)) {
      header_.format = OctomapFormat::kFull;
    } else {
      return Fail("does not start with \"# Octomap OcTree\": no OctoMap file");
    }
    while (true) {
      line = NextLine();
      if (!line.ok()) return line.status();
      if (line->empty() || line->front() == '#') continue;
      if (Trimmed(*line) == "data") break;
      const absl::Status status = Entry(*line);
      if (!status.ok()) return status;
    }
    return Checked();
  }

 private:
  absl::StatusOr<std::string_view> NextLine() {
    ++line_;
    const std::string_view rest = bytes_.substr(header_.data_begin);
    const std::size_t end = rest.substr(0, kMaxLine).find('\n');
    if (end == std::string_view::npos) {
      return Fail("the header ends before its line \"data\": cut off, or no OctoMap file");
    }
    header_.data_begin += end + 1;
    return rest.substr(0, end);
  }

  absl::Status Entry(std::string_view line) {
    const std::size_t blank = line.find(' ');
    const std::string_view key = line.substr(0, blank);
    const std::string_view value =
        blank == std::string_view::npos ? std::string_view() : Trimmed(line.substr(blank));
    if (key == "id") {
      header_.tree_type = std::string(value);
    } else if (key == "size") {
      has_size_ = ParseWhole(value, header_.nodes);
      if (!has_size_) return Fail("size is not a number of nodes");
    } else if (key == "res") {
      if (!ParseWhole(value, header_.resolution_m)) return Fail("res is not a number");
    } else {
      return Fail("none of id, size, res, data");
    }
    return absl::OkStatus();
  }

  absl::StatusOr<OctomapHeader> Checked() {
    if (header_.tree_type == "1") header_.tree_type = "OcTree";  // of OctoMap before 1.2
    if (header_.tree_type != "OcTree" && header_.tree_type != "ColorOcTree" &&
        header_.tree_type != "OcTreeStamped") {
      return Fail("id is none of OcTree, ColorOcTree, OcTreeStamped");
    }
    if (!has_size_) return Fail("no size before data");
    if (!(header_.resolution_m > 0) || !std::isfinite(header_.resolution_m)) {
      return Fail("res is missing or not above 0");
    }
    return header_;
  }

  absl::Status Fail(const char* why) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ", line ", line_, ": ", why));
  }

  const std::string& name_;
  std::string_view bytes_;
  OctomapHeader header_;
  bool has_size_ = false;
  int line_ = 0;
};

}  // namespace

absl::StatusOr<OctomapHeader> ParseOctomapHeader(const std::string& name, std::string_view bytes) {
  return HeaderParser(name, bytes).Parse();
}

}  // namespace clearway
