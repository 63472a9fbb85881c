// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/depth_file.hpp"

#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;

TEST(DepthFile, UnitsBecomeMetresAndInvalidValuesZero) {
  const TempDir dir;
  std::string image = test::pgm16(2500, 2, 2);
  image[image.size() - 1] = '\xFF';  // the last pixel: 65535
  image[image.size() - 2] = '\xFF';
  image[image.size() - 3] = '\0';  // the one before: 0
  image[image.size() - 4] = '\0';
  write_text(dir / "d.pgm", image);
  const auto depth = read_depth(dir / "d.pgm", {.units_per_m = 5000.0});
  ASSERT_TRUE(depth) << to_string(depth.error());
  EXPECT_EQ(depth->at(0, 0), 0.5F);
  EXPECT_EQ(depth->at(0, 1), 0.0F);
  EXPECT_EQ(depth->at(1, 1), 0.0F);
  const auto other = read_depth(dir / "d.pgm", {.units_per_m = 5000.0, .invalid_values = {2500}});
  EXPECT_EQ(other->at(0, 0), 0.0F);
  EXPECT_EQ(other->at(1, 1), 13.107F);  // 65535 / 5000
}

TEST(DepthFile, RotatedBitsAreTurnedBackBeforeAnythingElse) {
  const TempDir dir;
  // 10,000 is 0b0010011100010000; rotated left by 3 bits it is 0b0011100010000001 = 14,465.
  write_text(dir / "d.pgm", test::pgm16(14'465, 2, 1));
  const auto depth = read_depth(dir / "d.pgm", {.rotated_left_bits = 3});
  ASSERT_TRUE(depth) << to_string(depth.error());
  EXPECT_EQ(depth->at(0, 0), 10.0F);
  const auto invalid =
      read_depth(dir / "d.pgm", {.invalid_values = {10'000}, .rotated_left_bits = 3});
  EXPECT_EQ(invalid->at(1, 0), 0.0F);
}

TEST(DepthFile, WhatIsNoDepthImageIsRefusedByName) {
  const TempDir dir;
  const auto refused = [&](const std::string& content, ImageSize size = {}) {
    write_text(dir / "d.pgm", content);
    const auto depth = read_depth(dir / "d.pgm", {}, size);
    return depth ? std::string("was accepted") : to_string(depth.error());
  };
  EXPECT_THAT(refused(test::pgm8(1)), HasSubstr("d.pgm: format: has 1 channel(s) of 8 bit"));
  EXPECT_THAT(refused(test::pgm16(1, 2, 3), {8, 6}),
              HasSubstr("is 2 x 3, expected the camera's 8 x 6"));
  EXPECT_THAT(refused(test::pgm16(1).substr(0, 30)), HasSubstr("d.pgm"));
  EXPECT_THAT(refused(""), HasSubstr("d.pgm"));
  EXPECT_THAT(to_string(read_depth(dir / "absent.png", {}).error()), HasSubstr("absent.png"));
}

TEST(DepthFile, ColourAndSizeAreReadFromAnyImage) {
  const TempDir dir;
  write_text(dir / "c.pgm", test::pgm8(77, 3, 2));
  EXPECT_EQ(read_color(dir / "c.pgm")->at(2, 1), (Rgb8{77, 77, 77}));
  EXPECT_EQ(*read_image_size(dir / "c.pgm"), (ImageSize{3, 2}));
}

}  // namespace
}  // namespace hypermap
