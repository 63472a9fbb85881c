// SPDX-License-Identifier: BSD-3-Clause
#include "mask_grid.hpp"

#include "io/detector/tiny_networks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::kTinyCells;
using test::kTinySide;
using test::look;
using test::only;
using test::refusal;
using test::table;
using test::TinyOutput;
using test::transposed;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Rows of a mask as text, '#' where the object is, of every `step`-th pixel.
std::vector<std::string> drawing(const MaskImage& mask, int step) {
  std::vector<std::string> rows;
  for (int v = 0; v < mask.height_px(); v += step) {
    std::string row;
    for (int u = 0; u < mask.width_px(); u += step) row.push_back(mask.at(u, v) != 0 ? '#' : '.');
    rows.push_back(row);
  }
  return rows;
}

TEST(MaskGrid, ValuesBetweenMiddlesOfCellsAreMixed) {
  // Two cells of 4 input pixels: 0 at 2, 1 at 6. Above a quarter is what lies beyond 3: the
  // middle of pixel 2 does not, 2.5, that of 3 does. The image is the input.
  const MaskGrid grid{
      .place_px = {0, 0, 8, 4}, .width = 2, .height = 1, .values = {0.0F, 1.0F}, .threshold = 0.25};
  const MaskImage mask = drawn(grid, {0, 0, 7, 2}, {.width_px = 8, .height_px = 4}, 8, 4);
  EXPECT_EQ(drawing(mask, 1),
            (std::vector<std::string>{"...####.", "...####.", "........", "........"}));
}

TEST(MaskGrid, AnImageOfAnotherSizeLooksThroughItsPlacement) {
  // 4 x 2 pixels, twice as large in the input, 2 pixels down: the grid's second row of 4 pixels,
  // 4 .. 8, is the image's from 1 on.
  const MaskGrid grid{
      .place_px = {0, 0, 8, 8}, .width = 1, .height = 2, .values = {-1.0F, 1.0F}, .threshold = 0.0};
  const InputPlacement placement{
      .scale_u = 2.0, .scale_v = 2.0, .offset_v_px = 2, .width_px = 8, .height_px = 4};
  EXPECT_EQ(drawing(drawn(grid, {0, 0, 4, 2}, placement, 4, 2), 1),
            (std::vector<std::string>{"....", "####"}));
}

/// Two prototypes of 4 x 4 cells of 8 pixels: 1 in the left half, -1 in the right; 1 above, -1
/// below.
TinyOutput prototypes() {
  std::vector<float> values(32);
  for (std::size_t i = 0; i < 16; ++i) {
    values[i] = i % 4 < 2 ? 1.0F : -1.0F;
    values[16 + i] = i < 8 ? 1.0F : -1.0F;
  }
  return {"output1", {1, 2, 4, 4}, values};
}

/// One column: centre (16, 16), size 32 x 16, so 8 .. 24 down; chair 0.75; factors of prototypes.
TinyOutput yolov8_with_factors(float left, float above) {
  const auto rows = table(kTinyCells, 8, {{3, {16, 16, 32, 16, 0.25F, 0.75F, left, above}}});
  return {"output0", {1, 8, kTinyCells}, transposed(rows, kTinyCells)};
}

TEST(MaskGrid, PrototypesOfYolov8AreSummedByTheRowsFactorsWithinItsBox) {
  const Detection left =
      only(look({yolov8_with_factors(1, 0), prototypes()}), NetworkForm::kYolov8);
  ASSERT_TRUE(left.mask);
  EXPECT_EQ(drawing(*left.mask, 4),
            (std::vector<std::string>{"........",
                                      "........",
                                      "####....",
                                      "####....",
                                      "####....",
                                      "####....",
                                      "........",
                                      "........"}));
  // Right and above: -left + above is 2 there, 0 or less elsewhere; 0 is not the object.
  const Detection corner =
      only(look({yolov8_with_factors(-1, 1), prototypes()}), NetworkForm::kYolov8);
  ASSERT_TRUE(corner.mask);
  EXPECT_EQ(corner.mask->at(24, 10), 1);
  EXPECT_EQ(corner.mask->at(24, 22), 0);
  EXPECT_EQ(corner.mask->at(4, 10), 0);
  EXPECT_EQ(corner.mask->at(24, 4), 0);  // beyond the box
}

TEST(MaskGrid, PrototypesOfYolov5FollowItsClasses) {
  const TinyOutput rows{"output",
                        {1, 3 * kTinyCells, 9},
                        table(3 * kTinyCells, 9, {{3, {16, 16, 32, 16, 1, 0.25F, 0.75F, 0, -1}}})};
  const Detection below = only(look({rows, prototypes()}), NetworkForm::kYolov5);
  ASSERT_TRUE(below.mask);
  EXPECT_EQ(below.mask->at(4, 12), 0);
  EXPECT_EQ(below.mask->at(4, 20), 1);
}

TEST(MaskGrid, PrototypesThatTheRowsHaveNoFactorsForAreNone) {
  const TinyOutput without{"output0", {1, 6, kTinyCells}, std::vector<float>(6 * kTinyCells, 0.0F)};
  EXPECT_TRUE(look({without, prototypes()}));
  const TinyOutput one{"output0", {1, 7, kTinyCells}, std::vector<float>(7 * kTinyCells, 0.0F)};
  EXPECT_THAT(refusal(look({one, prototypes()})), HasSubstr("output1 1 x 2 x 4 x 4, expected"));
}

TEST(MaskGrid, AMaskWithoutAPixelIsNone) {
  EXPECT_FALSE(only(look({yolov8_with_factors(0, 0), prototypes()}), NetworkForm::kYolov8).mask);
}

TEST(MaskGrid, MasksThatAreNotFiniteAreRefused) {
  EXPECT_THAT(refusal(look({yolov8_with_factors(std::nanf(""), 0), prototypes()})),
              HasSubstr("must give finite masks, row 3 does not"));
  TinyOutput huge = prototypes();
  std::ranges::fill(huge.values, 3e38F);
  EXPECT_THAT(refusal(look({yolov8_with_factors(3e38F, 0), huge})), HasSubstr("row 3 does not"));
}

/// Two objects: a chair in 8 .. 24 across and 8 .. 16 down, and background.
std::vector<TinyOutput> mask_rcnn(std::vector<std::int64_t> mask_shape, std::vector<float> masks) {
  return {{"boxes", {2, 4}, {8, 8, 24, 16, 0, 0, 32, 32}},
          {"labels", {2}, {2, 0}},
          {"scores", {2}, {0.9F, 0.9F}},
          {"masks", std::move(mask_shape), std::move(masks)}};
}

TEST(MaskGrid, AMaskOfMaskRcnnIsOfItsBox) {
  // 2 x 1 cells over the box: 1, 0; above 0.5 up to the middle, 16. The other object's are 0.
  const Detection chair = only(look(mask_rcnn({2, 1, 1, 2}, {1, 0, 0, 0})), NetworkForm::kMaskRcnn);
  test::expect_box(chair, {8, 8, 24, 16});
  test::expect_scores(chair, 0.9, 0.1, 0.9);
  ASSERT_TRUE(chair.mask);
  EXPECT_EQ(drawing(*chair.mask, 4),
            (std::vector<std::string>{"........",
                                      "........",
                                      "..##....",
                                      "..##....",
                                      "........",
                                      "........",
                                      "........",
                                      "........"}));
}

TEST(MaskGrid, OfAMaskForEachClassThatOfTheLabelCounts) {
  // Background, cup, chair, of one cell each; then without background. -1: no mask, as it has no
  // pixel.
  const auto num_pixels = [](const Result<test::SeenByNetwork>& seen) {
    const Detection chair = only(seen, NetworkForm::kMaskRcnn);
    return chair.mask ? std::ranges::count(chair.mask->pixels(), std::uint8_t{1}) : -1;
  };
  EXPECT_EQ(num_pixels(look(mask_rcnn({2, 3, 1, 1}, {0, 0, 1, 0, 0, 0}))), 16 * 8);
  EXPECT_EQ(num_pixels(look(mask_rcnn({2, 3, 1, 1}, {1, 1, 0, 1, 1, 1}))), -1);
  EXPECT_EQ(num_pixels(look(mask_rcnn({2, 2, 1, 1}, {0, 1, 0, 0}))), 16 * 8);
  EXPECT_EQ(num_pixels(look(mask_rcnn({2, 2, 1, 1}, {1, 0, 1, 1}))), -1);
}

TEST(MaskGrid, AMaskOfTheInputsSizeIsOfTheInput) {
  const auto side = static_cast<std::size_t>(kTinySide);
  std::vector<float> masks(2 * side * side, 0.0F);
  for (std::size_t i = 0; i < side * side; ++i) {
    masks[i] = i % side < 12 ? 1.0F : 0.0F;  // left of column 12
  }
  const Detection chair =
      only(look(mask_rcnn({2, 1, kTinySide, kTinySide}, masks)), NetworkForm::kMaskRcnn);
  ASSERT_TRUE(chair.mask);
  EXPECT_EQ(chair.mask->at(11, 10), 1);
  EXPECT_EQ(chair.mask->at(12, 10), 0);
  EXPECT_EQ(chair.mask->at(7, 10), 0);  // beyond the box
}

TEST(MaskGrid, MaskRcnnWithoutNamesOrWithHostileNumbersIsRefused) {
  auto unnamed = mask_rcnn({2, 1, 1, 2}, {1, 0, 0, 0});
  unnamed[1].name = "a";
  EXPECT_THAT(refusal(look(unnamed)), HasSubstr("mask_rcnn boxes N x 4, labels N, scores N"));
  auto other_class = mask_rcnn({2, 1, 1, 2}, {1, 0, 0, 0});
  other_class[1].values = {3, 0};
  EXPECT_THAT(refusal(look(other_class)), HasSubstr("row 0 does not"));
  auto inside_out = mask_rcnn({2, 1, 1, 2}, {1, 0, 0, 0});
  inside_out[0].values = {24, 16, 8, 8, 0, 0, 0, 0};
  EXPECT_THAT(look(inside_out)->detections, SizeIs(0));
  auto no_number = mask_rcnn({2, 1, 1, 2}, {std::nanf(""), 0, 0, 0});
  EXPECT_THAT(refusal(look(no_number)), HasSubstr("must give finite masks, row 0 does not"));
}

}  // namespace
}  // namespace hypermap
