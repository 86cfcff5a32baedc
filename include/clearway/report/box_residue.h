// What objects left behind in the static map, as far as recorded boxes can tell.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "clearway/map/voxel_map.h"
#include "clearway/report/truth.h"

namespace clearway {

// Counts of voxels of the static map.
struct BoxResidue {
  std::int64_t passed = 0;    // that an object filled at some time
  std::int64_t occupied = 0;  // of these: the residue
};

// Collects the boxes at the times of frames. What an object filled at some time, nothing static
// fills: an occupied voxel there is a trail. It counts where the voxel's centre lay in a box, at
// least a voxel from its faces and kGround_m above its bottom, as boxes are not exact and the
// ground is below. Not where an object's box was last: nobody knows whether it still stands there.
// Nor in boxes of more than 2^24 voxels.
// Beside the boxes the true static world is not known, so nothing else of the map is judged. One
// thread.
class BoxResidueScore {
 public:
  static constexpr double kGround_m = 0.3;

  explicit BoxResidueScore(Truth truth) : truth_(std::move(truth)) {}

  void Add(Time stamp);

  BoxResidue Of(const VoxelMap& map_W) const;

 private:
  Truth truth_;
  std::vector<TrueBox> boxes_;        // of all times, with a size
  std::map<ObjectId, TrueBox> last_;  // of each object
};

}  // namespace clearway
