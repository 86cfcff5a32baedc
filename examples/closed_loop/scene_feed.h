// Where scans become a scene.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/scene_builder.h"

namespace clearway::closed_loop {

// Takes scans as they are made. One thread.
class SceneFeed {
 public:
  virtual ~SceneFeed() = default;
  // The version that holds the frame.
  virtual absl::StatusOr<ScenePtr> Push(const Frame& frame) = 0;
};

// How the loop's scenes are made: predictions reach as far as plans do.
SceneParams LoopSceneParams();

// In this process.
class OwnScene : public SceneFeed {
 public:
  OwnScene() : pool_(1), builder_(LoopSceneParams(), FrameLimits(), pool_) {}
  absl::StatusOr<ScenePtr> Push(const Frame& frame) override;

 private:
  ThreadPool pool_;
  SceneBuilder builder_;
};

}  // namespace clearway::closed_loop
