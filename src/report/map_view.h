// A part of the ground plane on a canvas.
#pragma once

#include <Eigen/Core>

#include "clearway/geometry/aabb.h"
#include "clearway/scene/scene_snapshot.h"
#include "report/canvas.h"
#include "report/column_map.h"
#include "report/polygon.h"

namespace clearway::report {

// Maps W's x and y (x to the right, y up) onto a rectangle of a canvas. A value.
class MapView {
 public:
  // The rectangle begins at top_left and is width_px wide; its height follows from the area.
  MapView(const Aabb& area_W, const Eigen::Vector2d& top_left, double width_px)
      : area_W_(area_W), top_left_(top_left), px_per_m_(width_px / area_W.Size().x()) {}

  const Aabb& area_W() const { return area_W_; }
  double px_per_m() const { return px_per_m_; }
  const Eigen::Vector2d& top_left() const { return top_left_; }
  Eigen::Vector2d size_px() const { return px_per_m_ * area_W_.Size().head<2>(); }

  Eigen::Vector2d ToPixels(const Eigen::Vector2d& p_W) const {
    return top_left_ +
           px_per_m_ * Eigen::Vector2d(p_W.x() - area_W_.min.x(), area_W_.max.y() - p_W.y());
  }
  Polygon ToPixels(const Polygon& polygon_W) const;

 private:
  Aabb area_W_;
  Eigen::Vector2d top_left_;
  double px_per_m_;
};

void DrawColumns(Canvas& canvas, const MapView& view, const ColumnMap& columns,
                 double max_height_m);

// Where something moves that nobody labelled.
void DrawDynamic(Canvas& canvas, const MapView& view, const SceneSnapshot& scene);

// A round length of about a fifth of the view, and the directions of W's axes, in the lower left
// corner.
void DrawScale(Canvas& canvas, const MapView& view);
Eigen::AlignedBox2d ScaleArea(const MapView& view);  // what that covers, in pixels

}  // namespace clearway::report
