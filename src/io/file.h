// Whole files in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace clearway {

// The bytes of a file. NOT_FOUND, RESOURCE_EXHAUSTED above max_bytes, or INTERNAL for an error of
// the disk; each names the file.
absl::StatusOr<std::string> ReadWholeFile(const std::filesystem::path& path,
                                          std::uint64_t max_bytes);

// Replaces the file at once: whoever reads it sees the old bytes or the new ones, never a part.
absl::Status WriteWholeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace clearway
