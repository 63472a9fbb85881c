// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/merge_job.hpp"

#include "core/objects/association_cases.hpp"
#include "hypermap/io/archive/map_sessions.hpp"
#include "hypermap/io/codec/jpeg_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

VoxelKey voxel_along_x(int x) {
  return {static_cast<std::uint16_t>(kOriginKey + x), kOriginKey, kOriginKey + 10};
}

/// A run of ten frames of input `name` that began at this second.
Provenance run_at(const std::string& name, int second) {
  return {.tool = "hypermap",
          .input = name,
          .input_hash = "hash of " + name,
          .map_from_input = {},
          .world = "hall",
          .next_frame_index = 10,
          .session = name,
          .first_stamp = Stamp{second * 1'000'000'000LL},
          .last_stamp = Stamp{(second + 1) * 1'000'000'000LL}};
}

/// Voxels along x from `first` on with these log-odds, of a run of that name.
MapArchive archive_of(const std::string& name,
                      int second,
                      const std::vector<int>& log_odds,
                      int first = 0) {
  std::vector<StoredLeaf> leaves;
  leaves.reserve(log_odds.size());
  for (const int l : log_odds) {
    leaves.push_back(
        {voxel_along_x(first + static_cast<int>(leaves.size())), static_cast<MilliLogOdds>(l)});
  }
  MapArchive archive{.hypermap = {}};
  archive.octree = SemanticOctree::from_leaves({.resolution_m = 0.1}, leaves).value();
  archive.provenance.push_back(run_at(name, second));
  return archive;
}

class MergedFiles : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder()); }
  void TearDown() override { std::filesystem::remove_all(folder()); }

  [[nodiscard]] static std::filesystem::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) / (std::string("merge_") + test->name());
  }
  /// Saves it under the name of its run.
  static MergedFile saved(const MapArchive& archive) {
    const auto path = folder() / (archive.provenance.front().input + ".hmap");
    const auto is_saved = save_archive(archive, path);
    EXPECT_TRUE(is_saved) << to_string(is_saved.error());
    return {.path = path};
  }
};

MilliLogOdds log_odds_of(const MapArchive& map, int x) {
  return map.octree->stored_at(voxel_along_x(x)).value().log_odds;
}

TEST_F(MergedFiles, GiveTheSameBytesInAnyOrder) {
  std::vector<MergedFile> files{saved(archive_of("a", 0, {847, -405, 442, 10})),
                                saved(archive_of("b", 0, {847, -405, -810, 20})),
                                saved(archive_of("c", 9, {-405, -405, 847}))};
  const auto whole = run_merge({.files = files});
  ASSERT_TRUE(whole) << to_string(whole.error());
  const auto written = write_archive(whole->map);
  ASSERT_TRUE(written) << to_string(written.error());
  const auto merged_bytes = [&] {
    return write_archive(run_merge({.files = files}).value().map).value();
  };
  const std::string& bytes = *written;
  const MapArchive& map = whole->map;
  EXPECT_EQ(log_odds_of(map, 0), 1289);
  EXPECT_EQ(log_odds_of(map, 1), -1215);
  EXPECT_EQ(log_odds_of(map, 2), 479);
  EXPECT_EQ(log_odds_of(map, 3), 30);
  std::ranges::reverse(files);
  EXPECT_EQ(merged_bytes(), bytes);
  std::swap(files[0], files[1]);
  EXPECT_EQ(merged_bytes(), bytes);
}

TEST_F(MergedFiles, AreAddedByTheirStamps) {
  const MergedFile late = saved(archive_of("late", 50, {-2000}));
  const MergedFile early = saved(archive_of("early", 0, {3511}));
  const auto by_stamps = run_merge({.files = {late, early}}).value();
  ASSERT_THAT(by_stamps.report.maps, SizeIs(2));
  EXPECT_EQ(by_stamps.report.maps[0].path, early.path);
  EXPECT_TRUE(by_stamps.report.maps[1].is_later);
  EXPECT_EQ(log_odds_of(by_stamps.map, 0), -2000) << "the later map looked through it";
  const auto as_given = run_merge({.files = {late, early}, .in_order = true}).value();
  EXPECT_EQ(as_given.report.maps[0].path, late.path);
  EXPECT_EQ(log_odds_of(as_given.map, 0), 3511);
}

TEST_F(MergedFiles, AtTheSameTimeNeitherIsTheLaterOne) {
  const auto both =
      run_merge({.files = {saved(archive_of("a", 0, {3511})), saved(archive_of("b", 1, {-2000}))}})
          .value();
  EXPECT_FALSE(both.report.maps[1].is_later);
  EXPECT_EQ(log_odds_of(both.map, 0), 1511);
}

/// Of this object alone, seen in three frames from that one on.
void see(MapArchive& map, const Box& box, std::uint64_t first_frame) {
  for (std::uint64_t frame = first_frame; frame < first_frame + 3; ++frame) {
    associate(map.objects, std::vector{testing_support::seen(box, ClassId{0}, frame)}, {});
  }
}

StoredLeaf voxel_of(ObjectId object, int x) {
  StoredLeaf leaf{.key = voxel_along_x(x), .log_odds = 847, .label = VoxelLabel{}};
  leaf.label->classes[0] = {0, 500};
  leaf.label->object = object;
  leaf.label->object_votes = 1;
  return leaf;
}

TEST_F(MergedFiles, WhatBecomesPartOfAnotherObjectLeavesItsVoxelsAndViewToIt) {
  // The ends of a bench, which one map never saw in one frame, and the bench. Of the second end a
  // voxel is stored far from its box.
  using testing_support::box_at;
  MapArchive parts = archive_of("parts", 0, {847});
  MapArchive whole = archive_of("whole", 0, {847});
  for (MapArchive* map : {&parts, &whole}) {
    for (std::uint32_t id = 0; id < testing_support::kNumClasses; ++id) {
      ASSERT_TRUE(map->classes.add("class " + std::to_string(id)));
    }
  }
  see(parts, box_at({-0.5, 0, 0.4}, {0.6, 0.4, 0.4}), 0);
  see(parts, box_at({0.5, 0, 0.4}, {0.6, 0.4, 0.4}), 3);
  see(whole, box_at({0, 0, 0.4}, {1.6, 0.4, 0.4}), 0);
  ASSERT_EQ(parts.objects.size(), 2U);
  ASSERT_TRUE(parts.octree->set_leaves(
      std::vector{voxel_of(ObjectId{1}, -5), voxel_of(ObjectId{2}, 5), voxel_of(ObjectId{2}, 90)}));
  const auto jpeg = encode_jpeg(ColorImage(8, 8, Rgb8{200, 100, 0}), 85);
  parts.views[ObjectId{1}] = {.quality = 1.0, .frame_index = 1, .jpeg = jpeg.value()};
  parts.views[ObjectId{2}] = {.quality = 2.0, .frame_index = 4, .jpeg = jpeg.value()};
  const auto merged = run_merge({.files = {saved(parts), saved(whole)}});
  ASSERT_TRUE(merged) << to_string(merged.error());
  ASSERT_EQ(merged->map.objects.size(), 1U);
  for (const int x : {-5, 5, 90}) {
    EXPECT_EQ(merged->map.octree->stored_at(voxel_along_x(x))->label->object, ObjectId{1}) << x;
  }
  ASSERT_EQ(merged->map.views.size(), 1U);
  EXPECT_EQ(merged->map.views.begin()->first, ObjectId{1});
  EXPECT_EQ(merged->map.views.begin()->second.frame_index, 4U) << "the better one of both";
  EXPECT_TRUE(write_archive(merged->map)) << "no voxel names an object that there is not";
}

TEST_F(MergedFiles, KeepTheirSessionsAndCountFramesOn) {
  const auto both =
      run_merge({.files = {saved(archive_of("b", 50, {847})), saved(archive_of("a", 0, {847}))}})
          .value();
  const auto sessions = sessions_of(both.map.provenance);
  ASSERT_THAT(sessions, SizeIs(2));
  EXPECT_EQ(sessions[0].name, "a");
  EXPECT_EQ(sessions[1].name, "b");
  EXPECT_EQ(sessions[1].frames->first, 10U);
  EXPECT_EQ(both.map.provenance[1].next_frame_index, 20U);
  EXPECT_EQ(both.report.num_sessions, 2U);
}

// What both imported is of no frames that would count twice, and no session.
TEST_F(MergedFiles, MayHaveImportedTheSameFile) {
  const auto beside_plan = [](MapArchive archive) {
    archive.provenance.push_back(
        {.tool = "hypermap",
         .input = "plan.yaml",
         .input_hash = "hash of plan",
         .options = make_map({{"import", make_map({{"frame", make_text("map")}})}}),
         .map_from_input = {}});
    return archive;
  };
  const auto both = run_merge({.files = {saved(beside_plan(archive_of("a", 0, {847}))),
                                         saved(beside_plan(archive_of("b", 50, {847})))}});
  ASSERT_TRUE(both) << to_string(both.error());
  EXPECT_EQ(both->report.num_sessions, 2U);
  EXPECT_EQ(both->report.maps[0].num_sessions, 1U);
  const auto sessions = sessions_of(both->map.provenance);
  ASSERT_THAT(sessions, SizeIs(2));
  EXPECT_EQ(sessions[1].frames->first, 10U);
}

TEST_F(MergedFiles, OfOneWorldThatWasAlignedOtherwiseAreBroughtTogether) {
  MapArchive shifted = archive_of("b", 0, {600}, 3);
  Eigen::Isometry3d map_from_input = Eigen::Isometry3d::Identity();
  map_from_input.translation().x() = 0.3;
  shifted.provenance.front().map_from_input = MapFromInput(map_from_input);
  const auto both =
      run_merge({.files = {saved(archive_of("a", 0, {847})), saved(shifted)}}).value();
  EXPECT_EQ(log_odds_of(both.map, 0), 1447);
  EXPECT_EQ(both.report.leaves.occupied, 1U);
}

TEST_F(MergedFiles, HaveEachClassOnce) {
  MapArchive a = archive_of("a", 0, {847});
  ASSERT_TRUE(a.classes.add("chair"));
  ASSERT_TRUE(a.classes.add("tv"));
  MapArchive b = archive_of("b", 0, {847}, 1);
  ASSERT_TRUE(b.classes.add("tvmonitor"));
  ASSERT_TRUE(b.classes.add("cup"));
  StoredLeaf leaf = b.octree->stored_at(voxel_along_x(1)).value();
  leaf.label = VoxelLabel{};
  leaf.label->classes[0] = {0, 500};
  leaf.label->classes[1] = {1, 400};
  ASSERT_TRUE(b.octree->set_leaf(leaf));
  const MapArchive map = run_merge({.files = {saved(a), saved(b)}}).value().map;
  const auto names = map.classes.names();
  EXPECT_THAT(std::vector<std::string>(names.begin(), names.end()),
              ElementsAre("chair", "tv", "cup"));
  const auto label = map.octree->stored_at(voxel_along_x(1))->label;
  EXPECT_EQ(label->classes[0], (ClassWeight{1, 500}));
  EXPECT_EQ(label->classes[1], (ClassWeight{2, 400}));
}

TEST_F(MergedFiles, KeepLayersThatNoMapperMade) {
  const auto with_rooms = [](MapArchive archive, const std::string& room) {
    SemanticObject object{.id = 1, .name = room};
    object.parts.push_back(make_polygon({{0, 0}, {1, 0}, {1, 1}}).value());
    EXPECT_TRUE(archive.hypermap.add_layer(
        {LayerInfo{.name = "rooms"}, SemanticLayer::create({std::move(object)}).value()}));
    return archive;
  };
  const MergedFile a = saved(with_rooms(archive_of("a", 0, {847}), "kitchen"));
  const MergedFile other = saved(with_rooms(archive_of("b", 0, {847}), "hall"));
  const MergedFile same = saved(with_rooms(archive_of("c", 0, {847}), "kitchen"));
  const auto result = run_merge({.files = {a, other, same}}).value();
  EXPECT_NE(result.map.hypermap.find("rooms"), nullptr);
  EXPECT_NE(result.map.hypermap.find("b_rooms"), nullptr);
  EXPECT_EQ(result.map.hypermap.find("c_rooms"), nullptr);
  ASSERT_THAT(result.report.findings, SizeIs(1));
  EXPECT_THAT(to_string(result.report.findings[0].error), HasSubstr("is called b_rooms now"));
}

TEST_F(MergedFiles, OfDifferentVoxelsOrOfOneRunAreRefused) {
  const MergedFile a = saved(archive_of("a", 0, {847}));
  MapArchive coarse = archive_of("coarse", 0, {847});
  coarse.octree = SemanticOctree::create({.resolution_m = 0.2}).value();
  const auto why = [](const MergeJob& job) {
    const auto result = run_merge(job);
    return result ? std::string("merged") : to_string(result.error());
  };
  EXPECT_THAT(why({.files = {a, saved(coarse)}}),
              HasSubstr("coarse.hmap: resolution_m: must be that of"));
  EXPECT_THAT(why({.files = {a, a}}), HasSubstr("whose frames would count twice"));
  EXPECT_THAT(why({.files = {a}}), HasSubstr("must be two or more, are 1"));
  MapArchive other_clamp = archive_of("other_clamp", 0, {847});
  other_clamp.octree = SemanticOctree::create(
                           {.resolution_m = 0.1, .sensor_model = {.clamp_max = Probability{0.99}}})
                           .value();
  EXPECT_THAT(why({.files = {a, saved(other_clamp)}}), HasSubstr("other_clamp.hmap: clamp_max"));
}

TEST_F(MergedFiles, EndWhenAskedTo) {
  const auto result =
      run_merge({.files = {saved(archive_of("a", 0, {847})), saved(archive_of("b", 0, {847}))}},
                [](std::size_t, std::size_t) { return false; });
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace hypermap
