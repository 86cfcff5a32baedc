#include "cli/commonroad_road.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/io/world_origin.h"

namespace clearway::cli {
namespace {

constexpr double kThickness_m = 0.1;
constexpr double kAside_m = 0.05;  // how far a point of the bound may lie beside its box's middle
constexpr double kLongest_m = 50;

absl::StatusOr<std::vector<Eigen::Vector2d>> PointsOf(const XmlElement& bound) {
  std::vector<Eigen::Vector2d> points;
  for (const XmlElement& point : bound.Children("point")) {
    const auto p = PointOf(point);
    if (!p.ok()) return p.status();
    points.push_back(*p);
  }
  if (points.size() < 2) return bound.Error("expected two points or more");
  return points;
}

// From the first of the points to the last.
Track EdgeOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m) {
  const Eigen::Vector2d along = to - from, middle = (from + to) / 2;
  Track edge;
  edge.shape = Box{{along.norm() + kThickness_m, kThickness_m, height_m}};
  edge.moves = false;
  Sighting& seen = edge.seen.emplace_back();
  seen.T_W_O = Pose::Translation(middle.x(), middle.y(), height_m / 2);
  seen.T_W_O.rotation =
      Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Eigen::Vector3d::UnitZ());
  return edge;
}

// Whether one box covers the bound from point `from` to point `to`.
bool IsStraight(const std::vector<Eigen::Vector2d>& points, std::size_t from, std::size_t to) {
  const Eigen::Vector2d along = points[to] - points[from];
  if (along.norm() > kLongest_m || along.norm() < kAside_m) return false;
  const Eigen::Hyperplane<double, 2> line =
      Eigen::Hyperplane<double, 2>::Through(points[from], points[to]);
  for (std::size_t i = from + 1; i < to; ++i) {
    if (line.absDistance(points[i]) > kAside_m) return false;
  }
  return true;
}

void AddEdges(const std::vector<Eigen::Vector2d>& points, double height_m,
              std::vector<Track>& edges) {
  for (std::size_t from = 0, to = 0; from + 1 < points.size(); from = to) {
    to = from + 1;
    while (to + 1 < points.size() && IsStraight(points, from, to + 1)) ++to;
    // A straight bound of any length is cut into boxes of a length that a scene takes.
    const Eigen::Vector2d along = points[to] - points[from];
    const double parts = std::max(1.0, std::ceil(along.norm() / kLongest_m));
    for (double part = 0; part < parts; ++part) {
      edges.push_back(EdgeOf(points[from] + part / parts * along,
                             points[from] + (part + 1) / parts * along, height_m));
    }
  }
}

}  // namespace

absl::StatusOr<Eigen::Vector2d> PointOf(const XmlElement& point) {
  const auto x = point.Number("x"), y = point.Number("y");
  if (!x.ok()) return x.status();
  if (!y.ok()) return y.status();
  if (std::max(std::abs(*x), std::abs(*y)) > kMaxFileCoordinate_m) {
    return point.Error(absl::StrCat("is beyond the limit of ", kMaxFileCoordinate_m, " m"));
  }
  return Eigen::Vector2d(*x, *y);
}

absl::StatusOr<std::vector<Track>> RoadEdgesOf(const XmlElement& road, double height_m) {
  std::vector<Track> edges;
  for (const XmlElement& lanelet : road.Children("lanelet")) {
    for (const auto& [bound, neighbour] :
         {std::pair{"leftBound", "adjacentLeft"}, {"rightBound", "adjacentRight"}}) {
      if (lanelet.Has(neighbour)) continue;
      const auto element = lanelet.Child(bound);
      if (!element.ok()) return element.status();
      const auto points = PointsOf(*element);
      if (!points.ok()) return points.status();
      const std::size_t before = edges.size();
      AddEdges(*points, height_m, edges);
      for (std::size_t i = before; i < edges.size(); ++i) {
        edges[i].name =
            absl::StrCat("road edge (", bound, " of lanelet ", lanelet.Attribute("id"), ")");
      }
    }
  }
  return edges;
}

}  // namespace clearway::cli
