#include "report/name_painter.h"

#include <array>
#include <utility>

#include "report/label_places.h"

namespace clearway::report {
namespace {

constexpr TextStyle kStyle{.size_px = 17, .align = Align::kCenter, .bold = true, .halo_px = 5};
constexpr double kLinePx = 22, kBaselinePx = 6;  // the latter from below

Rect Around(const Polygon& pixels) {
  Rect rect;
  for (const Eigen::Vector2d& corner : pixels) rect.extend(corner);
  return rect;
}

}  // namespace

void DrawNames(Canvas& canvas, const MapView& view, const std::vector<NamedOutline>& outlines) {
  const Rect frame(view.top_left(), view.top_left() + view.size_px());
  LabelPlaces places(frame);
  places.KeepClear(ScaleArea(view));
  for (const NamedOutline& outline : outlines) places.KeepClear(Around(outline.pixels));
  std::vector<std::pair<Eigen::Vector2d, std::string>> texts;  // over all lines
  for (const NamedOutline& outline : outlines) {
    const Rect named = Around(outline.pixels);
    if (!frame.intersects(named)) continue;
    const double width_px = canvas.TextWidth(outline.name, kStyle) + kStyle.halo_px;
    const Rect label = places.Take(named, {width_px, kLinePx});
    texts.push_back({{label.center().x(), label.max().y() - kBaselinePx}, outline.name});
    if (!LabelPlaces::IsFar(label, named)) continue;
    canvas.Line(std::array<Eigen::Vector2d, 2>{label.center(), named.center()},
                {palette::kInk, 1.2});
  }
  for (const auto& [position, text] : texts) canvas.Text(position, text, kStyle);
}

}  // namespace clearway::report
