// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/intrinsics_file.hpp"

#include "support/temp_dir.hpp"
#include "support/test_data.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

Result<Loaded<Intrinsics>> read(const std::string& text) {
  const TempDir dir;
  write_text(dir / "k", text);
  return read_intrinsics(dir / "k");
}

std::string intrinsics_refusal(const std::string& text) {
  const auto loaded = read(text);
  return loaded ? "was accepted" : to_string(loaded.error());
}

Intrinsics camera(std::optional<int> width, std::optional<int> height) {
  Intrinsics k;
  k.fx_px = 525.0;
  k.fy_px = 526.0;
  k.cx_px = 319.5;
  k.cy_px = 239.5;
  k.width_px = width;
  k.height_px = height;
  return k;
}

TEST(IntrinsicsFile, EveryFormGivesTheSameCamera) {
  const auto ours =
      read(R"({"width": 640, "height": 480, "fx": 525, "fy": 526, "cx": 319.5, "cy": 239.5})");
  ASSERT_TRUE(ours) << to_string(ours.error());
  EXPECT_EQ(ours->value, camera(640, 480));
  const auto open3d = read(  // column by column
      R"({"width": 640, "height": 480, "intrinsic_matrix": [525, 0, 0, 0, 526, 0, 319.5, 239.5, 1]})");
  ASSERT_TRUE(open3d) << to_string(open3d.error());
  EXPECT_EQ(open3d->value, camera(640, 480));
  const auto ros = read(
      "image_width: 640\nimage_height: 480\ncamera_name: c\n"
      "camera_matrix: {rows: 3, cols: 3, data: [525, 0, 319.5, 0, 526, 239.5, 0, 0, 1]}\n");
  ASSERT_TRUE(ros) << to_string(ros.error());
  EXPECT_EQ(ros->value, camera(640, 480));
  const auto message =
      read("height: 480\nwidth: 640\nK: [525, 0, 319.5, 0, 526, 239.5, 0, 0, 1]\n");
  ASSERT_TRUE(message) << to_string(message.error());
  EXPECT_EQ(message->value, camera(640, 480));
  const auto matrix = read("525 0 319.5\n0 526 239.5\n0 0 1\n");
  ASSERT_TRUE(matrix) << to_string(matrix.error());
  EXPECT_EQ(matrix->value, camera(std::nullopt, std::nullopt));
  const auto scannet = read("525 0 319.5 0\n0 526 239.5 0\n0 0 1 0\n0 0 0 1\n");
  ASSERT_TRUE(scannet) << to_string(scannet.error());
  EXPECT_EQ(scannet->value, camera(std::nullopt, std::nullopt));
}

TEST(IntrinsicsFile, FieldsOutOfRangeAreNamed) {
  const auto with = [](const std::string& key, const std::string& value) {
    std::string text = "{";
    for (const auto& [k, v] : {std::pair<std::string, std::string>{"width", "640"},
                               {"height", "480"},
                               {"fx", "525"},
                               {"fy", "525"},
                               {"cx", "319.5"},
                               {"cy", "239.5"},
                               {"depth_scale", "1000"}}) {
      text += (text.size() > 1 ? ", \"" : "\"") + k + "\": " + (k == key ? value : v);
    }
    return intrinsics_refusal(text + "}");
  };
  EXPECT_EQ(with("", ""), "was accepted");
  EXPECT_THAT(with("fx", "0"), HasSubstr("fx: must be > 0, is 0"));
  EXPECT_THAT(with("fy", "-1"), HasSubstr("fy: must be > 0, is -1: negative fy (y of the camera"));
  EXPECT_THAT(with("fx", "-1"), Not(HasSubstr("negative fy")));
  EXPECT_THAT(with("fx", "null"), HasSubstr("$.fx: is null, expected a number"));
  EXPECT_THAT(with("fx", "NaN"), HasSubstr("$.fx"));
  EXPECT_THAT(with("fx", "1e999"), HasSubstr("$.fx"));
  EXPECT_THAT(with("width", "-640"), HasSubstr("$.width"));
  EXPECT_THAT(with("width", "640.5"), HasSubstr("$.width"));
  EXPECT_THAT(with("width", "1000000000"), HasSubstr("in 1 .. 65535"));
  EXPECT_THAT(with("cx", "961"), HasSubstr("cx: must be inside the image"));
  EXPECT_EQ(with("cx", "960"), "was accepted");
  EXPECT_THAT(with("depth_scale", "0"), HasSubstr("depth_scale: must be > 0"));
  EXPECT_THAT(intrinsics_refusal(R"({"width": 640, "height": 480, "fx": 525})"),
              HasSubstr("\"fy\""));
  EXPECT_THAT(intrinsics_refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(intrinsics_refusal("525 0 319.5\n0 526 239.5\n0 0\n"), HasSubstr("has 8 numbers"));
  EXPECT_THAT(intrinsics_refusal("525 0 319.5\n1 526 239.5\n0 0 1\n"),
              HasSubstr("must have the form"));
}

TEST(IntrinsicsFile, DistortionIsAFindingUnlessItIsZero) {
  const std::string camera_info =
      "width: 640\nheight: 480\nK: [525, 0, 319.5, 0, 526, 239.5, 0, 0, 1]\n";
  EXPECT_THAT(read(camera_info + "D: [0, 0, 0, 0, 0]\n")->findings, SizeIs(0));
  EXPECT_THAT(read(camera_info + "D: [0.1, 0, 0, 0, 0]\n")->findings, SizeIs(1));
}

TEST(IntrinsicsFile, TheSizeComesFromTheImagesWhenNoneIsStated) {
  EXPECT_EQ(camera_of(camera(std::nullopt, std::nullopt), 640, 480)->width_px, 640);
  EXPECT_THAT(to_string(camera_of(camera(640, 480), 320, 240).error()),
              HasSubstr("must be the images' 320 x 240, is 640 x 480"));
}

TEST(IntrinsicsFile, WhatIsWrittenReadsBackTheSame) {
  const PinholeCamera written{640, 480, 525.1, 1.0 / 3.0, 319.5, 239.5};
  const auto loaded = read(to_intrinsics_json(written, 5000.0));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(*camera_of(loaded->value, 640, 480), written);
  EXPECT_EQ(loaded->value.depth_units_per_m, 5000.0);
}

}  // namespace
}  // namespace hypermap
