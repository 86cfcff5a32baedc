#include "collision/random_solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "clearway/geometry/distance.h"
#include "clearway/geometry/hull.h"
#include "collision/test_meshes.h"

namespace clearway {
namespace {

using testing_support::Random;

Mesh AnyHull(Random& random) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d size(random.Uniform(0.2, 0.6), random.Uniform(0.2, 0.6),
                             random.Uniform(0.2, 0.6));
  for (int i = random.Integer(5, 24); i > 0; --i) {
    points.push_back(random.Vector(1).cwiseProduct(size));
  }
  return ConvexHullOf(points);
}

Mesh AnyBall(Random& random) {
  const double a = random.Uniform(1, 5), b = random.Uniform(1, 5), deep = random.Uniform(0, 0.5);
  return BallMesh(random.Integer(2, 6), random.Integer(4, 10), [&](const Eigen::Vector3d& d) {
    return 0.45 * (1 + deep * std::sin(a * d.x() + b) * std::cos(b * d.y() + a * d.z()));
  });
}

Mesh AnyRing(Random& random) {
  const auto around = static_cast<std::uint32_t>(random.Integer(5, 12));
  const auto across = static_cast<std::uint32_t>(random.Integer(3, 7));
  const double radius_m = random.Uniform(0.35, 0.5), tube_m = random.Uniform(0.1, 0.25);
  Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around;
    for (std::uint32_t j = 0; j < across; ++j) {
      const double v = 2 * std::numbers::pi * j / across;
      const double out_m = radius_m + tube_m * std::cos(v);
      mesh.vertices.emplace_back(out_m * std::cos(u), out_m * std::sin(u), tube_m * std::sin(v));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i % around * across + j % across;
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Of an outline of columns that stand on one line, extruded: L, T, U, combs.
Mesh AnyNotched(Random& random) {
  const auto columns = static_cast<std::uint32_t>(random.Integer(2, 5));
  std::vector<double> heights_m;
  for (std::uint32_t i = 0; i < columns; ++i) heights_m.push_back(random.Uniform(0.15, 1));
  const double width_m = random.Uniform(0.15, 0.3), depth_m = random.Uniform(0.2, 0.8);
  Mesh mesh;
  const auto add = [&](double x, double z) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(x, -0.5 * depth_m, z);
    mesh.vertices.emplace_back(x, 0.5 * depth_m, z);
    return first;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  // At each border a row of vertices: the bottom, and the heights of the columns beside it.
  std::vector<std::vector<std::pair<double, std::uint32_t>>> rows;
  for (std::uint32_t i = 0; i <= columns; ++i) {
    std::vector<double> zs = {0};
    if (i > 0) zs.push_back(heights_m[i - 1]);
    if (i < columns) zs.push_back(heights_m[i]);
    std::sort(zs.begin(), zs.end());
    auto& row = rows.emplace_back();
    for (const double z : zs) row.emplace_back(z, add(width_m * i, z));
  }
  for (std::uint32_t i = 0; i < columns; ++i) {
    // The column's outline: up the right row as far as it is high, and down the left one.
    std::vector<std::uint32_t> outline;
    for (const auto& [z, vertex] : rows[i + 1]) {
      if (z <= heights_m[i]) outline.push_back(vertex);
    }
    for (auto it = rows[i].rbegin(); it != rows[i].rend(); ++it) {
      if (it->first <= heights_m[i]) outline.push_back(it->second);
    }
    // Collinear corners may follow each other: fans round a middle of its own have an area.
    const std::uint32_t middle = add(width_m * (i + 0.5), 0.4 * heights_m[i]);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const std::uint32_t a = outline[k], b = outline[(k + 1) % outline.size()];
      mesh.triangles.push_back({middle, a, b});
      mesh.triangles.push_back({middle + 1, b + 1, a + 1});
    }
    quad(rows[i].front().second, rows[i].front().second + 1, rows[i + 1].front().second + 1,
         rows[i + 1].front().second);
    const auto top = [&](const auto& row) {
      return std::find_if(row.begin(), row.end(),
                          [&](const auto& v) { return v.first == heights_m[i]; })
          ->second;
    };
    const std::uint32_t left = top(rows[i]), right = top(rows[i + 1]);
    quad(left, right, right + 1, left + 1);
  }
  for (std::uint32_t i = 0; i <= columns; ++i) {  // the walls between
    const double before_m = i > 0 ? heights_m[i - 1] : 0, after_m = i < columns ? heights_m[i] : 0;
    const double from_m = std::min(before_m, after_m), to_m = std::max(before_m, after_m);
    for (std::size_t k = 0; k + 1 < rows[i].size(); ++k) {
      if (rows[i][k].first < from_m || rows[i][k + 1].first > to_m) continue;
      const std::uint32_t a = rows[i][k].second, b = rows[i][k + 1].second;
      quad(a, a + 1, b + 1, b);
    }
  }
  return mesh;
}

Mesh AnyPart(int kind, Random& random) {
  if (kind == 0) return AnyHull(random);
  if (kind == 1) return AnyBall(random);
  return kind == 2 ? AnyRing(random) : AnyNotched(random);
}

Mesh MovedBy(Mesh mesh, const Pose& pose) {
  for (Eigen::Vector3d& v : mesh.vertices) v = pose * v;
  return mesh;
}

int Crossings(const Mesh& mesh, const Eigen::Vector3d& p, const Eigen::Vector3d& direction) {
  int crossings = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[i] - p, b = mesh.vertices[j] - p,
                          c = mesh.vertices[k] - p;
    const double u = direction.dot(a.cross(b)), v = direction.dot(b.cross(c)),
                 w = direction.dot(c.cross(a));
    const bool on_line = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    if (on_line && a.dot(b.cross(c)) / (u + v + w) > 0) ++crossings;
  }
  return crossings;
}

bool PartContains(const Mesh& mesh, const Eigen::Vector3d& p) {
  int inside = 0;
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0.31, 0.82, 0.47), Eigen::Vector3d(-0.73, 0.11, 0.61),
        Eigen::Vector3d(0.17, -0.59, -0.71)}) {
    inside += Crossings(mesh, p, direction) % 2;
  }
  return inside >= 2;
}

}  // namespace

Mesh RandomSolid::Joined() const {
  Mesh all;
  for (const Mesh& part : parts) {
    const auto shift = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [i, j, k] : part.triangles) {
      all.triangles.push_back({i + shift, j + shift, k + shift});
    }
  }
  return all;
}

bool RandomSolid::Contains(const Eigen::Vector3d& p) const {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Mesh& part) { return PartContains(part, p); });
}

double RandomSolid::DistanceTo(const Eigen::Vector3d& p) const {
  if (Contains(p)) return 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Mesh& part : parts) {
    for (const auto& [i, j, k] : part.triangles) {
      nearest_m = std::min(nearest_m, PointTriangleDistance(p, part.vertices[i], part.vertices[j],
                                                            part.vertices[k]));
    }
  }
  return nearest_m;
}

RandomSolid AnySolid(Random& random) {
  static constexpr const char* kNames[] = {"hull", "ball", "ring", "notched"};
  RandomSolid solid;
  const int count = random.Integer(0, 4) == 0 ? 2 : 1;
  for (int i = 0; i < count; ++i) {
    const int kind = random.Integer(0, 3);
    solid.kind += solid.kind.empty() ? kNames[kind] : std::string(" and ") + kNames[kind];
    solid.parts.push_back(MovedBy(AnyPart(kind, random), i == 0 ? Pose{} : random.AnyPose(0.6)));
  }
  return solid;
}

Mesh Damaged(const Mesh& mesh, Random& random) {
  const double turned = random.Uniform(0, 1), doubled = random.Uniform(0, 0.6);
  const bool shared = random.Integer(0, 1) == 0;
  auto faces = mesh.triangles;
  for (const auto& face : mesh.triangles) {
    if (random.Uniform(0, 1) < doubled) faces.push_back({face[1], face[2], face[0]});
  }
  for (std::size_t i = faces.size(); i > 1; --i) {
    std::swap(faces[i - 1], faces[random.Integer(0, static_cast<int>(i) - 1)]);
  }
  for (auto& face : faces) {
    if (random.Uniform(0, 1) < turned) std::swap(face[1], face[2]);
  }
  if (shared) return {mesh.vertices, faces};
  Mesh soup;
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : face) soup.vertices.push_back(mesh.vertices[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace clearway
