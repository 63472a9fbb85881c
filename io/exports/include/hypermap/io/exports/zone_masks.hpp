// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a robot keeps out and where it goes slowly, by the classes of what stands there.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

/// Speed near an object.
struct SpeedZone {
  int percent = 100;      ///< Of the robot's largest speed, 1 to 100.
  double radius_m = 0.0;  ///< Around the object's shape, 0 to 100.
  friend bool operator==(const SpeedZone&, const SpeedZone&) = default;
};

/// What objects of a class mean to a robot.
struct ZoneRule {
  std::optional<double> keepout_m = {};  ///< No way so near its shape, 0 to 100; none: no zone.
  std::optional<SpeedZone> speed = {};
  friend bool operator==(const ZoneRule&, const ZoneRule&) = default;
};

struct ZoneRules {
  double robot_height_m = 1.5;  ///< Over the floor: what hangs above makes no zone.
  std::map<std::string, ZoneRule> of_class = {};  ///< By canonical name of class or super-class.
  friend bool operator==(const ZoneRules&, const ZoneRules&) = default;
};

/// A YAML map: `robot_height_m`, which may be missing, and `zones` from names of classes, in any
/// spelling, to `keepout_m`, and `speed_percent` with `speed_radius_m`. `data/nav2.yaml` is one.
///
/// Errors: kIo; those of `read_yaml`; kNotFound for an unknown key, with the nearest known name;
/// kMalformedFile naming file, line and key for a value of another kind or out of its range, a rule
/// that says nothing, half a speed zone, and for a class that stands twice.
[[nodiscard]] Result<ZoneRules> read_zone_rules(const std::filesystem::path& path);

/// The rule of that name (in any spelling), else of the class that it means or another name of
/// that, else of the nearest super-class with one. None where there is none.
[[nodiscard]] std::optional<ZoneRule> zone_rule_of(std::string_view name,
                                                   const ZoneRules& rules,
                                                   const ClassVocabulary& vocabulary);

/// Masks of Nav2's costmap filters, on the cells of a map.
struct ZoneMasks {
  OccupancyGrid keepout;  ///< 100 where robots keep out, else 0.
  OccupancyGrid speed;    ///< Per cent of the largest speed, the least of zones; 0: no limit.
};

/// The zones of objects: the cells that their shapes meet, and those whose middle is at most the
/// zone's distance and half a cell's diagonal from the middle of such a cell. So a zone holds every
/// cell whose middle is within the distance of a shape, and none that is farther by more than a
/// diagonal. Heights are unknown here.
///
/// Errors: those of OccupancyGrid::create and for_each_near_cell; kOutOfMemory.
/// Cost: for each distance that a rule in use has, the cells around its shapes.
[[nodiscard]] Result<ZoneMasks> zone_masks(const GridGeometry& geometry,
                                           std::span<const SemanticObject> objects,
                                           const ZoneRules& rules,
                                           const ClassVocabulary& vocabulary);

}  // namespace hypermap
