// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/sensor_model.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

namespace hypermap {
namespace {

TEST(SensorModel, DefaultsAreOctomapsRoundedToThousandths) {
  // ln(0.7/0.3) = 0.847298, ln(0.4/0.6) = -0.405465, ln(0.1192/0.8808) = -2.00001,
  // ln(0.971/0.029) = 3.51112.
  const SensorModel model = SensorModel::create({}).value();
  EXPECT_EQ(model.hit, 847);
  EXPECT_EQ(model.miss, -405);
  EXPECT_EQ(model.clamp_min, -2000);
  EXPECT_EQ(model.clamp_max, 3511);
  EXPECT_EQ(model.occupied_from, 0);
  EXPECT_EQ(model, SensorModel{});

  const octomap::OcTree theirs(0.1);
  EXPECT_NEAR(theirs.getProbHitLog(), 0.847, 0.0005);
  EXPECT_NEAR(theirs.getProbMissLog(), -0.405, 0.0005);
  EXPECT_NEAR(theirs.getClampingThresMinLog(), -2.0, 0.0005);
  EXPECT_NEAR(theirs.getClampingThresMaxLog(), 3.511, 0.0005);
}

TEST(SensorModel, RefusesWhatIsNoModelAndNamesTheField) {
  const auto field_of = [](const SensorModelOptions& options) {
    const auto result = SensorModel::create(options);
    return result ? std::string("none") : result.error().field;
  };
  EXPECT_EQ(field_of({.hit = Probability(0.5)}), "hit");
  EXPECT_EQ(field_of({.hit = Probability(1.0)}), "hit");
  EXPECT_EQ(field_of({.miss = Probability(0.5)}), "miss");
  EXPECT_EQ(field_of({.miss = Probability(0.0)}), "miss");
  EXPECT_EQ(field_of({.clamp_min = Probability(0.6)}), "clamp_min");
  EXPECT_EQ(field_of({.clamp_max = Probability(1.0)}), "clamp_max");
  EXPECT_EQ(field_of({.occupied_from = Probability(0.99)}), "occupied_from");
  EXPECT_EQ(field_of({.occupied_from = Probability(0.6)}), "none");
}

}  // namespace
}  // namespace hypermap
