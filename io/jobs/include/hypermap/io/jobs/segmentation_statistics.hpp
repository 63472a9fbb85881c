// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What each step of the segmentation takes and leaves, over a whole sequence.
///
/// Source: [smap] 5.1 and 5.2, figures 5.5 and 5.7.
#pragma once

#include "hypermap/core/base/five_numbers.hpp"
#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hypermap {

/// One step, over the detections that came to it.
struct StepStatistics {
  std::string name;
  std::size_t num_detections = 0;
  FiveNumbers seconds = {};  ///< Wall clock, on one thread.
  FiveNumbers points = {};   ///< That it left: pixels, or voxels from a voxel grid on.
};

struct SegmentationStatistics {
  std::size_t num_frames = 0;   ///< That could be read.
  std::size_t num_skipped = 0;  ///< That could not.
  std::size_t num_detections = 0;
  std::size_t num_segments = 0;            ///< Detections of which something was left.
  std::vector<StepStatistics> steps = {};  ///< In their order.
  FiveNumbers seconds = {};                ///< Of all steps of a detection together.
};

/// Segments each detection of each frame with its steps noted.
/// Errors: kInterrupted when `progress` says so. Cost: that of trace_segmentation for each.
[[nodiscard]] Result<SegmentationStatistics> segmentation_statistics(
    const DatasetReader& dataset,
    const GeometricSegmentationOptions& options,
    const JobProgress& progress = {});

/// One JSON document: `frames`, `frames_skipped`, `detections`, `segments`, `seconds` and `steps`
/// [{`name`, `detections`, `seconds`, `points`}]; five numbers are {`min`, `lower`, `median`,
/// `upper`, `max`}.
[[nodiscard]] std::string to_json(const SegmentationStatistics& statistics);

}  // namespace hypermap
