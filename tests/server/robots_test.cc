#include "server/robots.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace clearway {
namespace {

// Of that many triangles, all in one place.
Robot Heavy(const std::string& name, std::size_t triangles) {
  Mesh mesh{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {}};
  mesh.triangles.assign(triangles, {0, 1, 2});
  return Robot::SingleShape(name, TriangleMesh{std::make_shared<const Mesh>(std::move(mesh))});
}

std::string Registered(Robots& dut, Robot robot) {
  const absl::StatusOr<Robots::Registered> known = dut.Register(std::move(robot));
  EXPECT_TRUE(known.ok()) << known.status();
  return known.ok() ? known->id : "";
}

TEST(RobotsTest, Empty) {
  Robots dut(ServerLimits{}, 0.1);
  EXPECT_EQ(dut.size(), 0u);
  EXPECT_EQ(dut.Find("none").status().code(), absl::StatusCode::kNotFound);
}

TEST(RobotsTest, ForgetsTheOneUsedLongestAgo) {
  ServerLimits limits;
  limits.max_robots = 2;
  Robots dut(limits, 0.1);
  std::vector<std::string> ids;
  for (const char* name : {"a", "b"})
    ids.push_back(Registered(dut, Robot::SingleShape(name, Sphere{1})));
  EXPECT_TRUE(dut.Find(ids[0]).ok());
  Registered(dut, Robot::SingleShape("c", Sphere{1}));
  EXPECT_EQ(dut.size(), 2u);
  EXPECT_TRUE(dut.Find(ids[0]).ok());
  EXPECT_FALSE(dut.Find(ids[1]).ok());
}

TEST(RobotsTest, ForgetsRobotsOfTooManyTrianglesTogether) {
  Robots dut(ServerLimits{}, 0.1, 20);
  const std::string first = Registered(dut, Heavy("first", 4));
  for (int i = 0; i < 4; ++i) Registered(dut, Heavy("more" + std::to_string(i), 4));
  EXPECT_EQ(dut.size(), 5u);
  EXPECT_TRUE(dut.Find(first).ok());
  Registered(dut, Heavy("last", 4));
  EXPECT_EQ(dut.size(), 5u);
  EXPECT_TRUE(dut.Find(first).ok()) << "used after the others";
}

}  // namespace
}  // namespace clearway
