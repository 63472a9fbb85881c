// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the scan of a range sensor whose plane is tilted against the ground says of the plane.
///
/// Source: [sogm] III-B: lobes of tilted sensors meet the map only where they end.
#pragma once

#include "hypermap/projection/sensor_models/planar_scan_model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

struct TiltedScanOptions {
  std::string layer = "/ism/tilted_scan";  ///< Which the grid is of.
  std::string frame_id = "map";            ///< Of the poses, and so of the grids.
  EvidenceOptions evidence = {};
  HeightOptions heights = {};
  double min_range_m = 0.05;  ///< Nearer readings are of the sensor's own housing: none.
  double max_range_m = 30.0;  ///< A reading of this or more met nothing.
  friend bool operator==(const TiltedScanOptions&, const TiltedScanOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const TiltedScanOptions& options);
[[nodiscard]] const OptionTable& option_table(const TiltedScanOptions& options);

/// Each beam tells of the cell alone in which it ends, by the height of its end: on the ground the
/// cell is free, between the ground and `max_obstacle_m` occupied, else unknown. It passed over all
/// cells before, which tells nothing of what stands in them.
///
/// A scan speaks once of a cell, however many beams end in it; where one met an obstacle, the cell
/// is occupied. Boundary: an end at exactly the tolerance is on the ground; one below the ground,
/// as in a hole, says nothing. Readings count as in PlanarScanModel; beams that met nothing say
/// nothing.
class TiltedScanModel final : public InverseSensorModel<RangeScan> {
 public:
  /// Errors: those of validate.
  [[nodiscard]] static Result<TiltedScanModel> create(TiltedScanOptions options = {});

  /// One grid. Errors: also those of validate(RangeScan). Cost: O(beams + cells of the grid).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(const RangeScan& scan) const override;

  [[nodiscard]] const TiltedScanOptions& options() const noexcept { return options_; }

 private:
  explicit TiltedScanModel(TiltedScanOptions options) : options_(std::move(options)) {}

  TiltedScanOptions options_;
};

}  // namespace hypermap
