// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_mask.hpp"

#include "hypermap/io/simulator/simulated_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string_view>

namespace hypermap {
namespace {

constexpr ObjectId kObject{1};

/// 24 x 16 pixels, the object in columns [5, 13) and rows [4, 10).
Image<ObjectId> instances_of_one() {
  Image<ObjectId> instances(24, 16);
  for (int v = 4; v < 10; ++v) {
    for (int u = 5; u < 13; ++u) instances.at(u, v) = kObject;
  }
  return instances;
}

/// Whether the mask is 1 exactly in these columns and rows.
testing::AssertionResult is_block(const MaskImage& mask, int left, int top, int right, int bottom) {
  for (int v = 0; v < mask.height_px(); ++v) {
    for (int u = 0; u < mask.width_px(); ++u) {
      const bool is_in = u >= left && u < right && v >= top && v < bottom;
      if ((mask.at(u, v) != 0) != is_in) {
        return testing::AssertionFailure() << "column " << u << ", row " << v;
      }
    }
  }
  return testing::AssertionSuccess();
}

TEST(SimulatedMask, TheExactOneIsThePixels) {
  EXPECT_TRUE(is_block(exact_mask(instances_of_one(), kObject), 5, 4, 13, 10));
}

TEST(SimulatedMask, ANetworksIsOfBlocksThatAreHalfTheObjects) {
  // Of the blocks of columns 4 to 8, 3 of 4 are the object's, of 12 to 16 one of 4; of those of
  // rows 8 to 12 two of 4: 6 of 16 in the first column of blocks, 8 of 16 in the second.
  const MaskImage mask = network_mask(instances_of_one(), kObject, {0, 0, 24, 16}, {.block_px = 4});
  EXPECT_EQ(std::ranges::count(mask.pixels(), 1), 3 * 16);
  EXPECT_EQ(mask.at(4, 4), 1);
  EXPECT_EQ(mask.at(4, 8), 0);
  EXPECT_EQ(mask.at(8, 8), 1);
  EXPECT_EQ(mask.at(12, 4), 0);
}

TEST(SimulatedMask, ANetworksIsMoved) {
  // Columns 8 to 16 and rows 4 to 10: rows 8 to 12 are half the object's.
  EXPECT_TRUE(is_block(
      network_mask(instances_of_one(), kObject, {0, 0, 24, 16}, {.block_px = 4, .du_px = 3}),
      8,
      4,
      16,
      12));
  EXPECT_TRUE(is_block(
      network_mask(
          instances_of_one(), kObject, {0, 0, 24, 16}, {.block_px = 4, .du_px = 3, .dv_px = -9}),
      8,
      0,
      16,
      0));
}

TEST(SimulatedMask, ANetworksEndsAtItsBox) {
  EXPECT_TRUE(is_block(
      network_mask(instances_of_one(), kObject, {9, 5, 24, 11}, {.block_px = 4, .du_px = 3}),
      9,
      5,
      16,
      11));
}

TEST(SimulatedMask, OneWithoutAPixelIsNone) {
  // One of the object's pixels in each block of 4 x 4: no block is half the object's.
  Image<ObjectId> instances(640, 480);
  for (int v = 200; v < 280; v += 4) {
    for (int u = 300; u < 400; u += 4) instances.at(u, v) = kObject;
  }
  auto objects = visible_objects(instances, std::array<std::string_view, 1>{"chair"});
  objects.at(0).unhidden_share = 1.0;
  ClassRegistry registry;
  const SimulatedDetectorOptions options{
      .miss_rate = 0.0, .false_alarms_per_frame = 0.0, .masks = true};
  const auto detector = SimulatedDetector::create(options, registry, 42);
  ASSERT_TRUE(detector);
  const auto found = detector->detect(objects, instances, 0).detections;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].mask);
}

TEST(SimulatedMask, ANoisyDetectorsIsOffByTwoPixelsAndNeverOutsideItsBox) {
  ClassRegistry registry;
  const SimulatedDetectorOptions options{.false_alarms_per_frame = 0.0, .masks = true};
  const auto detector = SimulatedDetector::create(options, registry, 42);
  ASSERT_TRUE(detector);
  Image<ObjectId> instances(640, 480);
  for (int v = 200; v < 280; ++v) std::fill_n(&instances.at(300, v), 100, kObject);
  auto objects = visible_objects(instances, std::array<std::string_view, 1>{"chair"});
  objects.at(0).unhidden_share = 1.0;
  std::size_t num_exact = 0;
  std::size_t num_all = 0;
  for (std::uint64_t frame = 0; frame < 100; ++frame) {
    for (const Detection& found : detector->detect(objects, instances, frame).detections) {
      ASSERT_TRUE(found.mask);
      ++num_all;
      num_exact += *found.mask == exact_mask(instances, kObject) ? 1U : 0U;
      for (int v = 0; v < 480; ++v) {
        for (int u = 0; u < 640; ++u) {
          if (found.mask->at(u, v) == 0) continue;
          ASSERT_TRUE(u + 1 > found.box_px.u_min_px && u < found.box_px.u_max_px);
          ASSERT_TRUE(v + 1 > found.box_px.v_min_px && v < found.box_px.v_max_px);
          // Six standard deviations and a block.
          ASSERT_TRUE(u >= 284 && u < 416 && v >= 184 && v < 296);
        }
      }
    }
  }
  EXPECT_GT(num_all, 60U);
  EXPECT_LT(num_exact, num_all / 4);
}

// 640 / 160: as networks fit an image into their squares, whichever side is the longer.
TEST(SimulatedMask, OfAHighImageConsistsOfSquaresOfFourPixels) {
  ClassRegistry registry;
  const auto detector =
      SimulatedDetector::create({.false_alarms_per_frame = 0.0, .masks = true}, registry, 42);
  ASSERT_TRUE(detector);
  Image<ObjectId> instances(480, 640);
  for (int v = 200; v < 320; ++v) {
    for (int u = 150; u < v - 40; ++u) instances.at(u, v) = ObjectId{1};  // stairs have many edges
  }
  auto objects = visible_objects(instances, std::array{std::string_view("chair")});
  objects.at(0).unhidden_share = 1.0;
  int num_edges = 0;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    for (const Detection& seen : detector->detect(objects, instances, frame).detections) {
      std::set<int> phases;
      for (int v = 0; v < 640; ++v) {
        for (int u = 1; u < 480; ++u) {
          const bool is_cut =
              std::abs(u - seen.box_px.u_min_px) < 2 || std::abs(u - seen.box_px.u_max_px) < 2;
          if (is_cut || seen.mask->at(u, v) == seen.mask->at(u - 1, v)) continue;
          phases.insert(u % 4);
          ++num_edges;
        }
      }
      EXPECT_LE(phases.size(), 1U) << "frame " << frame;
    }
  }
  EXPECT_GT(num_edges, 200);
}

}  // namespace
}  // namespace hypermap
