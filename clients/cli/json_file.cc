#include "cli/json_file.h"

#include <array>
#include <istream>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/file_type.h"

namespace clearway::cli {
namespace {

constexpr std::uint64_t kMaxBytes = 16'000'000;

}  // namespace

absl::StatusOr<Json> ParseJson(const std::string& text) {
  try {
    return Json::parse(text);
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
