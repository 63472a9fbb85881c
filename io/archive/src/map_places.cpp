// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_places.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/cleared_floor.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/grids/low_obstacles.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "place_amounts.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <span>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

/// An object whose shape is in no room: beyond the wall that it hangs at.
constexpr double kRoomReachM = 0.5;

std::span<const SemanticObject> shapes_of(const MapArchive& archive) {
  const auto* layer = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  return layer == nullptr ? std::span<const SemanticObject>() : layer->objects();
}

/// The floor without what stands on it: objects, and what was looked over. Errors: those of
/// map_places.
Result<OccupancyGrid> cleared_floor(const MapArchive& archive) {
  const Layer* occupancy = archive.hypermap.find(kOccupancyLayer);
  if (occupancy == nullptr || occupancy->content.as<OccupancyLayer>() == nullptr) {
    return fail(ErrorCode::kNotFound,
                "the map has no occupancy grid of that name, by which rooms are told",
                std::string(kOccupancyLayer));
  }
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyLayer floor, without_objects(archive, *occupancy));
  const bool has_heights = archive.octree && occupancy->info.frame_id == shown_frame_id(archive);
  if (!has_heights) return std::move(floor.grid);
  return without_low_obstacles(
      std::move(floor.grid), leaf_source(*archive.octree), {.floor = archive.floor});
}

RoomNumber room_of_shape(const RoomPlan& plan, const SemanticObject& object) {
  std::map<RoomNumber, double> cells;
  for (const Polygon& part : object.parts) {
    for_each_covered_cell(plan.geometry, part, [&](Cell cell, double covered) {
      const RoomNumber room = plan.cells[plan.geometry.index(cell)];
      if (room != kNoRoom) cells[room] += covered;
    });
  }
  const auto most = std::ranges::max_element(
      cells, [](const auto& a, const auto& b) { return a.second < b.second; });
  return most != cells.end() ? most->first : room_at(plan, position_of(object), kRoomReachM);
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<RouteEnd> end_at_object(const MapPlaces& places, const SemanticObject& object) {
  const RoomNumber room = places.room_of.at(object.id);
  const std::string name = object.name + " " + std::to_string(object.id);
  if (room == kNoRoom) return fail(ErrorCode::kNotFound, printable(name) + " is in no room");
  return RouteEnd{.name = name, .object = object.id, .position = position_of(object), .room = room};
}

RouteEnd end_in_room(const MapPlaces& places, RoomNumber room) {
  return {.name = room_name(places, room),
          .position = places.rooms[room - 1].room.middle,
          .room = room};
}

/// The room that a text names; none when it names none.
std::optional<RoomNumber> room_named(const MapPlaces& places,
                                     const NameSelection& names,
                                     std::string_view text) {
  constexpr std::string_view kRoom = "room ";
  if (text.starts_with(kRoom)) {
    const auto number = number_in(text.substr(kRoom.size()));
    if (number && *number > 0 && *number <= places.rooms.size()) {
      return static_cast<RoomNumber>(*number);
    }
  }
  const auto found = std::ranges::find_if(
      places.rooms, [&](const MapRoom& one) { return one.place && names.contains(*one.place); });
  if (found == places.rooms.end()) return std::nullopt;
  return found->room.number;
}

}  // namespace

Result<MapPlaces> map_places(const MapArchive& archive,
                             const PlaceClassifier& classifier,
                             const RoomOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const OccupancyGrid floor, cleared_floor(archive));
  MapPlaces places{.plan = find_rooms(floor, options), .rooms = {}, .room_of = {}};
  places.rooms.reserve(places.plan.rooms.size());
  for (const Room& room : places.plan.rooms) places.rooms.push_back({.room = room});
  for (const SemanticObject& object : shapes_of(archive)) {
    const RoomNumber room = room_of_shape(places.plan, object);
    places.room_of[object.id] = room;
    if (room != kNoRoom) places.rooms[room - 1].objects.push_back(object.id);
  }
  for (MapRoom& room : places.rooms) {
    room.belief = classifier.classify(amounts_of(archive, room.objects));
    room.place = classifier.decide(room.belief);
  }
  return places;
}

std::string room_name(const MapPlaces& places, RoomNumber room) {
  if (room == kNoRoom) return "no room";
  const std::string number = "room " + std::to_string(room);
  const auto& place = places.rooms[room - 1].place;
  return place ? "the " + *place + " (" + number + ")" : number;
}

Result<RouteEnd> route_end(const MapArchive& archive,
                           const MapPlaces& places,
                           std::string_view text) {
  const std::span<const SemanticObject> shapes = shapes_of(archive);
  if (const auto id = number_in(text)) {
    const auto found = std::ranges::find(shapes, *id, &SemanticObject::id);
    if (found != shapes.end()) return end_at_object(places, *found);
    return fail(ErrorCode::kNotFound, "no object has the id " + std::string(text));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const NameSelection asked, asked_of_map(archive, text));
  if (const auto room = room_named(places, asked, text)) return end_in_room(places, *room);
  const auto of_class = std::ranges::find_if(
      shapes, [&](const SemanticObject& one) { return asked.contains(one.name); });
  if (of_class != shapes.end()) return end_at_object(places, *of_class);
  std::set<std::string> known;
  for (const SemanticObject& one : shapes) known.insert(one.name);
  for (const MapRoom& one : places.rooms) {
    known.insert("room " + std::to_string(one.room.number));
    if (one.place) known.insert(*one.place);
  }
  const std::vector<std::string> names(known.begin(), known.end());
  return fail(ErrorCode::kNotFound, nothing_named("room, place or class of objects", text, names));
}

Result<PlaceRoute> find_place_route(const MapPlaces& places,
                                    const RouteEnd& from,
                                    const RouteEnd& to,
                                    const MetreCosts& metre_costs) {
  const auto cost_in = [&](RoomNumber room) {
    const std::optional<std::string>& place = places.rooms[room - 1].place;
    const auto cost = place ? metre_costs.find(*place) : metre_costs.end();
    return cost == metre_costs.end() ? 1.0 : cost->second;
  };
  auto doorways = doorways_between(places.plan, from.room, to.room, cost_in);
  if (!doorways) {
    return fail(ErrorCode::kNotFound,
                "no doorways that the map knows lead from " + room_name(places, from.room) +
                    " to " + room_name(places, to.room));
  }
  PlaceRoute route{.from = from, .to = to, .rooms = {from.room}, .doorways = {}};
  Eigen::Vector2d at = from.position;
  const auto go_to = [&](const Eigen::Vector2d& next) {
    const double step_m = (next - at).norm();
    route.length_m += step_m;
    route.cost += step_m * cost_in(route.rooms.back());
    at = next;
  };
  for (const Doorway& doorway : *doorways) {
    go_to(doorway.position);
    const bool is_forward = doorway.from == route.rooms.back();
    route.rooms.push_back(is_forward ? doorway.to : doorway.from);
  }
  go_to(to.position);
  route.doorways = std::move(*doorways);
  return route;
}

}  // namespace hypermap
