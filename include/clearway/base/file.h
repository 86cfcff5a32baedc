// Whole files in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace clearway {

// The bytes of a regular file. Every error names the file: NOT_FOUND (no such file),
// PERMISSION_DENIED, INVALID_ARGUMENT for a folder, pipe, socket or device, RESOURCE_EXHAUSTED
// above max_bytes, UNAVAILABLE if reading fails. Never blocks on a pipe. Any thread.
absl::StatusOr<std::string> ReadWholeFile(const std::filesystem::path& path,
                                          std::uint64_t max_bytes);

// The first bytes of a regular file, fewer if it is shorter. Errors as above.
absl::StatusOr<std::string> ReadFileStart(const std::filesystem::path& path, std::size_t bytes);

// The same of a text in UTF-8, without a byte order mark. INVALID_ARGUMENT for UTF-16, which begins
// with one.
absl::StatusOr<std::string> ReadTextFile(const std::filesystem::path& path,
                                         std::uint64_t max_bytes);
// `name` names the text in messages.
absl::StatusOr<std::string_view> WithoutByteOrderMark(const std::string& name,
                                                      std::string_view text);

// Replaces the file at once: readers see the old bytes or the new ones, never a part.
absl::Status WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace clearway
