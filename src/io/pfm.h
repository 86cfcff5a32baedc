// Portable float maps (http://netpbm.sourceforge.net/doc/pfm.html).
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

struct FloatImage {
  std::uint32_t width = 0, height = 0;
  std::vector<float> pixels;  // row by row from the top left
};

// Grey images (Pf) of a scale of 1 or -1, that is without a unit of their own. NOT_FOUND;
// INVALID_ARGUMENT for other kinds and what is cut off; RESOURCE_EXHAUSTED above 20 million pixels.
absl::StatusOr<FloatImage> ReadPfm(const std::filesystem::path& path);

}  // namespace clearway
