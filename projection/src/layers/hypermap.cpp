// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/hypermap.hpp"

#include "hypermap/core/base/utf8.hpp"

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

struct ClassName {
  std::string_view operator()(const OccupancyLayer& /*layer*/) const {
    return kOccupancyLayerClass;
  }
  std::string_view operator()(const SemanticLayer& /*layer*/) const { return kSemanticLayerClass; }
  std::string_view operator()(const OpaqueLayer& layer) const { return layer.class_name; }
};

}  // namespace

std::string_view class_of(const Layer& layer) {
  return std::visit(ClassName(), layer.content);
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
  layers_.push_back(std::move(layer));
  return {};
}

Result<void> Hypermap::set_content(std::string_view name, LayerContent content) {
  HYPERMAP_TRY(at(name));
  find_layer(layers_, name)->content = std::move(content);
  return {};
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
  std::string known;
  for (const Layer& layer : layers_) known += (known.empty() ? "" : ", ") + layer.info.name;
  return fail(
      ErrorCode::kNotFound,
      "no layer is named " + printable(name) + "; there are: " + (known.empty() ? "none" : known),
      "layer");
}

}  // namespace hypermap
