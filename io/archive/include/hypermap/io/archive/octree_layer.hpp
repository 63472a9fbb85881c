// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voxels of a 3D map as a layer that answers queries.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Its string is the class of an occupied voxel, else Occupied or Free; its integer the
/// probability that the voxel is occupied, in per cent. Ids count the voxels in Morton order.
///
/// A voxel is at a point when the point lies in it, lower faces included; in an area when its
/// square shares area with it. Requires: what the sources look at outlives the layer. Cost: a query
/// is a walk over the leaves; for one point SemanticOctree::at is faster.
class OctreeLayer final : public MapLayer {
 public:
  struct Sources {
    LeafSource leaves;                          ///< Asked, counted and drawn.
    ClassRegistry classes;                      ///< Names of the leaves' classes.
    std::function<Result<std::string>()> file;  ///< The octree's file.
    double resolution_m = 0.0;                  ///< Edge of a voxel, that of the smallest leaves.
  };

  explicit OctreeLayer(Sources sources) : sources_(std::move(sources)) {}

  /// kOctomapFormat.
  [[nodiscard]] std::string_view class_name() const override;
  [[nodiscard]] bool is_flat() const override { return false; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  /// Whether both have the same file.
  [[nodiscard]] bool equals(const MapLayer& other) const override;

 private:
  Sources sources_;
};

}  // namespace hypermap
