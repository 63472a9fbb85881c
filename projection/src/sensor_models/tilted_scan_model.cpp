// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/tilted_scan_model.hpp"

#include "cell_lattice.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"

#include <cmath>
#include <optional>

namespace hypermap {
namespace {

constexpr OptionRow kTiltedScanRows[] = {
    option::section<&TiltedScanOptions::evidence>("evidence"),
    option::section<&TiltedScanOptions::heights>("heights"),
    option::number<&TiltedScanOptions::min_range_m>(
        "min_range_m", {.max = 100.0}, {.unit = "m", .effect = "Nearer readings are none."}),
    option::number<&TiltedScanOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 1000.0),
        {.unit = "m", .effect = "Readings of this or more met nothing."}),
};

Result<void> check_tilted_ranges(const TiltedScanOptions& options) {
  return check_above("min_range_m", options.min_range_m, "max_range_m", options.max_range_m);
}

/// Where a beam ended, and whether on an obstacle.
struct BeamEnd {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  bool is_obstacle = false;
};

std::optional<BeamEnd> end_of(const Eigen::Vector3d& point_in_map, const HeightOptions& heights) {
  const double height_m = point_in_map.z() - heights.ground_m;
  if (height_m < -heights.ground_tolerance_m || height_m > heights.max_obstacle_m) {
    return std::nullopt;
  }
  return BeamEnd{point_in_map.head<2>(), height_m > heights.ground_tolerance_m};
}

std::vector<BeamEnd> ends_of(const RangeScan& scan, const TiltedScanOptions& options) {
  std::vector<BeamEnd> ends;
  ends.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    const bool is_reading =
        range_m > 0.0 && range_m >= options.min_range_m && range_m < options.max_range_m;
    if (!is_reading) continue;  // NaN too
    const double bearing = scan.bearings_rad[i];
    const Point<frame::Scanner> end{
        {range_m * std::cos(bearing), range_m * std::sin(bearing), 0.0}};
    if (const auto seen = end_of((scan.map_from_scanner * end).xyz, options.heights)) {
      ends.push_back(*seen);
    }
  }
  return ends;
}

Rect rect_around(const std::vector<BeamEnd>& ends, const Eigen::Vector2d& otherwise) {
  if (ends.empty()) return {otherwise, otherwise};
  Rect rect{ends.front().place, ends.front().place};
  for (const BeamEnd& end : ends) {
    rect.min = rect.min.cwiseMin(end.place);
    rect.max = rect.max.cwiseMax(end.place);
  }
  return rect;
}

Result<LogOddsGrid> grid_of_ends(const std::vector<BeamEnd>& ends,
                                 const GridGeometry& geometry,
                                 const EvidenceOptions& options) {
  const LogOddsSteps hit = to_steps(LogOdds::of(options.p_hit));
  const LogOddsSteps free = to_steps(LogOdds::of(options.p_free));
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, LogOddsGrid::create(geometry));
  for (const BeamEnd& end : ends) {
    const auto cell = cell_at(geometry, end.place);
    if (!cell || grid.at(*cell) == hit) continue;
    grid.set(*cell, end.is_obstacle ? hit : free);
  }
  return grid;
}

}  // namespace

const OptionTable& option_table(const TiltedScanOptions&) {
  static constexpr OptionTable kTable{kTiltedScanRows, kRule<check_tilted_ranges>};
  return kTable;
}

Result<void> validate(const TiltedScanOptions& options) {
  return check_options(options);
}

Result<TiltedScanModel> TiltedScanModel::create(TiltedScanOptions options) {
  HYPERMAP_TRY(validate(options));
  return TiltedScanModel(std::move(options));
}

Result<std::vector<SensorGrid>> TiltedScanModel::grids(const RangeScan& scan) const {
  HYPERMAP_TRY(validate(scan));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the scan", [&]() -> Result<Grids> {
    const std::vector<BeamEnd> ends = ends_of(scan, options_);
    const Eigen::Vector2d place = scan.map_from_scanner.origin().xyz.head<2>();
    HYPERMAP_ASSIGN_OR_RETURN(
        const GridGeometry geometry,
        lattice_around(rect_around(ends, place), options_.evidence.resolution_m));
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, grid_of_ends(ends, geometry, options_.evidence));
    return Grids{{.layer = options_.layer, .frame_id = options_.frame_id, .grid = std::move(grid)}};
  });
}

}  // namespace hypermap
