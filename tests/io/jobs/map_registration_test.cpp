// SPDX-License-Identifier: BSD-3-Clause
#include "map_registration.hpp"

#include "hypermap/octree_semantic/octree/transformed_octree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// In voxels of 0.1 m, in the plan.
struct FurnitureBox {
  int x = 0;
  int y = 0;
  int cols = 0;
  int rows = 0;

  [[nodiscard]] bool contains(int col, int row) const {
    return col >= x && row >= y && col < x + cols && row < y + rows;
  }
};

/// A room of 8 x 6 m with a floor, walls 2 m high and furniture 1 m high; its air is free.
SemanticOctree furnished_room(const std::vector<FurnitureBox>& furniture) {
  constexpr int kCols = 80;
  constexpr int kRows = 60;
  std::vector<StoredLeaf> leaves;
  leaves.reserve(std::size_t{kCols} * kRows * 20);
  for (int x = 0; x < kCols; ++x) {
    for (int y = 0; y < kRows; ++y) {
      const bool is_wall = x == 0 || y == 0 || x == kCols - 1 || y == kRows - 1;
      const bool is_furniture = std::ranges::any_of(
          furniture, [&](const FurnitureBox& box) { return box.contains(x, y); });
      for (int z = 0; z < 20; ++z) {
        const bool is_occupied = is_wall || z == 0 || (is_furniture && z < 10);
        leaves.push_back({{static_cast<std::uint16_t>(kOriginKey + x),
                           static_cast<std::uint16_t>(kOriginKey + y),
                           static_cast<std::uint16_t>(kOriginKey + z)},
                          static_cast<MilliLogOdds>(is_occupied ? 2000 : -1500)});
      }
    }
  }
  return SemanticOctree::from_leaves({.resolution_m = 0.1}, leaves).value();
}

const std::vector<FurnitureBox>& office_furniture() {
  static const std::vector<FurnitureBox> kFurniture{{5, 5, 14, 7},
                                                    {30, 8, 6, 20},
                                                    {55, 40, 15, 9},
                                                    {12, 42, 8, 8},
                                                    {60, 10, 5, 12},
                                                    {40, 35, 4, 4}};
  return kFurniture;
}

/// The room as it looks from an origin that lies there.
SemanticOctree room_seen_from(const WorldPlacement& origin) {
  const MapFromOldMap map_from_room(isometry_of(origin).inverse());
  return transformed(furnished_room(office_furniture()), map_from_room).value();
}

MapArchive map_of(SemanticOctree octree) {
  MapArchive map{.hypermap = {}};
  map.octree = std::move(octree);
  return map;
}

TEST(MapRegistration, AMovedRoomIsFoundWithinAVoxelAndADegree) {
  const MapArchive room = map_of(furnished_room(office_furniture()));
  for (const WorldPlacement origin :
       {WorldPlacement{.x_m = 1.3, .y_m = -0.7, .z_m = 0.0, .yaw_rad = 0.2},
        WorldPlacement{.x_m = 4.1, .y_m = 2.2, .z_m = 0.2, .yaw_rad = -2.0},
        WorldPlacement{.x_m = 0.5, .y_m = -0.3, .z_m = -1.4, .yaw_rad = 0.1},
        WorldPlacement{.x_m = 1.3, .y_m = -0.7, .z_m = 12.9, .yaw_rad = 0.2}}) {
    const auto found = register_maps(map_of(room_seen_from(origin)), room, {});
    ASSERT_TRUE(found) << to_string(found.error());
    const WorldPlacement& placed = found->placement;
    EXPECT_LT(std::hypot(placed.x_m - origin.x_m, placed.y_m - origin.y_m), 0.1);
    EXPECT_NEAR(placed.z_m, origin.z_m, 1e-9);
    EXPECT_NEAR(std::remainder(placed.yaw_rad - origin.yaw_rad, 2.0 * std::numbers::pi),
                0.0,
                std::numbers::pi / 180.0);
    EXPECT_GT(found->occupied_share, 0.9);
  }
}

/// The room without its lowest level of voxels, whose floor nobody saw.
SemanticOctree without_floor(const SemanticOctree& room, int lowest) {
  SemanticOctree part = SemanticOctree::create(room.options()).value();
  room.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (leaf.key.z <= kOriginKey + lowest) return;
    EXPECT_TRUE(part.set_leaf(leaf));
  });
  return part;
}

TEST(MapRegistration, WhoseFloorOneMapAloneShowsAreFound) {
  const SemanticOctree low =
      transformed(furnished_room(office_furniture()),
                  MapFromOldMap(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.5))))
          .value();
  const auto found = register_maps(map_of(without_floor(low, -5)), map_of(low), {});
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_NEAR(found->placement.z_m, 0.0, 1e-9);
  EXPECT_GT(found->occupied_share, 0.9);
}

TEST(MapRegistration, ARoomThatLooksTheSameFromTwoSidesIsRefused) {
  const MapArchive empty = map_of(furnished_room({}));
  EXPECT_EQ(register_maps(empty, empty, {}).error().code, ErrorCode::kNotFound);
  const MapArchive symmetric = map_of(furnished_room({{10, 10, 10, 6},
                                                      {60, 44, 10, 6},
                                                      {30, 8, 5, 9},
                                                      {45, 43, 5, 9},
                                                      {12, 40, 6, 4},
                                                      {62, 16, 6, 4}}));
  const Error error = register_maps(symmetric, symmetric, {}).error();
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_EQ(error.field, "rivals");
}

TEST(MapRegistration, AnotherPlaceIsRefused) {
  const MapArchive other = map_of(furnished_room({{20, 20, 30, 3}, {70, 2, 4, 40}}));
  const MapArchive office = map_of(furnished_room(office_furniture()));
  EXPECT_EQ(register_maps(other, office, {}).error().code, ErrorCode::kNotFound);
}

TEST(MapRegistration, AMapWithoutVoxelsIsRefused) {
  const MapArchive nothing = map_of(SemanticOctree::create({.resolution_m = 0.1}).value());
  EXPECT_FALSE(register_maps(nothing, map_of(furnished_room(office_furniture())), {}));
}

}  // namespace
}  // namespace hypermap
