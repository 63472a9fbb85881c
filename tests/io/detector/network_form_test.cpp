// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/detector/network_form.hpp"

#include "io/detector/tiny_networks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::detection_output;
using test::expect_box;
using test::expect_scores;
using test::kTinyCells;
using test::kTinySide;
using test::look;
using test::only;
using test::refusal;
using test::table;
using test::TinyOutput;
using test::two_classes;
using test::two_outputs;
using test::yolov5;
using test::yolov8;
using test::yolox;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(NetworkForm, ARowOfYolov5IsInPixelsWithItsObjectness) {
  // 63 rows, three a cell. Centre (12, 10), size 8 x 4; 0.8 * 0.75.
  const Detection found =
      only(look({yolov5(table(63, 7, {{10, {12, 10, 8, 4, 0.8F, 0.25F, 0.75F}}}))}),
           NetworkForm::kYolov5);
  expect_box(found, {8, 8, 16, 12});
  expect_scores(found, 0.6, 0.25, 0.75);
}

TEST(NetworkForm, AColumnOfYolov8IsInPixelsWithoutObjectness) {
  const Detection found =
      only(look({yolov8(table(kTinyCells, 6, {{5, {12, 10, 8, 4, 0.2F, 0.6F}}}))}),
           NetworkForm::kYolov8);
  expect_box(found, {8, 8, 16, 12});
  expect_scores(found, 0.6, 0.25, 0.75);
}

TEST(NetworkForm, ARowOfSsdHasCornersAsSharesAndTheBackgroundFirst) {
  // The second row is the same object, worse: suppressed. The third is background.
  const Detection found =
      only(look(two_outputs("boxes",
                            {0.25F, 0.5F, 0.75F, 1, 0.25F, 0.5F, 0.75F, 0.9F, 0, 0, 1, 1},
                            "scores",
                            {0.2F, 0.2F, 0.6F, 0.4F, 0.1F, 0.5F, 0.99F, 0.005F, 0.005F})),
           NetworkForm::kSsd);
  expect_box(found, {8, 16, 24, 32});
  expect_scores(found, 0.6, 0.25, 0.75);
}

TEST(NetworkForm, ADetectionOutputNamesOneClassARow) {
  // Class 2 of 1, 2; the rest of the score is the other class's. Image -1 and class 0 are none.
  const Detection found = only(look({detection_output({0,  2, 0.9F, 0.25F, 0.25F, 0.5F, 0.75F,  //
                                                       0,  0, 0.9F, 0.25F, 0.25F, 0.5F, 0.75F,  //
                                                       -1, 1, 0.9F, 0,     0,     1,    1})}),
                               NetworkForm::kSsd);
  expect_box(found, {8, 8, 16, 24});
  expect_scores(found, 0.9, 0.1, 0.9);
}

TEST(NetworkForm, ARowOfDetrHasLogitsWithNoObjectLastAndIsNotSuppressed) {
  // Odds 1 : 3 : 4, so probabilities 1/8, 3/8 and 1/2 of no object. Odds 1 : 1 : 9 are nothing.
  const float log3 = std::log(3.0F);
  const float log4 = std::log(4.0F);
  const auto seen = look(two_outputs("pred_boxes",
                                     {0.5F,
                                      0.5F,
                                      0.25F,
                                      0.5F,
                                      0.5F,
                                      0.5F,
                                      0.25F,
                                      0.5F,  //
                                      0.5F,
                                      0.5F,
                                      0.25F,
                                      0.5F},
                                     "logits",
                                     {0, log3, log4, 0, 0, std::log(9.0F), 0, log3, log4}));
  ASSERT_TRUE(seen) << refusal(seen);
  EXPECT_EQ(seen->form, NetworkForm::kDetr);
  ASSERT_THAT(seen->detections, SizeIs(2));
  expect_box(seen->detections[0], {12, 8, 20, 24});
  expect_scores(seen->detections[0], 0.375, 0.25, 0.75);
}

/// Two classes, then eight logits a side: bin 1; bin 1; bins 0 and 1 alike; all alike.
std::vector<float> nanodet_row() {
  std::vector<float> row(34, -50.0F);
  row[0] = 0.2F;
  row[1] = 0.6F;
  row[2 + 1] = 50.0F;
  row[2 + 8 + 1] = 50.0F;
  row[2 + 16] = 50.0F;
  row[2 + 16 + 1] = 50.0F;
  return row;
}

TEST(NetworkForm, ARowOfNanodetIsTheMeanDistanceToEachSide) {
  // Row 5 is column 1, row 1 of stride 8, its point (12, 12). Distances in strides: 1, 1, 0.5 and
  // the mean of 0 .. 7, 3.5, which ends 28 pixels below, beyond the image.
  const Detection found =
      only(look({{"output", {1, kTinyCells, 34}, table(kTinyCells, 34, {{5, nanodet_row()}})}}),
           NetworkForm::kNanodet);
  expect_box(found, {4, 4, 16, 32});
  expect_scores(found, 0.6, 0.25, 0.75);
}

TEST(NetworkForm, NanodetWithAFourthGridHasItsPointsAtTheCorners) {
  // 22 rows: the last is the one cell of stride 64. The point of row 5 is (8, 8).
  const Detection found = only(look({{"output", {1, 22, 34}, table(22, 34, {{5, nanodet_row()}})}}),
                               NetworkForm::kNanodet);
  expect_box(found, {0, 0, 12, 32});
}

TEST(NetworkForm, OfOneShapeTheNamesOrTheOptionTell) {
  const std::vector<float> boxes{0.25F, 0.5F, 0.75F, 1};
  const std::vector<float> scores{0.2F, 0.2F, 0.6F};
  const auto unnamed = two_outputs("a", boxes, "b", scores);
  EXPECT_THAT(refusal(look(unnamed)),
              HasSubstr("gives a 1 x 1 x 4, b 1 x 1 x 3, which may be ssd or detr: say which"));
  OnnxDetectorOptions said = two_classes();
  said.network_form = NetworkForm::kSsd;
  expect_scores(only(look(unnamed, ColorImage(kTinySide, kTinySide), said), NetworkForm::kSsd),
                0.6,
                0.25,
                0.75);
  said.network_form = NetworkForm::kDetr;
  said.min_score = 0.4;
  // e^0.2 : e^0.2 : e^0.6 of 4.265, no object last: 0.286 each.
  EXPECT_THAT(look(unnamed, ColorImage(kTinySide, kTinySide), said)->detections, SizeIs(0));
}

TEST(NetworkForm, WhatIsOfNoFormIsRefusedWithItsShapesAndThoseKnown) {
  const std::string none =
      refusal(look({{"first", {1, 20, 7}, table(20, 7, {})}, {"second", {1, 5}, table(1, 5, {})}}));
  EXPECT_THAT(none, HasSubstr("m.onnx"));
  EXPECT_THAT(none,
              HasSubstr("gives first 1 x 20 x 7, second 1 x 5, expected yolox 1 x 21 x 7; "
                        "yolov5 1 x 63 x 7; yolov8 1 x 6 x 21; ssd 1 x N x 4 and 1 x N x 3 "
                        "or 1 x 1 x N x 7; detr 1 x N x 4 and 1 x N x 3; nanodet 1 x 21 x (2 "
                        "+ 4 B); mask_rcnn boxes N x 4, labels N, scores N and masks N x K x H x W "
                        "for 2 classes and an input of 32 pixels"));
  OnnxDetectorOptions said = two_classes();
  said.network_form = NetworkForm::kYolov8;
  EXPECT_THAT(
      refusal(look({yolox(table(kTinyCells, 7, {}))}, ColorImage(kTinySide, kTinySide), said)),
      HasSubstr("gives output 1 x 21 x 7, expected yolov8 1 x 6 x 21 for 2 classes"));
  OnnxDetectorOptions three = two_classes();
  three.class_names.emplace_back("table");
  EXPECT_THAT(
      refusal(look({yolox(table(kTinyCells, 7, {}))}, ColorImage(kTinySide, kTinySide), three)),
      HasSubstr("for 3 classes"));
}

TEST(NetworkForm, OutputsOfHostileNumbersAreRefusedOrNothing) {
  const auto filled = [](std::size_t count, float value) {
    return std::vector<float>(count, value);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float value : {nan, infinite, 1e30F, 2.0F}) {
    const std::vector<std::vector<TinyOutput>> networks{
        {yolox(filled(kTinyCells * 7, value))},
        {yolov5(filled(kTinyCells * 21, value))},
        {yolov8(filled(kTinyCells * 6, value))},
        {detection_output(filled(14, value))},
        two_outputs("boxes", filled(8, value), "scores", filled(6, value)),
        {{"output", {1, kTinyCells, 34}, filled(kTinyCells * 34, value)}}};
    for (const auto& network : networks) {
      EXPECT_THAT(refusal(look(network)), HasSubstr("row 0 does not"))
          << network.front().name << " " << value;
    }
    const auto detr = look(two_outputs("pred_boxes", filled(8, value), "logits", filled(6, value)));
    // All logits alike are odds of one to one to one.
    if (std::isfinite(value)) {
      EXPECT_TRUE(detr) << refusal(detr);
    } else {
      EXPECT_THAT(refusal(detr), HasSubstr("row 0 does not"));
    }
  }
  for (const float value : {0.0F, -1.0F, -1e30F, -infinite}) {
    EXPECT_THAT(look({yolov5(filled(kTinyCells * 21, value))})->detections, SizeIs(0)) << value;
    EXPECT_THAT(look({yolov8(filled(kTinyCells * 6, value))})->detections, SizeIs(0)) << value;
    EXPECT_THAT(look({detection_output(filled(14, value))})->detections, SizeIs(0)) << value;
  }
  EXPECT_THAT(refusal(look({detection_output({0, 3, 0.9F, 0, 0, 1, 1})})),
              HasSubstr("row 0 does not"));
}

}  // namespace
}  // namespace hypermap
