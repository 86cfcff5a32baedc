// The voxel payload of delta.proto: BlockDeltas, compressed with Zstandard.
#pragma once

#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_delta.h"

namespace clearway {

std::string CompressBlocks(std::span<const BlockDelta> blocks);

// INVALID_ARGUMENT, its message starting with `field`, for bytes that are not such a payload, for
// more than `max_blocks`, and for a payload that would be larger than `max_bytes` decompressed;
// memory is taken only after the declared size has been checked.
absl::StatusOr<MapDelta> DecompressBlocks(const std::string& field, const std::string& bytes,
                                          std::size_t max_blocks, std::size_t max_bytes);

}  // namespace clearway
