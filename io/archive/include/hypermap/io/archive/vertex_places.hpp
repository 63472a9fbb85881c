// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What kind of place each vertex of a topological map is, what belongs to it, and ways along its
/// edges.
///
/// Source: [smap] 3.5.1, pseudocode 3.4: a vertex bears the classes of its place (`this_thing`) and
/// objects (`related_things`), and classes of places have traversability costs. Derived, never
/// stored, so that it is never older than the map.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/core/places/topological_routes.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_places.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct VertexPlace {
  RoomNumber room = kNoRoom;
  PlaceBelief belief = {};
  std::optional<std::string> place = {};    ///< Its class; none where nothing is probable enough.
  std::vector<std::uint64_t> objects = {};  ///< Those whose nearest vertex it is, ascending.
};

/// So many edges away objects tell of the place of a vertex that is in no room.
/// Source: [smap] 3.5.4 (layers of the graph that detections are compared with).
inline constexpr int kPlaceLayers = 3;

/// Of all vertices, by their ids; empty in a map without a topological map.
///
/// A vertex is in the room below it, else in the nearest within 0.5 m. Its place is what
/// `classifier` makes of the objects of its room at the vertices at most `kPlaceLayers` edges away:
/// so a kitchen and a bedroom that no doorway parts are two places in one room. Where no object is
/// so near it is of the room's. Objects are those of the layer `semantic` that the map has as such.
/// Requires: `places` are of `archive`. Cost: for each vertex that of the vertices and objects
/// around it.
[[nodiscard]] std::vector<VertexPlace> vertex_places(const MapArchive& archive,
                                                     const MapPlaces& places,
                                                     const PlaceClassifier& classifier);

/// The vertex whose class says what kind of place an object is in where its room's does not: the
/// one that it is nearest to. None: its room has a class, or the vertex has none or is in another
/// room, or the map has no vertex of it. Requires: `places` and `vertices` are of one map, which
/// has the object in its layer `semantic`. Cost: linear in the vertices.
[[nodiscard]] std::optional<VertexId> telling_vertex(const MapPlaces& places,
                                                     const std::vector<VertexPlace>& vertices,
                                                     std::uint64_t object);

/// In which place an object is: "the kitchen (room 2)"; by its vertex "the kitchen of room 2", and
/// "the garden" where it is in no room; else "room 3" or "no room".
/// Requires, cost: as telling_vertex.
[[nodiscard]] std::string place_name(const MapPlaces& places,
                                     const std::vector<VertexPlace>& vertices,
                                     std::uint64_t object);

/// The cheapest way along edges between the vertices nearest to two ends: where the sensor went, or
/// could have gone to an object. A metre costs what it does in the vertices' places.
/// Errors: kNotFound when the map has no topological map, or its edges do not join the two.
[[nodiscard]] Result<TopologicalRoute> find_vertex_route(const MapArchive& archive,
                                                         const std::vector<VertexPlace>& vertices,
                                                         const RouteEnd& from,
                                                         const RouteEnd& to,
                                                         const MetreCosts& metre_costs = {});

}  // namespace hypermap
