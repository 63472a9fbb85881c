// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/segmentation_statistics.hpp"

#include "hypermap/core/segmentation/segmentation_trace.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace hypermap {
namespace {

class SegmentationStatisticsTest : public testing::Test {
 protected:
  SegmentationStatisticsTest() : data(test::write_tum(dir / "lab")) {}

  [[nodiscard]] std::unique_ptr<DatasetReader> opened() {
    return open_dataset(data.folder, {}, classes).value();
  }

  test::TempDir dir;
  test::SyntheticDataset data;
  ClassRegistry classes;
};

TEST_F(SegmentationStatisticsTest, OneDetectionInFourFramesIsItsOwnStatistics) {
  const auto dataset = opened();
  const GeometricSegmentationOptions options = smap_segmentation();
  const SegmentationStatistics statistics = segmentation_statistics(*dataset, options).value();
  EXPECT_EQ(statistics.num_frames, 4U);
  EXPECT_EQ(statistics.num_skipped, 0U);
  ASSERT_EQ(statistics.num_detections, 1U);
  const RgbdFrame frame = dataset->read(2).value();
  const SegmentationTrace trace = trace_segmentation(frame, frame.detections.at(0), options);
  EXPECT_EQ(statistics.num_segments, trace.segment ? 1U : 0U);
  ASSERT_EQ(statistics.steps.size(), trace.steps.size());
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const auto points = static_cast<double>(trace.steps[i].num_points);
    EXPECT_EQ(statistics.steps[i].name, trace.steps[i].name);
    EXPECT_EQ(statistics.steps[i].num_detections, 1U);
    EXPECT_EQ(statistics.steps[i].points, (FiveNumbers{points, points, points, points, points}));
  }
  EXPECT_GE(statistics.seconds.median, statistics.steps.front().seconds.median);
}

TEST_F(SegmentationStatisticsTest, AFrameThatCannotBeReadIsCounted) {
  std::filesystem::remove(data.folder / data.depth_of_1);
  const auto dataset = opened();
  const SegmentationStatistics statistics = segmentation_statistics(*dataset, {}).value();
  EXPECT_EQ(statistics.num_frames + statistics.num_skipped, dataset->size());
  EXPECT_EQ(statistics.num_skipped, 1U);
}

TEST_F(SegmentationStatisticsTest, ItEndsWhenAskedAndSaysTheSameInJson) {
  const auto dataset = opened();
  const auto ended =
      segmentation_statistics(*dataset, {}, [](std::size_t done, std::size_t) { return done < 2; });
  EXPECT_EQ(ended.error().code, ErrorCode::kInterrupted);
  const auto statistics = segmentation_statistics(*dataset, {}).value();
  const auto json = JsonDocument::parse(to_json(statistics), "times").value();
  EXPECT_EQ(json.root().find("frames")->number().value(), 4.0);
  EXPECT_EQ(json.root().find("steps")->size(), statistics.steps.size());
}

}  // namespace
}  // namespace hypermap
