// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is in an archive, in a few lines.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/frame_tree.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// A layer or an extension, and how much it holds. `cells`, `num_objects` and `leaves`: the one
/// that its kind has.
struct LayerSummary {
  std::string name;
  std::string class_name;  ///< Of a layer; the format of an extension.
  std::string frame_id;
  std::optional<OccupancyCounts> cells = {};
  std::optional<std::size_t> num_objects = {};    ///< That the map shows.
  std::optional<std::size_t> num_tentative = {};  ///< Of tracked objects: not sure enough yet.
  std::optional<LeafCount> leaves = {};
  /// In the layer's frame; z is 0 where the layer is flat. None when it is empty.
  std::optional<Eigen::AlignedBox3d> bounds = {};
  bool flat = true;
};

struct ArchiveInfo {
  std::int64_t format_version = 0;  ///< 0: the first implementation's form, nothing beyond it.
  std::vector<LayerSummary> layers;
  std::vector<std::string> classes;  ///< In the order of their ids.
  std::vector<FrameTransform> transforms;
  std::optional<Provenance> provenance;
};

/// Cost: one pass over cells and leaves.
[[nodiscard]] ArchiveInfo describe(const MapArchive& archive);

/// One JSON document: `format_version`, `layers` [{`name`, `class`, `frame_id`, `cells`
/// {`occupied`, `free`, `unknown`, `between`} or `objects` (of tracked ones also `tentative`) or
/// `leaves` {`occupied`, `free`}, `bounds` {`min`, `max`}}], `classes` [{`id`, `name`}],
/// `transforms`, `provenance`.
[[nodiscard]] std::string to_json(const ArchiveInfo& info);

}  // namespace hypermap
