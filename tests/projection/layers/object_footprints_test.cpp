// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/object_footprints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Polygon square(double x, double edge) {
  return *make_polygon({{x, 0}, {x + edge, 0}, {x + edge, edge}, {x, edge}});
}

Object chair(std::uint32_t id) {
  Object object;
  object.id = ObjectId{id};
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{1}, Probability(0.9)}},
                        Probability(0.5));
  object.box = {.min_in_map = {0, 0, 0}, .max_in_map = {1, 2, 1}};
  return object;
}

ClassRegistry registry() {
  ClassRegistry classes;
  EXPECT_TRUE(classes.add("table"));
  EXPECT_TRUE(classes.add("chair"));
  return classes;
}

TEST(ObjectFootprints, EachPolicyShowsItsShape) {
  Object object = chair(5);
  // Hulls of two squares side by side: 0..1 and 0..3; the mean centroid is (1, 1), nearer to the
  // second one's (1.5, 1.5) than to (0.5, 0.5)? Both are 0.707 away: the earlier one counts.
  object.shapes.add(square(0, 1));
  object.shapes.add(square(0, 3));
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      points.emplace_back(0.1F * static_cast<float>(i), 0.1F * static_cast<float>(j), 0.5F);
    }
  }
  object.points.observe(points);
  const std::vector<const Object*> objects = {&object};
  const auto area = [&](ShapePolicy policy) {
    const auto out = project_footprints(objects, registry(), {.policy = policy});
    EXPECT_THAT(out->from_box, IsEmpty());
    return area_m2(out->layer.objects().front().parts.front());
  };
  EXPECT_NEAR(area(ShapePolicy::kBest), 1.0, 1e-9);
  EXPECT_NEAR(area(ShapePolicy::kHull), 9.0, 1e-9);
  EXPECT_NEAR(area(ShapePolicy::kVoxels), 1.0, 0.15);
}

/// Free voxels of 5 cm over the square from 0 to 1 m, and a layer below.
void visit_free_square(const LeafVisitor& visit) {
  LeafSample leaf;
  leaf.edge_m = 0.05;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (int k = -1; k < 20; ++k) {
        leaf.centre_in_map = 0.05 * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5);
        visit(leaf);
      }
    }
  }
}

TEST(ObjectFootprints, AreCarvedByTheMapWhenTheyAreOfVoxels) {
  Object object = chair(5);
  object.shapes.add(square(0, 1));
  std::vector<Eigen::Vector3f> points;  // Two sides of the square.
  for (int i = 0; i < 100; ++i) {
    const float along = 0.01F * static_cast<float>(i) + 0.005F;
    points.emplace_back(along, 0.005F, 0.5F);
    points.emplace_back(0.005F, along, 0.5F);
  }
  object.points.observe(points);
  const std::vector<const Object*> objects = {&object};
  const auto area = [&](ShapePolicy policy, std::optional<CarvingMap> carving) {
    const auto out =
        project_footprints(objects, registry(), {.policy = policy, .carving = std::move(carving)});
    return area_m2(out->layer.objects().front().parts.front());
  };
  EXPECT_NEAR(area(ShapePolicy::kVoxels, {}), 0.5, 0.02);
  EXPECT_LT(area(ShapePolicy::kVoxels, CarvingMap{visit_free_square, 0.05}), 0.1);
  EXPECT_NEAR(area(ShapePolicy::kHull, CarvingMap{visit_free_square, 0.05}), 1.0, 1e-9)
      << "[hypermap]'s shapes stay";
}

TEST(ObjectFootprints, AnObjectWithoutShapesShowsItsBoxAndThatIsSaid) {
  const Object object = chair(5);
  const auto out = project_footprints(std::vector<const Object*>{&object}, registry());
  ASSERT_TRUE(out);
  EXPECT_THAT(out->from_box, ElementsAre(ObjectId{5}));
  const SemanticObject& entry = out->layer.objects().front();
  EXPECT_EQ(entry.id, 5U);
  EXPECT_EQ(entry.name, "chair");
  EXPECT_THAT(entry.tags, ElementsAre("chair"));
  EXPECT_THAT(entry.confidence, ElementsAre(object_confidence(object).value()));
  EXPECT_NEAR(area_m2(entry.parts.front()), 2.0, 1e-12);
}

TEST(ObjectFootprints, WhatHasNoNameOrNoExtentIsLeftOutAndCounted) {
  Object nameless;
  nameless.id = ObjectId{1};
  nameless.box = {.min_in_map = {0, 0, 0}, .max_in_map = {1, 1, 1}};
  Object flat = chair(2);
  flat.box.max_in_map = flat.box.min_in_map;
  const auto out = project_footprints(std::vector<const Object*>{&nameless, &flat}, registry());
  ASSERT_TRUE(out);
  EXPECT_THAT(out->left_out, ElementsAre(ObjectId{1}, ObjectId{2}));
  EXPECT_TRUE(out->layer.objects().empty());
}

TEST(ObjectFootprints, AClassOutsideTheRegistryIsRefused) {
  const Object object = chair(5);
  EXPECT_EQ(project_footprints(std::vector<const Object*>{&object}, ClassRegistry()).error().field,
            "class");
}

}  // namespace
}  // namespace hypermap
