// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The topological map as a layer that answers queries.
#pragma once

#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// Its string is a vertex' kind, `path` or `support`, its integer the vertex. At a point is the
/// vertex nearest to it, if nearer than V_d, with the height only when the point has one; in an
/// area are those whose position lies in it. Drawn are its edges.
class TopologicalMapLayer final : public MapLayer {
 public:
  explicit TopologicalMapLayer(TopologicalMap map) : map_(std::move(map)) {}

  /// kTopologicalMapFormat.
  [[nodiscard]] std::string_view class_name() const override;
  [[nodiscard]] bool is_flat() const override { return false; }
  /// Values are vertices.
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const TopologicalMapLayer& a, const TopologicalMapLayer& b) {
    return a.map_ == b.map_;
  }

 private:
  TopologicalMap map_;
};

}  // namespace hypermap
