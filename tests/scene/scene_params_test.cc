#include "clearway/scene/scene_params.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace clearway {
namespace {

template <class Change>
void ExpectRefused(Change change, const char* field) {
  SceneParams params;
  change(params);
  const absl::Status status = Validate(params);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(field));
}

TEST(SceneParams, DefaultsAreValid) { EXPECT_TRUE(Validate(SceneParams{}).ok()); }

TEST(SceneParams, RefusesEachFieldByName) {
  ExpectRefused([](auto& p) { p.resolution_m = 0; }, "resolution_m");
  ExpectRefused([](auto& p) { p.object_resolution_m = NAN; }, "object_resolution_m");
  ExpectRefused([](auto& p) { p.occupancy.hit = 2; }, "probability_hit");
  ExpectRefused([](auto& p) { p.rays.max_range_m = 0; }, "max_range_m");
  ExpectRefused([](auto& p) { p.rays.max_range_m = INFINITY; }, "max_range_m");
  ExpectRefused([](auto& p) { p.rays.grazing_m = -1; }, "grazing_m");
  ExpectRefused([](auto& p) { p.rays.grazing_m = NAN; }, "grazing_m");
  ExpectRefused([](auto& p) { p.horizon = std::chrono::seconds(-1); }, "horizon_s");
  ExpectRefused([](auto& p) { p.object_lifetime = std::chrono::hours(25); }, "object_lifetime_s");
  ExpectRefused([](auto& p) { p.rest_distance_m = -0.1; }, "rest_distance_m");
  ExpectRefused([](auto& p) { p.rest_distance_m = NAN; }, "rest_distance_m");
  ExpectRefused([](auto& p) { p.object_pose_error_m = 11; }, "object_pose_error_m");
  ExpectRefused([](auto& p) { p.object_pose_error_rad = NAN; }, "object_pose_error_rad");
  ExpectRefused([](auto& p) { p.sensor_pose_error_m = -1; }, "sensor_pose_error_m");
  ExpectRefused([](auto& p) { p.sensor_pose_error_rad = 2; }, "sensor_pose_error_rad");
  ExpectRefused([](auto& p) { p.keep_distance_m = 0.5; }, "keep_distance_m");
  ExpectRefused([](auto& p) { p.keep_distance_m = NAN; }, "keep_distance_m");
  ExpectRefused([](auto& p) { p.bounds_W = Aabb{}; }, "bounds");
  ExpectRefused([](auto& p) { p.keep_out_W = {Aabb{{0, 0, 0}, {-1, 0, 0}}}; }, "keep_out[0]");
}

}  // namespace
}  // namespace clearway
