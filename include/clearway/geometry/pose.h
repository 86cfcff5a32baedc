// Rigid transforms in the notation of docs/notation.md: T_A_B maps coordinates in B to coordinates
// in A.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

namespace clearway {

// A rigid transform T_A_B: p_A = rotation * p_B + translation. A value type; safe to read from any
// thread. The rotation is a unit quaternion; Compose and the functions below renormalise it, so
// that products of thousands of poses stay rigid.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // metres

  static Pose FromMatrix(const Eigen::Matrix<double, 3, 4>& matrix);
  static Pose Translation(double x_m, double y_m, double z_m);

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const {
    return rotation * p_B + translation;
  }
  bool operator==(const Pose& other) const {
    return rotation.coeffs() == other.rotation.coeffs() && translation == other.translation;
  }
};

// points_A[i] = T_A_B * points_B[i], bit for bit; faster than one by one.
void TransformAll(const Pose& T_A_B, std::span<const Eigen::Vector3f> points_B,
                  Eigen::Vector3d* points_A);

// T_A_B * T_B_C = T_A_C.
Pose operator*(const Pose& T_A_B, const Pose& T_B_C);

// T_A_B -> T_B_A.
Pose Inverse(const Pose& T_A_B);

// A rigid velocity or displacement, expressed in the moving frame and taken at its origin: radians
// and metres (a displacement), or those per second (a velocity).
struct Twist {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();

  bool operator==(const Twist& other) const {
    return angular == other.angular && linear == other.linear;
  }
};

inline Twist operator*(double scale, const Twist& twist) {
  return {scale * twist.angular, scale * twist.linear};
}

// The constant screw that carries a frame by `displacement` (SE(3) exponential map), and its
// inverse. Log takes the rotation by the shorter way; at exactly half a turn the axis' sign is
// arbitrary. Murray, Li, Sastry, "A Mathematical Introduction to Robotic Manipulation", 1994,
// section 2.3.
Pose Exp(const Twist& displacement);
Twist Log(const Pose& displacement);

// The pose at `fraction` of the screw from T_W_A to T_W_B (0: T_W_A, 1: T_W_B); also extrapolates.
Pose Interpolate(const Pose& T_W_A, const Pose& T_W_B, double fraction);

}  // namespace clearway
