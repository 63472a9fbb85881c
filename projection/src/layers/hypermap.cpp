// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/projection/grids/grid_patch.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <algorithm>

namespace hypermap {
namespace {

constexpr std::size_t kMaxLayerNameBytes = 200;  // leaves room for an extension within 255

bool is_allowed(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x20 && byte != 0x7F && c != '/' && c != '\\' && c != ':';
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxLayerNameBytes && name != "." && name != ".." &&
         name.front() != ' ' && name.back() != ' ' && first_bad_utf8(name) == name.size() &&
         std::all_of(name.begin(), name.end(), is_allowed);
}

template <class Layers>
auto find_layer(Layers& layers, std::string_view name) {
  return std::find_if(
      layers.begin(), layers.end(), [&](const Layer& layer) { return layer.info.name == name; });
}

/// Where a layer of this form has its place behind all others of it.
std::vector<Layer>::iterator end_of_form(std::vector<Layer>& layers, bool strict) {
  return strict ? std::find_if_not(layers.begin(), layers.end(), is_strict_form) : layers.end();
}

Unexpected of_other_class(const Layer& layer, std::string_view expected) {
  return fail(ErrorCode::kUnsupported,
              printable(layer.info.name) + " is of class " + printable(class_of(layer)) +
                  ", the update is for one of " + std::string(expected),
              "layer");
}

}  // namespace

std::string_view class_of(const Layer& layer) {
  return layer.content->class_name();
}

bool is_strict_class(std::string_view class_name) {
  return class_name == kOccupancyLayerClass || class_name == kSemanticLayerClass;
}

bool is_strict_form(const Layer& layer) {
  return is_strict_class(class_of(layer)) || layer.content.as<OpaqueLayer>() != nullptr;
}

Result<std::vector<LayerAnswer>> OpaqueLayer::query(const LayerQuery& /*query*/) const {
  return fail(ErrorCode::kUnsupported,
              "layers of class " + printable(class_name_) + " answer no query",
              "layer");
}

Result<void> OpaqueLayer::save(LayerWriter& writer) const {
  return bytes_ ? writer.bytes("", *bytes_) : Result<void>();
}

bool OpaqueLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

Result<void> validate_layer_name(std::string_view name) {
  if (is_plain_name(name)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "is '" + printable(name) + "', expected a plain name of 1 to 200 bytes, no path",
              "name");
}

Result<void> Hypermap::add_layer(Layer layer) {
  HYPERMAP_TRY(validate_layer_name(layer.info.name));
  if (layer.info.frame_id.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must not be empty", "frame_id");
  }
  if (find(layer.info.name) != nullptr) {
    return fail(
        ErrorCode::kInvalidArgument, "two layers are named " + printable(layer.info.name), "name");
  }
  if (layers_.size() >= kMaxLayers) {
    return fail(ErrorCode::kLimit, "more than " + std::to_string(kMaxLayers) + " layers", "layers");
  }
  const bool strict = is_strict_form(layer);
  if (!strict) {
    layer.info.load_file = true;
    if (!layer.info.file) layer.info.file = layer.info.name;
  }
  layers_.insert(end_of_form(layers_, strict), std::move(layer));
  return {};
}

Result<void> Hypermap::set_content(std::string_view name, LayerContent content) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* found, at(name));
  Layer layer{.info = found->info, .content = std::move(content)};
  if (is_strict_form(layer) == is_strict_form(*found)) {
    find_layer(layers_, name)->content = std::move(layer.content);
    return {};
  }
  remove_layer(layer.info.name);
  return add_layer(std::move(layer));
}

Result<void> Hypermap::put_layer(Layer layer) {
  if (find(layer.info.name) == nullptr) return add_layer(std::move(layer));
  return set_content(layer.info.name, std::move(layer.content));
}

Result<const Layer*> Hypermap::updatable(std::string_view name) const {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, at(name));
  if (layer->info.enable_update.value_or(true)) return layer;
  return fail(ErrorCode::kUnsupported,
              printable(name) + " takes no updates, as its enable_update says",
              "layer");
}

Result<void> Hypermap::update(std::string_view name, const LayerContent& update) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, updatable(name));
  HYPERMAP_ASSIGN_OR_RETURN(LayerContent content, layer->content->updated(update));
  return set_content(name, std::move(content));
}

Result<SemanticUpdateReport> Hypermap::update(std::string_view name, const SemanticUpdate& update) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, updatable(name));
  const auto* shapes = layer->content.as<SemanticLayer>();
  if (shapes == nullptr) return of_other_class(*layer, kSemanticLayerClass);
  SemanticLayer changed = *shapes;
  HYPERMAP_ASSIGN_OR_RETURN(SemanticUpdateReport report, changed.apply(update));
  HYPERMAP_TRY(set_content(name, std::move(changed)));
  return report;
}

Result<void> Hypermap::update(std::string_view name, const OccupancyGrid& part) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, updatable(name));
  const auto* cells = layer->content.as<OccupancyLayer>();
  if (cells == nullptr) return of_other_class(*layer, kOccupancyLayerClass);
  OccupancyLayer changed = *cells;
  HYPERMAP_ASSIGN_OR_RETURN(changed.grid, patched(std::move(changed.grid), part));
  return set_content(name, std::move(changed));
}

bool Hypermap::remove_layer(std::string_view name) {
  return std::erase_if(layers_, [&](const Layer& layer) { return layer.info.name == name; }) > 0;
}

const Layer* Hypermap::find(std::string_view name) const {
  const auto found = find_layer(layers_, name);
  return found == layers_.end() ? nullptr : &*found;
}

Result<const Layer*> Hypermap::at(std::string_view name) const {
  if (const Layer* found = find(name)) return found;
  std::vector<std::string> known;
  known.reserve(layers_.size());
  for (const Layer& layer : layers_) known.push_back(layer.info.name);
  return fail(ErrorCode::kNotFound, nothing_named("layer", name, known), "layer");
}

}  // namespace hypermap
