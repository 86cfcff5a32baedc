// Files whose content only their owner may know.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace clearway {

// ReadWholeFile for private keys and tokens: FAILED_PRECONDITION, with the command that mends it,
// for a file that everybody can read, or others than its owner can write. Its group may read it.
// Any thread.
absl::StatusOr<std::string> ReadSecretFile(const std::filesystem::path& path,
                                           std::uint64_t max_bytes);

// WriteWholeFile for such a file: only its owner can read a new one; one that is replaced keeps its
// permissions and, where the system allows it, its owner.
absl::Status WriteSecretFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace clearway
