// SPDX-License-Identifier: BSD-3-Clause
#include "place_routes.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "tables.hpp"

#include <cstdio>
#include <string_view>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMetreDigits = 2;

/// " (cost 9.1)", where it reads otherwise than the length.
std::string cost_text(double cost, double length_m) {
  const std::string text = fixed(cost, 1);
  return text == fixed(length_m, 1) ? "" : " (cost " + text + ")";
}

std::string route_text(const MapPlaces& places, const PlaceRoute& route) {
  std::string text =
      "from " + route.from.name + " to " + route.to.name + ": " + fixed(route.length_m, 1) + " m";
  text += cost_text(route.cost, route.length_m);
  text += ", ";
  if (route.doorways.empty()) return text + "within " + room_name(places, route.from.room);
  text += "out of " + room_name(places, route.from.room);
  for (std::size_t i = 0; i < route.doorways.size(); ++i) {
    const Doorway& doorway = route.doorways[i];
    text += ", by the doorway at " + fixed(doorway.position.x(), kMetreDigits) + "," +
            fixed(doorway.position.y(), kMetreDigits) + " (" +
            fixed(doorway.width_m, kMetreDigits) + " m wide) into " +
            room_name(places, route.rooms[i + 1]);
  }
  return text;
}

/// "along the topological map: 7.4 m over 8 edges: 3, 4, ...".
std::string way_text(const TopologicalRoute& way) {
  std::string text = "along the topological map: " + fixed(way.length_m, 1) + " m";
  text += cost_text(way.cost, way.length_m);
  text += " over " + count_text(way.vertices.size() - 1, "edge") + ": ";
  for (std::size_t i = 0; i < way.vertices.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(way.vertices[i].value);
  }
  return text;
}

Json json_of(const MapPlaces& places, const RouteEnd& end) {
  Json json{{"name", end.name}};
  if (end.object) json["id"] = *end.object;
  json["position"] = json_of_point(end.position);
  json["in"] = json_of_room(places, end.room);
  return json;
}

Json json_of(const MapArchive& archive, const TopologicalRoute& way) {
  Json json{{"length_m", way.length_m}, {"cost", way.cost}, {"vertices", Json::array()}};
  for (const VertexId id : way.vertices) {
    const Eigen::Vector3d& at = archive.topological_map->vertices()[id.value].position_in_map;
    json["vertices"].push_back({{"vertex", id.value}, {"position", {at.x(), at.y(), at.z()}}});
  }
  return json;
}

}  // namespace

Result<void> print_route(const MapArchive& archive,
                         const AskedPlaces& asked,
                         const MetreCosts& metre_costs,
                         const std::string& ends,
                         bool json) {
  const MapPlaces& places = asked.rooms;
  const std::size_t comma = ends.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == ends.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be FROM,TO, each an id, a class, a place or \"room N\", is \"" +
                    printable(ends) + "\"",
                "route");
  }
  const auto from = route_end(archive, places, std::string_view(ends).substr(0, comma));
  if (!from) return Unexpected(for_flag(from.error(), "--route"));
  const auto to = route_end(archive, places, std::string_view(ends).substr(comma + 1));
  if (!to) return Unexpected(for_flag(to.error(), "--route"));
  const auto route = find_place_route(places, *from, *to, metre_costs);
  if (!route) return Unexpected(for_flag(route.error(), "--route"));
  const auto way = find_vertex_route(archive, asked.vertices, *from, *to, metre_costs);
  if (!json) {
    std::printf("%s\n", printable(route_text(places, *route), 2000).c_str());
    if (way) std::printf("%s\n", way_text(*way).c_str());
    return {};
  }
  Json document{{"from", json_of(places, route->from)},
                {"to", json_of(places, route->to)},
                {"length_m", route->length_m},
                {"cost", route->cost},
                {"rooms", Json::array()},
                {"doorways", Json::array()},
                {"way", way ? json_of(archive, *way) : Json(nullptr)}};
  for (const RoomNumber room : route->rooms)
    document["rooms"].push_back(json_of_room(places, room));
  for (const Doorway& one : route->doorways) document["doorways"].push_back(json_of_doorway(one));
  print_document(document);
  return {};
}

}  // namespace hypermap::app
