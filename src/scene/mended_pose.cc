#include "scene/mended_pose.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/view_registration.h"

namespace clearway {
namespace {

// T_W_O by what the source says now and how far it was off lately. While nothing of the object is
// seen, that may change.
PoseGuess GuessOfSource(const MovingObject& object, const ToldPose& told,
                        const SceneParams& params) {
  constexpr double kMeanOverSigma = 1.6;  // of the norm of three, over the sigma of one
  constexpr double kLeast = 1e-3;
  constexpr double kDrift_mps = 0.3, kDrift_radps = 0.1;
  const double hidden_s = ToSeconds(object.t_k() - object.last_seen);
  const double sigma_m = std::max(params.object_pose_error_m / kMeanOverSigma, kLeast);
  const double sigma_rad = std::max(params.object_pose_error_rad / kMeanOverSigma, kLeast);
  return {told.T_W_T * told.T_T_O, std::hypot(sigma_m, kDrift_mps * hidden_s),
          std::hypot(sigma_rad, kDrift_radps * hidden_s)};
}

// Where the half second or so before it was seen last would have carried it, once it is known for a
// few frames.
std::optional<PoseGuess> GuessOfTrack(const MovingObject& object, Time stamp) {
  constexpr std::ptrdiff_t kFewest = 3;
  constexpr Duration kBack = std::chrono::milliseconds(450);
  const auto begin = object.history.begin();
  auto last = object.history.end() - 1;
  while (last != begin && last->stamp > object.last_seen) --last;
  if (last - begin + 1 < kFewest || stamp <= last->stamp) return std::nullopt;
  auto before = last - 1;
  while (before != begin && last->stamp - (before - 1)->stamp <= kBack) --before;
  const double ahead_s = ToSeconds(stamp - last->stamp);
  const Pose T_W_O = last->T_W_O * Exp(ahead_s * VelocityBetween(*before, *last));
  return PoseGuess{T_W_O, 0.05 + 3.0 * ahead_s, 0.01 + 0.3 * ahead_s};
}

// Takes over how far the source was off in this view. The errors of views near each other are
// alike, and the error of all drifts: a few of them count.
void NoteView(const Pose& T_W_O, ToldPose& told) {
  constexpr int kMostViews = 5;
  told.views = std::min(told.views + 1, kMostViews);
  const Twist off = Log(Inverse(told.T_W_T * told.T_T_O) * T_W_O);
  told.T_T_O = told.T_T_O * Exp(1.0 / told.views * off);
}

}  // namespace

Pose CarriedOn(const ObjectMotion& motion, const Pose& T_W_from, MovingObject& object) {
  const auto& told = object.told;
  if (told && std::chrono::abs(told->stamp - motion.from) <= kNoGap)
    return motion.H_W * told->T_W_T;
  object.told.reset();
  return motion.H_W * T_W_from;
}

Pose MendedPose(const Pose& T_W_T, const LabelledCloud& cloud,
                std::span<const std::uint32_t> points, Time stamp, const SceneParams& params,
                MovingObject& object) {
  if (!params.MendsObjectPoses()) return T_W_T;
  if (!object.told) object.told.emplace();
  ToldPose& told = *object.told;
  told.stamp = stamp;
  told.T_W_T = T_W_T;
  std::vector<PoseGuess> guesses = {GuessOfSource(object, told, params)};
  if (const auto guess = GuessOfTrack(object, stamp)) guesses.push_back(*guess);
  const Pose T_W_O = RegisterView(object.map_O, EndsOf(cloud, points), guesses);
  if (!points.empty()) NoteView(T_W_O, told);
  return T_W_O;
}

}  // namespace clearway
