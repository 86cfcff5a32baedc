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

std::string Registered(Robots& dut, Robot robot, const std::string& peer = "planner") {
  const absl::StatusOr<Robots::Registered> known = dut.Register(std::move(robot), peer);
  EXPECT_TRUE(known.ok()) << known.status();
  return known.ok() ? known->id : "";
}

ServerLimits OfOnePeer() {
  ServerLimits limits;
  limits.max_peer_share = 1;
  return limits;
}

TEST(RobotsTest, Empty) {
  Robots dut(ServerLimits{}, 0.1);
  EXPECT_EQ(dut.size(), 0u);
  EXPECT_EQ(dut.Find("none").status().code(), absl::StatusCode::kNotFound);
}

TEST(RobotsTest, ForgetsTheOneUsedLongestAgo) {
  ServerLimits limits;
  limits.max_robots = 2;
  limits.max_peer_share = 1;
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
  Robots dut(OfOnePeer(), 0.1, 20);
  const std::string first = Registered(dut, Heavy("first", 4));
  for (int i = 0; i < 4; ++i) Registered(dut, Heavy("more" + std::to_string(i), 4));
  EXPECT_EQ(dut.size(), 5u);
  EXPECT_TRUE(dut.Find(first).ok());
  Registered(dut, Heavy("last", 4));
  EXPECT_EQ(dut.size(), 5u);
  EXPECT_TRUE(dut.Find(first).ok()) << "used after the others";
}

TEST(RobotsTest, APeerWithTooManyLosesItsOwn) {
  ServerLimits limits;
  limits.max_robots = 4;
  Robots dut(limits, 0.1);
  const std::string others = Registered(dut, Robot::SingleShape("b", Sphere{1}), "b");
  std::vector<std::string> ids;
  for (int i = 0; i < 10; ++i) {
    ids.push_back(Registered(dut, Robot::SingleShape(std::to_string(i), Sphere{1}), "a"));
    EXPECT_TRUE(dut.Find(ids.back()).ok());
  }
  EXPECT_TRUE(dut.Find(others).ok()) << "used longest ago, but another's";
  EXPECT_EQ(dut.size(), 3u);
  EXPECT_TRUE(dut.Find(ids[8]).ok());
  EXPECT_FALSE(dut.Find(ids[7]).ok());
}

TEST(RobotsTest, WhenThereIsNoRoomThePeerWithMostLosesOne) {
  ServerLimits limits;
  limits.max_robots = 4;
  Robots dut(limits, 0.1);
  const std::string b = Registered(dut, Robot::SingleShape("b", Sphere{1}), "b");
  const std::string a1 = Registered(dut, Robot::SingleShape("a1", Sphere{1}), "a");
  const std::string a2 = Registered(dut, Robot::SingleShape("a2", Sphere{1}), "a");
  const std::string c = Registered(dut, Robot::SingleShape("c", Sphere{1}), "c");
  const std::string d = Registered(dut, Robot::SingleShape("d", Sphere{1}), "d");
  EXPECT_EQ(dut.size(), 4u);
  for (const std::string& id : {b, a2, c, d}) EXPECT_TRUE(dut.Find(id).ok());
  EXPECT_FALSE(dut.Find(a1).ok());
  Registered(dut, Robot::SingleShape("e", Sphere{1}), "e");  // each has one: the oldest goes
  EXPECT_EQ(dut.size(), 4u);
  EXPECT_FALSE(dut.Find(b).ok());
}

TEST(RobotsTest, TrianglesCountByPeer) {
  Robots dut(ServerLimits{}, 0.1, 20);  // 10 of one peer
  const std::string others = Registered(dut, Heavy("other", 4), "b");
  const std::string first = Registered(dut, Heavy("first", 4), "a");
  Registered(dut, Heavy("second", 4), "a");
  EXPECT_TRUE(dut.Find(first).ok());
  Registered(dut, Heavy("third", 4), "a");
  EXPECT_EQ(dut.size(), 3u);
  EXPECT_TRUE(dut.Find(others).ok());
  EXPECT_TRUE(dut.Find(first).ok());
}

}  // namespace
}  // namespace clearway
