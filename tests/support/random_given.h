// Random given objects and futures, for scenes that random frames make.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/random.h"

namespace clearway::testing_support {

// Poses about `from`, some of them in a row equal.
inline std::vector<StampedPose> RandomFuture(Random& random, const StampedPose& from) {
  std::vector<StampedPose> poses;
  StampedPose pose = from;
  for (int i = random.Integer(1, 6); i > 0; --i) {
    pose.stamp += FromSeconds(random.Uniform(0.02, 0.6));
    if (random.Integer(0, 3) != 0) {
      pose.T_W_O = pose.T_W_O * Exp({random.Vector(1), random.Vector(0.5)});
    }
    poses.push_back(pose);
  }
  return poses;
}

inline Shape RandomGivenShape(Random& random) {
  switch (random.Integer(0, 3)) {
    case 0:
      return Sphere{random.Uniform(0.1, 0.8)};
    case 1:
      return Box{Eigen::Vector3d(0.9, 0.9, 0.9) + random.Vector(0.4)};
    case 2:
      return Capsule{random.Uniform(0.1, 0.5), random.Uniform(0.1, 1)};
    default:
      return Cylinder{random.Uniform(0.1, 0.5), random.Uniform(0.1, 1)};
  }
}

// Adds a given object, removes one, or states or withdraws a future. Of the ids 5 to 8, of which
// frames may have some: what the scene refuses changes nothing.
inline void ChangeGivenRandomly(SceneBuilder& builder, Random& random) {
  const ScenePtr scene = builder.Publish();
  const ObjectId id = random.Integer(5, 8);
  const MovingObject* const known = scene->FindObject(id);
  const int kind = random.Integer(0, 3);
  if (known != nullptr && kind == 0) {
    EXPECT_EQ(builder.RemoveObject(id).ok(), known->given());
  } else if (known != nullptr) {
    const StampedPose now = known->history.back();
    EXPECT_TRUE(
        builder.SetFuture(id, kind == 1 ? std::vector<StampedPose>{} : RandomFuture(random, now))
            .ok());
  } else {
    GivenObject given{id, RandomGivenShape(random), {scene->stamp, random.AnyPose(5)}, {}, {}};
    if (kind != 1) given.velocity_O = Twist{random.Vector(1), random.Vector(1)};
    if (kind == 2) given.future = RandomFuture(random, given.pose);
    EXPECT_TRUE(builder.AddObject(given).ok());
  }
}

}  // namespace clearway::testing_support
