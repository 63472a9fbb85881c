// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "io/dataset/opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::refusal;
using test::SyntheticDataset;
using test::TempDir;
using test::write_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(DatasetRefusals, AFolderOfNoLayoutSaysWhatWasLookedFor) {
  const TempDir dir;
  EXPECT_THAT(refusal(dir.path()), HasSubstr("expected dataset.yaml"));
  EXPECT_THAT(refusal(dir.path()), HasSubstr("--dataset"));
  EXPECT_THAT(refusal(dir / "absent"), HasSubstr("does not exist"));
  write_text(dir / "file", "");
  EXPECT_THAT(refusal(dir / "file"), HasSubstr("is no folder"));
}

TEST(DatasetRefusals, WhatCannotBeLookedAtIsNotTakenForAbsent) {
  for (const std::string name : {"dataset.yaml", "intrinsics.json", "depth.txt"}) {
    const TempDir dir;
    const SyntheticDataset tum = test::write_tum(dir / "t");
    std::filesystem::remove(tum.folder / name);
    std::filesystem::create_symlink(name, tum.folder / name);  // leads to itself
    EXPECT_THAT(refusal(tum.folder), HasSubstr(name + ": cannot be looked at: Too many levels"));
  }
}

TEST(DatasetRefusals, IntrinsicsOfAnotherSizeThanTheImagesAreRefused) {
  const TempDir dir;
  const SyntheticDataset tum = test::write_tum(dir / "t");
  write_text(tum.folder / "intrinsics.json",
             R"({"width": 640, "height": 480, "fx": 500, "fy": 500, "cx": 320, "cy": 240})");
  EXPECT_THAT(refusal(tum.folder), HasSubstr("must be the images' 8 x 6, is 640 x 480"));
}

TEST(DatasetRefusals, ADescriptionWithAFaultNamesFileLineAndField) {
  const TempDir dir;
  const auto described = [&](const std::string& text) {
    write_text(dir / "dataset.yaml", text);
    return refusal(dir.path());
  };
  const std::string good =
      "intrinsics: {fx: 8, fy: 8, cx: 3.5, cy: 2.5}\ndepth: d/*.pgm\ntrajectory: p.txt\n"
      "depth_scale: 1000\n";
  const std::string unscaled = good.substr(0, good.find("depth_scale"));
  EXPECT_THAT(described(unscaled + "depth_scale: 0\n"), HasSubstr("dataset.yaml:4: depth_scale"));
  EXPECT_THAT(described(good + "pair_by: luck\n"),
              HasSubstr("must be one of stamp, number, order"));
  EXPECT_THAT(described(good + "color: ../x/*.png\n"), HasSubstr("inside the dataset's folder"));
  EXPECT_THAT(described(good + "up_axis: up\n"), HasSubstr("up_axis"));
  EXPECT_THAT(described(good), HasSubstr("has no depth image"));
}

TEST(DatasetRefusals, ADescriptionNamesWhatItNeedsAllAtOnceWithExamples) {
  const TempDir dir;
  const auto described = [&](const std::string& text) {
    write_text(dir / "dataset.yaml", text);
    return refusal(dir.path());
  };
  const std::string all = described("name: nothing else\n");
  EXPECT_THAT(all, HasSubstr("must name intrinsics, depth, depth_scale, trajectory"));
  for (const char* example : {"intrinsics: {width: 640",
                              "depth: depth/*.png",
                              "depth_scale: 1000",
                              "trajectory: poses.txt"}) {
    EXPECT_THAT(all, HasSubstr(example));
  }
  const std::string unscaled =
      described("intrinsics: {fx: 8, fy: 8, cx: 3.5, cy: 2.5}\ndepth: d/*.pgm\ntrajectory: p\n");
  EXPECT_THAT(unscaled, HasSubstr("must name depth_scale, for example: depth_scale: 1000"));
  EXPECT_THAT(unscaled, Not(HasSubstr("trajectory")));
}

TEST(DatasetRefusals, TheScaleMayComeFromTheFileOfTheIntrinsics) {
  const TempDir dir;
  const SyntheticDataset data = test::write_described(dir / "d");
  const std::string rest =
      "intrinsics: k.json\ndepth: d/*_d.pgm\ntrajectory: p.txt\npair_by: order\n";
  write_text(data.folder / "dataset.yaml", rest);
  write_text(data.folder / "k.json", test::intrinsics_json(100));
  EXPECT_EQ(refusal(data.folder), "was accepted");
  write_text(data.folder / "k.json",
             R"({"width": 8, "height": 6, "fx": 8, "fy": 8, "cx": 3.5, "cy": 2.5})");
  EXPECT_THAT(refusal(data.folder), HasSubstr("k.json: has no depth_scale"));
  write_text(data.folder / "dataset.yaml", rest + "depth_scale: 100\n");
  EXPECT_EQ(refusal(data.folder), "was accepted");
}

/// TUM's layout without colour; images and poses of frame i have stamp i + 1 with these digits
/// behind it. What is said of the stamps, and of why the first frame has no pose.
std::vector<std::string> said_of_stamps(const std::string& image_digits,
                                        const std::string& pose_digits) {
  const TempDir dir;
  const SyntheticDataset tum = test::write_tum(dir / "t");
  std::string depth;
  std::string poses;
  for (int i = 0; i < test::kSyntheticFrames; ++i) {
    const std::string number = std::to_string(i + 1);
    depth.append(number + image_digits).append(" depth/").append(std::to_string(100 + i));
    depth.append(".000.pgm\n");
    poses.append(number + pose_digits).append(" 0 0 0 0 0 0 1\n");
  }
  write_text(tum.folder / "depth.txt", depth);
  write_text(tum.folder / "groundtruth.txt", poses);
  std::filesystem::remove(tum.folder / "rgb.txt");
  std::filesystem::remove(tum.folder / "detections.jsonl");
  ClassRegistry registry;
  const auto reader = test::opened(tum.folder, registry);
  std::vector<std::string> said;
  for (const Finding& finding : reader->summary().findings)
    said.push_back(to_string(finding.error));
  if (const auto frame = reader->read(0); !frame) said.push_back(to_string(frame.error()));
  return said;
}

TEST(DatasetRefusals, StampsOfTwoUnitsAreNamed) {
  EXPECT_THAT(said_of_stamps("", ""), IsEmpty());
  for (const auto& [digits, unit] : {std::pair{"000000000", "nanoseconds"},
                                     std::pair{"000000", "microseconds"},
                                     std::pair{"000", "milliseconds"}}) {
    // Of the sequence, and in the reason why a frame cannot be used.
    EXPECT_THAT(said_of_stamps("", digits),
                ElementsAre(HasSubstr(std::string("its stamps are taken as ") + unit),
                            HasSubstr(std::string("its stamps are taken as ") + unit)));
    EXPECT_THAT(said_of_stamps(digits, ""),
                ElementsAre(HasSubstr(std::string("theirs are taken as ") + unit),
                            HasSubstr(std::string("theirs are taken as ") + unit)));
  }
}

TEST(DatasetRefusals, StampsThatMerelyMissEachOtherAreNoMatterOfUnits) {
  EXPECT_THAT(said_of_stamps("", "7"), ElementsAre(HasSubstr("no pose within 0.02 s")));
}

TEST(DatasetRefusals, ListsThatLeaveTheFolderOrRepeatAStampAreRefused) {
  const TempDir dir;
  const SyntheticDataset tum = test::write_tum(dir / "t");
  write_text(tum.folder / "depth.txt", "100 ../../etc/passwd\n");
  EXPECT_THAT(refusal(tum.folder), HasSubstr("depth.txt:1: path"));
  write_text(tum.folder / "depth.txt", "100 a.png\n100 b.png\n");
  EXPECT_THAT(refusal(tum.folder), HasSubstr("timestamp: must occur once"));
}

}  // namespace
}  // namespace hypermap
