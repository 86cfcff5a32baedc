#include "cli/json_file.h"

#include <array>
#include <istream>
#include <set>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/file_type.h"

namespace clearway::cli {
namespace {

constexpr std::uint64_t kMaxBytes = 16'000'000;

// Finds a key that an object has twice: JSON parsers silently keep the last one's value.
class RepeatedKeys {
 public:
  void See(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key) return SeeKey(parsed.get<std::string>());
    if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
      return;
    }
    if (!levels_.empty() && levels_.back().is_list) ++levels_.back().items;
    if (event != Event::value) levels_.push_back({.is_list = event == Event::array_start});
  }

  // Empty if there is none.
  const std::string& error() const { return error_; }

 private:
  // An object or a list that has begun and not ended.
  struct Level {
    bool is_list = false;
    std::size_t items = 0;
    std::string key = {};
    std::set<std::string> keys = {};
  };

  void SeeKey(const std::string& key) {
    levels_.back().key = key;
    if (levels_.back().keys.insert(key).second || !error_.empty()) return;
    for (const Level& level : levels_) {
      absl::StrAppend(&error_, level.is_list ? absl::StrCat("[", level.items - 1, "]")
                                             : (error_.empty() ? "" : ".") + level.key);
    }
    error_ += ": given twice";
  }

  std::vector<Level> levels_;
  std::string error_;
};

}  // namespace

absl::StatusOr<Json> ParseJson(const std::string& text) {
  try {
    RepeatedKeys keys;
    Json json = Json::parse(text, [&keys](int, Json::parse_event_t event, const Json& parsed) {
      keys.See(event, parsed);
      return true;
    });
    if (keys.error().empty()) return json;
    return absl::InvalidArgumentError(keys.error());
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    const std::string what = error.what();
    const std::size_t end = what.find("] ");
    return absl::InvalidArgumentError(end == std::string::npos ? what : what.substr(end + 2));
  }
}

absl::StatusOr<std::string> ReadTextFile(const std::filesystem::path& file, const std::string& kind,
                                         const std::string& hint) {
  auto text = clearway::ReadTextFile(file, kMaxBytes);
  if (absl::IsNotFound(text.status())) {
    return absl::NotFoundError(absl::StrCat(file.string(), ": no such ", kind, hint));
  }
  if (!text.ok()) return text;
  const FileKind is = text->empty() ? FileKind{} : KindOfBytes(*text);
  const bool is_text = is.type == FileType::kText || is.type == FileType::kUnknown;
  if (is_text) return text;
  return absl::InvalidArgumentError(
      absl::StrCat(file.string(), ": not a ", kind, "; the file is ", is.name));
}

absl::StatusOr<std::string> ReadStream(const std::string& name, std::istream& in) {
  std::string text;
  std::array<char, 1 << 16> piece;
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMaxBytes) {
      return absl::ResourceExhaustedError(
          absl::StrCat(name, ": more than ", kMaxBytes, " bytes, the limit"));
    }
  }
  if (in.bad()) return absl::DataLossError(absl::StrCat(name, ": cannot be read"));
  return text;
}

}  // namespace clearway::cli
