#include "io/file.h"

#include <fstream>
#include <system_error>

#include "absl/strings/str_cat.h"

namespace clearway {

absl::StatusOr<std::string> ReadWholeFile(const std::filesystem::path& path,
                                          std::uint64_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    const bool exists = std::filesystem::exists(path, error);
    return absl::NotFoundError(
        absl::StrCat(path.string(), exists ? ": is not a file" : ": no such file"));
  }
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) {
    return absl::InternalError(absl::StrCat(path.string(), ": ", error.message()));
  }
  if (size > max_bytes) {
    return absl::ResourceExhaustedError(
        absl::StrCat(path.string(), ": ", size, " bytes; the limit is ", max_bytes, " bytes"));
  }
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) {
    return absl::InternalError(absl::StrCat(path.string(), ": cannot be read"));
  }
  return bytes;
}

absl::Status WriteWholeFile(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path partial = path.string() + ".partial";
  {
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(partial, ignored);
      return absl::UnavailableError(
          absl::StrCat(path.string(), ": cannot be written (no such folder, or disk full?)"));
    }
  }
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    return absl::UnavailableError(absl::StrCat(path.string(), ": ", error.message()));
  }
  return absl::OkStatus();
}

}  // namespace clearway
