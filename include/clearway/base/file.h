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

// The file to write when a user names `path`: links are followed. It is a regular file or not there
// yet, and so is "<it>.partial", the name under which it grows. INVALID_ARGUMENT names what else is
// there: a folder, pipe, socket, device or a link that leads nowhere.
absl::StatusOr<std::filesystem::path> OutputFile(const std::filesystem::path& path);

// Gives a finished file its name, in the place of one that has it; `path` is from OutputFile and is
// checked again. If that fails, the partial file is removed; UNAVAILABLE if it cannot be moved.
absl::Status MoveInto(const std::filesystem::path& partial, const std::filesystem::path& path);

// Replaces the file at once: readers see the old bytes or the new ones, never a part. Errors as
// above.
absl::Status WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace clearway
