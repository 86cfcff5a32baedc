// Small recordings as CARLA's clients leave them. CARLA's side is written down here once more, from
// its documentation, so that nothing of the reader is compared with itself.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/io/carla.h"
#include "support/temporary_folder.h"

namespace clearway {

// In CARLA's left-handed frames: x forward, y right, z up; metres and degrees.
struct CarlaPlace {
  double x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0;

  // What carla.Transform.get_matrix() is documented to be.
  Eigen::Matrix4d Matrix() const {
    const double to_rad = std::numbers::pi / 180;
    const double cr = std::cos(roll * to_rad), sr = std::sin(roll * to_rad);
    const double cp = std::cos(pitch * to_rad), sp = std::sin(pitch * to_rad);
    const double cy = std::cos(yaw * to_rad), sy = std::sin(yaw * to_rad);
    Eigen::Matrix4d m;
    m << cp * cy, cy * sp * sr - sy * cr, -cy * sp * cr - sy * sr, x,  //
        cp * sy, sy * sp * sr + cy * cr, -sy * sp * cr + cy * sr, y,   //
        sp, -cp * sr, cp * cr, z,                                      //
        0, 0, 0, 1;
    return m;
  }
  std::string Fields() const {
    return absl::StrFormat("%.9f,%.9f,%.9f,%.9f,%.9f,%.9f", x, y, z, roll, pitch, yaw);
  }
};

struct CarlaHit {
  Eigen::Vector3d p;  // in CARLA's world, or in its sensor's frame
  unsigned actor = 0, tag = 0;
};

// What SemanticLidarMeasurement.save_to_disk writes.
inline std::string CarlaPly(const std::vector<CarlaHit>& hits_S) {
  std::string text = absl::StrCat("ply\nformat ascii 1.0\nelement vertex ", hits_S.size(),
                                  "\n"
                                  "property float32 x\nproperty float32 y\nproperty float32 z\n"
                                  "property float32 CosAngle\nproperty uint32 ObjIdx\n"
                                  "property uint32 ObjTag\nend_header\n");
  for (const CarlaHit& hit : hits_S) {
    absl::StrAppendFormat(&text, "%.4f %.4f %.4f %.4f %u %u\n", hit.p.x(), hit.p.y(), hit.p.z(),
                          0.5, hit.actor, hit.tag);
  }
  return text;
}

// The scan that a sensor there makes of what is in CARLA's world.
inline std::string CarlaScan(const CarlaPlace& sensor, std::vector<CarlaHit> hits_W) {
  const Eigen::Matrix4d inverse = sensor.Matrix().inverse();
  for (CarlaHit& hit : hits_W) hit.p = (inverse * hit.p.homogeneous()).head<3>();
  return CarlaPly(hits_W);
}

// The same point where y goes to the left.
inline Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) { return {p.x(), -p.y(), p.z()}; }

inline constexpr char kCarlaSensor[] = "frame,timestamp,x,y,z,roll,pitch,yaw\n";
inline constexpr char kCarlaActors[] = "frame,id,type,x,y,z,roll,pitch,yaw\n";
inline constexpr char kCarlaBoxes[] =
    "frame,id,type,x,y,z,roll,pitch,yaw,box_x,box_y,box_z,extent_x,extent_y,extent_z\n";

// Frames 120 and 121, 0.1 s apart: a car, 31, goes 1 m along x; a traffic light has an id, too.
class Carla : public testing::Test {
 protected:
  Carla() {
    folder_.Write("carla_sensor.csv", absl::StrCat(kCarlaSensor, "120,12.000000001,0,0,2,0,0,0\n",
                                                   "121,12.10000000149012,1,0,2,0,0,0\n"));
    folder_.Write("carla_actors.csv",
                  absl::StrCat(kCarlaActors, "120,31,vehicle.audi.tt,10,3,0,0,0,0\n",
                               "121,31,vehicle.audi.tt,11,3,0,0,0,0\n"));
    for (const char* name : {"000120.ply", "000121.ply"}) {
      folder_.Write(name, CarlaPly({{{9, 3, -1.5}, 31, 14}, {{8, -2, 1}, 17, 7}, {{5, 0, -2}}}));
    }
  }
  absl::StatusOr<LidarFolder> Open(const LidarFolderOptions& options = {}) {
    return OpenCarla(folder_.path(), options);
  }

  TemporaryFolder folder_;
};

}  // namespace clearway
