// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/picture_file.hpp"

#include "hypermap/io/codec/png_image.hpp"
#include "support/hostile_index.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

std::string encoded(const std::string& extension, const cv::Mat& mat) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, mat, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(PictureFile, TheFormatIsFoundByContentAndMustBeWhatTheNamePromises) {
  const std::string png = *encode_png(ColorImage(2, 3));
  EXPECT_EQ(read_picture_header(png, {.file = "map"})->height_px, 3);
  EXPECT_TRUE(decode_picture(png, {.file = "a.PNG"}));
  const auto wrong = decode_picture(png, {.file = "a.hmap", .entry = "a.pgm"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(to_string(wrong.error()), "a.hmap!a.pgm: format: holds a PNG, its name promises a PGM");
}

TEST(PictureFile, OtherFormatsAreRefusedByName) {
  const auto refused = [](const std::string& bytes) {
    return to_string(decode_picture(bytes, {.file = "x"}).error());
  };
  EXPECT_THAT(refused("P4 3 3\n"), HasSubstr("bitmap (P4)"));
  EXPECT_THAT(refused("GIF89a"), HasSubstr("GIF"));
  EXPECT_THAT(refused("II*"), HasSubstr("is a TIFF, expected PNG, PGM, JPEG or BMP"));
  EXPECT_THAT(refused("RIFF....WEBP"), HasSubstr("WebP"));
  EXPECT_THAT(refused("8BPS"), HasSubstr("PSD"));
  EXPECT_THAT(refused("#?RADIANCE"), HasSubstr("Radiance HDR"));
  EXPECT_THAT(refused("\x53\x80\xF6\x34"), HasSubstr("PIC"));
  EXPECT_THAT(refused(std::string("\0\0\0\x0CjP  ", 8)), HasSubstr("JPEG 2000"));
  EXPECT_THAT(refused(std::string("\0\0\0\x18"
                                  "ftypavif",
                                  12)),
              HasSubstr("AVIF"));
  EXPECT_THAT(refused(std::string("..TRUEVISION-XFILE.\0", 20)), HasSubstr("TGA"));
  EXPECT_THAT(refused("hello"), HasSubstr("is no picture"));
  EXPECT_THAT(refused(""), HasSubstr("is empty"));
}

TEST(PictureFile, JpegAndBmpAreRead) {
  const cv::Mat mat(12, 20, CV_8UC3, cv::Scalar(30, 60, 200));  // blue, green, red
  for (const char* extension : {".jpg", ".bmp"}) {
    const auto picture = decode_picture(encoded(extension, mat), {.file = "x"});
    ASSERT_TRUE(picture) << to_string(picture.error());
    EXPECT_EQ(picture->width_px, 20);
    EXPECT_EQ(picture->height_px, 12);
    EXPECT_NEAR(to_color(*picture).at(3, 3).r, 200, 3);
    EXPECT_NEAR(to_color(*picture).at(3, 3).b, 30, 3);
  }
}

TEST(PictureFile, ACutJpegOrBmpIsNeverHalfAPicture) {
  cv::Mat mat(40, 40, CV_8UC3);
  cv::randu(mat, 0, 256);
  for (const char* extension : {".jpg", ".bmp"}) {
    const std::string bytes = encoded(extension, mat);
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
      EXPECT_FALSE(decode_picture(bytes.substr(0, size), {.file = "x"})) << extension << size;
    }
  }
}

TEST(PictureFile, AGiantJpegIsRefusedByItsHeader) {
  std::string bytes = encoded(".jpg", cv::Mat(8, 8, CV_8UC1, cv::Scalar(7)));
  const std::size_t frame = bytes.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) bytes[frame + i] = '\xFF';
  const auto picture = decode_picture(bytes, {.file = "x"});
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().code, ErrorCode::kLimit);
}

TEST(PictureFile, DepthAsksForSixteenBitsAndOneChannel) {
  const auto color = decode_picture(*encode_png(ColorImage(2, 2)), {.file = "x"});
  EXPECT_THAT(to_gray16(*color).error().what, HasSubstr("3 channels of 8 bit"));
  EXPECT_FALSE(to_gray8(*color));
}

TEST(PictureFile, AFileOnDiskIsNamed) {
  const test::TempDir dir;
  std::ofstream(dir / "x.png") << "nonsense";
  const auto picture = read_picture(dir / "x.png");
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().file, (dir / "x.png").string());
}

class HostilePicture : public ::testing::TestWithParam<std::string> {};

TEST_P(HostilePicture, GivesWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto path = test::shared_data("hostile/image") / GetParam();
  const auto picture = read_picture(path);
  if (GetParam().starts_with("ok_")) {
    EXPECT_TRUE(picture) << to_string(picture.error());
    return;
  }
  ASSERT_FALSE(picture);
  EXPECT_THAT(to_string(picture.error()), HasSubstr(GetParam()));
  EXPECT_FALSE(picture.error().field.empty()) << to_string(picture.error());
}

INSTANTIATE_TEST_SUITE_P(Corpus,
                         HostilePicture,
                         ::testing::ValuesIn(test::hostile_names("image")),
                         [](const auto& file) { return test::test_name_of(file.param); });

TEST(PictureFile, TheCorpusPicturesHoldTheRightPixels) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/image");
  const auto read = [](const char* name) {
    return *read_picture(test::shared_data("hostile/image") / name);
  };
  EXPECT_EQ(read("ok_p2.pgm").samples8, (std::vector<std::uint8_t>{0, 1, 2, 255}));
  EXPECT_EQ(read("ok_16bit_gray.png").bits, 16);
  EXPECT_EQ(read("ok_rgba16.png").channels, 4);
  EXPECT_EQ(read("ok_palette.png").channels, 3);
}

}  // namespace
}  // namespace hypermap
