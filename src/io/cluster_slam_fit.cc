#include "io/cluster_slam_fit.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace clearway {
namespace {

constexpr std::size_t kPairs = 20;
constexpr std::size_t kApart = 5;  // frames: the camera has moved, and sees the same landmarks
constexpr std::size_t kFewest = 8;

struct Errors {
  std::vector<double> static_px, moving_px;
};

std::optional<double> Median(std::vector<double> values) {
  if (values.size() < kFewest) return std::nullopt;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What moves points of a cluster, as the camera sees them, from one frame to the other.
std::optional<Pose> Between(const ClusterFrame& then, const ClusterFrame& now, ObjectId label,
                            QuaternionOrder order) {
  const Pose T_S_W = Inverse(now.camera.In(order)), T_W_S = then.camera.In(order);
  if (label == kStaticLabel) return T_S_W * T_W_S;
  const auto index = static_cast<std::size_t>(label - 1);
  if (index >= now.clusters.size() || !now.clusters[index] || !then.clusters[index]) {
    return std::nullopt;
  }
  return T_S_W * now.clusters[index]->In(order) * Inverse(then.clusters[index]->In(order)) * T_W_S;
}

const ClusterPoint* Find(const ClusterPoints& points, int landmark) {
  const auto found = std::ranges::lower_bound(points, landmark, {}, &ClusterPoint::landmark);
  return found != points.end() && found->landmark == landmark ? &*found : nullptr;
}

struct View {
  const ClusterFrame& poses;
  ClusterPoints points;
};

void AddErrors(const View& then, const View& now, const StereoPair& cameras, QuaternionOrder order,
               Errors& errors) {
  for (const ClusterPoint& point : then.points) {
    const ClusterPoint* const seen = Find(now.points, point.landmark);
    if (seen == nullptr || point.label == kIgnoreLabel) continue;
    const auto motion = Between(then.poses, now.poses, point.label, order);
    if (!motion) continue;
    const auto pixel = cameras.ProjectLeft(*motion * point.p_S);
    auto& list = point.label == kStaticLabel ? errors.static_px : errors.moving_px;
    list.push_back(pixel ? (*pixel - seen->left).norm() : std::numeric_limits<double>::infinity());
  }
}

ClusterFit FitIn(QuaternionOrder order, const Errors& errors) {
  return {order, Median(errors.static_px), Median(errors.moving_px)};
}

}  // namespace

absl::StatusOr<ClusterFit> FitOf(
    const ClusterPoses& poses, const StereoPair& cameras,
    const std::function<absl::StatusOr<ClusterPoints>(int frame)>& points_of) {
  const std::size_t apart = std::min(kApart, poses.size() - 1);
  const std::size_t choices = poses.size() - apart;
  const std::size_t pairs = apart == 0 ? 0 : std::min(kPairs, choices);
  Errors w_first, w_last;
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto then = std::next(poses.begin(), static_cast<std::ptrdiff_t>(i * choices / pairs));
    const auto now = std::next(then, static_cast<std::ptrdiff_t>(apart));
    auto before = points_of(then->first);
    if (!before.ok()) return before.status();
    auto after = points_of(now->first);
    if (!after.ok()) return after.status();
    const View view{then->second, *std::move(before)}, next{now->second, *std::move(after)};
    AddErrors(view, next, cameras, QuaternionOrder::kWFirst, w_first);
    AddErrors(view, next, cameras, QuaternionOrder::kWLast, w_last);
  }
  const ClusterFit first = FitIn(QuaternionOrder::kWFirst, w_first);
  const ClusterFit last = FitIn(QuaternionOrder::kWLast, w_last);
  return last.static_px && *last.static_px < *first.static_px / 2 ? last : first;
}

}  // namespace clearway
