// A world of moving discs, answered exactly: the truth that planning tests compare with.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "collision/link_motion.h"

namespace clearway {

// A disc (an endless vertical cylinder) of constant velocity.
struct MovingDisc {
  Eigen::Vector2d center_m;  // at time 0
  Eigen::Vector2d velocity_mps;
  double radius_m = 0;

  Eigen::Vector2d At(double seconds) const { return center_m + seconds * velocity_mps; }
};

// A robot of one box per link, each turned about z only, among discs: the distance of a disc's
// centre to a rectangle. Counts its calls.
class DiscChecker : public StateChecker {
 public:
  DiscChecker(Robot robot, std::vector<MovingDisc> discs)
      : robot_(std::move(robot)), discs_(std::move(discs)) {}

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override {
    ++calls_;
    checked_states_ += static_cast<long>(states.times.size());
    CheckReply reply{.version = version(), .stamp = stamp(), .answers = {}};
    const std::size_t links = robot_.links.size();
    for (std::size_t i = 0; i < states.times.size(); ++i) {
      reply.answers.push_back(Answer(states.times[i], &states.T_W_L[i * links], options));
    }
    return reply;
  }
  // By samples so dense that no test can tell them from a proof.
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override {
    ++calls_;
    MotionReply reply{version(), stamp(), {}, options.check.inflation_mps, 0, {}};
    std::size_t knot = 0;
    for (const std::size_t count : motions.knot_counts) {
      reply.answers.push_back(AnswerMotion(motions, knot, knot + count, options));
      knot += count;
    }
    return reply;
  }
  const Robot& robot() const override { return robot_; }
  std::uint64_t version() const override { return 7; }
  Time stamp() const override { return Time(); }

  // Metres between the robot and the nearest disc, 0 in contact.
  double Distance(Time time, const Pose* T_W_L) const {
    double distance_m = 1e9;
    const double seconds = ToSeconds(time.time_since_epoch());
    for (const MovingDisc& disc : discs_) {
      const Eigen::Vector2d center = disc.At(seconds);
      for (std::size_t l = 0; l < robot_.links.size(); ++l) {
        const Eigen::Vector3d half = 0.5 * std::get<Box>(robot_.links[l].shapes[0].shape).size_m;
        const Eigen::Vector3d p_L =
            Inverse(T_W_L[l]) * Eigen::Vector3d(center.x(), center.y(), T_W_L[l].translation.z());
        const Eigen::Vector2d outside = (p_L.head<2>().cwiseAbs() - half.head<2>()).cwiseMax(0.0);
        distance_m = std::min(distance_m, std::max(0.0, outside.norm() - disc.radius_m));
      }
    }
    return distance_m;
  }

  long calls() const { return calls_; }
  long checked_states() const { return checked_states_; }
  // Share of the robot in unknown space, as told in every answer.
  std::optional<double> unknown_fraction;

 private:
  StateAnswer Answer(Time time, const Pose* T_W_L, const CheckOptions& options) const {
    StateAnswer answer;
    const double distance_m = Distance(time, T_W_L);
    answer.status = distance_m > options.padding_m ? SpaceStatus::kFree : SpaceStatus::kOccupied;
    answer.unknown_fraction = unknown_fraction;
    if (options.clearance_up_to_m) {
      answer.clearance_m = std::min(*options.clearance_up_to_m, distance_m);
    }
    return answer;
  }

  MotionAnswer AnswerMotion(const MotionBatch& motions, std::size_t first, std::size_t end,
                            const MotionOptions& options) const {
    constexpr double kStep = 0.005;  // metres, radians or seconds
    const std::size_t links = robot_.links.size();
    MotionAnswer answer;
    answer.free_until = motions.times[first];
    for (std::size_t k = first; k + 1 < end; ++k) {
      const Duration lasts = motions.times[k + 1] - motions.times[k];
      double longest = options.world_at ? 0 : ToSeconds(lasts);
      for (std::size_t l = 0; l < links; ++l) {
        const Pose *from = &motions.T_W_L[k * links + l], *to = from + links;
        longest = std::max({longest, (to->translation - from->translation).norm(),
                            to->rotation.angularDistance(from->rotation)});
      }
      const int samples = std::max(1, static_cast<int>(std::ceil(longest / kStep)));
      for (int i = 0; i <= samples; ++i) {
        std::vector<Pose> T_W_L;
        for (std::size_t l = 0; l < links; ++l) {
          const Pose *from = &motions.T_W_L[k * links + l], *to = from + links;
          T_W_L.push_back(LinkMotion(*from, *to, 1).At(static_cast<double>(i) / samples));
        }
        const Time time = motions.times[k] + lasts * i / samples;
        const StateAnswer state =
            Answer(options.world_at.value_or(time), T_W_L.data(), options.check);
        if (state.status != SpaceStatus::kFree) {
          answer.status = state.status;
          answer.witness = MotionWitness{answer.free_until, time, 0, 1, std::nullopt};
          return answer;
        }
        answer.free_until = time;
      }
    }
    answer.status = SpaceStatus::kFree;
    return answer;
  }

  Robot robot_;
  std::vector<MovingDisc> discs_;
  mutable std::atomic<long> calls_ = 0;
  mutable std::atomic<long> checked_states_ = 0;
};

// 1.0 x 0.7 x 1.0 m, its origin in the middle.
inline Robot DeliveryRobot() {
  return Robot::SingleShape("delivery", Box{Eigen::Vector3d(1.0, 0.7, 1.0)});
}

}  // namespace clearway
