// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In which room of a map each object is, what kind of place each room is, and the way from one to
/// another.
///
/// Source: [smap] 3.5.1 (places have classes and objects). Ours: rooms by doorways (rooms.hpp).
/// Derived, never stored, so that it is never older than the map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/grids/rooms.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// A room and what is in it.
struct MapRoom {
  Room room;
  PlaceBelief belief = {};
  std::optional<std::string> place = {};    ///< Its class; none where nothing is probable enough.
  std::vector<std::uint64_t> objects = {};  ///< Ids of the layer `semantic`, ascending.
};

struct MapPlaces {
  RoomPlan plan;
  std::vector<MapRoom> rooms;                   ///< By number.
  std::map<std::uint64_t, RoomNumber> room_of;  ///< Of each object; kNoRoom where it is in none.
};

/// The rooms of the layer `occupancy`, from which the shapes of the layer `semantic` are removed,
/// as furniture is no wall, and, in a map with an octree in the same frame, what was looked over
/// (`without_low_obstacles`), named or not. An object is in the room that most of its shape lies
/// in, else in the nearest one within 0.5 m. A room has the class of its objects: with all that is
/// believed of them where the map has them, else by their names.
///
/// Errors: kNotFound when the map has no occupancy grid of that name, kUnsupported when the two
/// layers are in different frames. Cost: that of find_rooms, and the cells that shapes cover.
[[nodiscard]] Result<MapPlaces> map_places(const MapArchive& archive,
                                           const PlaceClassifier& classifier,
                                           const RoomOptions& options = {});

/// "the kitchen (room 2)", "room 3" where its class is unknown, "no room".
[[nodiscard]] std::string room_name(const MapPlaces& places, RoomNumber room);

/// An end of a way: an object, or the middle of a room.
struct RouteEnd {
  std::string name;  ///< "cup 12", "the kitchen (room 2)"
  std::optional<std::uint64_t> object = std::nullopt;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  RoomNumber room = kNoRoom;
};

/// What a text names: an object's id, "room 2", a class of places (the largest room of it), or a
/// class of objects in any spelling (the object of the lowest id).
/// Errors: kNotFound, telling what there is; that an object is in no room.
[[nodiscard]] Result<RouteEnd> route_end(const MapArchive& archive,
                                         const MapPlaces& places,
                                         std::string_view text);

/// A way through doorways.
struct PlaceRoute {
  RouteEnd from;
  RouteEnd to;
  std::vector<RoomNumber> rooms;  ///< That it leads through, both ends included.
  std::vector<Doorway> doorways;  ///< Between them.
  double length_m = 0.0;          ///< Straight from one to the next.
  double cost = 0.0;              ///< The same, each metre at what it costs in its room.
};

/// What a metre of way costs in places of a class, > 0; 1 in those that are not there.
using MetreCosts = std::map<std::string, double, std::less<>>;

/// The cheapest way. Errors: kNotFound when no doorways join their rooms, as far as the map knows.
[[nodiscard]] Result<PlaceRoute> find_place_route(const MapPlaces& places,
                                                  const RouteEnd& from,
                                                  const RouteEnd& to,
                                                  const MetreCosts& metre_costs = {});

}  // namespace hypermap
