#include "ended_reports.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "clearway/scene/scene_builder.h"

namespace clearway::bench {
namespace {

constexpr std::size_t kFirstEnd = 15, kEveryEnd = 20;
constexpr std::size_t kSilent = 31, kFirstScored = 8, kAhead = 10;  // frames, of 0.1 s each
constexpr Duration kAheadTime = std::chrono::seconds(1);
constexpr double kMargin_m = 0.1;  // around the box of a solid

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct OfObject {
  std::vector<double> misses_m;
  double bound_m = 0;
  int held = 0, in_solid = 0;
};

// One drive of which the reports end.
class SilentDrive {
 public:
  SilentDrive(const ReportedDrive& drive, std::size_t end, MotionFromPoints from_points)
      : drive_(drive), end_(end), builder_(Params(drive, from_points), {}, pool_) {}

  void Run() {
    const std::size_t frames = std::min(drive_.frames.size(), end_ + kSilent);
    for (std::size_t k = 0; k < frames; ++k) {
      Frame frame = drive_.frames[k];
      if (k >= end_) frame.motions.clear();
      const auto report = builder_.Apply(frame);
      if (!report.ok()) std::abort();
      for (const ObjectIssue& issue : report->issues) {
        const bool anew = issue.kind == ObjectIssueKind::kRestarted ||
                          issue.kind == ObjectIssueKind::kBridgedTooLong;
        if (anew) anew_.insert(issue.id);
      }
      for (const auto& object : builder_.Publish()->objects) Look(k, frame.stamp, *object);
    }
  }

  const std::map<ObjectId, OfObject>& objects() const { return objects_; }
  const std::set<ObjectId>& anew() const { return anew_; }

 private:
  static SceneParams Params(const ReportedDrive& drive, MotionFromPoints from_points) {
    SceneParams params;
    params.resolution_m = params.object_resolution_m = drive.resolution_m;
    params.motion_from_points = from_points;
    return params;
  }

  void Look(std::size_t k, Time stamp, const MovingObject& object) {
    const auto now = drive_.T_W_B(object.id, k);
    if (!now) return;
    if (k + 1 == end_) T_O_B_[object.id] = Inverse(object.LastPose().T_W_O) * *now;
    const auto T_O_B = T_O_B_.find(object.id);
    if (k < end_ + kFirstScored || T_O_B == T_O_B_.end() || object.last_seen != stamp) return;
    const auto then = drive_.T_W_B(object.id, k + kAhead);
    if (!then) return;
    const Time ahead = stamp + kAheadTime;
    const Pose T_W_O = PredictPose(object, ahead, builder_.Publish()->params.horizon).T_W_O;
    const double miss_m = ((T_W_O * T_O_B->second).translation - then->translation).norm();
    OfObject& of = objects_[object.id];
    of.misses_m.push_back(miss_m);
    of.bound_m = object.bound.At(1);
    of.held += miss_m <= object.bound.At(ToSeconds(ahead - object.LastPose().stamp));
    of.in_solid +=
        object.solid->box_O.Padded(kMargin_m).Contains(Inverse(T_W_O) * then->translation);
  }

  const ReportedDrive& drive_;
  const std::size_t end_;
  ThreadPool pool_{1};
  SceneBuilder builder_;
  std::map<ObjectId, Pose> T_O_B_;  // when the reports ended
  std::map<ObjectId, OfObject> objects_;
  std::set<ObjectId> anew_;
};

}  // namespace

EndedReports AfterReportsEnd(const ReportedDrive& drive, MotionFromPoints from_points) {
  EndedReports all;
  std::vector<double> misses_m, bounds_m;
  for (std::size_t end = kFirstEnd; end + kSilent < drive.frames.size(); end += kEveryEnd) {
    SilentDrive silent(drive, end, from_points);
    silent.Run();
    all.begun_anew += static_cast<int>(silent.anew().size());
    for (const auto& [id, of] : silent.objects()) {
      if (silent.anew().contains(id)) continue;
      misses_m.push_back(Median(of.misses_m));
      bounds_m.push_back(of.bound_m);
      all.predictions += static_cast<int>(of.misses_m.size());
      all.held += of.held;
      all.in_solid += of.in_solid;
    }
  }
  all.miss_m = Median(misses_m);
  all.bound_m = Median(bounds_m);
  all.held /= std::max(1, all.predictions);
  all.in_solid /= std::max(1, all.predictions);
  return all;
}

}  // namespace clearway::bench
