// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/jpeg_writer.hpp"

#include "hypermap/io/codec/image_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace hypermap {
namespace {

TEST(JpegWriter, WhatIsReadBackLooksTheSame) {
  ColorImage image(33, 17);
  for (int v = 0; v < image.height_px(); ++v) {
    for (int u = 0; u < image.width_px(); ++u) {
      image.at(u, v) = {
          static_cast<std::uint8_t>(100 + 3 * u), static_cast<std::uint8_t>(5 * v), 60};
    }
  }
  const std::string jpeg = encode_jpeg(image, 95).value();
  EXPECT_EQ(encode_jpeg(image, 95).value(), jpeg);
  const auto decoded = decode_image(jpeg, {});
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  const ColorImage again = to_color(*decoded);
  ASSERT_EQ(again.width_px(), 33);
  ASSERT_EQ(again.height_px(), 17);
  for (std::size_t i = 0; i < image.size(); ++i) {
    EXPECT_LE(std::abs(again.pixels()[i].r - image.pixels()[i].r), 12);
    EXPECT_LE(std::abs(again.pixels()[i].g - image.pixels()[i].g), 12);
    EXPECT_LE(std::abs(again.pixels()[i].b - image.pixels()[i].b), 12);
  }
  EXPECT_LT(encode_jpeg(image, 20)->size(), jpeg.size());
}

}  // namespace
}  // namespace hypermap
