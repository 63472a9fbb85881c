// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/binned_depth_map.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

/// First pixel of panel `panel` of `panels` over `side_px` pixels; panels differ by a pixel at
/// most.
int panel_begin(int panel, int panels, int side_px) {
  return static_cast<int>(static_cast<std::int64_t>(panel) * side_px / panels);
}

void extend(DepthPanel& panel, const Eigen::Vector3d& point_in_map, double distance_m) {
  const bool is_first = panel.num_points == 0;
  Box& box = panel.box;
  box.min_in_map = is_first ? point_in_map : box.min_in_map.cwiseMin(point_in_map);
  box.max_in_map = is_first ? point_in_map : box.max_in_map.cwiseMax(point_in_map);
  panel.nearest_m = is_first ? distance_m : std::min(panel.nearest_m, distance_m);
  panel.farthest_m = is_first ? distance_m : std::max(panel.farthest_m, distance_m);
  ++panel.num_points;
}

DepthPanel make_panel(const RgbdFrame& frame,
                      const PixelRect& rect,
                      const BinnedDepthMapOptions& options) {
  const Eigen::Isometry3d& map_from_camera = frame.map_from_camera.isometry();
  const double max_range_m = options.max_range_m.value_or(kDefaultMaxRangeM);
  DepthPanel panel;
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const float depth = frame.depth_m.at(u, v);
      if (!is_measured(depth)) continue;
      const double depth_m = static_cast<double>(depth);
      if (depth_m < options.min_range_m || depth_m > max_range_m) continue;
      const PointInCamera point = frame.camera.unproject(u, v, depth_m);
      extend(panel, map_from_camera * point.xyz, point.xyz.norm());
    }
  }
  return panel;
}

using BinnedDepth = BinnedDepthMapOptions;

constexpr OptionRow kPanelRows[] = {
    option::count<&BinnedDepth::columns>(
        "columns",
        {1, 4096},
        {.source = "[smap] table D.2", .effect = "Panels across.", .smap = 24}),
    option::count<&BinnedDepth::rows>(
        "rows", {1, 4096}, {.source = "[smap] table D.2", .effect = "Panels down.", .smap = 16}),
    option::number<&BinnedDepth::min_range_m>(
        "min_range_m",
        {0, 1000},
        {.unit = "m", .source = "[smap] table D.1, R_min", .effect = "Nearer depth is dropped."}),
    option::number<&BinnedDepth::max_range_m>(
        "max_range_m",
        option::above(0, 100000),
        {.unit = "m", .effect = "Farther depth is dropped; none: as integration.max_range_m."}),
};

Result<void> check_ranges(const BinnedDepth& options) {
  const double max_range_m = options.max_range_m.value_or(kDefaultMaxRangeM);
  if (max_range_m > options.min_range_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be above min_range_m (" + number_text(options.min_range_m) + "), is " +
                  number_text(max_range_m),
              "max_range_m");
}

}  // namespace

const OptionTable& option_table(const BinnedDepthMapOptions&) {
  static constexpr OptionTable kTable{kPanelRows, kRule<check_ranges>};
  return kTable;
}

Result<void> validate(const BinnedDepthMapOptions& options) {
  return check_options(options);
}

BinnedDepthMap::BinnedDepthMap(const RgbdFrame& frame, const BinnedDepthMapOptions& options)
    : columns_(options.columns),
      rows_(options.rows),
      camera_centre_(frame.map_from_camera.origin()),
      camera_axis_in_map_(frame.map_from_camera.isometry().linear().col(2)),
      panels_(static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows)) {}

BinnedDepthMap BinnedDepthMap::create(const RgbdFrame& frame,
                                      const BinnedDepthMapOptions& options,
                                      int threads) {
  BinnedDepthMap map(frame, options);
  const int width_px = frame.camera.width_px;
  const int height_px = frame.camera.height_px;
  const auto make_row = [&](int row) {
    for (int column = 0; column < options.columns; ++column) {
      const PixelRect rect{.u_begin = panel_begin(column, options.columns, width_px),
                           .v_begin = panel_begin(row, options.rows, height_px),
                           .u_end = panel_begin(column + 1, options.columns, width_px),
                           .v_end = panel_begin(row + 1, options.rows, height_px)};
      const auto position = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns_) +
                            static_cast<std::size_t>(column);
      map.panels_[position] = make_panel(frame, rect, options);
    }
  };
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(0, options.rows, make_row); });
  return map;
}

const DepthPanel& BinnedDepthMap::at(int column, int row) const {
  assert(column >= 0 && column < columns_ && row >= 0 && row < rows_);
  return panels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)];
}

}  // namespace hypermap
