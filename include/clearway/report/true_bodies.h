// The objects whose maps are judged: what shapes they have, and where they really were.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "clearway/report/truth.h"
#include "clearway/sim/world.h"

namespace clearway {

// Of a simulated world, or of recorded boxes. A value; any thread may ask.
//
// A recorded box is a stand-in for a surface that nobody recorded. A closed van fills its box to a
// decimetre or two; a cyclist, and whatever has a bonnet, does not: distances to the faces of the
// box are then large even where the map is right.
class TrueBodies {
 public:
  // Exact surfaces, whose poses are known at all times.
  TrueBodies(std::shared_ptr<const World> world);  // NOLINT: as good as the world
  // Boxes of these sizes (of an id without one nothing is known), where the truth tells them.
  TrueBodies(Truth truth, const std::map<ObjectId, Eigen::Vector3d>& sizes_m);

  const Body* Find(ObjectId id) const { return world_->FindObject(id); }  // null if there is none
  std::vector<const Body*> PartsOf(ObjectId whole) const { return world_->PartsOf(whole); }
  // None where it is not known.
  std::optional<Pose> T_W_B(ObjectId id, Time t) const;

 private:
  std::shared_ptr<const World> world_;
  std::optional<Truth> truth_;  // of the poses, instead of the world's
};

}  // namespace clearway
