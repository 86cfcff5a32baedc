#include "collision/separation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clearway {
namespace {

constexpr int kMostLooks = 32;
constexpr double kRounding_m = 1e-9;
// A gap beyond the margin is as great as can be if it is this part of it, or this close in metres.
constexpr double kAllBut = 0.98, kAllBut_m = 1e-8;

// Up to four points whose hull lies in the difference of the bodies, second less first: the nearer
// the hull's nearest point is to the origin, the better it tells the distance. Points that do not
// help are dropped. (Ericson, "Real-Time Collision Detection", 2005, section 5.1.)
class Simplex {
 public:
  void Add(const Eigen::Vector3d& p) { points_[count_++] = p; }

  // The hull's nearest point to the origin; leaves the points that span it.
  Eigen::Vector3d Nearest() {
    if (count_ == 1) return points_[0];
    if (count_ == 2) return Keep(OfSegment(points_[0], points_[1]));
    if (count_ == 3) return Keep(OfTriangle(points_[0], points_[1], points_[2]));
    return Keep(OfTetrahedron());
  }

 private:
  struct Part {
    Eigen::Vector3d nearest;
    std::array<Eigen::Vector3d, 4> points;
    int count;
  };

  Eigen::Vector3d Keep(const Part& part) {
    points_ = part.points;
    count_ = part.count;
    return part.nearest;
  }

  static Part OfSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d ab = b - a;
    const double along = -a.dot(ab), all = ab.squaredNorm();
    if (along <= 0) return {a, {a}, 1};
    if (along >= all) return {b, {b}, 1};
    return {a + along / all * ab, {a, b}, 2};
  }

  static Part Nearer(const Part& l, const Part& r) {
    return l.nearest.squaredNorm() <= r.nearest.squaredNorm() ? l : r;
  }

  // If the origin lies over no point of the triangle's inside, the nearest point is on an edge.
  static Part OfTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c) {
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const bool inside =
        normal.dot(a.cross(b)) > 0 && normal.dot(b.cross(c)) > 0 && normal.dot(c.cross(a)) > 0;
    if (inside) return {normal.dot(a) / normal.squaredNorm() * normal, {a, b, c}, 3};
    return Nearer(OfSegment(a, b), Nearer(OfSegment(b, c), OfSegment(c, a)));
  }

  // The nearest of the faces that have the origin on their outer side; in a flat one, of all.
  Part OfTetrahedron() const {
    Part nearest{Eigen::Vector3d::Zero(), points_, 4};
    bool inside = true;
    for (int left_out = 0; left_out < 4; ++left_out) {
      const Eigen::Vector3d &a = points_[(left_out + 1) % 4], &b = points_[(left_out + 2) % 4],
                            &c = points_[(left_out + 3) % 4], &other = points_[left_out];
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      if (normal.dot(-a) * normal.dot(other - a) > 0) continue;
      const Part face = OfTriangle(a, b, c);
      nearest = inside ? face : Nearer(nearest, face);
      inside = false;
    }
    return nearest;
  }

  std::array<Eigen::Vector3d, 4> points_;
  int count_ = 0;
};

}  // namespace

Separation FindSeparation(FarthestPoint first, FarthestPoint second,
                          const Eigen::Vector3d& first_look, double margin_m,
                          absl::FunctionRef<bool(const Separation&)> enough) {
  Separation best;
  Simplex difference;
  Eigen::Vector3d nearest = first_look;
  for (int look = 0; look < kMostLooks; ++look) {
    const Eigen::Vector3d direction = nearest.normalized();
    const Eigen::Vector3d apart = second(-direction) - first(direction);
    const double gap_m = direction.dot(apart) - kRounding_m;
    if (gap_m > best.gap_m) best = {direction, gap_m, best.at_most_m};
    if (best.gap_m > margin_m && enough(best)) break;
    if (best.gap_m - margin_m >= kAllBut * (best.at_most_m - margin_m) - kAllBut_m) break;
    difference.Add(apart);
    nearest = difference.Nearest();
    // The point is one of the difference: the bodies are no farther apart.
    const double length_m = nearest.norm(), at_most_m = length_m == 0 ? 0 : length_m + kRounding_m;
    const bool nearer = at_most_m < best.at_most_m;
    best.at_most_m = std::min(best.at_most_m, at_most_m);
    if (best.at_most_m <= margin_m || !nearer) break;
  }
  return best;
}

}  // namespace clearway
