// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the depth image of a posed frame says of the plane: obstacles, and ground that is free.
///
/// Source: [sogm] III-B: cameras whose lobe is tilted against the ground.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

struct DepthCameraOptions {
  std::string layer = "/ism/depth";  ///< Which the grid is of.
  std::string frame_id = "map";      ///< Of the poses, and so of the grids.
  EvidenceOptions evidence = {};
  HeightOptions heights = {};
  double min_depth_m = 0.2;  ///< Nearer pixels are none.
  double max_range_m =
      4.0;  ///< In the plan, from the camera; farther pixels and cells are left out.
  int min_obstacle_px = 3;  ///< So many pixels must show something in a cell for it to be occupied.
  friend bool operator==(const DepthCameraOptions&, const DepthCameraOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const DepthCameraOptions& options);
[[nodiscard]] const OptionTable& option_table(const DepthCameraOptions& options);

/// A cell is occupied when enough pixels measured something above it, higher than the ground and up
/// to `max_obstacle_m`; else free when the pixel that shows its centre measured the ground; else
/// unknown. Ground is asked for cell by cell, so it has no gaps where pixels lie far apart.
///
/// Boundary: a pixel at exactly the tolerance is ground. A frame without depth, or from below the
/// ground, knows nothing.
class DepthCameraModel final : public InverseSensorModel<RgbdFrame> {
 public:
  /// Errors: those of validate.
  [[nodiscard]] static Result<DepthCameraModel> create(DepthCameraOptions options = {});

  /// One grid. Errors: also those of validate(RgbdFrame). Cost: O(pixels + cells in range).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(const RgbdFrame& frame) const override;

  [[nodiscard]] const DepthCameraOptions& options() const noexcept { return options_; }

 private:
  explicit DepthCameraModel(DepthCameraOptions options) : options_(std::move(options)) {}

  DepthCameraOptions options_;
};

}  // namespace hypermap
