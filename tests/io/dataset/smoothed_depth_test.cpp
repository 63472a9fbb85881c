// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/smoothed_depth.hpp"

#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(SmoothedDepth, IsThatOfTheSmootherAndAllElseAsRecorded) {
  const test::TempDir folder;
  test::write_tum(folder.path());
  ClassRegistry classes;
  const auto recorded = open_dataset(folder.path(), {}, classes).value();
  const DepthSmoothingOptions options{.min_depth_m = 0.0};
  const auto smooth =
      with_smoothed_depth(open_dataset(folder.path(), {}, classes).value(), options);
  ASSERT_EQ(smooth->size(), recorded->size());
  const RgbdFrame given = recorded->read(1).value();
  const RgbdFrame frame = smooth->read(1).value();
  EXPECT_EQ(frame.depth_m, DepthSmoother(options).smoothed(given.depth_m, 1));
  EXPECT_EQ(frame.color, given.color);
  EXPECT_EQ(frame.detections.size(), given.detections.size());
  EXPECT_EQ(smooth->frame_name(1), recorded->frame_name(1));
}

TEST(SmoothedDepth, WithoutARuleTheDatasetItselfIsGivenBack) {
  const test::TempDir folder;
  test::write_tum(folder.path());
  ClassRegistry classes;
  auto recorded = open_dataset(folder.path(), {}, classes).value();
  const DatasetReader* const given = recorded.get();
  EXPECT_EQ(with_smoothed_depth(std::move(recorded), {.rule = DepthSmoothingRule::kNone}).get(),
            given);
}

}  // namespace
}  // namespace hypermap
