// SPDX-License-Identifier: BSD-3-Clause
// Layer `occupancy` where a confirmed object stands whose voxels rays cleared.
#include "hypermap/io/archive/map_layers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// All of 2 m x 1 m x 1.8 m was looked through. A board of 1 m x 1 m, from 0.41 to
/// 0.5 m, is an object.
MapArchive archive_with_a_cleared_board() {
  MapArchive archive;
  const ClassId table = archive.classes.add("diningtable").value();
  archive.octree = SemanticOctree::create({}).value();
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (int k = 0; k < 36; ++k) {
        const PointInMap middle{0.05 * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)};
        const auto key = archive.octree->grid().key(middle).value();
        EXPECT_TRUE(archive.octree->set_leaf({.key = key, .log_odds = -1000, .label = {}}));
      }
    }
  }
  std::vector<Eigen::Vector3f> top;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      for (const float z : {0.41F, 0.5F}) {
        top.emplace_back(0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), z);
      }
    }
  }
  Object object;
  object.belief.observe(std::array{ClassEvidence{table, Probability(0.9)}}, Probability(0.5));
  object.points.observe(top);
  object.box = *object.points.agreed_box();
  object.existence = LogOdds(10.0);
  (void)archive.objects.add(object);
  return archive;
}

std::int8_t occupancy_at(const MapArchive& archive, double x) {
  const auto* layer = archive.hypermap.find_as<OccupancyLayer>(kOccupancyLayer);
  EXPECT_NE(layer, nullptr);
  return layer == nullptr ? kUnknownCell : layer->grid.at_point({x, 0.52}).value_or(kUnknownCell);
}

class OccupiedFootprints : public testing::Test {
 protected:
  void SetUp() override {
    options.confirmation.min_observations = 0;
    options.confirmation.min_real_probability = std::nullopt;
  }
  MapArchive archive = archive_with_a_cleared_board();
  ObjectPipelineOptions options;
};

TEST_F(OccupiedFootprints, AreNotFreeThoughTheirVoxelsAre) {
  ASSERT_TRUE(derive_layers(archive, options, {}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kOccupiedCell);
  EXPECT_EQ(occupancy_at(archive, 1.52), kFreeCell);
}

TEST_F(OccupiedFootprints, OfTentativeObjectsAreFree) {
  options.confirmation.min_observations = 100;
  ASSERT_TRUE(derive_layers(archive, options, {}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell);
}

TEST_F(OccupiedFootprints, OfWhatLiesOutsideTheBandAreFree) {
  ASSERT_TRUE(derive_layers(archive, options, {.min_height_m = 0.6}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell);
  ASSERT_TRUE(derive_layers(archive, options, {.max_height_m = 0.45}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell) << "a robot passes below";
}

TEST_F(OccupiedFootprints, ThatWereNotHeldAgainstTheMapSayNothingOfTheFloor) {
  ASSERT_TRUE(derive_layers(archive, options, {.carve_footprints = false}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell);
  options.footprint = ShapePolicy::kHull;
  ASSERT_TRUE(derive_layers(archive, options, {}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell);
}

TEST_F(OccupiedFootprints, AreThoseOfALayerThatTakesNoUpdates) {
  SemanticLayer edited;
  const Polygon beside = make_polygon({{1.4, 0}, {1.7, 0}, {1.7, 1}, {1.4, 1}}).value();
  ASSERT_TRUE(edited.add({.id = 1, .name = "diningtable", .parts = {beside}}));
  ASSERT_TRUE(archive.hypermap.add_layer({{.name = "semantic", .enable_update = false}, edited}));
  ASSERT_TRUE(derive_layers(archive, options, {}));
  EXPECT_EQ(occupancy_at(archive, 0.52), kFreeCell);
  EXPECT_EQ(occupancy_at(archive, 1.52), kOccupiedCell);
}

}  // namespace
}  // namespace hypermap
