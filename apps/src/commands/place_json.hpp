// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rooms, places and ways as JSON.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_places.hpp"
#include "hypermap/io/archive/vertex_places.hpp"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <vector>

namespace hypermap::app {

/// The rooms of a map, and the vertices of its topological map.
struct AskedPlaces {
  MapPlaces rooms;
  std::vector<VertexPlace> vertices;  ///< By their ids.
};

/// The error, of the flag where it names no field.
[[nodiscard]] Error for_flag(Error error, const char* flag);

[[nodiscard]] nlohmann::ordered_json json_of_point(const Eigen::Vector2d& point);
/// null where it is none.
[[nodiscard]] nlohmann::ordered_json json_of_room(const MapPlaces& places, RoomNumber number);
[[nodiscard]] nlohmann::ordered_json json_of_doorway(const Doorway& doorway);

/// To standard output; what is no UTF-8 is replaced.
void print_document(const nlohmann::ordered_json& json);

}  // namespace hypermap::app
