// SPDX-License-Identifier: BSD-3-Clause
#include "stack_area.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "number_lists.hpp"
#include "tables.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hypermap::app {
namespace {

constexpr int kMaxCellsAlong = 1'000'000'000;  // far above what a grid may have

/// Cells of a side, at most kMaxCellsAlong; what is less than a millionth of a cell is rounding.
int cells_along(double length_m, double resolution_m) {
  constexpr double kSlack = 1e-6;
  const double cells = std::ceil(length_m / resolution_m - kSlack);
  return static_cast<int>(std::clamp(cells, 0.0, static_cast<double>(kMaxCellsAlong)));
}

}  // namespace

Result<std::optional<std::vector<double>>> parse_area(const std::optional<std::string>& text) {
  if (!text) return std::optional<std::vector<double>>();
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<double> corners, parse_numbers(*text, 4, 4, "--area"));
  if (corners[0] < corners[2] && corners[1] < corners[3]) return std::optional(std::move(corners));
  return fail(ErrorCode::kInvalidArgument,
              "must be X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1, is '" + printable(*text) + "'",
              "--area");
}

Result<GridGeometry> geometry_asked_for(const StackArguments& arguments,
                                        const GridGeometry& whole) {
  GridGeometry geometry = whole;
  geometry.resolution_m = arguments.resolution_m.value_or(whole.resolution_m);
  double width_m = whole.cols * whole.resolution_m;
  double height_m = whole.rows * whole.resolution_m;
  HYPERMAP_ASSIGN_OR_RETURN(const auto corners, parse_area(arguments.area));
  if (corners) {
    geometry.origin = Eigen::Vector2d((*corners)[0], (*corners)[1]);
    geometry.yaw_rad = arguments.yaw_deg * std::numbers::pi / 180.0;
    width_m = (*corners)[2] - (*corners)[0];
    height_m = (*corners)[3] - (*corners)[1];
  }
  geometry.cols = cells_along(width_m, geometry.resolution_m);
  geometry.rows = cells_along(height_m, geometry.resolution_m);
  if (std::max(geometry.cols, geometry.rows) == kMaxCellsAlong) {
    return fail(ErrorCode::kLimit,
                (arguments.area ? "'" + printable(*arguments.area) + "'" : std::string("the map")) +
                    " has more than a billion cells of " + number_text(geometry.resolution_m) +
                    " m a side",
                "--area, --resolution");
  }
  if (geometry.num_cells() > 0) return geometry;
  return fail(ErrorCode::kInvalidArgument,
              "has no cell of " + number_text(geometry.resolution_m) + " m",
              "--area");
}

Result<void> check_overlap(const GridGeometry& asked, const GridGeometry& whole) {
  const Rect there = bounds(whole);
  const Rect part = bounds(asked);
  const bool meets =
      (part.min.array() < there.max.array()).all() && (there.min.array() < part.max.array()).all();
  if (meets) return {};
  return fail(ErrorCode::kNotFound,
              "lies outside: there are cells in " + corners_text(there) + ", the area is " +
                  corners_text(part),
              "--area");
}

Result<std::optional<Rect>> rect_around_area(const StackArguments& arguments) {
  constexpr double kMargin = 10.0;  // in metres: the largest cells
  HYPERMAP_ASSIGN_OR_RETURN(const auto corners, parse_area(arguments.area));
  if (!corners) return std::optional<Rect>();
  const Eigen::Vector2d corner((*corners)[0], (*corners)[1]);
  const Eigen::Vector2d size(Eigen::Vector2d((*corners)[2], (*corners)[3]) - corner);
  const Eigen::Rotation2Dd turn(arguments.yaw_deg * std::numbers::pi / 180.0);
  Rect rect{corner, corner};
  for (const Eigen::Vector2d& share : {Eigen::Vector2d(1, 0), {0, 1}, {1, 1}}) {
    const Eigen::Vector2d point = corner + turn * share.cwiseProduct(size);
    rect.min = rect.min.cwiseMin(point);
    rect.max = rect.max.cwiseMax(point);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin);
  return std::optional(Rect{rect.min - margin, rect.max + margin});
}

std::string corners_text(const Rect& rect) {
  return fixed(rect.min.x(), 3) + "," + fixed(rect.min.y(), 3) + "," + fixed(rect.max.x(), 3) +
         "," + fixed(rect.max.y(), 3);
}

}  // namespace hypermap::app
