// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The grid of one class as a layer that answers queries.
#pragma once

#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/projection/layers/map_layer.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// It answers as an occupancy layer: Occupied, 100, is where objects of the class are; Free, 0,
/// where the space is free or holds other objects.
class ClassGridLayer final : public MapLayer {
 public:
  explicit ClassGridLayer(OccupancyGrid grid) : cells_(std::move(grid)) {}

  [[nodiscard]] std::string_view class_name() const override { return kClassGridFormat; }
  [[nodiscard]] LayerStatistics statistics() const override { return cells_.statistics(); }
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override {
    return cells_.query(query);
  }
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override { return cells_.draw(); }
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override {
    return cells_.save(writer);
  }
  [[nodiscard]] bool equals(const MapLayer& other) const override {
    return is_same_layer(*this, other);
  }

  friend bool operator==(const ClassGridLayer& a, const ClassGridLayer& b) {
    return a.cells_ == b.cells_;
  }

 private:
  OccupancyLayer cells_;
};

}  // namespace hypermap
