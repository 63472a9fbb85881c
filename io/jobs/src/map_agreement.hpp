// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether frames show the place that a map is of.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

inline constexpr std::size_t kNumComparedFrames = 8;

/// Up to `count` frames, evenly over the sequence, the first one first; those that cannot be read
/// are left out.
[[nodiscard]] std::vector<RgbdFrame> spread_frames(const DatasetReader& dataset, std::size_t count);

/// What a map says of the points that frames measured on surfaces that are not level.
struct MapAgreement {
  std::size_t num_points = 0;    ///< Sampled from the depth.
  std::size_t num_known = 0;     ///< Of these, where the map knows something.
  std::size_t num_occupied = 0;  ///< Of the known ones, at most a voxel from an occupied one.
};

/// Cost: a hundredth of a frame's pixels, 27 voxels each.
[[nodiscard]] MapAgreement agreement(const RgbdFrame& frame, const SemanticOctree& map);

/// A finding when the frames look nowhere where the map knows something, or what they show there is
/// not what the map has. None too when they have too few points to tell.
[[nodiscard]] std::optional<Finding> compare(std::span<const RgbdFrame> frames,
                                             const SemanticOctree& map);

}  // namespace hypermap
