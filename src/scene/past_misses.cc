#include "scene/past_misses.h"

#include <algorithm>
#include <cmath>

#include "scene/object_motion.h"

namespace clearway {
namespace {

constexpr Duration kHalf = std::chrono::milliseconds(500);
// Of sources at more than 10 Hz poses are skipped: evidence must not depend on the rate.
constexpr Duration kSoonStep = std::chrono::milliseconds(95);

// Between the first pose of the track and the last.
Pose PoseAt(std::span<const StampedPose> track, Time t) {
  const auto after = std::ranges::lower_bound(track, t, {}, &StampedPose::stamp);
  if (after == track.begin()) return after->T_W_O;
  const StampedPose& before = *(after - 1);
  const double share = ToSeconds(t - before.stamp) / ToSeconds(after->stamp - before.stamp);
  return Interpolate(before.T_W_O, after->T_W_O, share);
}

// A prediction from the last pose of `past`.
class PastPrediction {
 public:
  PastPrediction(std::span<const StampedPose> past, const Eigen::Vector3d& center_O,
                 const GoesOnBy& goes_on_by)
      : last_(past.back()), center_O_(center_O), velocity_O_(goes_on_by(past)) {}

  // The squared distance by which it misses the object's centre.
  double Missed_m2(Duration ahead, const Pose& T_W_O) const {
    const Pose predicted = last_.T_W_O * Exp(ToSeconds(ahead) * velocity_O_);
    return (predicted * center_O_ - T_W_O * center_O_).squaredNorm();
  }

 private:
  const StampedPose& last_;
  const Eigen::Vector3d& center_O_;
  Twist velocity_O_;
};

void AddLate(std::span<const StampedPose> track, const GoesOnBy& goes_on_by, PastMisses& misses) {
  constexpr int kPredictions = 10;
  const Time last = track.back().stamp;
  std::size_t known = track.size();
  for (int i = 1; i <= kPredictions; ++i) {
    const auto later =
        std::ranges::upper_bound(track.first(known), last - i * kHalf, {}, &StampedPose::stamp);
    const auto count = static_cast<std::size_t>(later - track.begin());
    if (count < 2) break;
    if (count == known) continue;  // poses are far apart
    known = count;
    const PastPrediction predicted(track.first(known), misses.center_O, goes_on_by);
    for (Misses& late : misses.late) {
      const auto ahead = kHalf * std::lround(2 * late.ahead_s);
      const Time then = track[known - 1].stamp + ahead;
      if (then <= last) late.Add(predicted.Missed_m2(ahead, PoseAt(track, then)));
    }
  }
}

// The poses of the last `period`, thinned out to steps of kSoonStep, as counts of poses known by
// then: the newest first.
std::vector<std::size_t> Steps(std::span<const StampedPose> track, Duration period) {
  std::vector<std::size_t> known = {track.size()};
  for (std::size_t i = track.size() - 1; i > 0; --i) {
    const Time stamp = track[i - 1].stamp;
    if (track.back().stamp - stamp > period) break;
    if (track[known.back() - 1].stamp - stamp >= kSoonStep) known.push_back(i);
  }
  return known;
}

void AddSoon(std::span<const StampedPose> track, const GoesOnBy& goes_on_by, PastMisses& misses) {
  const std::vector<std::size_t> steps = Steps(track, 2 * kHalf);
  for (std::size_t from = 1; from < steps.size() && steps[from] >= 2; ++from) {
    const PastPrediction predicted(track.first(steps[from]), misses.center_O, goes_on_by);
    const Time start = track[steps[from] - 1].stamp;
    for (std::size_t to = from; to-- > 0;) {
      const StampedPose& pose = track[steps[to] - 1];
      const Duration ahead = pose.stamp - start;
      if (ahead >= kHalf) break;
      misses.soon.push_back({ToSeconds(ahead), predicted.Missed_m2(ahead, pose.T_W_O), 1});
    }
  }
}

void AddJitter(std::span<const StampedPose> track, PastMisses& misses) {
  constexpr Duration kPeriod = std::chrono::milliseconds(1450);
  const std::vector<std::size_t> steps = Steps(track, kPeriod);
  for (std::size_t i = 2; i < steps.size(); ++i) {
    const StampedPose &after = track[steps[i - 2] - 1], &pose = track[steps[i - 1] - 1],
                      &before = track[steps[i] - 1];
    const double share =
        ToSeconds(pose.stamp - before.stamp) / ToSeconds(after.stamp - before.stamp);
    const Eigen::Vector3d from_W = before.T_W_O * misses.center_O;
    const Eigen::Vector3d to_W = after.T_W_O * misses.center_O;
    const Eigen::Vector3d between_W = from_W + share * (to_W - from_W);
    misses.jitter_m2 += (pose.T_W_O * misses.center_O - between_W).squaredNorm();
    ++misses.jitter_count;
  }
}

}  // namespace

PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by) {
  const auto first = std::ranges::lower_bound(track, since, {}, &StampedPose::stamp);
  track = track.last(static_cast<std::size_t>(track.end() - first));
  PastMisses misses;
  misses.center_O = CenterOf(solid);
  if (track.size() < 2) return misses;
  misses.interval_s = ToSeconds(track.back().stamp - track[track.size() - 2].stamp);
  AddLate(track, goes_on_by, misses);
  AddSoon(track, goes_on_by, misses);
  AddJitter(track, misses);
  return misses;
}

bool IsClearlyBetter(const PastMisses& misses, const PastMisses& others) {
  constexpr int kFewest = 4;
  constexpr double kClearly = 0.5;  // of squared distances
  return misses.late[0].count >= kFewest &&
         misses.late[0].sum_m2 + misses.late[1].sum_m2 <
             kClearly * (others.late[0].sum_m2 + others.late[1].sum_m2);
}

}  // namespace clearway
