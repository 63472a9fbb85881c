// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "hypermap/octree_semantic/octree/sensor_model.hpp"

namespace hypermap {
namespace {

/// Beyond it log-odds do not fit the steps of a voxel.
constexpr double kSmallest = 1e-6;
constexpr double kLargest = 1.0 - kSmallest;

constexpr OptionRow kSensorRows[] = {
    option::number<&SensorModelOptions::hit>(
        "hit",
        option::above(0.5, kLargest),
        {.unit = "probability",
         .source = "OctoMap",
         .effect = "Occupied, given that a ray ended in the voxel."}),
    option::number<&SensorModelOptions::miss>(
        "miss",
        option::below(kSmallest, 0.5),
        {.unit = "probability",
         .source = "OctoMap",
         .effect = "Occupied, given that rays only went through."}),
    option::number<&SensorModelOptions::clamp_min>(
        "clamp_min",
        option::below(kSmallest, 0.5),
        {.unit = "probability", .source = "OctoMap", .effect = "A voxel never becomes freer."}),
    option::number<&SensorModelOptions::clamp_max>(
        "clamp_max",
        option::above(0.5, kLargest),
        {.unit = "probability",
         .source = "OctoMap",
         .effect = "A voxel never becomes more occupied."}),
    option::number<&SensorModelOptions::occupied_from>(
        "occupied_from",
        {kSmallest, kLargest},
        {.unit = "probability",
         .source = "OctoMap",
         .effect = "Occupied when at least this probable."}),
};

Result<void> check_threshold(const SensorModelOptions& options) {
  const Probability threshold = options.occupied_from;
  if (threshold >= options.clamp_min && threshold <= options.clamp_max) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must lie between clamp_min and clamp_max, is " + number_text(threshold.value()),
              "occupied_from");
}

constexpr OptionRow kOctreeRows[] = {
    option::number<&OctreeOptions::resolution_m>(
        "resolution_m",
        {0.001, 10},
        {.unit = "m", .source = "OctoMap", .effect = "Edge of a voxel."}),
    option::section<&OctreeOptions::sensor_model>(""),
    option::number<&OctreeOptions::max_class_log_odds>(
        "max_class_log_odds",
        {0.1, 30},
        {.unit = "log-odds",
         .source = "[smap] table D.2",
         .effect = "Class evidence of a voxel saturates here."}),
};

}  // namespace

const OptionTable& option_table(const SensorModelOptions&) {
  static constexpr OptionTable kTable{kSensorRows, kRule<check_threshold>};
  return kTable;
}

Result<void> validate(const SensorModelOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const OctreeOptions&) {
  static constexpr OptionTable kTable{kOctreeRows};
  return kTable;
}

Result<void> validate(const OctreeOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
