// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Several maps of different kinds as layers of one, each in a frame, with the transforms between
/// the frames.
///
/// Source: [hypermap] 3.2 (F1, F3, F4, F6), 3.3.2, 3.3.3, 3.3.5.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "hypermap/core/base/value_tree.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hypermap {

inline constexpr std::string_view kOccupancyLayerClass = "OccupancyGridLayer";
inline constexpr std::string_view kSemanticLayerClass = "SemanticLayer";

/// An occupancy grid and what its metadata file says beyond it.
struct OccupancyLayer {
  OccupancyGrid grid;
  ValueTree extra = {};  ///< Unknown keys of the metadata, as a map; null when there are none.
  friend bool operator==(const OccupancyLayer&, const OccupancyLayer&) = default;
};

/// A file of a layer that is not understood, byte for byte.
struct OpaqueFile {
  std::string name;  ///< Member name in the archive.
  std::string bytes;
  friend bool operator==(const OpaqueFile&, const OpaqueFile&) = default;
};

/// A layer of a class that is not known here: kept, saved again, answers no query.
struct OpaqueLayer {
  std::string class_name;
  std::vector<OpaqueFile> files = {};
  friend bool operator==(const OpaqueLayer&, const OpaqueLayer&) = default;
};

/// A new kind of layer is added here, in hypermap_query.cpp and in the archive's layer files; the
/// compiler names each place that must know it.
using LayerContent = std::variant<OccupancyLayer, SemanticLayer, OpaqueLayer>;

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

/// `OccupancyGridLayer`, `SemanticLayer`, or the class name of an opaque layer.
[[nodiscard]] std::string_view class_of(const Layer& layer);

/// Errors: kInvalidArgument unless `name` is plain: 1 to 200 bytes of UTF-8 without control
/// characters, slash, backslash or colon, not "." or "..", no blank at either end.
[[nodiscard]] Result<void> validate_layer_name(std::string_view name);

/// Layers in the order of the configuration, frames, and keys that nobody knows.
///
/// A value: copy it, compare it; a reader fills one aside and swaps it in.
class Hypermap {
 public:
  static constexpr std::size_t kMaxLayers = 256;

  /// Errors: kInvalidArgument for a name that is not plain or that another layer bears, or an empty
  /// frame_id; kLimit beyond kMaxLayers.
  [[nodiscard]] Result<void> add_layer(Layer layer);
  /// Gives a layer new content. Errors: kNotFound.
  [[nodiscard]] Result<void> set_content(std::string_view name, LayerContent content);
  /// Whether there was one.
  bool remove_layer(std::string_view name);

  [[nodiscard]] std::span<const Layer> layers() const noexcept { return layers_; }
  [[nodiscard]] const Layer* find(std::string_view name) const;
  /// The layer, or kNotFound naming the layers there are.
  [[nodiscard]] Result<const Layer*> at(std::string_view name) const;

  [[nodiscard]] const FrameTree& frames() const noexcept { return frames_; }
  [[nodiscard]] FrameTree& frames() noexcept { return frames_; }

  /// Unknown keys of the configuration, as a map; null when there are none.
  [[nodiscard]] const ValueTree& extra() const noexcept { return extra_; }
  void set_extra(ValueTree extra) { extra_ = std::move(extra); }

  friend bool operator==(const Hypermap&, const Hypermap&) = default;

 private:
  std::vector<Layer> layers_;
  FrameTree frames_;
  ValueTree extra_;
};

}  // namespace hypermap
