#include "scene/position_bound.h"

#include <algorithm>
#include <cmath>

#include "scene/object_motion.h"

namespace clearway {
namespace {

constexpr Duration kHalf = std::chrono::milliseconds(500), kWhole = 2 * kHalf;
constexpr double kUsualCount = 2;  // what is usual counts as much as so many predictions

// Between the first pose of the track and the last.
Pose PoseAt(std::span<const StampedPose> track, Time t) {
  const auto after = std::ranges::lower_bound(track, t, {}, &StampedPose::stamp);
  if (after == track.begin()) return after->T_W_O;
  const StampedPose& before = *(after - 1);
  const double share = ToSeconds(t - before.stamp) / ToSeconds(after->stamp - before.stamp);
  return Interpolate(before.T_W_O, after->T_W_O, share);
}

// How much of what is usual for fast objects is usual for one of that speed.
double ShareOfUsual(double speed_mps) {
  constexpr double kFast_mps = 4, kNeverBelow_mps = 0.7;
  return std::min(1.0, (speed_mps + kNeverBelow_mps) / kFast_mps);
}

// The square of the distance by which the object's centre was not where it would have been then.
class PastPrediction {
 public:
  PastPrediction(std::span<const StampedPose> past, const Eigen::Vector3d& center_O,
                 const GoesOnBy& goes_on_by)
      : last_(past.back()), center_O_(center_O), velocity_O_(goes_on_by(past)) {}

  double Missed_m2(Duration ahead, const Pose& T_W_O) const {
    const Pose predicted = last_.T_W_O * Exp(ToSeconds(ahead) * velocity_O_);
    return (predicted * center_O_ - T_W_O * center_O_).squaredNorm();
  }

 private:
  const StampedPose& last_;
  const Eigen::Vector3d& center_O_;
  Twist velocity_O_;
};

void AddMisses(std::span<const StampedPose> track, const Eigen::Vector3d& center_O,
               const GoesOnBy& goes_on_by, PastMisses& misses) {
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
    const PastPrediction predicted(track.first(known), center_O, goes_on_by);
    for (const auto& [ahead, of_ahead] :
         {std::pair{kHalf, &misses.half}, {kWhole, &misses.whole}}) {
      const Time then = track[known - 1].stamp + ahead;
      if (then <= last) of_ahead->Add(predicted.Missed_m2(ahead, PoseAt(track, then)));
    }
  }
}

void AddSoonMisses(std::span<const StampedPose> track, const Eigen::Vector3d& center_O,
                   const GoesOnBy& goes_on_by, SoonMisses& misses) {
  constexpr Duration kEnough = kHalf / 2, kRounding = std::chrono::milliseconds(10);
  const Time last = track.back().stamp;
  const Duration enough = std::min(kEnough, (last - track.front().stamp) / 2 - kRounding);
  for (std::size_t known = track.size() - 1; known >= 2; --known) {
    const Time from = track[known - 1].stamp;
    if (last - from > kWhole) break;
    const PastPrediction predicted(track.first(known), center_O, goes_on_by);
    for (const StampedPose& pose : track.subspan(known)) {
      const Duration ahead = pose.stamp - from;
      if (ahead >= kHalf) break;
      misses.Add(ToSeconds(ahead), predicted.Missed_m2(ahead, pose.T_W_O), ahead >= enough);
    }
  }
}

// The bound of those values half a second, a second and three seconds ahead; if no bound is (one
// does not shrink, nor slow down), that of the second value and others near.
PositionBound BoundThrough(double half_m, double whole_m, double three_m) {
  const double first_mps = (whole_m - half_m) / 0.5, later_mps = (three_m - whole_m) / 2;
  const double per_s2 = std::clamp((later_mps - first_mps) / 2.5, 0.0, whole_m);
  const double per_s = std::clamp(first_mps - 1.5 * per_s2, 0.0, whole_m - per_s2);
  return {std::max(whole_m - per_s - per_s2, 0.0), per_s, 2 * per_s2};
}

// Those at rest drift evenly.
PositionBound BoundAtRest(const PastMisses& misses) {
  constexpr double kOf95 = 2.2, kUsualHalf_m = 0.06, kUsualWhole_m = 0.12;
  const double half_m = kOf95 * misses.half.Scale_m(kUsualHalf_m);
  const double whole_m = kOf95 * misses.whole.Scale_m(kUsualWhole_m);
  const double per_s = std::clamp(2 * (whole_m - half_m), 0.0, whole_m);
  return {whole_m - per_s, per_s, 0};
}

// Of others the error grows with the square of the time, as far as they do what they want. What is
// beyond that comes from the poses' noise, has lighter tails and grows evenly.
PositionBound BoundInMotion(const PastMisses& misses, double share_of_usual, double of_95_noise) {
  constexpr double kOf95 = 2.0, kUsualHalf_m = 0.17, kUsualWhole_m = 0.5;
  constexpr double kWilful = 1.1;  // times what is usual
  constexpr double kGrows = 0.5;   // with the square at least so much
  const double usual_half_m = share_of_usual * kUsualHalf_m;
  const double usual_whole_m = share_of_usual * kUsualWhole_m;
  const double half_m =
      std::max(misses.half.Scale_m(usual_half_m), misses.soon.Scale_m(0.5, usual_half_m));
  const double whole_m =
      std::max(misses.whole.Scale_m(usual_whole_m), misses.soon.Scale_m(1, usual_whole_m));

  const double wilful_half_m = std::min(half_m, kWilful * usual_half_m);
  const double wilful_whole_m = std::min(whole_m, kWilful * usual_whole_m);
  const double grown_m =
      std::clamp((wilful_whole_m - wilful_half_m) / 0.75, kGrows * wilful_whole_m, wilful_whole_m);
  const double noise_half_m = std::sqrt(half_m * half_m - wilful_half_m * wilful_half_m);
  const double noise_whole_m = std::sqrt(whole_m * whole_m - wilful_whole_m * wilful_whole_m);
  const double bound_whole_m = std::hypot(kOf95 * wilful_whole_m, of_95_noise * noise_whole_m);
  return BoundThrough(
      std::min(std::hypot(kOf95 * wilful_half_m, of_95_noise * noise_half_m), bound_whole_m),
      bound_whole_m,
      std::hypot(kOf95 * (wilful_whole_m + 8 * grown_m), of_95_noise * 3 * noise_whole_m));
}

}  // namespace

double Misses::Scale_m(double usual_m) const {
  const double usual_m2 = usual_m * usual_m;
  const double borne_out = sum_m2_ > count_ * usual_m2 ? count_ * usual_m2 / sum_m2_ : 1;
  const double usual_count = borne_out * kUsualCount;
  return std::sqrt((usual_count * usual_m2 + sum_m2_) / (usual_count + count_));
}

void SoonMisses::Add(double ahead_s, double squared_m2, bool enough) {
  const double squared_s2 = ahead_s * ahead_s;
  count_ += 1;
  s2_ += squared_s2;
  m2_ += squared_m2;
  s4_ += squared_s2 * squared_s2;
  s2m2_ += squared_s2 * squared_m2;
  if (!enough) return;
  enough_ += 1;
  m2ps2_ += squared_m2 / squared_s2;
}

// The slope of the line, whose height at 0 is the noise; but it is a line through few points.
double SoonMisses::VelocityError_m2ps2() const {
  constexpr double kLeast = 0.4;  // of what it would be if poses had no noise
  const double without_noise = m2ps2_ / enough_;
  const double spread = count_ * s4_ - s2_ * s2_;
  if (spread < 1e-9) return without_noise;  // all are of one time ahead
  return std::clamp((count_ * s2m2_ - s2_ * m2_) / spread, kLeast * without_noise, without_noise);
}

double SoonMisses::Scale_m(double ahead_s, double usual_m) const {
  constexpr double kMost = 16;  // neighbours miss by much the same
  if (enough_ == 0) return 0;
  const double count = std::min(enough_, kMost);
  const double missed_m2 = ahead_s * ahead_s * VelocityError_m2ps2();
  return std::sqrt((kUsualCount * usual_m * usual_m + count * missed_m2) / (kUsualCount + count));
}

PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by) {
  const auto first = std::ranges::lower_bound(track, since, {}, &StampedPose::stamp);
  track = track.last(static_cast<std::size_t>(track.end() - first));
  PastMisses misses;
  if (track.empty()) return misses;
  const Eigen::Vector3d center_O = CenterOf(solid);
  AddMisses(track, center_O, goes_on_by, misses);
  AddSoonMisses(track, center_O, goes_on_by, misses.soon);
  return misses;
}

bool IsClearlyBetter(const PastMisses& misses, const PastMisses& others) {
  constexpr int kFewest = 4;
  constexpr double kClearly = 0.5;  // of squares of distances
  return misses.half.count() >= kFewest &&
         misses.half.sum_m2() + misses.whole.sum_m2() <
             kClearly * (others.half.sum_m2() + others.whole.sum_m2());
}

// Root mean squares of misses times kOf95 were right for 95 in 100 objects of recorded drives
// (KITTI, Argoverse 2), and of a simulated one with and without noise. So was what an object may do
// of which one pose is known and nothing else.
PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O,
                      bool of_two_mended) {
  constexpr double kUnknown_mps = 6;
  constexpr double kOf95Noise = 1.55, kOf95MendedNoise = 2.1;
  if (velocity_O == Twist{}) {
    return has_motion ? BoundAtRest(misses) : PositionBound{0, kUnknown_mps, 0};
  }
  return BoundInMotion(misses, has_motion ? ShareOfUsual(velocity_O.linear.norm()) : 1,
                       of_two_mended ? kOf95MendedNoise : kOf95Noise);
}

PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params) {
  const auto by_itself = [&](std::span<const StampedPose> past) {
    return GoesOnByItself(past, solid, params);
  };
  return BoundBy(MissesOf(track, since, solid, by_itself), track.size() > 1, velocity_O,
                 params.motion == MotionModel::kLastMotion && params.MendsObjectPoses());
}

PositionBound BoundAfter(const PositionBound& bound, double seconds) {
  return {bound.At(seconds), bound.speed_mps + bound.accel_mps2 * seconds, bound.accel_mps2};
}

}  // namespace clearway
