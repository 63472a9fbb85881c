// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/transformed_octree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace hypermap {
namespace {

constexpr double kResolutionM = 0.1;

MapFromOldMap moved_by(const Eigen::Vector3d& shift_m, double yaw_rad) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation() = shift_m;
  return MapFromOldMap(transform);
}

MapFromOldMap back_from(const MapFromOldMap& there) {
  return MapFromOldMap(there.isometry().inverse());
}

/// A hall of 4 x 3 x 1.5 m: walls of one voxel, free inside, one wall labelled.
SemanticOctree hall() {
  std::vector<StoredLeaf> leaves;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 30; ++y) {
      for (int z = 0; z < 15; ++z) {
        const bool is_wall = x == 0 || y == 0 || z == 0 || x == 39 || y == 29;
        StoredLeaf leaf{.key = {static_cast<std::uint16_t>(kOriginKey + x),
                                static_cast<std::uint16_t>(kOriginKey + y),
                                static_cast<std::uint16_t>(kOriginKey + z)},
                        .log_odds = static_cast<MilliLogOdds>(is_wall ? 847 + z : -405)};
        if (x == 0) {
          leaf.label = VoxelLabel{};
          leaf.label->classes[0] = {3, 500};
          leaf.label->object = ObjectId{2};
          leaf.label->object_votes = 1;
        }
        leaves.push_back(leaf);
      }
    }
  }
  return SemanticOctree::from_leaves({.resolution_m = kResolutionM}, leaves).value();
}

SemanticOctree of_one_voxel(const VoxelKey& key) {
  const std::vector<StoredLeaf> leaves{{.key = key, .log_odds = 847}};
  return SemanticOctree::from_leaves({.resolution_m = kResolutionM}, leaves).value();
}

TEST(TransformedOctree, AShiftByWholeVoxelsMovesTheKeys) {
  const SemanticOctree old = hall();
  const SemanticOctree moved = transformed(old, moved_by({0.3, -1.7, 12.9}, 0.0)).value();
  EXPECT_EQ(moved.num_leaves(), old.num_leaves());
  old.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const auto there = moved.stored_at({static_cast<std::uint16_t>(leaf.key.x + 3),
                                        static_cast<std::uint16_t>(leaf.key.y - 17),
                                        static_cast<std::uint16_t>(leaf.key.z + 129)});
    ASSERT_TRUE(there);
    EXPECT_EQ(there->log_odds, leaf.log_odds);
    EXPECT_EQ(there->label, leaf.label);
  });
}

TEST(TransformedOctree, ThereAndBackIsTheSameMapForWholeVoxelsAndQuarterTurns) {
  const SemanticOctree old = hall();
  for (int quarters = 0; quarters < 4; ++quarters) {
    const auto there = moved_by({-2.5, 0.7, 0.1}, quarters * std::numbers::pi / 2.0);
    const SemanticOctree moved = transformed(old, there).value();
    EXPECT_EQ(moved.num_leaves(), old.num_leaves()) << quarters;
    EXPECT_EQ(moved == old, false);
    EXPECT_TRUE(transformed(moved, back_from(there)).value() == old) << quarters;
  }
}

TEST(TransformedOctree, ThereAndBackIsTheSameMapForAnyTurnAndShift) {
  const SemanticOctree old = hall();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> yaw_rad(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> shift_m(-5.0, 5.0);
  std::vector<MapFromOldMap> ways{moved_by({0.05, -0.05, 0.15}, 0.0),  // half voxels
                                  moved_by({0.3, 0.05, 0.0}, std::numbers::pi / 4.0),
                                  moved_by({0.3, 0.05, 0.0}, -std::numbers::pi / 4.0),
                                  moved_by({0.3, 0.05, 0.0}, 3.1415),
                                  moved_by({0.3, 0.05, 0.0}, 1e-5)};
  for (const double twelfths : {-5.0, -2.0, -1.0, 1.0, 2.0, 4.0, 5.0}) {  // sin 30 degrees is 1/2
    ways.push_back(moved_by({0.1, 0.0, 0.0}, twelfths * std::numbers::pi / 6.0));
  }
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d shift(shift_m(random), shift_m(random), shift_m(random));
    ways.push_back(moved_by(shift, yaw_rad(random)));
  }
  for (const MapFromOldMap& there : ways) {
    const SemanticOctree moved = transformed(old, there).value();
    EXPECT_EQ(moved.num_leaves(), old.num_leaves()) << there.isometry().matrix();
    EXPECT_TRUE(transformed(moved, back_from(there)).value() == old) << there.isometry().matrix();
  }
}

TEST(TransformedOctree, ATurnByTwelveDegreesIsThreeShearsAboutItsFixedPoint) {
  // About voxel coordinates 32768.5, 32768.5 (0.05 m, 0.05 m): tan(6 degrees) = 0.1051, sin(12
  // degrees) = 0.2079. Column 20, row 10 from there: 20 - round(1.051) = 19, 10 + round(3.950) =
  // 14, 19 - round(1.471) = 18; the turn itself comes to 17.48, 13.94.
  const double yaw_rad = 12.0 * std::numbers::pi / 180.0;
  const Eigen::Vector3d fixed(0.05, 0.05, 0.0);
  MapFromOldMap turn = moved_by(Eigen::Vector3d::Zero(), yaw_rad);
  turn = moved_by(fixed - turn.isometry().linear() * fixed, yaw_rad);
  const VoxelKey from{kOriginKey + 20, kOriginKey + 10, kOriginKey};
  const SemanticOctree old = of_one_voxel(from);
  const SemanticOctree moved = transformed(old, turn).value();
  EXPECT_TRUE(moved.stored_at({kOriginKey + 18, kOriginKey + 14, kOriginKey}));
}

TEST(TransformedOctree, NoVoxelComesFurtherFromItsPlaceThanIsSaid) {
  for (double yaw_rad = -3.1; yaw_rad < 3.2; yaw_rad += 0.17) {
    const auto way = moved_by({1.234, -0.567, 0.33}, yaw_rad);
    for (int i = 0; i < 400; ++i) {
      const VoxelKey key{static_cast<std::uint16_t>(kOriginKey + i % 20 * 13),
                         static_cast<std::uint16_t>(kOriginKey + i / 20 * 17),
                         kOriginKey};
      const SemanticOctree one = of_one_voxel(key);
      const Eigen::Vector3d goes_to = way.isometry() * one.grid().centre(key).xyz;
      transformed(one, way).value().for_each_stored_leaf([&](const StoredLeaf& leaf) {
        const Eigen::Vector3d off = one.grid().centre(leaf.key).xyz - goes_to;
        EXPECT_LE(off.head<2>().cwiseAbs().maxCoeff(), 1.07 * kResolutionM) << yaw_rad;
        EXPECT_LE(off.head<2>().cwiseAbs().minCoeff(), 0.855 * kResolutionM) << yaw_rad;
        EXPECT_LE(std::abs(off.z()), 0.501 * kResolutionM) << yaw_rad;
      });
    }
  }
}

TEST(TransformedOctree, WholeTurnsAboutAnyAxisOfTheGridAreExact) {
  Eigen::Isometry3d tilt = Eigen::Isometry3d::Identity();
  tilt.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const SemanticOctree moved = transformed(hall(), MapFromOldMap(tilt)).value();
  EXPECT_EQ(moved.num_leaves(), hall().num_leaves());
}

/// Share of occupied voxels for which the other map has an occupied one within a voxel's diagonal.
double share_found(const SemanticOctree& some,
                   const SemanticOctree& other,
                   const MapFromOldMap& way) {
  std::size_t num = 0;
  std::size_t num_found = 0;
  some.for_each_leaf([&](const LeafSample& leaf) {
    if (!leaf.occupied) return;
    ++num;
    const Eigen::Vector3d at = way.isometry() * leaf.centre_in_map;
    const double reach = 0.87 * kResolutionM;
    bool is_found = false;
    other.for_each_leaf_in(grown({at, at}, reach), [&](const LeafSample& near) {
      is_found |= near.occupied && (near.centre_in_map - at).norm() <= reach;
    });
    num_found += is_found ? 1U : 0U;
  });
  return static_cast<double>(num_found) / static_cast<double>(num);
}

TEST(TransformedOctree, AnyYawKeepsSurfacesInTheirPlace) {
  const SemanticOctree old = hall();
  for (const double yaw_rad : {0.1, 0.5, 0.785, 2.2, -1.3}) {
    const auto there = moved_by({1.234, -0.567, 0.0}, yaw_rad);
    const SemanticOctree moved = transformed(old, there).value();
    EXPECT_GE(share_found(old, moved, there), 0.99) << yaw_rad;
    EXPECT_GE(share_found(moved, old, back_from(there)), 0.99) << yaw_rad;
  }
}

TEST(TransformedOctree, RefusesWhatIsNoMotionAndWhatLeavesTheVolume) {
  Eigen::Isometry3d scaled = Eigen::Isometry3d::Identity();
  scaled.linear() *= 1.001;
  EXPECT_EQ(transformed(hall(), MapFromOldMap(scaled)).error().field, "map_from_old");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(transformed(hall(), moved_by({nan, 0, 0}, 0.0)).error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(transformed(hall(), moved_by({3276.0, 0, 0}, 0.0)).error().code, ErrorCode::kLimit);
  EXPECT_EQ(transformed(hall(), moved_by({1e30, 0, 0}, 0.0)).error().code, ErrorCode::kLimit);
  EXPECT_EQ(transformed(hall(), moved_by({1e308, 0, 0}, 0.3)).error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace hypermap
