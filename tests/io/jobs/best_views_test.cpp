// SPDX-License-Identifier: BSD-3-Clause
#include "best_views.hpp"

#include "hypermap/io/codec/image_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// Each pixel tells its column and row.
ColorImage ramp(int width_px, int height_px) {
  ColorImage image(width_px, height_px);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      image.at(u, v) = {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v), 7};
    }
  }
  return image;
}

/// A frame of one grey, `index` steps bright.
RgbdFrame grey_frame(std::uint64_t index) {
  RgbdFrame frame;
  frame.index = index;
  const auto grey = static_cast<std::uint8_t>(10 * index);
  frame.color = ColorImage(40, 30, Rgb8{grey, grey, grey});
  return frame;
}

FrameReport showing(ObjectId id, std::size_t num_pixels, double score) {
  FrameReport report;
  report.detected = {
      {.id = id, .box_px = {10, 5, 30, 25}, .num_pixels = num_pixels, .score = Probability(score)}};
  return report;
}

constexpr ObjectId kMug{3};
constexpr ObjectId kBowl{5};

std::uint64_t frame_of_view(const BestViews& views, ObjectId id) {
  return views.views().at(id).frame_index;
}

TEST(Thumbnail, IsTheBoxAndNotEnlarged) {
  const ColorImage image = ramp(40, 30);
  const ColorImage whole_pixels = thumbnail(image, {10, 5, 12, 8}, 160);
  ASSERT_EQ(whole_pixels.width_px(), 2);
  ASSERT_EQ(whole_pixels.height_px(), 3);
  EXPECT_EQ(whole_pixels.at(1, 2), (Rgb8{11, 7, 7}));
  // Pixels that the box touches belong to it; what lies outside of the image does not.
  EXPECT_EQ(thumbnail(image, {-5, -5, 0.5, 0.5}, 160).size(), 1U);
  EXPECT_EQ(thumbnail(image, {38.5, 0, 99, 1}, 160).width_px(), 2);
  EXPECT_TRUE(thumbnail(image, {40, 0, 50, 10}, 160).empty());
}

// 32 x 16 pixels to 4 on the longest side are 4 x 2: the first is the mean of columns 0 to 7, which
// is 3.5, rounded up to 4, and of rows 0 to 7, the same.
TEST(Thumbnail, PixelsAreMeansOfThoseThatTheyStandFor) {
  const ColorImage small = thumbnail(ramp(40, 30), {0, 0, 32, 16}, 4);
  ASSERT_EQ(small.width_px(), 4);
  ASSERT_EQ(small.height_px(), 2);
  EXPECT_EQ(small.at(0, 0), (Rgb8{4, 4, 7}));
  EXPECT_EQ(small.at(3, 1), (Rgb8{28, 12, 7}));
  EXPECT_EQ(thumbnail(ramp(200, 1), {0, 0, 200, 1}, 10).height_px(), 1);
}

TEST(ViewJpeg, IsSmallInBytesAndSidesWhateverTheImage) {
  std::mt19937 random(1);
  ColorImage noise(640, 480);
  for (Rgb8& pixel : noise.pixels()) {
    const auto bits = static_cast<std::uint32_t>(random());
    pixel = {static_cast<std::uint8_t>(bits & 255U),
             static_cast<std::uint8_t>((bits >> 8U) & 255U),
             static_cast<std::uint8_t>((bits >> 16U) & 255U)};
  }
  for (const PixelBox& box : {PixelBox{0, 0, 640, 480}, PixelBox{0, 0, 160, 160}}) {
    ObjectView view{.quality = 1.0, .frame_index = 0, .jpeg = view_jpeg(noise, box).value()};
    EXPECT_TRUE(validate(view));
    EXPECT_EQ(view_jpeg(noise, box).value(), view.jpeg);
  }
}

TEST(BestViews, ALargerVisiblePartTimesTheScoreIsBetterAndOfEqualsTheEarlier) {
  BestViews views;
  EXPECT_FALSE(views.saw_color());
  ASSERT_TRUE(views.add(grey_frame(1), showing(kMug, 100, 0.8)));
  ASSERT_TRUE(views.add(grey_frame(2), showing(kMug, 160, 0.5)));  // 80 as before
  EXPECT_EQ(frame_of_view(views, kMug), 1U);
  ASSERT_TRUE(views.add(grey_frame(3), showing(kMug, 90, 1.0)));
  EXPECT_EQ(frame_of_view(views, kMug), 3U);
  ASSERT_TRUE(views.add(grey_frame(4), showing(kMug, 0, 1.0)));
  ASSERT_TRUE(views.add(grey_frame(4), showing(kBowl, 9, 0.0)));
  EXPECT_EQ(frame_of_view(views, kMug), 3U);
  EXPECT_FALSE(views.views().contains(kBowl));
  EXPECT_TRUE(views.saw_color());
  const auto decoded = decode_image(views.views().at(kMug).jpeg, {});
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_EQ(decoded->width_px, 20);
  EXPECT_LE(std::abs(decoded->samples8.front() - 30), 2);
}

TEST(BestViews, OfMergedObjectsTheBetterOneStaysAndOfRemovedOnesNone) {
  BestViews views;
  ASSERT_TRUE(views.add(grey_frame(1), showing(kMug, 50, 1.0)));
  ASSERT_TRUE(views.add(grey_frame(2), showing(kBowl, 60, 1.0)));
  FrameReport merge;
  merge.merged = {{.from = kBowl, .into = kMug}};
  views.follow(merge, {});
  EXPECT_EQ(views.views().size(), 1U);
  EXPECT_EQ(frame_of_view(views, kMug), 2U);
  FrameReport removal;
  removal.num_removed = 1;
  views.follow(removal, ObjectMap{});
  EXPECT_TRUE(views.views().empty());
}

TEST(BestViews, WithoutColourThereIsNothingToSee) {
  BestViews views;
  RgbdFrame frame = grey_frame(1);
  frame.color = {};
  ASSERT_TRUE(views.add(frame, showing(kMug, 50, 1.0)));
  EXPECT_TRUE(views.views().empty());
  EXPECT_FALSE(views.saw_color());
}

}  // namespace
}  // namespace hypermap
