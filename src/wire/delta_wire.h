// Converters of delta.proto: a SceneDelta as a sequence of parts below the message limit.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_delta.h"
#include "clearway/v1/delta.pb.h"

namespace clearway {

// Bounds on one MapPart, so that a receiver knows what to expect before it takes memory: blocks in
// it, and bytes once decompressed.
inline constexpr std::size_t kMaxBlocksPerPart = 1024;
inline constexpr std::size_t kMaxPartBytes = 4 << 20;

// Calls `send` with the parts in order, each small enough for gRPC's default message limit of 4 MB;
// stops when it returns false, and then returns false. Takes the memory of one part.
bool WriteDifference(const SceneDifference& difference,
                     const std::function<bool(const v1::SceneDeltaPart&)>& send);

// Puts a delta together again. A value; one thread at a time.
class DeltaAssembler {
 public:
  // The whole delta once its last part is in; none before. FAILED_PRECONDITION for a part out of
  // turn; INVALID_ARGUMENT naming the field for one that is damaged. After an error, start afresh.
  absl::StatusOr<std::optional<SceneDelta>> Add(const v1::SceneDeltaPart& part);

 private:
  absl::Status Begin(const v1::SceneDeltaPart& part);
  absl::Status AddObjects(const v1::SceneDeltaPart& part);
  absl::Status AddMaps(const v1::SceneDeltaPart& part);
  absl::Status AddDynamic(const v1::SceneDeltaPart& part);

  SceneDelta delta_;
  std::map<ObjectId, std::size_t> objects_;  // where each is in delta_.objects
  std::vector<DynamicVoxel> dynamic_;
  std::uint32_t next_part_ = 0;
};

}  // namespace clearway
