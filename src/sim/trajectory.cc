#include "clearway/sim/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clearway {
namespace {

double LegLengthM(double start_mps, const Drive::Leg& leg) {
  return 0.5 * (start_mps + leg.end_speed_mps) * ToSeconds(leg.duration);
}

// The displacement after `seconds` of a leg that begins at start_mps.
Pose AlongLeg(double start_mps, const Drive::Leg& leg, double seconds) {
  const double duration_s = ToSeconds(leg.duration);
  const double acceleration_mps2 = (leg.end_speed_mps - start_mps) / duration_s;
  const double length_m = LegLengthM(start_mps, leg);
  const double distance_m = (start_mps + 0.5 * acceleration_mps2 * seconds) * seconds;
  const double fraction = length_m != 0 ? distance_m / length_m : seconds / duration_s;
  return Exp({{0, 0, fraction * leg.turn_rad}, {distance_m, 0, 0}});
}

Pose At(const FixedPose& fixed, Time) { return fixed.T_W_B; }

Pose At(const ConstantTwist& twist, Time t) {
  return twist.T_W_B * Exp(ToSeconds(t - twist.at) * twist.velocity_B);
}

Pose At(const WaypointPath& path, Time t) {
  if (path.points.empty()) return {};
  const auto next =
      std::upper_bound(path.points.begin(), path.points.end(), t,
                       [](Time time, const WaypointPath::Point& p) { return time < p.time; });
  if (next == path.points.begin()) return path.points.front().T_W_B;
  if (next == path.points.end()) return path.points.back().T_W_B;
  const WaypointPath::Point& last = *(next - 1);
  return Interpolate(last.T_W_B, next->T_W_B,
                     ToSeconds(t - last.time) / ToSeconds(next->time - last.time));
}

Pose At(const Drive& drive, Time t) {
  double seconds = ToSeconds(t - drive.start);
  if (seconds <= 0) return drive.T_W_B * Pose::Translation(drive.start_speed_mps * seconds, 0, 0);
  Pose T_W_B = drive.T_W_B;
  double speed_mps = drive.start_speed_mps;
  for (const Drive::Leg& leg : drive.legs) {
    const double duration_s = ToSeconds(leg.duration);
    T_W_B = T_W_B * AlongLeg(speed_mps, leg, std::min(seconds, duration_s));
    if (seconds <= duration_s) return T_W_B;
    seconds -= duration_s;
    speed_mps = leg.end_speed_mps;
  }
  return T_W_B * Pose::Translation(speed_mps * seconds, 0, 0);
}

Pose At(const Pendulum& pendulum, Time t) {
  const double phase_rad =
      2 * std::numbers::pi * ToSeconds(t - pendulum.at) / ToSeconds(pendulum.period);
  const double angle_rad = pendulum.amplitude_rad * std::sin(phase_rad);
  const Pose T_P_arm = Exp({{angle_rad, 0, 0}, Eigen::Vector3d::Zero()});
  return pendulum.T_W_P * T_P_arm * Pose::Translation(0, 0, -pendulum.length_m);
}

}  // namespace

Pose PoseAt(const Trajectory& trajectory, Time t) {
  return std::visit([t](const auto& kind) { return At(kind, t); }, trajectory);
}

double LengthOf(const Drive& drive) {
  double length_m = 0;
  double speed_mps = drive.start_speed_mps;
  for (const Drive::Leg& leg : drive.legs) {
    length_m += std::abs(LegLengthM(speed_mps, leg));
    speed_mps = leg.end_speed_mps;
  }
  return length_m;
}

}  // namespace clearway
