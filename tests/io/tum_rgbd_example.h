// A small sequence in the layout of the TUM RGB-D benchmark.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "clearway/io/tum_rgbd.h"
#include "io/png_example.h"
#include "support/temporary_folder.h"

namespace clearway {

// As published: comments above the rows.
inline constexpr char kTumDepth[] =
    "# depth maps\n# file: 'rgbd_dataset_freiburg9_test.bag'\n# timestamp filename\n"
    "1305031102.100000 depth/a.png\n"
    "1305031102.133000 depth/b.png\n"
    "1305031102.166000 depth/c.png\n";
// The camera goes 1 m/s along W's x and looks along W's z; the last poses come late.
inline constexpr char kTumTrack[] =
    "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n"
    "1305031102.0900 0.0900 0 0 0 0 0 1\n"
    "1305031102.1100 0.1100 0 0 0 0 0 1\n"
    "1305031102.1330 0.1330 0 0 0 0 0.0001 1.0001\n"
    "1305031102.1500 0.1500 0 0 0 0 0 1\n"
    "1305031102.9000 0.9000 0 0 0 0 0 1\n";
inline constexpr char kTumCamera[] = "# fx fy cx cy\n100 200 1.5 1\n";
inline constexpr char kTumMasks[] =
    "1305031102.105000 mask/a.png\n1305031102.140000 mask/b.png\n1305031102.170000 mask/c.png\n";
inline constexpr char kTumObjects[] =
    "# timestamp id tx ty tz qx qy qz qw\n"
    "1305031102.1000 7 0 0 2 0 0 0 1\n"
    "1305031102.1000 9 5 0 2 0 0 0 1\n"
    "1305031102.1230 7 0.023 0 2 0 0 0 1\n"
    "1305031102.1430 7 0.043 0 2 0 0 0 1\n"
    "1305031102.1660 7 0.066 0 2 0 0 0 1\n";
inline constexpr std::int64_t kStart_ns = 1'305'031'102'000'000'000;

inline Time At_ms(std::int64_t ms) { return TimeFromNanoseconds(kStart_ns + ms * 1'000'000); }

inline std::string DepthPng(int count) {
  return PngBytes(4, 3, {count, 0, 0, 0, 0, 0, count, 0, 0, 0, 0, 2 * count});
}

// Three images of a camera, with masks and poses of objects on request.
class TumRgbd : public testing::Test {
 protected:
  TumRgbd() {
    folder_.Write("depth.txt", kTumDepth);
    folder_.Write("groundtruth.txt", kTumTrack);
    folder_.Write("camera.txt", kTumCamera);
    folder_.Write("depth/a.png", DepthPng(5000));
    folder_.Write("depth/b.png", DepthPng(10'000));
    folder_.Write("depth/c.png", DepthPng(15'000));
  }
  void WriteObjects() {
    folder_.Write("mask.txt", kTumMasks);
    for (const char* name : {"mask/a.png", "mask/b.png", "mask/c.png"}) {
      folder_.Write(name, PngBytes(4, 3, {7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9}, {.bits = 8}));
    }
    folder_.Write("object_poses.txt", kTumObjects);
  }
  absl::StatusOr<LidarFolder> Open(const TumRgbdOptions& options = {}) {
    return OpenTumRgbd(folder_.path(), options);
  }

  TemporaryFolder folder_;
};

}  // namespace clearway
