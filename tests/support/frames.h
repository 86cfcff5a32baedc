// Small frames for tests.
#pragma once

#include <string>
#include <vector>

#include "clearway/scene/frame.h"
#include "clearway/scene/scene_builder.h"
#include "support/random.h"

namespace clearway::testing_support {

inline Time At(double seconds) { return Time(FromSeconds(seconds)); }

// A frame from a sensor at the world's origin.
inline Frame FrameAt(double seconds) {
  Frame frame;
  frame.sensor_id = "lidar";
  frame.sequence = static_cast<std::uint64_t>(seconds * 1000 + 0.5);
  frame.stamp = At(seconds);
  return frame;
}

inline void AddPoint(Frame& frame, ObjectId label, const Eigen::Vector3d& p_S) {
  frame.points_S.push_back(p_S.cast<float>());
  frame.labels.push_back(label);
}

// Where O begins (see FirstSight) if its first points lie about a corner of W's voxels of 0.1 m.
inline Eigen::Vector3d FirstOrigin(const Eigen::Vector3d& corner_W) {
  return corner_W + Eigen::Vector3d::Constant(0.025);
}

// Points on a grid over the surface of a box, given in the box's frame.
inline std::vector<Eigen::Vector3d> BoxSurface(const Eigen::Vector3d& size_m, double spacing_m) {
  std::vector<Eigen::Vector3d> points;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double a = -size_m[u] / 2; a <= size_m[u] / 2 + 1e-9; a += spacing_m) {
      for (double b = -size_m[v] / 2; b <= size_m[v] / 2 + 1e-9; b += spacing_m) {
        for (double side : {-0.5, 0.5}) {
          Eigen::Vector3d p;
          p[axis] = side * size_m[axis];
          p[u] = a;
          p[v] = b;
          points.push_back(p);
        }
      }
    }
  }
  return points;
}

inline void AddObject(Frame& frame, ObjectId id, const Pose& T_W_B,
                      const std::vector<Eigen::Vector3d>& points_B) {
  const Pose T_S_W = Inverse(frame.T_W_S);
  for (const Eigen::Vector3d& p_B : points_B) AddPoint(frame, id, T_S_W * (T_W_B * p_B));
}

// Points all over the place, other ones for each sequence: versions that differ by much, so that a
// few of them fill the buffers of a connection.
inline Frame ScatteredFrame(std::uint64_t sequence) {
  Frame frame = FrameAt(0.1 * static_cast<double>(sequence));
  frame.sequence = sequence;
  Random random(static_cast<unsigned>(sequence));
  for (int i = 0; i < 4000; ++i) AddPoint(frame, kStaticLabel, random.Vector(30));
  return frame;
}

// Random frames: static clutter, objects that come, go and come back, motions, poses, neither,
// parts of other objects.
class RandomFrames {
 public:
  explicit RandomFrames(unsigned seed) : random_(seed) {}

  Frame Next() {
    seconds_ += random_.Uniform(0.05, 0.3) + (random_.Integer(0, 14) == 0 ? 12.0 : 0.0);
    Frame frame = FrameAt(seconds_);
    frame.T_W_S = random_.AnyPose(2);
    for (int i = random_.Integer(0, 60); i > 0; --i)
      AddPoint(frame, kStaticLabel, random_.Vector(8));
    for (ObjectId id = 1; id <= 6; ++id) {
      const int kind = random_.Integer(0, 5);
      if (kind <= 3) {
        for (int i = random_.Integer(1, 15); i > 0; --i) {
          AddPoint(frame, id, random_.Vector(1) + Eigen::Vector3d(2 + id, 0, 0));
        }
      }
      if (kind == 1 || kind == 4) {
        const double angle_rad = random_.Uniform(-0.3, 0.3);
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad, random_.UnitVector()));
        frame.motions.push_back({id, {turn, random_.Vector(0.5)}, frame.stamp - FromSeconds(0.1)});
      } else if (kind == 2) {
        frame.poses.push_back({id, random_.AnyPose(6)});
      }
    }
    for (ObjectId part = 4; part <= 6; ++part) {
      if (random_.Integer(0, 9) == 0) frame.parts.push_back({part, random_.Integer(0, 3)});
    }
    return frame;
  }

 private:
  Random random_;
  double seconds_ = 0;
};

}  // namespace clearway::testing_support
