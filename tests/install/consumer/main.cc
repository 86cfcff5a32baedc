// What an outside project writes: is a box of one metre free at the origin of an empty scene?
#include <cstdio>

#include "clearway/collision/scene_checker.h"

int main() {
  using namespace clearway;
  const auto scene = std::make_shared<SceneSnapshot>(SceneSnapshot::Empty(SceneParams{}));
  const SceneChecker checker(scene, Robot::SingleShape("box", Box{{1, 1, 1}}));
  const auto reply = checker.Check({{scene->stamp}, {Pose{}}}, CheckOptions{});
  if (!reply.ok()) return 1;
  std::printf("%s\n", ToString(reply->answers[0].status));
  return reply->answers[0].status == SpaceStatus::kUnknownSpace ? 0 : 1;
}
