// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An occupancy grid as a layer of a hypermap.
///
/// Source: [hypermap] 3.3.3, occupancy layer.
#pragma once

#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

inline constexpr std::string_view kOccupancyLayerClass = "OccupancyGridLayer";

/// An occupancy grid and what its metadata file says beyond it.
///
/// Its string is Free, Occupied or Unknown, its integer the occupancy, -1 to 100; the confidence of
/// a known cell is its occupancy. Boundary: a point outside the grid has no answer.
class OccupancyLayer final : public MapLayer {
 public:
  OccupancyLayer() = default;  ///< Without cells.
  explicit OccupancyLayer(OccupancyGrid cells, ValueTree unknown_keys = {})
      : grid(std::move(cells)), extra(std::move(unknown_keys)) {}

  OccupancyGrid grid;
  ValueTree extra;  ///< Unknown keys of the metadata, as a map; null when there are none.

  [[nodiscard]] std::string_view class_name() const override { return kOccupancyLayerClass; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const OccupancyLayer& a, const OccupancyLayer& b) {
    return a.grid == b.grid && a.extra == b.extra;
  }
};

}  // namespace hypermap
