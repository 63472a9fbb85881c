// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the reading of a proximity sensor, sonar or infrared, says of the plane.
///
/// Source: [sogm] III-B. A. Elfes, "Using occupancy grids for mobile robot perception and
/// navigation", Computer 22, 1989: a cone that is free, an arc somewhere on which something is.
#pragma once

#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"
#include "hypermap/projection/sensor_models/planar_scan_model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// One distance in the cone about the sensor's +x.
struct ProximityReading {
  MapFromScanner map_from_sensor;
  double range_m = 0.0;
};

struct ProximityOptions {
  std::string layer = "/ism/proximity";  ///< Which the grid is of.
  std::string frame_id = "map";          ///< Of the poses, and so of the grids.
  /// Where on the arc something is, is not known: one reading says less of a cell than a beam.
  EvidenceOptions evidence = {.p_hit = Probability(0.6)};
  double field_of_view_rad = 0.5;  ///< Whole angle of the cone: 0.5 of sonars, 0.1 of infrared.
  double min_range_m = 0.02;       ///< Nearer readings are none.
  double max_range_m = 4.0;        ///< A reading of this or more met nothing.
  NoReturnRule no_return = NoReturnRule::kFree;  ///< What such a reading says.
  double range_error_m = 0.03;  ///< What was met lies within so much of the reading, either way.
  double range_error_per_m = 0.01;  ///< The same, for each metre of range.
  double max_tilt_rad = 0.1;        ///< A sensor that is tilted more is refused.
  friend bool operator==(const ProximityOptions&, const ProximityOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const ProximityOptions& options);
[[nodiscard]] const OptionTable& option_table(const ProximityOptions& options);

/// The cone is free up to the reading and the arc at its end occupied, as one beam of
/// PlanarScanModel. Boundary: readings count as there.
class ProximityModel final : public InverseSensorModel<ProximityReading> {
 public:
  /// Errors: those of validate.
  [[nodiscard]] static Result<ProximityModel> create(ProximityOptions options = {});

  /// One grid. Errors: also kInvalidArgument for a pose that is no finite rigid motion, lies beyond
  /// 1e6 m or is tilted too much. Cost: O(cells of the cone).
  [[nodiscard]] Result<std::vector<SensorGrid>> grids(
      const ProximityReading& reading) const override;

  [[nodiscard]] const ProximityOptions& options() const noexcept { return options_; }

 private:
  explicit ProximityModel(ProximityOptions options) : options_(std::move(options)) {}

  ProximityOptions options_;
};

}  // namespace hypermap
