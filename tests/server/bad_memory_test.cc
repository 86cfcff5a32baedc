// Servers that have no memory left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "server/memory_use.h"
#include "support/frames.h"
#include "support/test_server.h"
#include "wire/status.h"

namespace clearway {
namespace {

using testing::HasSubstr;

const std::vector<Time> kNow(1);

void ExpectNoMemory(const absl::Status& status, const std::string& limit) {
  EXPECT_TRUE(absl::IsResourceExhausted(status)) << status;
  EXPECT_EQ(ReasonOf(status), "NO_MEMORY");
  EXPECT_THAT(status.message(), HasSubstr(limit));
}

// A tree whose one deep node has eight free children, each 128 voxels wide: 32,768 blocks.
std::string SmallFileOfALargeMap() {
  std::string file = "# Octomap OcTree binary file\nid OcTree\nsize 17\nres 0.2\ndata\n";
  for (int depth = 0; depth < 8; ++depth) file += std::string("\x03\0", 2);
  return file + "\x55\x55";
}

TEST(MemoryLimits, WithoutMemoryNothingIsAddedAndReadingGoesOn) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_memory_bytes = 1;
  const testing_support::TestServer server(config);
  const SceneClient client(server.Connect());
  const std::string limit = "limits.max_memory_bytes is 1";
  Frame frame = testing_support::FrameAt(1);
  testing_support::AddPoint(frame, kStaticLabel, {3, 0, 0});
  ExpectNoMemory(FrameSender(server.Connect()).Push(frame).status(), limit);
  ExpectNoMemory(client.LoadPrior(MapFormat::kBt, SmallFileOfALargeMap()).status(), limit);
  ExpectNoMemory(client.AcquireLease(std::chrono::seconds(1)).status(), limit);
  GivenObject post;
  post.id = 1;
  post.shape = Sphere{1};
  ExpectNoMemory(client.AddObjects(std::span(&post, 1)).status(), limit);
  const std::vector<Eigen::Vector3f> points_W{{3, 0, 0}};
  EXPECT_TRUE(client.OccupancyOfPoints(points_W, kNow).ok());
  EXPECT_EQ(client.GetServerInfo()->limits.max_memory_bytes, 1u);
  EXPECT_TRUE(client.SetKeepOut({}).ok());
  EXPECT_TRUE(client.Reset().ok());
}

TEST(MemoryLimits, APriorIsGivenUpWhenItsMapGrowsTooLarge) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_memory_bytes = CurrentMemoryUse().heap_bytes_in_use + (16 << 20);
  const testing_support::TestServer server(config);
  const SceneClient client(server.Connect());
  ExpectNoMemory(client.LoadPrior(MapFormat::kBt, SmallFileOfALargeMap()).status(),
                 "limits.max_memory_bytes is");
  Frame frame = testing_support::FrameAt(1);
  testing_support::AddPoint(frame, kStaticLabel, {3, 0, 0});
  EXPECT_TRUE(FrameSender(server.Connect()).Push(frame).ok());
}

TEST(MemoryLimits, ARequestThatTakesTooMuchIsRefused) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_request_memory_bytes = 1000;
  const testing_support::TestServer server(config);
  const SceneClient client(server.Connect());
  ExpectNoMemory(client.OccupancyOfPoints(std::vector<Eigen::Vector3f>(1000), kNow).status(),
                 "limits.max_request_memory_bytes is 1000");
  EXPECT_TRUE(client.OccupancyOfPoints(std::vector<Eigen::Vector3f>(10), kNow).ok());
  Frame frame = testing_support::FrameAt(1);
  for (int i = 0; i < 1000; ++i) testing_support::AddPoint(frame, kStaticLabel, {3, 0, 0});
  ExpectNoMemory(FrameSender(server.Connect()).Push(frame).status(),
                 "limits.max_request_memory_bytes is 1000");
}

}  // namespace
}  // namespace clearway
