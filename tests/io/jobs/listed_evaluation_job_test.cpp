// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::string_view kListedRoom = "room";

/// The input's world is a camera's (y down, z forward); the map lies 1 m above and has z up.
MapFromInput map_from_camera_world() {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  isometry.translation().z() = 1.0;
  return MapFromInput(isometry);
}

/// A run of `input` that put the objects there; centres of boxes of 0.5 x 0.5 x 0.8 m in the map.
class ListedEvaluationTest : public ::testing::Test {
 protected:
  ListedEvaluationTest() {
    archive_.provenance.push_back(run_of(std::string(kListedRoom), map_from_camera_world()));
  }

  static Provenance run_of(const std::string& input, const MapFromInput& map_from_input) {
    return {.tool = "hypermap",
            .input = input,
            .input_hash = "xxh3-128:0",
            .map_from_input = map_from_input};
  }

  void add_object(const std::string& class_name, const Eigen::Vector3d& centre) {
    const ClassId id = archive_.classes.add(class_name).value();
    const auto number = static_cast<std::uint32_t>(layer_.objects().size() + 1);
    Object object;
    object.id = ObjectId{number};
    const Eigen::Vector3d half(0.25, 0.25, 0.4);
    object.box = {centre - half, centre + half};
    object.centroid_in_map = centre;
    object.belief.observe(std::vector<ClassEvidence>{{id, Probability(0.9)}}, Probability(0.5));
    objects_.push_back(std::move(object));
    const Eigen::Vector2d low = (centre - half).head<2>();
    const Eigen::Vector2d high = (centre + half).head<2>();
    const Polygon square =
        make_polygon(
            {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}})
            .value();
    EXPECT_TRUE(layer_.add({.id = number, .name = class_name, .parts = {square}}));
  }

  ListedEvaluationJob job_of(const std::string& instances) {
    EXPECT_TRUE(archive_.hypermap.add_layer({{.name = "semantic"}, layer_}));
    archive_.objects = ObjectMap::restore(objects_, ObjectId{100}).value();
    EXPECT_TRUE(save_archive(archive_, folder_ / "room.hmap"));
    test::write_text(folder_ / "room.yaml",
                     "format: hypermap-sequence-truth\nversion: 1\nsequence: room\nup: [0, -1, 0]\n"
                     "things:\n" +
                         instances);
    return {.map = folder_ / "room.hmap", .truth = folder_ / "room.yaml"};
  }

  test::TempDir folder_;
  MapArchive archive_;
  SemanticLayer layer_;
  std::vector<Object> objects_;
};

/// A chair whose centre lies at (x, 0.6, 2) of the input: (x, 2, 0.4) of the map.
std::string listed_chair(const std::string& name,
                         const std::string& x,
                         const std::string& more = "") {
  return "  - {name: " + name + ", class: chair, centre: [" + x +
         ", 0.6, 2], size: [0.5, 0.5, 0.8], first_frame: 0, marks: []" + more + "}\n";
}

TEST_F(ListedEvaluationTest, TheListLiesInTheMapAsItsSequenceDoes) {
  add_object("chair", {0.1, 2.0, 0.4});
  add_object("cup", {3.0, 2.0, 0.4});
  const auto outcome =
      run_listed_evaluation(job_of(listed_chair("here", "0") + listed_chair("gone", "5")));
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  EXPECT_TRUE(outcome->instances[0].box.centre().isApprox(Eigen::Vector3d(0.0, 2.0, 0.4)));
  EXPECT_TRUE(outcome->comparison.instances[0].is_right());
  EXPECT_EQ(outcome->object_ids.at(*outcome->comparison.instances[0].object), ObjectId{1});
  EXPECT_EQ(outcome->comparison.counts.counted, 2U);
  EXPECT_EQ(outcome->comparison.counts.right, 1U);
  EXPECT_THAT(outcome->comparison.false_objects, ElementsAre(1U));
  EXPECT_THAT(outcome->frames_named, IsEmpty());
  EXPECT_THAT(outcome->findings, IsEmpty());
}

TEST_F(ListedEvaluationTest, WordsThatTheMapDoesNotKnowDoNotCount) {
  add_object("chair", {0.0, 2.0, 0.4});
  const std::string vase =
      "  - {name: v, class: vase, centre: [0, 0.6, 5], size: [1, 1, 1], first_frame: 0, "
      "marks: []}\n";
  const auto outcome = run_listed_evaluation(job_of(
      vase + listed_chair("dark", "9", ", no_depth: true") +
      listed_chair("cut", "10", ", never_whole: true") + listed_chair("far", "11", ", far: true")));
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  EXPECT_EQ(outcome->instances[0].standing, InstanceStanding::kNoWord);
  EXPECT_EQ(outcome->instances[1].standing, InstanceStanding::kNoDepth);
  EXPECT_EQ(outcome->instances[2].standing, InstanceStanding::kNeverWhole);
  EXPECT_EQ(outcome->instances[3].standing, InstanceStanding::kFar);
  EXPECT_EQ(outcome->comparison.counts.counted, 0U);
}

TEST_F(ListedEvaluationTest, OfSeveralRunsTheNewestOfTheSequenceSaysWhere) {
  Eigen::Isometry3d shifted = map_from_camera_world().isometry();
  shifted.translation().x() = 7.0;
  archive_.provenance.push_back(run_of(std::string(kListedRoom), MapFromInput(shifted)));
  archive_.provenance.push_back(run_of("elsewhere", MapFromInput()));
  add_object("chair", {7.0, 2.0, 0.4});
  const auto outcome = run_listed_evaluation(job_of(listed_chair("here", "0")));
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  EXPECT_TRUE(outcome->comparison.instances[0].is_right());
}

TEST_F(ListedEvaluationTest, AMapOfAnotherNameIsAFindingAndOfSeveralAnError) {
  archive_.provenance[0].input = "kitchen";
  add_object("chair", {0.0, 2.0, 0.4});
  const auto outcome = run_listed_evaluation(job_of(listed_chair("here", "0")));
  ASSERT_TRUE(outcome) << to_string(outcome.error());
  ASSERT_THAT(outcome->findings, SizeIs(1));
  EXPECT_THAT(to_string(outcome->findings[0].error),
              HasSubstr("taken is the only one, of kitchen"));
}

TEST_F(ListedEvaluationTest, RunsOfOtherSequencesSayNothing) {
  archive_.provenance[0].input = "kitchen";
  archive_.provenance.push_back(run_of("hall", MapFromInput()));
  add_object("chair", {0.0, 2.0, 0.4});
  const auto refused = run_listed_evaluation(job_of(listed_chair("here", "0")));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("no run of the map is of the sequence room"));
}

TEST_F(ListedEvaluationTest, AMapWithoutProvenanceIsRefused) {
  archive_.provenance.clear();
  add_object("chair", {0.0, 2.0, 0.4});
  const auto refused = run_listed_evaluation(job_of(listed_chair("here", "0")));
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("it has no provenance"));
}

TEST_F(ListedEvaluationTest, ObjectsNeedBoxes) {
  const Polygon square = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).value();
  EXPECT_TRUE(layer_.add({.id = 9, .name = "chair", .parts = {square}}));
  const auto refused = run_listed_evaluation(job_of(listed_chair("here", "0")));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("object 9 must have a box"));
}

/// Frames of 40 x 30 pixels that look along z of the input, all 2 m deep, in layout 7-Scenes; those
/// of these numbers name a chair.
std::filesystem::path naming_sequence(const std::filesystem::path& folder,
                                      const std::vector<int>& naming_frames) {
  std::string detections;
  for (int i = 0; i < 5; ++i) {
    const std::string stem = "frame-" + test::padded(i, 6);
    test::write_text(folder / (stem + ".depth.pgm"), test::pgm16(2000, 40, 30));
    test::write_text(folder / (stem + ".pose.txt"), test::pose_rows(0));
  }
  for (const int i : naming_frames) {
    detections += "{\"image\": \"frame-" + test::padded(i, 6) +
                  ".color.png\", \"detections\": [{\"label\": \"chair\", \"score\": 0.9, "
                  "\"bbox\": [0, 0, 40, 30]}]}\n";
  }
  test::write_text(folder / "camera-intrinsics.txt", "40 0 19.5\n0 40 14.5\n0 0 1\n");
  if (!detections.empty()) test::write_text(folder / "detections.jsonl", detections);
  return folder;
}

TEST_F(ListedEvaluationTest, InstancesNamedInFewerThanThreeFramesAreRarelySeen) {
  // 0.8 m and twice the margin of 0.05 m are 18 pixels at a focal length of 40 and 2 m: 18 x 18.
  const std::string instance =
      "  - {name: c, class: chair, centre: [0, 0, 2], size: [0.8, 0.8, 0.8], first_frame: 0, "
      "marks: []}\n";
  add_object("chair", {0.0, 2.0, 1.0});
  ListedEvaluationJob job = job_of(instance);
  job.frames = NamingFrames{.input = naming_sequence(folder_ / "two", {1, 4})};
  const auto rare = run_listed_evaluation(job);
  ASSERT_TRUE(rare) << to_string(rare.error());
  EXPECT_THAT(rare->frames_named, ElementsAre(2U));
  EXPECT_EQ(rare->num_frames, 5U);
  EXPECT_EQ(rare->instances[0].standing, InstanceStanding::kRarelySeen);
  EXPECT_EQ(rare->comparison.counts.counted, 0U);
  job.frames = NamingFrames{.input = naming_sequence(folder_ / "three", {0, 1, 4})};
  const auto often = run_listed_evaluation(job);
  ASSERT_TRUE(often) << to_string(often.error());
  EXPECT_THAT(often->frames_named, ElementsAre(3U));
  EXPECT_EQ(often->comparison.counts.counted, 1U);
}

TEST_F(ListedEvaluationTest, FramesWithoutDetectionsNameNothing) {
  add_object("chair", {0.0, 2.0, 0.4});
  ListedEvaluationJob job = job_of(listed_chair("here", "0"));
  job.frames = NamingFrames{.input = naming_sequence(folder_ / "none", {})};
  const auto refused = run_listed_evaluation(job);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("must have detections"));
}

TEST_F(ListedEvaluationTest, CountingEndsWhenAsked) {
  add_object("chair", {0.0, 2.0, 0.4});
  ListedEvaluationJob job = job_of(listed_chair("here", "0"));
  job.frames = NamingFrames{.input = naming_sequence(folder_ / "some", {1})};
  job.stop = [] { return true; };
  const auto stopped = run_listed_evaluation(job);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

TEST_F(ListedEvaluationTest, BadTolerancesAreSaidFirst) {
  const auto refused =
      run_listed_evaluation({.map = "absent", .truth = "absent", .options = {.gate_m = -1.0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "gate_m");
}

}  // namespace
}  // namespace hypermap
