// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A semantic occupancy grid as a layer of a hypermap.
///
/// Source: [sogm] III-A (the stack), [hypermap] 3.2 (a layer of any type).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/layers/layer_members.hpp"
#include "hypermap/projection/layers/map_layer.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

inline constexpr std::string_view kGridStackLayerClass = "GridStackLayer";

/// A stack, or none.
///
/// A cell answers once for each of its layers that is more likely occupied than not: its string is
/// the last part of the layer's name (the class), its integer the layer's occupancy in per cent.
/// A cell without such a layer answers `Free`, 0, where some layer knows it, else `Unknown`, -1.
/// The id of the latter is the cell's place in row-major order, that of layer k, by name from 1 on,
/// is k times the number of cells more. Its cells are counted as by maximum pooling ([sogm] (6)),
/// log-odds above 0 as occupied.
///
/// Members: `.yaml` with the geometry, the options and the names of the layers; for each of them
/// `.0`, `.1` and so on its cells, 16 bits each, little endian, in steps of 0.001.
class GridStackLayer final : public MapLayer {
 public:
  GridStackLayer() = default;
  explicit GridStackLayer(GridStack stack) : stack_(std::move(stack)) {}

  /// Errors: kMalformedFile for members that GridStack::create refuses.
  [[nodiscard]] static Result<LayerContent> load(LayerReader& reader);

  [[nodiscard]] const std::optional<GridStack>& stack() const noexcept { return stack_; }

  [[nodiscard]] std::string_view class_name() const override { return kGridStackLayerClass; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  /// Cells in the colours of their best layers' classes.
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const GridStackLayer& a, const GridStackLayer& b) {
    return a.stack_ == b.stack_;
  }

 private:
  std::optional<GridStack> stack_;
};

}  // namespace hypermap
