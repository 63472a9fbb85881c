// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The 2D layers of a map, derived from its octree and its objects.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/grids/layer_options.hpp"
#include "hypermap/projection/grids/map_regions.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The 2D layer of where the floor is free.
inline constexpr std::string_view kOccupancyLayer = "occupancy";
/// The 2D layer of the confirmed objects.
inline constexpr std::string_view kSemanticLayer = "semantic";

/// The confirmed objects, those of the layer `semantic`, in the order of their ids; all when there
/// is no such layer. The others are tentative. Valid as long as the archive is not changed.
[[nodiscard]] std::vector<const Object*> confirmed_objects_of(const MapArchive& archive);

/// Their ids.
[[nodiscard]] std::vector<ObjectId> confirmed_ids_of(const MapArchive& archive);

/// The voxels with the classes of the objects `confirmed`, as `VoxelOwners` gives them: what grids
/// are made of before the layer `semantic` says which objects are confirmed.
///
/// Requires: archive.octree, which outlives the result. Ids that are no objects are left out.
[[nodiscard]] LeafSource confirmed_leaves(const MapArchive& archive,
                                          std::span<const ObjectId> confirmed);

/// The voxels that the map shows, and the one place that says which class each of them has: queries
/// of the octree, files, images and evaluations ask here. Those of its octree as `confirmed_leaves`
/// of `confirmed_objects_of`, or as they are labelled when it has no objects at all (points with
/// classes alone); else those of the first octree of another program, as they are; none when there
/// is neither. Requires: the archive outlives the result and is not changed.
[[nodiscard]] LeafSource shown_leaves(const MapArchive& archive);
/// The frame of those voxels and of the objects; of a map that has neither that of its first layer.
[[nodiscard]] std::string shown_frame_id(const MapArchive& archive);

/// What became of the layers that derive_layers made.
struct DerivedLayers {
  MapRegion main;                   ///< What the grids cover; empty for a map without leaves.
  std::vector<MapRegion> outlying;  ///< What they do not: the other regions, the largest first.
  /// Layers that are not there, or not made anew, and why; `entry` names them.
  std::vector<Finding> left_out;
};

/// Gives the archive its layers `occupancy` and `semantic` and its class grids anew, and, where it
/// is asked for or there already, `stack`: from its octree and from the objects that `objects`
/// confirms; other layers stay as they are. Those that are new are marked as fed by a mapper
/// (`subscribe_mode`), those that were there keep their flags.
///
/// Heights are over the floor of the map (`shown_floor`, or the one that the options state), which
/// the archive keeps. Grids cover the largest region of the octree alone (map_regions.hpp);
/// `semantic` has the objects of all regions. Cells of `occupancy` that were seen free are occupied
/// where one of its shapes covers half of them, when these were held against the map
/// (`carve_footprints`, policy `voxels`, no box in the place of a shape; a layer `semantic` that
/// takes no updates as it is) and the object reaches into the band by more than a voxel. What
/// cannot be made (too many cells, no memory) is left out and said: the map would else be lost with
/// it. A layer whose `enable_update` is false stays as it was, which is said, too. Source:
/// [hypermap] 3.3.5. Requires: archive.octree. Errors: those of validate(options). Cost: some walks
/// over the leaves, the cells of the grids.
[[nodiscard]] Result<DerivedLayers> derive_layers(MapArchive& archive,
                                                  const ObjectPipelineOptions& objects,
                                                  const LayerOptions& options);

}  // namespace hypermap
