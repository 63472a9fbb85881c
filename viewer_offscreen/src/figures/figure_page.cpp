// SPDX-License-Identifier: BSD-3-Clause
#include "figure_page.hpp"

#include "hypermap/viewer_offscreen/annotation/label_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hypermap {
namespace {

constexpr int kLineHeightPx = 22;
constexpr int kCaptionMarginPx = 8;

std::uint8_t mixed_channel(std::uint8_t under, std::uint8_t over, double share) {
  return static_cast<std::uint8_t>(std::lround(under + share * (over - under)));
}

}  // namespace

Enlargement whole_image(const ColorImage& image, int width_px) {
  return {.width_px = image.width_px(),
          .height_px = image.height_px(),
          .scale = std::max(1, (width_px + image.width_px() / 2) / image.width_px())};
}

ColorImage enlarged(const ColorImage& image, const Enlargement& part) {
  ColorImage figure(part.scale * part.width_px, part.scale * part.height_px);
  for (int v = 0; v < figure.height_px(); ++v) {
    for (int u = 0; u < figure.width_px(); ++u) {
      figure.at(u, v) = image.at(part.u_begin + u / part.scale, part.v_begin + v / part.scale);
    }
  }
  return figure;
}

Rgb8 mixed(Rgb8 under, Rgb8 over, double share) {
  return {mixed_channel(under.r, over.r, share),
          mixed_channel(under.g, over.g, share),
          mixed_channel(under.b, over.b, share)};
}

Rgb8 distance_color(double share) {
  constexpr std::array<Rgb8, 5> kStops{
      {{253, 224, 60}, {110, 200, 90}, {40, 150, 150}, {50, 90, 160}, {75, 25, 110}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return mixed(kStops.at(below), kStops.at(below + 1), at - static_cast<double>(below));
}

void draw_outline(ColorImage& image,
                  const Eigen::Vector2d& low,
                  const Eigen::Vector2d& high,
                  double width_px,
                  Rgb8 color) {
  const Eigen::Vector2d right(high.x(), low.y());
  const Eigen::Vector2d below(low.x(), high.y());
  draw_line(image, low, right, width_px, color);
  draw_line(image, right, high, width_px, color);
  draw_line(image, high, below, width_px, color);
  draw_line(image, below, low, width_px, color);
}

ImageRect write_on_plate(ColorImage& image,
                         const TextPainter& painter,
                         const std::string& text,
                         Eigen::Vector2d corner,
                         const TextStyle& style,
                         Rgb8 background,
                         std::span<const ImageRect> taken) {
  ImageRect plate{.width_px = painter.width_px(text, style) + 6.0,
                  .height_px = 1.4 * style.height_px};
  plate.x_px = std::clamp(corner.x(), 0.0, std::max(image.width_px() - plate.width_px, 0.0));
  plate.y_px = std::clamp(corner.y(), 0.0, std::max(image.height_px() - plate.height_px, 0.0));
  const auto is_taken = [&](const ImageRect& other) { return overlap(plate, other); };
  while (plate.y_px + 2.0 * plate.height_px < image.height_px() &&
         std::ranges::any_of(taken, is_taken)) {
    plate.y_px += plate.height_px;
  }
  draw_plate(image, plate, 0.0, background, 1.0);
  painter.write(image, text, plate.x_px + 3.0, plate.y_px + 1.05 * style.height_px, style);
  return plate;
}

ColorImage with_caption(const ColorImage& image,
                        const TextPainter& painter,
                        const std::vector<std::string>& lines) {
  const int strip_px = 2 * kCaptionMarginPx + kLineHeightPx * static_cast<int>(lines.size());
  ColorImage page(image.width_px(), image.height_px() + strip_px, kFigurePaper);
  std::ranges::copy(image.pixels(), page.pixels().begin());
  double baseline_px = image.height_px() + kCaptionMarginPx + 0.75 * kLineHeightPx;
  const TextStyle style{.height_px = 15, .color = kFigureInk};
  for (const std::string& line : lines) {
    const double room_px = page.width_px() - 2.0 * kCaptionMarginPx;
    painter.write(page, painter.fitted(line, style, room_px), kCaptionMarginPx, baseline_px, style);
    baseline_px += kLineHeightPx;
  }
  return page;
}

}  // namespace hypermap
