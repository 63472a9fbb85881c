// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/image_file.hpp"

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

TEST(ImageFile, TheFormatIsFoundByContentAndMustBeWhatTheNamePromises) {
  const std::string png = *encode_png(ColorImage(2, 3));
  EXPECT_EQ(read_image_header(png, {.file = "map"})->height_px, 3);
  EXPECT_TRUE(decode_image(png, {.file = "a.PNG"}));
  const auto wrong = decode_image(png, {.file = "a.hmap", .entry = "a.pgm"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(to_string(wrong.error()), "a.hmap!a.pgm: format: holds a PNG, its name promises a PGM");
}

TEST(ImageFile, OtherFormatsAreRefusedByName) {
  const auto refused = [](const std::string& bytes) {
    return to_string(decode_image(bytes, {.file = "x"}).error());
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
  const std::string old_tga("\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0...", 21);  // of one pixel
  EXPECT_THAT(refused(old_tga), HasSubstr("is no image"));
  EXPECT_EQ(to_string(decode_image(old_tga, {.file = "map.TGA"}).error()),
            "map.TGA: format: is a TGA, by its name, expected PNG, PGM, JPEG or BMP");
  EXPECT_THAT(refused("hello"), HasSubstr("is no image"));
  EXPECT_THAT(refused(""), HasSubstr("is empty"));
}

TEST(ImageFile, JpegAndBmpAreRead) {
  const cv::Mat mat(12, 20, CV_8UC3, cv::Scalar(30, 60, 200));  // blue, green, red
  for (const char* extension : {".jpg", ".bmp"}) {
    const auto image = decode_image(encoded(extension, mat), {.file = "x"});
    ASSERT_TRUE(image) << to_string(image.error());
    EXPECT_EQ(image->width_px, 20);
    EXPECT_EQ(image->height_px, 12);
    EXPECT_NEAR(to_color(*image).at(3, 3).r, 200, 3);
    EXPECT_NEAR(to_color(*image).at(3, 3).b, 30, 3);
  }
}

TEST(ImageFile, ACutJpegOrBmpIsNeverHalfAnImage) {
  cv::Mat mat(40, 40, CV_8UC3);
  cv::randu(mat, 0, 256);
  for (const char* extension : {".jpg", ".bmp"}) {
    const std::string bytes = encoded(extension, mat);
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
      EXPECT_FALSE(decode_image(bytes.substr(0, size), {.file = "x"})) << extension << size;
    }
  }
}

TEST(ImageFile, AGiantJpegIsRefusedByItsHeader) {
  std::string bytes = encoded(".jpg", cv::Mat(8, 8, CV_8UC1, cv::Scalar(7)));
  const std::size_t frame = bytes.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) bytes[frame + i] = '\xFF';
  const auto image = decode_image(bytes, {.file = "x"});
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kLimit);
}

TEST(ImageFile, DepthAsksForSixteenBitsAndOneChannel) {
  const auto color = decode_image(*encode_png(ColorImage(2, 2)), {.file = "x"});
  EXPECT_THAT(to_gray16(*color).error().what, HasSubstr("3 channels of 8 bit"));
  EXPECT_FALSE(to_gray8(*color));
}

TEST(ImageFile, AFileOnDiskIsNamed) {
  const test::TempDir dir;
  std::ofstream(dir / "x.png") << "nonsense";
  const auto image = read_image_file(dir / "x.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().file, (dir / "x.png").string());
}

class HostileImage : public ::testing::TestWithParam<std::string> {};

TEST_P(HostileImage, GivesWhatTheIndexSays) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/INDEX.md");
  const auto path = test::shared_data("hostile/image") / GetParam();
  const auto image = read_image_file(path);
  if (GetParam().starts_with("ok_")) {
    EXPECT_TRUE(image) << to_string(image.error());
    return;
  }
  ASSERT_FALSE(image);
  EXPECT_THAT(to_string(image.error()), HasSubstr(GetParam()));
  EXPECT_FALSE(image.error().field.empty()) << to_string(image.error());
}

INSTANTIATE_TEST_SUITE_P(Corpus,
                         HostileImage,
                         ::testing::ValuesIn(test::hostile_names("image")),
                         [](const auto& file) { return test::test_name_of(file.param); });

TEST(ImageFile, TheCorpusImagesHoldTheRightPixels) {
  HYPERMAP_REQUIRE_SHARED_DATA("hostile/image");
  const auto read = [](const char* name) {
    return *read_image_file(test::shared_data("hostile/image") / name);
  };
  EXPECT_EQ(read("ok_p2.pgm").samples8, (std::vector<std::uint8_t>{0, 1, 2, 255}));
  EXPECT_EQ(read("ok_16bit_gray.png").bits, 16);
  EXPECT_EQ(read("ok_rgba16.png").channels, 4);
  EXPECT_EQ(read("ok_palette.png").channels, 3);
}

}  // namespace
}  // namespace hypermap
