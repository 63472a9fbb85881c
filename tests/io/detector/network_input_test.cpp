// SPDX-License-Identifier: BSD-3-Clause
// How an image goes into a network, and its boxes come out.
#include "network_input.hpp"

#include "io/detector/tiny_networks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

using test::detection_output;
using test::expect_box;
using test::kTinyCells;
using test::kTinySide;
using test::look;
using test::only;
using test::table;
using test::TempDir;
using test::TinyOutput;
using test::two_classes;
using test::write_text;
using test::yolov8;
using test::yolox;
using ::testing::HasSubstr;

TEST(NetworkInput, BoxesLieInTheImageAsItLiesInTheInput) {
  // 64 x 32 pixels, half as large 32 x 16. The box is 8 .. 16 across and down.
  const auto box = [](ImageFit fit) {
    OnnxDetectorOptions options = two_classes();
    options.image_fit = fit;
    return only(look({yolov8(table(kTinyCells, 6, {{0, {12, 12, 8, 8, 0.2F, 0.6F}}}))},
                     ColorImage(64, 32),
                     options),
                NetworkForm::kYolov8)
        .box_px;
  };
  EXPECT_EQ(box(ImageFit::kCorner), (PixelBox{16, 16, 32, 32}));
  EXPECT_EQ(box(ImageFit::kCentre), (PixelBox{16, 0, 32, 16}));
  EXPECT_EQ(box(ImageFit::kAuto), (PixelBox{16, 0, 32, 16}));  // as YOLOv8 is trained
  EXPECT_EQ(box(ImageFit::kStretch), (PixelBox{16, 8, 32, 16}));
}

/// A box from corner (0, 0) whose width is the input's first channel and height its third, in
/// shares of the input.
Detection box_of_colors(const OnnxDetectorOptions& options) {
  TinyOutput output = detection_output({0, 2, 0.9F, 0, 0, 0, 0});
  output.weights.assign(21, 0.0F);
  output.weights[std::size_t{5} * 3] = 1.0F;
  output.weights[std::size_t{6} * 3 + 2] = 1.0F;
  return only(look({output}, ColorImage(kTinySide, kTinySide, Rgb8{191, 100, 159}), options),
              NetworkForm::kSsd);
}

TEST(NetworkInput, ColoursGoInAsTheFormIsTrainedOrTheOptionsSay) {
  OnnxDetectorOptions options = two_classes();
  // SSD: red, green, blue; (191 - 127) / 128 = 0.5, (159 - 127) / 128 = 0.25.
  expect_box(box_of_colors(options), {0, 0, 16, 8});
  options.channel_order = ChannelOrder::kBgr;
  expect_box(box_of_colors(options), {0, 0, 8, 16});
  options.channel_mean = {95, 0, 95};
  options.channel_stddev = {128, 1, 256};
  // Blue first: (159 - 95) / 128 = 0.5, (191 - 95) / 256 = 0.375.
  expect_box(box_of_colors(options), {0, 0, 16, 12});
}

TEST(NetworkInput, TheSideIsThatOfTheFile) {
  const TempDir dir;
  OnnxDetectorOptions options = two_classes();
  options.input_side_px = 0;
  ClassRegistry registry;
  const std::vector<TinyOutput> outputs{yolox(table(kTinyCells, 7, {}))};
  write_text(dir / "m.onnx", test::tiny_onnx(kTinySide, kTinySide, outputs));
  EXPECT_TRUE(OnnxDetector::load(dir / "m.onnx", options, registry));
  write_text(dir / "m.onnx", test::tiny_onnx(64, kTinySide, outputs));
  const auto oblong = OnnxDetector::load(dir / "m.onnx", options, registry);
  ASSERT_FALSE(oblong);
  EXPECT_THAT(to_string(oblong.error()), HasSubstr("takes images of 64 x 32 pixels, expected"));
}

TEST(NetworkInput, ChannelOptionsGoTogether) {
  OnnxDetectorOptions options = two_classes();
  options.channel_mean = {127, 127, 127};
  EXPECT_THAT(to_string(validate(options).error()), HasSubstr("channel_stddev"));
  options.channel_stddev = {128, 128, 128};
  EXPECT_TRUE(validate(options));
  options.channel_stddev[1] = 0.0;
  EXPECT_FALSE(validate(options));
}

}  // namespace
}  // namespace hypermap
