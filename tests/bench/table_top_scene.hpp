// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Table-top scenes that small robots map with three sensors, made up from a seed, and what truly
/// stands there.
///
/// Source: [sogm] IV, figures 9 and 10. The paper's scenes are not published; these are of the same
/// kind: robots on tables, a tilted laser, a camera and a sensor of edges, known poses.
#pragma once

#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/supercells/segmentation_metrics.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace hypermap::test {

enum class SceneKind : std::uint8_t {
  kOneTable,     ///< A rectangular table with boxes.
  kCornerTable,  ///< A table around a corner, many small objects.
  kTwoTables,    ///< Two tables with a gap and a robot on each.
  kCrowded,      ///< A large table with many things, long narrow ones among them.
};

inline constexpr SceneKind kSceneKinds[] = {
    SceneKind::kOneTable, SceneKind::kCornerTable, SceneKind::kTwoTables, SceneKind::kCrowded};
/// "one table" and so on.
[[nodiscard]] std::string_view name_of(SceneKind kind);

/// Classes of the true segmentation.
enum TrueClass : std::int32_t { kUnknown = 0, kFloor = 1, kTable = 2, kObstacle = 3 };

struct TableTopScene {
  /// 600 x 600 cells of 1 cm. Layers "/ism/cam": table or not; "/ism/edge": a drop or none;
  /// "/ism/laser": obstacle or free.
  GridStack stack;
  /// A segment for each class, as a person would draw them: whole obstacles, of which some part was
  /// seen, also where no sensor looks into them; unknown what no sensor could see.
  CellSegmentation truth;
};

[[nodiscard]] TableTopScene table_top_scene(SceneKind kind, std::uint64_t seed);

}  // namespace hypermap::test
