// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

const std::filesystem::path kData = test::source_path("data");

/// A small scene with everything that a scene may say; `objects` and `extra` are put in.
std::string scene_text(const std::string& objects, const std::string& extra = "") {
  return R"(name: cell
building:
  height: 2.5
  floor: [[0, 0], [4, 0], [4, 3], [0, 3]]
  materials: {walls: {color: [1, 2, 3], pattern: brick}}
lights: [[2, 1.5, 2.3]]
jitter: {position: 0.02, yaw: 5}
fixtures:
  - {from: [1, 0, 0], to: [2, 0.1, 2], color: [9, 8, 7], pattern: wood}
)" + extra +
         "objects:\n" + objects + R"(
camera:
  height: 1.3
  speed: 0.4
  turn_rate: 90
  path:
    - {at: [1, 1], look_at: [3, 2, 0.5]}
    - {at: [2, 1], look_at: [3, 2, 0.5], height: 1.1}
)";
}

const std::string kTable =
    "  - {name: desk, class: table, shape: table, at: [3, 2], yaw: 90, fixed: true}\n";

TEST(SceneFile, EveryKeyIsRead) {
  const auto scene = parse_scene(
      scene_text(kTable + "  - {name: mug, class: cup, shape: cup, on: desk, at: [0.1, -0.2], "
                          "height: 0.01, size: [0.09, 0.12, 0.1], colors: [[255, 0, 0]]}\n"),
      "cell.yaml");
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->name, "cell");
  EXPECT_EQ(scene->wall_height_m, 2.5);
  EXPECT_DOUBLE_EQ(area_m2(scene->floor), 12.0);
  EXPECT_EQ(scene->wall_material, (SurfaceMaterial{{1, 2, 3}, SurfacePattern::kBrick}));
  ASSERT_EQ(scene->lights_in_map.size(), 1U);
  EXPECT_EQ(scene->position_jitter_m, 0.02);
  EXPECT_NEAR(scene->yaw_jitter_rad, 5.0 * std::numbers::pi / 180.0, 1e-15);
  ASSERT_EQ(scene->fixtures.size(), 1U);
  EXPECT_EQ(scene->fixtures[0].box.max_in_map, Eigen::Vector3d(2, 0.1, 2));
  ASSERT_EQ(scene->objects.size(), 2U);
  EXPECT_FALSE(scene->objects[0].movable);
  EXPECT_NEAR(scene->objects[0].yaw_rad, 0.5 * std::numbers::pi, 1e-15);
  const SceneObject& mug = scene->objects[1];
  EXPECT_EQ(mug.on, "desk");
  EXPECT_EQ(mug.position_m, Eigen::Vector2d(0.1, -0.2));
  EXPECT_EQ(mug.height_m, 0.01);
  EXPECT_EQ(mug.size_m, Eigen::Vector3d(0.09, 0.12, 0.1));
  ASSERT_EQ(mug.colors.size(), 1U);
  EXPECT_EQ(mug.colors[0], (Rgb8{255, 0, 0}));
  EXPECT_TRUE(mug.movable);
  ASSERT_EQ(scene->waypoints.size(), 2U);
  EXPECT_EQ(scene->waypoints[0].position_in_map, Eigen::Vector3d(1, 1, 1.3));
  EXPECT_EQ(scene->waypoints[1].position_in_map, Eigen::Vector3d(2, 1, 1.1));
  EXPECT_NEAR(scene->path.turn_rate_rad_per_s, 0.5 * std::numbers::pi, 1e-15);
}

TEST(SceneFile, AThingBesideAnotherIsRead) {
  const auto scene = parse_scene(
      scene_text(kTable +
                 "  - {name: seat, class: chair, shape: chair, beside: desk, at: [1, 0]}\n"),
      "cell.yaml");
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_EQ(scene->objects.at(1).beside, "desk");
  const auto both = parse_scene(
      scene_text(kTable +
                 "  - {name: mug, class: cup, shape: cup, on: desk, beside: desk, at: [1, 0]}\n"),
      "cell.yaml");
  ASSERT_FALSE(both);
  EXPECT_THAT(to_string(both.error()), HasSubstr("beside"));
}

TEST(SceneFile, WhatMovesIsRead) {
  const std::string text = scene_text(kTable, R"(moving:
  - {name: guest, class: person, shape: person, speed: 0.8, way: [[1, 2], [3, 2.5]],
     size: [0.5, 0.4, 1.6], colors: [[1, 2, 3]]}
)");
  const auto scene = parse_scene(text, "cell.yaml");
  ASSERT_TRUE(scene) << to_string(scene.error());
  ASSERT_EQ(scene->moving.size(), 1U);
  const MovingBody& guest = scene->moving[0];
  EXPECT_EQ(guest.class_name, "person");
  EXPECT_EQ(guest.speed_m_per_s, 0.8);
  ASSERT_EQ(guest.way_in_map.size(), 2U);
  EXPECT_EQ(guest.way_in_map[1], Eigen::Vector2d(3, 2.5));
  EXPECT_EQ(guest.size_m, Eigen::Vector3d(0.5, 0.4, 1.6));
  EXPECT_EQ(guest.colors.size(), 1U);
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    const auto read = parse_scene(changed, "s.yaml");
    return read ? std::string("read") : to_string(read.error());
  };
  EXPECT_THAT(error("[[1, 2], [3, 2.5]]", "[[1, 2]]"), HasSubstr("2 points"));
  EXPECT_THAT(error("[[1, 2], [3, 2.5]]", "[[1, 2], [1, 2]]"), HasSubstr("1 cm"));
  EXPECT_THAT(error("speed: 0.8", "speed: 0"), HasSubstr("speed"));
  EXPECT_THAT(error("way:", "path:"), HasSubstr("moving[0].path"));
}

TEST(SceneFile, AnUnknownKeyIsRefusedWithTheNearestOne) {
  const auto scene = parse_scene(
      scene_text("  - {name: a, class: cup, shape: cup, at: [1, 1], colour: [1, 2, 3]}\n"),
      "s.yaml");
  ASSERT_FALSE(scene);
  const std::string text = to_string(scene.error());
  EXPECT_THAT(text, HasSubstr("s.yaml"));
  EXPECT_THAT(text, HasSubstr("colour"));
  EXPECT_THAT(text, HasSubstr("colors"));
  EXPECT_GT(scene.error().line, 0);
}

TEST(SceneFile, WhatIsWrongIsNamed) {
  const auto error = [](const std::string& text) {
    const auto scene = parse_scene(text, "s.yaml");
    return scene ? std::string("read") : to_string(scene.error());
  };
  EXPECT_THAT(error(scene_text("  - {class: cup, shape: cup, at: [1, 1]}\n")), HasSubstr("name"));
  EXPECT_THAT(error(scene_text("  - {name: a, class: cup, shape: cup, at: [1]}\n")),
              HasSubstr("at"));
  EXPECT_THAT(error(scene_text("  - {name: a, class: cup, shape: cup, at: [1, .nan]}\n")),
              HasSubstr("at"));
  EXPECT_THAT(error(scene_text("  - {name: a, class: cup, shape: cup, at: [1, 2e4]}\n")),
              HasSubstr("1000 m"));
  EXPECT_THAT(error(scene_text(
                  "  - {name: a, class: cup, shape: cup, at: [1, 1], colors: [[1, 2, 256]]}\n")),
              HasSubstr("colors"));
  EXPECT_THAT(error(scene_text(kTable, "extra: 1\n")), HasSubstr("extra"));
  EXPECT_THAT(error("name: x\n"), HasSubstr("building"));
  EXPECT_THAT(error("[1, 2]\n"), HasSubstr("map"));
  EXPECT_THAT(error(""), HasSubstr("s.yaml"));
}

TEST(SceneFile, AFixtureInsideOutIsRefused) {
  std::string text = scene_text(kTable);
  text.replace(text.find("to: [2, 0.1, 2]"), 15, "to: [0, 0.1, 2]");
  const auto scene = parse_scene(text, "s.yaml");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().what, HasSubstr("greater"));
}

TEST(SceneFile, AFloorThatCrossesItselfIsRefused) {
  std::string text = scene_text(kTable);
  text.replace(text.find("[4, 0], [4, 3]"), 14, "[4, 3], [4, 0]");
  EXPECT_FALSE(parse_scene(text, "s.yaml"));
}

TEST(SceneFile, ACameraWithoutAWayIsRefused) {
  std::string text = scene_text(kTable);
  text.erase(text.find("    - {at: [2, 1]"));
  const auto scene = parse_scene(text, "s.yaml");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().what, HasSubstr("2 stops"));
}

TEST(SceneFile, AnUnknownPatternIsRefused) {
  std::string text = scene_text(kTable);
  text.replace(text.find("pattern: wood"), 13, "pattern: gold");
  const auto scene = parse_scene(text, "s.yaml");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().what, HasSubstr("gold"));
}

TEST(SceneFile, TooManyThingsAreALimitError) {
  std::string evaluated;
  for (int i = 0; i < 1001; ++i)
    evaluated += "  - {name: c" + std::to_string(i) + ", class: cup, shape: cup, at: [1, 1]}\n";
  const auto scene = parse_scene(scene_text(evaluated), "s.yaml");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kLimit);
}

TEST(SceneFile, AFileOfOnesOwnIsFoundBeforeThoseThatShip) {
  const test::TempDir dir;
  std::ofstream(dir / "own.yaml") << scene_text(kTable);
  const auto own = find_scene((dir / "own.yaml").string(), kData);
  ASSERT_TRUE(own);
  EXPECT_EQ(*own, dir / "own.yaml");
  const auto none = find_scene("garden", kData);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(none.error().what, HasSubstr("flat, floor, hall, laboratory, lounge, office"));
  EXPECT_FALSE(find_scene("../scenes/floor", kData));
}

}  // namespace
}  // namespace hypermap
