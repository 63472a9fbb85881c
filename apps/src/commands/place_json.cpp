// SPDX-License-Identifier: BSD-3-Clause
#include "place_json.hpp"

#include <cstdio>

namespace hypermap::app {

Error for_flag(Error error, const char* flag) {
  if (error.field.empty()) error.field = flag;
  return error;
}

nlohmann::ordered_json json_of_point(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

nlohmann::ordered_json json_of_room(const MapPlaces& places, RoomNumber number) {
  if (number == kNoRoom) return nullptr;
  const MapRoom& room = places.rooms[number - 1];
  return {{"room", number},
          {"place",
           room.place ? nlohmann::ordered_json(*room.place) : nlohmann::ordered_json(nullptr)}};
}

nlohmann::ordered_json json_of_doorway(const Doorway& doorway) {
  return {{"rooms", {doorway.from, doorway.to}},
          {"position", json_of_point(doorway.position)},
          {"width_m", doorway.width_m}};
}

void print_document(const nlohmann::ordered_json& json) {
  std::printf("%s\n",
              json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace hypermap::app
