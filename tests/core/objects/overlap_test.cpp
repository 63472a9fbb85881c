// SPDX-License-Identifier: BSD-3-Clause
#include "objects/association/overlap.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::surface_of;

constexpr double kNearM = 0.025;

/// Every `stride`-th cell of an object's agreed points, made of the points themselves.
std::vector<ProximityCell> cells_of_points(const OccupancyVotes& votes) {
  const std::vector<Eigen::Vector3d> points = votes.agreed_points();
  const std::size_t stride = (points.size() + 299) / 300;
  std::vector<ProximityCell> cells;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    cells.push_back(proximity_cell_of(points[i], kNearM));
  }
  return cells;
}

TEST(PointSet, OfAnObjectHasTheCellsOfItsAgreedPoints) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0F, 0.01F);
  Object object;
  for (int i = 0; i < 12; ++i) {
    auto seen = surface_of(box_at({-0.3, 0.2, 0.5}, {0.4, 0.7, 1.0}));
    for (Eigen::Vector3f& p : seen) p += Eigen::Vector3f(noise(random), noise(random), 0.0F);
    object.points.observe(seen);
    const PointSet set = point_set_of(object, kNearM);
    ASSERT_EQ(set.cells, cells_of_points(object.points)) << i;
    for (const Eigen::Vector3d& p : object.points.agreed_points()) {
      ASSERT_TRUE(set.grid.is_near(proximity_cell_of(p, kNearM)));
    }
  }
}

TEST(PointSet, OfAnObjectWithPointsFarApartHasThemToo) {
  // 40 m are 4,000 cells of the object: more than are listed.
  Object object;
  object.points.observe(std::vector<Eigen::Vector3f>{{-20, 0, 0}, {20, 0, 1}, {20, 0.01F, 1}});
  EXPECT_EQ(point_set_of(object, kNearM).cells, cells_of_points(object.points));
}

TEST(PointSet, OfAnObjectWithoutPointsIsEmpty) {
  const PointSet set = point_set_of(Object{}, kNearM);
  EXPECT_TRUE(set.cells.empty());
  EXPECT_FALSE(set.grid.is_near({0, 0, 0}));
}

TEST(Overlap, SaysHowMuchMoreOftenThePartWasSeen) {
  Object keyboard;
  keyboard.box = box_at({-0.2, -0.1, 0.0}, {0.2, 0.1, 0.05});
  keyboard.points.observe(surface_of(keyboard.box));
  keyboard.num_observations = 8;
  Object around = keyboard;  // All of it lies in a larger one, seen twice.
  around.box = box_at({-0.3, -0.2, 0.0}, {0.3, 0.2, 0.05});
  around.points = {};
  around.points.observe(surface_of(around.box));
  around.points.observe(surface_of(keyboard.box));
  around.num_observations = 2;
  const auto ratio = [](const Object& a, const Object& b) {
    return measure_overlap(point_set_of(a, kNearM), point_set_of(b, kNearM), kNearM).maturity_ratio;
  };
  EXPECT_DOUBLE_EQ(ratio(keyboard, around), 4.0);
  EXPECT_DOUBLE_EQ(ratio(around, keyboard), 4.0);
  keyboard.num_observations = 1;
  EXPECT_DOUBLE_EQ(ratio(keyboard, around), 0.5);
}

TEST(Overlap, GrowthIsOfTheLongerDiagonal) {
  const auto growth = [](const Box& a, const Box& b) {
    Object first;
    first.box = a;
    Object second;
    second.box = b;
    return measure_overlap(point_set_of(first, kNearM), point_set_of(second, kNearM), kNearM)
        .growth;
  };
  // With 2.5 cm on all sides: 3 x 4 x 12 m, and 6 x 8 x 12 m with the one beside it.
  const Box box = box_at({0, 0, 0}, {2.95, 3.95, 11.95});
  const Box beside = box_at({3, 4, 0}, {2.95, 3.95, 11.95});
  EXPECT_NEAR(growth(box, beside), std::sqrt(36.0 + 64.0 + 144.0) / 13.0, 1e-9);
  EXPECT_NEAR(growth(beside, box), growth(box, beside), 1e-12);
  const Box inside = box_at({0.5, 0.5, 0}, {0.5, 0.5, 0.5});
  EXPECT_NEAR(growth(box, inside), 1.0, 1e-9);
  EXPECT_NEAR(growth(box, box), 1.0, 1e-9);
}

TEST(Overlap, AffinityIsLessForWhatEnlargesMoreAndNeverNone) {
  Overlap overlap{.share_of_first = 0.5, .share_of_second = 0.25, .distance = 0.5};
  // 0.05 + 0.4 0.5 + 0.3 0.25 + 0.4 0.5
  EXPECT_NEAR(affinity(overlap), 0.525, 1e-12);
  overlap.growth = 1.5;
  EXPECT_NEAR(affinity(overlap), 0.275, 1e-12);
  overlap.growth = 9.0;
  EXPECT_NEAR(affinity(overlap), 0.05, 1e-12);
}

}  // namespace
}  // namespace hypermap
