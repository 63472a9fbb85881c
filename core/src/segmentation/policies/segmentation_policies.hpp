// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the policies share, and the policies themselves.
#pragma once

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "step_recorder.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// Depth pixels and the points that they measure, side by side.
struct PixelCloud {
  std::vector<std::uint32_t> pixels;              ///< Row-major positions, ascending.
  std::vector<Eigen::Vector3f> points_in_camera;  ///< One per pixel.
};

/// The measured pixels of the detection: those of its mask, else those of its box.
/// Source: [smap] Eq. (3.6), (3.7).
[[nodiscard]] PixelCloud crop(const RgbdFrame& frame, const Detection& detection);

/// The points within [min_range_m, max_range_m] along the optical axis. Source: [smap] 3.3, RoI.
[[nodiscard]] PixelCloud within_range(const PixelCloud& cloud,
                                      const GeometricSegmentationOptions& options);

/// The elements at `kept`.
[[nodiscard]] PixelCloud subset(const PixelCloud& cloud, const std::vector<std::uint32_t>& kept);

/// Box, centroid, confidence and distance of points. Source: [smap] pseudocodes 3.2 and 3.3,
/// Eq. (3.9). Requires: points not empty.
[[nodiscard]] Segment describe(const RgbdFrame& frame,
                               std::vector<std::uint32_t> pixels,
                               std::span<const Eigen::Vector3f> points_in_camera,
                               const GeometricSegmentationOptions& options);

/// The error of a step that left nothing.
[[nodiscard]] Unexpected nothing_left(const std::string& step);

[[nodiscard]] Result<Segment> segment_by_cluster(const RgbdFrame& frame,
                                                 const Detection& detection,
                                                 const GeometricSegmentationOptions& options,
                                                 StepRecorder* recorder);

[[nodiscard]] Result<Segment> segment_by_region_growing(const RgbdFrame& frame,
                                                        const Detection& detection,
                                                        const GeometricSegmentationOptions& options,
                                                        StepRecorder* recorder);

/// `others` are all detections of the image: what fills another's box better is not this object.
[[nodiscard]] Result<Segment> segment_by_foreground(const RgbdFrame& frame,
                                                    const Detection& detection,
                                                    std::span<const Detection> others,
                                                    const GeometricSegmentationOptions& options,
                                                    StepRecorder* recorder);

}  // namespace hypermap
