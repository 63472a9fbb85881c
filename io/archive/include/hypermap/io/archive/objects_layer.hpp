// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The objects of a 3D map as a layer that answers queries.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <map>
#include <string_view>
#include <vector>

namespace hypermap {

/// Its string is the name of an object's best class, asked for in any spelling of it, or `unknown`,
/// which no text asks for; its integer the object's id; its position the centroid. `find_objects`
/// answers. Objects that the map does not show are counted, and answer nothing.
class ObjectsLayer final : public MapLayer {
 public:
  /// `confidence` is what the map's 2D layer says of its objects; others have `object_confidence`.
  /// Requires: `shown` ascends, and each is an object. Cost: of the copies, O(1).
  ObjectsLayer(ObjectMap objects,
               ClassRegistry classes,
               std::vector<ObjectId> shown,
               std::map<ObjectId, double> confidence = {})
      : objects_(std::move(objects)),
        classes_(std::move(classes)),
        shown_(std::move(shown)),
        confidence_(std::move(confidence)) {}

  /// kObjectsFormat.
  [[nodiscard]] std::string_view class_name() const override;
  [[nodiscard]] bool is_flat() const override { return false; }
  [[nodiscard]] LayerStatistics statistics() const override;
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override;
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const ObjectsLayer& a, const ObjectsLayer& b) {
    return a.objects_ == b.objects_ && a.classes_ == b.classes_ && a.shown_ == b.shown_ &&
           a.confidence_ == b.confidence_;
  }

 private:
  ObjectMap objects_;
  ClassRegistry classes_;
  std::vector<ObjectId> shown_;
  std::map<ObjectId, double> confidence_;
};

}  // namespace hypermap
