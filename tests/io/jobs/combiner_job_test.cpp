// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/combiner_job.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/io/combiner/combiner_file.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/block_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr int kNumLabelled = 60;

/// Cups and bowls in turn. "eager" calls everything a cup and is sure of it; "careful" is right.
CombinerJob job_of_two(const TempDir& folder) {
  test::write_block_dataset(folder / "data", kNumLabelled);
  const auto true_class = [](int i) { return i % 2 == 0 ? "cup" : "bowl"; };
  std::string eager;
  std::string careful;
  std::string labels;
  for (int i = 0; i < kNumLabelled; ++i) {
    eager += test::block_seen_as(
        i, "{\"label\": \"cup\", \"score\": 0.9, \"scores\": {\"cup\": 0.9, \"bowl\": 0.1}");
    careful +=
        test::block_seen_as(i,
                            std::string("{\"label\": \"") + true_class(i) +
                                "\", \"score\": 0.6, \"scores\": {\"cup\": " +
                                (i % 2 == 0 ? "0.6, \"bowl\": 0.4}" : "0.4, \"bowl\": 0.6}"));
    labels +=
        test::block_seen_as(i, std::string("{\"label\": \"") + true_class(i) + "\", \"score\": 1");
  }
  test::write_text(folder / "eager.jsonl", eager);
  test::write_text(folder / "careful.jsonl", careful);
  test::write_text(folder / "labels.jsonl", labels);
  CombinerJob job{.input = folder / "data",
                  .labels = folder / "labels.jsonl",
                  .output = folder / "combiner.json"};
  job.dataset.detections = {folder / "eager.jsonl", folder / "careful.jsonl"};
  return job;
}

TEST(CombinerJob, LearnsFromLabelsAndTellsHowOftenEachIsRight) {
  const TempDir folder;
  const CombinerJob job = job_of_two(folder);
  const auto report = train_combiner_job(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 60U);
  EXPECT_EQ(report->num_examples, 48U);
  EXPECT_EQ(report->num_held_out, 12U);
  EXPECT_EQ(report->num_unlabelled, 0U);
  EXPECT_THAT(report->classes, ElementsAre("cup", "bowl"));
  ASSERT_THAT(report->scores, SizeIs(5));
  const auto right = [&](std::size_t i) { return report->scores[i].num_right; };
  EXPECT_EQ(report->scores[0].name, "eager");
  EXPECT_EQ(right(0), 6U);   // the cups of frames 4, 9, 14 ... 59
  EXPECT_EQ(right(1), 12U);  // careful
  EXPECT_EQ(right(2), 6U);   // sum: 0.9 + 0.4 > 0.1 + 0.6
  EXPECT_EQ(right(3), 6U);   // product: 0.36 > 0.06
  EXPECT_EQ(report->scores[4].name, "trained");
  EXPECT_EQ(right(4), 12U);
  const auto model = read_combiner(job.output);
  ASSERT_TRUE(model) << to_string(model.error());
  EXPECT_EQ(model->detectors.at(1).name, "careful");
}

TEST(CombinerJob, AMapThatIsMadeByItBelievesIt) {
  const TempDir folder;
  const CombinerJob learnt = job_of_two(folder);
  ASSERT_TRUE(train_combiner_job(learnt));
  std::string bowls;
  std::string cups;
  for (int i = 0; i < kNumLabelled; ++i) {
    cups += test::block_seen_as(
        i, "{\"label\": \"cup\", \"score\": 0.9, \"scores\": {\"cup\": 0.9, \"bowl\": 0.1}");
    bowls += test::block_seen_as(
        i, "{\"label\": \"bowl\", \"score\": 0.6, \"scores\": {\"cup\": 0.4, \"bowl\": 0.6}");
  }
  test::write_text(folder / "b/eager.jsonl", cups);
  test::write_text(folder / "b/careful.jsonl", bowls);
  MappingJob job{.input = folder / "data", .output = folder / "a.hmap"};
  job.dataset.detections = {folder / "b/eager.jsonl", folder / "b/careful.jsonl"};
  job.dataset.max_frames = 4;
  job.up_axis = "z";
  job.mapper.num_threads = 1;
  const auto best = [&] {
    const auto report = run_mapping(job);
    EXPECT_TRUE(report) << to_string(report.error());
    auto map = load_archive(job.output);
    EXPECT_TRUE(map);
    EXPECT_EQ(map->value.objects.size(), 1U);
    const Object& object = *map->value.objects.objects().begin();
    return map->value.classes.name(object_beliefs(object).classes.front().id);
  };
  EXPECT_EQ(best(), "cup") << "by the sum";
  job.combiner = learnt.output;
  EXPECT_THAT(to_string(run_mapping(job).error()),
              HasSubstr("stacking.rule: must be trained where a combiner is given"));
  job.mapper.objects.stacking.rule = StackingRule::kTrained;
  EXPECT_EQ(best(), "bowl");
  const auto made = load_archive(job.output);
  const ValueTree* by = made->value.provenance.back().options.find("combiner");
  ASSERT_NE(by, nullptr);
  EXPECT_THAT(by->text, testing::StartsWith("combiner.json xxh3-128:"));
  job.combiner.reset();
  EXPECT_THAT(to_string(run_mapping(job).error()), HasSubstr("needs a combiner (--combiner)"));
}

TEST(CombinerJob, WhatNoLabelExplainsTeachesNothing) {
  const TempDir folder;
  CombinerJob job = job_of_two(folder);
  std::string labels;
  for (int i = 0; i < kNumLabelled; ++i) {
    labels += test::block_seen_as(i,
                                  std::string("{\"label\": \"") +
                                      (i % 3 == 0   ? "cup"
                                       : i % 3 == 1 ? "bowl"
                                                    : "violin") +
                                      "\", \"score\": 1");
  }
  test::write_text(job.labels, labels);
  const auto report = train_combiner_job(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_unlabelled, 20U) << "no detector knows a violin";
  job.dataset.detections.clear();
  EXPECT_EQ(train_combiner_job(job).error().field, "detections");
}

}  // namespace
}  // namespace hypermap
