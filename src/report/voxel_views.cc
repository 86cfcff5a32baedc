#include "report/voxel_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "report/polygon.h"

namespace clearway::report {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAzimuth = -52 * kDegree;   // of the oblique view, from the object's length
constexpr double kElevation = 27 * kDegree;  // over the ground

// Of a voxel's face: which axis it is square to, and on which side.
struct Face {
  int axis;
  int side;  // +1 or -1
};

int& Axis(VoxelKey& key, int axis) { return axis == 0 ? key.x : axis == 1 ? key.y : key.z; }

std::array<Eigen::Vector3d, 4> CornersOf(const Face& face, const Eigen::Vector3d& center,
                                         double half) {
  const int u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
  std::array<Eigen::Vector3d, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = center;
    corners[i][face.axis] += face.side * half;
    corners[i][u] += (i == 1 || i == 2 ? half : -half);
    corners[i][v] += (i >= 2 ? half : -half);
  }
  return corners;
}

Polygon Projected(std::span<const Eigen::Vector3d> points_O, const Eigen::Matrix3d& axes,
                  const Eigen::Vector2d& origin, double px_per_m) {
  Polygon polygon;
  for (const Eigen::Vector3d& p_O : points_O) {
    const Eigen::Vector3d p = axes * p_O;
    polygon.push_back(origin + px_per_m * Eigen::Vector2d(p.x(), -p.y()));
  }
  return polygon;
}

// The parts of a cube that the viewer sees: those faces that are turned towards him.
std::vector<Face> FacesTowards(const Eigen::Vector3d& viewer) {
  std::vector<Face> faces;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(viewer[axis]) > 1e-6) faces.push_back({axis, viewer[axis] > 0 ? 1 : -1});
  }
  return faces;
}

// Nearer voxels are darker; faces that look up are lighter.
Color ShadeOf(double nearness, double light) {
  const Color near = Color::Hex(0x0a5c58), far = Color::Hex(0xb9dbd8);
  const Color base = Mix(far, near, nearness);
  return Mix(Mix(base, Color::Hex(0x06211f), 0.55), Mix(base, palette::kPaper, 0.12), light);
}

}  // namespace

const char* NameOf(ViewKind kind) {
  switch (kind) {
    case ViewKind::kOblique:
      return "oblique";
    case ViewKind::kTop:
      return "top";
    case ViewKind::kSide:
      return "side";
    case ViewKind::kFront:
      break;
  }
  return "front";
}

VoxelViews::VoxelViews(const MovingObject& object)
    : object_(object), extent_(ExtentOf(object)), least_(object.map_O.model().clamp_max) {
  constexpr double kFewCertain = 0.4;
  object.map_O.blocks().ForEach([this](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      (block.log_odds[index] >= least_ ? cubes_ : pale_).push_back(VoxelAt(key, index));
    });
  });
  if (static_cast<double>(cubes_.size()) >= kFewCertain * static_cast<double>(voxel_count()))
    return;
  cubes_.insert(cubes_.end(), pale_.begin(), pale_.end());
  pale_.clear();
  least_ = object.map_O.model().occupied;
}

Eigen::Matrix3d VoxelViews::AxesOf(ViewKind kind) const {
  // In E, whose x is the object's length and whose z is up.
  Eigen::Matrix3d axes_E = Eigen::Matrix3d::Identity();
  const double az = kAzimuth, el = kElevation;
  switch (kind) {
    case ViewKind::kTop:
      axes_E << 1, 0, 0, 0, 1, 0, 0, 0, 1;
      break;
    case ViewKind::kSide:
      axes_E << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      break;
    case ViewKind::kFront:
      axes_E << 0, 1, 0, 0, 0, 1, 1, 0, 0;
      break;
    case ViewKind::kOblique:
      axes_E << -std::sin(az), std::cos(az), 0,                                      //
          -std::sin(el) * std::cos(az), -std::sin(el) * std::sin(az), std::cos(el),  //
          std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el);
      break;
  }
  return axes_E * Eigen::AngleAxisd(-extent_.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Aabb VoxelViews::BoundsOf(ViewKind kind) const {
  const Eigen::Matrix3d axes = AxesOf(kind);
  Aabb bounds;
  for (const Eigen::Vector3d& p_O : object_.solid->hull->vertices) bounds.Extend(axes * p_O);
  return bounds;
}

Eigen::Vector2d VoxelViews::SizeOf(ViewKind kind) const { return BoundsOf(kind).Size().head<2>(); }

void VoxelViews::Draw(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& corner,
                      double px_per_m) const {
  if (Empty()) return;
  const Aabb bounds = BoundsOf(kind);
  const Eigen::Vector2d origin =
      corner + px_per_m * Eigen::Vector2d(-bounds.min.x(), bounds.min.y());
  if (kind != ViewKind::kOblique) DrawPale(canvas, kind, origin, px_per_m);
  DrawCubes(canvas, kind, origin, px_per_m);
  if (kind != ViewKind::kOblique || object_.given()) DrawHull(canvas, kind, origin, px_per_m);
}

void VoxelViews::DrawPale(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                          double px_per_m) const {
  const Eigen::Matrix3d axes = AxesOf(kind);
  const VoxelGrid& grid = object_.map_O.grid();
  for (const VoxelKey& key : pale_) {
    for (const Face& face : FacesTowards(axes.row(2))) {
      const auto corners = CornersOf(face, grid.CenterOf(key), grid.resolution_m() / 2);
      canvas.Fill(Projected(corners, axes, origin, px_per_m), Color::Hex(0xe4f0ee));
    }
  }
}

void VoxelViews::DrawCubes(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                           double px_per_m) const {
  const Eigen::Matrix3d axes = AxesOf(kind);
  const Eigen::Vector3d viewer = axes.row(2);
  const VoxelGrid& grid = object_.map_O.grid();
  const Aabb bounds = BoundsOf(kind);

  // From the back to the front along each axis in turn: no cube is drawn over one before it.
  std::vector<VoxelKey> order = cubes_;
  const auto rank = [&viewer](VoxelKey key) {
    for (int axis = 0; axis < 3; ++axis) {
      if (viewer[axis] < 0) Axis(key, axis) = -Axis(key, axis);
    }
    return key;
  };
  std::sort(order.begin(), order.end(),
            [&](const VoxelKey& a, const VoxelKey& b) { return rank(a) < rank(b); });

  const std::vector<Face> faces = FacesTowards(viewer);
  for (const VoxelKey& key : order) {
    const Eigen::Vector3d center = grid.CenterOf(key);
    const double nearness = (viewer.dot(center) - bounds.min.z()) / bounds.Size().z();
    for (const Face& face : faces) {
      VoxelKey neighbour = key;
      Axis(neighbour, face.axis) += face.side;
      if (object_.map_O.Find(neighbour).value_or(least_ - 1) >= least_) continue;
      const auto corners = CornersOf(face, center, grid.resolution_m() / 2);
      const Polygon polygon = Projected(corners, axes, origin, px_per_m);
      const double light = face.axis == 2 ? 1.0 : face.axis == 0 ? 0.45 : 0.7;
      const Color color = ShadeOf(nearness, kind == ViewKind::kOblique ? light : 1.0);
      canvas.Fill(polygon, color);
      canvas.Outline(polygon, {Mix(color, palette::kInk, 0.25), 0.6});
    }
  }
}

void VoxelViews::DrawHull(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                          double px_per_m) const {
  const Eigen::Matrix3d axes = AxesOf(kind);
  Polygon points = Projected(object_.solid->hull->vertices, axes, origin, px_per_m);
  canvas.Outline(ConvexOutline(std::move(points)), {palette::kInk.WithAlpha(0.6), 1.4, 5});
}

}  // namespace clearway::report
