// SPDX-License-Identifier: BSD-3-Clause
// Detectors that come to a map, and come back to it.
#include "known_detectors.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/block_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr int kNumNamedFrames = 4;

/// Who speaks, and what it sees in every frame.
std::string words_of(const std::string& detector, const std::string& label) {
  std::string text = detector.empty() ? "" : "{\"detector\": " + detector + "}\n";
  for (int i = 0; i < kNumNamedFrames; ++i) {
    text += test::block_seen_as(i, "{\"label\": \"" + label + "\", \"score\": 0.9");
  }
  return text;
}

constexpr const char* kYolo =
    R"({"name": "yolo", "architecture": "YOLOX", "classes": ["chair", "sofa"]})";

/// A map of a dataset of four frames with detections by yolo.
MappingJob mapped_by_yolo(const TempDir& folder) {
  test::write_block_dataset(folder / "data", kNumNamedFrames);
  test::write_text(folder / "yolo.jsonl", words_of(kYolo, "chair"));
  MappingJob job{.input = folder / "data", .output = folder / "a.hmap"};
  job.dataset.detections = {folder / "yolo.jsonl"};
  job.dataset.max_frames = 2;
  job.up_axis = "z";
  job.mapper.num_threads = 1;
  const auto report = run_mapping(job);
  EXPECT_TRUE(report) << to_string(report.error());
  return job;
}

/// The same job for the rest of the frames.
MappingJob rest_of(MappingJob job, const fs::path& detections) {
  job.dataset.first = 2;
  job.dataset.detections = {detections};
  job.append = true;
  job.same_world = true;
  job.up_axis.reset();
  return job;
}

MapArchive map_with_detectors(const fs::path& path) {
  auto archive = load_archive(path);
  EXPECT_TRUE(archive) << to_string(archive.error());
  return archive ? std::move(archive->value) : MapArchive{};
}

TEST(KnownDetectors, AMapKeepsThemAndKnowsThemAgain) {
  const TempDir folder;
  const MappingJob job = mapped_by_yolo(folder);
  EXPECT_THAT(map_with_detectors(job.output).detectors.names(), ElementsAre("yolo"));
  test::write_text(folder / "again.jsonl", words_of(kYolo, "chair"));
  const auto report = run_mapping(rest_of(job, folder / "again.jsonl"));
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_THAT(map_with_detectors(job.output).detectors.names(), ElementsAre("yolo"));
}

TEST(KnownDetectors, AClashIsRefusedBeforeTheWork) {
  const TempDir folder;
  const MappingJob job = mapped_by_yolo(folder);
  const MapArchive before = map_with_detectors(job.output);
  test::write_text(folder / "other.jsonl",
                   words_of(R"({"name": "yolo", "classes": ["chair", "bed"]})", "bed"));
  const auto refused = run_mapping(rest_of(job, folder / "other.jsonl"));
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()),
              HasSubstr("\"yolo\" (2 classes) has other classes (\"bed\" among them) than the "
                        "detector \"yolo\" (YOLOX, 2 classes)"));
  EXPECT_EQ(map_with_detectors(job.output), before);
}

// [smap] 3.5.3: new classes extend the combined set; Eq. (3.18) rescales nothing that was learnt.
TEST(KnownDetectors, ClassesOfANewDetectorExtendAnOldMap) {
  const TempDir folder;
  const MappingJob job = mapped_by_yolo(folder);
  const MapArchive before = map_with_detectors(job.output);
  ASSERT_FALSE(before.objects.empty());
  test::write_text(folder / "ssd.jsonl",
                   words_of(R"({"name": "ssd", "classes": ["bed", "chair", "cup"]})", "bed"));
  // Other frames of another place: nothing that the map knows is seen.
  MappingJob more = rest_of(job, folder / "ssd.jsonl");
  more.same_world = false;
  more.placement = WorldPlacement{.x_m = 100.0};
  more.up_axis = "z";
  const auto report = run_mapping(more);
  ASSERT_TRUE(report) << to_string(report.error());
  const MapArchive after = map_with_detectors(job.output);
  EXPECT_THAT(after.detectors.names(), ElementsAre("yolo", "ssd"));
  EXPECT_THAT(after.classes.names(), ElementsAre("chair", "sofa", "bed", "cup"));
  for (const Object& object : before.objects.objects()) {
    ASSERT_TRUE(after.objects.contains(object.id));
    EXPECT_EQ(after.objects.at(object.id).belief, object.belief);
  }
  ASSERT_GT(after.objects.size(), before.objects.size());
  for (const Object& object : after.objects.objects()) {
    if (before.objects.contains(object.id)) continue;
    EXPECT_EQ(object.observation_log.state().first->detector, DetectorId{1});
    EXPECT_THAT(object.belief.entries(), SizeIs(3)) << "chair, bed and cup";
  }
}

// [smap] Eq. (3.16) in a run: "yolo" says chair with 0.9 of three classes, "ssd" bed with 0.9.
TEST(KnownDetectors, WeightsDecideBetweenThem) {
  const TempDir folder;
  test::write_block_dataset(folder / "data", kNumNamedFrames);
  test::write_text(folder / "yolo.jsonl",
                   words_of(R"({"name": "yolo", "classes": ["chair", "bed", "cup"]})", "chair"));
  test::write_text(folder / "ssd.jsonl",
                   words_of(R"({"name": "ssd", "classes": ["chair", "bed", "cup"]})", "bed"));
  MappingJob job{.input = folder / "data", .output = folder / "a.hmap"};
  job.dataset.detections = {folder / "yolo.jsonl", folder / "ssd.jsonl"};
  job.up_axis = "z";
  job.mapper.num_threads = 1;
  job.mapper.objects.stacking.rule = StackingRule::kWeighted;
  const auto best_with = [&](double yolo, double ssd) {
    job.mapper.objects.stacking.weights = {{"yolo", yolo}, {"ssd", ssd}};
    const auto report = run_mapping(job);
    EXPECT_TRUE(report) << to_string(report.error());
    EXPECT_TRUE(report->findings.empty());
    const MapArchive map = map_with_detectors(job.output);
    EXPECT_EQ(map.objects.size(), 1U);
    const auto best = object_beliefs(*map.objects.objects().begin()).classes.front().id;
    return map.classes.name(best);
  };
  EXPECT_EQ(best_with(2, 1), "chair");
  EXPECT_EQ(best_with(1, 2), "bed");
  job.mapper.objects.stacking.weights = {{"yollo", 2.0}};
  const auto report = run_mapping(job);
  ASSERT_TRUE(report);
  ASSERT_THAT(report->findings, SizeIs(1));
  EXPECT_THAT(
      to_string(report->findings[0].error),
      HasSubstr("stacking.weights: no detector is named \"yollo\", did you mean \"yolo\"?"));
}

TEST(KnownDetectors, RuleWeightedWithoutWeightsIsSaid) {
  const TempDir folder;
  test::write_block_dataset(folder / "data", kNumNamedFrames);
  test::write_text(folder / "yolo.jsonl",
                   words_of(R"({"name": "yolo", "classes": ["chair", "bed", "cup"]})", "chair"));
  MappingJob job{.input = folder / "data", .output = folder / "a.hmap"};
  job.dataset.detections = {folder / "yolo.jsonl"};
  job.up_axis = "z";
  job.mapper.num_threads = 1;
  job.mapper.objects.stacking.rule = StackingRule::kWeighted;
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_THAT(report->findings, SizeIs(1));
  EXPECT_EQ(to_string(report->findings[0].error),
            "stacking.weights: must name a detector where stacking.rule is weighted, names none: "
            "all weigh 1, as by rule sum (--weights NAME=WEIGHT)");
}

TEST(KnownDetectors, OfAMapFromBeforeTheyWereKeptTheIdsAreTaken) {
  const TempDir folder;
  const MappingJob job = mapped_by_yolo(folder);
  MapArchive old = map_with_detectors(job.output);
  old.detectors = {};
  ASSERT_TRUE(save_archive(old, job.output));
  ASSERT_TRUE(run_mapping(rest_of(job, folder / "yolo.jsonl")));
  EXPECT_THAT(map_with_detectors(job.output).detectors.names(),
              ElementsAre("unnamed detector 0", "yolo"));
}

TEST(KnownDetectors, IdsBeyondTheLimitAreNoReasonToWaitForever) {
  MapArchive map;
  ObservationLogEntry entry;
  entry.detector = DetectorId{0xFFFFFFFF};
  Object object;
  object.observation_log.add(entry);
  map.objects.add(object);
  EXPECT_EQ(known_detectors(map).error().code, ErrorCode::kLimit);
}

TEST(KnownDetectors, ANetworkIsCalledByItsFile) {
  const DetectorDescription coco = described_network("/x/yolox_nano.onnx", {}, NetworkForm::kYolox);
  EXPECT_EQ(coco.name, "yolox_nano");
  EXPECT_EQ(coco.architecture, "yolox");
  EXPECT_THAT(coco.classes, SizeIs(80));
  const DetectorDescription other =
      described_network("n.onnx", {.class_names = {"cup"}}, NetworkForm::kDetr);
  EXPECT_EQ(other.architecture, "detr");
  EXPECT_THAT(other.classes, ElementsAre("cup"));
}

}  // namespace
}  // namespace hypermap
