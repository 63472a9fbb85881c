// SPDX-License-Identifier: BSD-3-Clause
// A flat of two rooms whose places are known.
#pragma once

#include "hypermap/io/archive/map_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {

inline BelongingsClassifier home() {
  PlaceRules rules;
  rules.places = {"bedroom", "kitchen"};
  rules.belongings = {{"oven", {{"kitchen", 9}}}, {"bed", {{"bedroom", 9}}}};
  return BelongingsClassifier::create(rules).value();
}

inline SemanticObject shape(std::uint64_t id, const std::string& name, const Rect& rect) {
  SemanticObject object;
  object.id = id;
  object.name = name;
  object.parts = {
      make_polygon({rect.min, {rect.max.x(), rect.min.y()}, rect.max, {rect.min.x(), rect.max.y()}})
          .value()};
  return object;
}

/// A kitchen of 4 m by 3 m (room 1) west of a bedroom of 3 m by 3 m (room 2) with a door of 0.9 m
/// at y = 1 to 1.9 in the wall at x = 4 to 4.1. The oven (3) stands in the kitchen, the bed (5) in
/// the bedroom with a cup (7) on it, a lamp (9) hangs in the bedroom's wall, a tree (11) is
/// outside.
inline MapArchive small_flat() {
  constexpr double kCellM = 0.05;
  OccupancyGrid grid =
      OccupancyGrid::create(
          {.resolution_m = kCellM, .origin = {-0.5, -0.5}, .cols = 162, .rows = 80}, kOccupiedCell)
          .value();
  const auto set = [&](const Rect& rect, std::int8_t value) {
    const auto cells = [](double m) { return static_cast<int>(std::lround((m + 0.5) / kCellM)); };
    for (int row = cells(rect.min.y()); row < cells(rect.max.y()); ++row) {
      for (int col = cells(rect.min.x()); col < cells(rect.max.x()); ++col) {
        grid.set({col, row}, value);
      }
    }
  };
  const Rect bed{{5.5, 1}, {7.1, 3}};
  set({{0, 0}, {4, 3}}, kFreeCell);
  set({{4.1, 0}, {7.1, 3}}, kFreeCell);
  set({{4, 1}, {4.1, 1.9}}, kFreeCell);
  set(bed, kOccupiedCell);
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy", .file = "occupancy"}, .content = OccupancyLayer(grid)}));
  std::vector<SemanticObject> objects{shape(3, "oven", {{0, 2}, {0.6, 2.6}}),
                                      shape(5, "bed", bed),
                                      shape(7, "cup", {{6, 2}, {6.1, 2.1}}),
                                      shape(9, "lamp", {{7.15, 1.5}, {7.25, 1.6}}),
                                      shape(11, "tree", {{7.5, 3.2}, {7.59, 3.3}})};
  EXPECT_TRUE(
      archive.hypermap.add_layer({.info = {.name = "semantic", .file = "semantic"},
                                  .content = SemanticLayer::create(std::move(objects)).value()}));
  return archive;
}

}  // namespace hypermap::test
