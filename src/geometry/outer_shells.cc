#include "geometry/outer_shells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace clearway {
namespace {

constexpr double kSameAngle_rad = 1e-6;
constexpr double kNoVolume = 1e-12;  // of the cube of the surface's extent

// The two sides of each face, by what part of space they bound.
class Sides {
 public:
  Sides(const std::vector<Face>& faces, const std::vector<Eigen::Vector3d>& points)
      : faces_(faces), points_(points), sets_(2 * faces.size()), unclear_(faces.size()) {
    ForEachEdge(EdgesOf(faces), [&](std::span<const FaceEdge> edges) { JoinAround(edges); });
  }

  std::uint32_t FrontOf(std::uint32_t face) { return sets_.Of(2 * face); }
  std::uint32_t BackOf(std::uint32_t face) { return sets_.Of(2 * face + 1); }
  // Whether it shares an edge with others whose order around it is not known.
  bool Unclear(std::uint32_t face) const { return unclear_[face]; }

 private:
  struct AroundEdge {
    double angle_rad;
    FaceEdge edge;
  };

  void JoinAround(std::span<const FaceEdge> edges) {
    if (edges.size() == 1) return;
    std::vector<AroundEdge> around;
    for (const FaceEdge& edge : edges) around.push_back({0, edge});
    if (edges.size() > 2) SortByAngle(around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const FaceEdge& edge = around[i].edge;
      const FaceEdge& next = around[(i + 1) % around.size()].edge;
      // Angles grow towards the front of a face that runs upward.
      sets_.Join(2 * edge.face + (edge.upward ? 0 : 1), 2 * next.face + (next.upward ? 1 : 0));
    }
  }

  void SortByAngle(std::vector<AroundEdge>& around) {
    const Eigen::Vector3d from = points_[around[0].edge.low];
    const Eigen::Vector3d axis = (points_[around[0].edge.high] - from).normalized();
    const Eigen::Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
    bool unclear = false;
    for (AroundEdge& face : around) {
      const Eigen::Vector3d to = points_[ApexOf(faces_[face.edge.face], face.edge)] - from;
      face.angle_rad = std::atan2(to.dot(y), to.dot(x));
      unclear |= std::hypot(to.dot(x), to.dot(y)) <= kSameAngle_rad * to.norm();
    }
    std::sort(around.begin(), around.end(),
              [](const AroundEdge& l, const AroundEdge& r) { return l.angle_rad < r.angle_rad; });
    for (std::size_t i = 0; i < around.size(); ++i) {
      const double next_rad = i + 1 < around.size() ? around[i + 1].angle_rad
                                                    : around[0].angle_rad + 2 * std::numbers::pi;
      unclear |= next_rad - around[i].angle_rad < kSameAngle_rad;
    }
    for (const AroundEdge& face : around)
      unclear_[face.edge.face] = unclear_[face.edge.face] || unclear;
  }

  const std::vector<Face>& faces_;
  const std::vector<Eigen::Vector3d>& points_;
  DisjointSets sets_;
  std::vector<bool> unclear_;
};

// The part of space around all of a closed surface; nothing if the surface holds no volume.
std::optional<std::uint32_t> OutsideOf(const Surface& surface, const std::vector<Face>& faces,
                                       const std::vector<Eigen::Vector3d>& points, Sides& sides) {
  const Eigen::Vector3d center = points[faces[surface.faces[0]][0]];
  std::map<std::uint32_t, double> volumes;  // six times the volume behind the sides
  double extent_m = 0;
  for (const std::uint32_t f : surface.faces) {
    const auto& [i, j, k] = faces[f];
    const Eigen::Vector3d a = points[i] - center, b = points[j] - center, c = points[k] - center;
    const double volume = a.dot(b.cross(c));
    volumes[sides.FrontOf(f)] += volume;
    volumes[sides.BackOf(f)] -= volume;
    extent_m = std::max({extent_m, a.norm(), b.norm(), c.norm()});
  }
  std::optional<std::uint32_t> outside;
  double largest = kNoVolume * extent_m * extent_m * extent_m;
  for (const auto& [part, volume] : volumes) {
    if (volume <= largest) continue;
    largest = volume;
    outside = part;
  }
  return outside;
}

// The side of an open surface that more faces have in front.
std::uint32_t FrontOfMost(const Surface& surface, Sides& sides) {
  const std::uint32_t one = sides.FrontOf(surface.faces[0]);
  const auto in_front = std::count_if(surface.faces.begin(), surface.faces.end(),
                                      [&](std::uint32_t f) { return sides.FrontOf(f) == one; });
  return 2 * static_cast<std::size_t>(in_front) >= surface.faces.size()
             ? one
             : sides.BackOf(surface.faces[0]);
}

}  // namespace

std::vector<Surface> SurfacesOf(const std::vector<Face>& faces) {
  DisjointSets sets(faces.size());
  std::vector<bool> loose(faces.size());
  ForEachEdge(EdgesOf(faces), [&](std::span<const FaceEdge> edges) {
    for (const FaceEdge& edge : edges) sets.Join(edges[0].face, edge.face);
    if (edges.size() == 1) loose[edges[0].face] = true;
  });
  std::vector<Surface> surfaces;
  std::vector<std::size_t> index(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const std::uint32_t first = sets.Of(f);
    if (first == f) {
      index[f] = surfaces.size();
      surfaces.push_back({{}, true});
    }
    Surface& surface = surfaces[index[first]];
    surface.faces.push_back(f);
    if (loose[f]) surface.closed = false;
  }
  return surfaces;
}

std::vector<Side> OuterSidesOf(const std::vector<Face>& faces, const std::vector<Surface>& surfaces,
                               const std::vector<Eigen::Vector3d>& points) {
  Sides sides(faces, points);
  std::vector<Side> outer(faces.size(), Side::kUnknown);
  for (const Surface& surface : surfaces) {
    const std::optional<std::uint32_t> outside =
        surface.closed ? OutsideOf(surface, faces, points, sides) : FrontOfMost(surface, sides);
    const auto is_unknown = [&](std::uint32_t f) {
      const bool in_front = sides.FrontOf(f) == *outside, behind = sides.BackOf(f) == *outside;
      return sides.Unclear(f) || (in_front && behind) || (!surface.closed && !in_front && !behind);
    };
    if (!outside || std::any_of(surface.faces.begin(), surface.faces.end(), is_unknown)) continue;
    for (const std::uint32_t f : surface.faces) {
      outer[f] = sides.FrontOf(f) == *outside  ? Side::kFront
                 : sides.BackOf(f) == *outside ? Side::kBack
                                               : Side::kNone;
    }
  }
  return outer;
}

}  // namespace clearway
