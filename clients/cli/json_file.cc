#include "cli/json_file.h"

#include <fstream>
#include <iterator>

#include "absl/strings/str_cat.h"

namespace clearway::cli {

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
  constexpr std::uintmax_t kMaxBytes = 16'000'000;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) {
    return absl::NotFoundError(absl::StrCat(file.string(), ": no such ", kind, hint));
  }
  if (bytes > kMaxBytes) {
    return absl::ResourceExhaustedError(
        absl::StrCat(file.string(), ": has ", bytes, " bytes, the limit is ", kMaxBytes));
  }
  return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

}  // namespace clearway::cli
