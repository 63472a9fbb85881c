// SPDX-License-Identifier: BSD-3-Clause
// Masks of detections files, as runs.
#include "hypermap/core/segmentation/masks.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A frame of 2 x 3 pixels with one detection, its box over the left column.
std::string frame_with(const std::string& mask) {
  return R"({"image": "a", "width": 2, "height": 3, "detections": [{"label": "a", "score": 1,)"
         R"( "bbox": [0, 0, 1, 3], "mask": )" +
         mask + "}]}";
}

std::string why_refused(const std::string& mask) {
  const auto loaded = parse_detections(frame_with(mask), "d.json", {});
  return loaded ? "was accepted" : to_string(loaded.error());
}

std::string findings(const std::string& mask) {
  const auto loaded = parse_detections(frame_with(mask), "d.json", {});
  if (!loaded) return to_string(loaded.error());
  std::string all;
  for (const Finding& finding : loaded->findings) all += to_string(finding.error) + "\n";
  return all;
}

TEST(DetectionMasks, AreColumnMajorRuns) {
  // 2 columns of 3 pixels, one of 0, then 1 1 | 1 0 0: pixels (0,1) (0,2) (1,0).
  const RleMask runs{.width_px = 2, .height_px = 3, .runs = {1, 3, 2}};
  const MaskImage mask = decode(runs);
  EXPECT_EQ(mask.at(0, 0), 0);
  EXPECT_EQ(mask.at(0, 1), 1);
  EXPECT_EQ(mask.at(0, 2), 1);
  EXPECT_EQ(mask.at(1, 0), 1);
  EXPECT_EQ(mask.at(1, 1), 0);
  EXPECT_EQ(encode(mask), runs);
}

TEST(DetectionMasks, AreDecodedAsPixelByPixel) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    RleMask mask{.width_px = 1 + static_cast<int>(random() % 9),
                 .height_px = 1 + static_cast<int>(random() % 7),
                 .runs = {}};
    std::vector<std::uint8_t> by_column;
    const auto num_pixels =
        static_cast<std::size_t>(mask.width_px) * static_cast<std::size_t>(mask.height_px);
    while (by_column.size() < num_pixels) {
      // None, to a column's end, or over several columns.
      const std::size_t run = std::min<std::size_t>(random() % 20, num_pixels - by_column.size());
      by_column.insert(by_column.end(), run, mask.runs.size() % 2 == 0 ? 0 : 1);
      mask.runs.push_back(static_cast<std::uint32_t>(run));
    }
    const MaskImage image = decode(mask);
    std::size_t next = 0;
    for (int u = 0; u < mask.width_px; ++u) {
      for (int v = 0; v < mask.height_px; ++v) EXPECT_EQ(image.at(u, v), by_column.at(next++));
    }
    EXPECT_EQ(bounds_of(mask), bounds_of(image));
  }
}

TEST(DetectionMasks, MustFillTheImage) {
  EXPECT_EQ(why_refused(R"({"size": [3, 2], "counts": [1, 3, 2]})"), "was accepted");
  EXPECT_THAT(why_refused(R"({"size": [3, 2], "counts": [1, 3]})"), HasSubstr("sum to 6"));
  EXPECT_THAT(why_refused(R"({"size": [2, 3], "counts": [6]})"),
              HasSubstr("must be the image's 3 x 2"));
  EXPECT_THAT(why_refused(R"({"size": [3, 2], "counts": [-1, 7]})"), HasSubstr("counts[0]"));
  EXPECT_THAT(why_refused(R"({"size": [65535, 65535], "counts": [1]})"),
              HasSubstr("pixels are read"));
}

TEST(DetectionMasks, WithoutAPixelOrOutsideTheirBoxAreTold) {
  EXPECT_THAT(findings(R"({"size": [3, 2], "counts": [1, 3, 2]})"), IsEmpty());
  EXPECT_THAT(findings(R"({"size": [3, 2], "counts": [6]})"),
              HasSubstr("mask: 1 mask(s) have no pixel; the box alone counts"));
  const auto without =
      parse_detections(frame_with(R"({"size": [3, 2], "counts": [6]})"), "d.json", {});
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->value.frames.at(0).detections.at(0).mask);
  EXPECT_THAT(findings(R"({"size": [3, 2], "counts": [3, 3]})"),
              HasSubstr("mask: 1 mask(s) lie outside their box; the mask is believed"));
  EXPECT_THAT(findings(R"({"size": [3, 2], "counts": [1, 3, 2], "area": 3})"),
              HasSubstr("unknown key, ignored"));
}

}  // namespace
}  // namespace hypermap
