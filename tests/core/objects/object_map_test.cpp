// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_map.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Object object_in(const Box& box) {
  Object object;
  object.box = box;
  object.centroid_in_map = box.centre();
  return object;
}

Box random_box(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> size(0.0, 1.5);
  const Eigen::Vector3d corner(place(random), place(random), place(random));
  return {corner, corner + Eigen::Vector3d(size(random), size(random), size(random))};
}

TEST(ObjectMap, IdsStartAtOneAndAreNeverGivenAgain) {
  ObjectMap map;
  EXPECT_EQ(map.add({}), ObjectId{1});
  EXPECT_EQ(map.add({}), ObjectId{2});
  EXPECT_TRUE(map.erase(ObjectId{2}));
  EXPECT_FALSE(map.erase(ObjectId{2}));
  EXPECT_EQ(map.add({}), ObjectId{3});
  EXPECT_FALSE(map.contains(ObjectId{2}));
  EXPECT_EQ(map.find(ObjectId{9}), nullptr);
}

TEST(ObjectMap, QueriesAgreeWithLookingAtAll) {
  std::mt19937 random(1);
  ObjectMap map;
  for (int i = 0; i < 300; ++i) (void)map.add(object_in(random_box(random)));
  for (std::uint32_t id = 1; id <= 300; id += 3) {
    map.modify(ObjectId{id}, [&](Object& o) { o.box = random_box(random); });
  }
  for (std::uint32_t id = 2; id <= 300; id += 7) (void)map.erase(ObjectId{id});
  for (int round = 0; round < 100; ++round) {
    const Box box = random_box(random);
    const Rect area{box.min_in_map.head<2>(), box.max_in_map.head<2>()};
    std::vector<ObjectId> in_box;
    std::vector<ObjectId> in_area;
    for (const Object& o : map.objects()) {
      if (o.box.intersects(box)) in_box.push_back(o.id);
      if ((o.box.min_in_map.head<2>().array() <= area.max.array()).all() &&
          (o.box.max_in_map.head<2>().array() >= area.min.array()).all()) {
        in_area.push_back(o.id);
      }
    }
    EXPECT_EQ(map.query(box), in_box);
    EXPECT_EQ(map.query(area), in_area);
  }
}

TEST(ObjectMap, TheNearestAcceptedObjectIsFound) {
  ObjectMap map;
  const ClassId cup{1};
  for (const double x : {1.0, 3.0, -3.0, 7.0}) {
    Object object = object_in({{x, 0, 0}, {x + 0.5, 1, 1}});
    if (x != 1.0) object.belief = ClassBelief::from_entries({}, {{cup, LogOdds(1)}}).value();
    (void)map.add(object);
  }
  EXPECT_EQ(map.nearest({{0, 0, 0}}, std::nullopt), ObjectId{1});
  EXPECT_EQ(map.nearest({{0, 0, 0}}, cup), ObjectId{3});     // -2.5 is nearer than 3
  EXPECT_EQ(map.nearest({{0.25, 0, 0}}, cup), ObjectId{2});  // both 2.75 away: the lower id
  EXPECT_FALSE(map.nearest({{0, 0, 0}}, ClassId{9}).has_value());
  EXPECT_FALSE(ObjectMap().nearest({{0, 0, 0}}, std::nullopt).has_value());
}

TEST(ObjectMap, CopiesAreIndependent) {
  ObjectMap map;
  const ObjectId id = map.add(object_in({{0, 0, 0}, {1, 1, 1}}));
  ObjectMap copy = map;
  EXPECT_EQ(copy, map);
  copy.modify(id, [](Object& o) { o.box = {{5, 5, 5}, {6, 6, 6}}; });
  EXPECT_EQ(map.query(Box{{0, 0, 0}, {1, 1, 1}}).size(), 1U);
  EXPECT_TRUE(copy.query(Box{{0, 0, 0}, {1, 1, 1}}).empty());
  const ObjectMap moved = std::move(copy);
  EXPECT_EQ(moved.query(Box{{5, 5, 5}, {6, 6, 6}}).size(), 1U);
}

TEST(ObjectMap, CopiesOfEveryMomentStayWhatTheyWere) {
  std::mt19937 random(4);
  ObjectMap map;
  std::vector<std::pair<ObjectMap, std::vector<Object>>> moments;
  for (std::uint32_t i = 1; i <= 400; ++i) {
    const ObjectId some{static_cast<std::uint32_t>(random() % i + 1)};
    if (random() % 2 == 0 || !map.contains(some)) {
      (void)map.add(object_in(random_box(random)));
    } else if (random() % 3 == 0) {
      EXPECT_TRUE(map.erase(some));
    } else {
      map.modify(some, [&](Object& o) {
        o.box = random_box(random);
        ++o.num_observations;
      });
    }
    if (i % 20 == 0) {
      moments.emplace_back(map, std::vector<Object>(map.objects().begin(), map.objects().end()));
    }
  }
  for (const auto& [then, expected] : moments) {
    EXPECT_EQ(std::vector<Object>(then.objects().begin(), then.objects().end()), expected);
    EXPECT_EQ(then.size(), expected.size());
    const ObjectMap again = ObjectMap::restore(expected, then.next_id()).value();
    EXPECT_EQ(again, then);
    const Box box = random_box(random);
    EXPECT_EQ(then.query(box), again.query(box));
  }
}

TEST(ObjectMap, IdsMayLieFarApart) {
  std::vector<Object> objects(4);
  std::uint32_t x = 0;
  for (const std::uint32_t id : {4'000'000'000U, 1U, 2048U, 2047U}) {
    objects[x].id = ObjectId{id};
    objects[x].box = {{1.0 * x, 0, 0}, {1.0 * x, 0, 0}};
    ++x;
  }
  ObjectMap map = ObjectMap::restore(objects, ObjectId{4'000'000'001U}).value();
  std::vector<std::uint32_t> ids;
  for (const Object& object : map.objects()) ids.push_back(object.id.value);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{1, 2047, 2048, 4'000'000'000U}));
  EXPECT_TRUE(map.erase(ObjectId{2048}));
  EXPECT_EQ(map.find(ObjectId{2049}), nullptr);
  EXPECT_EQ(map.at(ObjectId{4'000'000'000U}).id.value, 4'000'000'000U);
  EXPECT_EQ(map.size(), 3U);
}

TEST(ObjectMap, WhatIsStoredComesBackAndNonsenseIsRefused) {
  ObjectMap map;
  (void)map.add(object_in({{0, 0, 0}, {1, 1, 1}}));
  (void)map.add(object_in({{2, 0, 0}, {3, 1, 1}}));
  (void)map.erase(ObjectId{1});
  const std::vector<Object> objects(map.objects().begin(), map.objects().end());
  const ObjectMap again = ObjectMap::restore(objects, map.next_id()).value();
  EXPECT_EQ(again, map);
  EXPECT_EQ(again.query(Box{{2, 0, 0}, {3, 1, 1}}).size(), 1U);
  EXPECT_FALSE(ObjectMap::restore(objects, ObjectId{2}).has_value());
  EXPECT_FALSE(ObjectMap::restore({Object{}}, ObjectId{2}).has_value());
  EXPECT_FALSE(ObjectMap::restore({objects[0], objects[0]}, ObjectId{9}).has_value());
  Object inside_out = objects[0];
  inside_out.box.max_in_map.x() = -9.0;
  EXPECT_FALSE(ObjectMap::restore({inside_out}, ObjectId{9}).has_value());
}

}  // namespace
}  // namespace hypermap
