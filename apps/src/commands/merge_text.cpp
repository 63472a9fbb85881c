// SPDX-License-Identifier: BSD-3-Clause
#include "merge_text.hpp"

#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

/// As --transform takes it.
std::string placement_text_of(const WorldPlacement& placement) {
  return fixed(placement.x_m, 3) + "," + fixed(placement.y_m, 3) + "," + fixed(placement.z_m, 3) +
         "," + fixed(degrees(placement.yaw_rad), 2);
}

void print_placement(const MergedMap& map) {
  std::printf(
      "%s lies at %s: grids overlap %s of it and agree %s, %s of its occupied voxels meet\n",
      printable(map.path.string()).c_str(),
      placement_text_of(map.found->placement).c_str(),
      fixed(map.found->overlap, 2).c_str(),
      fixed(map.found->agreement, 2).c_str(),
      fixed(map.found->occupied_share, 2).c_str());
}

Json placement_json(const std::optional<MapPlacement>& found) {
  if (!found) return nullptr;
  return {{"x_m", found->placement.x_m},
          {"y_m", found->placement.y_m},
          {"z_m", found->placement.z_m},
          {"yaw_deg", degrees(found->placement.yaw_rad)},
          {"overlap", found->overlap},
          {"agreement", found->agreement},
          {"occupied_share", found->occupied_share}};
}

Json map_json(const MergedMap& map) {
  return {{"file", map.path.string()},
          {"sessions", map.num_sessions},
          {"later", map.is_later},
          {"registered", placement_json(map.found)},
          {"occupied", map.leaves.occupied},
          {"free", map.leaves.free},
          {"joined", map.num_joined},
          {"new", map.num_new},
          {"gone", map.num_gone}};
}

}  // namespace

void print_merge(const MergeReport& report, const std::filesystem::path& output) {
  Table table({"map", "sessions", "occupied", "free", "joined", "new", "gone", "look"},
              LastColumn::kText);
  for (const MergedMap& map : report.maps) {
    const bool is_first = &map == &report.maps.front();
    table.add({printable(map.path.string()),
               std::to_string(map.num_sessions),
               std::to_string(map.leaves.occupied),
               std::to_string(map.leaves.free),
               is_first ? "-" : std::to_string(map.num_joined),
               std::to_string(map.num_new),
               is_first || !map.is_later ? "-" : std::to_string(map.num_gone),
               is_first       ? "-"
               : map.is_later ? "later"
                              : "beside"});
  }
  std::printf("%s", table.text().c_str());
  for (const MergedMap& map : report.maps) {
    if (map.found) print_placement(map);
  }
  std::printf(
      "%zu objects (and %zu tentative), %zu occupied and %zu free voxels, %zu sessions; %s\n",
      report.num_objects,
      report.num_tentative,
      report.leaves.occupied,
      report.leaves.free,
      report.num_sessions,
      output.string().c_str());
}

void print_merge_json(const MergeReport& report, const std::filesystem::path& output) {
  Json maps = Json::array();
  for (const MergedMap& map : report.maps) maps.push_back(map_json(map));
  const Json document{{"maps", std::move(maps)},
                      {"objects", report.num_objects},
                      {"tentative", report.num_tentative},
                      {"occupied", report.leaves.occupied},
                      {"free", report.leaves.free},
                      {"sessions", report.num_sessions},
                      {"files", Json::array({output.string()})}};
  std::printf("%s\n", document.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace hypermap::app
