// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/box_plot.hpp"

#include "figure_page.hpp"
#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace hypermap {
namespace {

constexpr int kPlotWidthPx = 900;
constexpr int kNamesPx = 150;
constexpr int kValuesPx = 90;
constexpr int kTopPx = 44;
constexpr int kPlotRowPx = 38;
constexpr int kBottomPx = 54;
constexpr double kHalfBoxPx = 11.0;
constexpr Rgb8 kBoxFill{165, 200, 225};
constexpr Rgb8 kBoxEdge{31, 90, 140};
constexpr Rgb8 kMedian{220, 90, 10};
constexpr Rgb8 kDecade{205, 205, 205};

/// The powers of ten between which all values lie.
struct LogAxis {
  int low = -1;
  int high = 0;

  /// In the plot, from 0 on the left to 1.
  [[nodiscard]] double share(double value) const {
    if (value <= 0.0) return 0.0;
    return std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0);
  }
  [[nodiscard]] double x_px(double value) const {
    return kNamesPx + share(value) * (kPlotWidthPx - kNamesPx - kValuesPx);
  }
};

LogAxis axis_of(std::span<const BoxPlotRow> rows) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const BoxPlotRow& row : rows) {
    const FiveNumbers& n = row.numbers;
    for (const double value : {n.min, n.lower, n.median, n.upper, n.max}) {
      if (value > 0.0) least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (most <= 0.0) return {};
  LogAxis axis{static_cast<int>(std::floor(std::log10(least))),
               static_cast<int>(std::ceil(std::log10(most)))};
  if (axis.high == axis.low) ++axis.high;
  return axis;
}

/// Three digits.
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

void draw_decades(ColorImage& plot, const LogAxis& axis, const TextPainter& painter) {
  const double bottom_px = plot.height_px() - kBottomPx;
  const TextStyle style{.height_px = 14, .color = kFigureInk};
  for (int power = axis.low; power <= axis.high; ++power) {
    const double value = std::pow(10.0, power);
    const double x_px = axis.x_px(value);
    draw_line(plot, {x_px, kTopPx - 6.0}, {x_px, bottom_px}, 1.0, kDecade);
    const std::string text = number_text(value);
    painter.write(plot, text, x_px - 0.5 * painter.width_px(text, style), bottom_px + 18.0, style);
  }
}

void draw_row(ColorImage& plot,
              const BoxPlotRow& row,
              double middle_px,
              const LogAxis& axis,
              const TextPainter& painter) {
  const FiveNumbers& n = row.numbers;
  const auto whisker = [&](double from, double to) {
    draw_line(plot, {axis.x_px(from), middle_px}, {axis.x_px(to), middle_px}, 2.0, kBoxEdge);
    const double x_px = axis.x_px(from);
    draw_line(plot, {x_px, middle_px - 6.0}, {x_px, middle_px + 6.0}, 2.0, kBoxEdge);
  };
  whisker(n.min, n.lower);
  whisker(n.max, n.upper);
  const Eigen::Vector2d low(axis.x_px(n.lower), middle_px - kHalfBoxPx);
  const Eigen::Vector2d high(axis.x_px(n.upper), middle_px + kHalfBoxPx);
  draw_plate(plot, {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()}, 0.0, kBoxFill, 1.0);
  draw_outline(plot, low, high, 1.5, kBoxEdge);
  const double median_px = axis.x_px(n.median);
  draw_line(plot, {median_px, low.y()}, {median_px, high.y()}, 3.0, kMedian);
  const TextStyle style{.height_px = 15, .color = kFigureInk};
  const std::string name = painter.fitted(row.name, style, kNamesPx - 20.0);
  painter.write(plot, name, 10.0, middle_px + 5.0, style);
  painter.write(plot,
                short_number(n.median),
                kPlotWidthPx - kValuesPx + 14.0,
                middle_px + 5.0,
                {.height_px = 15, .color = kMedian});
}

}  // namespace

Result<ColorImage> draw_box_plot(const std::string& title,
                                 const std::string& axis,
                                 std::span<const BoxPlotRow> rows,
                                 const std::filesystem::path& font_file) {
  HYPERMAP_ASSIGN_OR_RETURN(const TextPainter painter, TextPainter::create(font_file));
  ColorImage plot(
      kPlotWidthPx, kTopPx + kPlotRowPx * static_cast<int>(rows.size()) + kBottomPx, kFigurePaper);
  const LogAxis scale = axis_of(rows);
  painter.write(plot,
                painter.fitted(title, {.height_px = 18}, kPlotWidthPx - 20.0),
                10.0,
                26.0,
                {.height_px = 18, .color = kFigureInk, .weight = FontWeight::kBold});
  draw_decades(plot, scale, painter);
  double middle_px = kTopPx + 0.5 * kPlotRowPx;
  for (const BoxPlotRow& row : rows) {
    draw_row(plot, row, middle_px, scale, painter);
    middle_px += kPlotRowPx;
  }
  const std::string words = axis + "; boxes: quartiles, whiskers: extremes, orange: median";
  painter.write(plot, words, kNamesPx, plot.height_px() - 12.0, {.height_px = 14});
  return plot;
}

}  // namespace hypermap
