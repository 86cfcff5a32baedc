// PNG images of one channel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

// Row by row from the top left: a value per pixel as it is stored, not scaled to more bits.
struct GrayImage {
  std::uint32_t width = 0, height = 0;
  int bits = 0;  // of a value: 1, 2, 4, 8 or 16
  std::vector<std::uint16_t> pixels;
};

// Reads grey images, and images of a palette, whose values are then the palette's indices (as masks
// often are). NOT_FOUND; RESOURCE_EXHAUSTED above 128 MB; INVALID_ARGUMENT naming the file for
// other kinds (colours, alpha), for what is cut off or damaged, and for more than 20 million
// pixels. Any thread.
absl::StatusOr<GrayImage> ReadGrayPng(const std::filesystem::path& path);

}  // namespace clearway
