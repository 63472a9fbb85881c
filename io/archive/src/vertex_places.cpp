// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/vertex_places.hpp"

#include "hypermap/core/places/object_vertices.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "place_amounts.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// A vertex over furniture that no floor was seen through.
constexpr double kVertexReachM = 0.5;

/// Whether the rooms' floor and the vertices are in one frame.
bool shares_frame(const MapArchive& archive) {
  const Layer* floor = archive.hypermap.find(kOccupancyLayer);
  return floor != nullptr && floor->info.frame_id == shown_frame_id(archive);
}

/// The shapes among objects near a vertex that no wall parts from it. Ascending.
std::vector<std::uint64_t> shapes_near(const MapArchive& archive,
                                       const MapPlaces& places,
                                       VertexId vertex,
                                       RoomNumber room) {
  std::vector<std::uint64_t> ids;
  for (const ObjectId id :
       objects_near(*archive.topological_map, archive.objects, vertex, kPlaceLayers)) {
    const auto shape = places.room_of.find(id.value);
    if (shape == places.room_of.end()) continue;
    if (room == kNoRoom || shape->second == room) ids.push_back(id.value);
  }
  return ids;
}

/// An object's own, else the one nearest in plan: what is no object has no height.
VertexId vertex_at_end(const MapArchive& archive, const RouteEnd& end) {
  const TopologicalMap& map = *archive.topological_map;
  const Object* object =
      end.object ? archive.objects.find(ObjectId{static_cast<std::uint32_t>(*end.object)})
                 : nullptr;
  if (object != nullptr) return *vertex_of(map, *object);
  std::uint32_t nearest = 0;
  const auto away_m = [&](std::uint32_t i) {
    return (map.vertices()[i].position_in_map.head<2>() - end.position).norm();
  };
  for (std::uint32_t i = 1; i < map.vertices().size(); ++i) {
    if (away_m(i) < away_m(nearest)) nearest = i;
  }
  return VertexId{nearest};
}

}  // namespace

std::vector<VertexPlace> vertex_places(const MapArchive& archive,
                                       const MapPlaces& places,
                                       const PlaceClassifier& classifier) {
  if (!archive.topological_map) return {};
  const TopologicalMap& map = *archive.topological_map;
  std::vector<VertexPlace> vertices(map.vertices().size());
  for (const auto& [shape, room] : places.room_of) {
    const Object* object = archive.objects.find(ObjectId{static_cast<std::uint32_t>(shape)});
    const auto vertex = object == nullptr ? std::nullopt : vertex_of(map, *object);
    if (vertex) vertices[vertex->value].objects.push_back(shape);
  }
  const bool has_rooms = shares_frame(archive);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    VertexPlace& vertex = vertices[i];
    const Eigen::Vector2d position = map.vertices()[i].position_in_map.head<2>();
    if (has_rooms) vertex.room = room_at(places.plan, position, kVertexReachM);
    const auto near = shapes_near(archive, places, VertexId{i}, vertex.room);
    const bool is_told_by_room = near.empty() && vertex.room != kNoRoom;
    vertex.belief = is_told_by_room ? places.rooms[vertex.room - 1].belief
                                    : classifier.classify(amounts_of(archive, near));
    vertex.place = classifier.decide(vertex.belief);
  }
  return vertices;
}

std::optional<VertexId> telling_vertex(const MapPlaces& places,
                                       const std::vector<VertexPlace>& vertices,
                                       std::uint64_t object) {
  const RoomNumber room = places.room_of.at(object);
  if (room != kNoRoom && places.rooms[room - 1].place) return std::nullopt;
  const auto own = std::ranges::find_if(vertices, [object](const VertexPlace& vertex) {
    return std::ranges::binary_search(vertex.objects, object);
  });
  if (own == vertices.end() || own->room != room || !own->place) return std::nullopt;
  return VertexId{static_cast<std::uint32_t>(own - vertices.begin())};
}

std::string place_name(const MapPlaces& places,
                       const std::vector<VertexPlace>& vertices,
                       std::uint64_t object) {
  const RoomNumber room = places.room_of.at(object);
  const auto vertex = telling_vertex(places, vertices, object);
  if (!vertex) return room_name(places, room);
  const std::string place = "the " + *vertices[vertex->value].place;
  return room == kNoRoom ? place : place + " of " + room_name(places, room);
}

Result<TopologicalRoute> find_vertex_route(const MapArchive& archive,
                                           const std::vector<VertexPlace>& vertices,
                                           const RouteEnd& from,
                                           const RouteEnd& to,
                                           const MetreCosts& metre_costs) {
  if (vertices.empty()) {
    return fail(ErrorCode::kNotFound, "the map has no topological map, along which ways lead");
  }
  const auto cost_at = [&](VertexId id) {
    const auto& place = vertices[id.value].place;
    const auto cost = place ? metre_costs.find(*place) : metre_costs.end();
    return cost == metre_costs.end() ? 1.0 : cost->second;
  };
  const VertexId start = vertex_at_end(archive, from);
  const VertexId goal = vertex_at_end(archive, to);
  auto route = cheapest_route(*archive.topological_map, start, goal, cost_at);
  if (!route) {
    return fail(ErrorCode::kNotFound,
                "no edges of the topological map join vertex " + std::to_string(start.value) +
                    ", at " + from.name + ", and vertex " + std::to_string(goal.value) + ", at " +
                    to.name);
  }
  return *std::move(route);
}

}  // namespace hypermap
