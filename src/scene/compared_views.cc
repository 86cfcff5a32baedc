#include "scene/compared_views.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/rays_near.h"

namespace clearway {
namespace {

using Places = std::vector<Eigen::Vector3d>;

// Some of an object's points, carried by a motion. Evenly chosen, but not every n-th, which may be
// those of one beam.
Places SomeOf(const ObjectView& view, const Pose& H_W) {
  constexpr std::size_t kMost = 128;
  constexpr double kGoldenRatio = 0.6180339887498949;
  const std::size_t size = view.points.size();
  Places places_W;
  for (std::size_t i = 0; i < std::min(size, kMost); ++i) {
    const double part = std::fmod(kGoldenRatio * static_cast<double>(i), 1.0);
    const auto at = size > kMost ? static_cast<std::size_t>(part * static_cast<double>(size)) : i;
    places_W.push_back(H_W * view.cloud.ends_W[view.points[at]].cast<double>());
  }
  return places_W;
}

Eigen::Vector3d MeanOf(const Places& places) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : places) sum += p;
  return sum / static_cast<double>(places.size());
}

struct Span {
  double begin_m, end_m;
};

// Along a direction, without the outermost twentieth on each side: labels that bleed.
Span SpanOf(const Places& places, const Eigen::Vector3d& along) {
  std::vector<double> at_m;
  for (const Eigen::Vector3d& p : places) at_m.push_back(along.dot(p));
  const std::size_t strays = at_m.size() / 20;
  std::ranges::sort(at_m);
  return {at_m[strays], at_m[at_m.size() - 1 - strays]};
}

// How many places rays go on through, and at how many others they end. Of the rest nothing is
// known.
struct Tally {
  std::size_t passed = 0, met = 0;
};

// What the rays near a place do there.
struct Rays {
  int passing = 0, ending = 0;

  void Add(const Eigen::Vector3d& place_W, const Eigen::Vector3d& origin_W,
           const Eigen::Vector3d& direction_W, double length_m, double near_m) {
    constexpr double kThick_m = 0.3;
    const Eigen::Vector3d to_W = place_W - origin_W;
    const double along_m = to_W.dot(direction_W);
    if (along_m < 0 || to_W.squaredNorm() - along_m * along_m > near_m * near_m) return;
    if (length_m < along_m - kThick_m) return;  // something else hides it
    ++(length_m > along_m + kThick_m ? passing : ending);
  }
};

Tally TallyOf(const Places& places_W, const LabelledCloud& cloud, double near_m) {
  if (places_W.empty()) return {};
  const Eigen::Vector3d center_W = MeanOf(places_W);
  double radius_m = near_m;
  for (const Eigen::Vector3d& p : places_W) {
    radius_m = std::max(radius_m, (p - center_W).norm() + near_m);
  }
  const std::vector<std::uint8_t> is_near = RaysNear(cloud, center_W, radius_m);
  std::vector<Rays> rays(places_W.size());
  for (std::size_t i = 0; i < is_near.size(); ++i) {
    if (is_near[i] == 0) continue;
    const Eigen::Vector3d origin_W =
        cloud.origins_W[cloud.origins_W.size() == 1 ? 0 : i].cast<double>();
    const Eigen::Vector3d ray_W = cloud.ends_W[i].cast<double>() - origin_W;
    const double length_m = ray_W.norm();
    for (std::size_t k = 0; k < rays.size(); ++k) {
      rays[k].Add(places_W[k], origin_W, ray_W / length_m, length_m, near_m);
    }
  }
  Tally tally;
  for (const Rays& of_place : rays) {
    tally.passed += of_place.passing > of_place.ending;
    tally.met += of_place.ending > 0 && of_place.ending >= of_place.passing;
  }
  return tally;
}

// Whether so many of the places are passed that it is not just at the edge of what hides them.
// Along a surface that rays graze, and near the ground, some always end at places that are empty.
bool AreEmpty(const Tally& left, const Tally& reached, std::size_t places) {
  constexpr std::size_t kFew = 5, kPart = 3, kMany = 2;
  const std::size_t passed = left.passed + reached.passed, met = left.met + reached.met;
  return passed >= kFew && kPart * passed >= places && passed >= kMany * met &&
         left.passed >= left.met && reached.passed >= reached.met;
}

}  // namespace

std::optional<Mismatch> MismatchOf(const ObjectView& then, const ObjectView& now, const Pose& H_W,
                                   double seconds, double bound_m, const SceneParams& params) {
  constexpr double kSlack_m = 1, kManySigmas = 3;
  constexpr double kStampsOff_s = 0.1, kOfItsWay = 0.2;
  constexpr double kApart_m = 0.5;  // nearer to the ends rays tell little
  const Places then_W = SomeOf(then, H_W), now_W = SomeOf(now, Pose());
  const Eigen::Vector3d mean_W = MeanOf(then_W), step_W = MeanOf(now_W) - mean_W;
  const double way_m = (mean_W - Inverse(H_W) * mean_W).norm();
  const double limit_m = kSlack_m + bound_m + std::min(kOfItsWay, kStampsOff_s / seconds) * way_m +
                         kManySigmas * params.object_pose_error_m;
  if (2 * step_W.norm() < limit_m) return std::nullopt;
  const Eigen::Vector3d along = step_W.normalized();
  const Span before = SpanOf(then_W, along), after = SpanOf(now_W, along);
  const double off_m = std::min(after.begin_m - before.begin_m, after.end_m - before.end_m);
  if (off_m <= limit_m) return std::nullopt;

  // Where it was seen and is not now, as of now; where it is seen and was not, as of then.
  Places left_W, reached_W;
  for (const Eigen::Vector3d& p : then_W) {
    if (along.dot(p) < after.begin_m - kApart_m) left_W.push_back(p);
  }
  const Pose H_W_back = Inverse(H_W);
  for (const Eigen::Vector3d& p : now_W) {
    if (along.dot(p) > before.end_m + kApart_m) reached_W.push_back(H_W_back * p);
  }
  const double near_m = 1.5 * params.object_resolution_m;
  const Tally left = TallyOf(left_W, now.cloud, near_m);
  const Tally reached = TallyOf(reached_W, then.cloud, near_m);
  const bool are_empty = AreEmpty(left, reached, left_W.size() + reached_W.size());
  return are_empty ? std::optional(Mismatch{off_m, limit_m}) : std::nullopt;
}

}  // namespace clearway
