// SPDX-License-Identifier: BSD-3-Clause
// JPEG by libjpeg-turbo; OpenCV, which decodes with the same library, is the judge of the pixels.
#include "hypermap/io/codec/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

const SourceName kJpegSource{.file = "a.jpg"};

/// Smooth colours with some noise: what a camera sees compresses, and every coefficient is used.
cv::Mat scene_mat(int width, int height, int type) {
  cv::Mat noise(height, width, type);
  cv::randu(noise, 0, 256);
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, {9, 9}, 3.0);
  return smooth + 0.1 * noise;
}

std::string encoded_jpeg(const cv::Mat& mat, const std::vector<int>& parameters = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", mat, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

cv::Mat decoded_by_opencv(const std::string& bytes, bool is_gray) {
  const std::vector<char> input(bytes.begin(), bytes.end());
  cv::Mat mat = cv::imdecode(
      input, (is_gray ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR) | cv::IMREAD_IGNORE_ORIENTATION);
  if (!is_gray) cv::cvtColor(mat, mat, cv::COLOR_BGR2RGB);
  return mat;
}

void expect_as_opencv(const std::string& bytes) {
  const auto image = decode_image(bytes, kJpegSource);
  ASSERT_TRUE(image) << to_string(image.error());
  const cv::Mat mat = decoded_by_opencv(bytes, image->channels == 1);
  ASSERT_EQ(image->width_px, mat.cols);
  ASSERT_EQ(image->height_px, mat.rows);
  ASSERT_EQ(image->samples8,
            std::vector<std::uint8_t>(mat.datastart, mat.datastart + mat.total() * mat.elemSize()));
}

/// A JPEG with an APP1 segment behind its start mark: EXIF, orientation 6 (turn by 90 degrees).
std::string with_orientation(const std::string& jpeg) {
  const std::string tiff("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0", 26);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const std::string length{'\0', static_cast<char>(exif.size() + 2)};
  return jpeg.substr(0, 2) + "\xFF\xE1" + length + exif + jpeg.substr(2);
}

TEST(JpegImage, PixelsAreThoseOfOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(16, 16), cv::Size(37, 53)}) {
      for (const int progressive : {0, 1}) {
        for (const int quality : {20, 95}) {
          SCOPED_TRACE(cv::format("%d x %d, type %d", size.width, size.height, type));
          expect_as_opencv(encoded_jpeg(scene_mat(size.width, size.height, type),
                                        {cv::IMWRITE_JPEG_PROGRESSIVE,
                                         progressive,
                                         cv::IMWRITE_JPEG_QUALITY,
                                         quality,
                                         cv::IMWRITE_JPEG_RST_INTERVAL,
                                         progressive * 2}));
        }
      }
    }
  }
}

TEST(JpegImage, AnOrientationIsNotApplied) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const std::string plain = encoded_jpeg(scene_mat(24, 10, type));
    const std::string turned = with_orientation(plain);
    EXPECT_EQ(cv::imdecode(std::vector<char>(turned.begin(), turned.end()), cv::IMREAD_COLOR).cols,
              10);
    EXPECT_EQ(*decode_image(turned, kJpegSource), *decode_image(plain, kJpegSource));
  }
}

TEST(JpegImage, AFileCutInItsPixelsAndEndedByHandIsRefused) {
  const std::string whole = encoded_jpeg(scene_mat(64, 64, CV_8UC3));
  const std::size_t scan = whole.find("\xFF\xDA") + 14;
  for (std::size_t size = scan; size < whole.size() - 20; size += 97) {
    const auto image = decode_image(whole.substr(0, size) + "\xFF\xD9", kJpegSource);
    ASSERT_FALSE(image) << size;
    EXPECT_THAT(to_string(image.error()), HasSubstr("a.jpg: raster: cannot be decoded"));
  }
}

TEST(JpegImage, NoDamageIsMoreThanAnError) {
  const std::string whole = encoded_jpeg(scene_mat(40, 40, CV_8UC3));
  unsigned state = 1;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = whole;
    for (int j = 0; j < 3; ++j) {
      state = state * 1103515245U + 12345U;
      damaged[(state >> 8U) % damaged.size()] = static_cast<char>(state >> 24U);
    }
    const auto image = decode_image(damaged, kJpegSource);
    if (image) {
      EXPECT_EQ(image->samples8.size(),
                image->num_pixels() * static_cast<std::size_t>(image->channels));
    }
  }
}

TEST(JpegImage, CountlessScansAreRefused) {
  const std::string whole =
      encoded_jpeg(scene_mat(16, 16, CV_8UC1), {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const std::size_t scan = whole.find("\xFF\xDA");
  const std::size_t next = whole.find("\xFF\xC4", scan);  // the second scan's tables
  std::string bytes = whole.substr(0, next);
  for (int i = 0; i < 600; ++i) bytes += whole.substr(scan, next - scan);
  const auto image = decode_image(bytes + whole.substr(next), kJpegSource);
  ASSERT_FALSE(image);
  EXPECT_THAT(to_string(image.error()), HasSubstr("over 500 scans"));
}

}  // namespace
}  // namespace hypermap
