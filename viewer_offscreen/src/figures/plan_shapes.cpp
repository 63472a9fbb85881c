// SPDX-License-Identifier: BSD-3-Clause
#include "plan_shapes.hpp"

#include "annotation/text_painter.hpp"
#include "figure_page.hpp"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

constexpr int kPlanShift = 4;  // sixteenths of a pixel
constexpr double kDashPx = 7.0;

/// The part of the image around all points.
cv::Rect part_around(const ColorImage& image, const PixelShape& shape) {
  Eigen::AlignedBox2d box;
  for (const auto& ring : shape)
    for (const Eigen::Vector2d& point : ring) box.extend(point);
  if (box.isEmpty()) return {};
  const Eigen::Vector2i low = (box.min().array() - 2.0).floor().cast<int>();
  const Eigen::Vector2i high = (box.max().array() + 3.0).ceil().cast<int>();
  const cv::Rect around(cv::Point(low.x(), low.y()), cv::Point(high.x(), high.y()));
  return around & cv::Rect(0, 0, image.width_px(), image.height_px());
}

cv::Point sixteenths(const Eigen::Vector2d& point) {
  return {static_cast<int>(std::lround(16.0 * point.x())),
          static_cast<int>(std::lround(16.0 * point.y()))};
}

/// Every second piece of a way; `travelled_px` is what of it lies before.
double draw_dashes(ColorImage& image,
                   const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to,
                   double width_px,
                   Rgb8 color,
                   double travelled_px) {
  const double length = (to - from).norm();
  const Eigen::Vector2d along = length > 0.0 ? Eigen::Vector2d((to - from) / length)
                                             : Eigen::Vector2d(Eigen::Vector2d::Zero());
  double at = 0.0;
  while (at < length) {
    const double dash = std::floor((travelled_px + at) / kDashPx);
    const double end = std::min(length, std::max((dash + 1.0) * kDashPx - travelled_px, at + 0.1));
    const bool is_drawn = std::fmod(dash, 2.0) == 0.0;
    if (is_drawn) draw_line(image, from + at * along, from + end * along, width_px, color);
    at = end;
  }
  return travelled_px + length;
}

}  // namespace

void fill_shape(ColorImage& image, const PixelShape& shape, Rgb8 color, double opacity) {
  const cv::Rect part = part_around(image, shape);
  if (part.area() == 0) return;
  const Eigen::Vector2d corner(part.x, part.y);
  std::vector<std::vector<cv::Point>> rings;
  rings.reserve(shape.size());
  for (const auto& ring : shape) {
    std::vector<cv::Point>& points = rings.emplace_back();
    for (const Eigen::Vector2d& point : ring) points.push_back(sixteenths(point - corner));
  }
  cv::Mat mask = cv::Mat::zeros(part.height, part.width, CV_8UC1);
  cv::fillPoly(mask, rings, cv::Scalar(255), cv::LINE_AA, kPlanShift);
  for (int v = 0; v < part.height; ++v) {
    for (int u = 0; u < part.width; ++u) {
      const double cover = opacity * mask.at<std::uint8_t>(v, u) / 255.0;
      if (cover <= 0.0) continue;
      Rgb8& pixel = image.at(part.x + u, part.y + v);
      pixel = mixed(pixel, color, cover);
    }
  }
}

void stroke_shape(
    ColorImage& image, const PixelShape& shape, double width_px, Rgb8 color, StrokeStyle style) {
  for (const auto& ring : shape) {
    double travelled_px = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& from = ring[i];
      const Eigen::Vector2d& to = ring[(i + 1) % ring.size()];
      if (style == StrokeStyle::kSolid) {
        draw_line(image, from, to, width_px, color);
      } else {
        travelled_px = draw_dashes(image, from, to, width_px, color, travelled_px);
      }
    }
  }
}

}  // namespace hypermap
