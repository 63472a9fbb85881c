// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/map_many_job.hpp"

#include "hypermap/io/jobs/merge_job.hpp"
#include "rooms.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kNumRooms = 5;

class ManyRooms : public testing::Test {
 protected:
  void SetUp() override { rooms_ = test::write_rooms(folder_.path(), kNumRooms); }
  [[nodiscard]] std::filesystem::path room(std::size_t index) const { return rooms_[index].input; }
  [[nodiscard]] MapManyJob job_to(const std::string& output) const {
    return test::job_of_rooms(rooms_, folder_ / output);
  }
  /// What was said of the parts.
  static std::vector<std::string> notes(const MapManyReport& report) {
    std::vector<std::string> notes;
    for (const MappedSequence& sequence : report.sequences) notes.push_back(sequence.note);
    return notes;
  }
  static MapManyReport run(const MapManyJob& job, std::size_t num_workers = 1) {
    ThreadCrew crew(num_workers);
    auto report = run_map_many(job, crew);
    EXPECT_TRUE(report) << to_string(report.error());
    return report ? *std::move(report) : MapManyReport{};
  }

  test::TempDir folder_;
  std::vector<ListedSequence> rooms_;
};

TEST_F(ManyRooms, AreTheSameBytesByAnyNumberOfWorkers) {
  const MapManyReport report = run(job_to("one"));
  EXPECT_EQ(report.num_merges, kNumRooms - 1);
  ASSERT_TRUE(report.merged);
  EXPECT_EQ(report.merged->frames, 2 * kNumRooms);
  EXPECT_EQ(report.merged->sessions, kNumRooms);
  const std::string bytes = test::bytes_of(folder_ / "one.hmap");
  ASSERT_FALSE(bytes.empty());
  for (const std::size_t num_workers : {2U, 3U, 8U}) {
    const std::string name = std::to_string(num_workers);
    run(job_to(name), num_workers);
    EXPECT_EQ(test::bytes_of(folder_ / (name + ".hmap")), bytes);
  }
}

TEST_F(ManyRooms, HaveTheVoxelsOfAMergeOfAllAtOnce) {
  const MapManyJob job = job_to("tree");
  const MapManyReport report = run(job, 2);
  MergeJob merge{.files = {},
                 .options = {.mapper = job.mapping.mapper, .layers = job.mapping.layers}};
  for (const MappedSequence& sequence : report.sequences) {
    merge.files.push_back({.path = sequence.part});
  }
  const auto fold = run_merge(merge);
  ASSERT_TRUE(fold) << to_string(fold.error());
  const auto tree = load_archive(job.output);
  ASSERT_TRUE(tree) << to_string(tree.error());
  std::size_t num_compared = 0;
  ASSERT_EQ(tree->value.octree->num_leaves(), fold->map.octree->num_leaves());
  tree->value.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const auto other = fold->map.octree->stored_at(leaf.key);
    ASSERT_TRUE(other);
    EXPECT_EQ(leaf.log_odds, other->log_odds);
    ++num_compared;
  });
  EXPECT_GT(num_compared, 1000U);
}

TEST_F(ManyRooms, StandWhenAllIsAsItWas) {
  const MapManyJob job = job_to("map");
  EXPECT_THAT(notes(run(job)), ElementsAre("made", "made", "made", "made", "made"));
  const auto written = fs::last_write_time(job.output);
  const MapManyReport again = run(job, 2);
  EXPECT_THAT(notes(again), ElementsAre("kept", "kept", "kept", "kept", "kept"));
  EXPECT_EQ(again.num_merges, 0U);
  EXPECT_EQ(fs::last_write_time(job.output), written);
  EXPECT_EQ(again.merged->objects, run(job).merged->objects);
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(job.parts / "merging")) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }();
  EXPECT_THAT(files, ElementsAre("0-5.yaml"));
}

TEST_F(ManyRooms, ThatChangedAreMadeAnewAndNoOthers) {
  const MapManyJob job = job_to("map");
  run(job);
  const std::string before = test::bytes_of(job.output);
  std::fstream(room(1) / "depth/100.pgm", std::ios::in | std::ios::out | std::ios::binary)
      .seekp(-1, std::ios::end)
      .put('\1');
  std::ofstream(job.parts / "room3.hmap", std::ios::app | std::ios::binary) << "tampered";
  const MapManyReport report = run(job);
  EXPECT_THAT(notes(report),
              ElementsAre("kept",
                          "made anew: was made of other data",
                          "kept",
                          "made anew: is not as it was made",
                          "kept"));
  EXPECT_EQ(report.num_merges, kNumRooms - 1);
  EXPECT_NE(test::bytes_of(job.output), before);
  fs::remove_all(room(1));
  test::write_room(room(1), 1);
  run(job);
  EXPECT_EQ(test::bytes_of(job.output), before);
}

TEST_F(ManyRooms, AreMadeAnewWithOtherOptionsOrByForce) {
  MapManyJob job = job_to("map");
  run(job);
  job.mapping.mapper.num_threads = 2;
  EXPECT_THAT(notes(run(job)), testing::Each("kept")) << "threads change no map";
  job.force = true;
  EXPECT_THAT(notes(run(job)), testing::Each("made"));
  job.force = false;
  job.mapping.mapper.octree.resolution_m = 0.1;
  EXPECT_THAT(notes(run(job)), testing::Each("made anew: was made with other options"));
}

TEST_F(ManyRooms, OfWhichOneFailsAreNotMergedAndGoOnLater) {
  const MapManyJob job = job_to("map");
  fs::rename(room(2) / "depth.txt", room(2) / "away");
  const MapManyReport report = run(job, 2);
  EXPECT_FALSE(report.merged);
  ASSERT_TRUE(report.sequences[2].error);
  EXPECT_THAT(to_string(*report.sequences[2].error), HasSubstr("room2"));
  EXPECT_FALSE(fs::exists(job.output));
  EXPECT_TRUE(fs::exists(job.parts / "room4.hmap"));
  fs::rename(room(2) / "away", room(2) / "depth.txt");
  const MapManyReport again = run(job);
  EXPECT_THAT(notes(again), ElementsAre("kept", "kept", "made", "kept", "kept"));
  EXPECT_TRUE(again.merged);
}

TEST_F(ManyRooms, GoOnFromWhatAnInterruptedRunHadMade) {
  const MapManyJob job = job_to("map");
  run(job_to("undisturbed"));
  for (std::size_t last = 1; last < 2 * kNumRooms - 1; ++last) {
    ThreadCrew crew(1);
    const auto ended =
        run_map_many(job, crew, [&](std::size_t done, std::size_t) { return done < last; });
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::kInterrupted);
    EXPECT_FALSE(fs::exists(job.output));
  }
  const MapManyReport report = run(job);
  EXPECT_THAT(notes(report), testing::Each("kept"));
  EXPECT_LT(report.num_merges, kNumRooms - 1);
  EXPECT_EQ(test::bytes_of(job.output), test::bytes_of(folder_ / "undisturbed.hmap"));
}

TEST_F(ManyRooms, LeaveNothingButTheWholeWhenPartsGo) {
  MapManyJob job = job_to("map");
  job.keeps_parts = false;
  run(job, 2);
  EXPECT_TRUE(fs::exists(job.output));
  EXPECT_FALSE(fs::exists(job.parts));
  fs::create_directory(job.parts);
  test::write_text(job.parts / "letter.txt", "dear");
  const MapManyReport report = run(job);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(test::bytes_of(job.parts / "letter.txt"), "dear");
}

TEST_F(ManyRooms, LieWhereTheListPlacesThem) {
  MapManyJob job = job_to("map");
  job.sequences.resize(3);
  run(job);
  const auto together = load_archive(job.output).value().value.octree->num_leaves();
  // 12.8 m: whole bricks of 5 cm voxels, where nothing of the others lies.
  job.sequences[1].placement = WorldPlacement{.x_m = 12.8};
  const MapManyReport moved = run(job);
  EXPECT_THAT(notes(moved), testing::Each("kept"));
  EXPECT_EQ(moved.num_merges, 2U);
  const auto apart = load_archive(job.output).value().value.octree->num_leaves();
  EXPECT_GT(apart.occupied, together.occupied);
}

TEST_F(ManyRooms, OfOneIsItsPart) {
  MapManyJob job = job_to("map");
  job.sequences.resize(1);
  const MapManyReport report = run(job);
  EXPECT_EQ(report.num_merges, 0U);
  EXPECT_EQ(test::bytes_of(job.output), test::bytes_of(job.parts / "room0.hmap"));
}

TEST_F(ManyRooms, OfNoneAreRefused) {
  MapManyJob job = job_to("map");
  job.sequences.clear();
  ThreadCrew crew(1);
  const auto refused = run_map_many(job, crew);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_FALSE(fs::exists(job.parts));
}

TEST_F(ManyRooms, WhoseFramesWouldCountTwiceAreRefused) {
  MapManyJob job = job_to("map");
  job.sequences.push_back({.name = "again", .input = room(0)});
  ThreadCrew crew(1);
  const auto refused = run_map_many(job, crew);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("whose frames would count twice"));
  EXPECT_FALSE(fs::exists(job.output));
}

}  // namespace
}  // namespace hypermap
