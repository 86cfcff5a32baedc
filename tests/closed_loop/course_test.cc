#include "closed_loop/course.h"

#include <gtest/gtest.h>

#include "closed_loop/robot.h"

namespace clearway::closed_loop {
namespace {

bool SameCourse(const Course& a, const Course& b) {
  const auto a_bodies = a.world.bodies(), b_bodies = b.world.bodies();
  if (a_bodies.size() != b_bodies.size() || a.errand.goal_W != b.errand.goal_W) return false;
  for (std::size_t i = 0; i < a_bodies.size(); ++i) {
    if (a_bodies[i].id != b_bodies[i].id || a_bodies[i].name != b_bodies[i].name ||
        a_bodies[i].parts[0].shape != b_bodies[i].parts[0].shape) {
      return false;
    }
    for (const double seconds : {0.0, 3.7, 29.0}) {
      const Time time(FromSeconds(seconds));
      if (!(PoseAt(a_bodies[i].trajectory, time) == PoseAt(b_bodies[i].trajectory, time))) {
        return false;
      }
    }
  }
  return true;
}

TEST(CourseTest, SameSeedMakesTheSameCourse) {
  for (const Traffic traffic : {Traffic::kSteady, Traffic::kTurning}) {
    EXPECT_TRUE(SameCourse(MakeCourse(3, traffic), MakeCourse(3, traffic)));
    EXPECT_FALSE(SameCourse(MakeCourse(3, traffic), MakeCourse(4, traffic)));
  }
}

TEST(CourseTest, NothingIsAtTheStart) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Course dut = MakeCourse(seed, Traffic::kTurning);
    const Carrier& carrier = dut.errand.carrier;
    const auto& [radius_m, height_m] = std::get<Cylinder>(carrier.body);
    const Shape around = Cylinder{radius_m + 1, height_m};
    for (const double seconds : {0.0, 1.0, 2.0, 3.0}) {
      EXPECT_FALSE(dut.world.Touched(around, carrier.LinkPose(dut.errand.start_W),
                                     Time(FromSeconds(seconds))));
    }
  }
}

TEST(CourseTest, SteadyObjectsLeaveAndTurningOnesStay) {
  const auto near_at_the_end = [](Traffic traffic) {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Course course = MakeCourse(seed, traffic);
      for (const ObjectId id : course.world.ObjectIds()) {
        const Pose T_W_B = *course.world.T_W_B(id, Time(FromSeconds(30)));
        count += course.errand.area_W.Contains({T_W_B.translation.x(), T_W_B.translation.y(), 0});
      }
    }
    return count;
  };
  EXPECT_LT(2 * near_at_the_end(Traffic::kSteady), near_at_the_end(Traffic::kTurning));
}

}  // namespace
}  // namespace clearway::closed_loop
