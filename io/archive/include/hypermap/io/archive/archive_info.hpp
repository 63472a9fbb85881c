// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is in an archive, in a few lines.
#pragma once

#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/core/places/relations.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"
#include "hypermap/projection/layers/map_layer.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// What the configuration says of a layer; flags that it leaves out are at their default.
struct LayerFlags {
  bool load_file = true;        ///< False: the layer starts empty.
  bool subscribe_mode = false;  ///< A mapper feeds the layer.
  bool enable_update = true;    ///< False: the layer takes no updates.
  friend bool operator==(const LayerFlags&, const LayerFlags&) = default;
};

/// A layer of `archive_layers`, and how much it holds.
struct LayerSummary : LayerStatistics {
  std::string name;
  std::string class_name;  ///< Of a layer; the format of an extension.
  std::string frame_id;
  bool flat = true;
  std::optional<LayerFlags> flags = {};  ///< Of layers of the hypermap; other parts have none.
  std::vector<std::string> parts = {};   ///< Names of the layers in a stack, or of its supercells.
};

/// A network whose embeddings objects have.
struct ModelSummary {
  std::string model;
  std::size_t dimension = 0;
  std::size_t num_objects = 0;  ///< Tentative ones included.
};

struct ArchiveInfo {
  std::int64_t format_version = 0;  ///< 0: the first implementation's form, nothing beyond it.
  std::vector<LayerSummary> layers;
  std::vector<std::string> classes;                 ///< In the order of their ids.
  std::vector<DetectorDescription> detectors = {};  ///< The same.
  std::size_t num_aliases = 0;  ///< Of the map's vocabulary, as its super-classes.
  std::size_t num_super_classes = 0;
  std::vector<FrameTransform> transforms;
  std::vector<Provenance> provenance;  ///< Of each run, oldest first.
  /// Of the confirmed objects (`archive_relations`), as many of each of `kRelationKinds`.
  std::array<std::size_t, kRelationKinds.size()> num_relations = {};
  std::vector<ModelSummary> models = {};  ///< In ascending order of the names.
  std::size_t num_views = 0;
  std::size_t num_vertices = 0;  ///< Of the topological map, as its edges.
  std::size_t num_edges = 0;
  MapFloor floor = {};
};

/// Cost: one pass over cells and leaves, and that of `find_relations`.
[[nodiscard]] ArchiveInfo describe(const MapArchive& archive);

/// One JSON document: `format_version`, `layers` [{`name`, `class`, `frame_id`, of layers of the
/// hypermap `load_file`, `subscribe_mode` and `enable_update`, `cells`
/// {`occupied`, `free`, `unknown`, `between`} with `grid` {`columns`, `rows`, `resolution_m`,
/// `origin` [x, y, yaw], metres and radians} where they are of one, or `objects` (of tracked ones
/// also `tentative`) or `leaves` {`occupied`, `free`} or `values`, `parts` [names] of stacks and
/// supercells, `bounds`
/// {`min`, `max`}}], `classes` [{`id`, `name`}], `detectors` [{`id`, `name`,
/// `type`, `architecture`, `classes`; null what is not stated}], `class_names` {`aliases`,
/// `super_classes`: how many}, `transforms`, `relations` {`on`,
/// `in`, `under`, `beside`, `part_of`: how many}, `embeddings` [{`model`, `dimension`, `objects`}],
/// `views`: how many, `topological_map` {`vertices`, `edges`: how many}, `floor` {`height_m`,
/// `source`: assumed, found or stated}, `sessions` [{`number`,
/// `name`, `input`, `first_s`, `last_s`; null what is not known}], `provenance` (of the
/// newest run, with the others, oldest first, in its list `earlier`; null when there is none).
[[nodiscard]] std::string to_json(const ArchiveInfo& info);

}  // namespace hypermap
