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
  const auto layer =
      SemanticLayer::create({{.id = 0, .name = "shelf", .parts = {square}, .extra = box_of("2.5")},
                             {.id = 1, .name = "shelf", .parts = {square}, .extra = box_of("high")},
                             {.id = 2, .name = "shelf", .parts = {square}, .extra = box_of("nan")},
                             {.id = 3, .name = "shelf", .parts = {square}, .extra = box_of("-2")}});
  ASSERT_TRUE(layer);
  const auto evaluated = evaluated_objects(*layer);
  EXPECT_DOUBLE_EQ(evaluated[0].size_m, 2.5);
  EXPECT_EQ(evaluated[0].box, (Box{{0, 0, 0}, {1, 1, 2.5}}));
  for (const std::size_t i : {1U, 2U, 3U}) {
    EXPECT_DOUBLE_EQ(evaluated[i].size_m, 1.0);  // the footprint's
    EXPECT_FALSE(evaluated[i].box);
  }
}

TEST(EvaluatedObjects, KnowWhatATruthSaysOfWhatWasSeen) {
  const auto square = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).value();
  const auto with = [&square](std::vector<ValueTree::Entry> extra) {
    SemanticLayer layer =
        SemanticLayer::create(
            {{.id = 0, .name = "shelf", .parts = {square}, .extra = make_map(std::move(extra))}})
            .value();
    return evaluated_objects(layer).front();
  };
  const EvaluatedObject seen = with({{"frames_named", make_number(12)},
                                     {"seen_footprint", make_number(0.25)},
                                     {"nameable", make_bool(false)}});
  EXPECT_EQ(seen.frames_named, 12U);
  EXPECT_EQ(seen.seen_footprint_share, 0.25);
  EXPECT_FALSE(seen.is_nameable);
  const EvaluatedObject odd =
      with({{"frames_named", make_number(-1)}, {"seen_footprint", make_text("half")}});
  EXPECT_FALSE(odd.frames_named);
  EXPECT_FALSE(odd.seen_footprint_share);
  EXPECT_TRUE(odd.is_nameable);
}

}  // namespace
}  // namespace hypermap
