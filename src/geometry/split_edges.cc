#include "geometry/split_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clearway {
namespace {

constexpr int kMaxPasses = 6;  // each splits one edge of a face
constexpr std::int64_t kMaxComparisons = 20'000'000;

// The vertices of edges that one face alone has, by their coordinate along the longest axis.
class LooseVertices {
 public:
  LooseVertices(const std::vector<FaceEdge>& loose, const std::vector<Eigen::Vector3d>& points)
      : points_(points) {
    Eigen::Vector3d low = points[loose[0].low], high = low;
    for (const FaceEdge& edge : loose) {
      for (const std::uint32_t vertex : {edge.low, edge.high}) {
        sorted_.push_back(vertex);
        low = low.cwiseMin(points[vertex]);
        high = high.cwiseMax(points[vertex]);
      }
    }
    (high - low).maxCoeff(&axis_);
    const auto key = [&](std::uint32_t v) { return std::pair(points_[v][axis_], v); };
    std::sort(sorted_.begin(), sorted_.end(), [&](auto l, auto r) { return key(l) < key(r); });
    sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
  }

  // Those that lie on the edge between its ends, in order from `low` to `high`. None if the face's
  // third corner is one of them: the face has no area.
  std::vector<std::uint32_t> On(const FaceEdge& edge, std::uint32_t apex, double tolerance_m,
                                std::int64_t& comparisons) const {
    const Eigen::Vector3d& from = points_[edge.low];
    const Eigen::Vector3d along = points_[edge.high] - from;
    const double length_m = along.norm();
    const auto [least, most] = std::minmax(from[axis_], points_[edge.high][axis_]);
    std::vector<std::pair<double, std::uint32_t>> found;
    auto next = std::lower_bound(sorted_.begin(), sorted_.end(), least - tolerance_m,
                                 [&](std::uint32_t v, double x) { return points_[v][axis_] < x; });
    for (; next != sorted_.end() && points_[*next][axis_] <= most + tolerance_m; ++next) {
      ++comparisons;
      const Eigen::Vector3d to = points_[*next] - from;
      const double at_m = to.dot(along) / length_m;
      if (at_m <= tolerance_m || at_m >= length_m - tolerance_m) continue;
      if ((to - at_m / length_m * along).norm() <= tolerance_m) found.emplace_back(at_m, *next);
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> vertices;
    for (const auto& [at_m, vertex] : found) {
      if (vertex == apex) return {};
      vertices.push_back(vertex);
    }
    return vertices;
  }

 private:
  const std::vector<Eigen::Vector3d>& points_;
  std::vector<std::uint32_t> sorted_;
  int axis_ = 0;
};

// A fan over the cut edge from the corner opposite to it.
void Cut(const FaceEdge& edge, std::uint32_t apex, const std::vector<std::uint32_t>& at,
         std::vector<Face>& faces) {
  std::uint32_t from = edge.low;
  for (std::size_t i = 0; i <= at.size(); ++i) {
    const std::uint32_t to = i < at.size() ? at[i] : edge.high;
    const Face part = edge.upward ? Face{from, to, apex} : Face{to, from, apex};
    if (i == 0) {
      faces[edge.face] = part;
    } else {
      faces.push_back(part);
    }
    from = to;
  }
}

}  // namespace

std::vector<Face> SplitAtVerticesOnEdges(std::vector<Face> faces,
                                         const std::vector<Eigen::Vector3d>& points,
                                         double tolerance_m) {
  std::int64_t comparisons = 0;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    std::vector<FaceEdge> loose;
    ForEachEdge(EdgesOf(faces), [&](std::span<const FaceEdge> sharing) {
      if (sharing.size() == 1) loose.push_back(sharing[0]);
    });
    if (loose.empty()) break;
    const LooseVertices vertices(loose, points);
    std::vector<bool> is_cut(faces.size());
    bool any = false;
    for (const FaceEdge& edge : loose) {
      if (is_cut[edge.face] || comparisons > kMaxComparisons) continue;
      const std::uint32_t apex = ApexOf(faces[edge.face], edge);
      const auto at = vertices.On(edge, apex, tolerance_m, comparisons);
      if (at.empty()) continue;
      is_cut[edge.face] = any = true;
      Cut(edge, apex, at, faces);
    }
    if (!any) break;
  }
  return faces;
}

}  // namespace clearway
