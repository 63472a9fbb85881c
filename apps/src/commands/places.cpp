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
#include "place_json.hpp"
#include "place_routes.hpp"
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
                           const AskedPlaces& places,
                           const RelationGraph& graph,
                           const SemanticObject& object) {
  const std::string place = "in " + place_name(places.rooms, places.vertices, object.id);
  const ObjectId id{static_cast<std::uint32_t>(object.id)};
  if (!support_of(graph, id)) return name_of(object) + " is " + place;
  const auto naming = [&](ObjectId other) { return called(archive, other); };
  return sentence_of(graph, id, naming, place);
}

Json json_of(const MapArchive& archive, const MapRoom& room) {
  Json json{{"room", room.room.number},
            {"place", room.place ? Json(*room.place) : Json(nullptr)},
            {"area_m2", room.room.area_m2},
            {"middle", json_of_point(room.room.middle)},
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
Result<AskedPlaces> places_of(const MapArchive& archive, PlaceRules rules) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto classifier,
      BelongingsClassifier::create(with_vocabulary(std::move(rules), archive.vocabulary)));
  HYPERMAP_ASSIGN_OR_RETURN(MapPlaces rooms, map_places(archive, classifier));
  auto vertices = vertex_places(archive, rooms, classifier);
  return AskedPlaces{.rooms = std::move(rooms), .vertices = std::move(vertices)};
}

Json json_of(const MapArchive& archive, const AskedPlaces& places, std::uint32_t vertex) {
  const VertexPlace& place = places.vertices[vertex];
  const auto& [position, kind] = archive.topological_map->vertices()[vertex];
  Json json{{"vertex", vertex},
            {"kind", name_of(kind)},
            {"position", {position.x(), position.y(), position.z()}},
            {"room", place.room == kNoRoom ? Json(nullptr) : Json(place.room)},
            {"place", place.place ? Json(*place.place) : Json(nullptr)},
            {"objects", place.objects},
            {"joined", Json::array()}};
  for (const VertexId next : archive.topological_map->neighbours(VertexId{vertex})) {
    json["joined"].push_back(next.value);
  }
  return json;
}

void print_rooms_json(const MapArchive& archive, const AskedPlaces& asked) {
  Json document{{"rooms", Json::array()}, {"doorways", Json::array()}, {"vertices", Json::array()}};
  for (const MapRoom& room : asked.rooms.rooms) {
    document["rooms"].push_back(json_of(archive, room));
  }
  for (const Doorway& one : asked.rooms.plan.doorways) {
    document["doorways"].push_back(json_of_doorway(one));
  }
  for (std::uint32_t i = 0; i < asked.vertices.size(); ++i) {
    document["vertices"].push_back(json_of(archive, asked, i));
  }
  print_document(document);
}

std::size_t num_vertices_in(const AskedPlaces& asked, RoomNumber room) {
  return static_cast<std::size_t>(std::ranges::count(asked.vertices, room, &VertexPlace::room));
}

void print_rooms(const MapArchive& archive, const AskedPlaces& asked) {
  const MapPlaces& places = asked.rooms;
  Table table({"room", "place", "P", "area m2", "middle", "vertices", "objects"},
              LastColumn::kText);
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
               std::to_string(num_vertices_in(asked, room.room.number)),
               printable(objects, 500)});
  }
  std::printf("%s%s, %s\n",
              table.text().c_str(),
              count_text(places.rooms.size(), "room").c_str(),
              count_text(places.plan.doorways.size(), "doorway").c_str());
}

/// The room of an object, what kind of place it is in, and the vertex that tells it where the room
/// does not.
Json json_of_place(const AskedPlaces& places, std::uint64_t object) {
  const RoomNumber room = places.rooms.room_of.at(object);
  const auto vertex = telling_vertex(places.rooms, places.vertices, object);
  auto place = vertex ? places.vertices[vertex->value].place : std::nullopt;
  if (!vertex && room != kNoRoom) place = places.rooms.rooms[room - 1].place;
  return {{"in", json_of_room(places.rooms, room)},
          {"place", place ? Json(*place) : Json(nullptr)},
          {"vertex", vertex ? Json(vertex->value) : Json(nullptr)}};
}

Result<void> print_place(const MapArchive& archive,
                         const AskedPlaces& places,
                         const RelationGraph& graph,
                         const std::string& name,
                         bool json) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto objects, objects_named(archive, name));
  Json document{{"results", Json::array()}};
  for (const SemanticObject* object : objects) {
    const std::string sentence = place_sentence(archive, places, graph, *object);
    if (!json) std::printf("%s\n", printable(sentence, 500).c_str());
    Json one{{"id", object->id}, {"name", object->name}};
    one.update(json_of_place(places, object->id));
    one["sentence"] = sentence;
    document["results"].push_back(std::move(one));
  }
  if (json) print_document(document);
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
  HYPERMAP_ASSIGN_OR_RETURN(const AskedPlaces places, places_of(archive, rules));
  if (arguments.route) {
    return print_route(archive, places, rules.metre_costs, *arguments.route, json);
  }
  if (arguments.place) return print_place(archive, places, graph, *arguments.place, json);
  json ? print_rooms_json(archive, places) : print_rooms(archive, places);
  return {};
}

}  // namespace hypermap::app
