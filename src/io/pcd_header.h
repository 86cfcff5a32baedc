// Headers of PCD files (https://pointclouds.org/documentation/tutorials/pcd_file_format.html).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  std::uint64_t size = 0;                        // bytes of a number: 1, 2, 4 or 8
  char type = 'F';                               // F, I or U
  std::uint64_t count = 1;                       // numbers
  std::uint64_t first_byte = 0, first_word = 0;  // in a point's row
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  std::uint64_t row_bytes = 0, row_words = 0;
  bool has_viewpoint = false;  // that is not the identity
  PcdData data = PcdData::kAscii;
  std::size_t begin = 0;  // of the points, in the file
  int lines = 0;          // of the header

  // Null if there is none of that name.
  const PcdField* Find(const std::string& name) const;
};

// INVALID_ARGUMENT names the line of `name`'s text; RESOURCE_EXHAUSTED for too many points.
absl::StatusOr<PcdHeader> ParsePcdHeader(const std::string& name, std::string_view bytes);

}  // namespace clearway
