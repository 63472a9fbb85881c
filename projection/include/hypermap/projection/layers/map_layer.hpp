// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What every layer of a hypermap can do: answer queries, tell its extent, be drawn, saved, loaded
/// and updated. A type of layer is a class of its own; nothing here knows which types there are.
///
/// Source: [hypermap] 3.2, 3.3.2 (MapLayerBase).
/// Deviation: a layer has no pointer to its hypermap; frames are the business of whoever asks
/// (hypermap_query.hpp), files that of LayerReader and LayerWriter.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/layer_drawing.hpp"
#include "hypermap/projection/layers/layer_query.hpp"

#include <Eigen/Geometry>

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hypermap {

class LayerContent;
class LayerWriter;

/// How much a layer holds and where. Of the counts, the one that its kind has.
struct LayerStatistics {
  std::optional<OccupancyCounts> cells = {};
  std::optional<GridGeometry> grid = {};          ///< Of these cells.
  std::optional<std::size_t> num_objects = {};    ///< That the map shows.
  std::optional<std::size_t> num_tentative = {};  ///< Of tracked objects: not sure enough yet.
  std::optional<LeafCount> leaves = {};
  std::optional<LeafCount> voxels = {};        ///< Of these leaves: a large one covers many.
  std::optional<std::size_t> num_values = {};  ///< Of a layer of another kind.
  /// In the layer's frame; z is 0 where the layer is flat. None when it is empty.
  std::optional<Eigen::AlignedBox3d> bounds = {};
};

/// The content of a layer, in its own frame.
///
/// Derived classes are values: copyable, without shared state that changes.
/// Threads: const functions are called concurrently.
class MapLayer {
 public:
  virtual ~MapLayer() = default;

  /// The name by which archives and LayerRegistry know the type.
  [[nodiscard]] virtual std::string_view class_name() const = 0;
  /// The newest version of its members that the type reads, and the one that it writes.
  [[nodiscard]] virtual int version() const { return 1; }
  /// Whether its answers have no height.
  [[nodiscard]] virtual bool is_flat() const { return true; }

  [[nodiscard]] virtual LayerStatistics statistics() const = 0;
  /// Answers in ascending id. Requires: coordinates are finite, an area is a valid polygon.
  /// Errors: kUnsupported when the layer cannot be asked. An empty list is a normal answer.
  [[nodiscard]] virtual Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const = 0;
  /// From the lowest to the uppermost.
  [[nodiscard]] virtual std::vector<LayerPrimitive> draw() const = 0;
  /// Writes the members from which LayerRegistry's loader of this class makes an equal layer.
  /// Errors: kInvalidArgument for what the loader would refuse; those of the writer.
  [[nodiscard]] virtual Result<void> save(LayerWriter& writer) const = 0;
  /// The layer after an update of the same class; the update takes its place unless the type says
  /// otherwise. Errors: kInvalidArgument when the update is of another class.
  [[nodiscard]] virtual Result<LayerContent> updated(const LayerContent& update) const;
  /// Whether `other` is of this class and holds the same; `is_same_layer` does it.
  [[nodiscard]] virtual bool equals(const MapLayer& other) const = 0;

 protected:
  MapLayer() = default;
  MapLayer(const MapLayer&) = default;
  MapLayer(MapLayer&&) = default;
  MapLayer& operator=(const MapLayer&) = default;
  MapLayer& operator=(MapLayer&&) = default;
};

/// MapLayer::equals of a type that has an operator==.
template <class T>
[[nodiscard]] bool is_same_layer(const T& layer, const MapLayer& other) {
  const auto* same_class = dynamic_cast<const T*>(&other);
  return same_class != nullptr && layer == *same_class;
}

/// A layer of any type. A value: copies share the layer, which nobody can change.
class LayerContent {
 public:
  /// Implicit, as a layer is a content.
  template <std::derived_from<MapLayer> T>
  LayerContent(T layer)  // NOLINT(google-explicit-constructor)
      : layer_(std::make_shared<const T>(std::move(layer))) {}

  [[nodiscard]] const MapLayer& operator*() const noexcept { return *layer_; }
  [[nodiscard]] const MapLayer* operator->() const noexcept { return layer_.get(); }
  /// The layer as what it is; null when it is of another type.
  template <std::derived_from<MapLayer> T>
  [[nodiscard]] const T* as() const noexcept {
    return dynamic_cast<const T*>(layer_.get());
  }

  friend bool operator==(const LayerContent& a, const LayerContent& b) {
    return a.layer_ == b.layer_ || a.layer_->equals(*b.layer_);
  }

 private:
  std::shared_ptr<const MapLayer> layer_;
};

}  // namespace hypermap
