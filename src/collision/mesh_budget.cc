#include "collision/mesh_budget.h"

#include <algorithm>
#include <variant>

namespace clearway {
namespace {

// For the whole robot: a few seconds' worth of each.
constexpr double kCells = 1 << 20;
constexpr double kVisits = 7e7;
constexpr double kAngles = 5e7;
constexpr double kHullWork = 1e8;  // squares of numbers of corners, as Qhull takes for rims

const Mesh* MeshOf(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->mesh.get();
  if (const auto* polytope = std::get_if<ConvexPolytope>(&shape)) return polytope->mesh.get();
  return nullptr;
}

}  // namespace

double WantedCells(std::size_t triangles) {
  return std::min(32768.0, 512 + 64 * static_cast<double>(triangles));
}

BudgetShares::BudgetShares(const Robot& robot) : hull_work_left_(kHullWork) {
  for (const Link& link : robot.links) {
    for (const LinkShape& part : link.shapes) {
      const Mesh* mesh = MeshOf(part.shape);
      if (mesh != nullptr) wanted_cells_ += WantedCells(mesh->triangles.size());
    }
  }
}

MeshBudget BudgetShares::Next(const Shape& shape) {
  MeshBudget budget;
  const Mesh* mesh = MeshOf(shape);
  if (mesh == nullptr) return budget;
  const double share = WantedCells(mesh->triangles.size()) / wanted_cells_;
  const auto part_of = [&](double all, std::uint64_t most) {
    return static_cast<std::uint64_t>(std::min(share * all, static_cast<double>(most)));
  };
  budget.cells = std::min(budget.cells, share * kCells);
  budget.visits = part_of(kVisits, budget.visits);
  budget.angles = part_of(kAngles, budget.angles);
  if (!std::holds_alternative<ConvexPolytope>(shape)) return budget;
  const auto corners = static_cast<double>(mesh->vertices.size());
  if (corners > static_cast<double>(budget.hull_corners)) return budget;
  if (corners * corners > hull_work_left_) {
    budget.hull_corners = 0;
  } else {
    hull_work_left_ -= corners * corners;
  }
  return budget;
}

}  // namespace clearway
