#include "clearway/report/true_bodies.h"

#include <utility>

namespace clearway {

TrueBodies::TrueBodies(std::shared_ptr<const World> world) : world_(std::move(world)) {}

TrueBodies::TrueBodies(Truth truth, const std::map<ObjectId, Eigen::Vector3d>& sizes_m)
    : truth_(std::move(truth)) {
  auto boxes = std::make_shared<World>();
  for (const auto& [id, size_m] : sizes_m) {
    boxes->Add(Body::Single(id, "", Box{size_m}, FixedPose{}));
  }
  world_ = std::move(boxes);
}

std::optional<Pose> TrueBodies::T_W_B(ObjectId id, Time t) const {
  if (!truth_) return world_->T_W_B(id, t);
  const auto box = BoxOf(*truth_, id, t);
  return box ? std::optional(box->T_W_B) : std::nullopt;
}

}  // namespace clearway
