#include "clearway/geometry/hull.h"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <algorithm>
#include <cstdio>
#include <vector>

namespace clearway {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Qhull's state for one hull. Qhull reports errors by return code; flat input is one.
struct QhullRun {
  explicit QhullRun(std::span<const Eigen::Vector3d> points) {
    qh_zero(&qh, nullptr);
    std::vector<double> coordinates(points.front().data(),
                                    points.front().data() + 3 * points.size());
    char command[] = "qhull Qt";
    std::FILE* silence = std::fopen("/dev/null", "w");
    ok = qh_new_qhull(&qh, 3, static_cast<int>(points.size()), coordinates.data(), 0, command,
                      nullptr, silence) == 0;
    if (silence != nullptr) std::fclose(silence);
    if (ok) CollectTriangles();
  }
  ~QhullRun() {
    qh_freeqhull(&qh, !qh_ALL);
    int remaining = 0, total = 0;
    qh_memfreeshort(&qh, &remaining, &total);
  }

  void CollectTriangles() {
    qhT* const q = &qh;
    for (const facetT* facet = q->facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      Triangle triangle{};
      for (int corner = 0; corner < 3; ++corner) {
        const auto* vertex = static_cast<vertexT*>(facet->vertices->e[corner].p);
        triangle[corner] = static_cast<std::uint32_t>(qh_pointid(q, vertex->point));
      }
      triangles.push_back(triangle);
    }
  }

  qhT qh;
  bool ok = false;
  std::vector<Triangle> triangles;
};

// Winds each triangle so that its normal points away from `inside`.
void TurnOutward(std::vector<Triangle>& triangles, std::span<const Eigen::Vector3d> points,
                 const Eigen::Vector3d& inside) {
  for (Triangle& triangle : triangles) {
    const Eigen::Vector3d& a = points[triangle[0]];
    const Eigen::Vector3d normal = (points[triangle[1]] - a).cross(points[triangle[2]] - a);
    if (normal.dot(a - inside) < 0) std::swap(triangle[1], triangle[2]);
  }
}

Mesh WithUsedVertices(std::vector<Triangle> triangles, std::span<const Eigen::Vector3d> points) {
  std::vector<std::uint32_t> used;
  for (const Triangle& triangle : triangles)
    used.insert(used.end(), triangle.begin(), triangle.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  Mesh mesh;
  for (std::uint32_t index : used) mesh.vertices.push_back(points[index]);
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& index : triangle) {
      index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) -
                                         used.begin());
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

Mesh ConvexHullOf(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 4) return {};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  QhullRun run(points);
  if (!run.ok) return {};
  TurnOutward(run.triangles, points, sum / static_cast<double>(points.size()));
  return WithUsedVertices(std::move(run.triangles), points);
}

}  // namespace clearway
