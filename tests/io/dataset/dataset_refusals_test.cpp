// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "io/dataset/opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hypermap {
namespace {

using test::refusal;
using test::SyntheticDataset;
using test::TempDir;
using test::write_text;
using ::testing::HasSubstr;

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
      "intrinsics: {fx: 8, fy: 8, cx: 3.5, cy: 2.5}\ndepth: d/*.pgm\ntrajectory: p.txt\n";
  EXPECT_THAT(described("depth: d/*.pgm\ntrajectory: p\n"), HasSubstr("intrinsics"));
  EXPECT_THAT(described(good + "depth_scale: 0\n"), HasSubstr("dataset.yaml:4: depth_scale"));
  EXPECT_THAT(described(good + "pair_by: luck\n"),
              HasSubstr("must be one of stamp, number, order"));
  EXPECT_THAT(described(good + "color: ../x/*.png\n"), HasSubstr("inside the dataset's folder"));
  EXPECT_THAT(described(good + "up_axis: up\n"), HasSubstr("up_axis"));
  EXPECT_THAT(described(good), HasSubstr("has no depth image"));
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
