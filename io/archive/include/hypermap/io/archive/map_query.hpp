// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is where in a map, in any of its layers, flat or not.
///
/// Source: [hypermap] 3.3.1 (spatial, keyword and combined queries).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/objects/object_query.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Conditions that must all hold; those that are absent always do.
struct MapQuery {
  std::string layer = {};  ///< By its name in `archive_layers`.
  /// String representation: an object's class in any spelling, a shape's name, Free, Occupied.
  std::optional<std::string> text = std::nullopt;
  /// Integer representation: an id, a cell's occupancy.
  std::optional<std::int64_t> value = std::nullopt;
  std::optional<PlanPoint> at = std::nullopt;  ///< With a height only in layers that are not flat.
  std::optional<Polygon> area = std::nullopt;
  /// Of points and areas, in and out; empty: the layer's own.
  std::string frame_id = {};
};

/// One object found.
struct MapAnswer {
  std::uint64_t id = 0;
  std::string name;  ///< Of an object: its best class, `unknown` when none was named.
  std::int64_t value = 0;
  PlanPoint position;  ///< With a height when the layer is not flat.
  /// Of an object: what the semantic layer says, else that of its beliefs.
  std::optional<double> confidence = std::nullopt;
  std::optional<Eigen::Vector3d> size_m = std::nullopt;  ///< Of an object's box, of a voxel.
  /// Of an object in the layer of objects alone; ids are those of `MapArchive::classes`.
  std::optional<ObjectBeliefs> beliefs = std::nullopt;
  /// Of an object, when it was compared with a vector (similar_query.hpp): in -1 .. 1.
  std::optional<double> similarity = std::nullopt;
  /// Of an object, when the nearest was asked for: from the point to its centroid, in the plane
  /// when the point has no height.
  std::optional<double> distance_m = std::nullopt;
};

/// What was found, in ascending order of ids where nothing else is said, and the frame of the
/// positions.
struct MapAnswers {
  std::string frame_id;
  std::vector<MapAnswer> found;
};

/// Asks a layer of `archive_layers`. Without a condition one that is not flat tells all it has.
///
/// Boundary: an empty list is a normal answer.
/// Errors: those of hypermap_query.hpp; kNotFound for a frame that no layer and no transform has,
/// with the nearest and all that there are; kInvalidArgument, naming the member of MapQuery, when a
/// flat layer is asked nothing, at a height, for a point together with another condition, or for
/// text and value together.
[[nodiscard]] Result<MapAnswers> query_map(const MapArchive& archive, const MapQuery& query);

/// The layer that query_nearest asks: kObjectsLayer; in a map without 3D objects kSemanticLayer,
/// else the first semantic layer, if there is one and it has shapes.
[[nodiscard]] std::string nearest_layer(const MapArchive& archive);

/// Of the objects that fulfil all conditions but `at` the `count` whose centroids are nearest to
/// that point, the nearest first, of equally near ones the lowest id. The layer is nearest_layer,
/// whatever `query.layer` says.
/// Errors: those of query_map; kInvalidArgument naming `at` when it is absent, or has a height
/// where shapes are asked; kNotFound when there is no such object.
[[nodiscard]] Result<MapAnswers> query_nearest(const MapArchive& archive,
                                               const MapQuery& query,
                                               std::size_t count = 1);

}  // namespace hypermap
