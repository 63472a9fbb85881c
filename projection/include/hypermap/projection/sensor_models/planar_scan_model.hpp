// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the scan of a level range sensor, such as a laser range finder, says of the plane.
///
/// Source: [sogm] III-B: what a beam covers before the measured distance is free, the cell in which
/// it ends is occupied, and all behind is unknown.
#pragma once

#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// One sweep of a range sensor. `ranges_m[i]` was measured at `bearings_rad[i]`, counter-clockwise
/// about the scanner's +z from its +x; in any order.
struct RangeScan {
  MapFromScanner map_from_scanner;
  std::vector<double> bearings_rad;
  std::vector<double> ranges_m;
};

/// Errors: kInvalidArgument naming the field: lists of different lengths, a bearing that is not
/// within two turns of 0, a pose that is no finite rigid motion or lies beyond 1e6 m; kLimit for
/// more than 2^20 beams. Boundary: any range is one; see `PlanarScanModel`.
[[nodiscard]] Result<void> validate(const RangeScan& scan);

/// What a beam says that met nothing within the sensor's range.
enum class NoReturnRule : std::uint8_t {
  kIgnored,  ///< Nothing: the surface may have been black, a mirror or glass.
  kFree,     ///< That all up to `max_range_m` is free.
};

struct PlanarScanOptions {
  std::string layer = "/ism/scan";  ///< Which the grid is of.
  std::string frame_id = "map";     ///< Of the poses, and so of the grids.
  EvidenceOptions evidence = {};
  double min_range_m = 0.05;  ///< Nearer readings are of the sensor's own housing: none.
  double max_range_m = 30.0;  ///< A reading of this or more met nothing.
  NoReturnRule no_return = NoReturnRule::kIgnored;  ///< What such a reading says.
  /// The end lies within so much before and behind the reading, of any range.
  double range_error_m = 0.02;
  double range_error_per_m = 0.005;  ///< The same, for each metre of range.
  double beam_width_rad = 0.0;       ///< Of each beam; 0: half way to its neighbours.
  /// A beam reaches no farther to its neighbours than half of this: wider gaps stay unknown.
  double max_beam_width_rad = 0.05;
  double max_tilt_rad = 0.1;  ///< A plane that is tilted more is refused.
  friend bool operator==(const PlanarScanOptions&, const PlanarScanOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const PlanarScanOptions& options);
[[nodiscard]] const OptionTable& option_table(const PlanarScanOptions& options);

/// Beams are sectors of a circle, not lines: at any range, cells between two beams belong to one of
/// them, by exact areas.
///
/// Of a cell, H is how sure it is that something ended in it: the larger of the largest share of
/// one beam's end that lies in it, and of the share of its width that ends cover. F is the share of
/// its area that beams covered before their ends. It has H l(p_hit) + (1 - H) F l(p_free). So thin
/// things count in full, and a wall just behind a cell's edge does not make that cell occupied. An
/// end is the stretch of `range_error_m + range_error_per_m * range` either way; where that is
/// longer than a cell it is shared out, and nothing in it says more than its part.
/// Boundary: readings that are NaN, negative, or below `min_range_m` are none; those of
/// `max_range_m` or more, infinity too, are beams that met nothing.
class PlanarScanModel final : public InverseSensorModel<RangeScan> {
 public:
  /// Errors: those of validate.
  [[nodiscard]] static Result<PlanarScanModel> create(PlanarScanOptions options = {});

  /// One grid. Errors: also those of validate(RangeScan); kInvalidArgument when the scan's plane is
  /// tilted too much. Cost: O(cells that beams cover, each by each beam that covers it).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(const RangeScan& scan) const override;

  [[nodiscard]] const PlanarScanOptions& options() const noexcept { return options_; }

 private:
  explicit PlanarScanModel(PlanarScanOptions options) : options_(std::move(options)) {}

  PlanarScanOptions options_;
};

}  // namespace hypermap
