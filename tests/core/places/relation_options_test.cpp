// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relation_options.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

TEST(RelationOptions, DefaultsAreValid) {
  EXPECT_TRUE(validate(RelationOptions()));
}

TEST(RelationOptions, AFieldOutOfRangeIsNamed) {
  EXPECT_EQ(validate(RelationOptions{.voxel_m = 0.0}).error().field, "voxel_m");
  EXPECT_EQ(validate(RelationOptions{.gap_voxels = -1}).error().field, "gap_voxels");
  EXPECT_EQ(validate(RelationOptions{.min_support_share = 0}).error().field, "min_support_share");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(RelationOptions{.floor_m = nan}).error().field, "floor_m");
  EXPECT_EQ(validate(RelationOptions{.least_reach_m = 2, .max_reach_m = 1}).error().field,
            "max_reach_m");
  EXPECT_EQ(validate(RelationOptions{.max_beside = 65}).error().field, "max_beside");
}

TEST(RelationOptions, APartNamesItsWhole) {
  EXPECT_TRUE(validate(RelationOptions{.parts = {"door of oven"}}));
  for (const char* wrong : {"door", "of oven", " of oven", "door of ", ""}) {
    const auto checked = validate(RelationOptions{.parts = {wrong}});
    ASSERT_FALSE(checked) << wrong;
    EXPECT_EQ(checked.error().field, "parts");
  }
}

}  // namespace
}  // namespace hypermap
