// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_archive.hpp"

#include "hypermap/io/codec/byte_source.hpp"
#include "io/archive/archive_edits.hpp"
#include "io/archive/sample_archive.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::all_findings;
using test::changed;
using test::kArchiveSource;
using test::load_error;
using test::member_of;
using test::sample_archive;
using test::sample_object;
using test::TempDir;
using test::zip_of;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MapArchive, LoadSaveLoadIsAFixedPointByteForByte) {
  const MapArchive archive = sample_archive();
  const auto bytes = write_archive(archive);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const auto loaded = parse_archive(*bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_EQ(write_archive(loaded->value).value(), *bytes);
}

TEST(MapArchive, AnEmptyMapIsAMap) {
  const auto bytes = write_archive(MapArchive{});
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const auto loaded = parse_archive(*bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == MapArchive{});
}

TEST(MapArchive, TheStrictFormStandsFirstAndAlone) {
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  ASSERT_TRUE(zip);
  std::vector<std::string> names;
  for (const ZipMember& member : zip->members()) names.push_back(member.name);
  EXPECT_THAT(names,
              testing::ElementsAre("hmap_config.yaml",
                                   "occupancy.yaml",
                                   "occupancy.png",
                                   "semantic",
                                   "octree.ot",
                                   "objects.jsonl",
                                   "embeddings.bin",
                                   "classes.yaml",
                                   "class_grid_0.yaml",
                                   "class_grid_0.png",
                                   "provenance.yaml",
                                   "octree.bt"));
  const std::string config = member_of(bytes, "hmap_config.yaml");
  const std::size_t extensions = config.find("extensions:");
  ASSERT_NE(extensions, std::string::npos);
  // Without our additions it is an archive of the first implementation.
  const auto strict =
      zip_of({{"hmap_config.yaml", config.substr(0, config.find("format_version:"))},
              {"occupancy.yaml", member_of(bytes, "occupancy.yaml")},
              {"occupancy.png", member_of(bytes, "occupancy.png")},
              {"semantic", member_of(bytes, "semantic")}});
  const auto loaded = parse_archive(strict, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value.hypermap == sample_archive().hypermap);
}

TEST(MapArchive, ACheckpointsNoteIsPartOfTheMap) {
  MapArchive archive = sample_archive();
  archive.checkpoint = make_map({{"positions", make_number(3)}, {"name", make_text("no: 1")}});
  const std::string bytes = write_archive(archive).value();
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(all_findings(loaded->findings), "");
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_FALSE(loaded->value == sample_archive());
  EXPECT_EQ(write_archive(loaded->value).value(), bytes);
  EXPECT_THAT(load_error(changed(bytes, {{"checkpoint.yaml", "- 1\n"}})),
              HasSubstr("checkpoint.yaml"));
  EXPECT_THAT(load_error(changed(bytes, {{"checkpoint.yaml", ""}})), HasSubstr("checkpoint.yaml"));
  const std::string config = member_of(bytes, "hmap_config.yaml");
  const std::string second =
      "  - {format: hypermap-checkpoint, version: 1, name: again, frame_id: map, file: b.yaml}\n";
  EXPECT_THAT(load_error(changed(bytes, {{"hmap_config.yaml", config + second}})),
              HasSubstr("a second 'hypermap-checkpoint'"));
}

TEST(MapArchive, WhatIsNotUnderstoodIsKeptAndSaid) {
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "layers:\n"
               "  - {class: GasLayer, name: gas, frame_id: map, load_file: true, file: gas.bin,"
               " unit: ppm}\n"
               "extensions:\n"
               "  - {format: weather, version: 7, file: weather.txt}\n"
               "author: someone\n"},
              {"gas.bin", std::string("\0\1\2", 3)},
              {"weather.txt", "sunny"},
              {"notes.txt", "buy milk"}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const std::string findings = all_findings(loaded->findings);
  for (const char* what : {"GasLayer", "unit", "weather", "author"})
    EXPECT_THAT(findings, HasSubstr(what));
  const std::string saved = write_archive(loaded->value).value();
  for (const char* name : {"gas.bin", "weather.txt", "notes.txt"})
    EXPECT_EQ(member_of(saved, name), member_of(bytes, name));
  const auto again = parse_archive(saved, kArchiveSource);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_TRUE(again->value == loaded->value);
  EXPECT_EQ(write_archive(again->value).value(), saved);
}

TEST(MapArchive, OctreesOfOtherProgramsAreKeptByteForByte) {
  HYPERMAP_REQUIRE_SHARED_DATA("octomap/velma/map.bt");
  const std::string tree = read_file(test::shared_data("octomap/velma/map.bt"), 1 << 30).value();
  const std::string bytes =
      zip_of({{"hmap_config.yaml",
               "layers: []\nextensions:\n"
               "  - {format: octomap, version: 1, name: room, frame_id: odom, file: room.bt}\n"},
              {"room.bt", tree}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_EQ(loaded->value.octomaps.size(), 1U);
  EXPECT_FALSE(loaded->value.octree);
  EXPECT_GT(loaded->value.octomaps[0].tree.leaves.size(), 1000U);
  EXPECT_EQ(member_of(write_archive(loaded->value).value(), "room.bt"), tree);
}

TEST(MapArchive, ALabelWithoutAClassIsRefusedBothWays) {
  MapArchive archive = sample_archive();
  const std::string bytes = write_archive(archive).value();
  EXPECT_THAT(load_error(changed(bytes, {{"classes.yaml", "[chair]\n"}})), HasSubstr("class"));
  archive.classes = ClassRegistry();
  EXPECT_FALSE(write_archive(archive));
}

TEST(MapArchive, VoxelsOfAnObjectThatIsNotThereAreOfNone) {
  MapArchive other = sample_archive();
  other.objects.add(sample_object());
  ASSERT_TRUE(other.objects.erase(ObjectId{1}));
  ASSERT_TRUE(other.objects.contains(ObjectId{2}));
  EXPECT_THAT(to_string(write_archive(other).error()), HasSubstr("a voxel names object 1"));
  other.octree->relabel_object(ObjectId{1}, kNoObject);
  const std::string other_objects = member_of(write_archive(other).value(), "objects.jsonl");

  const std::string bytes =
      changed(write_archive(sample_archive()).value(), {{"objects.jsonl", other_objects}});
  const auto loaded = parse_archive(bytes, kArchiveSource);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_THAT(all_findings(loaded->findings),
              HasSubstr("72 voxels name objects that the map does not have (1 is one)"));
  EXPECT_TRUE(loaded->value.octree == other.octree);
  EXPECT_TRUE(write_archive(loaded->value));
}

TEST(MapArchive, WhatTheLoaderWouldRefuseTheSaverRefuses) {
  MapArchive archive = sample_archive();
  archive.objects.modify(ObjectId{1}, [](Object& object) {
    object.existence = LogOdds(std::numeric_limits<double>::quiet_NaN());
  });
  const TempDir dir;
  const auto saved = save_archive(archive, dir / "a.hmap");
  ASSERT_FALSE(saved);
  EXPECT_THAT(to_string(saved.error()), HasSubstr("object 1"));
  EXPECT_FALSE(fs::exists(dir / "a.hmap"));
}

TEST(MapArchive, AFailedSaveLeavesTheOldArchive) {
  const TempDir dir;
  ASSERT_TRUE(save_archive(MapArchive{}, dir / "a.hmap"));
  const std::string before = read_file(dir / "a.hmap", 1 << 20).value();
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  const rlimit full_disk{.rlim_cur = 100, .rlim_max = unlimited.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full_disk);
  const auto saved = save_archive(sample_archive(), dir / "a.hmap");
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().what, HasSubstr("errno 27"));
  EXPECT_EQ(read_file(dir / "a.hmap", 1 << 20).value(), before);
}

TEST(MapArchive, WhenItCannotBeReadBackTheErrorSaysThatItWasReplaced) {
  const TempDir dir;
  std::ofstream(dir / "a.hmap") << "old";
  fs::permissions(dir / "a.hmap", fs::perms::owner_write);
  fs::permissions(dir.path(), fs::perms::all);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {  // whose saver is nobody: the old file's mode, which is kept, forbids to read
    constexpr uid_t kNobody = 65534;
    const bool is_nobody = ::geteuid() != 0 || ::setuid(kNobody) == 0;
    const auto saved = save_archive(sample_archive(), dir / "a.hmap");
    const bool said = !saved && saved.error().what.starts_with("replaced, yet cannot open") &&
                      saved.error().file == (dir / "a.hmap").string();
    ::_exit(is_nobody && said ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_GT(fs::file_size(dir / "a.hmap"), 3U);
}

TEST(MapArchive, LoadsWhatWasSavedFromADisk) {
  const TempDir dir;
  const MapArchive archive = sample_archive();
  const auto saved = save_archive(archive, dir / "a.hmap");
  ASSERT_TRUE(saved) << to_string(saved.error());
  const auto loaded = load_archive(dir / "a.hmap");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == archive);
}

TEST(MapArchive, ABareConfigurationIsLoadedWithTheFilesBesideIt) {
  const TempDir dir;
  const std::string bytes = write_archive(sample_archive()).value();
  const auto zip = ZipReader::create(view_bytes(bytes));
  for (const ZipMember& member : zip->members())
    std::ofstream(dir / member.name, std::ios::binary) << zip->read(member.name).value();
  const auto loaded = load_archive(dir / "hmap_config.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value == sample_archive());
}

TEST(MapArchive, ABareConfigurationMayNameFilesAnywhereAndIsSavedWithThemInside) {
  const TempDir dir;
  fs::create_directory(dir / "maps");
  fs::create_directory(dir / "config");
  std::ofstream(dir / "maps" / "shapes.yaml") << "- name: sink\n  shape: POLYGON((0 0,1 0,1 1))\n";
  std::ofstream(dir / "config" / "map.yaml")
      << "layers:\n  - {class: SemanticLayer, name: semantic, frame_id: map, load_file: true, "
         "file: ../maps/shapes.yaml}\n";
  const auto loaded = load_archive(dir / "config" / "map.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto bytes = write_archive(loaded->value);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  EXPECT_THAT(member_of(*bytes, "semantic"), HasSubstr("sink"));
  const auto confined = load_archive(dir / "config" / "map.yaml", {.reach = FileReach::kOwnFolder});
  ASSERT_FALSE(confined);
  EXPECT_THAT(to_string(confined.error()), HasSubstr("layers[0].file: leads out of the archive"));
}

TEST(MapArchive, FilesThatAreNoArchivesAreSaidToBeNone) {
  const TempDir dir;
  std::ofstream(dir / "a.hmap") << "";
  std::ofstream(dir / "b.hmap") << "P5 2 2 255 abcd";
  for (const char* name : {"a.hmap", "b.hmap"}) {
    const auto loaded = load_archive(dir / name);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(to_string(loaded.error()), HasSubstr("not a map archive"));
    EXPECT_THAT(to_string(loaded.error()), HasSubstr(name));
  }
  EXPECT_EQ(load_archive(dir / "none.hmap").error().code, ErrorCode::kIo);
  EXPECT_EQ(load_archive(dir.path()).error().code, ErrorCode::kIo);
}

TEST(MapArchive, EveryArchiveOfTheFirstImplementationLoadsAndLosesNothing) {
  HYPERMAP_REQUIRE_SHARED_DATA("hmap");
  int num_archives = 0;
  for (const auto& file : fs::directory_iterator(test::shared_data("hmap"))) {
    if (file.path().extension() != ".hmap") continue;
    ++num_archives;
    const auto loaded = load_archive(file.path());
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const auto saved = write_archive(loaded->value);
    ASSERT_TRUE(saved) << file.path() << to_string(saved.error());
    const auto again = parse_archive(*saved, kArchiveSource);
    ASSERT_TRUE(again) << file.path() << to_string(again.error());
    EXPECT_TRUE(again->value == loaded->value) << file.path();
    EXPECT_EQ(write_archive(again->value).value(), *saved) << file.path();
  }
  EXPECT_EQ(num_archives, 8);
}

}  // namespace
}  // namespace hypermap
