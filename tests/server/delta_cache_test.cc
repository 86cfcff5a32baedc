#include "server/delta_cache.h"

#include <gtest/gtest.h>

#include <thread>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "wire/delta_wire.h"

namespace clearway {
namespace {

// Versions 1 to 4 of a scene.
std::vector<ScenePtr> Versions() {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  std::vector<ScenePtr> versions;
  for (int k = 1; k <= 4; ++k) {
    Frame frame = testing_support::FrameAt(k);
    testing_support::AddPoint(frame, kStaticLabel, {2, 0.1f * static_cast<float>(k), 0});
    EXPECT_TRUE(builder.Apply(frame).ok());
    versions.push_back(builder.Publish());
  }
  return versions;
}

TEST(DeltaCache, GivesTheDifference) {
  const auto versions = Versions();
  DeltaCache dut("abc");
  const auto messages = dut.Between(versions[0].get(), *versions[2], MapDetail::kLogOdds);
  DeltaAssembler assembler;
  std::optional<SceneDelta> delta;
  for (const v1::FollowSceneResponse& message : *messages) {
    EXPECT_EQ(message.server_instance(), "abc");
    EXPECT_EQ(message.scene().version(), 3u);
    delta = *assembler.Add(message.delta());
  }
  ASSERT_TRUE(delta);
  EXPECT_TRUE(SameContent(*Apply(versions[0].get(), *delta), *versions[2]));
}

TEST(DeltaCache, SharesWhatSomebodyHoldsAndTheLast) {
  const auto versions = Versions();
  DeltaCache dut("");
  const auto between = [&](int from, int to, MapDetail detail = MapDetail::kLogOdds) {
    return dut.Between(versions[from].get(), *versions[to], detail);
  };
  const auto held = between(0, 1);
  EXPECT_TRUE(between(0, 1) == held);
  EXPECT_FALSE(between(0, 1, MapDetail::kStates) == held);
  const DeltaCache::Messages* last = between(1, 2).get();  // nobody holds it
  EXPECT_TRUE(between(1, 2).get() == last);
  EXPECT_TRUE(between(0, 1) == held);
}

TEST(DeltaCache, ThreadsGetTheSame) {
  const auto versions = Versions();
  DeltaCache dut("");
  std::vector<std::shared_ptr<const DeltaCache::Messages>> got(8);
  std::vector<std::thread> threads;
  for (auto& mine : got) {
    threads.emplace_back(
        [&] { mine = dut.Between(versions[0].get(), *versions[3], MapDetail::kLogOdds); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& mine : got) EXPECT_TRUE(mine == got[0]);
}

}  // namespace
}  // namespace clearway
