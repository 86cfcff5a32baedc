#include "report/voxel_marks.h"

#include <algorithm>
#include <cmath>

#include "clearway/map/voxel_neighbours.h"

namespace clearway {
namespace {

// A face's plane in O; what lies in the hull has normal . p <= offset.
struct Face {
  Eigen::Vector3d normal;
  double offset, slope;  // slope: along a row
};

std::vector<Face> FacesOf(const Mesh& hull_O, const Eigen::Vector3d& along_O) {
  std::vector<Face> faces;
  for (const auto& [a, b, c] : hull_O.triangles) {
    const Eigen::Vector3d& origin = hull_O.vertices[a];
    const Eigen::Vector3d normal = (hull_O.vertices[b] - origin).cross(hull_O.vertices[c] - origin);
    faces.push_back({normal, normal.dot(origin), normal.dot(along_O)});
  }
  return faces;
}

// How far along a row from p_O the hull reaches, within [0, length_m]; empty if begin > end.
LinePart PartOfRow(const std::vector<Face>& faces, const Eigen::Vector3d& p_O, double length_m) {
  LinePart part{0, length_m};
  for (const Face& face : faces) {
    const double above = face.normal.dot(p_O) - face.offset;
    if (face.slope > 0) {
      part.end = std::min(part.end, -above / face.slope);
    } else if (face.slope < 0) {
      part.begin = std::max(part.begin, -above / face.slope);
    } else if (above > 0) {
      part.end = -1;
    }
    if (part.begin > part.end) break;
  }
  return part;
}

}  // namespace

VoxelMarks::VoxelMarks(const VoxelGrid& grid, const Aabb& box_W) : grid_(grid) {
  if (box_W.Empty()) return;
  min_ = grid.KeyOf(box_W.min);
  max_ = grid.KeyOf(box_W.max);
  marks_.resize(IndexOf(max_) + 1);
}

void VoxelMarks::MarkHull(const Mesh& hull_O, const Pose& T_O_W) {
  if (hull_O.triangles.empty()) return;
  const std::vector<Face> faces = FacesOf(hull_O, T_O_W.rotation * Eigen::Vector3d::UnitX());
  const double voxel_m = grid_.resolution_m();
  for (VoxelKey first = min_; first.z <= max_.z; ++first.z) {
    for (first.y = min_.y; first.y <= max_.y; ++first.y) {
      const auto [begin_m, end_m] =
          PartOfRow(faces, T_O_W * grid_.CenterOf(first), (max_.x - min_.x) * voxel_m);
      if (begin_m > end_m) continue;
      const auto row = marks_.begin() + static_cast<std::ptrdiff_t>(IndexOf(first));
      const auto begin = static_cast<std::ptrdiff_t>(std::ceil(begin_m / voxel_m));
      const auto end = static_cast<std::ptrdiff_t>(std::floor(end_m / voxel_m)) + 1;
      if (begin < end) std::fill(row + begin, row + end, 1);
    }
  }
}

bool VoxelMarks::Holds(VoxelKey key, std::int32_t padding) const {
  return key.x >= min_.x - padding && key.x <= max_.x + padding && key.y >= min_.y - padding &&
         key.y <= max_.y + padding && key.z >= min_.z - padding && key.z <= max_.z + padding;
}

bool VoxelMarks::AtOrBeside(VoxelKey key) const {
  return Holds(key, 1) && std::ranges::any_of(WithNeighbours(key), [&](VoxelKey beside) {
           return Holds(beside, 0) && marks_[IndexOf(beside)];
         });
}

std::size_t VoxelMarks::IndexOf(VoxelKey key) const {
  const auto extent = [](std::int32_t from, std::int32_t to) -> std::size_t {
    return to - from + 1;
  };
  return ((key.z - min_.z) * extent(min_.y, max_.y) + (key.y - min_.y)) * extent(min_.x, max_.x) +
         (key.x - min_.x);
}

}  // namespace clearway
