#include "closed_loop/scene_feed.h"

namespace clearway::closed_loop {

SceneParams LoopSceneParams() {
  SceneParams params;
  params.horizon = std::chrono::seconds(30);
  params.object_lifetime = std::chrono::seconds(5);
  params.history = std::chrono::seconds(2);
  return params;
}

absl::StatusOr<ScenePtr> OwnScene::Push(const Frame& frame) {
  if (const auto report = builder_.Apply(frame); !report.ok()) return report.status();
  return builder_.Publish();
}

}  // namespace clearway::closed_loop
