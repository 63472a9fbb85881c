// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(EvaluatedObjects, OfAMapLabelledByHandAreItsShapes) {
  const auto square = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto far = make_polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}});
  ASSERT_TRUE(square && far);
  const auto layer = SemanticLayer::create({{.id = 0, .name = "chair", .parts = {*square}},
                                            {.id = 1, .name = "sofa", .parts = {*square, *far}}});
  ASSERT_TRUE(layer);
  const auto evaluated = evaluated_objects(*layer);
  EXPECT_EQ(evaluated[0].class_name, "chair");
  EXPECT_EQ(evaluated[0].footprint, *square);
  EXPECT_DOUBLE_EQ(evaluated[0].size_m, 1.0);
  EXPECT_FALSE(evaluated[0].excluded);
  EXPECT_NEAR(area_m2(evaluated[1].footprint), 3.0, 1e-12);  // hull of both parts
}

TEST(EvaluatedObjects, KnowTheHeightWhenABoxIsWritten) {
  const auto square = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).value();
  const auto box_of = [](const char* height) {
    std::vector<ValueTree> numbers;
    for (const char* number : {"0", "0", "0", "1", "1", height}) {
      numbers.push_back({.kind = ValueKind::kScalar, .text = number});
    }
    return make_map({{"box", make_list(std::move(numbers))}});
  };
  const auto layer = SemanticLayer::create(
      {{.id = 0, .name = "shelf", .parts = {square}, .extra = box_of("2.5")},
       {.id = 1, .name = "shelf", .parts = {square}, .extra = box_of("high")}});
  ASSERT_TRUE(layer);
  const auto evaluated = evaluated_objects(*layer);
  EXPECT_DOUBLE_EQ(evaluated[0].size_m, 2.5);
  EXPECT_DOUBLE_EQ(evaluated[1].size_m, 1.0);  // the footprint's
}

}  // namespace
}  // namespace hypermap
