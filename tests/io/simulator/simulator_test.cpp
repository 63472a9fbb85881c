// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulator.hpp"

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulation_truth.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr PinholeCamera kSmall{160, 120, 131.25, 131.25, 79.5, 59.5};

/// A table with a cup and a monitor, a chair, and a bin that no detector can name.
Scene room_scene() {
  Scene scene;
  scene.name = "room";
  scene.floor.outer = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};
  scene.objects = {
      {.name = "desk", .class_name = "table", .shape = "table", .position_m = {3.5, 2.0}},
      {.name = "screen", .class_name = "tvmonitor", .shape = "monitor", .on = "desk"},
      {.name = "chair", .class_name = "chair", .shape = "chair", .position_m = {2.4, 1.2}},
      {.name = "bin", .class_name = "bin", .shape = "bin", .position_m = {4.5, 0.5}},
      {.name = "mug", .class_name = "cup", .shape = "cup", .position_m = {0.3, 3.8}}};
  scene.waypoints = {{{0.5, 1.0, 1.4}, {3.5, 2.0, 0.6}}, {{0.8, 3.0, 1.4}, {3.5, 1.8, 0.6}}};
  return scene;
}

SimulationOptions small_options() {
  SimulationOptions options;
  options.num_frames = 6;
  options.camera = kSmall;
  options.detector.min_visible_px = 20;
  return options;
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[fs::relative(entry.path(), folder).string()] = bytes.str();
  }
  return files;
}

/// Same boxes, scores, masks, and the same probability for each class by name.
void expect_same(const std::vector<Detection>& a,
                 const ClassRegistry& classes_a,
                 const std::vector<Detection>& b,
                 const ClassRegistry& classes_b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].box_px, b[i].box_px);
    EXPECT_EQ(a[i].score, b[i].score);
    EXPECT_EQ(a[i].mask, b[i].mask);
    std::map<std::string, double> scores;
    for (const ClassEvidence& evidence : a[i].class_scores)
      scores[classes_a.name(evidence.id)] = evidence.probability.value();
    ASSERT_EQ(scores.size(), b[i].class_scores.size());
    for (const ClassEvidence& evidence : b[i].class_scores)
      EXPECT_NEAR(scores.at(classes_b.name(evidence.id)), evidence.probability.value(), 1e-12);
  }
}

TEST(Simulator, AFrameIsWhatADatasetReaderWouldGive) {
  const auto simulator = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(simulator) << to_string(simulator.error());
  ASSERT_EQ(simulator->size(), 6U);
  const SimulatedFrame simulated = simulator->render(3);
  EXPECT_TRUE(validate(simulated.frame));
  EXPECT_EQ(simulated.frame.index, 3U);
  EXPECT_EQ(simulated.frame.name, "000003");
  EXPECT_TRUE(simulated.frame.map_from_camera.isometry().isApprox(simulated.true_pose.isometry()));
  EXPECT_GT(std::ranges::count_if(simulated.frame.depth_m.pixels(), [](float z) { return z > 0; }),
            160 * 120 / 2);
  EXPECT_LT(simulator->render(2).frame.stamp, simulated.frame.stamp);
}

TEST(Simulator, UnprojectedDepthLiesOnTheThingsItShows) {
  SimulationOptions options = small_options();
  options.sensor = {.noise_base_m = 0.0, .noise_per_m2 = 0.0, .dropout = 0.0};
  const auto simulator = Simulator::create(room_scene(), options);
  ASSERT_TRUE(simulator);
  const SimulatedFrame simulated = simulator->render(0);
  int checked = 0;
  for (int v = 0; v < kSmall.height_px; ++v) {
    for (int u = 0; u < kSmall.width_px; ++u) {
      const ObjectId id = simulated.instances.at(u, v);
      const double depth = static_cast<double>(simulated.frame.depth_m.at(u, v));
      if (id == kNoObject || depth == 0.0) continue;
      const Eigen::Vector3d point = (simulated.true_pose * kSmall.unproject(u, v, depth)).xyz;
      Box box = simulator->objects()[id.value - 1].box;
      box.min_in_map.array() -= 0.002;  // depth comes in steps of 1 mm
      box.max_in_map.array() += 0.002;
      EXPECT_TRUE(box.contains(point)) << id.value << " at " << u << " " << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Simulator, FramesDoNotDependOnWhatWasRenderedBefore) {
  const auto a = Simulator::create(room_scene(), small_options());
  const auto b = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(a && b);
  (void)a->render(0);
  EXPECT_EQ(a->render(4).frame.depth_m, b->render(4).frame.depth_m);
  EXPECT_EQ(a->render(4).frame.detections, b->render(4).frame.detections);
}

TEST(Simulator, PoseNoiseDriftsInThePlaneAndStartsAtTheTruth) {
  SimulationOptions options = small_options();
  options.pose_noise = 2.0;
  const auto simulator = Simulator::create(room_scene(), options);
  ASSERT_TRUE(simulator);
  const SimulatedFrame first = simulator->render(0);
  EXPECT_TRUE(first.frame.map_from_camera.isometry().isApprox(first.true_pose.isometry()));
  const SimulatedFrame last = simulator->render(5);
  const Eigen::Vector3d drift =
      last.frame.map_from_camera.origin().xyz - last.true_pose.origin().xyz;
  EXPECT_GT(drift.norm(), 1e-4);
  EXPECT_LT(drift.norm(), 0.3);
  EXPECT_EQ(drift.z(), 0.0);
  // The recorded gaze keeps its pitch.
  EXPECT_NEAR(last.frame.map_from_camera.isometry().linear()(2, 2),
              last.true_pose.isometry().linear()(2, 2),
              1e-12);
}

TEST(Simulator, ADatasetIsReadAgainAsItWasSimulated) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.detector.masks = true;
  const Scene scene = room_scene();
  std::vector<std::size_t> progress;
  const auto report = simulate(scene, options, dir / "out", [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 6U);
    progress.push_back(done);
    return true;
  });
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 6U);
  EXPECT_THAT(progress, testing::ElementsAre(1, 2, 3, 4, 5, 6));

  ClassRegistry classes;
  const auto reader = open_dataset(dir / "out", {}, classes);
  ASSERT_TRUE(reader) << to_string(reader.error());
  EXPECT_EQ((*reader)->summary().layout, "tum");
  EXPECT_EQ((*reader)->camera(), kSmall);
  const auto simulator = Simulator::create(scene, options);
  ASSERT_TRUE(simulator);
  ASSERT_EQ((*reader)->size(), simulator->size());
  std::size_t num_detections = 0;
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const auto read = (*reader)->read(i);
    ASSERT_TRUE(read) << to_string(read.error());
    const RgbdFrame expected = simulator->render(i).frame;
    EXPECT_EQ(read->stamp, expected.stamp);
    EXPECT_EQ(read->color, expected.color);
    EXPECT_TRUE(
        read->map_from_camera.isometry().isApprox(expected.map_from_camera.isometry(), 1e-12));
    for (std::size_t k = 0; k < expected.depth_m.size(); ++k)
      ASSERT_NEAR(read->depth_m.pixels()[k], expected.depth_m.pixels()[k], 1e-6F);
    expect_same(read->detections, classes, expected.detections, simulator->classes());
    num_detections += expected.detections.size();
  }
  EXPECT_EQ(report->num_detections, num_detections);
  EXPECT_GT(num_detections, 0U);
}

TEST(Simulator, AnyNumberOfThreadsGivesTheSameBytes) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.num_threads = 1;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "one"));
  options.num_threads = 3;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "three"));
  const auto one = contents(dir / "one");
  EXPECT_EQ(one, contents(dir / "three"));
  EXPECT_EQ(one.size(), 6U + 6U + 6U);  // pictures, depth, lists and truth
  options.seed = 2;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "other"));
  EXPECT_NE(one.at("depth/000000.png"), contents(dir / "other").at("depth/000000.png"));
  EXPECT_NE(one.at("truth.hmap"), contents(dir / "other").at("truth.hmap"));
}

TEST(Simulator, ThingsThatDoNotCountSayWhy) {
  const test::TempDir dir;
  const auto report = simulate(room_scene(), small_options(), dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  const auto reason = [&](std::size_t i) { return report->objects.at(i).excluded_because; };
  EXPECT_THAT(reason(0), HasSubstr("no word"));                      // table
  EXPECT_EQ(reason(1), "");                                          // tvmonitor
  EXPECT_EQ(reason(2), "");                                          // chair
  EXPECT_THAT(reason(3), HasSubstr("no word"));                      // bin
  EXPECT_THAT(reason(4), HasSubstr("200 depth pixels, at most 0"));  // behind the camera
  EXPECT_GT(report->objects[2].most_depth_pixels, 200);
  EXPECT_GT(report->objects[2].num_frames_visible, 0U);
}

TEST(Simulator, TheTruthLoadsWithoutAFindingAndSaysTheSame) {
  const test::TempDir dir;
  const auto report = simulate(room_scene(), small_options(), dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  const auto loaded = load_archive(dir / "out/truth.hmap");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  for (const Finding& finding : loaded->findings) ADD_FAILURE() << to_string(finding.error);
  const auto simulator = Simulator::create(room_scene(), small_options());
  ASSERT_TRUE(simulator);
  const auto expected = make_truth(*simulator, room_scene(), report->objects);
  ASSERT_TRUE(expected);
  EXPECT_EQ(loaded->value.objects, expected->objects);
  EXPECT_EQ(loaded->value.classes, expected->classes);
  const auto layer = loaded->value.hypermap.at("semantic");
  ASSERT_TRUE(layer);
  const auto things = evaluated_objects(*(*layer)->content.as<SemanticLayer>());
  ASSERT_EQ(things.size(), 5U);
  EXPECT_TRUE(things[0].excluded);   // table
  EXPECT_FALSE(things[2].excluded);  // chair
  EXPECT_NEAR(things[2].size_m, 0.86, 1e-5);
  const EvaluationReport perfect = evaluate(things, things);
  EXPECT_EQ(perfect.all.one_to_one.f1, 1.0);
  EXPECT_NEAR(*perfect.all.one_to_one.jaccard_in_place, 1.0, 1e-9);
}

TEST(Simulator, EndsWhenItsProgressSaysSo) {
  const test::TempDir dir;
  const auto report =
      simulate(room_scene(), small_options(), dir / "out", [](std::size_t done, std::size_t) {
        return done < 3;
      });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInterrupted);
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(Simulator, AFailureLeavesNothing) {
  const test::TempDir dir;
  Scene scene = room_scene();
  scene.objects[0].shape = "piano";
  EXPECT_FALSE(simulate(scene, small_options(), dir / "out"));
  EXPECT_TRUE(fs::is_empty(dir.path()));
  // A truth that no archive can hold: found at the very end, with all pictures written.
  scene = room_scene();
  scene.objects[0].class_name = std::string(300, 'x');
  EXPECT_FALSE(simulate(scene, small_options(), dir / "out"));
  EXPECT_TRUE(fs::is_empty(dir.path()));
}

TEST(Simulator, OnlyEmptyFoldersAndOldSimulationsAreReplaced) {
  const test::TempDir dir;
  fs::create_directory(dir / "empty");
  EXPECT_TRUE(simulate(room_scene(), small_options(), dir / "empty"));
  std::ofstream(dir / "empty/rgb/stale.jpg") << "old";
  EXPECT_TRUE(simulate(room_scene(), small_options(), dir / "empty"));
  EXPECT_FALSE(fs::exists(dir / "empty/rgb/stale.jpg"));
  std::ofstream(dir / "empty/map.hmap") << "what somebody made of it";
  const auto kept = simulate(room_scene(), small_options(), dir / "empty");
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(kept.error().what, HasSubstr("map.hmap"));
  EXPECT_TRUE(fs::exists(dir / "empty/map.hmap"));
  fs::create_directory(dir / "photos");
  std::ofstream(dir / "photos/holiday.jpg") << "precious";
  const auto refused = simulate(room_scene(), small_options(), dir / "photos");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(fs::exists(dir / "photos/holiday.jpg"));
  EXPECT_EQ(std::distance(fs::directory_iterator(dir.path()), fs::directory_iterator()), 2);
}

TEST(Simulator, BadOptionsNameTheirField) {
  const auto field = [](auto change) {
    SimulationOptions options = small_options();
    change(options);
    const auto simulator = Simulator::create(room_scene(), options);
    return simulator ? std::string() : simulator.error().field;
  };
  EXPECT_EQ(field([](auto& o) { o.num_frames = 0; }), "num_frames");
  EXPECT_EQ(field([](auto& o) { o.pose_noise = std::nan(""); }), "pose_noise");
  EXPECT_EQ(field([](auto& o) { o.num_threads = -1; }), "num_threads");
  EXPECT_EQ(field([](auto& o) { o.sensor.dropout = 2.0; }), "sensor.dropout");
  EXPECT_EQ(field([](auto& o) { o.detector.miss_rate = 2.0; }), "detector.miss_rate");
  EXPECT_NE(field([](auto& o) { o.camera.fx_px = 0.0; }), "");
  EXPECT_EQ(field([](auto& o) { o.num_frames = 1; }), "");
}

/// The camera's way shows every nameable thing of the laboratory well enough to count.
TEST(Simulator, TheLaboratoryShowsAllThatItHolds) {
  const auto scene = load_scene(test::source_path("data/scenes/laboratory.yaml"));
  ASSERT_TRUE(scene) << to_string(scene.error());
  SimulationOptions options;
  options.num_frames = 40;
  // A picture of a sixteenth of the pixels where a sanitizer makes rays dear.
  if (test::kSanitized) options.camera = kSmall;
  const int enough_px = test::kSanitized ? 200 / 16 : 200;
  const auto simulator = Simulator::create(*scene, options);
  ASSERT_TRUE(simulator);
  std::vector<int> best(simulator->objects().size(), 0);
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const SimulatedFrame simulated = simulator->render(i);
    std::ranges::transform(
        best, simulated.depth_pixels, best.begin(), [](int a, int b) { return std::max(a, b); });
  }
  for (std::size_t i = 0; i < best.size(); ++i)
    EXPECT_GE(best[i], enough_px) << simulator->objects()[i].name;
}

}  // namespace
}  // namespace hypermap
