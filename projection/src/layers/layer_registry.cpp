// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/layer_registry.hpp"

#include "hypermap/projection/layers/hypermap.hpp"

#include <utility>

namespace hypermap {
namespace {

Result<LayerContent> load_occupancy(LayerReader& reader) {
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyLayer layer, reader.grid(""));
  return LayerContent(std::move(layer));
}

Result<LayerContent> load_semantic(LayerReader& reader) {
  HYPERMAP_ASSIGN_OR_RETURN(SemanticLayer layer, reader.shapes(""));
  return LayerContent(std::move(layer));
}

}  // namespace

LayerRegistry::LayerRegistry() {
  types_.emplace(kOccupancyLayerClass, LayerType{OccupancyLayer(), load_occupancy});
  types_.emplace(kSemanticLayerClass, LayerType{SemanticLayer(), load_semantic});
}

Result<void> LayerRegistry::add(LayerContent empty, LayerLoader load) {
  const std::string class_name(empty->class_name());
  if (auto plain = validate_layer_name(class_name); !plain) {
    return fail(ErrorCode::kInvalidArgument, plain.error().what, "class_name");
  }
  LayerType type{std::move(empty), std::move(load)};
  if (types_.emplace(class_name, std::move(type)).second) return {};
  return fail(ErrorCode::kInvalidArgument,
              "a layer of class " + printable(class_name, 40) + " is registered already",
              "class_name");
}

const LayerType* LayerRegistry::find(std::string_view class_name) const {
  const auto found = types_.find(class_name);
  return found == types_.end() ? nullptr : &found->second;
}

}  // namespace hypermap
