// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/pgm_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

const SourceName kSource{.file = "a.pgm"};

std::vector<std::uint8_t> samples(const std::string& bytes) {
  const auto image = decode_pgm(bytes, kSource);
  EXPECT_TRUE(image) << (image ? "" : to_string(image.error()));
  return image ? image->samples8 : std::vector<std::uint8_t>{};
}

std::string refused(const std::string& bytes) {
  const auto image = decode_pgm(bytes, kSource);
  EXPECT_FALSE(image) << printable(bytes);
  return image ? "" : to_string(image.error());
}

TEST(PgmImage, BinaryAndTextAreReadWithComments) {
  const std::vector<std::uint8_t> expected = {1, 2, 3, 4};
  EXPECT_EQ(samples("P5 2 2 255\n\1\2\3\4"), expected);
  EXPECT_EQ(samples("P5\n# by hand\n2 # wide\n2\n255\n\1\2\3\4"), expected);
  EXPECT_EQ(samples("P5 2 2 255\n\1\2\3\4\n"), expected);
  EXPECT_EQ(samples("P2\n2 2\n#c\n255\n1 2\n# between\n3 4\n"), expected);
  EXPECT_EQ(samples("P2#c\n2 2 255 1 2 3 4#end\n"), expected);
}

TEST(PgmImage, AboveMaxval255TwoBytesTheHighOneFirst) {
  const auto image = decode_pgm(std::string("P5 1 2 1000\n\3\xE8\0\1", 16), kSource);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->bits, 16);
  EXPECT_EQ(image->max_value, 1000);
  EXPECT_EQ(image->samples16, (std::vector<std::uint16_t>{1000, 1}));  // 0x03E8 = 1000
}

TEST(PgmImage, FaultsAreNamed) {
  EXPECT_THAT(refused("P5"), HasSubstr("header"));
  EXPECT_THAT(refused("P5 -4 3 255\n"), HasSubstr("width: is '-4 3 255\\x0a'"));
  EXPECT_THAT(refused("P5 4294967297 1 255\n\1"), HasSubstr("width"));
  EXPECT_THAT(refused("P5 0 1 255\n\1"), HasSubstr("width"));
  EXPECT_THAT(refused("P5 2 2 0\n\1\1\1\1"), HasSubstr("maxval"));
  EXPECT_THAT(refused("P5 2 2 70000\n\1\1\1\1"), HasSubstr("expected a number from 1 to 65535"));
  EXPECT_THAT(refused("P5 2 2 255\n\1\1\1"), HasSubstr("ends early"));
  EXPECT_THAT(refused("P5 2 2 255\n\1\1\1\1\1"), HasSubstr("bytes follow"));
  EXPECT_THAT(refused("P5 1 1 7\n\x08"), HasSubstr("above maxval 7"));
  EXPECT_THAT(refused("P2 2 2 255\n0 1 2 999\n"), HasSubstr("expected a number from 0 to maxval"));
  EXPECT_THAT(refused("P2 2 2 255\n0 1 2\n"), HasSubstr("raster"));
  EXPECT_THAT(refused("P2 2 2 255\n0 1 2 3 4\n"), HasSubstr("more follows"));
  EXPECT_THAT(refused("P2 1 1 255\na\n"), HasSubstr("raster"));
  EXPECT_THAT(refused("P5 65536 65536 255\n\1"), HasSubstr("limit for a side"));
  EXPECT_THAT(refused("P5 40000 40000 255\n\1"), HasSubstr("pixels"));
  EXPECT_THAT(refused("P5\n#" + std::string(100'000, 'x')), HasSubstr("never ends"));
  EXPECT_THAT(refused("P5\n#" + std::string(100'000, 'x') + "\n1 1 255\n\1"),
              HasSubstr("never ends"));
}

TEST(PgmImage, WhatIsWrittenReadsTheSame) {
  Image<std::uint8_t> image(3, 2);
  for (int i = 0; i < 6; ++i)
    image.pixels()[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i * 50);
  const std::string bytes = *encode_pgm(image);
  EXPECT_EQ(*to_gray8(*decode_pgm(bytes, kSource)), image);
  EXPECT_EQ(bytes.substr(0, 11), "P5\n3 2\n255\n");
  EXPECT_FALSE(encode_pgm(Image<std::uint8_t>()));
}

TEST(PgmImage, NoCutIsReadAsAnImage) {
  const std::string bytes = "P5\n# comment\n3 2\n255\nabcdef";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_pgm(bytes.substr(0, size), kSource)) << size;
  }
}

}  // namespace
}  // namespace hypermap
