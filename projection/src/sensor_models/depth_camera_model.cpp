// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/depth_camera_model.hpp"

#include "cell_lattice.hpp"
#include "ground_view.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kDepthCameraRows[] = {
    option::section<&DepthCameraOptions::evidence>("evidence"),
    option::section<&DepthCameraOptions::heights>("heights"),
    option::number<&DepthCameraOptions::min_depth_m>(
        "min_depth_m", {.max = 10.0}, {.unit = "m", .effect = "Nearer pixels are none."}),
    option::number<&DepthCameraOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 100.0),
        {.unit = "m", .effect = "Farther pixels and cells are left out."}),
    option::count<&DepthCameraOptions::min_obstacle_px>(
        "min_obstacle_px",
        {.min = 1, .max = 10'000},
        {.unit = "px",
         .effect = "Pixels that must show something in a cell for it to be occupied."}),
};

/// How many pixels measured an obstacle above each cell.
std::vector<int> obstacle_pixels(const RgbdFrame& frame,
                                 const GroundView& view,
                                 const DepthCameraOptions& options) {
  std::vector<int> num_px(view.geometry().num_cells(), 0);
  const Eigen::Vector2d eye = frame.map_from_camera.origin().xyz.head<2>();
  const HeightOptions& heights = options.heights;
  for (int v = 0; v < frame.depth_m.height_px(); ++v) {
    for (int u = 0; u < frame.depth_m.width_px(); ++u) {
      const float measured_m = frame.depth_m.at(u, v);
      const auto depth_m = static_cast<double>(measured_m);
      if (!is_measured(measured_m) || depth_m < options.min_depth_m) continue;
      const Eigen::Vector3d point =
          (frame.map_from_camera * frame.camera.unproject(u, v, depth_m)).xyz;
      const double height_m = point.z() - heights.ground_m;
      const bool is_obstacle =
          height_m > heights.ground_tolerance_m && height_m <= heights.max_obstacle_m;
      if (!is_obstacle || (point.head<2>() - eye).norm() > options.max_range_m) continue;
      if (const auto cell = cell_at(view.geometry(), point.head<2>())) {
        ++num_px[view.geometry().index(*cell)];
      }
    }
  }
  return num_px;
}

Result<LogOddsGrid> evidence_of_depth(const RgbdFrame& frame,
                                      const GroundView& view,
                                      const DepthCameraOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, LogOddsGrid::create(view.geometry()));
  if (frame.depth_m.empty()) return grid;
  const LogOddsSteps free = to_steps(LogOdds::of(options.evidence.p_free));
  for (const CellInView& seen : view.cells_in_view()) {
    if (view.is_ground(seen, frame.depth_m)) grid.set(seen.cell, free);
  }
  const LogOddsSteps hit = to_steps(LogOdds::of(options.evidence.p_hit));
  const std::vector<int> num_px = obstacle_pixels(frame, view, options);
  for (int row = 0; row < view.geometry().rows; ++row) {
    for (int col = 0; col < view.geometry().cols; ++col) {
      const bool is_hit = num_px[view.geometry().index({col, row})] >= options.min_obstacle_px;
      if (is_hit) grid.set({col, row}, hit);
    }
  }
  return grid;
}

}  // namespace

const OptionTable& option_table(const DepthCameraOptions&) {
  static constexpr OptionTable kTable{kDepthCameraRows};
  return kTable;
}

Result<void> validate(const DepthCameraOptions& options) {
  return check_options(options);
}

Result<DepthCameraModel> DepthCameraModel::create(DepthCameraOptions options) {
  HYPERMAP_TRY(validate(options));
  return DepthCameraModel(std::move(options));
}

Result<std::vector<SensorGrid>> DepthCameraModel::grids(const RgbdFrame& frame) const {
  HYPERMAP_TRY(validate(frame));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the frame", [&]() -> Result<Grids> {
    const GroundRange range{options_.heights, options_.evidence.resolution_m, options_.max_range_m};
    HYPERMAP_ASSIGN_OR_RETURN(const GroundView view,
                              GroundView::create(frame.camera, frame.map_from_camera, range));
    HYPERMAP_ASSIGN_OR_RETURN(const LogOddsGrid whole, evidence_of_depth(frame, view, options_));
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid, cropped_to_known(whole));
    return Grids{{.layer = options_.layer, .frame_id = options_.frame_id, .grid = std::move(grid)}};
  });
}

}  // namespace hypermap
