// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a layer can be asked, and what it answers.
///
/// Source: [hypermap] 3.3.1 (spatial and keyword queries), 3.3.3 (string and integer
/// representations), table 2.
#pragma once

#include "hypermap/core/geometry/plan_point.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/vocabulary/name_selection.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>

namespace hypermap {

/// Conditions that must all hold; those that are absent always do.
///
/// getString is `at`, getStrings `area`, getCoords `text`, getCoordsArea `text` with `area`; the
/// integer queries go by `value`. Frame: the layer's.
struct LayerQuery {
  /// The string representation is one of these names.
  std::optional<NameSelection> text = std::nullopt;
  std::optional<std::int64_t> value = std::nullopt;  ///< The integer representation is this one.
  std::optional<PlanPoint> at = std::nullopt;  ///< It is at this point; flat layers ignore heights.
  /// It is in this area: objects that touch it are, cells must share area with it.
  std::optional<Polygon> area = std::nullopt;
};

/// One object found.
struct LayerAnswer {
  std::uint64_t id = 0;    ///< Of the object; of a grid's cell its place in row-major order.
  std::string name;        ///< String representation: the object's name; Free, Occupied, Unknown.
  std::int64_t value = 0;  ///< Integer representation: the object's id; the cell's occupancy,
                           ///< -1..100.
  Eigen::Vector2d position =
      Eigen::Vector2d::Zero();  ///< Centroid or cell centre, in the query's frame.
  /// That the object is there and is what it is called, in [0, 1], when the layer knows it. Cells
  /// and voxels have none: their occupancy is `value`.
  std::optional<double> confidence = {};
  std::optional<double> z_m = {};  ///< Height of the position; none in flat layers.
  /// Extent along the axes of the layer's frame; none in flat layers.
  std::optional<Eigen::Vector3d> size_m = {};
  /// Of an object of the 3D map, with the class ids of that map; others have none.
  std::optional<ObjectBeliefs> beliefs = {};
};

/// Whether string and integer representation are those that `query` asks for.
[[nodiscard]] inline bool has_representation(const LayerAnswer& answer, const LayerQuery& query) {
  return (!query.text || query.text->contains(answer.name)) &&
         (!query.value || *query.value == answer.value);
}

}  // namespace hypermap
