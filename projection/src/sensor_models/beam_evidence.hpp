// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What sectors of circles, free up to where they end, say of the cells that they cover.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <span>
#include <vector>

namespace hypermap {

/// A sector of the plane about `apex` between two bearings. Requires: from <= to, less than half a
/// turn apart; error_m > 0.
struct Beam {
  Eigen::Vector2d apex = Eigen::Vector2d::Zero();
  double from_rad = 0.0;
  double to_rad = 0.0;
  double range_m = 0.0;  ///< Where it ends.
  double error_m = 0.0;  ///< The end lies within so much of that, either way.
  bool has_end = false;  ///< Something was met there; else only what lies before is told.
};

/// How beams of a scan are added up, as PlanarScanModel says it. Errors: kLimit when the beams
/// reach over too many cells; kOutOfMemory. Boundary: no beams give the cell of `apex`, unknown.
[[nodiscard]] Result<LogOddsGrid> evidence_of_beams(std::span<const Beam> beams,
                                                    const Eigen::Vector2d& apex,
                                                    const EvidenceOptions& options);

}  // namespace hypermap
