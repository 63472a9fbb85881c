// SPDX-License-Identifier: BSD-3-Clause
#include "page_filling.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kNumSizes = 10;          // tried from the largest down
constexpr double kClearancePx = 14.0;  // between the scene and what is written, at the plan's scale
constexpr double kThinPx = 4.0;        // of points that fall so near each other one stands for all

// Of the free room before the scene, nearest to the middle of the page first.
constexpr std::array<double, 7> kPlacesAcross{0.5, 0.375, 0.625, 0.25, 0.75, 0.0, 1.0};
constexpr std::array<double, 5> kPlacesAlong{0.5, 0.75, 0.25, 1.0, 0.0};

bool covers(const ImageRect& rect, const PixelPoint& point, double margin_px) {
  return rect.width_px > 0.0 && point.u_px > rect.x_px - margin_px &&
         point.v_px > rect.y_px - margin_px && point.u_px < rect.x_px + rect.width_px + margin_px &&
         point.v_px < rect.y_px + rect.height_px + margin_px;
}

/// No drawn point lies under what is written.
bool is_clear(const SnapshotCamera& camera,
              const PagePlan& plan,
              std::span<const Eigen::Vector3d> drawn) {
  const double margin_px = kClearancePx * plan.scale;
  return std::none_of(drawn.begin(), drawn.end(), [&](const Eigen::Vector3d& point) {
    const auto pixel = camera.project(point);
    return pixel &&
           (covers(plan.title, *pixel, margin_px) || covers(plan.legend, *pixel, margin_px) ||
            covers(plan.foot, *pixel, margin_px));
  });
}

/// Points that differ in the image of this camera.
std::vector<Eigen::Vector3d> thinned(std::span<const Eigen::Vector3d> points,
                                     const SnapshotCamera& camera) {
  std::set<std::pair<int, int>> seen;
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& point : points) {
    const auto pixel = camera.project(point);
    if (!pixel) continue;
    const std::pair cell(static_cast<int>(std::floor(pixel->u_px / kThinPx)),
                         static_cast<int>(std::floor(pixel->v_px / kThinPx)));
    if (seen.insert(cell).second) kept.push_back(point);
  }
  return kept;
}

/// Width and height of the points in the image.
Eigen::Vector2d size_px(std::span<const Eigen::Vector3d> points, const SnapshotCamera& camera) {
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector3d& point : points) {
    const auto pixel = camera.project(point);
    if (pixel) seen.extend(Eigen::Vector2d(pixel->u_px, pixel->v_px));
  }
  return seen.isEmpty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d(seen.sizes());
}

}  // namespace

SnapshotCamera fill_page(const SnapshotOptions& options,
                         const PagePlan& plan,
                         std::span<const Eigen::Vector3d> framed,
                         std::span<const Eigen::Vector3d> drawn) {
  SnapshotCamera least = SnapshotCamera::frame(options, framed, plan.content);
  const double margin = plan.content.x_px;
  const Eigen::Vector2d page(plan.canvas.width_px - 2.0 * margin,
                             plan.canvas.height_px - 2.0 * margin);
  if (!least.pixels_per_m() || framed.empty() || page.minCoeff() <= 0.0) return least;
  const SnapshotCamera most =
      SnapshotCamera::frame(options, framed, {margin, margin, page.x(), page.y()});
  const Eigen::Vector2d largest = size_px(framed, most);
  const std::vector<Eigen::Vector3d> points = thinned(drawn, most);
  const double smallest_share = *least.pixels_per_m() / *most.pixels_per_m();
  for (int i = 0; i < kNumSizes; ++i) {
    const double share = 1.0 - (1.0 - smallest_share) * i / kNumSizes;
    const Eigen::Vector2d size = share * largest;
    const Eigen::Vector2d room = (page - size).cwiseMax(0.0);
    for (const double along : kPlacesAlong) {
      for (const double across : kPlacesAcross) {
        SnapshotCamera camera = SnapshotCamera::frame(
            options,
            framed,
            {margin + across * room.x(), margin + along * room.y(), size.x(), size.y()});
        if (is_clear(camera, plan, points)) return camera;
      }
    }
  }
  return least;
}

}  // namespace hypermap
