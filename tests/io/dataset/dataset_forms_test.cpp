// SPDX-License-Identifier: BSD-3-Clause
// Forms of other public sequences: read rightly by a key of the description, or refused by name.
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hypermap {
namespace {

using test::TempDir;
using test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kSidePx = 20;

/// Four frames of 20 x 20 pixels, 1 m deep, and a description of them with these lines more.
class DatasetForms : public ::testing::Test {
 protected:
  void describe(const std::string& lines, const std::string& fy = "8") {
    for (int i = 0; i < 4; ++i)
      write_text(folder_ / ("d/" + test::padded(i, 4) + ".pgm"),
                 test::pgm16(1000, kSidePx, kSidePx));
    write_text(
        folder_ / "dataset.yaml",
        "intrinsics: {width: 20, height: 20, fx: 8, fy: " + fy +
            ", cx: 9.5, cy: 9.5}\ndepth: d/*.pgm\ndepth_scale: 1000\ntrajectory: traj.txt\n" +
            lines);
  }

  void write_poses() {
    std::string lines;
    for (int i = 0; i < 4; ++i)
      lines += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0 0 0 0 1\n";
    write_text(folder_ / "traj.txt", lines);
  }

  /// Label images whose left half is class `number`, the rest 0.
  void write_labels(std::uint16_t number) {
    std::string image = test::pgm16(0, kSidePx, kSidePx);
    const std::size_t num_pixels = std::size_t{kSidePx} * kSidePx;
    const std::size_t begin = image.size() - 2 * num_pixels;
    for (std::size_t i = 0; i < num_pixels; ++i) {
      if (i % kSidePx >= kSidePx / 2) continue;
      image[begin + 2 * i] = static_cast<char>(number >> 8U);
      image[begin + 2 * i + 1] = static_cast<char>(number & 0xFFU);
    }
    for (int i = 0; i < 4; ++i) write_text(folder_ / ("l/" + test::padded(i, 4) + ".pgm"), image);
  }

  Result<std::unique_ptr<DatasetReader>> opened() {
    return open_dataset(folder_.path(), {}, classes_);
  }

  /// Of frame 0, or of opening the folder.
  std::string refusal() {
    const auto reader = opened();
    if (!reader) return to_string(reader.error());
    const auto frame = (*reader)->read(0);
    return frame ? "was read" : to_string(frame.error());
  }

  TempDir folder_;
  ClassRegistry classes_;
};

TEST_F(DatasetForms, FlattenedMatricesGoToTheImagesInOrder) {
  describe("trajectory_format: lines\n");
  write_poses();
  const auto reader = opened();
  ASSERT_TRUE(reader) << to_string(reader.error());
  EXPECT_THAT((*reader)->summary().findings, IsEmpty());
  EXPECT_EQ((*reader)->summary().num_poses, 4U);
  EXPECT_EQ((*reader)->read(3)->map_from_camera.origin().xyz, Eigen::Vector3d(3.0, 0.0, 0.0));
}

TEST_F(DatasetForms, ImagesThatWereLeftOutFindTheirPoseByNumber) {
  describe("trajectory_format: lines\npair_by: number\n");
  write_poses();
  std::filesystem::remove(folder_ / "d/0001.pgm");
  const auto reader = opened();
  ASSERT_TRUE(reader) << to_string(reader.error());
  EXPECT_EQ((*reader)->read(1)->map_from_camera.origin().xyz, Eigen::Vector3d(2.0, 0.0, 0.0));
}

TEST_F(DatasetForms, PosesWithoutStampsArePairedByNoStamp) {
  describe("trajectory_format: lines\npair_by: stamp\n");
  write_poses();
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("traj.txt"), HasSubstr("pair_by: must be order or number")));
}

TEST_F(DatasetForms, PosesWithoutStampsInAnotherFormatNameTheirOwn) {
  describe("pair_by: order\n");
  write_poses();
  EXPECT_THAT(refusal(), AllOf(HasSubstr("traj.txt"), HasSubstr("`trajectory_format: lines`")));
}

TEST_F(DatasetForms, NegativeFyIsRefusedByName) {
  describe("trajectory_format: lines\n", "-8");
  write_poses();
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("dataset.yaml:1"),
                    HasSubstr("intrinsics.fy"),
                    HasSubstr("is -8: negative fy")));
}

TEST_F(DatasetForms, RotatedDepthIsReadAsTheDescriptionSays) {
  describe("trajectory_format: lines\ndepth_rotated_bits: 3\n");
  write_poses();
  // 2,000 rotated left by 3 bits: 2,000 * 8.
  for (int i = 0; i < 4; ++i)
    write_text(folder_ / ("d/" + test::padded(i, 4) + ".pgm"),
               test::pgm16(16'000, kSidePx, kSidePx));
  const auto reader = opened();
  ASSERT_TRUE(reader) << to_string(reader.error());
  EXPECT_EQ((*reader)->read(0)->depth_m.at(5, 5), 2.0F);
  describe("trajectory_format: lines\ndepth_rotated_bits: 16\n");
  EXPECT_THAT(refusal(), HasSubstr("depth_rotated_bits"));
}

TEST_F(DatasetForms, ClassNumbersBeyondTheAssumedNamesAreRefusedByName) {
  describe("trajectory_format: lines\nlabels: l/*.pgm\n");
  write_poses();
  write_labels(41);
  EXPECT_THAT(
      refusal(),
      AllOf(HasSubstr("l/0000.pgm"), HasSubstr("class number 41"), HasSubstr("`label_names`")));
  write_labels(40);
  EXPECT_EQ(refusal(), "was read");
}

TEST_F(DatasetForms, ClassNumbersAreNamedByAFileOfTheDescription) {
  describe("trajectory_format: lines\nlabels: l/*.pgm\nlabel_names: names.txt\n");
  write_poses();
  write_labels(1163);
  write_text(folder_ / "names.txt", "# raw numbers\n1163 office chair\n3 table\n");
  const auto reader = opened();
  ASSERT_TRUE(reader) << to_string(reader.error());
  const auto frame = (*reader)->read(0);
  ASSERT_TRUE(frame) << to_string(frame.error());
  ASSERT_THAT(frame->detections, SizeIs(1));
  EXPECT_EQ(best_class(frame->detections[0].class_scores)->id, *classes_.find("office chair"));
  // Numbers that the file leaves out are of nothing.
  write_labels(255);
  EXPECT_THAT((*reader)->read(1)->detections, IsEmpty());
}

TEST_F(DatasetForms, BrokenNamesOfClassesAreRefusedByLine) {
  describe("trajectory_format: lines\nlabels: l/*.pgm\nlabel_names: names.txt\n");
  write_poses();
  write_labels(3);
  for (const std::string bad : {"3\n", "chair 3\n", "70000 chair\n", "4 bed\n4 sofa\n"}) {
    write_text(folder_ / "names.txt", "# names\n" + bad);
    EXPECT_THAT(refusal(), HasSubstr("names.txt:")) << bad;
  }
}

}  // namespace
}  // namespace hypermap
