// SPDX-License-Identifier: BSD-3-Clause
#include "place_json.hpp"

#include <cstdio>

namespace hypermap::app {

using Json = nlohmann::ordered_json;

Error for_flag(Error error, const char* flag) {
  if (error.field.empty()) error.field = flag;
  return error;
}

Json json_of_point(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

Json json_of_room(const MapPlaces& places, RoomNumber number) {
  if (number == kNoRoom) return nullptr;
  const MapRoom& room = places.rooms[number - 1];
  return {{"room", number}, {"place", room.place ? Json(*room.place) : Json(nullptr)}};
}

Json json_of_doorway(const Doorway& doorway) {
  return {{"rooms", {doorway.from, doorway.to}},
          {"position", json_of_point(doorway.position)},
          {"width_m", doorway.width_m}};
}

void print_document(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace hypermap::app
