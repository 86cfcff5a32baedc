// A small LiDAR folder in UTM coordinates.
#pragma once

#include <string>

#include "absl/strings/str_cat.h"
#include "io/lidar_example.h"

namespace clearway {

// Four frames of a sensor that goes along x from (500000.25, 4100000.5, 1.5), with a van beside it.
inline void WriteUtmFolder(const TemporaryFolder& folder) {
  std::string poses = "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
  std::string boxes =
      "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,"
      "T23\n";
  for (int k = 0; k < 4; ++k) {
    absl::StrAppend(&poses, k, ",1,0,0,", 500'000 + k, ".25,0,1,0,4100000.5,0,0,1,1.5\n");
    absl::StrAppend(&boxes, k, ",7,Van,4,2,2,1,1,0,0,", 500'009 + k,
                    ".25,0,1,0,4100003.5,0,0,1,1\n");
    folder.Write(absl::StrCat("points/000", k, ".bin"),
                 PointBytes({{5, 2, -1.5, 0}, {9, 3, 0, 7}, {9.5, 3, 0.2f, 7}}));
  }
  folder.Write("poses.csv", poses);
  folder.Write("objects.csv", boxes);
}

}  // namespace clearway
