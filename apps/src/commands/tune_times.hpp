// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// `tune --times`: what each step of the segmentation takes and leaves, over a whole sequence.
#pragma once

#include "command.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <optional>
#include <string>

namespace hypermap::app {

/// Prints a table, or JSON; box plots `times.png` and `points.png` go into the folder `output`.
[[nodiscard]] Result<void> tell_times(const DatasetReader& dataset,
                                      const GeometricSegmentationOptions& options,
                                      const std::optional<std::string>& output,
                                      bool json,
                                      const std::string& progress_when);

}  // namespace hypermap::app
