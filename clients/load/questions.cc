#include "load/questions.h"

#include <numbers>

namespace clearway {

double RandomQuestions::Uniform(double low, double high) {
  constexpr double kSteps = 1ull << 53;
  return low + (high - low) * (static_cast<double>(engine_() >> 11) / kSteps);
}

Eigen::Vector3d RandomQuestions::Position() {
  Eigen::Vector3d p_W;
  for (int i = 0; i < 3; ++i) p_W[i] = Uniform(space_.box_W.min[i], space_.box_W.max[i]);
  return p_W;
}

std::vector<Eigen::Vector3f> RandomQuestions::Points(std::size_t count) {
  std::vector<Eigen::Vector3f> points_W(count);
  for (Eigen::Vector3f& p_W : points_W) p_W = Position().cast<float>();
  return points_W;
}

std::vector<Time> RandomQuestions::Times(std::size_t count) {
  const Duration step = std::max(space_.step, Duration(1));
  const std::uint64_t steps = space_.span / step + 1;
  std::vector<Time> times(count);
  for (Time& time : times) time = space_.from + static_cast<std::int64_t>(engine_() % steps) * step;
  return times;
}

StateBatch RandomQuestions::States(std::size_t count, const std::vector<Pose>& T_R_L) {
  StateBatch states;
  states.times = Times(count);
  states.T_W_L.reserve(count * T_R_L.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double yaw_rad = Uniform(-std::numbers::pi, std::numbers::pi);
    const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
    const Pose T_W_R{Eigen::Quaterniond(turn), Position()};
    for (const Pose& place : T_R_L) states.T_W_L.push_back(T_W_R * place);
  }
  return states;
}

}  // namespace clearway
