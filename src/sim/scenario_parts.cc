#include "sim/scenario_parts.h"

#include <utility>

#include "sim/meshes.h"

namespace clearway {

Pose PlacedAt(double x_m, double y_m, double z_m, double yaw_rad) {
  return {Exp({{0, 0, yaw_rad}, Eigen::Vector3d::Zero()}).rotation, {x_m, y_m, z_m}};
}

Pose LookingAt(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& target_W) {
  Eigen::Matrix<double, 3, 4> T_W_S;
  const Eigen::Vector3d forward = (target_W - eye_W).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  T_W_S << right, forward.cross(right), forward, eye_W;
  return Pose::FromMatrix(T_W_S);
}

Time AtSeconds(double seconds) { return Time(FromSeconds(seconds)); }

Body StaticBox(std::string name, const Pose& T_W_B, const Eigen::Vector3d& size_m) {
  return Body::Single(kStaticLabel, std::move(name), Box{size_m}, FixedPose{T_W_B});
}

Body Pole(std::string name, double x_m, double y_m, double radius_m, double height_m) {
  return Body::Single(kStaticLabel, std::move(name), Cylinder{radius_m, height_m},
                      FixedPose{PlacedAt(x_m, y_m, kGroundZM + height_m / 2)});
}

Body Ground(double x_m, double y_m, double size_m, double ground_z_m) {
  return StaticBox("ground", PlacedAt(x_m, y_m, ground_z_m - 0.5), {size_m, size_m, 1});
}

Body Car(ObjectId id, Trajectory trajectory) {
  return {id,
          "car",
          {{Box{{4.4, 1.8, 0.72}}, Pose::Translation(0, 0, -0.30)},
           {Box{{2.3, 1.6, 0.60}}, Pose::Translation(-0.2, 0, 0.36)}},
          std::move(trajectory)};
}

Body Hatchback(ObjectId id, Trajectory trajectory) {
  // From the side, nose to the right; the first point is on the underside.
  static const auto mesh = Extruded({{0, -0.66},
                                     {1.9, -0.66},
                                     {2.0, -0.1},
                                     {1.9, 0.05},
                                     {1.1, 0.15},
                                     {0.5, 0.66},
                                     {-1.5, 0.66},
                                     {-2.0, 0.1},
                                     {-2.0, -0.66}},
                                    1.7);
  return Body::Single(id, "hatchback", TriangleMesh{mesh}, std::move(trajectory));
}

Body Van(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "van", Box{{5.2, 2.0, 2.1}}, std::move(trajectory));
}

Body Truck(ObjectId id, Trajectory trajectory) {
  return {id,
          "truck",
          {{Box{{2.1, 2.4, 2.6}}, Pose::Translation(2.7, 0, -0.25)},
           {Box{{5.3, 2.4, 3.1}}, Pose::Translation(-1.1, 0, 0)}},
          std::move(trajectory)};
}

Body Cyclist(ObjectId id, Trajectory trajectory) {
  return {id,
          "cyclist",
          {{Box{{1.7, 0.24, 0.98}}, Pose::Translation(0, 0, -0.40)},
           {Capsule{0.22, 0.60}, Pose::Translation(-0.1, 0, 0.37)}},
          std::move(trajectory)};
}

Body Pedestrian(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "pedestrian", Cylinder{0.3, 1.74}, std::move(trajectory));
}

}  // namespace clearway
