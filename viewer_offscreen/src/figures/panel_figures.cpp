// SPDX-License-Identifier: BSD-3-Clause
#include "panel_figures.hpp"

#include "figure_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr int kPanelsWidthPx = 1280;
constexpr int kPlanSidePx = 900;
constexpr int kPlanMarginPx = 30;
constexpr double kPanelShare = 0.55;
constexpr double kFarDepthM = 5.0;  ///< Black in a backdrop made of depth.

std::string metres(double value_m, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value_m);
  return text.data();
}

/// The distances that the colours' ends stand for.
struct DistanceScale {
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = 0.0;

  [[nodiscard]] Rgb8 color(double distance_m) const {
    const double range_m = std::max(farthest_m - nearest_m, 1e-6);
    return distance_color((distance_m - nearest_m) / range_m);
  }
  [[nodiscard]] bool is_empty() const { return nearest_m > farthest_m; }
};

DistanceScale scale_of(const BinnedDepthMap& panels) {
  DistanceScale scale;
  for (const DepthPanel& panel : panels.panels()) {
    if (panel.num_points == 0) continue;
    scale.nearest_m = std::min(scale.nearest_m, panel.nearest_m);
    scale.farthest_m = std::max(scale.farthest_m, panel.nearest_m);
  }
  return scale;
}

std::string panels_caption(const BinnedDepthMap& panels, const DistanceScale& scale) {
  std::string text =
      std::to_string(panels.columns()) + " x " + std::to_string(panels.rows()) + " panels";
  if (scale.is_empty()) return text + ", all empty";
  return text + " by their nearest point: " + metres(scale.nearest_m, 2) + " m yellow, " +
         metres(scale.farthest_m, 2) + " m violet";
}

/// So that the panels' colours are the only ones.
ColorImage grey(ColorImage backdrop) {
  for (Rgb8& pixel : backdrop.pixels()) {
    const auto level = static_cast<std::uint8_t>((3 * pixel.r + 6 * pixel.g + pixel.b) / 10);
    pixel = {level, level, level};
  }
  return backdrop;
}

/// The pixels of a panel's column or row: [begin, end).
int panel_edge(int index, int count, int pixels) {
  return static_cast<int>(static_cast<std::int64_t>(index) * pixels / count);
}

void fill(ColorImage& figure,
          const Eigen::Vector2d& low,
          const Eigen::Vector2d& high,
          Rgb8 color,
          double share) {
  draw_plate(figure, {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()}, 0.0, color, share);
}

/// "1.24" over "3.80"; in narrow panels the nearest alone, with one digit.
void write_distances(ColorImage& figure,
                     const DepthPanel& panel,
                     const Eigen::Vector2d& low,
                     const Eigen::Vector2d& high,
                     const TextPainter& painter) {
  const TextStyle style{.height_px = 13, .color = kFigurePaper};
  const double room_px = high.x() - low.x() - 4.0;
  const auto write = [&](double value_m, double baseline_px) {
    std::string text = metres(value_m, 2);
    if (painter.width_px(text, style) > room_px) text = metres(value_m, 1);
    if (painter.width_px(text, style) > room_px) return;
    const double x_px = 0.5 * (low.x() + high.x() - painter.width_px(text, style));
    painter.write(figure, text, x_px + 1.0, baseline_px + 1.0, {.height_px = 13, .color = {}});
    painter.write(figure, text, x_px, baseline_px, style);
  };
  const double middle_px = 0.5 * (low.y() + high.y());
  if (high.y() - low.y() < 36.0) return write(panel.nearest_m, middle_px + 5.0);
  write(panel.nearest_m, middle_px - 4.0);
  write(panel.farthest_m, middle_px + 14.0);
}

/// Metres of the map's plane to pixels of the figure, x to the right and y upward.
struct PlanView {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  double px_per_m = 1.0;

  [[nodiscard]] Eigen::Vector2d to_figure(const Eigen::Vector2d& point) const {
    return {kPlanMarginPx + px_per_m * (point.x() - low.x()),
            kPlanMarginPx + px_per_m * (high.y() - point.y())};
  }
};

PlanView plan_of(const BinnedDepthMap& panels) {
  PlanView view;
  view.low = view.high = panels.camera_centre().xyz.head<2>();
  for (const DepthPanel& panel : panels.panels()) {
    if (panel.num_points == 0) continue;
    view.low = view.low.cwiseMin(panel.box.min_in_map.head<2>());
    view.high = view.high.cwiseMax(panel.box.max_in_map.head<2>());
  }
  const double side_m = std::max((view.high - view.low).maxCoeff(), 0.1);
  view.px_per_m = (kPlanSidePx - 2.0 * kPlanMarginPx) / side_m;
  return view;
}

/// The farthest first, so that nothing near is hidden.
std::vector<const DepthPanel*> far_to_near(const BinnedDepthMap& panels) {
  std::vector<const DepthPanel*> sorted;
  for (const DepthPanel& panel : panels.panels()) {
    if (panel.num_points > 0) sorted.push_back(&panel);
  }
  std::ranges::stable_sort(sorted, std::greater(), &DepthPanel::nearest_m);
  return sorted;
}

void draw_metre_bar(ColorImage& figure, const TextPainter& painter, double px_per_m) {
  const double y_px = figure.height_px() - 12.0;
  draw_line(figure, {kPlanMarginPx, y_px}, {kPlanMarginPx + px_per_m, y_px}, 3.0, kFigureInk);
  painter.write(figure, "1 m", kPlanMarginPx + px_per_m + 6.0, y_px + 5.0, {});
}

}  // namespace

ColorImage backdrop_of(const RgbdFrame& frame) {
  if (!frame.color.empty()) return frame.color;
  ColorImage backdrop(frame.camera.width_px, frame.camera.height_px);
  for (std::size_t i = 0; i < backdrop.size(); ++i) {
    const float depth_m = frame.depth_m.pixels()[i];
    if (!(depth_m > 0.0F) || !std::isfinite(depth_m)) continue;
    const double share = std::clamp(static_cast<double>(depth_m) / kFarDepthM, 0.0, 1.0);
    backdrop.pixels()[i] = mixed({235, 235, 235}, {25, 25, 25}, share);
  }
  return backdrop;
}

ColorImage draw_panels(const ColorImage& backdrop,
                       const BinnedDepthMap& panels,
                       const TextPainter& painter) {
  const Enlargement part = whole_image(backdrop, kPanelsWidthPx);
  ColorImage figure = enlarged(grey(backdrop), part);
  const DistanceScale scale = scale_of(panels);
  for (int row = 0; row < panels.rows(); ++row) {
    for (int column = 0; column < panels.columns(); ++column) {
      const DepthPanel& panel = panels.at(column, row);
      const Eigen::Vector2d low =
          part.to_figure(panel_edge(column, panels.columns(), backdrop.width_px()),
                         panel_edge(row, panels.rows(), backdrop.height_px()));
      const Eigen::Vector2d high =
          part.to_figure(panel_edge(column + 1, panels.columns(), backdrop.width_px()),
                         panel_edge(row + 1, panels.rows(), backdrop.height_px()));
      const bool is_empty = panel.num_points == 0;
      fill(figure, low, high, is_empty ? Rgb8{} : scale.color(panel.nearest_m), kPanelShare);
      draw_outline(figure, low, high, 1.0, kFigureInk);
      if (!is_empty) write_distances(figure, panel, low, high, painter);
    }
  }
  return with_caption(
      figure, painter, {panels_caption(panels, scale) + "; nearest over farthest, metres"});
}

ColorImage draw_panels_from_above(const BinnedDepthMap& panels, const TextPainter& painter) {
  const PlanView view = plan_of(panels);
  const Eigen::Vector2d size = view.px_per_m * (view.high - view.low);
  ColorImage figure(static_cast<int>(size.x()) + 2 * kPlanMarginPx + 1,
                    static_cast<int>(size.y()) + 2 * kPlanMarginPx + 1,
                    kFigurePaper);
  const DistanceScale scale = scale_of(panels);
  const Eigen::Vector2d camera = view.to_figure(panels.camera_centre().xyz.head<2>());
  for (const DepthPanel* panel : far_to_near(panels)) {
    const Rgb8 color = scale.color(panel->nearest_m);
    const Eigen::Vector2d upper_left =
        view.to_figure({panel->box.min_in_map.x(), panel->box.max_in_map.y()});
    const Eigen::Vector2d lower_right =
        view.to_figure({panel->box.max_in_map.x(), panel->box.min_in_map.y()});
    fill(figure, upper_left, lower_right, color, 0.15);
    draw_outline(figure, upper_left, lower_right, 1.0, color);
  }
  draw_disc(figure, camera, 6.0, kFigureInk);
  draw_metre_bar(figure, painter, view.px_per_m);
  return with_caption(figure, painter, {panels_caption(panels, scale), "from above; dot: camera"});
}

}  // namespace hypermap
