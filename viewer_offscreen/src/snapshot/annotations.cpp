// SPDX-License-Identifier: BSD-3-Clause
#include "annotations.hpp"

#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"
#include "page_style.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace hypermap {
namespace {

constexpr Rgb8 kPlate{255, 255, 255};
constexpr Rgb8 kRim{198, 204, 212};  ///< Around swatches: a white one must be seen on white.
constexpr double kPlateOpacity = 0.84;
constexpr double kLabelPx = 20.0;
constexpr double kLabelGapPx = 3.0;

/// For thin lines: pale ones would be lost on pale walls.
Rgb8 darkened(Rgb8 color) {
  const auto scaled = [](std::uint8_t channel) {
    return static_cast<std::uint8_t>(channel * 13 / 20);
  };
  return {scaled(color.r), scaled(color.g), scaled(color.b)};
}

/// Paints one page; holds what every part of it needs.
class Page {
 public:
  Page(ColorImage& image, const TextPainter& text, const PagePlan& plan)
      : image_(&image), text_(&text), plan_(&plan), look_{plan.scale} {}

  void paint_title(const Annotations& annotations) {
    const double x = plan_->title.x_px;
    const double room = plan_->title.width_px;
    paint_title_plate();
    write(text_->fitted(annotations.title, look_.title(), room),
          x,
          plan_->title.y_px + look_.px(22.0),
          look_.title());
    write(text_->fitted(annotations.subtitle, look_.small(), room),
          x,
          plan_->title.y_px + look_.px(43.0),
          look_.small());
    double y = plan_->title.y_px + look_.px(43.0);
    for (const std::string& note : annotations.notes) {
      y += look_.px(kNotePx);
      write(text_->fitted(note, look_.small(), room), x, y, look_.small());
    }
  }

  void paint_legend(const Legend& legend) {
    if (legend.rows.empty()) return;
    const LegendColumns columns = measure(*text_, legend, look_);
    const ImageRect& rect = plan_->legend;
    draw_plate(*image_, rect, look_.px(6.0), kPlate, kPlateOpacity);
    double y = rect.y_px + look_.px(22.0);
    if (!legend.columns.empty()) {
      paint_numbers(legend.columns, columns, y - look_.px(2.0), look_.heading());
      y += look_.px(kRowPx);
    }
    for (std::size_t i = 0; i < plan_->num_legend_rows; ++i, y += look_.px(kRowPx)) {
      paint_row(legend.rows[i], columns, y);
    }
    const std::size_t hidden = legend.rows.size() - plan_->num_legend_rows;
    if (hidden == 0) return;
    write("and " + std::to_string(hidden) + " more", name_x(), y, look_.small());
  }

  void paint_scale_bar(double pixels_per_m) {
    const double length_m = round_length_m(look_.px(kScaleBarPx) / pixels_per_m);
    const double length_px = length_m * pixels_per_m;
    const double x = plan_->foot.x_px;
    const double y = plan_->foot.y_px + plan_->foot.height_px - look_.px(8.0);
    const double tick = look_.px(5.0);
    const double width = look_.px(2.0);
    draw_line(*image_, {x, y}, {x + length_px, y}, width, kInk);
    draw_line(*image_, {x, y - tick}, {x, y + tick}, width, kInk);
    draw_line(*image_, {x + length_px, y - tick}, {x + length_px, y + tick}, width, kInk);
    write(length_text(length_m), x + look_.px(6.0), y - look_.px(8.0), look_.label());
  }

  /// The map's axes as they lie in the image, beside the scale bar's right end.
  void paint_axes(const SnapshotCamera& camera, double centre_x_px) {
    struct Axis {
      Eigen::Vector3d direction;
      const char* name;
      Rgb8 color;
    };
    const std::array<Axis, 3> axes{{{Eigen::Vector3d::UnitX(), "x", {203, 52, 48}},
                                    {Eigen::Vector3d::UnitY(), "y", {40, 138, 62}},
                                    {Eigen::Vector3d::UnitZ(), "z", {38, 96, 196}}}};
    const Eigen::Vector2d origin(centre_x_px,
                                 plan_->foot.y_px + plan_->foot.height_px - look_.px(18.0));
    for (const Axis& axis : axes) {
      const Eigen::Vector2d along(axis.direction.dot(camera.right_in_map()),
                                  -axis.direction.dot(camera.up_in_map()));
      if (along.norm() < 0.15) continue;  // towards the eye
      draw_line(*image_, origin, origin + look_.px(30.0) * along, look_.px(2.4), axis.color);
      const Eigen::Vector2d at =
          origin + look_.px(30.0) * along + look_.px(9.0) * along.normalized();
      TextStyle style = look_.label();
      style.color = axis.color;
      style.weight = FontWeight::kBold;
      write(axis.name, at.x() - look_.px(4.0), at.y() + look_.px(4.5), style);
    }
    draw_disc(*image_, origin, look_.px(2.6), kInk);
  }

  void paint_labels(std::span<const MapLabel> labels, const SnapshotCamera& camera) {
    const std::vector<MapLabel> seen = in_front(labels, camera);
    std::vector<LabelRequest> requests;
    requests.reserve(seen.size());
    for (const MapLabel& label : seen) requests.push_back(request_for(label, camera));
    std::vector<ImageRect> obstacles{plan_->title, plan_->legend, plan_->foot};
    for (const LabelRequest& request : requests) {  // no label on the point that another speaks of
      obstacles.push_back({request.anchor_x_px - 3.0, request.anchor_y_px, 6.0, 4.0});
    }
    const auto placed = place_labels(requests,
                                     plan_->canvas,
                                     obstacles,
                                     {.gap_px = look_.px(kLabelGapPx),
                                      .max_distance_px = look_.px(150.0),
                                      .leader_from_px = look_.px(9.0)});
    for (std::size_t i = 0; i < placed.size(); ++i) paint_leader(requests[i], placed[i], seen[i]);
    for (std::size_t i = 0; i < placed.size(); ++i) paint_label(placed[i], seen[i]);
  }

 private:
  /// Where the scene fills the page the title stands on a plate of its own.
  void paint_title_plate() {
    if (!plan_->scene_fills_page) return;
    const double margin = look_.px(10.0);
    draw_plate(*image_,
               {plan_->title.x_px - margin,
                plan_->title.y_px - look_.px(4.0),
                plan_->title.width_px + 2.0 * margin,
                plan_->title.height_px + look_.px(8.0)},
               look_.px(6.0),
               kPlate,
               kPlateOpacity);
  }

  void write(const std::string& text, double x_px, double baseline_px, const TextStyle& style) {
    text_->write(*image_, text, x_px, baseline_px, style);
  }

  [[nodiscard]] double name_x() const {
    return plan_->legend.x_px + look_.px(12.0 + kSwatchPx + 8.0);
  }

  void paint_numbers(const std::vector<std::string>& numbers,
                     const LegendColumns& columns,
                     double baseline_px,
                     const TextStyle& style) {
    double right = name_x() + columns.name_px;
    for (std::size_t i = 0; i < std::min(numbers.size(), columns.number_px.size()); ++i) {
      right += look_.px(kColumnGapPx) + columns.number_px[i];
      write(numbers[i], right - text_->width_px(numbers[i], style), baseline_px, style);
    }
  }

  void paint_row(const LegendRow& row, const LegendColumns& columns, double baseline_px) {
    const ImageRect swatch{plan_->legend.x_px + look_.px(12.0),
                           baseline_px - look_.px(kSwatchPx - 1.5),
                           look_.px(kSwatchPx),
                           look_.px(kSwatchPx)};
    const ImageRect rim{
        swatch.x_px - 1.0, swatch.y_px - 1.0, swatch.width_px + 2.0, swatch.height_px + 2.0};
    draw_plate(*image_, rim, look_.px(3.0), kRim, 1.0);
    draw_plate(*image_, swatch, look_.px(2.5), row.color, 1.0);
    write(text_->fitted(row.name, look_.row(), columns.name_px + 1.0),
          name_x(),
          baseline_px,
          look_.row());
    TextStyle faint = look_.row();
    faint.color = kFaintInk;
    paint_numbers(row.numbers, columns, baseline_px, faint);
  }

  [[nodiscard]] static std::vector<MapLabel> in_front(std::span<const MapLabel> labels,
                                                      const SnapshotCamera& camera) {
    std::vector<MapLabel> seen;
    for (const MapLabel& label : labels) {
      if (!label.text.empty() && camera.project(label.upper_in_map)) seen.push_back(label);
    }
    return seen;
  }

  /// Around those corners of the box that are before the eye.
  [[nodiscard]] static ImageRect seen_rect(const Box& box, const SnapshotCamera& camera) {
    Eigen::AlignedBox2d seen;
    for (const Eigen::Vector3d& corner : box.corners()) {
      const auto pixel = camera.project(corner);
      if (pixel) seen.extend(Eigen::Vector2d(pixel->u_px, pixel->v_px));
    }
    if (seen.isEmpty()) return {};
    return {seen.min().x(), seen.min().y(), seen.sizes().x(), seen.sizes().y()};
  }

  [[nodiscard]] LabelRequest request_for(const MapLabel& label,
                                         const SnapshotCamera& camera) const {
    const double height = look_.px(kLabelPx);
    const double width = text_->width_px(label.text, look_.label()) + look_.px(15.0);
    const ImageRect subject = seen_rect(label.box, camera);
    if (subject.width_px < 1.6 * width || subject.height_px < 3.0 * height) {
      return {subject.x_px + 0.5 * subject.width_px, subject.y_px, width, height, subject};
    }
    PixelPoint anchor = camera.project(label.upper_in_map).value_or(PixelPoint{});
    const auto middle = camera.project(label.middle_in_map);
    if (middle && middle->v_px - anchor.v_px > 0.6 * height) {
      anchor = {middle->u_px, middle->v_px + 0.5 * height + look_.px(kLabelGapPx)};
    }
    return {anchor.u_px, anchor.v_px, width, height};
  }

  void paint_leader(const LabelRequest& request, const PlacedLabel& placed, const MapLabel& label) {
    if (!placed.shown || !placed.leader) return;
    const ImageRect& rect = placed.rect;
    const Eigen::Vector2d anchor(request.anchor_x_px, request.anchor_y_px);
    const Eigen::Vector2d nearest(
        std::clamp(anchor.x(), rect.x_px + 3.0, rect.x_px + rect.width_px - 3.0),
        std::clamp(anchor.y(), rect.y_px + 3.0, rect.y_px + rect.height_px - 3.0));
    const Rgb8 color = darkened(label.color);
    draw_line(*image_, anchor, nearest, look_.px(1.3), color);
    draw_disc(*image_, anchor, look_.px(2.4), color);
  }

  void paint_label(const PlacedLabel& placed, const MapLabel& label) {
    if (!placed.shown) return;
    const ImageRect& rect = placed.rect;
    draw_plate(*image_, rect, look_.px(4.0), label.color, 1.0);
    const ImageRect inner{rect.x_px + look_.px(4.5),
                          rect.y_px + look_.px(1.0),
                          rect.width_px - look_.px(5.5),
                          rect.height_px - look_.px(2.0)};
    draw_plate(*image_, inner, look_.px(3.0), kPlate, 0.94);
    write(label.text,
          rect.x_px + look_.px(9.5),
          rect.y_px + rect.height_px - look_.px(5.5),
          look_.label());
  }

  ColorImage* image_;
  const TextPainter* text_;
  const PagePlan* plan_;
  Look look_;
};

}  // namespace

ColorImage annotated(ColorImage image,
                     const TextPainter& text,
                     const Annotations& annotations,
                     const PagePlan& plan,
                     const SnapshotCamera& camera) {
  Page page(image, text, plan);
  page.paint_labels(annotations.labels, camera);
  page.paint_title(annotations);
  page.paint_legend(annotations.legend);
  const Look look{plan.scale};
  double axes_x = plan.foot.x_px + look.px(30.0);
  if (camera.pixels_per_m()) {
    page.paint_scale_bar(*camera.pixels_per_m());
    axes_x += look.px(kScaleBarPx + 25.0);
  }
  page.paint_axes(camera, axes_x);
  return image;
}

}  // namespace hypermap
