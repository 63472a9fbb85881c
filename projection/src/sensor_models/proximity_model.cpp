// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/proximity_model.hpp"

#include "beam_evidence.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "scanner_pose.hpp"

#include <algorithm>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kEmptyConeNames[] = {"ignored", "free"};

constexpr OptionRow kProximityRows[] = {
    option::section<&ProximityOptions::evidence>("evidence"),
    option::number<&ProximityOptions::field_of_view_rad>(
        "field_of_view_rad",
        option::above(0.0, 3.0),
        {.unit = "rad", .effect = "Whole angle of the cone."}),
    option::number<&ProximityOptions::min_range_m>(
        "min_range_m", {.max = 100.0}, {.unit = "m", .effect = "Nearer readings are none."}),
    option::number<&ProximityOptions::max_range_m>(
        "max_range_m",
        option::above(0.0, 1000.0),
        {.unit = "m", .effect = "Readings of this or more met nothing."}),
    option::choice<&ProximityOptions::no_return>(
        "no_return", kEmptyConeNames, {.effect = "What a reading says that met nothing."}),
    option::number<&ProximityOptions::range_error_m>(
        "range_error_m",
        option::above(0.0, 10.0),
        {.unit = "m", .effect = "What was met lies within so much of the reading."}),
    option::number<&ProximityOptions::range_error_per_m>(
        "range_error_per_m", {}, {.unit = "m/m", .effect = "The same, for each metre of range."}),
    option::number<&ProximityOptions::max_tilt_rad>(
        "max_tilt_rad",
        {.max = 0.5},
        {.unit = "rad", .effect = "A sensor that is tilted more is refused."}),
};

Result<void> check_proximity_ranges(const ProximityOptions& options) {
  return check_above("min_range_m", options.min_range_m, "max_range_m", options.max_range_m);
}

/// None where the reading says nothing.
std::vector<Beam> cone_of(double range_m, const PlanePose& pose, const ProximityOptions& options) {
  if (!(range_m > 0.0 && range_m >= options.min_range_m)) return {};  // NaN too
  const bool has_end = range_m < options.max_range_m;
  if (!has_end && options.no_return == NoReturnRule::kIgnored) return {};
  return {{.apex = pose.place,
           .from_rad = pose.yaw_rad - options.field_of_view_rad / 2.0,
           .to_rad = pose.yaw_rad + options.field_of_view_rad / 2.0,
           .range_m = std::min(range_m, options.max_range_m),
           .error_m = options.range_error_m + options.range_error_per_m * range_m,
           .has_end = has_end}};
}

}  // namespace

const OptionTable& option_table(const ProximityOptions&) {
  static constexpr OptionTable kTable{kProximityRows, kRule<check_proximity_ranges>};
  return kTable;
}

Result<void> validate(const ProximityOptions& options) {
  return check_options(options);
}

Result<ProximityModel> ProximityModel::create(ProximityOptions options) {
  HYPERMAP_TRY(validate(options));
  return ProximityModel(std::move(options));
}

Result<std::vector<SensorGrid>> ProximityModel::grids(const ProximityReading& reading) const {
  HYPERMAP_TRY(check_scanner_pose(reading.map_from_sensor));
  HYPERMAP_ASSIGN_OR_RETURN(const PlanePose pose,
                            level_pose(reading.map_from_sensor, options_.max_tilt_rad));
  using Grids = std::vector<SensorGrid>;
  return guarded(ErrorCode::kInvalidArgument, "the reading", [&]() -> Result<Grids> {
    const std::vector<Beam> cone = cone_of(reading.range_m, pose, options_);
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid grid,
                              evidence_of_beams(cone, pose.place, options_.evidence));
    return Grids{{.layer = options_.layer, .frame_id = options_.frame_id, .grid = std::move(grid)}};
  });
}

}  // namespace hypermap
