// SPDX-License-Identifier: BSD-3-Clause
#include "map_rescue.hpp"

#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"
#include "working_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using test::WorkingFolder;
using ::testing::HasSubstr;

Error failed_save() {
  return {.code = ErrorCode::kIo, .what = "cannot write", .file = "a.hmap"};
}

/// One occupied voxel of one chair, and a layer of it.
MapArchive small_map() {
  MapArchive archive;
  const ClassId chair = archive.classes.add("chair").value();
  Object object;
  object.belief.observe(std::array{ClassEvidence{chair, Probability(0.9)}}, Probability(0.5));
  object.box = {{0.0, 0.0, 0.0}, {0.4, 0.4, 0.8}};
  archive.objects.add(object);
  archive.octree = SemanticOctree::create({}).value();
  EXPECT_TRUE(archive.octree->set_leaf({.key = {32768, 32768, 32769}, .log_odds = 1000}));
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .file = "semantic"}, .content = SemanticLayer()}));
  return archive;
}

MapArchive loaded(const fs::path& path) {
  auto archive = load_archive(path);
  EXPECT_TRUE(archive) << to_string(archive.error());
  return archive ? std::move(archive->value) : MapArchive{};
}

/// The only file below a folder.
fs::path only_file(const fs::path& folder) {
  fs::path found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_TRUE(found.empty()) << found << " and " << entry.path();
    found = entry.path();
  }
  return found;
}

TEST(MapRescue, IsTheWholeMapBesideTheOutput) {
  const TempDir folder;
  const MapArchive map = small_map();
  const Error error = with_rescue(failed_save(), map, folder / "a.hmap");
  EXPECT_EQ(error.code, ErrorCode::kIo);
  EXPECT_THAT(to_string(error), HasSubstr("a.hmap: cannot write; the map is saved in "));
  EXPECT_THAT(error.what, HasSubstr(rescue_path(folder / "a.hmap").string()));
  EXPECT_EQ(loaded(folder / "a.hmap.rescue"), map);
  EXPECT_EQ(only_file(folder.path()), folder / "a.hmap.rescue");
}

TEST(MapRescue, ReplacesAnOlderOne) {
  const TempDir folder;
  test::write_text(folder / "a.hmap.rescue", "older");
  (void)with_rescue(failed_save(), small_map(), folder / "a.hmap");
  EXPECT_EQ(loaded(folder / "a.hmap.rescue"), small_map());
}

TEST(MapRescue, OfAMapWithALayerThatCannotBeSavedHasOctreeAndObjects) {
  const TempDir folder;
  MapArchive map = small_map();
  // Two layers of one file: no loader would take them.
  ASSERT_TRUE(map.hypermap.add_layer(
      {.info = {.name = "other", .file = "semantic"}, .content = SemanticLayer()}));
  ASSERT_FALSE(save_archive(map, folder / "a.hmap"));
  const Error error = with_rescue(failed_save(), map, folder / "a.hmap");
  EXPECT_THAT(error.what, HasSubstr("; its octree and objects are saved in "));
  const MapArchive rescued = loaded(folder / "a.hmap.rescue");
  EXPECT_EQ(rescued.octree, map.octree);
  EXPECT_EQ(rescued.objects, map.objects);
  EXPECT_EQ(rescued.classes, map.classes);
}

TEST(MapRescue, IsWithinTheLimitsOfTheRun) {
  const TempDir folder;
  MapArchive map = small_map();
  map.opaque_files.push_back({.name = "notes", .bytes = "abc"});
  const ArchiveLimits none{.sums = {.max_opaque_bytes = 0}};
  const Error bare = with_rescue(failed_save(), map, folder / "a.hmap", {.limits = none});
  EXPECT_THAT(bare.what, HasSubstr("; its octree and objects are saved in "));
  const ArchiveLimits enough{.sums = {.max_opaque_bytes = 3}};
  const Error whole = with_rescue(failed_save(), map, folder / "a.hmap", {.limits = enough});
  EXPECT_THAT(whole.what, HasSubstr("; the map is saved in "));
}

TEST(MapRescue, GoesToTheWorkingFolderWhenTheOutputsIsGone) {
  const TempDir folder;
  const WorkingFolder elsewhere(folder / "working", folder / "temporaries");
  const Error error = with_rescue(failed_save(), small_map(), folder / "gone" / "a.hmap");
  EXPECT_THAT(error.what, HasSubstr((folder / "working" / "a.hmap.rescue").string()));
  EXPECT_EQ(only_file(folder.path()), folder / "working" / "a.hmap.rescue");
  EXPECT_EQ(loaded("a.hmap.rescue"), small_map());
}

TEST(MapRescue, GoesToAFolderOfItsOwnAmongTemporariesRatherThanOverAFile) {
  const TempDir folder;
  const WorkingFolder elsewhere(folder / "working", folder / "temporaries");
  test::write_text(folder / "working" / "a.hmap.rescue", "of another map");
  const Error error = with_rescue(failed_save(), small_map(), folder / "gone" / "a.hmap");
  const fs::path rescued = only_file(folder / "temporaries");
  EXPECT_THAT(error.what, HasSubstr("; the map is saved in " + rescued.string()));
  EXPECT_EQ(loaded(rescued), small_map());
  EXPECT_EQ(fs::status(rescued.parent_path()).permissions(), fs::perms::owner_all);
}

TEST(MapRescue, ThatCanGoNowhereSaysSoAndLeavesNothing) {
  const TempDir folder;
  const WorkingFolder elsewhere(folder / "working", folder / "temporaries");
  fs::create_directories(folder / "working" / "a.hmap.rescue");
  fs::remove(folder / "temporaries");
  const Error error = with_rescue(failed_save(), small_map(), folder / "gone" / "a.hmap");
  EXPECT_THAT(error.what, HasSubstr("the map could be saved nowhere"));
  EXPECT_EQ(only_file(folder.path()), fs::path());
}

}  // namespace
}  // namespace hypermap
