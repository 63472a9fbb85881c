// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/corrected_poses.hpp"

#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

std::unique_ptr<DatasetReader> opened(const std::filesystem::path& folder) {
  ClassRegistry classes;
  return open_dataset(folder, {}, classes).value();
}

TEST(CorrectedPoses, FramesTakeThePoseOfTheNearestStamp) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  // Frame 2 (stamp 102.000) lies between two poses; nothing is near frame 3.
  test::write_text(folder.path() / "closed.txt",
                   "100.001 5 0 0 0 0 0 1\n101.000 6 0 0 0 0 0 1\n"
                   "101.990 7 0 0 0 0 0 1\n102.001 8 0 0 0 0 0 1\n103.5 9 0 0 0 0 0 1\n");
  auto recorded = opened(folder.path() / "recorded");
  const Stamp stamp = recorded->read(2)->stamp;
  const auto corrected =
      with_corrected_poses(std::move(recorded), folder.path() / "closed.txt").value();
  ASSERT_EQ(corrected->size(), 4U);
  EXPECT_EQ(corrected->read(2)->stamp, stamp);
  EXPECT_EQ(corrected->read(0)->map_from_camera.origin().xyz.x(), 5.0);
  EXPECT_EQ(corrected->read(2)->map_from_camera.origin().xyz.x(), 8.0);
  EXPECT_EQ(corrected->read(2)->detections.size(), 1U);
  const auto lost = corrected->read(3);
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, ErrorCode::kNotFound);
  EXPECT_NE(lost.error().file.find("closed.txt"), std::string::npos);
  EXPECT_EQ(corrected->summary().num_poses, 5U);
}

TEST(CorrectedPoses, ALogGoesByTheNumberOfTheFrame) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  test::write_text(folder.path() / "closed.log",
                   "1 1 2\n" + test::pose_rows(7) + "3 3 4\n" + test::pose_rows(9));
  const auto corrected =
      with_corrected_poses(opened(folder.path() / "recorded"), folder.path() / "closed.log")
          .value();
  EXPECT_FALSE(corrected->read(0));
  EXPECT_EQ(corrected->read(1)->map_from_camera.origin().xyz.x(), 7.0);
  EXPECT_EQ(corrected->read(3)->map_from_camera.origin().xyz.x(), 9.0);
}

TEST(CorrectedPoses, AreTurnedWithTheWorld) {
  const test::TempDir folder;
  test::write_tum(folder.path());
  const auto corrected =
      with_corrected_poses(opened(folder.path()), folder.path() / "groundtruth.txt").value();
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.translation() = Eigen::Vector3d(0.0, 0.0, 4.0);
  corrected->set_map_from_input(MapFromInput(turned));
  EXPECT_EQ(corrected->read(1)->map_from_camera.origin().xyz, Eigen::Vector3d(1.0, 0.0, 4.0));
}

TEST(CorrectedPoses, AFileThatCannotBeReadIsNamed) {
  const test::TempDir folder;
  test::write_tum(folder.path());
  const auto missing = with_corrected_poses(opened(folder.path()), folder.path() / "none.txt");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().file.find("none.txt"), std::string::npos);
}

}  // namespace
}  // namespace hypermap
