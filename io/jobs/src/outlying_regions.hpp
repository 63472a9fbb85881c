// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is said of the parts of a map that its layers leave out.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace hypermap {

/// Where a frame was taken.
struct FramePlace {
  std::size_t index = 0;  ///< In the dataset.
  Eigen::Vector3d camera_in_map = Eigen::Vector3d::Zero();
};

/// A warning for each of the first ten outlying regions: how many voxels, where, and of which of
/// the frames (none when an earlier run left them); one for all others together; and those of
/// layers that are not there. `file` is `output` in each.
[[nodiscard]] std::vector<Finding> findings_of(const DerivedLayers& derived,
                                               std::span<const FramePlace> frames,
                                               const DatasetReader& dataset,
                                               const std::filesystem::path& output);

}  // namespace hypermap
