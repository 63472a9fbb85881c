// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The 2D layers of a map, derived from its octree and its objects.
#pragma once

#include "hypermap/core/object_pipeline_options.hpp"
#include "hypermap/core/result.hpp"
#include "hypermap/io/map_archive.hpp"

namespace hypermap {

struct LayerOptions {
  /// Band of heights over the floor in which things are obstacles. Unit: metre. Default: 0.1 .. 1.8
  double min_height_m = 0.1;
  double max_height_m = 1.8;  ///< > min_height_m
  friend bool operator==(const LayerOptions&, const LayerOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const LayerOptions& options);

/// Gives the archive its layers `occupancy` and `semantic` and its class grids anew, from its
/// octree and from the objects that `objects` publishes; other layers stay as they are.
///
/// Requires: archive.octree. Errors: those of the grids and layers.
/// Cost: two walks over the leaves.
[[nodiscard]] Result<void> derive_layers(MapArchive& archive,
                                         const ObjectPipelineOptions& objects,
                                         const LayerOptions& options);

}  // namespace hypermap
