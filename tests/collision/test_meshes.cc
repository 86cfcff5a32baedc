#include "collision/test_meshes.h"

#include <cmath>
#include <numbers>

#include "collision/test_world.h"
#include "support/random.h"

namespace clearway {
namespace {

double Dented(const Eigen::Vector3d& d) {
  return 0.4 * (1 + 0.3 * std::sin(4 * d.x()) * std::sin(5 * d.y()) + 0.2 * std::cos(6 * d.z()));
}

Mesh Scaled(Mesh mesh, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& v : mesh.vertices) v = v.cwiseProduct(by);
  return mesh;
}

Mesh TurnedInward(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

Mesh Both(Mesh a, const Mesh& b, const Eigen::Vector3d& offset) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  for (const Eigen::Vector3d& v : b.vertices) a.vertices.push_back(v + offset);
  for (const auto& [i, j, k] : b.triangles) {
    a.triangles.push_back({i + shift, j + shift, k + shift});
  }
  return a;
}

// No two triangles share a vertex, as in STL files, and there is no vertex of no triangle.
Mesh Soup(const Mesh& mesh) {
  Mesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : triangle) soup.vertices.push_back(mesh.vertices[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

Mesh WithHoles(Mesh mesh, std::size_t every) {
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i % every != 0) kept.push_back(mesh.triangles[i]);
  }
  mesh.triangles = std::move(kept);
  return mesh;
}

// Below z = 0.
Mesh Bowl(Mesh mesh) {
  std::erase_if(mesh.triangles,
                [&](const auto& triangle) { return mesh.vertices[triangle[0]].z() > 0; });
  return mesh;
}

Mesh Sheet(int cells) {
  Mesh mesh;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      mesh.vertices.emplace_back(1.0 * x / cells - 0.5, 1.0 * y / cells - 0.5,
                                 0.1 * std::sin(0.9 * x) * std::cos(0.7 * y));
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

// Triangles that are points or lines, on the edges there are.
Mesh WithDegenerateTriangles(Mesh mesh) {
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; i += 3) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({a, a, a});
    mesh.triangles.push_back({a, b, b});
    mesh.triangles.push_back({c, b, c});
    mesh.triangles.push_back({c, c, a});
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.3 * mesh.vertices[a] + 0.7 * mesh.vertices[b]);
    mesh.triangles.push_back({a, middle, b});
    mesh.triangles.push_back({middle, a, b});
  }
  return mesh;
}

}  // namespace

Mesh BallMesh(int rings, int corners,
              const std::function<double(const Eigen::Vector3d& direction)>& radius_m) {
  Mesh mesh;
  const auto add = [&](double polar, double azimuth) {
    const Eigen::Vector3d direction(std::sin(polar) * std::cos(azimuth),
                                    std::sin(polar) * std::sin(azimuth), std::cos(polar));
    mesh.vertices.push_back(radius_m(direction) * direction);
  };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int corner = 0; corner < corners; ++corner) {
      add(std::numbers::pi * ring / (rings + 1), 2 * std::numbers::pi * corner / corners);
    }
  }
  add(0, 0);
  add(std::numbers::pi, 0);
  const auto top = static_cast<std::uint32_t>(rings * corners), bottom = top + 1;
  const auto at = [&](int ring, int corner) {
    return static_cast<std::uint32_t>(ring * corners + corner % corners);
  };
  for (int corner = 0; corner < corners; ++corner) {
    mesh.triangles.push_back({top, at(0, corner), at(0, corner + 1)});
    mesh.triangles.push_back({bottom, at(rings - 1, corner + 1), at(rings - 1, corner)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, corner), at(ring + 1, corner), at(ring + 1, corner + 1)});
      mesh.triangles.push_back({at(ring, corner), at(ring + 1, corner + 1), at(ring, corner + 1)});
    }
  }
  return mesh;
}

std::vector<TestMesh> TestMeshes() {
  std::vector<TestMesh> meshes;
  const auto add = [&](const std::string& name, Mesh mesh, double size_m) {
    const auto shared = std::make_shared<const Mesh>(std::move(mesh));
    meshes.push_back({name, shared, shared, size_m});
  };
  const Mesh ball = BallMesh(9, 12, Dented), cube = *CubeMesh(0.4);
  add("ball", ball, 0.5);
  add("ball turned inward", TurnedInward(ball), 0.5);
  add("soup", Soup(ball), 0.5);
  add("cube", cube, 0.4);
  add("cavity", Both(cube, TurnedInward(Scaled(ball, {0.5, 0.5, 0.5})), {0, 0, 0}), 0.4);
  add("two that overlap", Both(ball, ball, {0.2, 0.1, 0}), 0.6);
  add("plate", Scaled(cube, {1, 1, 0.003}), 0.4);
  add("tiny", Scaled(ball, {0.03, 0.03, 0.03}), 0.02);
  add("huge", Scaled(ball, {60, 50, 20}), 25);
  add("needle",
      BallMesh(2, 40,
               [](const Eigen::Vector3d& d) {
                 return 1 / std::hypot(d.x() / 0.01, d.y() / 0.01, d.z() / 0.6);
               }),
      0.6);
  add("ball with holes", WithHoles(ball, 11), 0.5);
  add("few triangles of a ball", Soup(WithHoles(WithHoles(ball, 2), 2)), 0.5);
  add("bowl", Soup(Bowl(ball)), 0.5);
  add("sheet", Sheet(12), 0.5);
  add("triangle", {{{-0.3, -0.2, 0.1}, {0.4, 0, 0}, {0, 0.5, 0.2}}, {{0, 1, 2}}}, 0.4);
  add("flat and closed", {{{0, 0, 0}, {0.5, 0, 0}, {0, 0.4, 0}}, {{0, 1, 2}, {0, 2, 1}}}, 0.4);
  add("degenerate", WithDegenerateTriangles(ball), 0.5);
  meshes.back().regular = meshes.front().mesh;
  return meshes;
}

}  // namespace clearway
