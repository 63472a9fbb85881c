// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// `hmap_config.yaml`: which layers and extensions a map archive has, and in which files they lie.
///
/// Source: [hypermap] 3.3.5, and the archives that its first implementation wrote: `layers` and
/// `transforms`. Ours adds `extensions`, a key that the first implementation ignores.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/source_name.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/hypermap.hpp"
#include "hypermap/projection/layers/layer_registry.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The member that every archive has by this name.
inline constexpr std::string_view kConfigName = "hmap_config.yaml";
/// What this version writes and the newest that it reads; 0 stands for the first implementation's
/// archives, which say nothing.
inline constexpr std::int64_t kArchiveFormatVersion = 1;

/// A layer as the configuration describes it; content comes from its file.
struct LayerEntry {
  std::string class_name;
  LayerInfo info;
  friend bool operator==(const LayerEntry&, const LayerEntry&) = default;
};

/// Formats of extensions that are read here, all at version 1. `octomap` is any `.ot` or `.bt`.
inline constexpr std::string_view kOctomapFormat = "octomap";
/// The occupancy of the semantic octree alone, for OctoMap's own programs; never read back.
inline constexpr std::string_view kOctreeTwinFormat = "hypermap-octree-twin";
inline constexpr std::string_view kObjectsFormat = "hypermap-objects";
inline constexpr std::string_view kEmbeddingsFormat = "hypermap-embeddings";
inline constexpr std::string_view kViewsFormat = "hypermap-views";
inline constexpr std::string_view kTopologicalMapFormat = "hypermap-topological-map";
inline constexpr std::string_view kClassesFormat = "hypermap-classes";
inline constexpr std::string_view kDetectorsFormat = "hypermap-detectors";
inline constexpr std::string_view kVocabularyFormat = "hypermap-vocabulary";
inline constexpr std::string_view kClassGridFormat = "hypermap-class-grid";
inline constexpr std::string_view kProvenanceFormat = "hypermap-provenance";
inline constexpr std::string_view kCheckpointFormat = "hypermap-checkpoint";
inline constexpr std::string_view kTrueSurfacesFormat = "hypermap-true-surfaces";

/// A part of the map beyond the strict form: of a known format, or a layer whose class, registered
/// by whoever reads, is the format.
struct ExtensionEntry {
  std::string format;
  std::int64_t version = 1;
  std::string name = {};
  std::string frame_id = "map";
  /// Member name; of a class grid and a registered layer the stem.
  std::string file = {};
  ValueTree extra = {};  ///< All other keys, as a map; null when there are none.
  friend bool operator==(const ExtensionEntry&, const ExtensionEntry&) = default;
};

struct HypermapConfig {
  std::int64_t format_version = 0;
  std::vector<LayerEntry> layers = {};
  FrameTree frames = {};
  std::vector<ExtensionEntry> extensions = {};
  /// Extensions of other formats, whole, as they are.
  std::vector<ValueTree> foreign_extensions = {};
  ValueTree extra = {};  ///< All other keys, as a map; null when there are none.
  friend bool operator==(const HypermapConfig&, const HypermapConfig&) = default;
};

/// The member names that a layer's or extension's file may have are checked when it is read, since
/// a configuration on disk may name files anywhere.
///
/// Extensions whose format is a class of `layers` beyond the strict form are known ones.
///
/// Findings: unknown keys, with the nearest known one; extensions of unknown format. Both are kept.
/// Errors: kMalformedFile naming field and line (a missing key, a wrong type, a name that is not
/// plain or there twice, a transform that closes a loop); kUnsupported "written by a newer version
/// N"; kLimit for too many layers or extensions.
[[nodiscard]] Result<Loaded<HypermapConfig>> parse_hypermap_config(
    std::string_view bytes, const SourceName& source, const LayerRegistry& layers = {});

/// The strict form first: layers, transforms; then format_version, extensions, other keys.
/// Boundary: without layers the list is there, empty; without extensions their key and
/// format_version are not written.
[[nodiscard]] std::string write_hypermap_config(const HypermapConfig& config);

}  // namespace hypermap
