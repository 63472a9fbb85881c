// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/png_image.hpp"

#include "support/image_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <zlib.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::chunk;
using test::deflated;
using test::ihdr;
using test::png;
using ::testing::HasSubstr;

const SourceName kPngSource{.file = "a.png"};

DecodedImage decoded(const std::string& bytes) {
  auto image = decode_png(bytes, kPngSource);
  EXPECT_TRUE(image) << (image ? "" : to_string(image.error()));
  return image ? *image : DecodedImage{};
}

Error refused_png(const std::string& bytes) {
  const auto image = decode_png(bytes, kPngSource);
  EXPECT_FALSE(image);
  return image ? Error{} : image.error();
}

template <class Pixel>
Image<Pixel> noise(int width, int height) {
  Image<Pixel> image(width, height);
  std::mt19937 random(7);
  for (Pixel& pixel : image.pixels()) pixel = static_cast<Pixel>(random());
  return image;
}

/// Filtered rows of the seven passes, each byte another.
std::vector<std::vector<std::uint8_t>> adam7_rows(std::uint32_t width,
                                                  std::uint32_t height,
                                                  int color) {
  constexpr std::uint32_t kPasses[7][4] = {// x, y, steps
                                           {0, 0, 8, 8},
                                           {4, 0, 8, 8},
                                           {0, 4, 4, 8},
                                           {2, 0, 4, 4},
                                           {0, 2, 2, 4},
                                           {1, 0, 2, 2},
                                           {0, 1, 1, 2}};
  const std::size_t channels = color == 0 ? 1 : color == 2 ? 3 : 4;
  std::vector<std::vector<std::uint8_t>> rows;
  std::uint8_t next = 1;
  for (const auto& [x, y, step_x, step_y] : kPasses) {
    if (x >= width) continue;
    const std::size_t in_row = (width - x + step_x - 1) / step_x;
    for (std::uint32_t v = y; v < height; v += step_y) {
      std::vector<std::uint8_t>& row = rows.emplace_back(1, static_cast<std::uint8_t>(v % 5));
      for (std::size_t i = 0; i < in_row * channels; ++i) {
        row.push_back(next = static_cast<std::uint8_t>(next * 5 + 3));
      }
    }
  }
  return rows;
}

TEST(PngImage, AOneByOneGrayImageIsReadByHand) {
  // filter 0, sample 0x2A
  const DecodedImage image = decoded(png(ihdr(1, 1, 8, 0), {{0, 0x2A}}));
  EXPECT_EQ(image.width_px, 1);
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.samples8, std::vector<std::uint8_t>{0x2A});
}

TEST(PngImage, SixteenBitIsBigEndian) {
  const DecodedImage image = decoded(png(ihdr(1, 1, 16, 0), {{0, 0x12, 0x34}}));
  EXPECT_EQ(image.bits, 16);
  EXPECT_EQ(image.samples16, std::vector<std::uint16_t>{0x1234});
}

TEST(PngImage, BitsAreSpreadOverTheFullRange) {
  // 1 bit, width 3: 101..... -> 255 0 255;  2 bit, width 3: 00 01 11 -> 0 85 255
  EXPECT_EQ(decoded(png(ihdr(3, 1, 1, 0), {{0, 0xA0}})).samples8,
            (std::vector<std::uint8_t>{255, 0, 255}));
  EXPECT_EQ(decoded(png(ihdr(3, 1, 2, 0), {{0, 0x1C}})).samples8,
            (std::vector<std::uint8_t>{0, 85, 255}));
}

TEST(PngImage, APaletteBecomesColoursAndItsTransparencyAlpha) {
  const std::string bytes =
      png(ihdr(2, 1, 8, 3), {{0, 1, 0}}, chunk("PLTE", {1, 2, 3, 4, 5, 6}) + chunk("tRNS", {9}));
  const DecodedImage image = decoded(bytes);
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.samples8, (std::vector<std::uint8_t>{4, 5, 6, 255, 1, 2, 3, 9}));
}

TEST(PngImage, AKeyColourBecomesAlpha) {
  const DecodedImage image = decoded(png(ihdr(2, 1, 8, 0), {{0, 7, 8}}, chunk("tRNS", {0, 8})));
  EXPECT_EQ(image.channels, 2);
  EXPECT_EQ(image.samples8, (std::vector<std::uint8_t>{7, 255, 8, 0}));
}

TEST(PngImage, EachFilterIsUndone) {
  // 3 x 1 rows, grey. Row 0: sub 10, +1, +1 -> 10 11 12. Row 1: up +1 -> 11 12 13.
  // Row 2: average 5 + 11/2 = 10, 0 + (10 + 12) / 2 = 11, 0 + (11 + 13) / 2 = 12.
  // Row 3: Paeth 1 + above 10 = 11; left 11, above 11, above-left 10 -> p = 12, ties go to left:
  // 11;
  //        left 11, above 12, above-left 11 -> p = 12 -> above: 12.
  const DecodedImage image =
      decoded(png(ihdr(3, 4, 8, 0), {{1, 10, 1, 1}, {2, 1, 1, 1}, {3, 5, 0, 0}, {4, 1, 0, 0}}));
  EXPECT_EQ(image.samples8,
            (std::vector<std::uint8_t>{10, 11, 12, 11, 12, 13, 10, 11, 12, 11, 11, 12}));
}

TEST(PngImage, AnInterlacedImageIsPutTogether) {
  // 2 x 2, Adam7: pass 1 has (0,0), pass 6 (1,0), pass 7 row 1.
  EXPECT_EQ(decoded(png(ihdr(2, 2, 8, 0, 1), {{0, 1}, {0, 2}, {0, 3, 4}})).samples8,
            (std::vector<std::uint8_t>{1, 2, 3, 4}));
}

TEST(PngImage, InterlacedImagesOfEverySizeAreThoseOfOpenCv) {
  for (const int color : {0, 2, 6}) {
    for (std::uint32_t width = 1; width <= 9; ++width) {
      for (std::uint32_t height = 1; height <= 9; ++height) {
        const std::string bytes =
            png(ihdr(width, height, 8, color, 1), adam7_rows(width, height, color));
        const DecodedImage image = decoded(bytes);
        const cv::Mat mat = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()),
                                         color == 0 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
        const ColorImage color_image = to_color(image);
        for (int v = 0; v < mat.rows; ++v) {
          for (int u = 0; u < mat.cols; ++u) {
            const auto bgr =
                color == 0 ? cv::Vec3b::all(mat.at<std::uint8_t>(v, u)) : mat.at<cv::Vec3b>(v, u);
            ASSERT_EQ(color_image.at(u, v), (Rgb8{.r = bgr[2], .g = bgr[1], .b = bgr[0]}));
          }
        }
        auto rows = adam7_rows(width, height, color);
        rows.pop_back();
        EXPECT_EQ(refused_png(png(ihdr(width, height, 8, color, 1), rows)).field, "IDAT");
      }
    }
  }
}

TEST(PngImage, TheStreamMustEndWithItsChecksumAndNothingMore) {
  const std::string data = deflated(std::string("\0\x05\x06", 3));
  const auto split = [&](const std::vector<std::string>& parts) {
    std::string bytes = std::string(test::kSignature) + ihdr(2, 1, 8, 0);
    for (const std::string& part : parts) bytes += chunk("IDAT", {part.begin(), part.end()});
    return bytes + chunk("IEND", {});
  };
  const std::size_t end = data.size() - 4;
  EXPECT_TRUE(decode_png(split({data.substr(0, end), data.substr(end)}), kPngSource));
  EXPECT_EQ(refused_png(split({data.substr(0, end)})).field, "IDAT");
  EXPECT_EQ(refused_png(split({data.substr(0, end), "abcd"})).field, "IDAT");
  EXPECT_EQ(refused_png(split({data.substr(0, end + 2)})).field, "IDAT");
  EXPECT_EQ(refused_png(split({data + "x"})).field, "IDAT");
  EXPECT_EQ(refused_png(split({data, "x"})).field, "IDAT");
  EXPECT_TRUE(decode_png(split({data, ""}), kPngSource));
}

TEST(PngImage, WhatIsWrittenReadsTheSameHereAndInOpenCv) {
  const auto gray = noise<std::uint8_t>(37, 23);
  const auto depth = noise<std::uint16_t>(37, 23);
  EXPECT_EQ(*to_gray8(decoded(*encode_png(gray))), gray);
  EXPECT_EQ(*to_gray16(decoded(*encode_png(depth))), depth);
  const std::string bytes = *encode_png(depth);
  const cv::Mat mat =
      cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mat.type(), CV_16UC1);
  for (int v = 0; v < depth.height_px(); ++v) {
    for (int u = 0; u < depth.width_px(); ++u) {
      ASSERT_EQ(mat.at<std::uint16_t>(v, u), depth.at(u, v));
    }
  }
}

TEST(PngImage, WhatOpenCvWritesReadsTheSame) {
  cv::Mat mat(19, 45, CV_16UC3);
  cv::randu(mat, 0, 65536);
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(".png", mat, bytes));
  const DecodedImage image = decoded(std::string(bytes.begin(), bytes.end()));
  ASSERT_EQ(image.channels, 3);
  for (int v = 0; v < mat.rows; ++v) {
    for (int u = 0; u < mat.cols; ++u) {
      const std::size_t at = (static_cast<std::size_t>(v) * 45 + static_cast<std::size_t>(u)) * 3;
      ASSERT_EQ(mat.at<cv::Vec3w>(v, u)[2], image.samples16[at]);
      ASSERT_EQ(mat.at<cv::Vec3w>(v, u)[0], image.samples16[at + 2]);
    }
  }
}

TEST(PngImage, GrayAlphaAndColourAreWritten) {
  Image<GrayAlpha8> gray(2, 1);
  gray.at(0, 0) = {.gray = 127, .alpha = 0};
  EXPECT_EQ(decoded(*encode_png(gray)).samples8, (std::vector<std::uint8_t>{127, 0, 0, 255}));
  ColorImage color(1, 1, {.r = 1, .g = 2, .b = 3});
  EXPECT_EQ(to_color(decoded(*encode_png(color))), color);
  EXPECT_EQ(*encode_png(color), *encode_png(color));
  EXPECT_FALSE(encode_png(ColorImage()));
}

TEST(PngImage, NoCutAndNoFlippedBitIsReadAsAnotherImage) {
  const auto image = noise<std::uint8_t>(9, 7);
  const std::string bytes = *encode_png(image);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_png(bytes.substr(0, size), kPngSource)) << "cut at " << size;
  }
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    std::string flipped = bytes;
    flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << (i % 8)));
    EXPECT_FALSE(decode_png(flipped, kPngSource)) << "bit " << i;
  }
}

TEST(PngImage, FaultsAreNamed) {
  const std::vector<std::vector<std::uint8_t>> rows = {{0, 1}};
  EXPECT_THAT(to_string(refused_png(png(ihdr(0, 1, 8, 0), rows))), HasSubstr("a.png: size"));
  EXPECT_THAT(to_string(refused_png(png(ihdr(1, 1, 3, 0), rows))), HasSubstr("bit depth 3"));
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 3), rows)).field, "PLTE");
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 0), {{9, 1}})).what,
              HasSubstr("bad adaptive filter value"));
  EXPECT_THAT(refused_png(png(ihdr(1, 2, 8, 0), rows)).what, HasSubstr("too few"));
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 0), {{0, 1}, {0, 1}})).what,
              HasSubstr("Extra compressed data"));
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 3), {{0, 2}}, chunk("PLTE", {1, 2, 3}))).what,
              HasSubstr("palette index 2"));
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 0), rows) + "x").field, "IEND");
  EXPECT_THAT(refused_png(png(ihdr(1, 1, 8, 0), rows, chunk("ABCD", {}))).code,
              ErrorCode::kUnsupported);
  EXPECT_THAT(refused_png(png(ihdr(100'000, 100'000, 8, 0), rows)).code, ErrorCode::kLimit);
  EXPECT_THAT(refused_png(png(ihdr(10'000, 10'000, 8, 0), rows)).what, HasSubstr("cannot hold"));
}

TEST(PngImage, AncillaryTextIsNeverInflated) {
  // A compressed text bomb: its CRC is right, its content stays closed.
  const std::string bomb = deflated(std::string(std::size_t{1} << 24U, 'x'));
  const std::vector<std::uint8_t> text(bomb.begin(), bomb.end());
  EXPECT_TRUE(decode_png(png(ihdr(1, 1, 8, 0), {{0, 1}}, chunk("zTXt", text)), kPngSource));
}

TEST(PngImage, PixelsMayBeSplitOverManyChunks) {
  const std::string data = deflated(std::string("\0\x05\x06", 3));
  std::string bytes(test::kSignature);
  bytes += ihdr(2, 1, 8, 0);
  for (const char c : data) bytes += chunk("IDAT", {static_cast<std::uint8_t>(c)});
  bytes += chunk("IDAT", {}) + chunk("IEND", {});
  EXPECT_EQ(decoded(bytes).samples8, (std::vector<std::uint8_t>{5, 6}));
}

}  // namespace
}  // namespace hypermap
