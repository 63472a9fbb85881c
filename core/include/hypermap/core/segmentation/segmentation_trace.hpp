// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Segmentation step by step, to look at and to tune.
///
/// Source: [smap] figures 3.4 to 3.13; [hypermap] figures 12 and 13.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// Per pixel of the image, what a step made of it.
using LabelImage = Image<std::int32_t>;
inline constexpr std::int32_t kLabelAbsent = -1;  ///< Not looked at, or dropped.
inline constexpr std::int32_t kLabelNone = 0;     ///< Looked at, and in no segment.
// 1, 2, ...: in that segment. Steps that do not separate segments use 1, a voxel grid the number of
// the voxel.

/// One step and what it left.
struct SegmentationStep {
  std::string name;              ///< "crop", "range", "voxel grid", ...
  std::size_t num_points = 0;    ///< Pixels, or voxels after a voxel grid, that are left.
  std::size_t num_segments = 0;  ///< Separate segments; 0 when the step does not separate them.
  double seconds = 0.0;          ///< Wall clock of this step alone.
  LabelImage labels;
};

/// The steps in their order, and what came out.
struct SegmentationTrace {
  std::vector<SegmentationStep> steps;
  Result<Segment> segment;
};

/// `segment` with all its steps kept. The segment is the same, byte for byte.
/// Cost: a label image per step on top of `segment`.
[[nodiscard]] SegmentationTrace trace_segmentation(const RgbdFrame& frame,
                                                   const Detection& detection,
                                                   const GeometricSegmentationOptions& options);

/// Labels as an image: pixels in no segment red, those of a segment in its colour, the rest as
/// in `background` (black when that is empty).
///
/// Source: [hypermap] 5.2.2: "red pixels do not belong to any segment".
/// Requires: `background` is empty or has the size of `labels`.
[[nodiscard]] ColorImage render_labels(const LabelImage& labels, const ColorImage& background = {});

}  // namespace hypermap
