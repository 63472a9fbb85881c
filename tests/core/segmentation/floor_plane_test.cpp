// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/floor_plane.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

namespace hypermap {
namespace {

const Eigen::Vector3f kUpInCamera{0, -1, 0};
constexpr std::size_t kLeast = 20;

/// `count` points in a row before a level camera, that far below it.
void add_row(PlanePoints& points, std::size_t count, float below_m) {
  for (std::size_t i = 0; i < count; ++i) {
    points.add({0.01F * static_cast<float>(i), below_m, 2.0F}, 0.0F);
  }
}

/// A table top 0.5 m below the camera, which has a plane already, and what is beside it.
struct Surroundings {
  PlanePoints all;
  PlanePoints left;

  Surroundings() { add_row(all, 400, 0.5F); }
  Surroundings& with(std::size_t count, float below_m) {
    add_row(all, count, below_m);
    add_row(left, count, below_m);
    return *this;
  }
  [[nodiscard]] std::optional<Plane> floor() const {
    return floor_around(all, left, kUpInCamera, kLeast, {});
  }
};

TEST(FloorPlane, IsLevelAndHoldsLittle) {
  const auto floor = Surroundings().with(kLeast, 1.25F).with(60, 0.8F).floor();
  ASSERT_TRUE(floor.has_value());
  EXPECT_EQ(floor->normal, kUpInCamera);
  EXPECT_FLOAT_EQ(floor->offset_m, 1.25F);
}

TEST(FloorPlane, HoldsAsMuchAsIsAskedFor) {
  EXPECT_FALSE(Surroundings().with(kLeast - 1, 1.25F).floor().has_value());
}

TEST(FloorPlane, IsTheLevelWithMostOfThosePoints) {
  const auto floor = Surroundings().with(kLeast, 1.25F).with(5, 1.255F).with(3, 1.262F).floor();
  ASSERT_TRUE(floor.has_value());
  EXPECT_FLOAT_EQ(floor->offset_m, 1.255F) << "7 mm to both sides";
}

TEST(FloorPlane, HasNothingBelowButErrors) {
  EXPECT_TRUE(Surroundings().with(kLeast, 1.25F).with(5, 1.5F).floor().has_value());
  EXPECT_FALSE(Surroundings().with(kLeast, 1.25F).with(6, 1.5F).floor().has_value());
}

TEST(FloorPlane, IsNoTableOverAFloorThatIsKnown) {
  Surroundings view = Surroundings().with(60, 0.8F);
  add_row(view.all, 400, 1.25F);
  EXPECT_FALSE(view.floor().has_value());
}

TEST(FloorPlane, OfNothingIsNone) {
  EXPECT_FALSE(Surroundings().floor().has_value());
}

}  // namespace
}  // namespace hypermap
