#include "scene/rivals.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "scene/reidentification.h"
#include "scene/same_object.h"

namespace clearway {
namespace {

// Whether the other was seen while the lost one was out of sight before, between two sights of it
// that were joined since, and where that one must have been then: no two are in one place.
bool IsSightBetween(const MovingObject& other, const MovingObject& lost) {
  const auto after = std::ranges::find_if(
      lost.history, [&](const StampedPose& pose) { return pose.stamp >= other.first_seen; });
  if (after == lost.history.begin() || after == lost.history.end()) return false;
  if (after->stamp <= other.t_k()) return false;
  const Eigen::Vector3d center_W = other.history.back().T_W_O * other.observed_box_O.Center();
  const Pose T_W_L = PredictPose(lost, other.t_k(), Duration::max()).T_W_O;
  return lost.observed_box_O.Contains(Inverse(T_W_L) * center_W);
}

// Whether the young one's place would be a strange chance if it was the other: a hundred times less
// likely than if it is the lost one.
bool IsThereByChance(const MovingObject& other, const MovingObject& lost, const MovingObject& young,
                     const SceneParams& params) {
  constexpr double kTimes = 100;
  const auto as_lost = LogLikelihoodIfSame(lost, young, params);
  const auto as_other = LogLikelihoodIfSame(other, young, params);
  return as_lost && as_other && *as_lost - *as_other > std::log(kTimes);
}

// Whether an object that may be the young one as well is likely to be the lost one, too: where it
// was to be then, another one cannot have been; or, as the young one, it is much farther off.
bool IsLostOne(double as_young_m, double as_lost_m, const MovingObject& lost,
               const MovingObject& young, const SceneParams& params) {
  constexpr double kNearlyAsWell = 2;
  const double beside_m = ToleranceOfPlace_m(lost, 0, 0);
  const double match_m = DistanceIfSame_m(lost, young, params).value_or(0);
  return as_lost_m <= beside_m || as_young_m > kNearlyAsWell * match_m + beside_m;
}

}  // namespace

bool IsRival(const MovingObject& other, const MovingObject& lost, const MovingObject& young,
             Time stamp, const SceneParams& params) {
  const auto since_m = DistanceIfSame_m(lost, other, params);
  if (const auto as_young_m = DistanceIfSame_m(other, young, params)) {
    if (IsSightBetween(other, lost)) return false;
    if (!since_m && IsThereByChance(other, lost, young, params)) return false;
    const auto as_lost_m = since_m ? since_m : DistanceIfSame_m(other, lost, params);
    return !as_lost_m || !IsLostOne(*as_young_m, *as_lost_m, lost, young, params);
  }
  if (since_m) return true;
  // What is to be joined now has matches of its own.
  return WasLostBefore(lost, other) && !IsToBeJoined(other, stamp) &&
         SeenAgain(lost, other, params).has_value();
}

}  // namespace clearway
