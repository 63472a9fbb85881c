// SPDX-License-Identifier: BSD-3-Clause
// What a simulation leaves on disk.
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::files_below;
using test::kSmall;
using test::room_scene;
using test::small_options;
using testing::HasSubstr;

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

TEST(SimulatedDataset, ADatasetIsReadAgainAsItWasSimulated) {
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

TEST(SimulatedDataset, AnyNumberOfThreadsGivesTheSameBytes) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.num_threads = 1;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "one"));
  options.num_threads = 3;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "three"));
  const auto one = files_below(dir / "one");
  EXPECT_EQ(one, files_below(dir / "three"));
  EXPECT_EQ(one.size(), 6U + 6U + 6U);  // images, depth, lists and truth
  options.seed = 2;
  ASSERT_TRUE(simulate(room_scene(), options, dir / "other"));
  EXPECT_NE(one.at("depth/000000.png"), files_below(dir / "other").at("depth/000000.png"));
  EXPECT_NE(one.at("truth.hmap"), files_below(dir / "other").at("truth.hmap"));
}

TEST(SimulatedDataset, EndsWhenItsProgressSaysSo) {
  const test::TempDir dir;
  const auto report =
      simulate(room_scene(), small_options(), dir / "out", [](std::size_t done, std::size_t) {
        return done < 3;
      });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInterrupted);
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(SimulatedDataset, AFailureLeavesNothing) {
  const test::TempDir dir;
  Scene scene = room_scene();
  scene.objects[0].shape = "piano";
  EXPECT_FALSE(simulate(scene, small_options(), dir / "out"));
  EXPECT_TRUE(fs::is_empty(dir.path()));
  // A truth that no archive can hold: found at the very end, with all images written.
  scene = room_scene();
  scene.objects[0].class_name = std::string(300, 'x');
  EXPECT_FALSE(simulate(scene, small_options(), dir / "out"));
  EXPECT_TRUE(fs::is_empty(dir.path()));
}

TEST(SimulatedDataset, OnlyEmptyFoldersAndOldSimulationsAreReplaced) {
  const test::TempDir dir;
  fs::create_directory(dir / "empty");
  SimulationOptions options = small_options();
  options.num_frames += 2;
  EXPECT_TRUE(simulate(room_scene(), options, dir / "empty"));
  EXPECT_TRUE(fs::exists(dir / "empty/rgb/000007.png"));
  EXPECT_TRUE(simulate(room_scene(), small_options(), dir / "empty"));
  EXPECT_FALSE(fs::exists(dir / "empty/rgb/000007.png"));
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

TEST(SimulatedDataset, WhatStrangersPutBelowAnOldSimulationIsNamedAndStays) {
  const test::TempDir dir;
  ASSERT_TRUE(simulate(room_scene(), small_options(), dir / "lab"));
  const auto before = files_below(dir / "lab");
  for (const std::string name : {"rgb/notes.txt", "depth/000999.png", "rgb/more/000000.png"}) {
    fs::create_directories((dir / "lab" / name).parent_path());
    std::ofstream(dir / "lab" / name) << "precious";
    const auto refused = simulate(room_scene(), small_options(), dir / "lab");
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(refused.error().what, HasSubstr(name.substr(0, name.rfind("/000000"))));
    EXPECT_TRUE(fs::exists(dir / "lab" / name));
    fs::remove(dir / "lab" / name);
    fs::remove(dir / "lab" / "rgb" / "more");
  }
  fs::rename(dir / "lab/rgb", dir / "photos");
  fs::create_symlink("../photos", dir / "lab/rgb");
  EXPECT_FALSE(simulate(room_scene(), small_options(), dir / "lab")) << "a link is no part of one";
  fs::remove(dir / "lab/rgb");
  fs::rename(dir / "photos", dir / "lab/rgb");
  EXPECT_EQ(files_below(dir / "lab"), before);
}

TEST(SimulatedDataset, AnOldFolderThatCannotBeLookedAtIsTheSystemsFault) {
  const test::TempDir dir;
  fs::create_directories(dir / "lab");
  fs::create_symlink("truth.hmap", dir / "lab/truth.hmap");  // leads to itself
  const auto refused = simulate(room_scene(), small_options(), dir / "lab");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  EXPECT_THAT(refused.error().what, HasSubstr("cannot be looked at"));
}

TEST(SimulatedDataset, WhatIsPutThereMeanwhileStays) {
  const test::TempDir dir;
  ASSERT_TRUE(simulate(room_scene(), small_options(), dir / "lab"));
  const auto refused =
      simulate(room_scene(), small_options(), dir / "lab", [&](std::size_t, std::size_t) {
        std::ofstream(dir / "lab/rgb/notes.txt") << "precious";
        return true;
      });
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("rgb/notes.txt"));
  EXPECT_TRUE(fs::exists(dir / "lab/rgb/notes.txt"));
}

TEST(SimulatedDataset, ALinkIsFollowedAndStays) {
  const test::TempDir dir;
  fs::create_directory(dir / "disk");
  fs::create_symlink("disk", dir / "lab");
  ASSERT_TRUE(simulate(room_scene(), small_options(), dir / "lab"));
  ASSERT_TRUE(simulate(room_scene(), small_options(), dir / "lab" / ""));  // the old one replaced
  EXPECT_TRUE(fs::is_symlink(dir / "lab"));
  EXPECT_TRUE(fs::is_regular_file(dir / "disk/truth.hmap"));
}

}  // namespace
}  // namespace hypermap
