// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/map_floor.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kEvidenceRows[] = {
    option::number<&EvidenceOptions::resolution_m>(
        "resolution_m", {.min = 0.001, .max = 10.0}, {.unit = "m", .effect = "Edge of a cell."}),
    option::number<&EvidenceOptions::p_hit>(
        "p_hit",
        option::inside(0.5, 1.0),
        {.unit = "probability", .effect = "Occupancy of a cell in which something was measured."}),
    option::number<&EvidenceOptions::p_free>(
        "p_free",
        option::inside(0.0, 0.5),
        {.unit = "probability", .effect = "Occupancy of a cell that was seen free."}),
};

constexpr OptionRow kHeightRows[] = {
    option::number<&HeightOptions::ground_m>("ground_m",
                                             {-kMaxFloorHeightM, kMaxFloorHeightM},
                                             {.unit = "m", .effect = "Where the ground is."}),
    option::number<&HeightOptions::ground_tolerance_m>(
        "ground_tolerance_m",
        option::above(0.0, 1.0),
        {.unit = "m", .effect = "Lower things count as the ground."}),
    option::number<&HeightOptions::max_obstacle_m>(
        "max_obstacle_m",
        option::above(0.0, 100.0),
        {.unit = "m", .effect = "What is higher above the ground is no obstacle."}),
};

Result<void> check_heights(const HeightOptions& options) {
  return check_above(
      "ground_tolerance_m", options.ground_tolerance_m, "max_obstacle_m", options.max_obstacle_m);
}

}  // namespace

const OptionTable& option_table(const EvidenceOptions&) {
  static constexpr OptionTable kTable{kEvidenceRows};
  return kTable;
}

Result<void> validate(const EvidenceOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const HeightOptions&) {
  static constexpr OptionTable kTable{kHeightRows, kRule<check_heights>};
  return kTable;
}

Result<void> validate(const HeightOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
