// Views of one object's voxels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/scene/object_extent.h"
#include "report/canvas.h"

namespace clearway::report {

enum class ViewKind { kOblique, kTop, kSide, kFront };
const char* NameOf(ViewKind kind);

// The occupied voxels of an object as seen in parallel projection along its extent's axes. Those
// that so many scans hit that they are as certain as the map's model lets them be are drawn as
// cubes; the others, which blur what is not quite rigid or not quite in its place, pale and flat
// behind them, and in the oblique view not at all. Of an object with few certain ones (young or
// far away) all are cubes. Refers to the object, which must outlive it.
class VoxelViews {
 public:
  explicit VoxelViews(const MovingObject& object);

  const ObjectExtent& extent() const { return extent_; }
  std::size_t voxel_count() const { return cubes_.size() + pale_.size(); }
  bool HasPale() const { return !pale_.empty(); }

  // What the view takes up, in metres.
  Eigen::Vector2d SizeOf(ViewKind kind) const;
  // Nothing to draw: neither an occupied voxel nor a given shape.
  bool Empty() const { return cubes_.empty() && !object_.given(); }
  // Draws the view with its lower left corner at `corner`.
  void Draw(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& corner, double px_per_m) const;

 private:
  // Rows: to the right, up and towards the viewer, in O.
  Eigen::Matrix3d AxesOf(ViewKind kind) const;
  void DrawPale(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                double px_per_m) const;
  void DrawCubes(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                 double px_per_m) const;
  void DrawHull(Canvas& canvas, ViewKind kind, const Eigen::Vector2d& origin,
                double px_per_m) const;
  Aabb BoundsOf(ViewKind kind) const;  // of the hull, in the view's axes

  const MovingObject& object_;
  ObjectExtent extent_;
  std::vector<VoxelKey> cubes_, pale_;
  LogOdds least_;  // of the voxels that are cubes
};

}  // namespace clearway::report
