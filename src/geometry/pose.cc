#include "clearway/geometry/pose.h"

#include <cmath>

#include "base/multiversion.h"

namespace clearway {
namespace {

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Below this angle the closed forms lose digits and their series are exact to double precision.
constexpr double kSmallAngle = 1e-4;

// A pose's quaternion and translation, as plain numbers.
struct Coefficients {
  double x, y, z, w;
  double t[3];
};

// The operations of Eigen's Quaternion::_transformVector in their order, so that they round alike.
CLEARWAY_MULTIVERSION void Transform(const Coefficients& T, const float* p_B, std::size_t count,
                                     double* p_A) {
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    const double x = p_B[i], y = p_B[i + 1], z = p_B[i + 2];
    const double ux = 2 * (T.y * z - T.z * y);
    const double uy = 2 * (T.z * x - T.x * z);
    const double uz = 2 * (T.x * y - T.y * x);
    p_A[i] = x + T.w * ux + (T.y * uz - T.z * uy) + T.t[0];
    p_A[i + 1] = y + T.w * uy + (T.z * ux - T.x * uz) + T.t[1];
    p_A[i + 2] = z + T.w * uz + (T.x * uy - T.y * ux) + T.t[2];
  }
}
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));

}  // namespace

Pose Pose::FromMatrix(const Eigen::Matrix<double, 3, 4>& matrix) {
  return {Eigen::Quaterniond(matrix.leftCols<3>()).normalized(), matrix.col(3)};
}

Pose Pose::Translation(double x_m, double y_m, double z_m) {
  return {Eigen::Quaterniond::Identity(), {x_m, y_m, z_m}};
}

void TransformAll(const Pose& T_A_B, std::span<const Eigen::Vector3f> points_B,
                  Eigen::Vector3d* points_A) {
  if (points_B.empty()) return;
  const Eigen::Quaterniond& q = T_A_B.rotation;
  const Eigen::Vector3d& t = T_A_B.translation;
  Transform({q.x(), q.y(), q.z(), q.w(), {t.x(), t.y(), t.z()}}, points_B[0].data(),
            points_B.size(), points_A->data());
}

Pose operator*(const Pose& T_A_B, const Pose& T_B_C) {
  return {(T_A_B.rotation * T_B_C.rotation).normalized(), T_A_B * T_B_C.translation};
}

Pose Inverse(const Pose& T_A_B) {
  const Eigen::Quaterniond R_B_A = T_A_B.rotation.conjugate();
  return {R_B_A, -(R_B_A * T_A_B.translation)};
}

Pose Exp(const Twist& displacement) {
  const Eigen::Vector3d& w = displacement.angular;
  const double angle2 = w.squaredNorm();
  if (angle2 == 0) return {Eigen::Quaterniond::Identity(), displacement.linear};
  const double angle = std::sqrt(angle2);
  const bool small = angle < kSmallAngle;
  const double half_sinc = small ? 0.5 - angle2 / 48.0 : std::sin(angle / 2) / angle;
  const double b = small ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double c =
      small ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  const Eigen::Vector3d vector_part = half_sinc * w;
  Eigen::Quaterniond rotation(std::cos(angle / 2), vector_part.x(), vector_part.y(),
                              vector_part.z());
  const Eigen::Matrix3d W = Skew(w);
  const Eigen::Matrix3d V = Eigen::Matrix3d::Identity() + b * W + c * W * W;
  return {rotation.normalized(), V * displacement.linear};
}

Twist Log(const Pose& displacement) {
  Eigen::Quaterniond q = displacement.rotation;
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sin_half = q.vec().norm();
  if (sin_half == 0) return {Eigen::Vector3d::Zero(), displacement.translation};
  const double angle = 2 * std::atan2(sin_half, q.w());
  const bool small = angle < kSmallAngle;
  const Eigen::Vector3d w = (small ? 2.0 + angle * angle / 12.0 : angle / sin_half) * q.vec();
  const double d = small ? 1.0 / 12.0 + angle * angle / 720.0
                         : (1.0 - angle / 2 / std::tan(angle / 2)) / (angle * angle);
  const Eigen::Matrix3d W = Skew(w);
  const Eigen::Matrix3d V_inverse = Eigen::Matrix3d::Identity() - 0.5 * W + d * W * W;
  return {w, V_inverse * displacement.translation};
}

Pose Interpolate(const Pose& T_W_A, const Pose& T_W_B, double fraction) {
  return T_W_A * Exp(fraction * Log(Inverse(T_W_A) * T_W_B));
}

}  // namespace clearway
