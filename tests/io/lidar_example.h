// A small LiDAR folder for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string>

#include "clearway/io/lidar_folder.h"
#include "support/temporary_folder.h"

namespace clearway {

inline constexpr char kPoses[] =
    "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
    "4,1,0,0,0,0,1,0,0,0,0,1,1.5\n"
    "5,1,0,0,1,0,1,0,0,0,0,1,1.5\n"
    "6,1,0,0,2,0,1,0,0,0,0,1,1.5\n";
inline constexpr char kObjects[] =
    "frame,track,type,occluded,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
    "5,2,Van,0,4,2,2,1,1,0,0,10,0,1,0,3,0,0,1,1\n"
    "4,2,Van,0,4,2,2,1,1,0,0,9,0,1,0,3,0,0,1,1\n"
    "6,2,\"Van, white\",0,4,2,2,0,0,-1,0,10,1,0,0,3,0,0,1,1\n"
    "6,3,Cyclist,0,2,1,2,0,1,0,0,5,0,1,0,5,0,0,1,1\n";

struct LabelledPoint {
  float x, y, z;
  std::int16_t label;
};

// The bytes of a file of points.
inline std::string PointBytes(std::initializer_list<LabelledPoint> points) {
  std::string bytes;
  for (const LabelledPoint& point : points) {
    bytes.append(reinterpret_cast<const char*>(&point), 14);  // without the padding at the end
  }
  return bytes;
}

// Three frames, 4 to 6, of one van that moves 1 m, then turns a quarter.
inline void WriteExample(const TemporaryFolder& folder) {
  folder.Write("poses_icp.csv", kPoses);
  folder.Write("objects_icp.csv", kObjects);
  folder.Write("points/0004.bin", PointBytes({{1, 2, 3, 0}, {4, 5, 6, 2}, {7, 8, 9, -1}}));
  folder.Write("points/0005.bin", PointBytes({{1, 1, 1, 77}}));
  folder.Write("points/0006.bin", "");
}

inline std::string ErrorOf(const TemporaryFolder& folder, const LidarFolderOptions& options = {}) {
  const auto opened = OpenLidarFolder(folder.path(), options);
  EXPECT_FALSE(opened.ok());
  return std::string(opened.status().message());
}

}  // namespace clearway
