// SPDX-License-Identifier: BSD-3-Clause
#include "floor_keys.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#include <array>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kHeightKey = "floor_m";
constexpr std::string_view kSourceKey = "floor_source";
constexpr std::array kFloorKeys{kHeightKey, kSourceKey};

Result<FloorSource> source_of(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string source, node.as_string());
  for (const FloorSource known :
       {FloorSource::kAssumed, FloorSource::kFound, FloorSource::kStated}) {
    if (source == name_of(known)) return known;
  }
  return Unexpected(
      node.error("must be assumed, found or stated, is '" + printable(source, 80) + "'"));
}

}  // namespace

Result<MapFloor> floor_of_keys(const ValueTree& extra) {
  const SourceName unnamed;
  const YamlNode root(extra, "", unnamed);
  const auto height = root.find(kHeightKey);
  if (!height) return MapFloor{};
  MapFloor floor{.source = FloorSource::kStated};
  HYPERMAP_ASSIGN_OR_RETURN(floor.height_m, height->as_double(-kMaxFloorHeightM, kMaxFloorHeightM));
  if (const auto source = root.find(kSourceKey)) {
    HYPERMAP_ASSIGN_OR_RETURN(floor.source, source_of(*source));
  }
  return floor;
}

std::vector<ValueTree::Entry> floor_keys(const MapFloor& floor) {
  if (floor == MapFloor{}) return {};
  return {{std::string(kHeightKey), make_number(floor.height_m)},
          {std::string(kSourceKey), make_text(std::string(name_of(floor.source)))}};
}

ValueTree without_floor_keys(const ValueTree& extra) {
  return other_keys(extra, kFloorKeys);
}

}  // namespace hypermap
