#include "io/octomap_header.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "io/parse_number.h"
#include "io/utf8.h"

namespace clearway {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";
constexpr std::size_t kMaxHeader = 65'536;

// Reads words up to "data", as AbstractOcTree::readHeader of OctoMap does: lines do not matter, but
// what follows # or an unknown word up to the end of its line is skipped.
class HeaderParser {
 public:
  HeaderParser(const std::string& name, std::string_view bytes)
      : name_(name), bytes_(bytes), rest_(bytes.substr(0, kMaxHeader)) {}

  absl::StatusOr<OctomapHeader> Parse() {
    // The binary magic is not a prefix of the other, nor the other way round.
    if (rest_.starts_with(kBinaryMagic)) {
      header_.format = OctomapFormat::kBinary;
    } else if (rest_.starts_with(kFullMagic)) {
      header_.format = OctomapFormat::kFull;
    } else {
      return Fail("does not start with \"# Octomap OcTree\": no OctoMap file");
    }
    SkipLine();
    for (std::string_view word = TakeWord(); !word.empty(); word = TakeWord()) {
      if (word == "data") {
        if (!SkipLine()) break;
        header_.data_begin = static_cast<std::size_t>(rest_.data() - bytes_.data()) + 1;
        return Checked();
      }
      if (const absl::Status status = Entry(word); !status.ok()) return status;
    }
    return Fail("the header ends before its word \"data\": cut off, or no OctoMap file");
  }

 private:
  // Empty at the end of the header's bytes.
  std::string_view TakeWord() {
    constexpr std::string_view kBlank = " \t\r\n\v\f";
    const std::size_t first = std::min(rest_.find_first_not_of(kBlank), rest_.size());
    line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + first, '\n'));
    rest_.remove_prefix(first);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(word.size());
    return word;
  }

  // Up to the line's end; false if there is none.
  bool SkipLine() {
    const std::size_t end = rest_.find('\n');
    rest_.remove_prefix(std::min(end, rest_.size()));
    return end != std::string_view::npos;
  }

  absl::Status Entry(std::string_view key) {
    if (key == "id") {
      header_.tree_type = std::string(TakeWord());
    } else if (key == "size") {
      has_size_ = ParseWhole(TakeWord(), header_.nodes);
      if (!has_size_) return Fail("size is not a number of nodes");
    } else if (key == "res") {
      if (!ParseWhole(TakeWord(), header_.resolution_m)) return Fail("res is not a number");
    } else {
      if (key.front() != '#') header_.unknown_keys.push_back(Shown(key));
      SkipLine();
    }
    return absl::OkStatus();
  }

  static std::string Shown(std::string_view key) {
    constexpr std::size_t kMaxShown = 40;
    return IsPlainText(key.substr(0, kMaxShown)) ? std::string(key.substr(0, kMaxShown))
                                                 : "(not text)";
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
  std::string_view bytes_, rest_;
  OctomapHeader header_;
  bool has_size_ = false;
  int line_ = 1;
};

}  // namespace

absl::StatusOr<OctomapHeader> ParseOctomapHeader(const std::string& name, std::string_view bytes) {
  return HeaderParser(name, bytes).Parse();
}

}  // namespace clearway
