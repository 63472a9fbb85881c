// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_query.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

namespace hypermap {
namespace {

using testing_support::box_at;

/// Objects without evidence but for their class.
class ObjectQueryTest : public testing::Test {
 protected:
  ObjectId put(const std::string& name, const Box& box) {
    Object object;
    object.box = box;
    object.centroid_in_map = box.centre();
    if (!name.empty()) {
      const std::array evidence{ClassEvidence{classes.add(name).value(), Probability(0.9)}};
      object.belief.observe(evidence, Probability(0.5));
    }
    return objects.add(object);
  }
  [[nodiscard]] std::vector<ObjectId> ask(const ObjectQuery& query) const {
    return find_objects(objects, classes, query);
  }

  ObjectMap objects;
  ClassRegistry classes;
  const ObjectId low_cup = put("cup", box_at({0, 0, 0.5}, {0.2, 0.2, 0.2}));
  const ObjectId high_cup = put("cup", box_at({0, 0, 1.5}, {0.2, 0.2, 0.2}));
  const ObjectId sofa = put("couch", box_at({3, 0, 0.5}, {2, 1, 1}));
  const ObjectId unnamed = put("", box_at({6, 0, 0.5}, {1, 1, 1}));
};

TEST_F(ObjectQueryTest, WithoutConditionsAllObjectsAnswer) {
  EXPECT_EQ(ask({}), (std::vector{low_cup, high_cup, sofa, unnamed}));
}

TEST_F(ObjectQueryTest, AClassIsFoundInAnySpelling) {
  EXPECT_EQ(objects_of_class(objects, classes, "cup"), (std::vector{low_cup, high_cup}));
  // canonical_class_name: "couch" is "sofa".
  EXPECT_EQ(objects_of_class(objects, classes, "sofa"), std::vector{sofa});
  EXPECT_EQ(objects_of_class(objects, classes, "Couch"), std::vector{sofa});
}

TEST_F(ObjectQueryTest, AnUnknownNameFitsNothing) {
  EXPECT_TRUE(objects_of_class(objects, classes, "zebra").empty());
  EXPECT_TRUE(objects_of_class(objects, classes, "").empty());
}

TEST_F(ObjectQueryTest, APointWithoutHeightIsOfEveryHeight) {
  EXPECT_EQ(ask({.at = PlanPoint{{0, 0}}}), (std::vector{low_cup, high_cup}));
  EXPECT_EQ(ask({.at = PlanPoint{{0, 0}, 1.5}}), std::vector{high_cup});
  EXPECT_TRUE(ask({.at = PlanPoint{{0, 0}, 1.0}}).empty());
}

TEST_F(ObjectQueryTest, FacesOfTheBoxAreInside) {
  // The sofa covers x = 2 .. 4.
  EXPECT_EQ(ask({.at = PlanPoint{{4, 0}}}), std::vector{sofa});
  EXPECT_TRUE(ask({.at = PlanPoint{{4.001, 0}}}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ask({.at = PlanPoint{{nan, 0}}}).empty());
}

TEST_F(ObjectQueryTest, AnAreaTakesWhatItTouches) {
  const Polygon right = make_polygon({{4, -5}, {9, -5}, {9, 5}, {4, 5}}).value();
  EXPECT_EQ(ask({.area = right}), (std::vector{sofa, unnamed}));
}

TEST_F(ObjectQueryTest, ABoxWithoutAreaIsItsPoint) {
  const ObjectId point = put("cup", box_at({-3, -3, 0}, {0, 0, 0}));
  const Polygon around = make_polygon({{-4, -4}, {-2, -4}, {-2, -2}, {-4, -2}}).value();
  EXPECT_EQ(ask({.area = around}), std::vector{point});
}

TEST_F(ObjectQueryTest, ConditionsMustAllHold) {
  EXPECT_EQ(ask({.class_name = "cup", .id = high_cup}), std::vector{high_cup});
  EXPECT_TRUE(ask({.class_name = "couch", .id = high_cup}).empty());
  EXPECT_EQ(ask({.class_name = "cup", .among = std::vector{high_cup, sofa}}),
            std::vector{high_cup});
  EXPECT_TRUE(ask({.among = std::vector<ObjectId>{}}).empty());
  EXPECT_TRUE(ask({.id = kNoObject}).empty());
}

TEST_F(ObjectQueryTest, NearestIsMeasuredInThePlaneUnlessAHeightIsGiven) {
  const auto nearest = [&](const PlanPoint& point) {
    return nearest_object(objects, classes, {.class_name = "cup"}, point);
  };
  EXPECT_EQ(nearest({{1, 0}}), low_cup) << "both are 1 m away: the lowest id";
  EXPECT_EQ(nearest({{1, 0}, 1.6}), high_cup);
  EXPECT_EQ(nearest_object(objects, classes, {.class_name = "zebra"}, {}), std::nullopt);
  EXPECT_EQ(nearest_object({}, classes, {}, {}), std::nullopt);
}

TEST_F(ObjectQueryTest, NearestIsTheNearestOfAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  for (int i = 0; i < 50; ++i) {
    (void)put("chair", box_at({place(random), place(random), place(random)}, {0.4, 0.4, 0.4}));
  }
  for (int i = 0; i < 50; ++i) {
    const PlanPoint point{{place(random), place(random)}, place(random)};
    const Eigen::Vector3d at(point.xy.x(), point.xy.y(), *point.z);
    const auto found = nearest_object(objects, classes, {.class_name = "chair"}, point);
    ASSERT_TRUE(found);
    for (const ObjectId id : objects_of_class(objects, classes, "chair")) {
      EXPECT_LE((objects.at(*found).centroid_in_map - at).norm(),
                (objects.at(id).centroid_in_map - at).norm());
    }
  }
}

}  // namespace
}  // namespace hypermap
