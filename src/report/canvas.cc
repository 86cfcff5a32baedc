#include "report/canvas.h"

#include <cairo/cairo.h>

#include <cstring>
#include <numbers>

#include "absl/strings/str_cat.h"

namespace clearway::report {
namespace {

void SetColor(cairo_t* cairo, const Color& color) {
  cairo_set_source_rgba(cairo, color.r, color.g, color.b, color.a);
}

void SetFont(cairo_t* cairo, const TextStyle& style) {
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size_px);
}

}  // namespace

Canvas::Canvas(int width_px, int height_px) : cairo_(nullptr, cairo_destroy) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px);
  cairo_.reset(cairo_create(surface));
  cairo_surface_destroy(surface);  // the context holds it
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  SetColor(cairo_.get(), palette::kPaper);
  cairo_paint(cairo_.get());
}

Canvas::~Canvas() = default;

void Canvas::Path(std::span<const Eigen::Vector2d> points) {
  cairo_new_path(cairo_.get());
  for (const Eigen::Vector2d& p : points) cairo_line_to(cairo_.get(), p.x(), p.y());
}

void Canvas::Apply(const Stroke& stroke) {
  SetColor(cairo_.get(), stroke.color);
  cairo_set_line_width(cairo_.get(), stroke.width_px);
  cairo_set_dash(cairo_.get(), &stroke.dash_px, stroke.dash_px > 0 ? 1 : 0, 0);
  cairo_stroke(cairo_.get());
}

void Canvas::Line(std::span<const Eigen::Vector2d> points, const Stroke& stroke) {
  Path(points);
  Apply(stroke);
}

void Canvas::Fill(std::span<const Eigen::Vector2d> polygon, const Color& color) {
  Path(polygon);
  SetColor(cairo_.get(), color);
  cairo_fill(cairo_.get());
}

void Canvas::Outline(std::span<const Eigen::Vector2d> polygon, const Stroke& stroke) {
  Path(polygon);
  cairo_close_path(cairo_.get());
  Apply(stroke);
}

void Canvas::FillRect(double x, double y, double width, double height, const Color& color) {
  cairo_new_path(cairo_.get());
  cairo_rectangle(cairo_.get(), x, y, width, height);
  SetColor(cairo_.get(), color);
  cairo_fill(cairo_.get());
}

void Canvas::Circle(const Eigen::Vector2d& center, double radius_px, const Color& fill,
                    const Stroke& stroke) {
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), center.x(), center.y(), radius_px, 0, 2 * std::numbers::pi);
  SetColor(cairo_.get(), fill);
  cairo_fill_preserve(cairo_.get());
  Apply(stroke);
}

double Canvas::TextWidth(const std::string& text, const TextStyle& style) {
  SetFont(cairo_.get(), style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::Text(const Eigen::Vector2d& position, const std::string& text,
                  const TextStyle& style) {
  const double width = TextWidth(text, style);
  const double shift = style.align == Align::kLeft     ? 0
                       : style.align == Align::kCenter ? width / 2
                                                       : width;
  cairo_new_path(cairo_.get());
  cairo_move_to(cairo_.get(), position.x() - shift, position.y());
  if (style.halo_px > 0) {
    cairo_text_path(cairo_.get(), text.c_str());
    Apply({palette::kPaper.WithAlpha(0.9), style.halo_px});
    cairo_move_to(cairo_.get(), position.x() - shift, position.y());
  }
  SetColor(cairo_.get(), style.color);
  cairo_show_text(cairo_.get(), text.c_str());
}

void Canvas::Image(const Eigen::Vector2d& top_left, double scale_px, int width, int height,
                   std::span<const std::uint32_t> pixels) {
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  if (cairo_surface_status(image) == CAIRO_STATUS_SUCCESS) {
    unsigned char* const data = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    for (int row = 0; row < height; ++row) {
      std::memcpy(data + static_cast<std::ptrdiff_t>(row) * stride,
                  pixels.data() + static_cast<std::ptrdiff_t>(row) * width, 4u * width);
    }
    cairo_surface_mark_dirty(image);
  }
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), top_left.x(), top_left.y());
  cairo_scale(cairo_.get(), scale_px, scale_px);
  cairo_set_source_surface(cairo_.get(), image, 0, 0);
  // Enlarged voxels keep their edges; reduced ones are averaged.
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()),
                           scale_px >= 1 ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
  cairo_surface_destroy(image);
}

void Canvas::Clip(double x, double y, double width, double height) {
  cairo_new_path(cairo_.get());
  cairo_rectangle(cairo_.get(), x, y, width, height);
  cairo_clip(cairo_.get());
}

void Canvas::ResetClip() { cairo_reset_clip(cairo_.get()); }

absl::Status Canvas::WritePng(const std::string& file) const {
  const cairo_status_t drawn = cairo_status(cairo_.get());
  const cairo_status_t status =
      drawn != CAIRO_STATUS_SUCCESS
          ? drawn
          : cairo_surface_write_to_png(cairo_get_target(cairo_.get()), file.c_str());
  if (status == CAIRO_STATUS_SUCCESS) return absl::OkStatus();
  return absl::InternalError(
      absl::StrCat("cannot write '", file, "': ", cairo_status_to_string(status)));
}

}  // namespace clearway::report
