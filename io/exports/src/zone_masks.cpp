// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/exports/zone_masks.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/projection/grids/near_cells.hpp"

#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// What a cell's corner is farther from its middle than its edge: a shape may lie there.
constexpr double kCornerCells = 0.5 * (std::numbers::sqrt2 - 1.0);

using Shapes = std::vector<Polygon>;

/// Shapes whose zones are alike: they are drawn together.
struct AlikeZones {
  std::map<double, Shapes> keepout;                  ///< By distance.
  std::map<std::pair<int, double>, Shapes> slowing;  ///< By per cent and radius.
};

void append(const Shapes& parts, Shapes& shapes) {
  shapes.insert(shapes.end(), parts.begin(), parts.end());
}

AlikeZones alike_zones(std::span<const SemanticObject> objects,
                       const ZoneRules& rules,
                       const ClassVocabulary& vocabulary) {
  AlikeZones zones;
  std::map<std::string, std::optional<ZoneRule>> rule_of_name;
  for (const SemanticObject& object : objects) {
    const auto [found, is_new] = rule_of_name.try_emplace(object.name);
    if (is_new) found->second = zone_rule_of(object.name, rules, vocabulary);
    if (!found->second) continue;
    const ZoneRule& rule = *found->second;
    if (rule.keepout_m) append(object.parts, zones.keepout[*rule.keepout_m]);
    if (rule.speed) {
      append(object.parts, zones.slowing[{rule.speed->percent, rule.speed->radius_m}]);
    }
  }
  return zones;
}

/// The grid with that value in the cells around shapes.
Result<OccupancyGrid> with_value_around(OccupancyGrid grid,
                                        const Shapes& shapes,
                                        double distance_m,
                                        std::int8_t value) {
  const double reach_cells = distance_m / grid.geometry().resolution_m + kCornerCells;
  HYPERMAP_TRY(for_each_near_cell(
      grid.geometry(), shapes, reach_cells, [&](Cell cell, double) { grid.set(cell, value); }));
  return grid;
}

}  // namespace

Result<ZoneMasks> zone_masks(const GridGeometry& geometry,
                             std::span<const SemanticObject> objects,
                             const ZoneRules& rules,
                             const ClassVocabulary& vocabulary) {
  return guarded(ErrorCode::kInvalidArgument, "zones", [&]() -> Result<ZoneMasks> {
    const AlikeZones zones = alike_zones(objects, rules, vocabulary);
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid keepout, OccupancyGrid::create(geometry, kFreeCell));
    for (const auto& [distance_m, shapes] : zones.keepout) {
      HYPERMAP_ASSIGN_OR_RETURN(
          keepout, with_value_around(std::move(keepout), shapes, distance_m, kOccupiedCell));
    }
    HYPERMAP_ASSIGN_OR_RETURN(OccupancyGrid speed, OccupancyGrid::create(geometry, kFreeCell));
    for (auto zone = zones.slowing.rbegin(); zone != zones.slowing.rend(); ++zone) {
      const auto& [percent, radius_m] = zone->first;  // descending: the slowest has the last word
      HYPERMAP_ASSIGN_OR_RETURN(
          speed,
          with_value_around(
              std::move(speed), zone->second, radius_m, static_cast<std::int8_t>(percent)));
    }
    return ZoneMasks{std::move(keepout), std::move(speed)};
  });
}

}  // namespace hypermap
