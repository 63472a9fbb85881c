// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One map with what another one of the same place knows besides.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hypermap {

/// What becomes of two maps.
struct MergedArchives {
  MapArchive map;
  std::size_t num_joined = 0;  ///< Objects of both.
  std::size_t num_new = 0;     ///< Objects of the added map alone.
  std::size_t num_gone = 0;    ///< Objects of the other whose place the added map saw empty.
  std::size_t num_forgotten_runs = 0;
  std::vector<Finding> findings = {};
};

struct ArchiveMergeOptions {
  AssociationOptions association = {};
  bool is_later = false;  ///< All frames of the added map came after those of the other.
  /// The result's floor is stated: where those of both maps lie decides nothing.
  bool is_floor_stated = false;
  /// By what the added map's layers go where another layer has their name: `<name>_<layer>`.
  std::string name = {};
};

/// `added` becomes part of `map`: voxels, objects, views, topological map, classes, detectors,
/// runs, and layers that no mapper made. Derived layers are those of `map` still: derive_layers
/// makes them anew. Frame: Map, the same for both. Requires: both have an octree.
/// Errors: see run_merge.
[[nodiscard]] Result<MergedArchives> merged(MapArchive map,
                                            MapArchive added,
                                            const ArchiveMergeOptions& options);

/// Whether a layer is one that mapping derives from voxels and objects.
[[nodiscard]] bool is_derived(const Layer& layer);

}  // namespace hypermap
