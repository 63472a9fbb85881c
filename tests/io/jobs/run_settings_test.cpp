// SPDX-License-Identifier: BSD-3-Clause
#include "run_settings.hpp"

#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using ::testing::HasSubstr;

class RunSettings : public ::testing::Test {
 protected:
  RunSettings() {
    test::write_tum(folder_ / "dataset");
    test::write_text(folder_ / "found.jsonl", test::chair_in("rgb/102.010.pgm"));
    job_.input = folder_ / "dataset";
    job_.dataset.detections = {folder_ / "found.jsonl"};
  }

  [[nodiscard]] ValueTree settings(const MappingJob& job) const {
    ClassRegistry classes;
    const auto dataset = open_dataset(job.input, job.dataset, classes);
    EXPECT_TRUE(dataset) << to_string(dataset.error());
    auto said = settings_of(job, **dataset);
    EXPECT_TRUE(said) << to_string(said.error());
    return said.value();
  }

  /// What is said of `changed`, with the job as it was before.
  [[nodiscard]] std::string difference(const MappingJob& changed) const {
    const auto same = refuse_other_settings(settings(changed), settings(job_));
    return same ? "none" : to_string(same.error());
  }

  TempDir folder_;
  MappingJob job_;
};

TEST_F(RunSettings, WhatChangesNoMapMayDiffer) {
  MappingJob other = job_;
  other.output = "elsewhere.hmap";
  other.mapper.num_threads = 7;
  other.checkpoint_every = 3;
  other.max_skipped_share = 0.5;
  other.strict = true;
  other.limits.sums.max_pixels = 1;
  EXPECT_EQ(difference(other), "none");
}

TEST_F(RunSettings, EachSettingIsNamedWithBothValues) {
  MappingJob other = job_;
  other.dataset.stride = 2;
  EXPECT_EQ(difference(other), "stride: is 2, must be that of the run to go on with, 1");
  other = job_;
  other.dataset.first = 1;
  EXPECT_EQ(difference(other), "first: is 1, must be that of the run to go on with, 0");
  other = job_;
  other.dataset.max_frames = 3;
  EXPECT_EQ(difference(other), "max_frames: is 3, must be that of the run to go on with, none");
  other = job_;
  other.up_axis = "-y";
  EXPECT_EQ(difference(other), "up: is -y, must be that of the run to go on with, none");
  other = job_;
  other.append = true;
  EXPECT_EQ(difference(other), "append: is yes, must be that of the run to go on with, no");
  other = job_;
  other.placement = WorldPlacement{.x_m = 1.5, .yaw_rad = 0.25};
  EXPECT_EQ(difference(other),
            "transform: is 1.5,0,0,0.25, must be that of the run to go on with, none");
  other = job_;
  other.detector.min_score = 0.5;
  EXPECT_EQ(difference(other),
            "detector.min_score: is 0.5, must be that of the run to go on with, 0.25");
  other = job_;
  other.looks.rule = LookRule::kKeyframes;
  EXPECT_EQ(difference(other),
            "detect.rule: is keyframes, must be that of the run to go on with, every");
  other = job_;
  other.detector.network_form = NetworkForm::kDetr;
  EXPECT_EQ(difference(other),
            "detector.network_form: is detr, must be that of the run to go on with, auto");
  other = job_;
  other.detector.channel_stddev = {255.0, 255.0, 128.0};
  EXPECT_EQ(
      difference(other),
      "detector.channel_stddev: is 255,255,128, must be that of the run to go on with, 0,0,0");
}

TEST_F(RunSettings, AMapTellsWhatItWasMadeWithBesidesOptionsAndFrames) {
  EXPECT_TRUE(companion_settings(job_)->empty());
  job_.place_rules.emplace();
  job_.place_rules->belongings = {{"cup", {{"kitchen", 2.0}}}};
  job_.place_rules->places = {"kitchen"};
  EXPECT_TRUE(companion_settings(job_)->empty()) << "they are not used";
  job_.mapper.prior.source = ClassPriorKind::kPlaces;
  job_.place_rules_name = "mine.yaml";
  test::write_text(folder_ / "c.json", "{}");
  job_.combiner = folder_ / "c.json";
  const auto companions = companion_settings(job_).value();
  ASSERT_EQ(companions.size(), 2U);
  EXPECT_EQ(companions[0].first, "combiner");
  EXPECT_THAT(companions[0].second.text, testing::StartsWith("c.json xxh3-128:"));
  EXPECT_EQ(companions[1].first, "places");
  EXPECT_THAT(companions[1].second.text, testing::StartsWith("mine.yaml xxh3-128:"));
  const std::string before = companions[1].second.text;
  job_.place_rules->belongings["cup"]["kitchen"] = 3.0;
  EXPECT_NE(companion_settings(job_).value()[1].second.text, before);
  job_.combiner = folder_ / "absent.json";
  EXPECT_EQ(companion_settings(job_).error().code, ErrorCode::kIo);
}

TEST_F(RunSettings, FilesAreKnownByNameAndContentWhereverTheyLie) {
  MappingJob other = job_;
  fs::create_directories(folder_ / "moved");
  fs::copy_file(folder_ / "found.jsonl", folder_ / "moved/found.jsonl");
  other.dataset.detections = {folder_ / "moved/found.jsonl"};
  EXPECT_EQ(difference(other), "none");
  test::write_text(folder_ / "moved/found.jsonl",
                   test::chair_in("rgb/102.010.pgm") + test::chair_in("rgb/101.010.pgm"));
  EXPECT_THAT(difference(other), HasSubstr("detections: is found.jsonl xxh3-128:"));
  other.dataset.detections.clear();
  EXPECT_THAT(difference(other), HasSubstr("detections: is none, must be"));
}

TEST_F(RunSettings, OtherFramesAreAnotherInput) {
  const ValueTree before = settings(job_);
  fs::rename(folder_ / "dataset/depth/103.000.pgm", folder_ / "dataset/depth/renamed.pgm");
  fs::rename(folder_ / "dataset/rgb/103.010.pgm", folder_ / "dataset/rgb/renamed.pgm");
  test::write_text(folder_ / "dataset/rgb.txt",
                   "100.010 rgb/100.010.pgm\n101.010 rgb/101.010.pgm\n102.010 rgb/102.010.pgm\n"
                   "103.010 rgb/renamed.pgm\n");
  const auto refused = refuse_other_settings(settings(job_), before);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "frames");
  EXPECT_THAT(refused.error().what, HasSubstr("is 4 with 1 detections, names xxh3-128:"));
}

TEST_F(RunSettings, AFileThatIsNotThereIsNamed) {
  ClassRegistry classes;
  const auto dataset = open_dataset(job_.input, job_.dataset, classes);
  ASSERT_TRUE(dataset);
  job_.model = folder_ / "gone.onnx";
  const auto refused = settings_of(job_, **dataset);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("gone.onnx"));
}

}  // namespace
}  // namespace hypermap
