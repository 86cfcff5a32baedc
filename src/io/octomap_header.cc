#include "io/octomap_header.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"
#include "clearway/io/file_type.h"
#include "io/utf8.h"

namespace clearway {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";
constexpr std::size_t kMaxHeader = 65'536;
constexpr std::size_t kMaxMagic = 512;  // of any known file

// Reads words up to "data", as AbstractOcTree::readHeader of OctoMap does: lines do not matter, but
// what follows # or an unknown word up to the end of its line is skipped.
class HeaderParser {
 public:
  HeaderParser(const std::string& name, std::string_view bytes)
      : name_(name), bytes_(bytes), rest_(bytes.substr(0, kMaxHeader)) {}

  absl::StatusOr<OctomapHeader> Parse() {
    // The binary magic is not a prefix of the other, nor the other way round.
    if (rest_.starts_with("\xEF\xBB\xBF")) {
      return Fail("begins with a UTF-8 byte order mark: a text editor changed the binary file");
    }
    if (rest_.starts_with(kBinaryMagic)) {
      header_.format = OctomapFormat::kBinary;
    } else if (rest_.starts_with(kFullMagic)) {
      header_.format = OctomapFormat::kFull;
    } else {
      const std::string kind = KindOfBytes(bytes_.substr(0, kMaxMagic)).name;
      return Fail(absl::StrCat("does not start with \"# Octomap OcTree\": no OctoMap file",
                               kind.empty() ? "" : "; the file is ", kind));
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
    if (key != "id" && key != "size" && key != "res") {
      if (key.front() != '#') header_.unknown_keys.push_back(Shown(key));
      SkipLine();
      return absl::OkStatus();
    }
    const std::string_view value = TakeWord();
    const auto [first, is_new] = values_.try_emplace(key, value);
    if (!is_new && first->second != value) {
      return Fail(absl::StrCat("a second ", std::string(key), ", '", Shown(value),
                               "'; the first is '", Shown(first->second), "'"));
    }
    const auto is_not = [&](const char* expected) {
      return Fail(absl::StrCat(std::string(key), ": '", Shown(value), "' is not a ", expected));
    };
    if (key == "id") {
      header_.tree_type = std::string(value);
    } else if (key == "size") {
      if (!ParseWhole(value, header_.nodes)) return is_not("number of nodes");
    } else {
      double& res_m = header_.resolution_m;
      if (!ParseWhole(value, res_m) || !std::isfinite(res_m) || !(res_m > 0)) {
        return is_not("finite number above 0");
      }
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
    if (!values_.contains("size")) return Fail("no size before data");
    if (!values_.contains("res")) return Fail("no res before data");
    return header_;
  }

  absl::Status Fail(const std::string& why) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ", line ", line_, ": ", why));
  }

  const std::string& name_;
  std::string_view bytes_, rest_;
  OctomapHeader header_;
  std::map<std::string_view, std::string_view> values_;
  int line_ = 1;
};

}  // namespace

absl::StatusOr<OctomapHeader> ParseOctomapHeader(const std::string& name, std::string_view bytes) {
  return HeaderParser(name, bytes).Parse();
}

}  // namespace clearway
