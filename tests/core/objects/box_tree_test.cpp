// SPDX-License-Identifier: BSD-3-Clause
#include "objects/map/box_tree.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace hypermap {
namespace {

using Boxes = std::map<ObjectId, Box>;

Box random_cuboid(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> size(0.0, 1.0);
  const Eigen::Vector3d corner(place(random), place(random), place(random));
  return {corner, corner + Eigen::Vector3d(size(random), size(random), size(random))};
}

std::vector<ObjectId> looked_at_all(const Boxes& boxes, const Box& query) {
  std::vector<ObjectId> ids;
  for (const auto& [id, box] : boxes) {
    if (box.intersects(query)) ids.push_back(id);
  }
  return ids;
}

TEST(BoxTree, AgreesWithLookingAtAllAndCopiesStayWhatTheyWere) {
  std::mt19937 random(7);
  BoxTree tree;
  Boxes boxes;
  std::vector<std::pair<BoxTree, Boxes>> moments;
  for (std::uint32_t i = 1; i <= 3000; ++i) {
    if (!boxes.empty() && random() % 3 == 0) {
      auto it = boxes.lower_bound(ObjectId{static_cast<std::uint32_t>(random() % i)});
      if (it == boxes.end()) it = boxes.begin();
      tree = tree.without(it->second, it->first);
      boxes.erase(it);
    } else {
      const Box box = random_cuboid(random);
      tree = tree.with(box, ObjectId{i});
      boxes[ObjectId{i}] = box;
    }
    if (i % 300 == 0) moments.emplace_back(tree, boxes);
  }
  for (const auto& [then, expected] : moments) {
    for (int i = 0; i < 50; ++i) {
      const Box query = random_cuboid(random);
      EXPECT_EQ(then.query(query), looked_at_all(expected, query));
    }
  }
  while (!boxes.empty()) {
    tree = tree.without(boxes.begin()->second, boxes.begin()->first);
    boxes.erase(boxes.begin());
  }
  EXPECT_TRUE(tree.query({Eigen::Vector3d::Constant(-9), Eigen::Vector3d::Constant(9)}).empty());
}

TEST(BoxTree, EqualBoxesAreToldApart) {
  BoxTree tree;
  for (std::uint32_t id = 1; id <= 100; ++id) tree = tree.with({}, ObjectId{id});
  for (std::uint32_t id = 1; id <= 100; id += 2) tree = tree.without({}, ObjectId{id});
  const std::vector<ObjectId> left = tree.query({});
  ASSERT_EQ(left.size(), 50U);
  EXPECT_EQ(left.front(), ObjectId{2});
  EXPECT_EQ(tree.nearest({1, 0, 0}, [](ObjectId) { return true; }), ObjectId{2});
}

TEST(BoxTree, TheNearestAcceptedOneAgreesWithLookingAtAll) {
  std::mt19937 random(9);
  BoxTree tree;
  Boxes boxes;
  for (std::uint32_t id = 1; id <= 500; ++id) {
    boxes[ObjectId{id}] = random_cuboid(random);
    tree = tree.with(boxes[ObjectId{id}], ObjectId{id});
  }
  const auto is_odd = [](ObjectId id) { return id.value % 2 == 1; };
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d point = random_cuboid(random).min_in_map;
    std::optional<ObjectId> expected;
    double nearest = 1e9;
    for (const auto& [id, box] : boxes) {
      const Eigen::Vector3d inside = point.cwiseMax(box.min_in_map).cwiseMin(box.max_in_map);
      const double distance = (inside - point).squaredNorm();
      if (!is_odd(id) || distance >= nearest) continue;
      nearest = distance;
      expected = id;
    }
    EXPECT_EQ(tree.nearest(point, is_odd), expected);
  }
  EXPECT_FALSE(tree.nearest({0, 0, 0}, [](ObjectId) { return false; }).has_value());
}

}  // namespace
}  // namespace hypermap
