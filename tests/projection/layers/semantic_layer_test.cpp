// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Polygon square_around(double x, double y, double edge = 1.0) {
  return *make_polygon({{x, y}, {x + edge, y}, {x + edge, y + edge}, {x, y + edge}});
}

SemanticObject object(std::uint64_t id, const std::string& name, Polygon shape) {
  return {.id = id, .name = name, .parts = {std::move(shape)}};
}

TEST(SemanticLayer, ObjectsAreFoundByPlaceAndName) {
  const auto layer = SemanticLayer::create({object(4, "cup", square_around(0, 0)),
                                            object(2, "chair", square_around(0.5, 0.5)),
                                            object(9, "cup", square_around(5, 5))});
  ASSERT_TRUE(layer);
  EXPECT_THAT(layer->at({0.7, 0.7}), ElementsAre(2, 4));
  EXPECT_THAT(layer->at({0, 0}), ElementsAre(4));  // a corner belongs to the shape
  EXPECT_THAT(layer->at({3, 3}), IsEmpty());
  EXPECT_THAT(layer->at({std::nan(""), 3}), IsEmpty());
  EXPECT_THAT(layer->named("cup"), ElementsAre(4, 9));
  EXPECT_THAT(layer->named("Cup"), IsEmpty());
  EXPECT_THAT(layer->of_class("Cup"), ElementsAre(4, 9));
  EXPECT_THAT(layer->in(square_around(1.2, 1.2, 4)), ElementsAre(2, 9));
}

TEST(SemanticLayer, OverlappingBoundsAreNotYetMeeting) {
  // The triangle's bounds hold (0.9, 0.9); the triangle does not.
  const auto layer =
      SemanticLayer::create({object(0, "a", *make_polygon({{0, 0}, {1, 0}, {0, 1}}))});
  EXPECT_THAT(layer->at({0.9, 0.9}), IsEmpty());
  EXPECT_THAT(layer->in(square_around(0.8, 0.8, 0.1)), IsEmpty());
  EXPECT_THAT(layer->in(square_around(0.5, 0.5, 0.1)), ElementsAre(0));  // touches at (0.5, 0.5)
}

TEST(SemanticLayer, QueriesAgreeWithALinearSearch) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10);
  std::uniform_real_distribution<double> size(0.05, 2);
  std::vector<SemanticObject> objects;
  for (std::uint64_t id = 0; id < 400; ++id) {
    objects.push_back(object(id, "x", square_around(place(random), place(random), size(random))));
  }
  const auto layer = SemanticLayer::create(objects);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d point(place(random), place(random));
    const Polygon area = square_around(place(random), place(random), size(random));
    std::vector<std::uint64_t> at;
    std::vector<std::uint64_t> in;
    for (const SemanticObject& candidate : objects) {
      if (contains(candidate.parts[0], point)) at.push_back(candidate.id);
      if (intersects(candidate.parts[0], area)) in.push_back(candidate.id);
    }
    EXPECT_EQ(layer->at(point), at);
    EXPECT_EQ(layer->in(area), in);
  }
}

TEST(SemanticLayer, EditingKeepsAllIndicesTrue) {
  SemanticLayer layer;
  EXPECT_EQ(layer.next_id(), 0U);
  ASSERT_TRUE(layer.add(object(7, "a", square_around(0, 0))));
  ASSERT_TRUE(layer.add(object(3, "b", square_around(0, 0))));
  EXPECT_EQ(layer.next_id(), 8U);
  EXPECT_FALSE(layer.add(object(3, "c", square_around(0, 0))));
  ASSERT_TRUE(layer.replace(object(3, "c", square_around(4, 4))));
  EXPECT_FALSE(layer.replace(object(5, "c", square_around(4, 4))));
  EXPECT_THAT(layer.at({0.5, 0.5}), ElementsAre(7));
  EXPECT_THAT(layer.named("b"), IsEmpty());
  EXPECT_THAT(layer.named("c"), ElementsAre(3));
  EXPECT_TRUE(layer.erase(7));
  EXPECT_FALSE(layer.erase(7));
  EXPECT_THAT(layer.at({0.5, 0.5}), IsEmpty());
  EXPECT_EQ(layer.objects().size(), 1U);
}

TEST(SemanticLayer, ACopyIsItsOwn) {
  SemanticLayer layer = *SemanticLayer::create({object(1, "a", square_around(0, 0))});
  SemanticLayer copy = layer;
  EXPECT_EQ(copy, layer);
  copy.erase(1);
  EXPECT_NE(copy, layer);
  EXPECT_THAT(layer.at({0.5, 0.5}), ElementsAre(1));
}

TEST(SemanticLayer, SeveralPartsHaveOnePosition) {
  // Squares of area 1 at (0.5, 0.5) and of area 4 at (11, 1): (0.5 + 44) / 5, (0.5 + 4) / 5.
  const SemanticObject both{
      .id = 1, .name = "a", .parts = {square_around(0, 0), square_around(10, 0, 2)}};
  EXPECT_TRUE(position_of(both).isApprox(Eigen::Vector2d(8.9, 0.9), 1e-12));
  const SemanticLayer layer = *SemanticLayer::create({both});
  EXPECT_THAT(layer.at({11, 1}), ElementsAre(1));
  EXPECT_THAT(layer.at({5, 0.5}), IsEmpty());
}

TEST(SemanticLayer, WhatIsNoObjectIsRefusedNamingIt) {
  const auto refused = [](SemanticObject bad) {
    return SemanticLayer().add(std::move(bad)).error();
  };
  EXPECT_EQ(refused(object(1, "", square_around(0, 0))).field, "name");
  EXPECT_EQ(refused(object(1, std::string(257, 'x'), square_around(0, 0))).field, "name");
  EXPECT_EQ(refused(object(1, "\xFF", square_around(0, 0))).field, "name");
  EXPECT_EQ(refused({.id = 1, .name = "a"}).field, "shape");
  SemanticObject unsure = object(1, "a", square_around(0, 0));
  for (const double confidence : {-1.0, 2.0, std::nan("")}) {
    unsure.confidence = {confidence};
    EXPECT_EQ(refused(unsure).field, "confidence");
  }
  unsure.confidence = {0.5, 0.5};
  unsure.tags = {"one"};
  EXPECT_EQ(refused(unsure).field, "confidence");
  EXPECT_EQ(SemanticLayer::create(
                {object(1, "a", square_around(0, 0)), object(1, "b", square_around(0, 0))})
                .error()
                .field,
            "id");
}

TEST(SemanticLayer, TheConfidenceIsTheLargestOfItsTags) {
  SemanticObject evaluated_object = object(1, "a", square_around(0, 0));
  EXPECT_FALSE(confidence_of(evaluated_object));
  evaluated_object.tags = {"x", "y"};
  evaluated_object.confidence = {0.3, 0.8};
  EXPECT_EQ(confidence_of(evaluated_object), 0.8);
}

}  // namespace
}  // namespace hypermap
