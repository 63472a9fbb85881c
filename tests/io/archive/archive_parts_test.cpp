// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>

#include <span>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> formats_of(std::span<const ExtensionEntry> entries) {
  std::vector<std::string> formats;
  formats.reserve(entries.size());
  for (const ExtensionEntry& entry : entries) formats.push_back(entry.format);
  return formats;
}

TEST(ArchiveParts, WhatIsLeftOutIsNotThereAndTheRestIsAsInTheWhole) {
  const test::TempDir folder;
  const auto path = folder.path() / "a.hmap";
  ASSERT_TRUE(save_archive(test::sample_archive(), path));
  const MapArchive whole = load_archive(path).value().value;
  const PartialMap layers =
      load_archive_parts(path, {.octrees = false, .objects = false, .class_grids = false})
          .value()
          .value;
  EXPECT_EQ(layers.map.hypermap, whole.hypermap);
  EXPECT_EQ(layers.map.classes, whole.classes);
  EXPECT_EQ(layers.map.vocabulary, whole.vocabulary);
  EXPECT_EQ(layers.map.provenance, whole.provenance);
  EXPECT_FALSE(layers.map.octree);
  EXPECT_TRUE(layers.map.objects.empty());
  EXPECT_TRUE(layers.map.class_grids.empty());
  EXPECT_EQ(layers.octree_resolution_m, whole.octree->resolution_m());
  EXPECT_THAT(
      formats_of(layers.left_out),
      ElementsAre(
          kOctomapFormat, kOctreeTwinFormat, kObjectsFormat, kClassGridFormat, kEmbeddingsFormat));
  const PartialMap objects = load_archive_parts(path, {.octrees = false}).value().value;
  EXPECT_EQ(objects.map.objects, whole.objects);
  EXPECT_EQ(objects.map.class_grids, whole.class_grids);
  EXPECT_FALSE(objects.map.octree);
  const PartialMap all = load_archive_parts(path, {}).value().value;
  EXPECT_EQ(all.map, whole);
  EXPECT_TRUE(all.left_out.empty());
  EXPECT_EQ(all.octree_resolution_m, whole.octree->resolution_m());
}

// The voxels name object 1, which is not read: that is no finding, and no voxel forgets it.
TEST(ArchiveParts, VoxelsKeepTheNamesOfObjectsThatAreNotRead) {
  const test::TempDir folder;
  const auto path = folder.path() / "a.hmap";
  ASSERT_TRUE(save_archive(test::sample_archive(), path));
  const auto loaded = load_archive_parts(path, {.objects = false}).value();
  EXPECT_TRUE(loaded.findings.empty());
  EXPECT_EQ(loaded.value.map.octree, load_archive(path).value().value.octree);
}

TEST(ArchiveParts, AMapWithoutAnOctreeDeclaresNoVoxels) {
  const test::TempDir folder;
  const auto path = folder.path() / "a.hmap";
  MapArchive archive = test::sample_archive();
  archive.octree.reset();
  ASSERT_TRUE(save_archive(archive, path));
  EXPECT_FALSE(load_archive_parts(path, {.octrees = false}).value().value.octree_resolution_m);
}

TEST(ArchiveParts, AFaultOfWhatIsReadIsSaid) {
  const test::TempDir folder;
  const auto path = folder.path() / "a.hmap";
  ASSERT_TRUE(write_file_atomically(path, "PK no archive"));
  EXPECT_FALSE(load_archive_parts(path, {.octrees = false}));
  EXPECT_EQ(load_archive_parts(folder.path() / "b.hmap", {}).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap
