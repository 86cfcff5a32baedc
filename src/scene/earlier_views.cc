#include "scene/earlier_views.h"

#include <algorithm>
#include <utility>

#include "scene/mended_pose.h"

namespace clearway {
namespace {

constexpr Duration kKept = std::chrono::milliseconds(1500);  // what was found of an object
constexpr std::size_t kFewPoints = 4;

}  // namespace

void EarlierViews::Said::Add(const Moved& step) {
  constexpr std::size_t kMost = 4;  // each of several sensors tells of motions since its last frame
  moved.push_back(step);
  if (moved.size() > kMost) moved.erase(moved.begin());
}

std::optional<Pose> EarlierViews::Followed(const ObjectClue& clue, Time stamp, Said& said) {
  if (clue.pose != nullptr) {
    if (!said.T_W_B) return std::nullopt;
    return clue.pose->T_W_B * Inverse(*said.T_W_B);
  }
  const auto from = std::find_if(said.moved.rbegin(), said.moved.rend(), [&](const Moved& moved) {
    return std::chrono::abs(clue.motion->from - moved.until) <= kNoGap;
  });
  if (from == said.moved.rend()) return std::nullopt;
  said.Add({stamp, clue.motion->H_W * from->H_W});
  return said.moved.back().H_W;
}

std::optional<EarlierViews::Distrust> EarlierViews::MismatchWithViews(
    ObjectId id, const ObjectClue& clue, const PositionBound& bound, const LabelledCloud& cloud,
    Time stamp, const SceneParams& params) {
  constexpr double kAhead_s = 0.2;  // so far it tells of the noise of poses, then of manoeuvres
  constexpr Duration kLeast = std::chrono::seconds(1), kMost = std::chrono::milliseconds(1500);
  Duration followed{};  // for how long nothing speaks against it
  for (auto view = views_.rbegin(); view != views_.rend(); ++view) {
    const auto said = view->said.find(id);
    if (said == view->said.end()) continue;
    const std::optional<Pose> H_W = Followed(clue, stamp, said->second);
    if (!H_W || clue.points.size() < kFewPoints) continue;
    const Duration ago = stamp - view->stamp;
    const double seconds = ToSeconds(ago);
    const auto mismatch =
        MismatchOf({*view->cloud, view->cloud->object_hits.at(id)}, {cloud, clue.points}, *H_W,
                   seconds, bound.At(std::min(seconds, kAhead_s)), params);
    if (mismatch) return Distrust{*mismatch, stamp, std::clamp(ago, kLeast, kMost)};
    followed = std::max(followed, ago);
  }
  const auto distrust = distrusted_.find(id);
  if (distrust != distrusted_.end() && followed >= distrust->second.least) {
    distrusted_.erase(distrust);
  }
  return std::nullopt;
}

std::optional<Mismatch> EarlierViews::Judge(ObjectId id, const ObjectClue& clue,
                                            const PositionBound& bound, const LabelledCloud& cloud,
                                            Time stamp, const SceneParams& params) {
  if (clue.pose != nullptr) T_W_B_now_[id] = clue.pose->T_W_B;
  if (const auto found = MismatchWithViews(id, clue, bound, cloud, stamp, params)) {
    // The row begins anew: from here on what is said may be right.
    for (View& view : views_) view.said.erase(id);
    const auto before = distrusted_.find(id);
    const Duration least = before == distrusted_.end() ? Duration{} : before->second.least;
    distrusted_[id] = {found->mismatch, stamp, std::max(found->least, least)};
  }
  const auto distrust = distrusted_.find(id);
  if (distrust == distrusted_.end()) return std::nullopt;
  distrust->second.judged_at = stamp;
  return distrust->second.mismatch;
}

bool EarlierViews::MayDoubt(ObjectId id) const {
  constexpr int kMost = 3;
  const auto doubts = doubts_.find(id);
  return doubts == doubts_.end() || doubts->second.in_a_row < kMost;
}

void EarlierViews::NoteDoubt(ObjectId id, Time stamp, bool doubted) {
  if (!doubted) {
    doubts_.erase(id);
    return;
  }
  Doubts& doubts = doubts_[id];
  ++doubts.in_a_row;
  doubts.newest = stamp;
}

// The older, the farther apart: of 0.5, 1, 1.5 and 2 s ago, say.
void EarlierViews::ForgetViews(Time stamp) {
  constexpr Duration kLong = std::chrono::seconds(1), kLongest = std::chrono::seconds(2);
  std::erase_if(views_, [&](const View& view) { return stamp - view.stamp > kLongest; });
  for (std::size_t i = 1; i + 1 < views_.size(); ++i) {
    const Duration older = stamp - views_[i - 1].stamp, newer = stamp - views_[i + 1].stamp;
    if (newer < kLong || 2 * older > 3 * newer) continue;
    views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

bool EarlierViews::IsTimeFor(const LabelledCloud& cloud, Time stamp) const {
  constexpr Duration kApart = std::chrono::milliseconds(500);
  constexpr Duration kLeast = std::chrono::milliseconds(200);
  const auto is_large = [](const auto& hits) { return hits.second.size() >= kFewPoints; };
  if (std::ranges::none_of(cloud.object_hits, is_large)) return false;
  if (views_.empty() || stamp - views_.back().stamp >= kApart) return true;
  if (stamp - views_.back().stamp < kLeast) return false;
  return std::ranges::any_of(cloud.object_hits, [&](const auto& hits) {
    return is_large(hits) && std::ranges::none_of(views_, [&](const View& view) {
             return view.said.contains(hits.first);
           });
  });
}

void EarlierViews::GoOn(const MovingObject& object, Time stamp) {
  if (object.t_k() != stamp || Distrusts(object.id)) return;
  for (View& view : views_) {
    const auto said = view.said.find(object.id);
    if (said == view.said.end() || said->second.moved.back().until == stamp) continue;
    const Moved& moved = said->second.moved.back();
    const auto from = std::ranges::find(object.history, moved.until, &StampedPose::stamp);
    if (from == object.history.end()) continue;
    const Pose H_W = object.history.back().T_W_O * Inverse(from->T_W_O);
    said->second.Add({stamp, H_W * moved.H_W});
  }
}

void EarlierViews::Keep(LabelledCloud cloud, Time stamp, const SceneObjects& objects) {
  if (IsLate(stamp)) return;
  newest_ = stamp;
  for (const auto& object : objects) GoOn(*object, stamp);
  ForgetViews(stamp);
  std::erase_if(doubts_, [&](const auto& entry) { return stamp - entry.second.newest > kKept; });
  std::erase_if(distrusted_,
                [&](const auto& entry) { return stamp - entry.second.judged_at > kKept; });
  if (IsTimeFor(cloud, stamp)) {
    cloud.labels = {};
    cloud.kinds = {};
    View view{stamp, std::make_shared<const LabelledCloud>(std::move(cloud)), {}};
    for (const auto& [id, points] : view.cloud->object_hits) {
      if (points.size() < kFewPoints) continue;
      const auto T_W_B = T_W_B_now_.find(id);
      view.said[id] = {{{stamp, Pose()}},
                       T_W_B == T_W_B_now_.end() ? std::nullopt : std::optional(T_W_B->second)};
    }
    views_.push_back(std::move(view));
  }
  T_W_B_now_.clear();
}

}  // namespace clearway
