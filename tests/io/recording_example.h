// Frames for the tests of recordings.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "clearway/io/recording.h"
#include "io/sqlite.h"

namespace clearway {

// Every field holds something, with numbers that decimal digits would lose.
inline Frame ExampleFrame(std::uint64_t sequence) {
  Frame frame;
  frame.sensor_id = "lidar front";
  frame.sensor_run = 0x8000'0000'0000'0001;
  frame.sequence = std::numeric_limits<std::uint64_t>::max() - sequence;
  frame.stamp = TimeFromNanoseconds(315973157959879000 + 100 * static_cast<int>(sequence));
  frame.T_W_S = {Eigen::Quaterniond(0.1, -0.2, 0.3, 1.0 / 3.0), {-0.0, 1e-300, 1.0 / 7.0}};
  for (int i = 0; i < 50; ++i) {
    frame.points_S.emplace_back(0.1f * i, -1.0f / 3.0f, std::numeric_limits<float>::quiet_NaN());
    frame.labels.push_back(i % 5 - 1);
    frame.no_return.push_back(i % 2);
    frame.origins_S.emplace_back(0.0f, 1e-42f * i, -0.0f);
  }
  frame.motions.push_back({3, Pose::Translation(1.0 / 3.0, 2, 3), frame.stamp - Duration(7)});
  frame.poses.push_back({1, Pose::Translation(5e300, -1.0 / 9.0, 0)});
  return frame;
}

template <class T>
inline bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool SameBits(const Pose& a, const Pose& b) {
  return std::memcmp(a.rotation.coeffs().data(), b.rotation.coeffs().data(), 32) == 0 &&
         std::memcmp(a.translation.data(), b.translation.data(), 24) == 0;
}

inline bool SameBits(const Frame& a, const Frame& b) {
  const auto same_motion = [](const ObjectMotion& x, const ObjectMotion& y) {
    return x.id == y.id && x.from == y.from && SameBits(x.H_W, y.H_W);
  };
  const auto same_pose = [](const ObjectPose& x, const ObjectPose& y) {
    return x.id == y.id && SameBits(x.T_W_B, y.T_W_B);
  };
  return a.sensor_id == b.sensor_id && a.sensor_run == b.sensor_run && a.sequence == b.sequence &&
         a.stamp == b.stamp && SameBits(a.T_W_S, b.T_W_S) && SameBits(a.points_S, b.points_S) &&
         a.labels == b.labels && a.no_return == b.no_return && SameBits(a.origins_S, b.origins_S) &&
         std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(), b.motions.end(),
                    same_motion) &&
         std::equal(a.poses.begin(), a.poses.end(), b.poses.begin(), b.poses.end(), same_pose);
}

inline void WriteFrames(const std::filesystem::path& path, const std::vector<Frame>& frames,
                        const RecordingOptions& options = {}) {
  auto dut = RecordingWriter::Create(path, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (const Frame& frame : frames) ASSERT_TRUE((*dut)->Append(frame).ok());
  ASSERT_TRUE((*dut)->Close().ok());
}

inline void ChangeDatabase(const std::filesystem::path& path, const std::string& sql) {
  auto database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kCreate);
  ASSERT_TRUE(database.ok()) << database.status();
  ASSERT_TRUE(database->Execute(sql).ok()) << database->Execute(sql);
}

}  // namespace clearway
