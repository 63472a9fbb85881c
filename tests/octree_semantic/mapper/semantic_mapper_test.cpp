// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include "octree_semantic/support/detected_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

const std::vector<RgbdFrame>& frames() {
  static const std::vector<RgbdFrame> kFrames = test::detected_room_frames(12, 160);
  return kFrames;
}

SemanticMapper mapper_with(const DeadlineOptions& deadline = {},
                           int num_threads = 1,
                           int publish_every_n_frames = 0) {
  SemanticMapperOptions options;
  options.deadline = deadline;
  options.num_threads = num_threads;
  options.publish_every_n_frames = publish_every_n_frames;
  return SemanticMapper::create(options).value();
}

TEST(SemanticMapper, AllRangesFollowTheMapsUnlessSetApart) {
  SemanticMapperOptions options{.integration = {.max_range_m = 3.0}};
  options.visibility.max_range_m = 4.0;
  const auto mapper = SemanticMapper::create(options);
  ASSERT_TRUE(mapper) << to_string(mapper.error());
  EXPECT_EQ(mapper->options().visibility.max_range_m, 4.0);
  EXPECT_EQ(mapper->options().objects.segmentation.max_range_m, 3.0);
  EXPECT_EQ(mapper->options().objects.binned_depth.max_range_m, 3.0);
  EXPECT_EQ(with_ranges({.integration = {.max_range_m = 200.0}}).objects.segmentation.max_range_m,
            kMaxSegmentedRangeM);
  EXPECT_EQ(with_ranges({}), with_ranges({.visibility = {.max_range_m = kDefaultMaxRangeM}}));
}

TEST(SemanticMapper, ARangeThatFollowsIsCheckedAsIfItWereSet) {
  SemanticMapperOptions options;
  options.objects.segmentation.min_range_m = 6.0;
  EXPECT_EQ(validate(options).error().field, "segmentation.max_range_m");
  options.integration.max_range_m = 7.0;
  EXPECT_TRUE(validate(options));
}

/// As they are, each detection with an embedding of its class and its place in the list.
std::vector<RgbdFrame> frames_with_embeddings() {
  std::vector<RgbdFrame> out(frames().begin(), frames().begin() + 4);
  for (RgbdFrame& frame : out) {
    float place = 0.0F;
    for (Detection& detection : frame.detections) {
      const auto id = static_cast<float>(best_class(detection.class_scores)->id.value);
      detection.embeddings = {{"clip", {1.0F, id, place++}}};
    }
  }
  return out;
}

TEST(SemanticMapper, EmbeddingsReachTheObjectsAtAnyNumberOfThreads) {
  SemanticMapper one = mapper_with();
  SemanticMapper four = mapper_with({}, 4);
  for (const RgbdFrame& frame : frames_with_embeddings()) {
    ASSERT_TRUE(one.integrate(frame));
    ASSERT_TRUE(four.integrate(frame));
  }
  ASSERT_FALSE(one.objects().empty());
  EXPECT_EQ(one.objects(), four.objects());
  for (const Object& object : one.objects().objects()) {
    ASSERT_NE(object.embeddings.find("clip"), nullptr);
    EXPECT_EQ(object.embeddings.find("clip")->count, object.num_observations);
  }
}

TEST(SemanticMapper, AnEmbeddingOfAnotherDimensionIsRefusedWithItsFrame) {
  SemanticMapper mapper = mapper_with();
  std::vector<RgbdFrame> given = frames_with_embeddings();
  ASSERT_TRUE(mapper.integrate(given[0]));
  const ObjectMap before = mapper.objects();
  given[1].detections[0].embeddings[0].vector.push_back(1.0F);
  const auto refused = mapper.integrate(given[1]);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()),
            "detections[0].embeddings: of model \"clip\" must have 3 numbers as before, has 4");
  EXPECT_EQ(mapper.objects(), before);
  // A resumed mapper knows it from the objects.
  SemanticMapper resumed = SemanticMapper::resume({}, mapper.octree(), mapper.objects()).value();
  EXPECT_FALSE(resumed.integrate(given[1]));
  EXPECT_TRUE(resumed.integrate(given[2]));
}

TEST(SemanticMapper, TellsWhichObjectsAFrameShowed) {
  SemanticMapper mapper = mapper_with();
  const FrameReport report = mapper.integrate(frames()[0]).value();
  ASSERT_FALSE(report.detected.empty());
  EXPECT_LE(report.detected.size(), report.num_segments);
  for (const DetectedObject& one : report.detected) {
    EXPECT_TRUE(mapper.objects().contains(one.id));
    EXPECT_GT(one.num_pixels, 0U);
    EXPECT_LE(static_cast<double>(one.num_pixels), one.box_px.width_px() * one.box_px.height_px());
    const auto is_its_own = [&](const Detection& detection) {
      return detection.box_px == one.box_px && detection.score == one.score;
    };
    EXPECT_TRUE(std::ranges::any_of(frames()[0].detections, is_its_own));
  }
}

TEST(SemanticMapper, AnyNumberOfThreadsGivesTheSameMap) {
  SemanticMapper one = mapper_with();
  SemanticMapper four = mapper_with({}, 4);
  for (const RgbdFrame& frame : frames()) {
    const FrameReport report = one.integrate(frame).value();
    EXPECT_EQ(report.num_segments, four.integrate(frame)->num_segments);
    EXPECT_EQ(report.num_deadline_dropped, 0U);
    EXPECT_TRUE(report.visibility_evaluated);
  }
  EXPECT_TRUE(one.octree() == four.octree());
  EXPECT_TRUE(one.objects() == four.objects());
  EXPECT_GE(one.objects().size(), 8U);
}

TEST(SemanticMapper, WithoutADeadlineNoClockMatters) {
  SemanticMapper usual = mapper_with();
  SemanticMapper slow = mapper_with();
  slow.set_clock([now = 0.0]() mutable { return now += 1000.0; });
  for (const RgbdFrame& frame : frames()) {
    ASSERT_TRUE(usual.integrate(frame));
    ASSERT_TRUE(slow.integrate(frame));
  }
  EXPECT_TRUE(usual.octree() == slow.octree());
  EXPECT_TRUE(usual.objects() == slow.objects());
}

/// A clock that is one second later each time it is asked: when the frame starts, when its depth is
/// smooth, and once before each detection.
Clock ticking() {
  return [now = 0.0]() mutable { return now += 1.0; };
}

TEST(SemanticMapper, ADeadlineDropsTheLeastSureDetections) {
  const RgbdFrame& frame = *std::max_element(
      frames().begin(), frames().end(), [](const RgbdFrame& a, const RgbdFrame& b) {
        return a.detections.size() < b.detections.size();
      });
  ASSERT_GE(frame.detections.size(), 4U);
  SemanticMapper all = mapper_with();
  SemanticMapper hurried = mapper_with({.rule = DeadlineRule::kFixed, .frame_s = 3.5});
  hurried.set_clock(ticking());
  const FrameReport report = hurried.integrate(frame).value();
  // Asked 2 and 3 s after the start, which is in time; after 4 s it is not.
  EXPECT_EQ(report.num_deadline_dropped, frame.detections.size() - 2);
  EXPECT_EQ(report.num_detections, frame.detections.size());
  EXPECT_FALSE(report.visibility_evaluated) << "not to be seen means nothing now";

  RgbdFrame surest = frame;
  surest.detections.resize(2);  // their scores fall
  ASSERT_TRUE(all.integrate(surest));
  ASSERT_EQ(hurried.objects().size(), all.objects().size());
  EXPECT_EQ(report.integration.num_hits, all.integrate(surest)->integration.num_hits)
      << "the depth is used whole";
}

TEST(SemanticMapper, ADeadlineLeavesObjectsThatNobodyLookedFor) {
  SemanticMapper mapper = mapper_with({.rule = DeadlineRule::kFixed, .frame_s = 1e3});
  for (const RgbdFrame& frame : frames()) ASSERT_TRUE(mapper.integrate(frame));
  const ObjectMap before = mapper.objects();
  mapper.set_clock([now = 0.0]() mutable { return now += 1e6; });  // always too late
  for (const RgbdFrame& frame : frames()) {
    EXPECT_EQ(mapper.integrate(frame)->num_deadline_dropped, frame.detections.size());
  }
  EXPECT_TRUE(mapper.objects() == before);
}

TEST(SemanticMapper, AFrameThatNoDetectorLookedAtBringsItsSurfacesAndMissesNoObject) {
  SemanticMapper looked = mapper_with();
  for (const RgbdFrame& frame : frames()) ASSERT_TRUE(looked.integrate(frame));
  SemanticMapper not_looked =
      SemanticMapper::resume(looked.options(), looked.octree(), looked.objects()).value();
  const ObjectMap before = looked.objects();
  for (RgbdFrame frame : frames()) {
    frame.detections.clear();
    const FrameReport missed = looked.integrate(frame).value();
    const FrameReport report = not_looked.integrate(frame, DetectorLook::kNotLooked).value();
    EXPECT_TRUE(missed.visibility_evaluated);
    EXPECT_FALSE(report.visibility_evaluated);
    EXPECT_EQ(report.integration.num_hits, missed.integration.num_hits);
    EXPECT_GT(report.integration.num_hits, 0U);
  }
  EXPECT_TRUE(not_looked.objects() == before);
  EXPECT_FALSE(looked.objects() == before) << "none was detected, which speaks against them";
}

TEST(SemanticMapper, MemoryIsFlatWhileOneRoomIsSeenAgainAndAgain) {
  SemanticMapper mapper = mapper_with();
  std::uint64_t num_seen = 0;
  const auto see = [&](int num_rounds) {
    for (int round = 0; round < num_rounds; ++round) {
      for (RgbdFrame frame : frames()) {
        frame.index = num_seen++;
        ASSERT_TRUE(mapper.integrate(frame));
      }
    }
  };
  see(test::repetitions(10));
  const std::size_t octree_bytes = mapper.octree().memory_bytes();
  const std::size_t num_objects = mapper.objects().size();
  see(test::repetitions(32));  // 504 frames in all, without a sanitizer
  EXPECT_LE(mapper.octree().memory_bytes(), octree_bytes + octree_bytes / 50);
  EXPECT_LE(mapper.objects().size(), num_objects + 2);
  for (const Object& object : mapper.objects().objects()) {
    EXPECT_LE(object.observation_log.state().newest.size(), ObservationLog::kMaxNewest);
    EXPECT_LE(object.observation_log.state().summaries.size(), ObservationLog::kMaxSummaries);
    EXPECT_LE(object.points.state().votes.size(), object.points.options().max_cells);
    EXPECT_LE(object.shapes.state().shapes.size(), ShapeEvidence::kMaxShapes);
  }
}

}  // namespace
}  // namespace hypermap
