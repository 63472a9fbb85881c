// SPDX-License-Identifier: BSD-3-Clause
#include "frame_checks.hpp"

#include <algorithm>
#include <string>

namespace hypermap {

Result<void> check_sensor(const VoxelGrid& grid, const PointInMap& sensor, const char* field) {
  if (grid.key(PointInMap{sensor.xyz.cast<float>().cast<double>()})) return {};
  return fail(ErrorCode::kInvalidArgument,
              "the sensor must stand within " + std::to_string(kOriginKey * grid.resolution_m()) +
                  " m of the map's origin along each axis, is at (" +
                  std::to_string(sensor.xyz.x()) + ", " + std::to_string(sensor.xyz.y()) + ", " +
                  std::to_string(sensor.xyz.z()) + ")",
              field);
}

Result<void> check_labels(std::span<const PixelLabels> labels, std::size_t num_measurements) {
  for (const PixelLabels& label : labels) {
    std::uint32_t largest = 0;
    for (const std::uint32_t index : label.pixel_indices) largest = std::max(largest, index);
    if (!label.pixel_indices.empty() && largest >= num_measurements) {
      return fail(
          ErrorCode::kInvalidArgument,
          "must be below " + std::to_string(num_measurements) + ", is " + std::to_string(largest),
          "pixel_indices");
    }
    const auto& scores = label.class_scores;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const bool ascending = i == 0 || scores[i - 1].id < scores[i].id;
      if (ascending && scores[i].id.value < ClassWeight::kNone) continue;
      return fail(
          ErrorCode::kInvalidArgument,
          "ids must ascend and be below 65535, one is " + std::to_string(scores[i].id.value),
          "class_scores");
    }
  }
  return {};
}

Unexpected window_too_large(const KeyBox& key_bounds, const IntegrationOptions& options) {
  std::string size;
  for (std::size_t i = 0; i < 3; ++i) {
    size += (i == 0 ? "" : " x ") + std::to_string(key_bounds.max[i] - key_bounds.min[i] + 1);
  }
  return fail(ErrorCode::kLimit,
              "a frame may reach over 2^31 voxels, this one over " + size +
                  "; use a shorter range than " + std::to_string(options.max_range_m) +
                  " m or larger voxels",
              "max_range_m");
}

}  // namespace hypermap
