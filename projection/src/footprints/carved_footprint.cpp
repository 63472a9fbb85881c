// SPDX-License-Identifier: BSD-3-Clause
#include "carved_footprint.hpp"

#include "mask_outline.hpp"
#include "plan_mask.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Half of the widest gap between points of one surface.
constexpr double kBridgeM = 0.1;
/// Half the width of what is too thin to be kept or left out for what columns say.
constexpr double kSmoothM = 0.05;
/// Parts with a smaller share of the largest one's area are strays.
constexpr double kMinPartShare = 0.05;
/// Where a smaller share of the supported points is agreed on, all of them count.
constexpr double kMinAgreedShare = 0.6;
constexpr double kMaxPixels = 1e6;

/// Pixels of half a cell, of which each second one lies on the middle of a cell, around a
/// rectangle.
struct Raster {
  MaskFrame frame;
  int cols = 0;
  int rows = 0;

  [[nodiscard]] int in_pixels(double length_m) const {
    return std::max(static_cast<int>(std::floor(length_m / frame.edge_m)), 1);
  }
};

/// None beyond kMaxPixels. Pixels stand around the rectangle for `margin_m` and more.
std::optional<Raster> raster_around(const Rect& rect, double cell_m, double margin_m) {
  const double pixel_m = cell_m / 2;
  const Eigen::Vector2d low = ((rect.min.array() - margin_m) / cell_m).floor();
  const Eigen::Vector2d high = ((rect.max.array() + margin_m) / cell_m).ceil();
  const Eigen::Vector2d size = 2.0 * (high - low).array() + 1.0;
  if (!(size.prod() <= kMaxPixels)) return std::nullopt;
  return Raster{
      .frame = {.corner = low * cell_m - Eigen::Vector2d::Constant(pixel_m / 2), .edge_m = pixel_m},
      .cols = static_cast<int>(size.x()),
      .rows = static_cast<int>(size.y())};
}

PlanMask points_mask(const Raster& raster, const std::vector<Eigen::Vector3d>& points) {
  PlanMask mask(raster.cols, raster.rows);
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d place =
        ((point.head<2>() - raster.frame.corner) / raster.frame.edge_m).array().floor();
    const bool is_inside =
        place.x() >= 0.0 && place.y() >= 0.0 && place.x() < raster.cols && place.y() < raster.rows;
    if (is_inside) mask.set(static_cast<int>(place.x()), static_cast<int>(place.y()));
  }
  return mask;
}

/// Where the line of constant y crosses a convex ring; an empty range where it does not.
std::pair<double, double> crossing(const Ring& ring, double y) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return {low, high};
}

/// The pixels whose middle lies in the convex ring.
PlanMask hull_mask(const Raster& raster, const Ring& ring) {
  PlanMask mask(raster.cols, raster.rows);
  for (int row = 0; row < raster.rows; ++row) {
    const auto [low, high] = crossing(ring, raster.frame.centre(0, row).y());
    for (int col = 0; col < raster.cols; ++col) {
      const double x = raster.frame.centre(col, row).x();
      if (low <= x && x <= high) mask.set(col, row);
    }
  }
  return mask;
}

/// What the points cover, before gaps are filled.
PlanMask seen_mask(const Raster& raster, const OccupancyVotes& points, const PlanMask& hull) {
  PlanMask seen = points_mask(raster, points.agreed_points());
  const auto supported = points.supported_points();
  const auto num_agreed = static_cast<double>(points.agreement().num_cells);
  if (num_agreed >= kMinAgreedShare * static_cast<double>(supported.size())) return seen;
  PlanMask more = points_mask(raster, supported);
  more &= hull;
  return seen |= more;
}

/// The pixels of the hull where more of the object can stand.
PlanMask open_mask(const Raster& raster, const ObjectColumns& columns, PlanMask hull) {
  for (int row = 0; row < raster.rows; ++row) {
    for (int col = 0; col < raster.cols; ++col) {
      if (hull.at(col, row) && !columns.can_hold_more(raster.frame.centre(col, row)))
        hull.set(col, row, false);
    }
  }
  return hull;
}

/// What points and columns make together when gaps of twice `bridge` are filled.
MaskParts filled(const Raster& raster,
                 const PlanMask& seen,
                 const PlanMask& open,
                 const PlanMask& hull,
                 int bridge) {
  const int smooth = raster.in_pixels(kSmoothM);
  const PlanMask surface = with_holes_filled(closed(seen, bridge));
  PlanMask all = surface;
  all |= open;
  all = opened(closed(all, smooth), smooth);
  all |= surface;
  all = with_holes_filled(all);
  all &= hull;
  return without_specks(without_corner_contacts(std::move(all)), kMinPartShare);
}

}  // namespace

Result<Polygon> carved_footprint(const OccupancyVotes& points, const ObjectColumns& columns) {
  HYPERMAP_ASSIGN_OR_RETURN(const Polygon hull, points.footprint());
  const Rect rect = bounds(hull);
  const double cell_m = points.state().edge_m;
  for (double bridge_m = kBridgeM; bridge_m <= 4 * kBridgeM; bridge_m *= 2.0) {
    const auto raster = raster_around(rect, cell_m, bridge_m + 2 * cell_m);
    if (!raster) break;
    const PlanMask within = hull_mask(*raster, hull.outer);
    const MaskParts parts = filled(*raster,
                                   seen_mask(*raster, points, within),
                                   open_mask(*raster, columns, within),
                                   within,
                                   raster->in_pixels(bridge_m));
    if (parts.num_parts == 1) return outline_of(parts.mask, raster->frame);
  }
  return hull;
}

}  // namespace hypermap
