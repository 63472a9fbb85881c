// SPDX-License-Identifier: BSD-3-Clause
#include "places.hpp"

#include "data_dir.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/places/relation_text.hpp"
#include "hypermap/core/places/vocabulary_rules.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_places.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMetreDigits = 2;

Error for_flag(Error error, const char* flag) {
  if (error.field.empty()) error.field = flag;
  return error;
}

Json json_of(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

Json json_of_room(const MapPlaces& places, RoomNumber number) {
  if (number == kNoRoom) return nullptr;
  const MapRoom& room = places.rooms[number - 1];
  return {{"room", number}, {"place", room.place ? Json(*room.place) : Json(nullptr)}};
}

void print_document(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

const SemanticLayer* objects_in(const MapArchive& archive) {
  return archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
}

std::string name_of(const SemanticObject& object) {
  return object.name + " " + std::to_string(object.id);
}

/// The objects that `name` means. Errors: kNotFound, telling the classes that there are.
Result<std::vector<const SemanticObject*>> objects_named(const MapArchive& archive,
                                                         const std::string& name) {
  auto meant = asked_of_map(archive, name);
  if (!meant) return Unexpected(for_flag(meant.error(), "--place"));
  std::vector<const SemanticObject*> found;
  std::set<std::string> known;
  const SemanticLayer* layer = objects_in(archive);
  const auto objects = layer == nullptr ? std::span<const SemanticObject>() : layer->objects();
  for (const SemanticObject& object : objects) {
    known.insert(object.name);
    const bool is_meant = std::to_string(object.id) == name || meant->contains(object.name);
    if (is_meant) found.push_back(&object);
  }
  if (!found.empty()) return found;
  const std::vector<std::string> names(known.begin(), known.end());
  return fail(ErrorCode::kNotFound,
              nothing_named("id or class of the map's objects", name, names),
              "--place");
}

/// "cup 12 is in the kitchen (room 2), on diningtable 3".
std::string place_sentence(const MapArchive& archive,
                           const MapPlaces& places,
                           const RelationGraph& graph,
                           const SemanticObject& object) {
  const std::string place = "in " + room_name(places, places.room_of.at(object.id));
  const ObjectId id{static_cast<std::uint32_t>(object.id)};
  if (!support_of(graph, id)) return name_of(object) + " is " + place;
  const auto naming = [&](ObjectId other) { return called(archive, other); };
  return sentence_of(graph, id, naming, place);
}

std::string route_text(const MapPlaces& places, const PlaceRoute& route) {
  std::string text =
      "from " + route.from.name + " to " + route.to.name + ": " + fixed(route.length_m, 1) + " m";
  if (route.cost != route.length_m) text += " (cost " + fixed(route.cost, 1) + ")";
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

Json json_of(const MapPlaces& places, const RouteEnd& end) {
  Json json{{"name", end.name}};
  if (end.object) json["id"] = *end.object;
  json["position"] = json_of(end.position);
  json["in"] = json_of_room(places, end.room);
  return json;
}

Json json_of(const Doorway& doorway) {
  return {{"rooms", {doorway.from, doorway.to}},
          {"position", json_of(doorway.position)},
          {"width_m", doorway.width_m}};
}

Json json_of(const MapArchive& archive, const MapRoom& room) {
  Json json{{"room", room.room.number},
            {"place", room.place ? Json(*room.place) : Json(nullptr)},
            {"area_m2", room.room.area_m2},
            {"middle", json_of(room.room.middle)},
            {"places", Json::array()},
            {"objects", Json::array()}};
  for (const PlaceProbability& one : room.belief) {
    json["places"].push_back({{"name", one.place}, {"probability", one.probability}});
  }
  for (const std::uint64_t id : room.objects) {
    json["objects"].push_back({{"id", id}, {"name", objects_in(archive)->find(id)->name}});
  }
  return json;
}

/// Errors: those of map_places.
Result<MapPlaces> places_of(const MapArchive& archive, PlaceRules rules) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto classifier,
      BelongingsClassifier::create(with_vocabulary(std::move(rules), archive.vocabulary)));
  return map_places(archive, classifier);
}

void print_rooms(const MapArchive& archive, const MapPlaces& places, bool json) {
  if (json) {
    Json document{{"rooms", Json::array()}, {"doorways", Json::array()}};
    for (const MapRoom& room : places.rooms) document["rooms"].push_back(json_of(archive, room));
    for (const Doorway& one : places.plan.doorways) document["doorways"].push_back(json_of(one));
    return print_document(document);
  }
  Table table({"room", "place", "P", "area m2", "middle", "objects"}, LastColumn::kText);
  for (const MapRoom& room : places.rooms) {
    std::string objects;
    for (const std::uint64_t id : room.objects) {
      objects += (objects.empty() ? "" : ", ") + name_of(*objects_in(archive)->find(id));
    }
    table.add({std::to_string(room.room.number),
               room.place.value_or("unknown"),
               room.belief.empty() ? "-" : fixed(room.belief.front().probability, 2),
               fixed(room.room.area_m2, 1),
               fixed(room.room.middle.x(), 2) + " " + fixed(room.room.middle.y(), 2),
               printable(objects, 500)});
  }
  std::printf("%s%s, %s\n",
              table.text().c_str(),
              count_text(places.rooms.size(), "room").c_str(),
              count_text(places.plan.doorways.size(), "doorway").c_str());
}

Result<void> print_place(const MapArchive& archive,
                         const MapPlaces& places,
                         const RelationGraph& graph,
                         const std::string& name,
                         bool json) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto objects, objects_named(archive, name));
  Json document{{"results", Json::array()}};
  for (const SemanticObject* object : objects) {
    const std::string sentence = place_sentence(archive, places, graph, *object);
    if (!json) std::printf("%s\n", printable(sentence, 500).c_str());
    document["results"].push_back({{"id", object->id},
                                   {"name", object->name},
                                   {"in", json_of_room(places, places.room_of.at(object->id))},
                                   {"sentence", sentence}});
  }
  if (json) print_document(document);
  return {};
}

Result<void> print_route(const MapArchive& archive,
                         const MapPlaces& places,
                         const MetreCosts& metre_costs,
                         const std::string& ends,
                         bool json) {
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
  if (!json) {
    std::printf("%s\n", printable(route_text(places, *route), 2000).c_str());
    return {};
  }
  Json document{{"from", json_of(places, route->from)},
                {"to", json_of(places, route->to)},
                {"length_m", route->length_m},
                {"cost", route->cost},
                {"rooms", Json::array()},
                {"doorways", Json::array()}};
  for (const RoomNumber room : route->rooms)
    document["rooms"].push_back(json_of_room(places, room));
  for (const Doorway& one : route->doorways) document["doorways"].push_back(json_of(one));
  print_document(document);
  return {};
}

}  // namespace

std::filesystem::path places_file(const std::string& given) {
  return given.empty() ? data_dir() / "places.yaml" : std::filesystem::path(given);
}

void add_place_options(CLI::App& command, PlaceArguments& arguments) {
  command.add_flag("--rooms",
                   arguments.rooms,
                   "the rooms that doorways part, what kind of place each is, what is in it");
  command.add_option("--place",
                     arguments.place,
                     "the objects of this class, or of this id: in which room each is, what it "
                     "stands on");
  command.add_option("--route",
                     arguments.route,
                     "FROM,TO: the way through doorways; each an id, a class of objects (the first "
                     "one), a place (kitchen) or \"room 2\"");
  command.add_option(
      "--places",
      arguments.rules,
      "YAML file with what belongs where, as data/places.yaml, which is the default");
}

bool asks_places(const PlaceArguments& arguments) {
  return arguments.rooms || arguments.place || arguments.route || !arguments.rules.empty();
}

std::optional<std::string> fault_of(const PlaceArguments& arguments, bool asks_more) {
  const int num_asked = static_cast<int>(arguments.rooms) +
                        static_cast<int>(arguments.place.has_value()) +
                        static_cast<int>(arguments.route.has_value());
  if (num_asked == 0) return "--places is of --rooms, --place and --route";
  if (num_asked > 1 || asks_more) {
    return "--rooms, --place and --route ask one thing each: no other condition goes with them";
  }
  return std::nullopt;
}

Result<void> print_places(const MapArchive& archive,
                          const PlaceArguments& arguments,
                          const RelationGraph& graph,
                          bool json) {
  HYPERMAP_ASSIGN_OR_RETURN(const PlaceRules rules, read_place_rules(places_file(arguments.rules)));
  HYPERMAP_ASSIGN_OR_RETURN(const MapPlaces places, places_of(archive, rules));
  if (arguments.route) {
    return print_route(archive, places, rules.metre_costs, *arguments.route, json);
  }
  if (arguments.place) return print_place(archive, places, graph, *arguments.place, json);
  print_rooms(archive, places, json);
  return {};
}

}  // namespace hypermap::app
