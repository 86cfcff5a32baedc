#include "io/numbered_files.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"
#include "clearway/io/file_type.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

std::optional<int> NumberOf(const std::string& name) {
  constexpr int kMost = 99'999'999;
  int number = 0;
  if (!ParseWhole(name, number) || number < 0 || number > kMost) return std::nullopt;
  return number;
}

}  // namespace

absl::StatusOr<std::map<int, Path>> NumberedFiles(const Path& folder,
                                                  const std::string& extension) {
  std::map<int, Path> files;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const Path path = entry->path();
    const std::optional<int> number = NumberOf(path.stem().string());
    if (LowerExtension(path) != extension || !number) continue;
    const auto [file, is_new] = files.try_emplace(*number, path);
    if (is_new) continue;
    // Named in the order of their names: that of a folder's entries is the file system's.
    const auto [first, second] = std::minmax(file->second, path);
    return absl::InvalidArgumentError(
        absl::StrCat(first.string(), " and ", second.string(), ": two files of frame ", *number));
  }
  return files;
}

}  // namespace clearway
