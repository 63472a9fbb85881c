// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Several maps of different kinds as layers of one, each in a frame, with the transforms between
/// the frames.
///
/// Source: [hypermap] 3.2 (F1, F3, F4, F6), 3.3.2, 3.3.3, 3.3.5.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/map_layer.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "hypermap/projection/layers/semantic_update.hpp"

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {

/// A member of an archive that is not understood, byte for byte.
struct OpaqueFile {
  std::string name;
  std::string bytes;
  friend bool operator==(const OpaqueFile&, const OpaqueFile&) = default;
};

/// A layer of a class that nobody registered: kept, saved again, answers no query.
class OpaqueLayer final : public MapLayer {
 public:
  explicit OpaqueLayer(std::string name_of_class, std::optional<std::string> file_bytes = {})
      : class_name_(std::move(name_of_class)), bytes_(std::move(file_bytes)) {}

  [[nodiscard]] std::string_view class_name() const override { return class_name_; }
  [[nodiscard]] LayerStatistics statistics() const override { return {}; }
  /// Errors: kUnsupported, always.
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& query) const override;
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override { return {}; }
  [[nodiscard]] Result<void> save(LayerWriter& writer) const override;
  [[nodiscard]] bool equals(const MapLayer& other) const override;

  friend bool operator==(const OpaqueLayer& a, const OpaqueLayer& b) {
    return a.class_name_ == b.class_name_ && a.bytes_ == b.bytes_;
  }

 private:
  std::string class_name_;
  std::optional<std::string> bytes_;  ///< Of its file, when it has one.
};

/// What the configuration says of a layer. An absent flag stays absent on save.
struct LayerInfo {
  std::string name;  ///< Unique; a plain file name (no path).
  std::string frame_id = "map";
  bool load_file = true;                 ///< False: the layer starts empty.
  std::optional<std::string> file = {};  ///< Stem (occupancy) or member name; the name when absent.
  std::optional<bool> subscribe_mode = {};         ///< False when absent.
  std::optional<bool> enable_update = {};          ///< True when absent.
  std::optional<bool> publish_global_topics = {};  ///< False when absent.
  ValueTree extra = {};  ///< Unknown keys, as a map; null when there are none.
  friend bool operator==(const LayerInfo&, const LayerInfo&) = default;
};

struct Layer {
  LayerInfo info;
  LayerContent content;
  friend bool operator==(const Layer&, const Layer&) = default;
};

/// The class name of the content.
[[nodiscard]] std::string_view class_of(const Layer& layer);

/// Whether the first implementation knows the class: OccupancyGridLayer or SemanticLayer.
[[nodiscard]] bool is_strict_class(std::string_view class_name);
/// Whether the first implementation's form of archives has the layer among its own: of a class that
/// it knows, or of one that stood there unknown. All others are extensions of an archive.
[[nodiscard]] bool is_strict_form(const Layer& layer);

/// Errors: kInvalidArgument unless `name` is plain: 1 to 200 bytes of UTF-8 without control
/// characters, slash, backslash or colon, not "." or "..", no blank at either end.
[[nodiscard]] Result<void> validate_layer_name(std::string_view name);

/// Layers in the order of the configuration (those of the strict form come first), frames, and
/// unknown keys.
///
/// A value: copy it, compare it; a reader fills one aside and swaps it in.
class Hypermap {
 public:
  static constexpr std::size_t kMaxLayers = 256;

  /// Behind those of its form. An extension is always loaded from a file: its name when it has
  /// none. Errors: kInvalidArgument for a name that is not plain or that another layer bears, or an
  /// empty frame_id; kLimit beyond kMaxLayers.
  [[nodiscard]] Result<void> add_layer(Layer layer);
  /// Gives a layer new content; one that changes its form moves behind those of the new one.
  /// Errors: kNotFound.
  [[nodiscard]] Result<void> set_content(std::string_view name, LayerContent content);
  /// set_content of the layer of that name where there is one, else add_layer. Errors: of both.
  [[nodiscard]] Result<void> put_layer(Layer layer);
  /// Lets a layer take an update of its class in, as its type does it (MapLayer::updated).
  /// Errors: kNotFound; kUnsupported when the layer's enable_update is false; those of the type.
  /// The layer is then as it was.
  [[nodiscard]] Result<void> update(std::string_view name, const LayerContent& update);
  /// The same with single changes of a semantic layer, all or none. Errors: also kUnsupported for a
  /// layer of another type; those of SemanticLayer::apply. Cost: of a copy of the layer, which
  /// others may share.
  [[nodiscard]] Result<SemanticUpdateReport> update(std::string_view name,
                                                    const SemanticUpdate& update);
  /// The same with the cells of a part of an occupancy layer, in the frame of the layer; its bounds
  /// stay. Errors: as above; those of patched.
  [[nodiscard]] Result<void> update(std::string_view name, const OccupancyGrid& part);
  /// Whether there was one.
  bool remove_layer(std::string_view name);

  [[nodiscard]] std::span<const Layer> layers() const noexcept { return layers_; }
  [[nodiscard]] const Layer* find(std::string_view name) const;
  /// The content of a layer that is there and of this type; else null.
  template <std::derived_from<MapLayer> T>
  [[nodiscard]] const T* find_as(std::string_view name) const {
    const Layer* layer = find(name);
    return layer == nullptr ? nullptr : layer->content.as<T>();
  }
  /// The layer, or kNotFound naming the layers there are.
  [[nodiscard]] Result<const Layer*> at(std::string_view name) const;

  [[nodiscard]] const FrameTree& frames() const noexcept { return frames_; }
  [[nodiscard]] FrameTree& frames() noexcept { return frames_; }

  /// Unknown keys of the configuration, as a map; null when there are none.
  [[nodiscard]] const ValueTree& extra() const noexcept { return extra_; }
  void set_extra(ValueTree extra) { extra_ = std::move(extra); }

  friend bool operator==(const Hypermap&, const Hypermap&) = default;

 private:
  /// The layer, if its flag allows updates.
  [[nodiscard]] Result<const Layer*> updatable(std::string_view name) const;

  std::vector<Layer> layers_;
  FrameTree frames_;
  ValueTree extra_;
};

}  // namespace hypermap
