// The text before the data of an OctoMap file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/octomap_file.h"

namespace clearway {

struct OctomapHeader {
  OctomapFormat format = OctomapFormat::kBinary;
  std::string tree_type;
  std::uint64_t nodes = 0;
  double resolution_m = 0;
  std::vector<std::string> unknown_keys;  // OctoMap skips them, too
  std::size_t data_begin = 0;             // the first byte of data
};

// INVALID_ARGUMENT naming the line and the field.
absl::StatusOr<OctomapHeader> ParseOctomapHeader(const std::string& name, std::string_view bytes);

}  // namespace clearway
