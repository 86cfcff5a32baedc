// Small logs as DynoSAM writes them.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/io/dynosam.h"
#include "support/temporary_folder.h"

namespace clearway {

// As published, with and without stamps. Ground truth is the identity where there is none.
inline constexpr char kDynosamCamera[] =
    "frame_id,"
    "tx,ty,tz,qx,qy,qz,qw,gt_tx,gt_ty,gt_tz,gt_qx,gt_qy,gt_qz,gt_qw";
inline constexpr char kDynosamObject[] =
    "frame_id,object_id,"
    "tx,ty,tz,qx,qy,qz,qw,gt_tx,gt_ty,gt_tz,gt_qx,gt_qy,gt_qz,gt_qw";
inline constexpr char kDynosamStampedCamera[] =
    "timestamp,frame_id,"
    "tx,ty,tz,qx,qy,qz,qw,gt_tx,gt_ty,gt_tz,gt_qx,gt_qy,gt_qz,gt_qw";
inline constexpr char kDynosamStampedObject[] =
    "timestamp,frame_id,object_id,"
    "tx,ty,tz,qx,qy,qz,qw,gt_tx,gt_ty,gt_tz,gt_qx,gt_qy,gt_qz,gt_qw";
inline constexpr char kDynosamPoints[] = "frame_id,object_id,tracklet_id,x_world,y_world,z_world";
inline constexpr char kDynosamTruth[] = ",0,0,0,0,0,0,1";
inline constexpr char kDynosamNoFrame[] = "18446744073709551615";

// A header and rows: the last line does not end, as CsvWriter leaves it.
inline std::string DynosamLog(const std::string& header, std::initializer_list<std::string> rows,
                              const std::string& end = "") {
  std::string text = header + "\n";
  const char* separator = "";
  for (const std::string& row : rows) {
    absl::StrAppend(&text, separator, row, end);
    separator = "\n";
  }
  return text;
}

inline std::string DynosamCameraLog(std::initializer_list<std::string> rows) {
  return DynosamLog(kDynosamCamera, rows, kDynosamTruth);
}
inline std::string DynosamObjectLog(std::initializer_list<std::string> rows) {
  return DynosamLog(kDynosamObject, rows, kDynosamTruth);
}

// Three frames of a camera that goes along W's z and in the second looks along W's x; object 7
// goes 0.2 m a frame along x and is first seen in frame 1, object 9 in frame 3.
class Dynosam : public testing::Test {
 protected:
  Dynosam() { WriteModule("rgbd_motion_world_backend"); }

  void WriteModule(const std::string& module) {
    folder_.Write(
        module + "_camera_pose_log.csv",
        DynosamCameraLog({"1,0,0,0.1,0,0,0,1", "2,0,0,0.2,0,0.707106781186547,0,0.707106781186548",
                          "3,0,0,0.3,0,0,0,1"}));
    folder_.Write(module + "_object_pose_log.csv",
                  DynosamObjectLog({"1,7,1,0,5,0,0,0,1", "2,7,1.2,0,5,0,0,0,1",
                                    "3,7,1.4,0,5,0,0,0,1", "3,9,-4,0,8,0,0,0,1"}));
    folder_.Write(module + "_object_motion_log.csv",
                  DynosamObjectLog({"1,7,0,0,0,0,0,0,1", "2,7,0.2,0,0,0,0,0,1",
                                    "3,7,0.2,0,0,0,0,0,1", "3,9,0,0,1e-17,0,0,0,1"}));
    folder_.Write(module + "_map_points_log.csv",
                  DynosamLog(kDynosamPoints,
                             {absl::StrCat(kDynosamNoFrame, ",0,11,3,1,6"), "1,7,21,1,0.5,5.1",
                              "2,7,21,1.2,0.5,5.2", "2,0,12,2,1,0.2", "3,9,31,-4,0,8"}));
  }
  std::string Name(const std::string& log) const {
    return absl::StrCat("rgbd_motion_world_backend_", log, "_log.csv");
  }
  absl::StatusOr<LidarFolder> Open(const DynosamOptions& options = {}) {
    return OpenDynosam(folder_.path(), options);
  }

  TemporaryFolder folder_;
};

}  // namespace clearway
