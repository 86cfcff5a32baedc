// Queries through client and server agree with the same questions asked of the scene itself.
#include <gtest/gtest.h>

#include "clearway/client/error_details.h"
#include "clearway/client/frame_sender.h"
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_client.h"
#include "clearway/collision/scene_checker.h"
#include "clearway/io/octomap_file.h"
#include "support/frames.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::TestServer;

class QueriesTest : public testing::Test {
 protected:
  void SetUp() override {
    FrameSender sender(connection_);
    testing_support::RandomFrames frames(5);
    for (int i = 1; i <= 30; ++i) {
      Frame frame = frames.Next();
      frame.sequence = i;
      ASSERT_TRUE(sender.Push(frame).ok());
    }
    scene_ = server_.Newest();
    ASSERT_FALSE(scene_->objects.empty());
    for (int i = 0; i < 8; ++i) times_.push_back(scene_->stamp + FromSeconds(0.8 * i - 1));
  }

  TestServer server_;
  std::shared_ptr<Connection> connection_ = server_.Connect();
  SceneClient dut_{connection_};
  ScenePtr scene_;
  std::vector<Time> times_;
  testing_support::Random random_{4};
};

// What a list holds, parts and all.
std::vector<ObjectInfo> WithParts(const ObjectList& list) {
  std::vector<ObjectInfo> objects;
  for (const ObjectInfo& object : list.objects) {
    objects.push_back(object);
    objects.insert(objects.end(), object.parts.begin(), object.parts.end());
  }
  return objects;
}

TEST_F(QueriesTest, Points) {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3d> same;
  std::vector<Time> times;
  for (int i = 0; i < 2000; ++i) {
    points.push_back(random_.Vector(9).cast<float>());
    same.push_back(points.back().cast<double>());
    times.push_back(times_[i % times_.size()]);
  }
  const auto answer = dut_.OccupancyOfPoints(points, times);
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_EQ(answer->version, scene_->version);
  EXPECT_EQ(answer->stamp, scene_->stamp);
  const auto truth = OccupancyOf(*scene_, same, times);
  ASSERT_EQ(answer->points.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(answer->points[i].status, truth[i].status);
    EXPECT_EQ(answer->points[i].object, truth[i].object);
    EXPECT_EQ(answer->points[i].fused_log_odds, truth[i].fused_log_odds);
    EXPECT_EQ(answer->points[i].dynamic, truth[i].dynamic);
  }
}

TEST_F(QueriesTest, ABoxCountsItsCells) {
  const Aabb box{{-1.05, -2, 0.1}, {3.3, 4, 0.75}};
  const auto answer = dut_.OccupancyOfBox(box, times_, true);
  ASSERT_TRUE(answer.ok()) << answer.status();
  const auto [nx, ny, nz] = answer->cell_counts;
  ASSERT_EQ(answer->cells.size(), std::size_t{nx} * ny * nz * times_.size());
  EXPECT_EQ(nx, 23u);  // from -1.2 to 3.4
  std::size_t i = 0;
  for (std::size_t t = 0; t < times_.size(); ++t) {
    const SceneAtTime at(*scene_, times_[t]);
    std::uint64_t occupied = 0;
    for (unsigned z = 0; z < nz; ++z) {
      for (unsigned y = 0; y < ny; ++y) {
        for (unsigned x = 0; x < nx; ++x, ++i) {
          const Eigen::Vector3d p =
              answer->origin_W + 0.2 * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
          EXPECT_EQ(answer->cells[i], at.At(p).status);
          occupied += answer->cells[i] == SpaceStatus::kOccupied;
        }
      }
    }
    EXPECT_EQ(answer->counts[t].occupied, occupied);
  }
  EXPECT_TRUE(dut_.OccupancyOfBox(box, times_, false)->cells.empty());
}

TEST_F(QueriesTest, ASlice) {
  const SliceQuestion slice{.z_m = 0.3, .min_W = {-3, -2}, .max_W = {4, 2}, .cell_m = 0.25};
  const auto answer = dut_.OccupancyOfSlice(slice, times_);
  ASSERT_TRUE(answer.ok()) << answer.status();
  EXPECT_EQ(answer->columns, 28u);
  EXPECT_EQ(answer->rows, 16u);
  ASSERT_EQ(answer->cells.size(), 28u * 16 * times_.size());
  const SceneAtTime at(*scene_, times_[2]);
  for (unsigned row = 0; row < 16; ++row) {
    for (unsigned column = 0; column < 28; ++column) {
      const PointOccupancy truth =
          at.At({-3 + 0.25 * (column + 0.5), -2 + 0.25 * (row + 0.5), 0.3});
      const std::size_t i = 2 * 28 * 16 + row * 28 + column;
      EXPECT_EQ(answer->cells[i], truth.status);
      EXPECT_EQ(answer->objects[i], truth.object);
    }
  }
}

TEST_F(QueriesTest, Rays) {
  std::vector<Eigen::Vector3f> origins, directions;
  for (int i = 0; i < 100; ++i) {
    origins.push_back(random_.Vector(2).cast<float>());
    directions.push_back(random_.UnitVector().cast<float>());
  }
  const Time time[] = {scene_->stamp};
  const auto answer = dut_.CastRays(origins, directions, time, 10);
  ASSERT_TRUE(answer.ok()) << answer.status();
  const SceneAtTime at(*scene_, scene_->stamp);
  for (int i = 0; i < 100; ++i) {
    const RayAnswer truth =
        CastQueryRay(at, origins[i].cast<double>(), directions[i].cast<double>(), 10);
    EXPECT_EQ(answer->rays[i].first_hit_m, truth.first_hit_m);
    EXPECT_EQ(answer->rays[i].first_unknown_m, truth.first_unknown_m);
    EXPECT_EQ(answer->rays[i].object, truth.object);
  }
}

TEST_F(QueriesTest, ObjectsAndPredictions) {
  const auto list = dut_.ListObjects();
  ASSERT_TRUE(list.ok()) << list.status();
  const std::vector<ObjectInfo> objects = WithParts(*list);
  ASSERT_EQ(objects.size(), scene_->objects.size());
  for (const ObjectInfo& object : objects) {
    const MovingObject& truth = *scene_->FindObject(object.id);
    EXPECT_EQ(object.T_W_O, truth.history.back().T_W_O);
    EXPECT_EQ(object.part_of, truth.part_of);
    EXPECT_EQ(object.frames_seen, truth.frames_seen);
    EXPECT_EQ(object.occupied_voxels, truth.map_O.occupied_count());
    EXPECT_EQ(object.velocity_O, truth.velocity_O);
    EXPECT_EQ(object.bound.value_or(PositionBound{}), truth.bound);
    EXPECT_EQ(dut_.GetObject(truth.id)->id, truth.id);
    if (!object.parts.empty()) continue;  // its boxes and when it was seen are of all of it
    EXPECT_EQ(object.extent.size_m, ExtentOf(truth).size_m);
    EXPECT_EQ(object.extent.center_O, ExtentOf(truth).center_O);
    EXPECT_EQ(object.extent.yaw_rad, ExtentOf(truth).yaw_rad);
    EXPECT_EQ(dut_.GetObject(truth.id)->last_seen, truth.last_seen);
  }
  const auto poses = dut_.PredictPoses({}, times_);
  ASSERT_TRUE(poses.ok()) << poses.status();
  ASSERT_EQ(poses->poses.size(), scene_->objects.size() * times_.size());
  for (std::size_t i = 0; i < poses->poses.size(); ++i) {
    const PredictedPose truth = PredictPose(*scene_->objects[i / times_.size()],
                                            times_[i % times_.size()], scene_->params.horizon);
    EXPECT_EQ(poses->poses[i].T_W_O, truth.T_W_O);
    EXPECT_EQ(poses->poses[i].beyond_horizon_radius_m, truth.beyond_horizon_radius_m);
  }
  const ObjectId nobody[] = {4711};
  EXPECT_TRUE(absl::IsNotFound(dut_.PredictPoses(nobody, times_).status()));
}

TEST_F(QueriesTest, GivenObjectsAndFutures) {
  const Time now = scene_->stamp, then = now + FromSeconds(3);
  const GivenObject door[] = {{900, Box{{1, 0.05, 2}}, {now, Pose::Translation(3, 3, 1)}, {}, {}}};
  ASSERT_TRUE(dut_.AddObjects(door).ok());
  const ObjectFuture opens[] = {{900, {{then, Pose::Translation(4, 3, 1)}}}};
  const auto changed = dut_.SetFutures(opens);
  ASSERT_TRUE(changed.ok()) << changed.status();
  const auto info = dut_.GetObject(900, {.min_version = changed->version});
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_TRUE(info->given);
  EXPECT_EQ(info->future_end, then);
  EXPECT_EQ(info->occupied_voxels, 0);
  EXPECT_LT((info->extent.size_m - Eigen::Vector3d(1, 0.05, 2)).norm(), 1e-9);
  const ObjectId ids[] = {900};
  const Time middle[] = {now + FromSeconds(1.5)};
  const auto poses = dut_.PredictPoses(ids, middle);
  ASSERT_TRUE(poses.ok()) << poses.status();
  EXPECT_LT((poses->poses[0].T_W_O.translation - Eigen::Vector3d(3.5, 3, 1)).norm(), 1e-9);
  ASSERT_TRUE(dut_.RemoveObjects(ids).ok());
  const absl::Status gone = dut_.RemoveObjects(ids).status();
  EXPECT_TRUE(absl::IsNotFound(gone)) << gone;
  EXPECT_EQ(DetailsOf(gone).reason, "UNKNOWN_OBJECT");
}

TEST_F(QueriesTest, ALeaseHoldsItsVersion) {
  const auto lease = dut_.AcquireLease(std::chrono::seconds(60));
  ASSERT_TRUE(lease.ok()) << lease.status();
  ASSERT_TRUE(dut_.Reset().ok());
  EXPECT_EQ(dut_.ListObjects()->objects.size(), 0u);
  const auto held = dut_.ListObjects({.min_version = 0, .lease_id = lease->id});
  ASSERT_TRUE(held.ok()) << held.status();
  EXPECT_EQ(held->version, scene_->version);
  EXPECT_EQ(WithParts(*held).size(), scene_->objects.size());
  ASSERT_TRUE(dut_.ReleaseLease(lease->id).ok());
  const absl::Status gone = dut_.ListObjects({.min_version = 0, .lease_id = lease->id}).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(gone));
  EXPECT_EQ(DetailsOf(gone).reason, "LEASE_GONE");
}

TEST_F(QueriesTest, AQueryMayWaitForAVersion) {
  const absl::Status not_yet =
      dut_.ListObjects({.min_version = scene_->version + 1, .lease_id = ""}).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(not_yet)) << not_yet;
  EXPECT_TRUE(dut_.ListObjects({.min_version = scene_->version, .lease_id = ""}).ok());
}

TEST_F(QueriesTest, ACheckerLosesItsVersionWithItsLease) {
  const Robot ball = Robot::SingleShape("ball", Sphere{0.3});
  const auto checker = RemoteChecker::Pin(connection_, ball);
  ASSERT_TRUE(checker.ok()) << checker.status();
  const StateBatch state{{scene_->stamp}, {Pose{}}};
  EXPECT_TRUE((*checker)->Check(state, {}).ok());
  server_.core().leases.Release((*checker)->lease_id());
  EXPECT_TRUE(absl::IsFailedPrecondition((*checker)->Check(state, {}).status()));
}

TEST_F(QueriesTest, ARobotThatWasForgottenIsRegisteredAgain) {
  const auto checker = RemoteChecker::Pin(connection_, Robot::SingleShape("ball", Sphere{0.3}));
  ASSERT_TRUE(checker.ok()) << checker.status();
  for (int i = 0; i < 100; ++i) {
    const Robot other = Robot::SingleShape("ball", Sphere{1 + 0.01 * i});
    ASSERT_TRUE(server_.core().robots.Register(other, "client " + std::to_string(i)).ok());
  }
  EXPECT_LE(server_.core().robots.size(), server_.core().config.limits.max_robots);
  EXPECT_TRUE((*checker)->Check({{scene_->stamp}, {Pose{}}}, {}).ok());
}

TEST_F(QueriesTest, RemoteAndLocalChecksAgreeOnAMovingWorld) {
  const Robot robot = Robot::SingleShape("box", Box{{0.6, 0.4, 0.3}});
  const auto remote = RemoteChecker::Pin(connection_, robot);
  ASSERT_TRUE(remote.ok()) << remote.status();
  const SceneChecker local(scene_, robot);
  StateBatch states;
  for (int i = 0; i < 500; ++i) {
    states.times.push_back(times_[i % times_.size()]);
    states.T_W_L.push_back(random_.AnyPose(6));
  }
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  options.with_unknown_fraction = true;
  options.clearance_up_to_m = 1;
  const auto a = (*remote)->Check(states, options), b = local.Check(states, options);
  ASSERT_TRUE(a.ok() && b.ok()) << a.status() << b.status();
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(a->answers[i].status, b->answers[i].status);
    EXPECT_EQ(a->answers[i].object, b->answers[i].object);
    EXPECT_EQ(a->answers[i].clearance_m, b->answers[i].clearance_m);
    EXPECT_EQ(a->answers[i].unknown_fraction, b->answers[i].unknown_fraction);
  }
}

TEST_F(QueriesTest, ExportedMapsReadBack) {
  std::string file;
  const auto sink = [&](std::string_view bytes) {
    file.append(bytes);
    return absl::OkStatus();
  };
  ASSERT_TRUE(dut_.ExportMap(StaticMapTarget{}, MapFormat::kOt, sink).ok());
  const auto map = ParseOctomap("export", file, scene_->params.Model());
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->map.observed_count(), scene_->static_map_W.observed_count());
  EXPECT_EQ(map->map.occupied_count(), scene_->static_map_W.occupied_count());

  ASSERT_TRUE(dut_.Reset().ok());
  const auto loaded = dut_.LoadPrior(MapFormat::kOt, file);
  ASSERT_TRUE(loaded.ok()) << loaded.status();
  EXPECT_EQ(server_.Newest()->static_map_W.occupied_count(), scene_->static_map_W.occupied_count());
}

TEST_F(QueriesTest, ExportsEveryMapInEveryFormat) {
  const ExportTarget object = ObjectTarget{scene_->objects.front()->id};
  const ExportTarget scene_at = SceneAtTarget{scene_->stamp};
  const std::vector<std::pair<ExportTarget, MapFormat>> exports = {
      {StaticMapTarget{}, MapFormat::kBt},
      {StaticMapTarget{}, MapFormat::kPly},
      {object, MapFormat::kBt},
      {object, MapFormat::kOt},
      {object, MapFormat::kPly},
      {scene_at, MapFormat::kBt},
      {scene_at, MapFormat::kPly}};
  for (const auto& [target, format] : exports) {
    std::string file;
    const auto scene = dut_.ExportMap(target, format, [&](std::string_view bytes) {
      file.append(bytes);
      return absl::OkStatus();
    });
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_EQ(scene->version, scene_->version);
    EXPECT_EQ(file.rfind(format == MapFormat::kPly ? "ply" : "# Octomap", 0), 0u);
  }
  const absl::Status full =
      dut_.ExportMap(StaticMapTarget{}, MapFormat::kBt,
                     [](std::string_view) { return absl::DataLossError("disk full"); })
          .status();
  EXPECT_TRUE(absl::IsDataLoss(full));
}

TEST_F(QueriesTest, StatusAndInfo) {
  const auto status = dut_.GetStatus(true);
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->scene_hash, scene_->Hash());
  EXPECT_EQ(status->frames_applied, 30u);
  EXPECT_EQ(status->objects, scene_->objects.size());
  EXPECT_EQ(status->static_occupied_voxels,
            static_cast<std::uint64_t>(scene_->static_map_W.occupied_count()));
  EXPECT_FALSE(status->draining);
  const auto info = dut_.GetServerInfo();
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_EQ(info->limits, server_.core().config.limits);
  EXPECT_EQ(info->params, scene_->params);
}

}  // namespace
}  // namespace clearway
