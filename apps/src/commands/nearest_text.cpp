// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_text.hpp"

#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kWayDigits = 2;

Json point_json(const Eigen::Vector2d& point) {
  return {point.x(), point.y()};
}

Json reached_json(const ReachedObject& one) {
  Json route{{"length_m", one.route.length_m},
             {"beside_unknown_m", one.route.beside_unknown_m},
             {"points", Json::array()}};
  for (const Eigen::Vector2d& point : one.route.points)
    route["points"].push_back(point_json(point));
  const MapAnswer& object = one.object;
  return {{"id", object.id},
          {"name", object.name},
          {"value", object.value},
          {"position", point_json(object.position.xy)},
          {"confidence", object.confidence ? Json(*object.confidence) : Json(nullptr)},
          {"straight_m", one.straight_m},
          {"gap_m", one.gap_m},
          {"route", std::move(route)}};
}

std::string point_text(const Eigen::Vector2d& point) {
  return fixed(point.x(), kWayDigits) + "," + fixed(point.y(), kWayDigits);
}

/// "the way to chair 19: 0.00,0.00 1.20,0.30"
std::string way_text(const ReachedObject& one) {
  std::string text =
      "the way to " + printable(one.object.name) + " " + std::to_string(one.object.id) + ":";
  for (const Eigen::Vector2d& point : one.route.points) text += " " + point_text(point);
  return text;
}

void print_json_of(const ReachedObjects& reached, const ApproachOptions& options) {
  Json json{{"frame", reached.frame_id},
            {"robot_radius_m", options.robot_radius_m},
            {"reach_m", options.reach_m},
            {"results", Json::array()},
            {"out_of_reach", reached.out_of_reach}};
  for (const ReachedObject& one : reached.found) json["results"].push_back(reached_json(one));
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace

void print_nearest_routes(const ReachedObjects& reached,
                          const ApproachOptions& options,
                          bool json) {
  if (json) return print_json_of(reached, options);
  Table table({"name",
               "id",
               "position (" + printable(reached.frame_id) + ")",
               "confidence",
               "way m",
               "straight m",
               "gap m",
               "beside unknown m"});
  for (const ReachedObject& one : reached.found) {
    table.add({printable(one.object.name),
               std::to_string(one.object.id),
               point_text(one.object.position.xy),
               fixed(one.object.confidence, 2),
               fixed(one.route.length_m, kWayDigits),
               fixed(one.straight_m, kWayDigits),
               fixed(one.gap_m, kWayDigits),
               fixed(one.route.beside_unknown_m, kWayDigits)});
  }
  std::printf("%s%zu found\n", table.text().c_str(), reached.found.size());
  for (const ReachedObject& one : reached.found) std::printf("%s\n", way_text(one).c_str());
  if (reached.out_of_reach.empty()) return;
  std::string ids;
  for (const std::uint64_t id : reached.out_of_reach) {
    ids += (ids.empty() ? "" : ", ") + std::to_string(id);
  }
  std::printf("without a place for this robot within reach: %s\n", printable(ids, 500).c_str());
}

}  // namespace hypermap::app
