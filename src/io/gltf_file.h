// The two forms of glTF 2 files: JSON alone, and JSON with a buffer in one binary file.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace clearway {

struct GltfFile {
  nlohmann::json json;
  std::optional<std::string> buffer;  // of a .glb file
  bool is_glb = false;
};

// INVALID_ARGUMENT for what is not JSON, has a key twice, or is no .glb file whose chunks fill it.
absl::StatusOr<GltfFile> ReadGltf(std::string_view bytes);
absl::StatusOr<GltfFile> ReadGlb(std::string_view bytes);

// The file's bytes.
std::string GltfBytes(const GltfFile& file);

}  // namespace clearway
