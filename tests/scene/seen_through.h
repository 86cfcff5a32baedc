// One is lost before a house, and another one seen where it would have come.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {

// What is seen of a road user, x forward.
struct RoadUserShape {
  std::vector<Aabb> boxes_B;
};
inline const Aabb kUpright{{-0.25, -0.2, -0.9}, {0.25, 0.2, 0.85}};
inline const RoadUserShape kPedestrian{{kUpright}};
inline const RoadUserShape kCyclist{{kUpright, {{-0.85, -0.2, -0.9}, {0.85, 0.2, 0}}}};
inline const RoadUserShape kChild{{{{-0.2, -0.2, -0.9}, {0.2, 0.2, 0.4}}}};
inline const RoadUserShape kBox{{{{-0.85, -0.2, -0.9}, {0.85, 0.2, 0.85}}}};
inline RoadUserShape CarWithRoofAt(double z_m) { return {{{{-1.5, -0.8, -1.5}, {1.5, 0.8, z_m}}}}; }

// Goes along x, before a house. The sensor is at the world's origin.
class SeenThrough : public testing::Test {
 protected:
  SeenThrough() {
    params_.motion = MotionModel::kTrack;
    params_.reidentify = true;
    BeginAnew();
  }
  void BeginAnew(const FrameLimits& limits = {}) {
    dut_.emplace(params_, limits, pool_);
    refused_ = absl::OkStatus();
  }
  void TearDown() override { EXPECT_TRUE(refused_.ok()) << refused_; }

  void See(ObjectId id, const RoadUserShape& shape, int from, int until) {
    for (int k = from; k < until; ++k) {
      const Pose T_W_B = PoseAt(k);
      Frame frame = testing_support::FrameAt(k * period_s_);
      if (k != missed_) AddSight(id, shape, T_W_B, frame);
      if (k > from && k != missed_) {
        const int before = k - 1 == missed_ ? k - 2 : k - 1;
        const Pose H_W = T_W_B * Inverse(PoseAt(before));
        frame.motions.push_back({id, H_W, testing_support::At(before * period_s_)});
      }
      if (background_s_) {
        Apply(frame);
        frame = testing_support::FrameAt(k * period_s_ + *background_s_);
      }
      if (k >= sky_until_ && k < sky_from_) AddBehind(shape, T_W_B, frame);
      Apply(frame);
    }
  }
  void SeeNobody(int from, int until) {
    for (int k = from; k < until; ++k) Apply(testing_support::FrameAt(k * period_s_));
  }
  bool Same(ObjectId a, ObjectId b) {
    const ScenePtr scene = dut_->Publish();
    return scene->FindObject(a) != nullptr && scene->FindObject(a) == scene->FindObject(b);
  }
  void LoseAndSee(const RoadUserShape& lost, const RoadUserShape& young) {
    See(1, lost, 0, 20);
    See(2, young, 30, 50);
  }

  // What the published scene holds; and what of the frames was refused, until it is asked.
  std::size_t BlocksOfScene() {
    const ScenePtr scene = dut_->Publish();
    std::size_t blocks = scene->static_map_W.blocks().size();
    for (const auto& object : scene->objects) blocks += object->map_O.blocks().size();
    return blocks;
  }
  absl::Status Refused() { return std::exchange(refused_, absl::OkStatus()); }

  SceneParams params_;
  // Before one of the frames, and from the other on, nothing lies behind.
  int sky_until_ = 0, sky_from_ = 1000;
  // In that frame the source misses the object.
  int missed_ = -1;
  double period_s_ = 0.1;
  // Static points come in another frame, so much later.
  std::optional<double> background_s_;
  // A wall before it, from so far ahead of its middle on.
  std::optional<double> wall_from_m_;
  // All of it, object and house, is hit by beams that are so far apart.
  std::optional<double> beams_apart_deg_;
  double beams_reach_deg_ = 0.25;  // to either side
  // Everything is so many times as far away.
  double farther_x_ = 1;
  // A rail before the object hides what is up to 0.2 m above and below that height.
  std::optional<double> rail_m_;
  // The source tells rays in a frame whose origin is so far from where they begin.
  std::optional<double> origins_off_m_;
  // Of the object, the faces that are not hit, by their normals.
  std::vector<Eigen::Vector3d> unseen_faces_;
  // So far ahead of where it would have come.
  double ahead_m_ = 0;

 private:
  static constexpr double kLaneM = 6, kWallM = 4, kHouseM = 9;

  Pose PoseAt(int k) const {
    return Pose::Translation(0.15 * k - 3 + ahead_m_, farther_x_ * kLaneM, 0);
  }

  // Of its surface, all that is not behind the wall.
  void AddSight(ObjectId id, const RoadUserShape& shape, const Pose& T_W_B, Frame& frame) const {
    for (const Aabb& box_B : shape.boxes_B) {
      const Eigen::Vector3d center_B = box_B.Center();
      std::vector<Eigen::Vector3d> surface =
          testing_support::BoxSurface(box_B.max - box_B.min, 0.06);
      std::erase_if(surface, [&](const Eigen::Vector3d& p) {
        const auto is_of = [&](const Eigen::Vector3d& normal) {
          return normal.dot(p) > box_B.Size().dot(normal.cwiseAbs()) / 2 - 1e-6;
        };
        return (wall_from_m_ && (center_B + p).x() > *wall_from_m_) ||
               IsHidden(T_W_B * (center_B + p)) || std::ranges::any_of(unseen_faces_, is_of);
      });
      testing_support::AddObject(frame, id, T_W_B * Pose{.translation = center_B}, surface);
    }
  }
  bool IsHidden(const Eigen::Vector3d& p_W) const {
    if (rail_m_ && std::abs(p_W.z() - *rail_m_) < 0.2) return true;
    if (!beams_apart_deg_) return false;
    const double up_deg = std::atan2(p_W.z(), p_W.head<2>().norm()) * 180 / std::numbers::pi;
    return std::abs(std::remainder(up_deg, *beams_apart_deg_)) > beams_reach_deg_;
  }
  // Of the house, what the sensor sees beside the object and the wall; and that wall.
  void AddBehind(const RoadUserShape& shape, const Pose& T_W_B, Frame& frame) const {
    for (double x = -8; x < 8; x += 0.1) {
      for (double z = -2; z < 2; z += 0.1) {
        const Eigen::Vector3d p_W = farther_x_ * Eigen::Vector3d(x, kHouseM, z);
        const Eigen::Vector3d at_wall_W = p_W * kWallM / kHouseM,
                              at_lane_W = p_W * kLaneM / kHouseM;
        if (IsHidden(at_lane_W)) continue;
        const double ahead_m = (at_lane_W - T_W_B.translation).x();
        if (wall_from_m_ && ahead_m > *wall_from_m_) {
          testing_support::AddPoint(frame, kStaticLabel, at_wall_W);
        } else if (!Hides(shape, T_W_B, p_W)) {
          testing_support::AddPoint(frame, kStaticLabel, p_W);
        }
      }
    }
  }
  static bool Hides(const RoadUserShape& shape, const Pose& T_W_B, const Eigen::Vector3d& p_W) {
    const Pose T_B_W = Inverse(T_W_B);
    const Eigen::Vector3d sensor_B = T_B_W.translation;
    return std::ranges::any_of(shape.boxes_B, [&](const Aabb& box_B) {
      const auto [begin, end] = Clip(box_B, sensor_B, T_B_W * p_W - sensor_B, {0, 1});
      return begin <= end;
    });
  }

  void Apply(Frame frame) {
    if (origins_off_m_) {
      const Eigen::Vector3d off_m(0, *origins_off_m_, 0);
      frame.T_W_S.translation -= off_m;
      for (Eigen::Vector3f& p_S : frame.points_S) p_S += off_m.cast<float>();
      frame.origins_S.assign(frame.points_S.size(), off_m.cast<float>());
    }
    const auto report = dut_->Apply(frame);
    if (!report.ok() && refused_.ok()) refused_ = report.status();
  }

  ThreadPool pool_{1};
  std::optional<SceneBuilder> dut_;
  absl::Status refused_;
};

}  // namespace clearway
