// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

const SourceName kBmpSource{.file = "a.bmp"};

std::string bytes_of(std::uint32_t value, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(static_cast<char>(value >> (8 * i)));
  return out;
}

struct BmpParts {
  std::int32_t width = 2;
  std::int32_t height = 2;
  std::uint32_t bits = 24;
  std::uint32_t compression = 0;
  std::uint32_t num_colors = 0;
  std::string between = "";  ///< Masks or palette.
  std::string raster = "";
  std::uint32_t header_bytes = 40;
};

/// BITMAPFILEHEADER, BITMAPINFOHEADER, what stands between, the raster.
std::string bmp(const BmpParts& parts) {
  const auto offset = static_cast<std::uint32_t>(54 + parts.between.size());
  const auto size = static_cast<std::uint32_t>(offset + parts.raster.size());
  return "BM" + bytes_of(size, 4) + bytes_of(0, 4) + bytes_of(offset, 4) +
         bytes_of(parts.header_bytes, 4) + bytes_of(static_cast<std::uint32_t>(parts.width), 4) +
         bytes_of(static_cast<std::uint32_t>(parts.height), 4) + bytes_of(1, 2) +
         bytes_of(parts.bits, 2) + bytes_of(parts.compression, 4) + std::string(12, '\0') +
         bytes_of(parts.num_colors, 4) + bytes_of(0, 4) + parts.between + parts.raster;
}

std::vector<std::uint8_t> pixels(const std::string& bytes) {
  const auto image = decode_image(bytes, kBmpSource);
  EXPECT_TRUE(image) << (image ? "" : to_string(image.error()));
  if (!image) return {};
  EXPECT_EQ(image->channels, 3);
  return image->samples8;
}

std::string refused_bmp(const BmpParts& parts) {
  const auto image = decode_image(bmp(parts), kBmpSource);
  EXPECT_FALSE(image);
  return image ? "" : to_string(image.error());
}

// Blue, green, red; two bytes of padding. The lower row comes first.
const std::string kRows24("\1\2\3\4\5\6\0\0\7\10\11\12\13\14\0\0", 16);

TEST(BmpImage, RowsOf24BitStandUpsideDownAndPadded) {
  EXPECT_EQ(pixels(bmp({.raster = kRows24})),
            (std::vector<std::uint8_t>{9, 8, 7, 12, 11, 10, 3, 2, 1, 6, 5, 4}));
}

TEST(BmpImage, ANegativeHeightIsTopDown) {
  EXPECT_EQ(pixels(bmp({.height = -2, .raster = kRows24})),
            (std::vector<std::uint8_t>{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
}

TEST(BmpImage, APaletteIsResolvedAndNotExceeded) {
  BmpParts parts{.height = 1, .bits = 8, .num_colors = 2};
  parts.between = std::string("\1\2\3\0\4\5\6\0", 8);
  parts.raster = std::string("\1\0\0\0", 4);
  EXPECT_EQ(pixels(bmp(parts)), (std::vector<std::uint8_t>{6, 5, 4, 3, 2, 1}));
  parts.raster = std::string("\1\2\0\0", 4);
  EXPECT_THAT(refused_bmp(parts), HasSubstr("a.bmp: raster: palette index 2 of 2 colours"));
}

TEST(BmpImage, TheFourthByteOf32BitIsDropped) {
  EXPECT_EQ(pixels(bmp({.width = 1, .height = 1, .bits = 32, .raster = "\1\2\3\4"})),
            (std::vector<std::uint8_t>{3, 2, 1}));
}

TEST(BmpImage, BitFieldsOfWholeBytesAreRead) {
  BmpParts parts{.width = 1, .height = 1, .bits = 32, .compression = 3, .raster = "\1\2\3\4"};
  const auto masks = [](std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    return bytes_of(r, 4) + bytes_of(g, 4) + bytes_of(b, 4);
  };
  parts.between = masks(0xFF, 0xFF00, 0xFF0000);
  EXPECT_EQ(pixels(bmp(parts)), (std::vector<std::uint8_t>{1, 2, 3}));
  parts.between = masks(0xFF000000, 0xFF0000, 0xFF00);
  EXPECT_EQ(pixels(bmp(parts)), (std::vector<std::uint8_t>{4, 3, 2}));
  parts.between = masks(0x3FF00000, 0xFFC00, 0x3FF);
  EXPECT_THAT(refused_bmp(parts), HasSubstr("bit fields that are no whole bytes"));
}

TEST(BmpImage, PixelsAreThoseOfOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    for (int width = 1; width < 9; ++width) {
      cv::Mat mat(5, width, type);
      cv::randu(mat, 0, 256);
      std::vector<std::uint8_t> bytes;
      cv::imencode(".bmp", mat, bytes);
      const cv::Mat read = cv::imdecode(bytes, cv::IMREAD_COLOR);
      const ColorImage image =
          to_color(*decode_image(std::string(bytes.begin(), bytes.end()), kBmpSource));
      for (int v = 0; v < 5; ++v) {
        for (int u = 0; u < width; ++u) {
          const auto& bgr = read.at<cv::Vec3b>(v, u);
          ASSERT_EQ(image.at(u, v), (Rgb8{.r = bgr[2], .g = bgr[1], .b = bgr[0]}));
        }
      }
    }
  }
}

TEST(BmpImage, FaultsAreNamed) {
  EXPECT_THAT(refused_bmp({.raster = kRows24.substr(1)}), HasSubstr("a.bmp: raster: ends early"));
  EXPECT_THAT(refused_bmp({.width = 0}), HasSubstr("size: a side is absurd"));
  EXPECT_THAT(refused_bmp({.width = -2, .raster = kRows24}), HasSubstr("absurd"));
  EXPECT_THAT(refused_bmp({.height = INT32_MIN, .raster = kRows24}), HasSubstr("absurd"));
  EXPECT_THAT(refused_bmp({.width = 70'000, .raster = kRows24}), HasSubstr("ends early"));
  EXPECT_THAT(refused_bmp({.bits = 8, .compression = 1, .raster = kRows24}),
              HasSubstr("compression or depth"));
  EXPECT_THAT(refused_bmp({.bits = 16, .raster = kRows24}), HasSubstr("compression or depth"));
  EXPECT_THAT(refused_bmp({.raster = kRows24, .header_bytes = 12}), HasSubstr("OS/2"));
  EXPECT_THAT(refused_bmp({.raster = kRows24, .header_bytes = 0xFFFFFFF0}), HasSubstr("early"));
  EXPECT_FALSE(decode_image("BM", kBmpSource));
}

}  // namespace
}  // namespace hypermap
